#pragma once

#include "benchmarks/plan/Problem.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/referee/Referee.h"

#include <ompl/geometric/PathGeometric.h>

#include <cstddef>

namespace parking
{
    /** \brief A planner's path as a car may drive it, with what was measured along it. Local coordinates of the
        scenario. */
    struct PlannedPath
    {
        Path path;              ///< from the scenario's start; see readPath()
        Pose end;               ///< of the path; the goal itself when the solution is exact
        double length{0.0};     ///< metres
        std::size_t cusps{0};   ///< changes of direction
        double clearance{0.0};  ///< metres between body (or disc) and obstacles, the least; 0 in collision
        Verdict recheck;        ///< by code of its own, on what the planner returned

        /** \brief States of the path no more than samplingOf(path.length(), recheck.valid) apart, the last one at \e
         * end. */
        SampledPath states() const;

        static constexpr double SAMPLING = 0.1;  ///< metres between states, see samplingOf()
    };

    /** \brief How far the states of a path may lie apart, in metres: PlannedPath::SAMPLING; more along one that is very
       long and not valid. What a plug-in calls a path may be a million metres, of which nobody needs every one. */
    double samplingOf(double length, bool valid);

    /** \brief Reads and measures a solution of \e problem.

        In a Reeds-Shepp or Dubins space the arcs are those that the space interpolates along; pieces shorter than a
        tenth of a micrometre are rounding and left out.

        In a plain SE2 space the planner means straight lines along which the heading turns evenly, whatever the
        direction of travel. That is what length, clearance and the recheck are about. No car moves like that, so the
        path is as near to it as the model of a car allows: where the heading keeps to the direction of travel, as on
        somebody's smooth curve, a motion becomes the two arcs that join its ends exactly; any other becomes a turn on
        the spot to the direction of the line, the line, and a turn to the heading at its end. For the paper's grid
        paths, whose headings are those of their lines, this is exactly what was planned.

        A path whose states are no places in the world (not finite, say) is not read any further than that.

        \param exact the planner says that the path ends at a goal; where it does, but for rounding, the end is set to
        that goal */
    PlannedPath readPath(const Problem &problem, const ompl::geometric::PathGeometric &path, bool exact);
}  // namespace parking
