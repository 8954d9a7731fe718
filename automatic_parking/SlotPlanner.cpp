#include "automatic_parking/SlotPlanner.h"

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/manoeuvres/MultiStretchParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking
{
    namespace
    {
        /** Gaps tried for several stretches between that of the sweep and the least one, metres. */
        constexpr double MIDDLE_GAP = 0.02;

        /** The search proves motions free up to this many metres from contact; its gap is smaller by as much. */
        constexpr double SWEEP_TOLERANCE = 1e-3;

        constexpr double SAME_POSE = 1e-6;  // metres and radians

        /** In several stretches, metres of driving that a change of direction may save. */
        constexpr double GEAR_CHANGE = 4.0;
        constexpr double STEERING_CHANGE = 0.1;

        /** Manoeuvres of more stretches than this are sought with the next smaller gap, too, which is worth it when it
           saves this share of them. */
        constexpr std::size_t MANY_STRETCHES = 8;
        constexpr double WORTH_A_SMALLER_GAP = 0.25;

        /** On the way to the slot. */
        constexpr double APPROACH_GEAR_CHANGE = 2.0;

        /** How much of its surroundings a slot gets where nothing is known, metres to either side. */
        constexpr double REACH = 15.0;

        /** A world without a wall across the aisle ends so far from the slot, metres. */
        constexpr double OPEN_AISLE = 15.0;

        /** Growth of slots that are too small, metres. */
        constexpr double GROWTH_STEP = 0.25;
        constexpr double MOST_GROWTH = 2.0;

        struct SearchTask
        {
            Pose from;
            std::vector<Pose> to;
            Bounds bounds;  ///< of the rear axle
            double radius;
            double gearChange;
            bool bothSides;  ///< search from both ends; otherwise out of `from`
            std::uint64_t effort;
        };

        /** Without pieces when nothing was found. */
        Path searchPath(const FootprintChecker &checker, const SearchTask &task)
        {
            FootprintEnvironment environment(checker, task.bounds, SWEEP_TOLERANCE);
            search::PlanRequest request;
            request.starts = {task.from};
            request.goals = task.to;
            request.car = {task.radius, false, checker.vehicle().inscribedRadius(checker.margin()), task.bounds.min,
                           task.bounds.max};
            request.parameters.bidirectional = task.bothSides;
            request.parameters.searchFrom = "start";
            request.parameters.gearChangePenalty = task.gearChange;
            request.parameters.steeringChangePenalty = STEERING_CHANGE;
            request.parameters.approximate = false;
            request.maxExpansions = task.effort;
            search::PlanResult result = search::plan(environment, request);
            return result.outcome == search::PlanOutcome::Solved ? std::move(result.path) : Path{task.from, {}};
        }

        Bounds boundsOf(const ObstacleSet &world)
        {
            Bounds bounds;
            bounds.min.setConstant(std::numeric_limits<double>::infinity());
            bounds.max = -bounds.min;
            for (const double x : {world.bounds().min.x(), world.bounds().max.x()})
                for (const double y : {world.bounds().min.y(), world.bounds().max.y()})
                {
                    const Pose corner = compose(world.frame(), {x, y, 0.0});
                    bounds.min = bounds.min.cwiseMin(Eigen::Vector2d(corner.x, corner.y));
                    bounds.max = bounds.max.cwiseMax(Eigen::Vector2d(corner.x, corner.y));
                }
            return bounds;
        }

        ParkingSlot withSide(ParkingSlot slot)
        {
            if (slot.side == SlotSide::Either)
                slot.side = SlotSide::Right;
            return slot;
        }

        ObstacleSet surroundings(const ParkingSlot &slot, const Vehicle &vehicle, double aisleWidth, const Pose *start)
        {
            const double across = std::isfinite(aisleWidth) ? aisleWidth : OPEN_AISLE;
            std::vector<Polygon> obstacles = slotSurroundings(slot, slot.side, aisleWidth, REACH);
            // Neighbours and walls end somewhere; the car shall not look for a way round their ends.
            const double reach = 0.5 * slot.length + across + REACH;
            Bounds bounds{{slot.pose.x - reach, slot.pose.y - reach}, {slot.pose.x + reach, slot.pose.y + reach}};
            if (start != nullptr)
                for (const Eigen::Vector2d &corner : vehicle.footprint(*start))
                {
                    bounds.min = bounds.min.cwiseMin(corner - Eigen::Vector2d::Constant(vehicle.length()));
                    bounds.max = bounds.max.cwiseMax(corner + Eigen::Vector2d::Constant(vehicle.length()));
                }
            return ObstacleSet::fromPolygons(obstacles, bounds);
        }

        /** Width of a perpendicular slot below which no body of that length and width gets round the corner of the
            neighbour, however it moves.

            Turned by phi from the slot's axis, its side on the corner, the body reaches up to the far side of the aisle
            and down to the other side of the slot: length <= (aisle - width sin phi) / cos phi + (slot - width cos phi)
            / sin phi. Once the aisle holds all of it the slot does not matter. */
        double widthToTurnInto(double length, double width, double aisle)
        {
            double needed = width;
            constexpr int STEPS = 2000;
            for (int i = 1; i < STEPS; ++i)
            {
                const double phi = 0.5 * PI * i / STEPS, s = std::sin(phi), c = std::cos(phi);
                if (length * c + width * s <= aisle)
                    break;
                needed = std::max(needed, length * s + (width - aisle * s) / c);
            }
            return needed;
        }
    }  // namespace

    SlotPlanner::SlotPlanner(const Vehicle &vehicle, const SlotPlannerOptions &options)
      : vehicle_(vehicle),
        options_(options)
    {
        ReverseParking(vehicle, options.sweep);  // checks the car and these options
        PathSmoother(vehicle, options.smoothing);
        const Require require("slot planner");
        require.that(options.radiusFactor >= 1.0 && std::isfinite(options.radiusFactor), "radius factor",
                     options.radiusFactor, "at least 1");
        require.that(options.leastClearance >= 4.0 * SWEEP_TOLERANCE && std::isfinite(options.leastClearance),
                     "least clearance", options.leastClearance, "at least 0.004 m");
        require.that(options.effort > 0, "effort", static_cast<double>(options.effort),
                     "a positive number of expansions");
    }

    SlotPlanner::Found SlotPlanner::find(const ParkingSlot &slot, const ObstacleSet &world, bool regular) const
    {
        Found found{};
        if (regular && slot.kind == SlotKind::Perpendicular)
        {
            const double both = 2.0 * options_.leastClearance;
            const double missing =
                widthToTurnInto(vehicle_.length() + both, vehicle_.width + both, options_.sweep.aisleWidth) -
                slot.width;
            found.manoeuvre = ReverseParking(vehicle_, options_.sweep).plan(slot);
            if (missing > 0.0 && !found.manoeuvre.fits())
            {
                found.manoeuvre.message +=
                    "; nor does a car of this size get round the corner in any number of stretches: the "
                    "slot would have to be " +
                    formatNumber(std::ceil(1000.0 * missing) / 10.0) + " cm wider";
                return found;
            }
        }

        // Comfortable first: the gap, and with it the reserve of steering, is given up step by step.
        std::vector<std::pair<double, double>> attempts{{options_.sweep.clearance, options_.radiusFactor}};
        if (MIDDLE_GAP < options_.sweep.clearance && options_.leastClearance < MIDDLE_GAP)
            attempts.emplace_back(MIDDLE_GAP, 1.0 + 0.5 * (options_.radiusFactor - 1.0));
        if (options_.leastClearance < options_.sweep.clearance)
            attempts.emplace_back(options_.leastClearance, 1.0);
        for (const auto &[gap, radiusFactor] : attempts)
        {
            const double clearance = std::max(gap, 4.0 * SWEEP_TOLERANCE);
            ReverseParkingOptions sweep = options_.sweep;
            sweep.clearance = gap;
            const ReverseParking parking(vehicle_, sweep);
            const FootprintChecker judge(world, vehicle_, 0.5 * clearance);
            const FootprintChecker planning(world, vehicle_, clearance - SWEEP_TOLERANCE);
            const SlotExitPlanner shunts = [&, radius = radiusFactor * vehicle_.minTurningRadius()](const auto &task)
            {
                return searchPath(planning, {task.parked, task.exits, Bounds{task.min, task.max}, radius, GEAR_CHANGE,
                                             false, options_.effort});
            };
            ReverseParkingResult result = planInStretches(parking, slot, queriesOf(judge), shunts);
            const std::size_t stretches = result.path.stretches().size();
            const double few =
                (1.0 - WORTH_A_SMALLER_GAP) * static_cast<double>(found.manoeuvre.path.stretches().size());
            if (found.clearance > 0.0 &&
                !(result.fits() && (!found.manoeuvre.fits() || static_cast<double>(stretches) <= few)))
                continue;
            found = {result, {}, clearance, radiusFactor};
            for (ReverseParkingResult &each : parking.planAll(slot, queriesOf(judge)))
                if (each.fits())
                    found.sweeps.push_back(std::move(each));
            if (result.fits() && stretches <= MANY_STRETCHES)
                break;
        }
        if (!found.manoeuvre.fits())
            found.manoeuvre.message += "; nor was a way in several stretches found";
        return found;
    }

    ReverseParkingResult SlotPlanner::manoeuvre(const ParkingSlot &slot) const
    {
        const ParkingSlot sided = withSide(slot);
        return find(sided, surroundings(sided, vehicle_, options_.sweep.aisleWidth, nullptr), true).manoeuvre;
    }

    ReverseParkingResult SlotPlanner::manoeuvre(const ParkingSlot &slot, const ObstacleSet &world) const
    {
        return find(slot, world, false).manoeuvre;
    }

    SlotPlan SlotPlanner::plan(const ParkingSlot &slot, const Pose &start) const
    {
        const ParkingSlot sided = withSide(slot);
        return plan(sided, start, surroundings(sided, vehicle_, options_.sweep.aisleWidth, &start), true);
    }

    SlotPlan SlotPlanner::plan(const ParkingSlot &slot, const Pose &start, const ObstacleSet &world) const
    {
        return plan(slot, start, world, false);
    }

    SlotPlan SlotPlanner::plan(const ParkingSlot &slot, const Pose &start, const ObstacleSet &world, bool regular) const
    {
        checkStart(slot, vehicle_, start, options_.sweep.aisleWidth);
        SlotPlan plan;
        Found found = find(slot, world, regular);
        plan.manoeuvre = found.manoeuvre;
        plan.clearance = found.clearance;
        plan.message = found.manoeuvre.message;
        if (!found.manoeuvre.fits())
            return plan;

        const FootprintChecker bare(world, vehicle_, 0.0);
        const double startGap = bare.exactClearance(start);
        if (!(startGap > 4.0 * SWEEP_TOLERANCE))
        {
            plan.message = startGap > 0.0 ? "the start is nearer to an obstacle than the least gap of 4 mm"
                                          : "the car touches an obstacle at the start";
            return plan;
        }
        plan.clearance = std::min(plan.clearance, 0.9 * startGap);
        const FootprintChecker planning(world, vehicle_, plan.clearance - SWEEP_TOLERANCE);
        SearchTask task{start,
                        {},
                        boundsOf(world),
                        found.radiusFactor * vehicle_.minTurningRadius(),
                        APPROACH_GEAR_CHANGE,
                        true,
                        options_.effort};
        if (found.sweeps.empty())
            found.sweeps.push_back(found.manoeuvre);
        for (const ReverseParkingResult &sweep : found.sweeps)
            task.to.push_back(sweep.path.start);
        const Path approach = searchPath(planning, task);
        if (!approach.pieces.empty() || isSamePose(start, task.to.front(), SAME_POSE))
        {
            for (const ReverseParkingResult &sweep : found.sweeps)
                if (isSamePose(approach.end(), sweep.path.start, SAME_POSE))
                {
                    plan.manoeuvre = sweep;
                    break;
                }
            plan.path = joined(approach, plan.manoeuvre.path);
        }
        else
        {
            task.to = slot.goals(vehicle_);
            task.gearChange = GEAR_CHANGE;
            plan.path = searchPath(planning, task);
        }
        plan.solved = !plan.path.pieces.empty();
        plan.message = plan.solved ? "" : "no way was found from the start to the slot";
        if (plan.solved)
        {
            const FootprintChecker judge(world, vehicle_, 0.5 * plan.clearance);
            plan.smooth = PathSmoother(vehicle_, options_.smoothing).smooth(plan.path, queriesOf(judge));
        }
        return plan;
    }

    double SlotPlanner::smallestSlot(const ParkingSlot &slot, double precision) const
    {
        const bool parallel = slot.kind == SlotKind::Parallel;
        double ParkingSlot::*const dimension = parallel ? &ParkingSlot::length : &ParkingSlot::width;
        const double least = (parallel ? vehicle_.length() : vehicle_.width) + 2.0 * options_.leastClearance;
        const auto fits = [&](const ParkingSlot &tried)
        {
            return manoeuvre(tried).fits();
        };
        ParkingSlot largest = slot;
        largest.depth.reset();
        largest.lateralOffset = 0.0;
        largest.*dimension = std::max(slot.*dimension, least);
        for (double grown = 0.0; !fits(largest); grown += GROWTH_STEP, largest.*dimension += GROWTH_STEP)
            if (grown >= MOST_GROWTH)
                return std::numeric_limits<double>::infinity();
        return parking::smallestSlot(largest, dimension, least, fits, precision);
    }
}  // namespace parking
