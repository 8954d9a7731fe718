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
    // These functions answer whether and how a car enters a slot of given size, and how small the slot may be. The
    // world is that of slotSurroundings(), with the aisle of the planner's parameters().sweep. Slots without a side lie
    // on the right. Use a planner with PlanningParameters::intoTightSlots(). All functions throw parking::Error for an
    // invalid slot and for one smaller than the car, naming the missing centimetres.

    /** \brief The problem of parking in \e slot in its regular world, large enough for \e start if that is given.
        ParkingPlanner::plan() plans the whole path from there. */
    Scenario slotProblem(const PlanningParameters &parameters, const Vehicle &vehicle, const ParkingSlot &slot,
                         const std::optional<Pose> &start = std::nullopt);

    /** \brief Plans the part at the slot, from P in the aisle to the parked pose. The stretches of its path are those
        of the entry; neededSlotLength and neededAisleWidth are the sizes that one sweep requires. */
    ReverseParkingResult planSlotEntry(const ParkingPlanner &planner, const Vehicle &vehicle, const ParkingSlot &slot);

    /** \brief The minimum length of a parallel slot, or width of another one, in metres, that the car can enter in any
        number of stretches. The centre and the other sizes of \e slot are kept.

        It is found by bisection to \e precision metres, from \e slot or from larger ones if it is too small. The result
        is infinite if PlanningTuning::maxGrowth does not suffice. It is an upper bound, because the search may miss a
        path. */
    double smallestSlot(const ParkingPlanner &planner, const Vehicle &vehicle, const ParkingSlot &slot,
                        double precision = 0.01);
}  // namespace parking
