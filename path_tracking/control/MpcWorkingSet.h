#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Hard constraints on one quantity over a horizon: a box, and a bound on its change per step. */
    struct ChannelLimits
    {
        double low{0.0};     ///< minimum value, in m/s or radians
        double high{0.0};    ///< maximum value, in m/s or radians
        double change{0.0};  ///< maximum change per step, either sign
        double last{0.0};    ///< value before the horizon; outside the box it may return by \e change per step
    };

    /** \brief Constraints on the unknowns of a horizon, which alternate: speed after step 1, steering angle after step
        1, speed after step 2, and so on. */
    using HorizonLimits = std::array<ChannelLimits, 2>;

    /** \brief Clamps \e unknowns to \e limits, from the first step to the last. */
    void cutToLimits(const HorizonLimits &limits, Eigen::VectorXd &unknowns);

    /** \brief The constraints active at a feasible point, and the directions that remain free.

        A general least-squares solver handles boxes at most. It clamps steps that cross active ones, which stalls if
        many are active: on every full-lock arc. Without the active constraints the remaining problem is locally
        unconstrained. Values coupled by an active bound on their change move together and share a direction. */
    class WorkingSet
    {
    public:
        /** \brief Selects the active constraints at \e unknowns whose multipliers have the sign of a minimum.

            \param gradient of the cost at \e unknowns */
        WorkingSet(const HorizonLimits &limits, const Eigen::VectorXd &unknowns, const Eigen::VectorXd &gradient);

        /** \brief Number of free directions. */
        Eigen::Index freedom() const
        {
            return freedom_;
        }

        /** \brief Returns \e base moved by \e step in the free directions. */
        Eigen::VectorXd expand(const Eigen::VectorXd &base, const double *step) const;

        /** \brief Computes derivatives by the free directions: sums of the columns of \e full that move together.

            \param reduced row-major, full.rows() by freedom() */
        template <typename Matrix>
        void reduce(const Matrix &full, double *reduced) const
        {
            using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            Eigen::Map<RowMajor> target(reduced, full.rows(), freedom_);
            for (Eigen::Index row = 0; row < full.rows(); ++row)
            {
                target.row(row).setZero();
                for (Eigen::Index column = 0; column < full.cols(); ++column)
                    if (direction_[static_cast<std::size_t>(column)] >= 0)
                        target(row, direction_[static_cast<std::size_t>(column)]) += full(row, column);
            }
        }

        /** \brief Whether both have the same active constraints, and so the same free directions. */
        bool operator==(const WorkingSet &other) const
        {
            return direction_ == other.direction_;
        }

    private:
        std::vector<int> direction_;  // per unknown: its free direction, -1 if constrained
        Eigen::Index freedom_{0};
    };
}  // namespace parking
