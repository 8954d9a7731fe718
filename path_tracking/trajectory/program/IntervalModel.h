#pragma once

#include "path_tracking/trajectory/program/MotionProblem.h"

#include <array>

#include <Eigen/Core>

namespace parking
{
    /** \brief Entries of the two nodes of an interval, those of its begin first. @{ */
    constexpr int PAIR_SIZE = 2 * NODE_SIZE;
    using PairVector = Eigen::Matrix<double, PAIR_SIZE, 1>;          ///< a number for each entry
    using PairMatrix = Eigen::Matrix<double, PAIR_SIZE, PAIR_SIZE>;  ///< a number for each two entries
    using GapRows = Eigen::Matrix<double, 3, PAIR_SIZE>;  ///< derivatives of the gaps in x, y and yaw, a row each
    /** @} */

    /** \brief What of a node's yaw and steering angle is needed again and again. */
    struct NodeAngles
    {
        /** \brief Of the angles of \e node. */
        explicit NodeAngles(const NodeVector &node);

        double cosine;   ///< of the yaw
        double sine;     ///< of the yaw
        double tangent;  ///< of the steering angle
    };

    /** \brief Weights of begin, way at the begin, end and way at the end (see IntervalModel) in the cubic Hermite
        polynomial that leads through an interval. */
    Eigen::Vector4d hermiteWeights(double fraction);

    /** \brief What an interval adds to the system of a MotionProgram, by the entries of its two nodes. */
    struct IntervalTerms
    {
        PairMatrix hessian{PairMatrix::Zero()};   ///< of the Lagrangian, with what was eliminated
        PairVector cost{PairVector::Zero()};      ///< gradient of the cost
        PairVector gradient{PairVector::Zero()};  ///< of the rest of the Lagrangian
        /** Right side of the system, with a barrier of zero, plus gradient of the Lagrangian. */
        PairVector shift{PairVector::Zero()};
        PairVector barrierSlope{PairVector::Zero()};  ///< by how much a barrier (mu) raises the right side
        /** What the curvature of the ways at the two ends (see IntervalModel) is multiplied with. @{ */
        Eigen::Vector3d wayAtBegin{Eigen::Vector3d::Zero()},  ///< where the interval begins
            wayAtEnd{Eigen::Vector3d::Zero()};                ///< the same where it ends
        /** @} */

        /** \brief Adds to an entry of the Hessian beside the diagonal and to its mirror image. */
        void couple(int i, int j, double value)
        {
            hessian(i, j) += value;
            hessian(j, i) += value;
        }
    };

    /** \brief What the rows at some poses of an interval demand, summed up.

        By begin, way at the begin, end and way at the end of x, of y and of yaw: poses within the interval are linear
        in these. */
    struct SpanTerms
    {
        Eigen::Matrix<double, 12, 12> hessian{Eigen::Matrix<double, 12, 12>::Zero()};  ///< of the rows
        Eigen::Matrix<double, 12, 1> gradient{Eigen::Matrix<double, 12, 1>::Zero()};  ///< of the rows in the Lagrangian
        Eigen::Matrix<double, 12, 1> shift{Eigen::Matrix<double, 12, 1>::Zero()};  ///< what they add to the right side
        Eigen::Matrix<double, 12, 1> barrierSlope{Eigen::Matrix<double, 12, 1>::Zero()};  ///< see IntervalTerms
        Eigen::Matrix<double, 12, 1> cost{Eigen::Matrix<double, 12, 1>::Zero()};          ///< gradient of the cost

        /** \brief Adds derivatives by the pose at hermiteWeights(). Of the Hessian only the blocks on and below the
            diagonal are added to: see complete(). */
        void add(const Eigen::Vector4d &weights, const Eigen::Matrix3d &poseHessian,
                 const Eigen::Vector3d &poseGradient, const Eigen::Vector3d &poseShift,
                 const Eigen::Vector3d &poseBarrierSlope, const Eigen::Vector3d &poseCost);

        /** \brief Fills the blocks of the Hessian above the diagonal. */
        void complete();
    };

    /** \brief An interval between two nodes: where it leads, what it costs, and all first and second derivatives.

        The *way* of an end is d h v (cos yaw, sin yaw, tan(steering) / wheelbase): how far the interval, of duration h
        in direction d, would lead at the rates of that end. All that is not linear is in the ways of the ends and of
        the middle. */
    class IntervalModel
    {
    public:
        /** \brief \param direction 1, -1, or 0 at a standstill */
        IntervalModel(int direction, double wheelbase, const NodeVector &begin, const NodeVector &end);

        /** \brief The same, with the angles of the nodes at hand. */
        IntervalModel(int direction, double wheelbase, const NodeVector &begin, const NodeVector &end,
                      const NodeAngles &atBegin, const NodeAngles &atEnd);

        /** \brief How far x, y and yaw of the end are from where the begin leads: 0 when the interval is driven. */
        Eigen::Vector3d gaps() const;

        /** \brief Derivatives of gaps(). */
        GapRows gapRows() const;

        /** \brief Adds the second derivatives of \e prices . gaps(), those of the ways at the ends excepted. */
        void addGapCurvature(const Eigen::Vector3d &prices, IntervalTerms &terms) const;

        /** \brief x, y and yaw within the interval, by hermiteWeights(). */
        Eigen::Vector3d poseAt(const Eigen::Vector4d &weights) const;

        /** \brief The change of poseAt() when the nodes change by \e step. */
        Eigen::Vector3d poseStep(const Eigen::Vector4d &weights, const PairVector &step) const;

        /** \brief Adds what rows demand. */
        void addSpan(const SpanTerms &span, IntervalTerms &terms) const;

        /** \brief Adds the second derivatives of the ways at the ends, as often as \e terms say. To be called last. */
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
