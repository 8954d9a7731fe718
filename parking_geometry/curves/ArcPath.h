#pragma once

#include "parking_geometry/Pose.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A piece of constant curvature. */
    struct ArcSegment
    {
        double curvature{0.0};  ///< 1/m, positive to the left
        double length{0.0};     ///< metres, negative when driven in reverse
    };

    /** \brief One state of a sampled path; curvature and direction are those with which it is reached (the first state:
        those with which it is left). */
    struct PathState
    {
        Pose pose;
        double arcLength{0.0};  ///< metres driven since the start, never decreasing
        double curvature{0.0};  ///< 1/m, positive to the left
        int direction{1};       ///< 1 forwards, -1 in reverse
    };

    /** \brief A path as a sequence of states, each at most the sampling step after the last; between two states the car
        drives a circular arc. Curvature and direction are carried along, never guessed back from the poses. */
    using Path = std::vector<PathState>;

    /** \brief A drivable path in exact form: a start pose and pieces of constant curvature. */
    struct ArcPath
    {
        Pose start;
        std::vector<ArcSegment> segments;

        /** \brief Metres driven, both directions counted positive. */
        double length() const;

        /** \brief Number of changes between forwards and reverse. */
        std::size_t cusps() const;

        /** \brief The pose at the end, yaw wrapped. */
        Pose end() const;

        /** \brief The same motion driven backwards from its end to its start. */
        ArcPath reversed() const;

        /** \brief Adds a piece; pieces of no length are dropped and equal neighbours are merged. */
        void append(const ArcSegment &segment);

        /** \brief States no more than \e step metres apart, with every end of a piece among them.

            \param step metres, positive
            The last state of the sample is end() up to rounding. */
        Path sample(double step) const;
    };

    /** \brief Metres driven along \e path. */
    double pathLength(const Path &path);

    /** \brief Number of changes of direction along \e path. */
    std::size_t countCusps(const Path &path);
}  // namespace parking
