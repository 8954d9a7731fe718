// The heuristics, and their registry.

#include "ompl_improved_astar/search/Heuristic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        /** Least value over the targets. */
        template <class Value>
        double least(const std::vector<Pose> &targets, const Value &value)
        {
            double result = std::numeric_limits<double>::infinity();
            for (const Pose &target : targets)
                result = std::min(result, value(target));
            return result;
        }

        /** Length of the shortest curve of bounded curvature: never more than that of any path that can be driven. */
        class CurveHeuristic final : public Heuristic
        {
        public:
            void begin(const SearchContext &context, Side side, const std::vector<Pose> &targets) override
            {
                curves_ = ReedsShepp(context.car.turningRadius,
                                     context.car.forwardOnly ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
                isBackward_ = side == Side::Goal;
                targets_ = targets;
            }

            double estimate(const Pose &pose) override
            {
                return lowerBound(pose);
            }

            double lowerBound(const Pose &pose) override
            {
                return least(targets_, [&](const Pose &target)
                             { return isBackward_ ? curves_.distance(target, pose) : curves_.distance(pose, target); });
            }

        private:
            ReedsShepp curves_{1.0};
            bool isBackward_{false};  // curves from a target to the pose, not the other way
            std::vector<Pose> targets_;
        };

        /** Distances between positions by some metric, of which the straight one is a bound (paper, "Heuristic
           Evaluation Function" and "Heuristic Function Optimization"). */
        template <double (*metric)(double dx, double dy)>
        class PositionHeuristic final : public Heuristic
        {
        public:
            void begin(const SearchContext & /*context*/, Side /*side*/, const std::vector<Pose> &targets) override
            {
                targets_ = aims_ = targets;
            }

            void aim(const Pose &pose) override
            {
                aims_.assign(1, pose);
            }

            double estimate(const Pose &pose) override
            {
                return least(
                    aims_, [&](const Pose &aim) { return metric(std::abs(pose.x - aim.x), std::abs(pose.y - aim.y)); });
            }

            double lowerBound(const Pose &pose) override
            {
                return least(targets_, [&](const Pose &target) { return positionDistance(pose, target); });
            }

        private:
            std::vector<Pose> targets_, aims_;
        };

        double straight(double dx, double dy)
        {
            return std::hypot(dx, dy);
        }

        /** In steps to eight neighbours. */
        double octile(double dx, double dy)
        {
            return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
        }

        /** In steps to four neighbours: more than diagonal steps need, so that longer paths may be found with it. */
        double manhattan(double dx, double dy)
        {
            return dx + dy;
        }
    }  // namespace

    Registry<Heuristic> &heuristics()
    {
        static Registry<Heuristic> registry("heuristic", {
                                                             {"curves", newPart<CurveHeuristic>},
                                                             {"straight", newPart<PositionHeuristic<straight>>},
                                                             {"octile", newPart<PositionHeuristic<octile>>},
                                                             {"manhattan", newPart<PositionHeuristic<manhattan>>},
                                                         });
        return registry;
    }
}  // namespace parking::search
