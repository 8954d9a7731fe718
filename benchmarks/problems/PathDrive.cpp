#include "benchmarks/problems/PathDrive.h"

namespace parking
{
    DriveResult drivePath(const Problem &problem, const PlannedPath &path)
    {
        const FootprintChecker &footprint = problem.footprint();
        ClosedLoop loop(problem.scenario().vehicle);
        loop.setClearance([&footprint](const Pose &pose) { return footprint.clearance(pose); });
        loop.setValidity([&footprint](const Pose &pose) { return footprint.isFree(pose); });
        return loop.drive(path.path);
    }
}  // namespace parking
