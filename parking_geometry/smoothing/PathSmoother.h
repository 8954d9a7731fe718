#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <vector>

namespace parking
{
    struct GearSegment;

    struct SmoothingOptions
    {
        /** Planned speed, m/s, at which the steering must keep up; the vehicle's maximum where that is lower. */
        double speed{1.0};

        /** Where a transition has no room at the planned speed, slower ones are tried, each half as fast, down to this,
            m/s. Slower than that the car had better stop to steer. */
        double minSpeed{0.1};

        double step{0.1};  ///< metres between the states of the result, at most

        /** Deviation from the arcs, metres, that is worth steering at the full rate of the planned speed. Larger values
            give softer steering and larger deviations. */
        double tolerance{0.05};
    };

    /** \brief What became of a stretch between two changes of direction. */
    struct GearReport
    {
        std::size_t firstState{0};  ///< into SmoothPath::path: the pose where it begins
        std::size_t lastState{0};   ///< where it ends; the next one begins here
        double speed{0.0};          ///< m/s, the lowest planned speed that any of its transitions assumes
        std::size_t stops{0};       ///< joints that kept their jump of curvature: the car stops there to steer
        bool changed{false};        ///< false: it is what it was, for instance because it is one arc

        bool continuous() const
        {
            return stops == 0;
        }
    };

    /** \brief A drivable path whose curvature is continuous wherever the car moves. */
    struct SmoothPath
    {
        /** States at most SmoothingOptions::step apart, curvatures those of the curve at the state. A state where the
            car stops has the curvature and direction of arrival. */
        SampledPath path;

        /** Per state, the speed, m/s, up to which the steering keeps up with the change of curvature there, at most
            that of the vehicle; 0 where the car stops: first and last state, changes of direction, stops. */
        std::vector<double> speedLimit;

        Path pieces;                     ///< the same path in exact form
        std::vector<GearReport> gears;   ///< the stretches in order
        std::vector<std::size_t> stops;  ///< states inside of stretches where the car stops to steer
        double lengthBefore{0.0};        ///< metres, of the arcs
        bool free{true};                 ///< whether the world's callables agree, kept arcs included

        /** \brief Stretches of continuous curvature. */
        std::size_t continuousGears() const;
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

        SmoothPath smooth(const Path &path, const FootprintQueries &world = {}) const;

        /** \brief The same for a sampled path: between its states lie the circular arcs that their poses imply. */
        SmoothPath smooth(const SampledPath &path, const FootprintQueries &world = {}) const;

    private:
        SmoothPath smooth(const std::vector<GearSegment> &gears, const Pose &start,
                          const FootprintQueries &world) const;

        Vehicle vehicle_;
        SmoothingOptions options_;
    };
}  // namespace parking
