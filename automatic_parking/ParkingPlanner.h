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
    /** \brief How a parking manoeuvre ended. */
    enum class ParkingStatus
    {
        Parked,        ///< the car stands where it was asked to
        InvalidStart,  ///< the car touches an obstacle, or is outside of the world, where it starts
        InvalidGoal,   ///< it would at its goal
        NoPath,        ///< the planner found no path within its time
        NotDrivable,   ///< the path cannot be driven: a curvature that the car has not, for example
        Collision,     ///< the driven body touched an obstacle
        Stopped,       ///< a safe stop on the way, and no replanning left or allowed
        MissedGoal     ///< it stands, but farther from the goal than the tolerances say
    };

    /** \brief Names as in results: parked, invalid_start, invalid_goal, no_path, not_drivable, collision, stopped,
        missed_goal. */
    std::string toString(ParkingStatus status);

    /** \brief What planning came to, stage by stage. */
    struct ParkingPlan
    {
        bool found{false};                             ///< is there a path, or does the car stand at a goal?
        ParkingStatus failure{ParkingStatus::NoPath};  ///< why not, when nothing was found
        std::string message;                           ///< one line: what was planned, or why nothing was

        Pose goal;      ///< the one that was chosen
        Path approach;  ///< the planner's part
        /** The part at the slot; its path has no pieces where the planner did it all. When no way in was found: what
           the first gap was missing. */
        ReverseParkingResult manoeuvre;
        Path arcs;                ///< both, arcs and lines; no pieces where the car stands at the goal already
        SmoothPath smooth;        ///< what the smoother made of it; empty when it was not asked or refused
        Path path;                ///< to be driven: the smooth one, or \e arcs
        double gap{0.0};          ///< metres kept all round the body while planning; the smoother may use half of it
                                  ///< in tight slots
        double turningRadius{0};  ///< metres, planned with
        double clearance{0.0};    ///< metres, least between body and obstacles along \e path, to 1 mm or 1 %

        double loadingTime{0.0};          ///< seconds, obstacles and distance fields
        double planningTime{0.0};         ///< seconds, all tries
        double smoothingTime{0.0};        ///< seconds
        double cost{0.0};                 ///< metres: length and what the parameters add to it
        std::size_t tries{0};             ///< searches begun
        search::SearchStatistics search;  ///< of all tries
    };

    /** \brief Plans how a car gets from its start to its goal (paper, "Overall Workflow").

        A ladder of tries, from a wide gap round the body to a narrow one. Each of them:
        1. constructs the ways into the slot (ReverseParking), or searches one out of the slot (planInStretches()),
        2. brings the car to where one of them begins, or plans all the way to the goal,
        3. is compared with the best so far: by cost and gap, or, InStretches, by the number of stretches at the slot.

        The best is smoothed as one. For goals without a slot the search goes all the way; a car that stands at a goal
        already gets a path without pieces. Equal inputs give equal paths as long as the time suffices. */
    class ParkingPlanner
    {
    public:
        /** \brief Throws parking::Error for parameters out of their range.

            \param contact of the worlds that plan() makes, see ParkingWorld */
        explicit ParkingPlanner(const PlanningParameters &parameters = {}, ContactTestMaker contact = {});

        /** \brief The parameters as given. */
        const PlanningParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Plans from scenario.start; never throws for a problem that has no solution.

            Throws parking::Error for an invalid scenario: no goal, a car or a slot that is not valid, a slot
            smaller than the car in a world that has room for the car there. */
        ParkingPlan plan(const Scenario &scenario) const;

        /** \brief The same in a world that is there already. */
        ParkingPlan plan(const Scenario &scenario, const ParkingWorld &world) const;

        /** \brief The part at the slot alone, wherever the car comes from: which manoeuvre fits, or why none does.

            Throws parking::Error for a scenario without a slot, and for an invalid slot and one smaller than the car,
            naming the missing centimetres. */
        ReverseParkingResult wayIn(const Scenario &scenario, const ParkingWorld &world) const;

    private:
        PlanningParameters parameters_;
        ContactTestMaker contact_;
    };
}  // namespace parking
