#include "path_tracking/trajectory/program/SolvedMotion.h"

#include "path_tracking/trajectory/program/IntervalModel.h"

namespace parking
{
    TimedMotion motionOf(const MotionProblem &problem, const Pose &start)
    {
        TimedMotion motion{start, {}};
        for (std::size_t k = 0; k < problem.nodes.size(); ++k)
        {
            // A node between a standstill and a drive is at rest, whatever the direction.
            const int before = k > 0 ? problem.directions[k - 1] : 0;
            const int behind = k < problem.directions.size() ? problem.directions[k] : 0;
            motion.append(k > 0 ? problem.nodes[k - 1][NODE_DURATION] : 0.0,
                          (before != 0 ? before : behind) * problem.nodes[k][NODE_SPEED],
                          problem.nodes[k][NODE_STEERING]);
        }
        return motion;
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
