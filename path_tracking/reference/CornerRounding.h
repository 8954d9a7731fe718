#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <optional>

namespace parking
{
    /** \brief What roundCorners() made of a stretch. */
    struct RoundedCorners
    {
        Path path;               ///< drivable, in one direction
        double deviation{0.0};   ///< metres, the farthest that the rear axle is from the stretch
        double worstPlace{0.0};  ///< metres along the stretch since its begin where that is
        bool following{false};   ///< whether the car could follow at all
    };

    /** \brief Cuts the corners of \e stretch as a car has to.

        No car turns on the spot. The stretch is driven by a simulated car that aims at a point ahead on it (pure
        pursuit; R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm", CMU-RI-TR-92-01), with the
        steering limit and no more than \e steeringSlope radians of steering per metre, from \e start. Of several
        distances to the point ahead, from a quarter to twice the turning radius, the one with the least deviation is
        taken. Behind the last corner the car returns to the stretch: once it is within 5 mm and 0.3 degrees, two gentle
        arcs lead it there exactly, and what is left is driven as it is. Where there is no room for that it ends beside
        the end of the stretch.

        A lone corner of angle c is cut by little more than R (1 / cos(c / 2) - 1), the distance from the corner to the
        arc of the turning radius R that touches both chords.

        \param stretch pieces of one direction, with turns on the spot between them but none at either end */
    RoundedCorners roundCorners(const Path &stretch, const Pose &start, const Vehicle &vehicle, double steeringSlope);

    /** \brief The way of a car at \e car, which is beside \e stretch by rounding or little more, onto it, and the rest
        of it: two arcs over a metre from \e from metres on, then the stretch's own pieces.

        \return nothing when there is no such way within the steering limit: the stretch is too short, or full lock
        leaves no room to correct */
    std::optional<Path> joinStretch(const Path &stretch, double from, const Pose &car, const Vehicle &vehicle);
}  // namespace parking
