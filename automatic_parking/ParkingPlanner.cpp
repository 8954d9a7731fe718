#include "automatic_parking/ParkingPlanner.h"

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/PathSweep.h"
#include "state_validity/fcl/FclContactTest.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SWEEP_TOLERANCE = 1e-3;  // metres kept from obstacles along motions
        constexpr double SAME = 1e-6;             // metres and radians between a path's end and the goal that it is
        constexpr double CLEARANCE_STEP = 1e-3;   // metres to which the least clearance is found
        constexpr double CLEARANCE_SHARE = 0.01;  // or this share of it
        constexpr double CLEARANCE_RANGE = 1.0;   // metres of clearance from which on there is no extra cost

        // A path of the search all the way must be cheaper than a manoeuvre by this factor to be taken instead.
        constexpr double MANOEUVRE_PREFERENCE = 1.5;
        constexpr double MANOEUVRE_RADIUS = 1.1;  // of manoeuvres where there is room, over the smallest
        constexpr double LATE = 0.5;              // share of the time that all but the last try may take
        // What a gap is worth: GAP_UNIT / (gap + GAP_OFFSET), metres.
        constexpr double GAP_UNIT = 0.25, GAP_OFFSET = 0.02;

        using Clock = std::chrono::steady_clock;

        double secondsSince(Clock::time_point begin)
        {
            return std::chrono::duration<double>(Clock::now() - begin).count();
        }

        std::string centimetres(double metres)
        {
            return formatNumber(std::round(100.0 * metres)) + " cm";
        }

        bool isAt(const Pose &pose, const Pose &goal)
        {
            return isSamePose(pose, goal, SAME);
        }

        /** A way from start to goal. */
        struct Candidate
        {
            Path approach, manoeuvre, arcs;
            Pose goal;
            double cost{std::numeric_limits<double>::infinity()};
        };

        /** The searches of one plan. */
        class Search
        {
        public:
            Search(const Scenario &scenario, const PlanningParameters &parameters, const ParkingWorld &world,
                   ParkingPlan &plan)
              : scenario_(scenario),
                parameters_(parameters),
                world_(world),
                plan_(plan)
            {
            }

            double elapsed() const
            {
                return secondsSince(begin_);
            }

            bool isOver() const
            {
                return elapsed() > parameters_.timeLimit;
            }

            /** Is it time for the last resort? */
            bool isLate() const
            {
                return elapsed() > LATE * parameters_.timeLimit;
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

            /** The cheaper of manoeuvre and search all the way that \e checker and \e radius allow.

                \param expansions 0: as many as there is time for */
            Candidate find(const std::shared_ptr<const FootprintChecker> &checker, double radius,
                           std::uint64_t expansions)
            {
                Candidate best;
                if (scenario_.slot && parameters_.manoeuvres)
                    best = byManoeuvre(checker, radius, expansions > 0 ? expansions : parameters_.expansionsPerGap);
                std::vector<Pose> goals;
                for (const Pose &goal : scenario_.goals)
                    if (checker->isFree(goal))
                        goals.push_back(goal);
                if (goals.empty())
                    return best;
                Candidate whole;
                whole.approach = whole.arcs = search(*checker, radius, goals, expansions);
                if (whole.arcs.pieces.empty())
                    return best;
                for (const Pose &goal : goals)
                    if (isAt(whole.arcs.end(), goal))
                        whole.goal = goal;
                whole.cost = cost(whole.arcs);
                return whole.cost * MANOEUVRE_PREFERENCE < best.cost ? whole : best;
            }

        private:
            search::CostModel costModel(double radius) const
            {
                return {0.0,
                        parameters_.gearChangePenalty,
                        parameters_.steeringChangePenalty,
                        parameters_.clearanceWeight,
                        CLEARANCE_RANGE,
                        1.0 / radius};
            }

            /** Cost as of the car itself, so that paths planned with different gaps can be compared. */
            double cost(const Path &path) const
            {
                FootprintEnvironment environment(world_.footprint(), scenario_.bounds, SWEEP_TOLERANCE);
                return search::pathCost(costModel(scenario_.vehicle.minTurningRadius()), path, environment);
            }

            Path search(const FootprintChecker &checker, double radius, const std::vector<Pose> &goals,
                        std::uint64_t expansions)
            {
                ++plan_.tries;
                FootprintEnvironment environment(checker, scenario_.bounds, SWEEP_TOLERANCE);
                search::PlanRequest request;
                request.starts = {scenario_.start};
                request.goals = goals;
                request.car = {radius, false, checker.vehicle().inscribedRadius(checker.margin()), scenario_.bounds.min,
                               scenario_.bounds.max};
                request.parameters.gearChangePenalty = parameters_.gearChangePenalty;
                request.parameters.steeringChangePenalty = parameters_.steeringChangePenalty;
                request.parameters.clearanceWeight = parameters_.clearanceWeight;
                request.parameters.approximate = false;
                request.maxExpansions = expansions;
                request.stop = [this, isLast = expansions == 0]
                {
                    return isLast ? isOver() : isLate();
                };
                search::PlanResult result = search::plan(environment, request);
                plan_.search.expanded += result.statistics.expanded;
                plan_.search.generated += result.statistics.generated;
                plan_.search.connections += result.statistics.connections;
                plan_.search.heuristicCells += result.statistics.heuristicCells;
                return std::move(result.path);
            }

            Candidate byManoeuvre(const std::shared_ptr<const FootprintChecker> &checker, double radius,
                                  std::uint64_t expansions)
            {
                ReverseParkingOptions options;
                options.clearance = 0.0;  // the gap is in the checker already
                options.preferredRadius = std::max(radius, MANOEUVRE_RADIUS * scenario_.vehicle.minTurningRadius());
                std::vector<ReverseParkingResult> fitting;
                std::vector<Pose> starts;
                for (ReverseParkingResult &each :
                     ReverseParking(scenario_.vehicle, options).planAll(*scenario_.slot, queriesOf(*checker)))
                    if (each.fits() && !each.path.pieces.empty())
                    {
                        starts.push_back(each.path.start);
                        fitting.push_back(std::move(each));
                    }
                Candidate found;
                if (fitting.empty())
                    return found;
                found.approach = search(*checker, radius, starts, expansions);
                const bool none = found.approach.pieces.empty();
                found.approach.start = scenario_.start;
                for (const ReverseParkingResult &each : fitting)
                    if (isAt(none ? scenario_.start : found.approach.end(), each.path.start))
                    {
                        found.manoeuvre = each.path;
                        found.goal = each.goal;
                        found.arcs = joined(found.approach, found.manoeuvre);
                        found.cost = cost(found.arcs);
                        break;
                    }
                return found;
            }

            const Scenario &scenario_;
            const PlanningParameters &parameters_;
            const ParkingWorld &world_;
            ParkingPlan &plan_;
            Clock::time_point begin_{Clock::now()};
        };

        void smoothPlan(const PlanningParameters &parameters, const Vehicle &vehicle, const ParkingWorld &world,
                        const std::shared_ptr<const FootprintChecker> &checker, ParkingPlan &plan)
        {
            const auto begin = Clock::now();
            plan.path = plan.arcs;
            if (parameters.smooth)
            {
                plan.smooth = PathSmoother(vehicle, parameters.smoothing).smooth(plan.arcs, queriesOf(*checker));
                // The arcs were swept; where the smoother cannot promise as much for what it made, they stay.
                if (plan.smooth.free && isPathFree(world.footprint(), plan.smooth.path))
                    plan.path = plan.smooth.path;
                else
                    plan.smooth = {};
            }
            plan.smoothingTime = secondsSince(begin);
        }
    }  // namespace

    void PlanningParameters::validate() const
    {
        const Require require("planning");
        require.positive("timeLimit", timeLimit, "seconds");
        require.that(!gaps.empty(), "gaps", static_cast<double>(gaps.size()), "a list with at least one gap");
        for (const double gap : gaps)
            require.notNegative("a gap", gap);
        require.that(std::isfinite(radiusFactor) && radiusFactor >= 1.0, "radiusFactor", radiusFactor, "1 or more");
        require.notNegative("gapWorth", gapWorth);
        require.notNegative("gearChangePenalty", gearChangePenalty);
        require.notNegative("steeringChangePenalty", steeringChangePenalty);
        require.notNegative("clearanceWeight", clearanceWeight);
    }

    ParkingWorld::ParkingWorld(const Scenario &scenario)
      : footprint_(std::make_shared<const FootprintChecker>(ObstacleSet::fromScenario(scenario), scenario.vehicle, 0.0,
                                                            fclContactTest()))
    {
    }

    std::shared_ptr<const FootprintChecker> ParkingWorld::enlarged(double gap) const
    {
        if (gap == 0.0)
            return footprint_;
        try
        {
            return std::make_shared<const FootprintChecker>(footprint_->obstacles(), footprint_->vehicle(), gap,
                                                            fclContactTest());
        }
        catch (const Error &)
        {
            return nullptr;
        }
    }

    bool ParkingWorld::isFree(const Path &path) const
    {
        return isPathFree(*footprint_, path);
    }

    double ParkingWorld::clearance(const Path &path) const
    {
        double least = footprint_->exactClearance(path.start);
        Pose from = path.start;
        // From a pose with clearance c the body cannot come nearer than the least so far before its fastest point has
        // moved by the difference.
        for (const PathPiece &piece : path.pieces)
        {
            const double bend = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            const double moved =
                piece.driven() * footprint_->speedFactor(bend) + std::abs(piece.turn) * footprint_->farthestPoint();
            for (double share = 0.0; share <= 1.0 && least > 0.0;)
            {
                const Pose pose = piece.turn != 0.0 ? Pose{from.x, from.y, from.yaw + share * piece.turn}
                                                    : advance(from, piece, share * piece.driven());
                double here = footprint_->clearance(pose);
                if (here < least)
                    here = footprint_->exactClearance(pose);
                least = std::min(least, here);
                if (moved <= 0.0 || share >= 1.0)
                    break;
                const double stride = here - least + std::max(CLEARANCE_STEP, CLEARANCE_SHARE * least);
                share = std::min(1.0, share + stride / moved);
            }
            from = advance(from, piece);
        }
        return least;
    }

    ParkingPlanner::ParkingPlanner(const PlanningParameters &parameters)
      : parameters_((parameters.validate(), parameters))
    {
    }

    ParkingPlan ParkingPlanner::plan(const Scenario &scenario) const
    {
        scenario.vehicle.validate();
        const auto begin = Clock::now();
        const ParkingWorld world(scenario);
        const double loading = secondsSince(begin);
        ParkingPlan result = plan(scenario, world);
        result.loadingTime += loading;
        return result;
    }

    ParkingPlan ParkingPlanner::plan(const Scenario &scenario, const ParkingWorld &world) const
    {
        if (scenario.goals.empty())
            throw Error("scenario " + scenario.name + ": it has no goal");
        ParkingPlan plan;
        const FootprintChecker &body = world.footprint();
        const auto fail = [&plan](ParkingStatus failure, const std::string &message)
        {
            plan.failure = failure;
            plan.message = message;
            return plan;
        };
        if (!body.isFree(scenario.start))
            return fail(ParkingStatus::InvalidStart, "the car is in collision, or outside, where it starts");
        const double startRoom = body.exactClearance(scenario.start);
        double goalRoom = -1.0;
        for (const Pose &goal : scenario.goals)
            if (body.isFree(goal))
                goalRoom = std::max(goalRoom, body.exactClearance(goal));
        if (goalRoom < 0.0)
            return fail(ParkingStatus::InvalidGoal, "the car is in collision, or outside, at the goal");

        Search search(scenario, parameters_, world, plan);
        const double smallest = scenario.vehicle.minTurningRadius();
        std::vector<double> gaps, radii{parameters_.radiusFactor * smallest};
        for (const double gap : parameters_.gaps)
            if (gap == 0.0 || gap < std::min(startRoom, goalRoom))
                gaps.push_back(gap);
        if (parameters_.radiusFactor > 1.0)
            radii.push_back(smallest);
        const auto worth = [this](double gap)
        {
            return parameters_.gapWorth * GAP_UNIT / (gap + GAP_OFFSET);
        };
        double best = std::numeric_limits<double>::infinity();
        std::shared_ptr<const FootprintChecker> bestChecker;
        for (const double radius : radii)
        {
            for (const double gap : gaps)
            {
                // Nothing that a smaller gap allows can be shorter than the bare curve.
                if (search.isOver() || search.leastLength(radius) + worth(gap) >= best)
                    break;
                const bool last = !plan.found && gap == gaps.back() && radius == radii.back();
                if (search.isLate() && !last)
                    continue;
                const auto before = Clock::now();
                const std::shared_ptr<const FootprintChecker> checker = world.enlarged(gap);
                plan.loadingTime += secondsSince(before);
                if (!checker)
                    continue;
                Candidate found = search.find(checker, radius, last ? 0 : parameters_.expansionsPerGap);
                if (!(found.cost + worth(gap) < best))
                    continue;
                best = found.cost + worth(gap);
                bestChecker = checker;
                plan.found = true;
                plan.cost = found.cost;
                plan.goal = found.goal;
                plan.approach = std::move(found.approach);
                plan.manoeuvre = std::move(found.manoeuvre);
                plan.arcs = std::move(found.arcs);
                plan.gap = gap;
                plan.turningRadius = radius;
            }
            if (plan.found)
                break;
        }
        plan.planningTime = search.elapsed() - plan.loadingTime;
        if (!plan.found)
            return fail(ParkingStatus::NoPath,
                        search.isOver() ? "no path was found within " + formatNumber(parameters_.timeLimit) + " s"
                                        : "there is no path for this car");
        smoothPlan(parameters_, scenario.vehicle, world, bestChecker, plan);
        plan.clearance = world.clearance(plan.path);
        plan.message = (plan.manoeuvre.pieces.empty() ? "planned all the way" : "approach and manoeuvre") +
                       std::string(", at least ") + centimetres(plan.clearance) + " from obstacles";
        return plan;
    }
}  // namespace parking
