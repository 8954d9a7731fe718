#include "path_tracking/control/MpcWorkingSet.h"

#include <algorithm>
#include <cstddef>

namespace parking
{
    namespace
    {
        /** Share of the maximum change per step: closer values are at the limit. With a far smaller share, steps would
            stall just before limits. */
        constexpr double AT_LIMIT = 1e-3;

        /** -1 near the lower limit, 1 near the upper, 0 between. */
        int side(double value, double low, double high, double near)
        {
            return value >= high - near ? 1 : value <= low + near ? -1 : 0;
        }

        /** One quantity over the horizon with its active constraints. */
        class Chain
        {
        public:
            Chain(const ChannelLimits &limits, const Eigen::VectorXd &unknowns, const Eigen::VectorXd &gradient,
                  Eigen::Index offset)
            {
                const double near = AT_LIMIT * limits.change;
                double before = limits.last;
                for (Eigen::Index i = offset; i < unknowns.size(); i += 2)
                {
                    gradient_.push_back(gradient[i]);
                    bound_.push_back(side(unknowns[i], limits.low, limits.high, near));
                    link_.push_back(side(unknowns[i] - before, -limits.change, limits.change, near));
                    before = unknowns[i];
                }
                // Every round drops at least one constraint or is the last.
                for (bool dropped = true; dropped;)
                {
                    dropped = false;
                    for (std::size_t begin = 0; begin < size(); begin = stretchEnd(begin))
                        dropped = release(begin, stretchEnd(begin)) || dropped;
                }
            }

            std::size_t size() const
            {
                return gradient_.size();
            }

            /** End of the stretch of linked values that begins at \e begin. */
            std::size_t stretchEnd(std::size_t begin) const
            {
                std::size_t end = begin + 1;
                while (end < size() && link_[end] != 0)
                    ++end;
                return end;
            }

            /** Whether the values from \e begin to \e end cannot move, not even together. */
            bool held(std::size_t begin, std::size_t end) const
            {
                bool result = link_[begin] != 0;
                for (std::size_t k = begin; k < end; ++k)
                    result = result || bound_[k] != 0;
                return result;
            }

        private:
            double sum(std::size_t from, std::size_t to) const
            {
                double total = 0.0;
                for (std::size_t k = from; k < to; ++k)
                    total += gradient_[k];
                return total;
            }

            /** Drops the constraint with the multiplier of the steepest decrease of the cost. Only one is dropped at a
                time, because the other multipliers change with it. \return whether there was one */
            bool release(std::size_t begin, std::size_t end)
            {
                const bool anchored = link_[begin] != 0;  // only the first: coupled to the value before the horizon
                std::size_t support = end;                // the value at its box bound; one fixes the stretch
                for (std::size_t k = begin; k < end && !anchored && support == end; ++k)
                    if (bound_[k] != 0)
                        support = k;
                const double total = sum(begin, end);
                const double share = !anchored && support == end ? total / static_cast<double>(end - begin) : 0.0;
                double loudest = 0.0;
                int *worst = nullptr;
                const auto weigh = [&](int &constraint, double force)
                {
                    if (constraint * force > loudest)
                    {
                        loudest = constraint * force;
                        worst = &constraint;
                    }
                };
                for (std::size_t k = anchored ? begin : begin + 1; k < end; ++k)
                {
                    // The part of the stretch that the link couples to its support, and its inner side.
                    const bool tail = anchored || support == end || k > support;
                    weigh(link_[k], tail ? sum(k, end) - share * static_cast<double>(end - k) : -sum(begin, k));
                }
                if (support != end)
                    weigh(bound_[support], total);
                if (worst != nullptr)
                    *worst = 0;
                return worst != nullptr;
            }

            std::vector<double> gradient_;
            std::vector<int> bound_;  // side of the box
            std::vector<int> link_;   // side of the bound on the change from the step before
        };
    }  // namespace

    void cutToLimits(const HorizonLimits &limits, Eigen::VectorXd &unknowns)
    {
        for (Eigen::Index channel = 0; channel < 2; ++channel)
        {
            const ChannelLimits &limit = limits[static_cast<std::size_t>(channel)];
            double before = limit.last;
            for (Eigen::Index i = channel; i < unknowns.size(); i += 2)
            {
                const double boxed = std::clamp(unknowns[i], limit.low, limit.high);
                unknowns[i] = std::clamp(boxed, before - limit.change, before + limit.change);
                before = unknowns[i];
            }
        }
    }

    WorkingSet::WorkingSet(const HorizonLimits &limits, const Eigen::VectorXd &unknowns,
                           const Eigen::VectorXd &gradient)
      : direction_(static_cast<std::size_t>(unknowns.size()), -1)
    {
        int next = 0;
        for (std::size_t channel = 0; channel < 2; ++channel)
        {
            const Chain chain(limits[channel], unknowns, gradient, static_cast<Eigen::Index>(channel));
            for (std::size_t begin = 0; begin < chain.size();)
            {
                const std::size_t end = chain.stretchEnd(begin);
                if (!chain.held(begin, end))
                {
                    for (std::size_t k = begin; k < end; ++k)
                        direction_[2 * k + channel] = next;
                    ++next;
                }
                begin = end;
            }
        }
        freedom_ = next;
    }

    Eigen::VectorXd WorkingSet::expand(const Eigen::VectorXd &base, const double *step) const
    {
        Eigen::VectorXd result = base;
        for (std::size_t i = 0; i < direction_.size(); ++i)
            if (direction_[i] >= 0)
                result[static_cast<Eigen::Index>(i)] += step[direction_[i]];
        return result;
    }
}  // namespace parking
