#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <functional>
#include <vector>

namespace parking
{
    /** \brief How far apart the states of a path may be for a space's own interpolation to follow the path.

        Of straight lines and turns on the spot the ends suffice everywhere. Spaces of curves go from state to state
        along arcs at their turning radius, too; an arc that turns less, or a clothoid, they would replace by a sharper
        arc and a line. */
    struct StateSpacing
    {
        double onArcs{0.0};         ///< metres; 0 where the ends of short arcs suffice
        double onGentleArcs{0.0};   ///< metres; 0 as above
        double turningRadius{0.0};  ///< metres; arcs that turn less are gentle
        /** Length in metres of a Reeds-Shepp space's curve between two poses, for straightened(); empty: nothing is
            straightened. */
        std::function<double(const Pose &, const Pose &)> curveLength;
    };

    /** \brief The spacing for a space.

        \param isPlain whether it is a plain SE2 space, with straight lines between its states
        \param turnsOnTheSpot whether the motion model's paths do */
    StateSpacing stateSpacing(bool isPlain, double turningRadius, bool turnsOnTheSpot);

    /** \brief The poses of \e path between which the space's own interpolation follows the path. */
    std::vector<Pose> pathStates(const Path &path, const StateSpacing &spacing);

    /** \brief The poses, and others in between where a Reeds-Shepp space would swerve instead of driving straight on.

        Of straight lines much shorter than the turning radius OMPL misses the shortest curve now and then, because of
        the last digits of their ends, and takes one of four arcs instead (measured with OMPL 1.5: 4 to 7 % of those up
        to 4 % of the radius, none from 8 % on, with coordinates below 50 m). Other digits will do. */
    std::vector<Pose> straightened(std::vector<Pose> poses, const StateSpacing &spacing);

    /** \brief Does a path that ends at \e pose end at one of the goals, but for rounding? */
    bool isAtGoal(const Pose &pose, const std::vector<Pose> &goals, double turningRadius);

    /** \brief Replaces the end of a path by the very goal that is nearest to it, of at least one. */
    void endAtGoal(std::vector<Pose> &poses, const std::vector<Pose> &goals, const StateSpacing &spacing,
                   bool turnsOnTheSpot);
}  // namespace parking
