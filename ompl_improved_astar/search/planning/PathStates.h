#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <functional>
#include <vector>

namespace parking
{
    /** \brief Largest distance between states of a path at which a space's own interpolation follows the path.

        For straight lines and turns on the spot the ends suffice. Curve spaces also connect states by arcs at their
        turning radius; they would replace a gentler arc or a clothoid by a sharper arc and a line. */
    struct StateSpacing
    {
        double onArcs{0.0};         ///< metres; 0 where the ends of short arcs suffice
        double onGentleArcs{0.0};   ///< metres; 0 where the ends of short gentle arcs suffice
        double turningRadius{0.0};  ///< metres; arcs that turn less are gentle
        /** Length in metres of the curve of a Reeds-Shepp space between two poses, for straightened(); empty in other
            spaces. */
        std::function<double(const Pose &, const Pose &)> curveLength;
    };

    /** \brief Largest distance, in turning radii, between states that are checked along a motion if the validity
       checker supports states only. */
    constexpr double CHECK_STEP = 0.02;

    /** \brief Returns the spacing for a space.

        \param isPlain whether it is a plain SE2 space, which interpolates by straight lines \param turnsOnTheSpot
        whether paths of the motion model turn on the spot */
    StateSpacing stateSpacing(bool isPlain, double turningRadius, bool turnsOnTheSpot);

    /** \brief Returns the poses of \e path between which the space's own interpolation follows the path. */
    std::vector<Pose> pathStates(const Path &path, const StateSpacing &spacing);

    /** \brief Adds poses where a Reeds-Shepp space would swerve instead of driving straight.

        For some straight lines much shorter than the turning radius, rounding makes OMPL miss the shortest curve and
        return four arcs instead (OMPL 1.5: lines up to 8 % of the radius). Slightly different poses avoid this. */
    std::vector<Pose> straightened(std::vector<Pose> poses, const StateSpacing &spacing);

    /** \brief Whether \e pose is one of the goals up to rounding. */
    bool isAtGoal(const Pose &pose, const std::vector<Pose> &goals, double turningRadius);

    /** \brief Replaces the end of a path by the nearest goal, of at least one. */
    void endAtGoal(std::vector<Pose> &poses, const std::vector<Pose> &goals, const StateSpacing &spacing,
                   bool turnsOnTheSpot);
}  // namespace parking
