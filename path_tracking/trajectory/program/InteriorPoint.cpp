#include "path_tracking/trajectory/program/InteriorPoint.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Softness of the joints in the linear systems. */
        constexpr double SOFTNESS = 1e-8;
        /** Minimum share of a slack or price that remains after a step. */
        constexpr double LEFT_OVER = 0.005;

        /** Length of a step below which the next direction is damped; first, maximum and negligible damping. The
            damping decays slowly, because switching it off at once made every second step short. */
        constexpr double SHORT_STEP = 0.1, FIRST_DAMPING = 0.02, MAX_DAMPING = 1.0, NO_DAMPING = 0.005;
        /** The problem of a barrier is solved if its cost changes by less than this share several times in a row, and
            joints and inequalities are satisfied to this accuracy. Stricter limits would take twice the time. */
        constexpr double SMALL_CHANGE = 1e-4, NEARLY = 1e-4;
        constexpr int ENOUGH_SMALL_CHANGES = 3;
        /** Maximum gap of a joint in a feasible solution, in metres or radians, and of all joints in total. A motion
            misses its goal by their sum. */
        constexpr double FEASIBLE_GAP = 1e-5, FEASIBLE_SUM = 5e-4;
        /** Maximum gap of a joint in an optimal solution, and maximum violation of inequalities. */
        constexpr double OPTIMAL_GAP = 1e-6, LIMIT_TOLERANCE = 1e-7;
        /** Attempts to make the system positive definite. */
        constexpr int MAX_SHIFTS = 40;

        using Nodes = std::vector<NodeVector>;

        double largest(const Nodes &nodes)
        {
            double result = 0.0;
            for (const NodeVector &node : nodes)
                result = std::max(result, node.lpNorm<Eigen::Infinity>());
            return result;
        }

        double inner(const Nodes &a, const Nodes &b)
        {
            double sum = 0.0;
            for (std::size_t k = 0; k < a.size(); ++k)
                sum += a[k].dot(b[k]);
            return sum;
        }

        /** The state of the iteration. */
        class Search
        {
        public:
            Search(MotionProgram &program, const InteriorPointOptions &options)
              : program_(program),
                options_(options),
                barrier_(options.firstBarrier),
                nodes_(program.problem().nodes)
            {
                cost_ = program_.evaluate(nodes_, joints_, values_);
                duals_.joints.assign(joints_.size(), Eigen::Vector4d::Zero());
                duals_.slacks.resize(values_.size());
                duals_.prices.resize(values_.size());
                const double least = std::sqrt(barrier_) * 0.15;
                for (std::size_t i = 0; i < values_.size(); ++i)
                {
                    duals_.slacks[i] = std::max(values_[i], least);
                    duals_.prices[i] = barrier_ / duals_.slacks[i];
                }
            }

            InteriorPointResult run(const std::function<bool()> &interrupted)
            {
                InteriorPointResult result;
                std::size_t stuck = 0;
                for (; result.iterations < options_.maxIterations; ++result.iterations)
                {
                    if (interrupted && interrupted())
                    {
                        result.status = InteriorPointStatus::Interrupted;
                        break;
                    }
                    program_.linearize(duals_, SOFTNESS);
                    if (lowerBarrier())
                    {
                        result.status = InteriorPointStatus::Converged;
                        break;
                    }
                    if (!direction())
                        break;
                    stuck = advance() ? 0 : stuck + 1;
                    if (stuck > 6)
                        break;
                }
                result.nodes = nodes_;
                result.cost = cost_;
                if (result.status == InteriorPointStatus::Infeasible && gap() <= feasibleGap() &&
                    violation() <= LIMIT_TOLERANCE)
                    result.status = InteriorPointStatus::Feasible;
                return result;
            }

        private:
            double gap() const
            {
                double widest = 0.0;
                for (const auto &joint : joints_)
                    widest = std::max(widest, joint.lpNorm<Eigen::Infinity>());
                return widest;
            }

            double feasibleGap() const
            {
                return std::min(FEASIBLE_GAP, FEASIBLE_SUM / static_cast<double>(joints_.size()));
            }

            double violation() const
            {
                double most = 0.0;
                for (const double value : values_)
                    most = std::max(most, -value);
                return most;
            }

            /** Residual of the barrier problem with \e barrier. */
            double error(double barrier) const
            {
                double sum = 0.0;
                for (const double price : duals_.prices)
                    sum += price;
                for (const auto &joint : duals_.joints)
                    sum += joint.lpNorm<1>();
                const double count = static_cast<double>(duals_.prices.size() + 4 * duals_.joints.size());
                const double scale = std::max(1.0, sum / count);
                double worst = largest(program_.gradient()) / scale;
                for (std::size_t i = 0; i < values_.size(); ++i)
                {
                    worst = std::max(worst, std::abs(duals_.prices[i] * duals_.slacks[i] - barrier) / scale);
                    worst = std::max(worst, std::abs(values_[i] - duals_.slacks[i]));
                }
                return std::max(worst, gap());
            }

            /** Counts consecutive steps with small changes of the cost. */
            bool hasSettled()
            {
                const bool isSmall = std::abs(lastCost_ - cost_) < SMALL_CHANGE * std::abs(cost_);
                smallChanges_ = isSmall && gap() <= NEARLY && violation() <= NEARLY ? smallChanges_ + 1 : 0;
                lastCost_ = cost_;
                return smallChanges_ >= ENOUGH_SMALL_CHANGES;
            }

            /** Lowers the barrier while its problem is solved. \return whether the last one is solved */
            bool lowerBarrier()
            {
                for (bool settled = hasSettled(); settled || error(barrier_) <= 10.0 * barrier_; settled = false)
                {
                    if (barrier_ <= options_.lastBarrier)
                    {
                        if (gap() <= (settled ? feasibleGap() : OPTIMAL_GAP) && violation() <= LIMIT_TOLERANCE)
                            return true;
                        break;
                    }
                    smallChanges_ = 0;
                    barrier_ = std::max(options_.lastBarrier, 0.2 * barrier_);
                    penalty_ = 1.0;
                }
                return false;
            }

            /** Computes Newton's direction. \return false if there is none */
            bool direction()
            {
                double shift = damping_;
                for (int attempt = 0; !program_.system().factorize(shift); ++attempt)
                {
                    if (attempt == MAX_SHIFTS)
                        return false;
                    shift = attempt > 0 ? shift * (lastShift_ > 0.0 ? 4.0 : 20.0)
                                        : std::max({1e-6, lastShift_ / 3.0, 4.0 * damping_});
                }
                lastShift_ = shift > 0.0 ? shift : lastShift_;
                step_ = program_.right(barrier_);
                program_.system().solve(step_);
                program_.apply(step_, jointStep_, slackStep_);
                priceStep_.resize(values_.size());
                for (std::size_t k = 0; k < joints_.size(); ++k)
                    jointStep_[k] = (jointStep_[k] + joints_[k]) / SOFTNESS;
                for (std::size_t i = 0; i < values_.size(); ++i)
                {
                    slackStep_[i] += values_[i] - duals_.slacks[i];
                    priceStep_[i] = barrier_ / duals_.slacks[i] - duals_.prices[i] -
                                    duals_.prices[i] / duals_.slacks[i] * slackStep_[i];
                }
                return true;
            }

            double longest(const std::vector<double> &from, const std::vector<double> &step) const
            {
                double length = 1.0;
                for (std::size_t i = 0; i < from.size(); ++i)
                    if (step[i] < 0.0)
                        length = std::min(length, -(1.0 - LEFT_OVER) * from[i] / step[i]);
                return length;
            }

            double infeasibility(const std::vector<Eigen::Vector4d> &joints, const std::vector<double> &values,
                                 const std::vector<double> &slacks) const
            {
                double sum = 0.0;
                for (const auto &joint : joints)
                    sum += joint.lpNorm<1>();
                for (std::size_t i = 0; i < values.size(); ++i)
                    sum += std::abs(values[i] - slacks[i]);
                return sum;
            }

            double barrierCost(double cost, const std::vector<double> &slacks) const
            {
                // A product of a few values neither under- nor overflows, and needs only one logarithm.
                double logarithms = 0.0, product = 1.0;
                for (const double slack : slacks)
                {
                    product *= slack;
                    if (product < 1e-200 || product > 1e200)
                    {
                        logarithms += std::log(product);
                        product = 1.0;
                    }
                }
                return cost - barrier_ * (logarithms + std::log(product));
            }

            /** Moves along the direction while that decreases the penalty function. \return whether it moved */
            bool advance()
            {
                const double now = infeasibility(joints_, values_, duals_.slacks);
                double slope = inner(program_.costGradient(), step_);
                for (std::size_t i = 0; i < values_.size(); ++i)
                    slope -= barrier_ * slackStep_[i] / duals_.slacks[i];
                if (now > 0.0)
                    penalty_ = std::max(penalty_, slope / (0.9 * now) + 1e-3);
                const double descent = slope - penalty_ * now;
                const double merit = barrierCost(cost_, duals_.slacks) + penalty_ * now;
                double length = longest(duals_.slacks, slackStep_);
                Nodes nodes(nodes_.size());
                std::vector<Eigen::Vector4d> joints;
                std::vector<double> values, slacks(values_.size());
                bool found = false;
                double cost = 0.0;
                for (int attempt = 0; attempt < 12 && !found; ++attempt)
                {
                    if (attempt > 0)
                        length *= 0.5;
                    for (std::size_t k = 0; k < nodes.size(); ++k)
                        nodes[k] = nodes_[k] + length * step_[k];
                    cost = program_.evaluate(nodes, joints, values);
                    for (std::size_t i = 0; i < values.size(); ++i)
                        slacks[i] = std::max(values[i], duals_.slacks[i] + length * slackStep_[i]);
                    const double then = barrierCost(cost, slacks) + penalty_ * infeasibility(joints, values, slacks);
                    found = then <= merit + 1e-4 * length * std::min(0.0, descent) + 1e-10 * std::abs(merit);
                }
                const double priceLength = longest(duals_.prices, priceStep_);
                nodes_.swap(nodes);
                joints_.swap(joints);
                values_.swap(values);
                duals_.slacks.swap(slacks);
                cost_ = cost;
                for (std::size_t k = 0; k < joints_.size(); ++k)
                    duals_.joints[k] += length * jointStep_[k];
                for (std::size_t i = 0; i < values_.size(); ++i)
                {
                    // Prices stay close to those of the barrier (I. Wachter and L. Biegler, 2006, equation 16).
                    const double own = barrier_ / duals_.slacks[i];
                    duals_.prices[i] =
                        std::clamp(duals_.prices[i] + priceLength * priceStep_[i], 1e-10 * own, 1e10 * own);
                }
                lastShift_ = found && length > 0.5 ? lastShift_ / 3.0 : lastShift_;
                // Short steps indicate a direction beyond the range of the linearisation.
                if (length < SHORT_STEP)
                    damping_ = std::min(MAX_DAMPING, std::max(FIRST_DAMPING, 4.0 * damping_));
                else if (length > 0.5)
                    damping_ = damping_ > NO_DAMPING ? 0.25 * damping_ : 0.0;
                return found;
            }

            MotionProgram &program_;
            InteriorPointOptions options_;
            double barrier_;
            double penalty_{1.0};
            double lastShift_{0.0};
            double damping_{0.0};
            double lastCost_{0.0};
            int smallChanges_{0};
            double cost_{0.0};
            Nodes nodes_, step_;
            MotionDuals duals_;
            std::vector<Eigen::Vector4d> joints_, jointStep_;
            std::vector<double> values_, slackStep_, priceStep_;
        };
    }  // namespace

    InteriorPointResult solveMotion(MotionProgram &program, const InteriorPointOptions &options,
                                    const std::function<bool()> &interrupted)
    {
        return Search(program, options).run(interrupted);
    }
}  // namespace parking
