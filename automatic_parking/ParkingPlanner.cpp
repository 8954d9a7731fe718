#include "automatic_parking/ParkingPlanner.h"

#include "automatic_parking/Stopwatch.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/manoeuvres/MultiStretchParking.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double SAME_POSE = 1e-6;  // metres and radians, as for joined()
        constexpr double GAP_UNIT = 0.25;   // metres, of PlanningParameters::gapWeight

        /** Parameters of an attempt: gap and turning radius, in metres. */
        struct ClearanceLevel
        {
            double gap;           ///< required
            double radius;        ///< of the tightest turn
            double searchMargin;  ///< by which the body is enlarged for searches
            double checkMargin;   ///< and for constructed manoeuvres and smoothing
        };

        /** Result of an attempt: a path from start to goal, or only the slot entry if that is required. */
        struct Candidate
        {
            ReverseParkingResult manoeuvre;  ///< slot entry; no pieces if there is none
            Path approach,                   ///< from the start to the manoeuvre, or all the way
                arcs;                        ///< both, from start to goal
            Pose goal;                       ///< last pose of the path
            /** Metres, 0 for a slot entry only; infinite if no path was found. */
            double cost{std::numeric_limits<double>::infinity()};
            std::size_t stretches{0};                         ///< at the slot
            ClearanceLevel level{};                           ///< level of the attempt
            std::shared_ptr<const FootprintChecker> checker;  ///< whose margin the smoothed path must keep

            bool found() const
            {
                return cost < std::numeric_limits<double>::infinity();
            }
        };

        std::string centimetres(double metres)
        {
            return formatNumber(std::round(100.0 * metres)) + " cm";
        }

        /** Makes one plan: runs the attempts, compares their results, and smooths the best. */
        class Planning
        {
        public:
            Planning(const Scenario &scenario, const PlanningParameters &parameters, const ParkingWorld &world)
              : scenario_(scenario),
                parameters_(parameters),
                tuning_(parameters.tuning),
                world_(world),
                inStretches_(parameters.entryMode == EntryMode::InStretches)
            {
            }

            ParkingPlan plan()
            {
                if (!checkEnds())
                    return std::move(plan_);
                Candidate best = climb();
                plan_.planningTime = watch_.seconds() - plan_.loadingTime;
                if (!best.found())
                {
                    fail(ParkingStatus::NoPath, whyNot());
                    plan_.manoeuvre = verdict_.value_or(ReverseParkingResult{});
                    return std::move(plan_);
                }
                plan_.found = true;
                plan_.cost = best.cost;
                plan_.goal = best.goal;
                plan_.approach = std::move(best.approach);
                plan_.manoeuvre = std::move(best.manoeuvre);
                plan_.arcs = std::move(best.arcs);
                plan_.gap = best.level.gap;
                plan_.turningRadius = best.level.radius;
                smooth(*best.checker);
                plan_.clearance = minClearance(world_.footprint(), plan_.path);
                plan_.message =
                    (plan_.manoeuvre.path.pieces.empty() ? "searched all the way" : "approach and manoeuvre") +
                    std::string(", at least ") + centimetres(plan_.clearance) + " from obstacles";
                return std::move(plan_);
            }

            ReverseParkingResult planSlotEntry()
            {
                onlySlotEntry_ = true;
                Candidate best = climb();
                return best.found() ? std::move(best.manoeuvre) : verdict_.value_or(ReverseParkingResult{});
            }

        private:
            void fail(ParkingStatus failure, const std::string &message)
            {
                plan_.failure = failure;
                plan_.message = message;
            }

            /** Checks start and goals. \return false if the plan is finished */
            bool checkEnds()
            {
                const FootprintChecker &body = world_.footprint();
                if (!body.isFree(scenario_.start))
                {
                    fail(ParkingStatus::InvalidStart, "the car collides or is outside the world at its start");
                    return false;
                }
                startClearance_ = body.exactClearance(scenario_.start);
                double goalClearance = -1.0;
                for (const Pose &goal : scenario_.goals)
                    if (body.isFree(goal))
                    {
                        goalClearance = std::max(goalClearance, body.exactClearance(goal));
                        if (isSamePose(scenario_.start, goal, PlannerParameters().goalTolerance))
                            return stay(goal);
                    }
                if (goalClearance < 0.0)
                    fail(ParkingStatus::InvalidGoal, "the car collides or is outside the world at its goal");
                else if (inStretches_ && startClearance_ <= PlanningParameters::MIN_GAP_IN_STRETCHES)
                    fail(ParkingStatus::InvalidStart,
                         "the start is nearer to an obstacle than the minimum gap of 4 mm");
                else
                {
                    maxGap_ = std::min(startClearance_, goalClearance);
                    watch_ = Stopwatch();
                    return true;
                }
                return false;
            }

            /** Finishes the plan of a car that already stands at its goal. */
            bool stay(const Pose &goal)
            {
                plan_.found = true;
                plan_.message = "the car already stands at the goal";
                plan_.goal = goal;
                plan_.approach = plan_.arcs = plan_.path = Path{scenario_.start, {}};
                plan_.clearance = startClearance_;
                return false;
            }

            std::string whyNot() const
            {
                if (verdict_ && inStretches_)
                    return verdict_->message;
                return isOver() ? "no path was found within " + formatNumber(parameters_.timeLimit) + " s"
                                : "there is no path for this car";
            }

            bool isInterrupted() const
            {
                return parameters_.interrupted && parameters_.interrupted();
            }

            /** Whether the time limit has passed or planning was interrupted. */
            bool isOver() const
            {
                return isInterrupted() || watch_.seconds() > parameters_.timeLimit;
            }

            /** Whether only the last attempt may start. */
            bool isLate() const
            {
                return isInterrupted() || watch_.seconds() > tuning_.attemptsShare * parameters_.timeLimit;
            }

            /** A level for EntryMode::InStretches. Its searches keep up to a tolerance less than the gap, and smoothing
                may use half of it. */
            ClearanceLevel levelInStretches(double gap, double radius) const
            {
                return {gap, radius, gap - tuning_.sweepTolerance, 0.5 * gap};
            }

            /** The levels of all attempts in order. */
            std::vector<ClearanceLevel> ladder() const
            {
                const std::vector<double> &gaps = parameters_.gaps;
                const double smallest = scenario_.vehicle.minTurningRadius(), factor = parameters_.radiusFactor;
                std::vector<ClearanceLevel> levels;
                if (inStretches_)
                {
                    // The gap and the reserve of steering decrease step by step.
                    const auto last = static_cast<double>(gaps.size() - 1);
                    for (std::size_t i = 0; i < gaps.size(); ++i)
                    {
                        const double kept = gaps.size() > 1 ? (last - static_cast<double>(i)) / last : 1.0;
                        levels.push_back(levelInStretches(gaps[i], (1.0 + kept * (factor - 1.0)) * smallest));
                    }
                    return levels;
                }
                for (const double each : factor > 1.0 ? std::vector<double>{factor, 1.0} : std::vector<double>{1.0})
                    for (const double gap : gaps)
                        if (gap == 0.0 || gap < maxGap_)
                            levels.push_back({gap, each * smallest, gap, gap});
                return levels;
            }

            /** The best result of all attempts. */
            Candidate climb()
            {
                const std::vector<ClearanceLevel> levels = ladder();
                Candidate best;
                for (std::size_t i = 0; i < levels.size(); ++i)
                {
                    if (isOver() || !isWorthTrying(levels[i], best))
                        break;
                    const bool last = !best.found() && i + 1 == levels.size();
                    if (isLate() && !last)
                        continue;
                    Candidate next = find(levels[i], last);
                    if (isBetter(next, best))
                        best = std::move(next);
                }
                return best;
            }

            bool isWorthTrying(const ClearanceLevel &level, const Candidate &best) const
            {
                if (!best.found())
                    return true;
                if (inStretches_)
                    return best.stretches > tuning_.manyStretches;
                // No path with a smaller gap is shorter than the curve without obstacles.
                return level.radius == best.level.radius &&
                       minLength(level.radius) + gapCost(level.gap) < totalCost(best);
            }

            bool isBetter(const Candidate &next, const Candidate &best) const
            {
                if (!next.found() || !best.found())
                    return next.found();
                if (inStretches_)
                    return static_cast<double>(next.stretches) <=
                           (1.0 - tuning_.minStretchSaving) * static_cast<double>(best.stretches);
                return totalCost(next) < totalCost(best);
            }

            double gapCost(double gap) const
            {
                return parameters_.gapWeight * GAP_UNIT / (gap + tuning_.gapOffset);
            }

            double totalCost(const Candidate &candidate) const
            {
                return candidate.cost + gapCost(candidate.level.gap);
            }

            /** Length of the shortest curve to any goal, ignoring obstacles. */
            double minLength(double radius) const
            {
                const ReedsShepp curves(radius);
                double least = std::numeric_limits<double>::infinity();
                for (const Pose &goal : scenario_.goals)
                    least = std::min(least, curves.distance(scenario_.start, goal));
                return least;
            }

            /** Checkers of the body enlarged for searches and for other checks; null if it is larger than the world. */
            struct Checkers
            {
                std::shared_ptr<const FootprintChecker> search, check;
            };

            Checkers checkers(const ClearanceLevel &level)
            {
                const Stopwatch loading;
                Checkers body{world_.enlarged(level.searchMargin), nullptr};
                body.check = level.checkMargin == level.searchMargin ? body.search : world_.enlarged(level.checkMargin);
                plan_.loadingTime += loading.seconds();
                return body;
            }

            /** The best path of \e level. \param last whether it is the last attempt, whose search may use the
                remaining time */
            Candidate find(ClearanceLevel level, bool last)
            {
                Checkers body = checkers(level);
                if (!body.search || !body.check)
                    return {};
                const bool constructed = scenario_.slot && parameters_.entryMode != EntryMode::Searched;
                std::vector<ReverseParkingResult> entries;
                if (constructed)
                    entries = slotEntries(level, body);
                // If no path out of the slot was found, no search into it is made.
                if (entries.empty() && (onlySlotEntry_ || (constructed && inStretches_)))
                    return {};
                Candidate best;
                if (onlySlotEntry_)
                {
                    best.manoeuvre = entries.front();
                    best.cost = 0.0;
                }
                else
                {
                    const double most = tuning_.shareOfStartGap * startClearance_;
                    if (inStretches_ && most < level.gap)
                    {
                        level = levelInStretches(most, level.radius);
                        body = checkers(level);
                    }
                    if (!entries.empty())
                        best = throughManoeuvre(entries, fromStart(level), *body.search);
                    if (!best.found() || !inStretches_)
                    {
                        Candidate whole = allTheWay(fromStart(level), *body.search, last);
                        if (whole.cost * tuning_.manoeuvrePreference < best.cost)
                            best = std::move(whole);
                    }
                }
                best.level = level;
                best.checker = body.check;
                best.stretches = entries.empty() ? 0 : entries.front().path.stretches().size();
                return best;
            }

            /** The slot entries of \e level, from P in the aisle to the parked pose: all in one sweep, otherwise the
                best in several stretches. */
            std::vector<ReverseParkingResult> slotEntries(const ClearanceLevel &level, const Checkers &body)
            {
                ReverseParkingOptions sweep = parameters_.sweep;
                sweep.clearance = inStretches_ ? level.gap : 0.0;  // otherwise included in the checker
                if (!inStretches_ && sweep.preferredRadius == 0.0)
                    sweep.preferredRadius =
                        std::max(level.radius, tuning_.manoeuvreRadius * scenario_.vehicle.minTurningRadius());
                const ReverseParking parking(scenario_.vehicle, sweep);
                const FootprintQueries queries = queriesOf(*body.check);
                std::vector<ReverseParkingResult> entries = parking.planAll(*scenario_.slot, queries);
                ReverseParkingResult result = entries.front();
                entries.erase(std::remove_if(entries.begin(), entries.end(),
                                             [](const ReverseParkingResult &entry)
                                             { return !entry.fits() || entry.path.pieces.empty(); }),
                              entries.end());
                if (!entries.empty())
                    return entries;
                if (inStretches_)
                {
                    const auto leave = [&](const SlotExitTask &task)
                    {
                        return search(*body.search, {task.parked, task.exits, task.bounds, level.radius,
                                                     tuning_.gearChangeInSlot, false, parameters_.expansionsPerGap});
                    };
                    result = planInStretches(parking, *scenario_.slot, queries, leave);
                    if (result.fits())
                        return {std::move(result)};
                    result.message += "; no slot entry in several stretches was found, either";
                }
                if (!verdict_)
                    verdict_ = std::move(result);
                return entries;
            }

            struct SearchTask
            {
                Pose from;
                std::vector<Pose> to;
                Box bounds;  ///< of the rear axle
                double radius;
                double gearChange;
                bool bothSides;            ///< whether to search from both ends; otherwise from \e from only
                std::uint64_t expansions;  ///< 0: limited by time only
            };

            SearchTask fromStart(const ClearanceLevel &level) const
            {
                return {scenario_.start,
                        {},
                        scenario_.bounds,
                        level.radius,
                        parameters_.gearChangePenalty,
                        true,
                        parameters_.expansionsPerGap};
            }

            /** Plans to the start of one of \e entries, and appends it. */
            Candidate throughManoeuvre(const std::vector<ReverseParkingResult> &entries, SearchTask task,
                                       const FootprintChecker &checker)
            {
                Candidate candidate;
                for (const ReverseParkingResult &entry : entries)
                    task.to.push_back(entry.path.start);
                candidate.approach = search(checker, task);
                for (const ReverseParkingResult &entry : entries)
                    if (isSamePose(candidate.approach.end(), entry.path.start, SAME_POSE))
                    {
                        candidate.manoeuvre = entry;
                        candidate.goal = entry.goal;
                        candidate.arcs = joined(candidate.approach, entry.path);
                        candidate.cost = cost(candidate.arcs);
                        break;
                    }
                return candidate;
            }

            /** Searches the whole path to one of the goals. */
            Candidate allTheWay(SearchTask task, const FootprintChecker &checker, bool last)
            {
                Candidate candidate;
                if (inStretches_)
                    task.gearChange = tuning_.gearChangeInSlot;
                if (last && std::isfinite(parameters_.timeLimit))
                    task.expansions = 0;
                std::copy_if(scenario_.goals.begin(), scenario_.goals.end(), std::back_inserter(task.to),
                             [&checker](const Pose &goal) { return checker.isFree(goal); });
                if (task.to.empty())
                    return candidate;
                candidate.approach = candidate.arcs = search(checker, task);
                if (candidate.arcs.pieces.empty())
                    return candidate;
                for (const Pose &goal : task.to)
                    if (isSamePose(candidate.arcs.end(), goal, SAME_POSE))
                        candidate.goal = goal;
                candidate.cost = cost(candidate.arcs);
                return candidate;
            }

            /** The path found; without pieces if there is none. */
            Path search(const FootprintChecker &checker, const SearchTask &task)
            {
                ++plan_.attempts;
                FootprintEnvironment environment(checker, task.bounds, tuning_.sweepTolerance);
                search::PlanRequest request;
                request.starts = {task.from};
                request.goals = task.to;
                request.car = search::carInSpace(checker.vehicle(), checker.margin(), task.bounds);
                request.car.turningRadius = task.radius;
                request.parameters.bidirectional = task.bothSides;
                request.parameters.searchFrom = task.bothSides ? "goal" : "start";
                request.parameters.gearChangePenalty = task.gearChange;
                request.parameters.steeringChangePenalty = parameters_.steeringChangePenalty;
                request.parameters.preferredClearance = parameters_.preferredClearance;
                request.parameters.clearanceCost = parameters_.clearanceCost;
                request.parameters.detours = task.bothSides;  // out of a slot they need more stretches
                request.parameters.approximate = false;
                request.maxExpansions = task.expansions;
                request.stop = [this, isLast = task.expansions == 0]
                {
                    return isLast ? isOver() : isLate();
                };
                search::PlanResult result = search::plan(environment, request);
                plan_.search += result.statistics;
                return result.outcome == search::PlanOutcome::Solved ? std::move(result.path) : Path{task.from, {}};
            }

            /** Cost for the car without a gap, so that paths of different gaps can be compared. */
            double cost(const Path &path) const
            {
                FootprintEnvironment environment(world_.footprint(), scenario_.bounds, tuning_.sweepTolerance);
                search::CostModel model;
                model.gearChangePenalty = parameters_.gearChangePenalty;
                model.steeringChangePenalty = parameters_.steeringChangePenalty;
                model.fullLockCurvature = 1.0 / scenario_.vehicle.minTurningRadius();
                model.preferredClearance = parameters_.preferredClearance;
                model.clearanceCost = parameters_.clearanceCost;
                return search::price(model, path, environment).cost;
            }

            void smooth(const FootprintChecker &checker)
            {
                const Stopwatch watch;
                plan_.path = plan_.arcs;
                if (parameters_.smooth)
                {
                    plan_.smooth =
                        PathSmoother(scenario_.vehicle, parameters_.smoothing).smooth(plan_.arcs, queriesOf(checker));
                    // The arcs were swept. If the smoothed path cannot be proved free, they are kept.
                    if (plan_.smooth.free && isPathFree(world_.footprint(), plan_.smooth.path))
                        plan_.path = plan_.smooth.path;
                    else
                        plan_.smooth = {};
                }
                plan_.smoothingTime = watch.seconds();
            }

            const Scenario &scenario_;
            const PlanningParameters &parameters_;
            const PlanningTuning &tuning_;
            const ParkingWorld &world_;
            const bool inStretches_;
            bool onlySlotEntry_{false};                               // only the slot entry is required, for any start
            double startClearance_{0.0};                              // metres, clearance of the body at the start
            double maxGap_{std::numeric_limits<double>::infinity()};  // metres, smaller clearance of start and goal
            Stopwatch watch_;                                         // of all attempts
            std::optional<ReverseParkingResult> verdict_;  // reason of the first attempt without a slot entry
            ParkingPlan plan_;
        };
    }  // namespace

    std::string toString(ParkingStatus status)
    {
        switch (status)
        {
            case ParkingStatus::Parked:
                return "parked";
            case ParkingStatus::InvalidStart:
                return "invalid_start";
            case ParkingStatus::InvalidGoal:
                return "invalid_goal";
            case ParkingStatus::NoPath:
                return "no_path";
            case ParkingStatus::NotDrivable:
                return "not_drivable";
            case ParkingStatus::Collision:
                return "collision";
            case ParkingStatus::Stopped:
                return "stopped";
            case ParkingStatus::MissedGoal:
                return "missed_goal";
        }
        return "stopped";
    }

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

    ReverseParkingResult ParkingPlanner::planSlotEntry(const Scenario &scenario, const ParkingWorld &world) const
    {
        if (!scenario.slot)
            throw Error("scenario " + scenario.name + ": it has no slot");
        return Planning(scenario, parameters_, world).planSlotEntry();
    }
}  // namespace parking
