#include "benchmarks/plan/PathDrive.h"

namespace parking
{
    namespace
    {
        ClosedLoop loopFor(const Problem &problem)
        {
            const FootprintChecker &footprint = problem.footprint();
            ClosedLoop loop(problem.scenario().vehicle);
            loop.setClearance([&footprint](const Pose &pose)
                              { return footprint.isFree(pose) ? footprint.clearance(pose) : 0.0; });
            return loop;
        }
    }  // namespace

    DriveResult drivePath(const Problem &problem, const PlannedPath &path)
    {
        return loopFor(problem).drive(path.path);
    }

    DriveResult driveMotion(const Problem &problem, const TimedMotion &motion)
    {
        return loopFor(problem).follow(motion);
    }
}  // namespace parking
