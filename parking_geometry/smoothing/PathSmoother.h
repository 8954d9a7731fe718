#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief How PathSmoother makes curvature continuous. */
    struct SmoothingOptions
    {
        /** Planned speed, m/s, at which the steering must keep up; the vehicle's maximum where that is lower. */
        double speed{1.0};

        /** Where a transition has no room at the planned speed, slower ones are tried, each half as fast, down to this,
            m/s. Slower than that the car had better stop to steer. */
        double minSpeed{0.1};

        /** Deviation from the arcs, metres, that is worth steering at the full rate of the planned speed. Larger values
            give softer steering and larger deviations. */
        double tolerance{0.05};
    };

    /** \brief A path whose curvature is continuous wherever the car moves, and what smoothing did to get there. */
    struct SmoothPath
    {
        Path path;                       ///< of arcs, lines and clothoids
        std::vector<std::size_t> stops;  ///< pieces before which the car stops to steer, ends of stretches apart
        bool free{true};                 ///< whether the world's callables agree, kept arcs included
    };

    /** \brief Turns a path of arcs and lines, the planner's or a manoeuvre's, into one that a car can drive without
        stopping to steer (paper, sections "Reverse Parking Planning Method" and "Bezier Curve Trajectory
        Optimization").

        Per stretch between changes of direction the arcs are replaced by pieces of linear curvature: position and
        heading are continuous, the curvature is continuous and bounded by that of the minimum turning radius, and its
        change per metre by what the steering can do at the planned speed. Start, goal and every change of direction
        keep their exact poses. The car stands at those, so that a stretch may begin and end with any curvature.

        The result is checked by the world's callables. A stretch whose smooth curve collides is smoothed again within
        what the clearance callable promises to be free on either side of its arcs, then at lower speeds, whose sharper
        transitions deviate less. What still does not fit is divided: as many arcs as possible are joined smoothly, and
        where two cannot be, the car stops to steer. Two arcs at full lock, one to each side, with no line before or
        after them never can: a car that turns no tighter than planned has no other way to the same end pose. Plan with
        a turning radius 2 to 5 % above the smallest to leave the room. */
    class PathSmoother
    {
    public:
        /** \brief Throws parking::Error for an invalid vehicle or option, naming it. */
        explicit PathSmoother(const Vehicle &vehicle, const SmoothingOptions &options = {});

        /** \brief Throws parking::Error for pieces that are no arcs or lines: clothoids and turns on the spot. */
        SmoothPath smooth(const Path &path, const FootprintQueries &world = {}) const;

    private:
        Vehicle vehicle_;
        SmoothingOptions options_;
    };
}  // namespace parking
