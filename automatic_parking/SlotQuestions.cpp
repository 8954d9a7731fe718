#include "automatic_parking/SlotQuestions.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking
{
    namespace
    {
        ParkingSlot withSide(ParkingSlot slot)
        {
            if (slot.side == SlotSide::Either)
                slot.side = SlotSide::Right;
            return slot;
        }

        /** Minimum width of a perpendicular slot for any motion of a body of this length and width round the corner of
            the neighbour.

            The body is turned by phi from the slot's axis with its side on the corner. It reaches up to the far side of
            the aisle and down to the other side of the slot: length <= (aisle - width sin phi) / cos phi + (slot -
            width cos phi) / sin phi. Once the aisle contains the whole body, the slot does not matter. */
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

        /** The reason why no search can find a slot entry, if it is known beforehand. */
        std::optional<ReverseParkingResult> hopeless(const PlanningParameters &parameters, const Vehicle &vehicle,
                                                     const ParkingSlot &slot)
        {
            ReverseParkingOptions options = parameters.sweep;
            options.clearance = parameters.gaps.front();
            ReverseParkingResult oneSweep = ReverseParking(vehicle, options).plan(slot);
            if (slot.kind != SlotKind::Perpendicular || oneSweep.fits())
                return std::nullopt;
            const double both = 2.0 * parameters.gaps.back();
            const double missing =
                widthToTurnInto(vehicle.length() + both, vehicle.width + both, options.aisleWidth) - slot.width;
            if (!(missing > 0.0))
                return std::nullopt;
            oneSweep.message +=
                "; nor does a car of this size get round the corner in any number of stretches: the "
                "slot would have to be " +
                formatNumber(std::ceil(1000.0 * missing) / 10.0) + " cm wider";
            return oneSweep;
        }
    }  // namespace

    Scenario slotProblem(const PlanningParameters &parameters, const Vehicle &vehicle, const ParkingSlot &slot,
                         const std::optional<Pose> &start)
    {
        const PlanningTuning &tuning = parameters.tuning;
        const double aisle = parameters.sweep.aisleWidth;
        Scenario problem;
        problem.name = "slot";
        problem.vehicle = vehicle;
        problem.slot = withSide(slot);
        problem.goals = problem.slot->goals(vehicle);
        problem.polygons = slotSurroundings(*problem.slot, problem.slot->side, aisle, tuning.reach);
        // Neighbours and walls are finite; the car must not drive round their ends.
        const double reach = 0.5 * slot.length + (std::isfinite(aisle) ? aisle : tuning.openAisle) + tuning.reach;
        problem.bounds = {{slot.pose.x - reach, slot.pose.y - reach}, {slot.pose.x + reach, slot.pose.y + reach}};
        if (start)
        {
            problem.start = *start;
            for (const Eigen::Vector2d &corner : vehicle.footprint(*start))
            {
                problem.bounds.min = problem.bounds.min.cwiseMin(corner - Eigen::Vector2d::Constant(vehicle.length()));
                problem.bounds.max = problem.bounds.max.cwiseMax(corner + Eigen::Vector2d::Constant(vehicle.length()));
            }
        }
        return problem;
    }

    ReverseParkingResult planSlotEntry(const ParkingPlanner &planner, const Vehicle &vehicle, const ParkingSlot &slot)
    {
        if (std::optional<ReverseParkingResult> verdict = hopeless(planner.parameters(), vehicle, withSide(slot)))
            return *verdict;
        const Scenario problem = slotProblem(planner.parameters(), vehicle, slot);
        return planner.planSlotEntry(problem, ParkingWorld(problem));
    }

    double smallestSlot(const ParkingPlanner &planner, const Vehicle &vehicle, const ParkingSlot &slot,
                        double precision)
    {
        if (!(precision > 0.0))
            throw Error("smallest slot: precision is " + formatNumber(precision) +
                        "; it must be a positive number of metres");
        const PlanningTuning &tuning = planner.parameters().tuning;
        const bool parallel = slot.kind == SlotKind::Parallel;
        double ParkingSlot::*const dimension = parallel ? &ParkingSlot::length : &ParkingSlot::width;
        const double least = (parallel ? vehicle.length() : vehicle.width) + 2.0 * planner.parameters().gaps.back();
        const auto fits = [&](const ParkingSlot &size)
        {
            return planSlotEntry(planner, vehicle, size).fits();
        };
        ParkingSlot tried = slot;
        tried.depth.reset();
        tried.lateralOffset = 0.0;
        tried.*dimension = std::max(slot.*dimension, least);
        for (double grown = 0.0; !fits(tried); grown += tuning.growthStep, tried.*dimension += tuning.growthStep)
            if (grown >= tuning.maxGrowth)
                return std::numeric_limits<double>::infinity();
        // By bisection, as larger slots are never worse.
        double low = least, high = tried.*dimension;
        while (high - low > precision)
        {
            tried.*dimension = 0.5 * (low + high);
            // The precision may be finer than the resolution of the numbers.
            if (!(tried.*dimension > low && tried.*dimension < high))
                break;
            (fits(tried) ? high : low) = tried.*dimension;
        }
        return high;
    }
}  // namespace parking
