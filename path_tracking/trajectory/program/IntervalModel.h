#pragma once

#include "path_tracking/trajectory/program/MotionProblem.h"

#include <array>

#include <Eigen/Core>

namespace parking
{
    /** \brief Entries of the two nodes of an interval, those of its first node first. @{ */
    constexpr int PAIR_SIZE = 2 * NODE_SIZE;
    using PairVector = Eigen::Matrix<double, PAIR_SIZE, 1>;          ///< one number per entry
    using PairMatrix = Eigen::Matrix<double, PAIR_SIZE, PAIR_SIZE>;  ///< one number per pair of entries
    using GapRows = Eigen::Matrix<double, 3, PAIR_SIZE>;  ///< derivatives of the gaps in x, y and yaw, one row each
    /** @} */

    /** \brief Trigonometric functions of a node's yaw and steering angle, computed once. */
    struct NodeAngles
    {
        /** \brief Computes the functions of the angles of \e node. */
        explicit NodeAngles(const NodeVector &node);

        double cosine;   ///< of the yaw
        double sine;     ///< of the yaw
        double tangent;  ///< of the steering angle
    };

    /** \brief Weights of the cubic Hermite polynomial of an interval, for first pose, way at the start, last pose and
        way at the end. See IntervalModel. */
    Eigen::Vector4d hermiteWeights(double fraction);

    /** \brief Contributions of an interval to the system of a MotionProgram, by the entries of its two nodes. */
    struct IntervalTerms
    {
        PairMatrix hessian{PairMatrix::Zero()};   ///< of the Lagrangian, including eliminated variables
        PairVector cost{PairVector::Zero()};      ///< gradient of the cost
        PairVector gradient{PairVector::Zero()};  ///< of the rest of the Lagrangian
        /** Right side of the system at a barrier of zero, plus the gradient of the Lagrangian. */
        PairVector shift{PairVector::Zero()};
        PairVector barrierSlope{PairVector::Zero()};  ///< change of the right side per unit of the barrier (mu)
        /** Factors of the curvature of the ways at the two ends (see IntervalModel). @{ */
        Eigen::Vector3d wayAtBegin{Eigen::Vector3d::Zero()},  ///< at the start of the interval
            wayAtEnd{Eigen::Vector3d::Zero()};                ///< at the end of the interval
        /** @} */

        /** \brief Adds \e value to an off-diagonal entry of the Hessian and to its mirror image. */
        void couple(int i, int j, double value)
        {
            hessian(i, j) += value;
            hessian(j, i) += value;
        }
    };

    /** \brief Accumulated contributions of rows at poses of an interval.

        The order is begin, way at the start, end and way at the end of x, then of y, then of yaw. Poses within the
        interval are linear in these. */
    struct SpanTerms
    {
        Eigen::Matrix<double, 12, 12> hessian{Eigen::Matrix<double, 12, 12>::Zero()};  ///< of the rows
        /** Gradient of the Lagrangian by the rows. */
        Eigen::Matrix<double, 12, 1> gradient{Eigen::Matrix<double, 12, 1>::Zero()};
        Eigen::Matrix<double, 12, 1> shift{Eigen::Matrix<double, 12, 1>::Zero()};  ///< contribution to the right side
        Eigen::Matrix<double, 12, 1> barrierSlope{Eigen::Matrix<double, 12, 1>::Zero()};  ///< see IntervalTerms
        Eigen::Matrix<double, 12, 1> cost{Eigen::Matrix<double, 12, 1>::Zero()};          ///< gradient of the cost

        /** \brief Adds derivatives by the pose at hermiteWeights(). The Hessian is updated on and below the block
            diagonal only, see complete(). */
        void add(const Eigen::Vector4d &weights, const Eigen::Matrix3d &poseHessian,
                 const Eigen::Vector3d &poseGradient, const Eigen::Vector3d &poseShift,
                 const Eigen::Vector3d &poseBarrierSlope, const Eigen::Vector3d &poseCost);

        /** \brief Fills the blocks of the Hessian above the diagonal. */
        void complete();
    };

    /** \brief Model of an interval between two nodes: its final pose, its cost, and all first and second derivatives.

        The *way* of an end is d h v (cos yaw, sin yaw, tan(steering) / wheelbase). It is the displacement of an
        interval of duration h in direction d at the rates of that end. All nonlinearity is in the ways of both ends and
        of the middle. */
    class IntervalModel
    {
    public:
        /** \param direction 1, -1, or 0 at a standstill */
        IntervalModel(int direction, double wheelbase, const NodeVector &begin, const NodeVector &end);

        /** \brief Creates the model from nodes whose NodeAngles are available. */
        IntervalModel(int direction, double wheelbase, const NodeVector &begin, const NodeVector &end,
                      const NodeAngles &atBegin, const NodeAngles &atEnd);

        /** \brief Differences in x, y and yaw between the last node and the pose reached from the first. They are 0 for
            a driven interval. */
        Eigen::Vector3d gaps() const;

        /** \brief Derivatives of gaps(). */
        GapRows gapRows() const;

        /** \brief Adds the second derivatives of \e prices . gaps(), except those of the ways at the ends. */
        void addGapCurvature(const Eigen::Vector3d &prices, IntervalTerms &terms) const;

        /** \brief Pose (x, y, yaw) within the interval, by hermiteWeights(). */
        Eigen::Vector3d poseAt(const Eigen::Vector4d &weights) const;

        /** \brief Change of poseAt() when the nodes change by \e step. */
        Eigen::Vector3d poseStep(const Eigen::Vector4d &weights, const PairVector &step) const;

        /** \brief Adds the contributions of rows. */
        void addSpan(const SpanTerms &span, IntervalTerms &terms) const;

        /** \brief Adds the second derivatives of the ways at the ends, multiplied by those in \e terms. It must be
            called last. */
        void addWayCurvature(IntervalTerms &terms) const;

        /** \brief The cost of the interval. */
        double cost(const MotionWeights &weights) const;

        /** \brief Adds the derivatives of the cost. */
        void addCost(const MotionWeights &weights, IntervalTerms &terms) const;

    private:
        /** A way and its derivatives by duration, speed and angle: the yaw for x and y, the steering angle for yaw. */
        struct Way
        {
            Eigen::Vector3d way, byDuration, bySpeed, byAngle;
        };

        Way wayOf(const NodeVector &node, const NodeAngles &angles) const;
        PairVector yawRow() const;
        void addEffort(double weight, IntervalTerms &terms) const;

        double direction_, wheelbase_, duration_;
        NodeVector a_, b_;
        NodeAngles atBegin_, atEnd_;
        Way begin_, end_;
        double speed_, steering_, yaw_;  // in the middle
        double cosine_, sine_, tangent_;
    };
}  // namespace parking
