#pragma once

#include "path_tracking/trajectory/program/IntervalModel.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Multipliers and slacks of an interior point method for a MotionProgram. */
    struct MotionDuals
    {
        std::vector<Eigen::Vector4d> joints;  ///< multipliers y of the joints
        std::vector<double> prices;           ///< multipliers z of the inequalities
        std::vector<double> slacks;           ///< slacks s, the required values of the inequalities
    };

    /** \brief The functions of a MotionProblem, their derivatives, and the linear systems of an interior point method.

        It minimises the cost f(n) over the nodes n, subject to the joints c(n) = 0 and the inequalities g(n) >= 0. Each
        interval has four joints: x, y, yaw, and equality of its duration with the next one. All derivatives are
        exact. */
    class MotionProgram
    {
    public:
        /** \brief Takes over a problem and creates the inequalities of its limits. */
        explicit MotionProgram(MotionProblem problem);

        /** \brief The problem as given. */
        const MotionProblem &problem() const
        {
            return problem_;
        }

        /** \brief Number of intervals, one less than the number of nodes. */
        std::size_t intervals() const
        {
            return problem_.directions.size();
        }

        /** \brief Number of inequalities: limits first, then the rows of the problem. */
        std::size_t inequalities() const
        {
            return limits_.size() + problem_.rows.size();
        }

        /** \brief Evaluates f, c and g at \e nodes, and prepares linearize(). \return f */
        double evaluate(const std::vector<NodeVector> &nodes, std::vector<Eigen::Vector4d> &joints,
                        std::vector<double> &values);

        /** \brief Linearises the program at the nodes evaluated last. Afterwards system(), right(), the gradients and
            apply() are valid until the next evaluation.

            The system is that of Newton's method for the barrier problem, with inequalities and joints eliminated: W +
            G^T (z / s) G + A^T A / \e softness. */
        void linearize(const MotionDuals &duals, double softness);

        /** \brief The matrix of the linearisation, for factorisation by the caller. */
        BlockTridiagonal &system()
        {
            return system_;
        }

        /** \brief The right side of the linear system at \e barrier (mu), one vector per node. */
        std::vector<NodeVector> right(double barrier) const;

        /** \brief The gradient of the Lagrangian f + y c - z g. */
        const std::vector<NodeVector> &gradient() const
        {
            return gradient_;
        }

        /** \brief The gradient of f. */
        const std::vector<NodeVector> &costGradient() const
        {
            return costGradient_;
        }

        /** \brief Computes A times \e step and G times \e step, with the Jacobians of the linearisation. */
        void apply(const std::vector<NodeVector> &step, std::vector<Eigen::Vector4d> &joints,
                   std::vector<double> &values) const;

    private:
        using JointRows = Eigen::Matrix<double, 4, PAIR_SIZE>;

        /** Inequality: coefficient . (three entries of the two nodes of an interval) + constant >= 0. */
        struct Limit
        {
            std::array<int, 3> entry;
            std::array<double, 3> coefficient;
            double constant;

            template <class Pair>
            double slope(const Pair &pair) const
            {
                return coefficient[0] * pair[entry[0]] + coefficient[1] * pair[entry[1]] +
                       coefficient[2] * pair[entry[2]];
            }
        };

        /** Proximity cost per metre at a row, and its slope. */
        struct Nearness
        {
            double price{0.0}, growth{0.0};
        };

        void addLimits(std::size_t interval);
        void addNodeLimits(std::size_t node, int first);
        Eigen::Vector4d jointsOf(const IntervalModel &model, const std::vector<NodeVector> &nodes,
                                 std::size_t interval) const;
        void addJoints(std::size_t interval, const MotionDuals &duals, double softness, IntervalTerms &terms);
        void addLimitTerms(std::size_t interval, const MotionDuals &duals, IntervalTerms &terms) const;
        void addRowTerms(std::size_t interval, const MotionDuals &duals, IntervalTerms &terms);
        Nearness nearnessOf(const MotionCheckpoint &point, double value) const;
        void scatter(std::size_t interval, const IntervalTerms &terms);
        void applyFixed();

        MotionProblem problem_;
        std::vector<Limit> limits_;
        std::vector<std::size_t> firstLimit_;       // per interval and one more
        std::vector<std::size_t> firstCheckpoint_;  // per interval and one more
        std::vector<Eigen::Vector4d> weights_;      // per checkpoint: of the Hermite polynomial

        /** Pose of the car at a checkpoint. */
        struct CheckedPose
        {
            Eigen::Vector3d pose;
            double cosine, sine;
        };

        // What was evaluated last.
        std::vector<NodeAngles> angles_;
        std::vector<IntervalModel> models_;
        std::vector<Eigen::Vector4d> joints_;
        std::vector<double> values_;
        std::vector<CheckedPose> poses_;  // per checkpoint

        // The linearisation.
        std::vector<JointRows> jointRows_;
        std::vector<Eigen::Vector3d> rowGradients_;
        BlockTridiagonal system_;
        std::vector<NodeVector> right_, barrierSlope_;  // the right side is the first plus mu times the second
        std::vector<NodeVector> gradient_, costGradient_;
    };
}  // namespace parking
