#pragma once

#include "automatic_parking/ParkingWorld.h"
#include "automatic_parking/PlanningParameters.h"
#include "ompl_improved_astar/search/SearchContext.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "parking_geometry/smoothing/PathSmoother.h"

#include <cstddef>
#include <string>

namespace parking
{
    /** \brief Final status of a parking manoeuvre. */
    enum class ParkingStatus
    {
        Parked,        ///< the car stands at the required goal
        InvalidStart,  ///< the car collides or is outside the world at its start
        InvalidGoal,   ///< the car would collide or be outside the world at every goal
        NoPath,        ///< the planner found no path within its limits
        NotDrivable,   ///< the path cannot be driven: its curvature exceeds the car's, for example
        Collision,     ///< the driven body touched an obstacle
        Stopped,       ///< a safe stop during the drive, without a replan left or allowed
        MissedGoal     ///< the car stands farther from the goal than the tolerances allow
    };

    /** \brief Names as in results: parked, invalid_start, invalid_goal, no_path, not_drivable, collision, stopped,
        missed_goal. */
    std::string toString(ParkingStatus status);

    /** \brief Result of planning, stage by stage. */
    struct ParkingPlan
    {
        bool found{false};                             ///< whether there is a path, or the car already stands at a goal
        ParkingStatus failure{ParkingStatus::NoPath};  ///< reason of the failure, if no path was found
        std::string message;                           ///< one line: the kind of plan, or the reason of the failure

        Pose goal;      ///< the chosen goal
        Path approach;  ///< the part found by the search
        /** The part at the slot. Its path has no pieces if the search planned the whole path. Without a slot entry it
            contains the reason why the first gap failed. */
        ReverseParkingResult manoeuvre;
        Path arcs;  ///< approach and manoeuvre as arcs and lines; no pieces if the car already stands at the goal
        SmoothPath smooth;  ///< result of the smoother; empty if disabled or rejected
        Path path;          ///< the path to drive: the smooth one, or \e arcs
        /** Metres kept around the body while planning; the smoother may use half of it in tight slots. */
        double gap{0.0};
        double turningRadius{0};  ///< metres, planned turning radius
        double clearance{0.0};    ///< metres, minimum between body and obstacles along \e path, to 1 mm or 1 %

        double loadingTime{0.0};          ///< seconds, for obstacles and distance fields
        double planningTime{0.0};         ///< seconds, for all attempts
        double smoothingTime{0.0};        ///< seconds
        double cost{0.0};                 ///< metres: length and penalties of the parameters
        std::size_t attempts{0};          ///< number of searches started
        search::SearchStatistics search;  ///< of all attempts
    };

    /** \brief Plans the path of a car from its start to its goal (paper, "Overall Workflow").

        The planner makes attempts with decreasing gaps around the body. Each of them:
        1. constructs slot entries (ReverseParking), or searches one out of the slot (planInStretches()),
        2. plans to the start of one of them, or all the way to the goal,
        3. is compared with the best so far: by cost and gap, or, InStretches, by the number of stretches at the slot.

        The best path is smoothed as a whole. Without a slot the search plans the whole path. A car that already stands
        at a goal receives a path without pieces. Equal inputs give equal paths if the time suffices. */
    class ParkingPlanner
    {
    public:
        /** \brief Throws parking::Error for parameters out of their range.

            \param contact of the worlds that plan() creates, see ParkingWorld */
        explicit ParkingPlanner(const PlanningParameters &parameters = {}, ContactTestMaker contact = {});

        /** \brief The parameters as given. */
        const PlanningParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Plans from scenario.start. An unsolvable problem is a result, not an exception.

            Throws parking::Error for an invalid scenario: no goal, an invalid car or slot, or a slot smaller than the
            car in a world with enough space. */
        ParkingPlan plan(const Scenario &scenario) const;

        /** \brief Plans as plan(scenario) does, in an existing world. */
        ParkingPlan plan(const Scenario &scenario, const ParkingWorld &world) const;

        /** \brief Plans only the part at the slot, for any start: the manoeuvre that fits, or the reason why none does.

            Throws parking::Error for a scenario without a slot, for an invalid slot, and for one smaller than the car,
            naming the missing centimetres. */
        ReverseParkingResult planSlotEntry(const Scenario &scenario, const ParkingWorld &world) const;

    private:
        PlanningParameters parameters_;
        ContactTestMaker contact_;
    };
}  // namespace parking
