#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/reference/PathSections.h"

#include <vector>

namespace parking
{
    /** \brief A drivable stand-in for a section whose heading jumps. */
    struct RoundedSection
    {
        std::vector<PathNode> nodes;  ///< drivable arcs, no more than 5 cm each
        double deviation{0.0};        ///< metres, the farthest that the rear axle is from the section
        double worstPlace{0.0};       ///< metres of chords since its begin where that is
    };

    /** \brief Cuts the corners of \e section as a car has to.

        No car drives a jump of its heading. The section is driven by a simulated car that aims at a point ahead on it
        (pure pursuit; R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm", CMU-RI-TR-92-01),
        with the steering limit and no more than \e steeringSlope radians of steering per metre, from \e start. Of
        several distances to the point ahead, from a quarter to twice the turning radius, the one with the least
        deviation is taken. Behind the last corner the car returns to the section, and as soon as it is there (5 mm,
        0.3 degrees) the section is kept as it is. The car ends beside the end of the section.

        A lone corner of angle c is cut by little more than R (1 / cos(c / 2) - 1), the distance from the corner to the
        arc of the turning radius R that touches both chords.

        \return the deviation is infinite when the car cannot follow at all (a heading against the direction of travel,
        for example) */
    RoundedSection roundCorners(const PathSection &section, const Pose &start, const Vehicle &vehicle,
                                double steeringSlope);
}  // namespace parking
