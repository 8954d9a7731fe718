#pragma once

#include <string>

namespace parking
{
    /** \brief How a parking manoeuvre ended. */
    enum class ParkingStatus
    {
        Parked,        ///< the car stands where it was asked to
        InvalidStart,  ///< the car touches an obstacle, or is outside of the world, where it starts
        InvalidGoal,   ///< it would where it shall stand
        NoPath,        ///< the planner found no path within its time
        NotDrivable,   ///< the path cannot be driven: a curvature that the car has not, for example
        Collision,     ///< the driven body touched an obstacle
        Stopped,       ///< a safe stop on the way, and no replanning left or allowed
        MissedGoal     ///< it stands, but farther from the goal than the tolerances say
    };

    /** \brief Names as in results: parked, invalid_start, invalid_goal, no_path, not_drivable, collision, stopped,
        missed_goal. */
    std::string toString(ParkingStatus status);
}  // namespace parking
