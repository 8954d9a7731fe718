#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"

#include <functional>
#include <vector>

namespace parking
{
    /** \brief A small planning problem: leave a slot that is too tight for a single sweep. */
    struct SlotExitTask
    {
        Pose parked;              ///< start of the search
        std::vector<Pose> exits;  ///< goals of the search, nearest first: poses along the aisle beyond the slot's mouth
        Box bounds;               ///< bounds of the search in the frame of the poses
        SlotEntry entry{SlotEntry::Reverse};  ///< entry of the later manoeuvre, Reverse or Forward
        SlotSide side{SlotSide::Right};       ///< side of the slot, Right or Left
    };

    /** \brief The task of leaving \e slot for an entry and a side.

        The exits lie along the aisle, in its middle if its width is known and otherwise close to the slots.
        Throws parking::Error like ParkingSlot::goals(). */
    SlotExitTask slotExitTask(const ReverseParking &parking, const ParkingSlot &slot, SlotEntry entry, SlotSide side);

    /** \brief A planner for exit tasks. Returns a path from \e parked to one of \e exits with any number of cusps, or a
        path without pieces if it finds none. */
    using SlotExitPlanner = std::function<Path(const SlotExitTask &)>;

    /** \brief Plans a single sweep if one fits, otherwise a manoeuvre of several stretches from the paths of \e
        planner.

        A path of the planner must begin at the parked pose, end at an exit (1e-6 m, 1e-6 rad) and pass the world's
        callables. The manoeuvre is this path reversed, with radii of 0. Among the allowed entries and sides, the
        function selects the fewest stretches, then the shortest path. If no path is valid, it returns the result of the
        single sweep.

        Throws parking::Error like ReverseParking::plan() and if a path of the planner violates these conditions. */
    ReverseParkingResult planInStretches(const ReverseParking &parking, const ParkingSlot &slot,
                                         const FootprintQueries &world, const SlotExitPlanner &planner);
}  // namespace parking
