#pragma once

#include "automatic_parking/ParkingPlanner.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"

#include <optional>

namespace parking
{
    // Questions about slots of which only the size is known: does the car get in, how, and how small may they be? The
    // world is that of slotSurroundings(), with the aisle of the planner's parameters().sweep; slots that do not say
    // their side lie on the right. The planner should be one of PlanningParameters::intoTightSlots(). All functions
    // throw parking::Error for an invalid slot and for one smaller than the car, naming the missing centimetres.

    /** \brief The problem: \e slot in its regular world, large enough for \e start where that is given; all the way
       from there is what ParkingPlanner::plan() makes of it. */
    Scenario slotProblem(const PlanningParameters &parameters, const Vehicle &vehicle, const ParkingSlot &slot,
                         const std::optional<Pose> &start = std::nullopt);

    /** \brief The part at the slot: from P in the aisle to the parked pose. Its path says in how many stretches,
        neededSlotLength and neededAisleWidth what one sweep would need. */
    ReverseParkingResult wayIntoSlot(const ParkingPlanner &planner, const Vehicle &vehicle, const ParkingSlot &slot);

    /** \brief The shortest parallel slot, or the narrowest other one, in metres, that the car gets into in however many
        stretches; centre, and the rest of \e slot, stay as they are.

        By bisection to \e precision metres, from \e slot, or from larger ones where it does not fit; infinite when
        PlanningTuning::mostGrowth more does not do. An upper bound: the search may have overlooked a way. */
    double smallestSlot(const ParkingPlanner &planner, const Vehicle &vehicle, const ParkingSlot &slot,
                        double precision = 0.01);
}  // namespace parking
