#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The hard constraints on one quantity over a horizon: a box, and a bound on its change per step. */
    struct ChannelLimits
    {
        double low{0.0};     ///< least value, in the quantity's unit: m/s or radians
        double high{0.0};    ///< greatest value, likewise
        double change{0.0};  ///< per step, either sign
        double last{0.0};    ///< the value before the horizon; outside of the box it may return by \e change per step
    };

    /** \brief The constraints on the unknowns of a horizon, which take turns: speed after step 1, steering angle after
        step 1, speed after step 2, and so on. */
    using HorizonLimits = std::array<ChannelLimits, 2>;

    /** \brief Moves \e unknowns within \e limits, from the first step to the last. */
    void cutToLimits(const HorizonLimits &limits, Eigen::VectorXd &unknowns);

    /** \brief Which constraints hold a feasible point against the gradient, and the directions that remain.

        A general least-squares solver knows boxes at most, and steps across active ones by cutting its step, which
        stalls where many are active: on every full-lock arc. With the active constraints taken out of the unknowns what
        is left is unconstrained nearby. Values tied to each other by an active bound on their change move together;
        they share a direction. */
    class WorkingSet
    {
    public:
        /** \brief Chooses the constraints active at \e unknowns whose multipliers have the sign of a minimum.

            \param gradient of the cost at \e unknowns */
        WorkingSet(const HorizonLimits &limits, const Eigen::VectorXd &unknowns, const Eigen::VectorXd &gradient);

        /** \brief Number of free directions. */
        Eigen::Index freedom() const
        {
            return freedom_;
        }

        /** \brief \e base moved by \e step in the free directions. */
        Eigen::VectorXd expand(const Eigen::VectorXd &base, const double *step) const;

        /** \brief Derivatives by the free directions: sums of the columns of \e full that move together.

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

        /** \brief Do both hold the same constraints? Then the same directions are free. */
        bool operator==(const WorkingSet &other) const
        {
            return direction_ == other.direction_;
        }

    private:
        std::vector<int> direction_;  // per unknown: the free direction that it belongs to, -1 if it is held
        Eigen::Index freedom_{0};
    };
}  // namespace parking
