#include "path_tracking/trajectory/program/MotionProblem.h"

#include "path_tracking/trajectory/program/IntervalModel.h"

namespace parking
{
    namespace
    {
        constexpr double AT_LIMIT = 0.97;  // share of a limit above which it is active

        /** Utilisation of the limit of acceleration or steering rate by an interval, in [-1, 1]. */
        double shareOfLimit(const MotionProblem &problem, std::size_t interval, int entry)
        {
            const NodeVector &from = problem.nodes[interval], &to = problem.nodes[interval + 1];
            const double limit =
                entry == NODE_SPEED ? problem.vehicle.maxAcceleration : problem.vehicle.maxSteeringRate;
            return (to[entry] - from[entry]) / (from[NODE_DURATION] * limit);
        }

        /** 1 and -1 at an active limit, 0 between. */
        int limitOf(double share)
        {
            return share > AT_LIMIT ? 1 : share < -AT_LIMIT ? -1 : 0;
        }
    }  // namespace

    Pose MotionProblem::poseAt(std::size_t interval, double fraction) const
    {
        const Eigen::Vector3d pose =
            IntervalModel(directions[interval], vehicle.wheelbase, nodes[interval], nodes[interval + 1])
                .poseAt(hermiteWeights(fraction));
        return {pose[0], pose[1], pose[2]};
    }

    TimedMotion motionOf(const MotionProblem &problem, const Pose &start)
    {
        TimedMotion motion{start, {}};
        for (std::size_t k = 0; k < problem.nodes.size(); ++k)
        {
            // A node between a standstill and a drive is at rest, in either direction.
            const int before = k > 0 ? problem.directions[k - 1] : 0;
            const int behind = k < problem.directions.size() ? problem.directions[k] : 0;
            motion.append(k > 0 ? problem.nodes[k - 1][NODE_DURATION] : 0.0,
                          (before != 0 ? before : behind) * problem.nodes[k][NODE_SPEED],
                          problem.nodes[k][NODE_STEERING]);
        }
        return motion;
    }

    void endPhasesAtChanges(MotionProblem &problem)
    {
        problem.phaseEnds.resize(problem.directions.size(), 0);
        for (std::size_t k = 1; k + 1 < problem.directions.size(); ++k)
        {
            if (problem.directions[k - 1] == 0 || problem.directions[k] == 0 || problem.directions[k + 1] == 0)
                continue;
            for (const int entry : {NODE_SPEED, NODE_STEERING})
            {
                const double before = shareOfLimit(problem, k - 1, entry), here = shareOfLimit(problem, k, entry),
                             behind = shareOfLimit(problem, k + 1, entry);
                if (limitOf(here) != 0 || limitOf(before) == limitOf(behind))
                    continue;
                // The share of the interval with the previous value; the node nearer to the change may move.
                const double part = (here - behind) / (before - behind);
                problem.phaseEnds[part < 0.5 ? k - 1 : k] = 1;
            }
        }
    }

    void correctIntervals(MotionProblem &problem)
    {
        problem.corrections.assign(problem.directions.size(), Eigen::Vector3d::Zero());
        for (std::size_t k = 0; k < problem.directions.size(); ++k)
        {
            const double direction = problem.directions[k];
            if (direction == 0.0)
                continue;
            const NodeVector &from = problem.nodes[k], &to = problem.nodes[k + 1];
            TimedMotion motion{{from[NODE_X], from[NODE_Y], from[NODE_YAW]}, {}};
            motion.append(0.0, direction * from[NODE_SPEED], from[NODE_STEERING]);
            motion.append(from[NODE_DURATION], direction * to[NODE_SPEED], to[NODE_STEERING]);
            const Pose end = endOf(motion, problem.vehicle);
            const IntervalModel model(problem.directions[k], problem.vehicle.wheelbase, from, to);
            problem.corrections[k] = Eigen::Vector3d(end.x, end.y, end.yaw) - (to.head<3>() - model.gaps());
        }
    }
}  // namespace parking
