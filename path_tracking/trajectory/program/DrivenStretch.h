#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/program/MotionGuess.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief What a motion drives between two standstills. */
    struct DrivenStretch
    {
        int direction{1};                ///< 1 forwards, -1 in reverse
        std::vector<GuessPoint> points;  ///< poses and steering angles some centimetres apart
        double length{0.0};              ///< metres
    };

    /** \brief The stretches of the motion whose nodes a problem has, in order. */
    std::vector<DrivenStretch> stretchesOf(const MotionProblem &problem);

    /** \brief The stretches without one of them.

        Its neighbours are cut where they come nearest to each other, or to the end of the motion if it was the first or
        the last, and bent to meet there. So they are a guess: no car can drive the bend exactly, and it may touch
        something. Neighbours on both sides become one stretch: between two cusps, two cusps go.

        \return nothing when there would be no stretch left */
    std::vector<DrivenStretch> withoutStretch(const std::vector<DrivenStretch> &stretches, std::size_t index);

    /** \brief Drives along the stretches, one each. */
    std::vector<StretchGuess> guessesAlong(const std::vector<DrivenStretch> &stretches, const Vehicle &vehicle);
}  // namespace parking
