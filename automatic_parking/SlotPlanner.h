#pragma once

#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "parking_geometry/smoothing/PathSmoother.h"
#include "state_validity/ObstacleSet.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace parking
{
    struct SlotPlannerOptions
    {
        /** Of the manoeuvre in one sweep. Its aisle width also bounds the world where no obstacles are given. */
        ReverseParkingOptions sweep;

        /** Planned turning radius over the smallest one: the reserve that smoothing needs. Where nothing else gets
            through, full lock is used. At least 1. */
        double radiusFactor{1.03};

        /** Gap all round the body, metres, that manoeuvres in several stretches may go down to, from that of the
            sweep. */
        double leastClearance{0.01};

        /** Expansions after which a search gives up. */
        std::uint64_t effort{60000};

        SmoothingOptions smoothing;
    };

    /** \brief The way of a car from the aisle into a slot. */
    struct SlotPlan
    {
        ReverseParkingResult manoeuvre;  ///< the part at the slot, or why there is none
        bool solved{false};
        std::string message;  ///< one line: what is wrong, when not solved

        Path path;          ///< from the start to the parked pose, arcs and lines; no pieces unless solved
        SmoothPath smooth;  ///< the same, drivable; re-checked by the swept footprint

        /** Gap, metres, that path keeps all round the body (to a millimetre); smooth keeps at least half of it. */
        double clearance{0.0};
    };

    /** \brief Parks a car in a slot, in one sweep where that fits and in several stretches where not.

        1. The one-sweep manoeuvre of ReverseParking, checked against the world by the swept footprint.
        2. Where no sweep fits, planInStretches() with the planner's car model: shunts, searched out of the slot. The
          gap kept is that of the sweep, then 2 cm, then leastClearance: smaller ones where nothing else gets through,
          or where many stretches become a quarter fewer.
        3. The planner brings the car to the manoeuvre's beginning P. Where the manoeuvre cannot be reached, the planner
          goes all the way to the parked pose.
        4. Both are joined and smoothed as one.

        Equal inputs give equal outputs: searches end by expansions, not by the clock.

        Where no obstacles are given, the slot is taken to lie in the world of slotSurroundings(); slots that do not say
        their side lie on the right then. All methods throw parking::Error for an invalid slot and for one smaller than
        the car, naming the missing centimetres. */
    class SlotPlanner
    {
    public:
        /** \brief Throws parking::Error for an invalid vehicle or option, naming it. */
        explicit SlotPlanner(const Vehicle &vehicle, const SlotPlannerOptions &options = {});

        /** \brief The part at the slot: from P in the aisle to the parked pose. its path says in
            how many stretches, neededSlotLength and neededAisleWidth what one sweep would need. */
        ReverseParkingResult manoeuvre(const ParkingSlot &slot) const;
        ReverseParkingResult manoeuvre(const ParkingSlot &slot, const ObstacleSet &world) const;

        /** \brief All the way from \e start.

            Throws parking::Error when the car at \e start already reaches into the slot, or beyond the aisle, saying
            how far (see checkStart()). */
        SlotPlan plan(const ParkingSlot &slot, const Pose &start) const;
        SlotPlan plan(const ParkingSlot &slot, const Pose &start, const ObstacleSet &world) const;

        /** \brief The shortest parallel slot, or the narrowest other one, in metres, that the car gets into in however
            many stretches, in the world of slotSurroundings(); centre, and the rest of \e slot, stay as they are.

            By bisection to \e precision metres, from \e slot, or from larger ones where it does not fit; infinite when
            2 m more do not do. An upper bound: the search may have overlooked a way. */
        double smallestSlot(const ParkingSlot &slot, double precision = 0.01) const;

        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        const SlotPlannerOptions &options() const
        {
            return options_;
        }

    private:
        /** A manoeuvre and the conditions under which it was found. */
        struct Found
        {
            ReverseParkingResult manoeuvre;
            std::vector<ReverseParkingResult> sweeps;  ///< all that fit, when it is one sweep
            double clearance;
            double radiusFactor;
        };

        /** \param regular the world is that of slotSurroundings() */
        Found find(const ParkingSlot &slot, const ObstacleSet &world, bool regular) const;
        SlotPlan plan(const ParkingSlot &slot, const Pose &start, const ObstacleSet &world, bool regular) const;

        Vehicle vehicle_;
        SlotPlannerOptions options_;
    };
}  // namespace parking
