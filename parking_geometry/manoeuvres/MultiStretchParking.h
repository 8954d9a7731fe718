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
    /** \brief Leaving a slot that is too tight for one sweep: a small planning problem, to be solved out of the
        slot. */
    struct SlotExitTask
    {
        Pose parked;  ///< where the search begins
        std::vector<Pose>
            exits;   ///< any of these will do: in the aisle, along it, beyond the slot's mouth; nearest first
        Box bounds;  ///< within which to look, in the frame of the poses
        SlotEntry entry{SlotEntry::Reverse};  ///< Reverse or Forward
        SlotSide side{SlotSide::Right};       ///< Right or Left
    };

    /** \brief The task for \e slot, entered that way.

        The exits lie along the aisle, in its middle where its width is known and close to the slots otherwise. Throws
        parking::Error like ParkingSlot::goals(). */
    SlotExitTask slotExitTask(const ReverseParking &parking, const ParkingSlot &slot, SlotEntry entry, SlotSide side);

    /** \brief A planner for such tasks: a path from \e parked to one of \e exits, as many changes of direction as it
        takes; without pieces when there is none. */
    using SlotExitPlanner = std::function<Path(const SlotExitTask &)>;

    /** \brief In one sweep where that fits, otherwise in several stretches found by \e planner.

        The planner's path is checked: it must begin at the parked pose and end at an exit (1e-6 m, 1e-6 rad) and pass
        the world's callables. Reversed it is the manoeuvre; its path counts its stretches, and
        the radii are 0. Among the allowed entries and sides the one with the fewest stretches wins, then the
        shortest. When none works, the verdict is that of the single sweep.

        Throws parking::Error like ReverseParking::plan(), and when the planner's path is none of the above. */
    ReverseParkingResult planInStretches(const ReverseParking &parking, const ParkingSlot &slot,
                                         const FootprintQueries &world, const SlotExitPlanner &planner);
}  // namespace parking
