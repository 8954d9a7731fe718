#pragma once

#include "benchmarks/plan/Problem.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/referee/Referee.h"

#include <ompl/geometric/PathGeometric.h>

#include <cstddef>

namespace parking
{
    /** \brief A planner's path as a car may drive it, with its measurements, in local coordinates of the scenario. */
    struct PlannedPath
    {
        Path path;              ///< path from the scenario's start; see readPath()
        Pose end;               ///< end of the path; exactly the goal when the solution is exact
        double length{0.0};     ///< metres
        std::size_t cusps{0};   ///< changes of direction
        double clearance{0.0};  ///< minimum distance in metres between body (or disc) and obstacles; 0 in collision
        Verdict recheck;        ///< result of the referee for the states that the planner returned

        /** \brief States of the path at most samplingOf(path.length(), recheck.valid) apart; the last one is \e end. */
        SampledPath states() const;

        static constexpr double SAMPLING = 0.1;  ///< metres between states, see samplingOf()
    };

    /** \brief Maximum distance in metres between states of a path: PlannedPath::SAMPLING, or more on long invalid
       paths.

       A plug-in may return a path of a million metres, for which such detail has no use. */
    double samplingOf(double length, bool valid);

    /** \brief Reads and measures a solution of \e problem.

        In a Reeds-Shepp or Dubins space the arcs are those that the space interpolates along. Pieces shorter than a
        tenth of a micrometre are rounding and left out.

        In a plain SE2 space a motion is a straight line along which the heading turns evenly, in any direction of
        travel. Length, clearance and the recheck refer to these lines. No car moves like that, so the path approximates
        them by the car model. Where the heading follows the direction of travel, as on smooth curves, a motion becomes
        the two arcs that join its ends exactly. Any other motion becomes a turn to the direction of the line, the line,
        and a turn to its final heading. For the paper's grid paths, whose headings are those of their lines, this is
        exactly the planned path.

        An exact path of one state, or of two within 1e-5 m and 1e-5 rad, has no motion: the start is at a goal.

        A path is read up to its first state outside of the world, for example one that is not finite.

        \param exact whether the planner reports that the path ends at a goal. If it does up to rounding, the end is set
        to that goal */
    PlannedPath readPath(const Problem &problem, const ompl::geometric::PathGeometric &path, bool exact);
}  // namespace parking
