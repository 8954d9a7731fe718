#include "automatic_parking/ParkingPlanner.h"

#include "automatic_parking/PlanningTries.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace parking
{
    namespace
    {
        using namespace planning;

        constexpr double GAP_UNIT = 0.25;  // metres, of PlanningParameters::gapWorth

        std::string centimetres(double metres)
        {
            return formatNumber(std::round(100.0 * metres)) + " cm";
        }

        /** The making of one plan. */
        class Planning
        {
        public:
            Planning(const Scenario &scenario, const PlanningParameters &parameters, const ParkingWorld &world)
              : scenario_(scenario),
                parameters_(parameters),
                world_(world),
                inStretches_(parameters.wayIn == WayIn::InStretches)
            {
            }

            ParkingPlan plan()
            {
                if (!checkEnds())
                    return std::move(plan_);
                Tries tries(scenario_, parameters_, world_, startRoom_, false);
                Candidate best = climb(tries);
                plan_.loadingTime = tries.loadingTime();
                plan_.planningTime = tries.seconds() - plan_.loadingTime;
                plan_.tries = tries.count();
                plan_.search = tries.statistics();
                if (!best.found())
                {
                    fail(ParkingStatus::NoPath, whyNot(tries));
                    plan_.manoeuvre = tries.verdict().value_or(ReverseParkingResult{});
                    return std::move(plan_);
                }
                plan_.found = true;
                plan_.cost = best.cost;
                plan_.goal = best.goal;
                plan_.approach = std::move(best.approach);
                plan_.manoeuvre = std::move(best.manoeuvre);
                plan_.arcs = std::move(best.arcs);
                plan_.gap = best.rung.gap;
                plan_.turningRadius = best.rung.radius;
                smooth(*best.checker);
                plan_.clearance = world_.clearance(plan_.path);
                plan_.message =
                    (plan_.manoeuvre.path.pieces.empty() ? "planned all the way" : "approach and manoeuvre") +
                    std::string(", at least ") + centimetres(plan_.clearance) + " from obstacles";
                return std::move(plan_);
            }

            ReverseParkingResult wayIn()
            {
                Tries tries(scenario_, parameters_, world_, 0.0, true);
                Candidate best = climb(tries);
                return best.found() ? std::move(best.manoeuvre) : tries.verdict().value_or(ReverseParkingResult{});
            }

        private:
            void fail(ParkingStatus failure, const std::string &message)
            {
                plan_.failure = failure;
                plan_.message = message;
            }

            /** Looks at start and goals; false when the plan is finished with that. */
            bool checkEnds()
            {
                const FootprintChecker &body = world_.footprint();
                if (!body.isFree(scenario_.start))
                {
                    fail(ParkingStatus::InvalidStart, "the car is in collision, or outside, where it starts");
                    return false;
                }
                startRoom_ = body.exactClearance(scenario_.start);
                double goalRoom = -1.0;
                for (const Pose &goal : scenario_.goals)
                    if (body.isFree(goal))
                    {
                        goalRoom = std::max(goalRoom, body.exactClearance(goal));
                        if (isSamePose(scenario_.start, goal, SAME_POSE))
                            return stay(goal);
                    }
                if (goalRoom < 0.0)
                    fail(ParkingStatus::InvalidGoal, "the car is in collision, or outside, at the goal");
                else if (inStretches_ && startRoom_ <= PlanningParameters::LEAST_GAP_IN_STRETCHES)
                    fail(ParkingStatus::InvalidStart, "the start is nearer to an obstacle than the least gap of 4 mm");
                else
                {
                    mostGap_ = std::min(startRoom_, goalRoom);
                    return true;
                }
                return false;
            }

            /** The car stands where it shall stand. */
            bool stay(const Pose &goal)
            {
                plan_.found = true;
                plan_.message = "the car stands at the goal already";
                plan_.goal = goal;
                plan_.approach = plan_.arcs = plan_.path = Path{scenario_.start, {}};
                plan_.clearance = startRoom_;
                return false;
            }

            std::string whyNot(const Tries &tries) const
            {
                if (tries.verdict() && inStretches_)
                    return tries.verdict()->message;
                return tries.isOver() ? "no path was found within " + formatNumber(parameters_.timeLimit) + " s"
                                      : "there is no path for this car";
            }

            /** All tries, in their order. */
            std::vector<Rung> ladder() const
            {
                const std::vector<double> &gaps = parameters_.gaps;
                const double smallest = scenario_.vehicle.minTurningRadius(), factor = parameters_.radiusFactor;
                std::vector<Rung> rungs;
                if (inStretches_)
                {
                    // The gap, and with it the reserve of steering, is given up step by step.
                    const auto last = static_cast<double>(gaps.size() - 1);
                    for (std::size_t i = 0; i < gaps.size(); ++i)
                    {
                        const double kept = gaps.size() > 1 ? (last - static_cast<double>(i)) / last : 1.0;
                        rungs.push_back(
                            rungInStretches(gaps[i], (1.0 + kept * (factor - 1.0)) * smallest, parameters_.tuning));
                    }
                    return rungs;
                }
                for (const double each : factor > 1.0 ? std::vector<double>{factor, 1.0} : std::vector<double>{1.0})
                    for (const double gap : gaps)
                        if (gap == 0.0 || gap < mostGap_)
                            rungs.push_back({gap, each * smallest, gap, gap});
                return rungs;
            }

            /** The best of all tries. */
            Candidate climb(Tries &tries) const
            {
                const std::vector<Rung> rungs = ladder();
                Candidate best;
                for (std::size_t i = 0; i < rungs.size(); ++i)
                {
                    if (tries.isOver() || !isWorthTrying(rungs[i], best))
                        break;
                    const bool last = !best.found() && i + 1 == rungs.size();
                    if (tries.isLate() && !last)
                        continue;
                    Candidate next = tries.find(rungs[i], last);
                    if (isBetter(next, best))
                        best = std::move(next);
                }
                return best;
            }

            bool isWorthTrying(const Rung &rung, const Candidate &best) const
            {
                if (!best.found())
                    return true;
                if (inStretches_)
                    return best.stretches > parameters_.tuning.manyStretches;
                // Nothing that a smaller gap allows can be shorter than the bare curve.
                return rung.radius == best.rung.radius && leastLength(rung.radius) + worth(rung.gap) < price(best);
            }

            bool isBetter(const Candidate &next, const Candidate &best) const
            {
                if (!next.found() || !best.found())
                    return next.found();
                if (inStretches_)
                    return static_cast<double>(next.stretches) <=
                           (1.0 - parameters_.tuning.worthASmallerGap) * static_cast<double>(best.stretches);
                return price(next) < price(best);
            }

            double worth(double gap) const
            {
                return parameters_.gapWorth * GAP_UNIT / (gap + parameters_.tuning.gapOffset);
            }

            double price(const Candidate &candidate) const
            {
                return candidate.cost + worth(candidate.rung.gap);
            }

            /** Length of the shortest curve to any goal, obstacles or not. */
            double leastLength(double radius) const
            {
                const ReedsShepp curves(radius);
                double least = std::numeric_limits<double>::infinity();
                for (const Pose &goal : scenario_.goals)
                    least = std::min(least, curves.distance(scenario_.start, goal));
                return least;
            }

            void smooth(const FootprintChecker &checker)
            {
                const Stopwatch watch;
                plan_.path = plan_.arcs;
                if (parameters_.smooth)
                {
                    plan_.smooth =
                        PathSmoother(scenario_.vehicle, parameters_.smoothing).smooth(plan_.arcs, queriesOf(checker));
                    // The arcs were swept; where the smoother cannot promise as much for what it made, they stay.
                    if (plan_.smooth.free && world_.isFree(plan_.smooth.path))
                        plan_.path = plan_.smooth.path;
                    else
                        plan_.smooth = {};
                }
                plan_.smoothingTime = watch.seconds();
            }

            const Scenario &scenario_;
            const PlanningParameters &parameters_;
            const ParkingWorld &world_;
            const bool inStretches_;
            double startRoom_{0.0};  ///< metres, what the start leaves all round the body
            double mostGap_{std::numeric_limits<double>::infinity()};  ///< metres, what start and goal leave
            ParkingPlan plan_;
        };
    }  // namespace

    ParkingPlanner::ParkingPlanner(const PlanningParameters &parameters, ContactTestMaker contact)
      : parameters_((parameters.validate(), parameters)),
        contact_(std::move(contact))
    {
    }

    ParkingPlan ParkingPlanner::plan(const Scenario &scenario) const
    {
        scenario.vehicle.validate();
        const Stopwatch watch;
        const ParkingWorld world(scenario, contact_);
        const double loading = watch.seconds();
        ParkingPlan result = plan(scenario, world);
        result.loadingTime += loading;
        return result;
    }

    ParkingPlan ParkingPlanner::plan(const Scenario &scenario, const ParkingWorld &world) const
    {
        if (scenario.goals.empty())
            throw Error("scenario " + scenario.name + ": it has no goal");
        return Planning(scenario, parameters_, world).plan();
    }

    ReverseParkingResult ParkingPlanner::wayIn(const Scenario &scenario, const ParkingWorld &world) const
    {
        if (!scenario.slot)
            throw Error("scenario " + scenario.name + ": it has no slot");
        return Planning(scenario, parameters_, world).wayIn();
    }
}  // namespace parking
