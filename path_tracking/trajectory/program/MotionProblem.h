#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/program/BlockTridiagonal.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Index of an entry of a node. */
    enum NodeEntry : int
    {
        NODE_X,         ///< metres
        NODE_Y,         ///< metres
        NODE_YAW,       ///< radians, not wrapped
        NODE_SPEED,     ///< m/s in the direction of the interval, not negative
        NODE_STEERING,  ///< radians
        NODE_DURATION   ///< seconds of the interval that follows the node
    };

    /** \brief A constraint on a pose that keeps the body away from an obstacle.

        Either a corner of the body must stay beyond a line of the world, or a point of the world beyond a side of the
        body. */
    struct BodyRow
    {
        bool ofBody{false};      ///< whether the line is a side of the body
        Eigen::Vector2d normal;  ///< of the line, of unit length; in the frame of the car if ofBody
        /** The point that must stay beyond the line; of the world if ofBody, else in the frame of the body. */
        Eigen::Vector2d point;
        double offset{0.0};  ///< of the line along its normal, including the margin

        /** \brief Distance of the point beyond the line in metres, negative on the wrong side.
            \param x, y metres, position
            \param cosine, sine of the yaw */
        double value(double x, double y, double cosine, double sine) const
        {
            if (!ofBody)
                return normal.x() * (x + cosine * point.x() - sine * point.y()) +
                       normal.y() * (y + sine * point.x() + cosine * point.y()) - offset;
            const double dx = point.x() - x, dy = point.y() - y;
            return normal.x() * (cosine * dx + sine * dy) + normal.y() * (cosine * dy - sine * dx) - offset;
        }
    };

    /** \brief Position along an interval at which rows must hold. */
    struct MotionCheckpoint
    {
        std::size_t interval{0};  ///< index into MotionProblem::directions
        double fraction{1.0};     ///< of the interval's time, above 0 and up to 1
        std::size_t firstRow{0};  ///< index of the first row of the problem
        std::size_t lastRow{0};   ///< index after the last row
        double way{0.0};          ///< driven metres that the checkpoint represents
    };

    /** \brief Weights of the cost of a motion. */
    struct MotionWeights
    {
        double time{1.0};      ///< per second
        double effort{0.0};    ///< per integral of a^2 + (v w)^2, with the steering rate w
        double steering{0.0};  ///< per integral of the squared steering angle
        double nearness{0.0};  ///< per metre driven in contact with a row's obstacle, see MotionProblem::clearance
    };

    /** \brief The search for a locally optimal motion, as a nonlinear program.

        It has nodes in time with intervals between them. Speed and steering are linear over an interval. Therefore the
        limits of acceleration and steering rate are linear in the nodes.

        Hermite-Simpson collocation joins the poses of adjacent nodes (C. R. Hargraves and S. W. Paris, "Direct
        trajectory optimization using nonlinear programming and collocation", 1987). The pose within an interval is the
        cubic Hermite polynomial of its ends.

        A stretch consists of phases, and the intervals of a phase have equal durations. At the end of a phase, a node
        can lie where the car begins to brake or to steer back. At a standstill the pose is constant. */
    struct MotionProblem
    {
        Vehicle vehicle;        ///< the limits, and the wheelbase
        MotionWeights weights;  ///< of the cost
        /** Metres from a row within which proximity is penalised; the penalty is quadratic in the missing distance. */
        double clearance{0.0};
        double minDuration{0.01};         ///< seconds, of a driving interval
        std::vector<int> directions;      ///< per interval: 1 forwards, -1 in reverse, 0 at a standstill
        std::vector<NodeVector> nodes;    ///< initial nodes, one more than intervals
        std::vector<std::uint8_t> fixed;  ///< per node: bit mask of fixed entries
        /** Per interval: whether a phase ends with it within a stretch. Empty if each stretch is one phase. */
        std::vector<std::uint8_t> phaseEnds;
        /** Per interval: correction of x, y and yaw added to its collocation. Empty for none. */
        std::vector<Eigen::Vector3d> corrections;
        std::vector<MotionCheckpoint> checkpoints;  ///< by interval
        std::vector<BodyRow> rows;                  ///< constraints on poses, grouped by checkpoint

        /** \brief Whether an entry of a node is fixed. */
        bool isFixed(std::size_t node, int entry) const
        {
            return (fixed[node] >> entry & 1) != 0;
        }

        /** \brief Whether an interval has the same duration as its successor. A standstill separates two stretches. */
        bool sharesDuration(std::size_t interval) const
        {
            return interval + 1 < directions.size() && directions[interval] != 0 && directions[interval + 1] != 0 &&
                   (phaseEnds.empty() || phaseEnds[interval] == 0);
        }

        /** \brief The pose at a fraction of an interval between the nodes. */
        Pose poseAt(std::size_t interval, double fraction) const;
    };

    /** \brief The motion with the speeds and steering angles of the nodes of a problem.
        \param start its first pose, which may be in other coordinates than the problem's */
    TimedMotion motionOf(const MotionProblem &problem, const Pose &start);

    /** \brief Ends phases near intervals in which the solution switches between limits of acceleration or steering
        rate. In the next solution, a node can lie at that change. Existing ends of phases are kept.

        Acceleration and steering rate are constant between two nodes, so a change between nodes costs time. If every
        interval ended a phase, the distribution of nodes would be undetermined, and solving would take three times as
        many iterations. */
    void endPhasesAtChanges(MotionProblem &problem);

    /** \brief Computes MotionProblem::corrections as the difference between integration and collocation. In the next
        solution, the nodes match the integrated motion. Collocation errors of hundredths of a millimetre accumulate to
        a centimetre over hundreds of metres. */
    void correctIntervals(MotionProblem &problem);
}  // namespace parking
