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
    /** \brief Which entry of a node is what. */
    enum NodeEntry : int
    {
        NODE_X,         ///< metres
        NODE_Y,         ///< metres
        NODE_YAW,       ///< radians, not wrapped
        NODE_SPEED,     ///< m/s in the direction of the interval, not negative
        NODE_STEERING,  ///< radians
        NODE_DURATION   ///< seconds of the interval that begins at the node
    };

    /** \brief A demand on a pose that keeps the body apart from something.

        Either a corner of the body has to stay beyond a line of the world, or a point of the world has to stay beyond a
        side of the body. */
    struct BodyRow
    {
        bool ofBody{false};      ///< the line is a side of the body
        Eigen::Vector2d normal;  ///< of the line, of unit length; in the frame of the car if ofBody
        Eigen::Vector2d point;   ///< that has to stay beyond it: of the body in its frame, or if ofBody of the world
        double offset{0.0};      ///< of the line along its normal, with the margin

        /** \brief How far the point is beyond the line, metres; negative when it is not.
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

    /** \brief Where along an interval rows have to hold. */
    struct MotionCheckpoint
    {
        std::size_t interval{0};  ///< index into MotionProblem::directions
        double fraction{1.0};     ///< of the interval's time, above 0 and up to 1
        std::size_t firstRow{0};  ///< into the rows of the problem
        std::size_t lastRow{0};   ///< one behind
        double way{0.0};          ///< metres driven for which it stands
    };

    /** \brief What is counted as the cost of a motion. */
    struct MotionWeights
    {
        double time{1.0};      ///< per second
        double effort{0.0};    ///< of the integral of a^2 + (v w)^2, with the steering rate w
        double steering{0.0};  ///< of the integral of the squared steering angle
        double nearness{0.0};  ///< per metre driven in touch with what a row keeps apart, see MotionProblem::clearance
    };

    /** \brief A search for the best motion nearby, as a nonlinear program.

        Nodes in time, with an interval between each and the next. Speed and steering are linear over an interval, so
        that the limits of acceleration and steering rate are linear in the nodes. The poses of neighbouring nodes are
        joined by Hermite-Simpson collocation (C. R. Hargraves and S. W. Paris, "Direct trajectory optimization using
        nonlinear programming and collocation", 1987), and the pose within an interval is the cubic Hermite polynomial
        of its ends. A stretch consists of phases, and intervals of one phase last equally long: where a phase ends, a
        node can be where the car begins to brake or the wheels begin to turn back. At a standstill the pose stays. */
    struct MotionProblem
    {
        Vehicle vehicle;        ///< the limits, and the wheelbase
        MotionWeights weights;  ///< what counts as the cost
        /** Metres beyond a row from which on it costs nothing to be near; nearer the price grows with the square of
            what is missing. */
        double clearance{0.0};
        double leastDuration{0.01};       ///< seconds, of an interval that drives
        std::vector<int> directions;      ///< per interval: 1 forwards, -1 in reverse, 0 at a standstill
        std::vector<NodeVector> nodes;    ///< one more than intervals: where to begin
        std::vector<std::uint8_t> fixed;  ///< per node, bit by bit: entries that keep their value
        /** Per interval: whether a phase ends with it, within a stretch; empty where each stretch is one phase. */
        std::vector<std::uint8_t> phaseEnds;
        /** Per interval: x, y and yaw by which it leads farther than its collocation says; empty for no difference. */
        std::vector<Eigen::Vector3d> corrections;
        std::vector<MotionCheckpoint> checkpoints;  ///< by interval
        std::vector<BodyRow> rows;                  ///< demands on poses, grouped by checkpoint

        /** \brief Does this entry of a node keep its value? */
        bool isFixed(std::size_t node, int entry) const
        {
            return (fixed[node] >> entry & 1) != 0;
        }

        /** \brief Does an interval last as long as the one behind it? Two stretches have a standstill between them. */
        bool sharesDuration(std::size_t interval) const
        {
            return interval + 1 < directions.size() && directions[interval] != 0 && directions[interval + 1] != 0 &&
                   (phaseEnds.empty() || phaseEnds[interval] == 0);
        }

        /** \brief The pose at a fraction of an interval between the nodes. */
        Pose poseAt(std::size_t interval, double fraction) const;
    };

    /** \brief The motion whose speeds and steering angles the nodes of a problem have.
        \param start its first pose, which may be in other coordinates than those of the problem */
    TimedMotion motionOf(const MotionProblem &problem, const Pose &start);

    /** \brief Ends phases beside intervals in which the solution changes from one limit to another: of acceleration, or
        of the steering rate. Solved once more, a node can then be where that change is. Phases that end already go on
        doing so.

        Between two nodes neither changes, so that a change between nodes costs time. Phases that end everywhere would
        do, too, but leave it undecided how nodes are spread where nothing changes, and take thrice as many
        iterations. */
    void endPhasesAtChanges(MotionProblem &problem);

    /** \brief Writes MotionProblem::corrections: where the intervals lead when they are integrated, less what
        collocation says. Solved once more, the nodes are then where the car is. Along hundreds of metres the errors of
        collocation, some hundredths of a millimetre each, add up to a centimetre. */
    void correctIntervals(MotionProblem &problem);
}  // namespace parking
