#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief Options of PathSmoother. */
    struct SmoothingOptions
    {
        /** Planned speed, m/s, at which the steering must follow the path. The vehicle's maximum speed limits it. */
        double speed{1.0};

        /** Lowest planned speed, m/s. If a transition does not fit at the planned speed, the smoother halves the speed
            down to this limit. Below it the car stops to steer. */
        double minSpeed{0.1};

        /** Deviation from the arcs, metres, that costs as much as steering at the full rate. Larger values result in
            softer steering and larger deviations. */
        double tolerance{0.05};
    };

    /** \brief A path whose curvature is continuous while the car moves. */
    struct SmoothPath
    {
        Path path;                       ///< arcs, lines and clothoids
        std::vector<std::size_t> stops;  ///< pieces before which the car stops to steer within a stretch
        bool free{true};                 ///< whether the world's callables accept the whole path
    };

    /** \brief Replaces a path of arcs and lines by one that a car can drive without steering at standstill.

        The method follows the paper, sections "Reverse Parking Planning Method" and "Bezier Curve Trajectory
        Optimization".

        In each stretch between cusps, pieces of linear curvature replace the arcs. Position, heading and curvature are
        continuous. The minimum turning radius limits the curvature, and the steering rate at the planned speed limits
        its change per metre. Start, goal and cusps keep their exact poses. The car stops there, so a stretch may begin
        and end with any curvature.

        The world's callables check the result. If the smooth curve of a stretch collides, the smoother repeats within
        the clearance on either side of its arcs. It then attempts lower speeds, whose sharper transitions deviate less.
        If this fails too, it divides the stretch: it joins as many arcs as possible, and the car stops to steer between
        the parts.

        Two arcs at full lock to opposite sides cannot be joined if there is no line before or after them. Plan with a
        turning radius 2 to 5 % above the minimum to avoid this case. */
    class PathSmoother
    {
    public:
        /** \brief Uses \e options for \e vehicle. Throws parking::Error naming an invalid vehicle or option. */
        explicit PathSmoother(const Vehicle &vehicle, const SmoothingOptions &options = {});

        /** \brief The smooth version of \e path. Throws parking::Error for clothoids and turns on the spot in \e
            path. */
        SmoothPath smooth(const Path &path, const FootprintQueries &world = {}) const;

    private:
        Vehicle vehicle_;
        SmoothingOptions options_;
    };
}  // namespace parking
