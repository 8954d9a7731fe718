#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief A moment of a guessed motion. */
    struct GuessPoint
    {
        double t{0.0};         ///< seconds since the begin of the stretch
        Pose pose;             ///< yaw not wrapped
        double speed{0.0};     ///< m/s, not negative
        double steering{0.0};  ///< radians
    };

    /** \brief How a stretch of a path might be driven: along the path as fast as the acceleration allows, the steering
        angle smoothed over some way round its jumps, however fast the wheels would have to turn. Where an optimisation
        begins: nodes that are spread evenly over such a drive leave it the most freedom. */
    class StretchGuess
    {
    public:
        /** \param path in one direction, without turns on the spot */
        StretchGuess(const Path &path, const Vehicle &vehicle);

        /** \brief A drive through poses, whose steering angles are taken as they are.
            \param points two at least, in order, with pose and steering angle; time and speed are made anew */
        StretchGuess(int direction, std::vector<GuessPoint> points, const Vehicle &vehicle);

        /** \brief 1 forwards, -1 in reverse. */
        int direction() const
        {
            return direction_;
        }

        /** \brief Poses and steering angles some centimetres apart. */
        const std::vector<GuessPoint> &points() const
        {
            return points_;
        }

        /** \brief Metres. */
        double length() const;

        /** \brief Seconds. */
        double duration() const
        {
            return points_.back().t;
        }

        /** \brief When it ceases to speed up, and when it begins to brake: seconds, of a short stretch the same twice.
         */
        std::pair<double, double> fastest() const;

        /** \brief At \e t seconds, cut to the stretch. */
        GuessPoint at(double t) const;

    private:
        void setSpeeds(const std::vector<double> &ways, const Vehicle &vehicle);

        int direction_;
        std::vector<GuessPoint> points_;
    };

    /** \brief The stretches of a path; yaw continuous along it. */
    std::vector<StretchGuess> guessesAlong(const Path &path, const Vehicle &vehicle);

    /** \brief The stretches of the motion whose nodes a problem has, in order. */
    std::vector<StretchGuess> stretchesOf(const MotionProblem &problem, const Vehicle &vehicle);

    /** \brief The stretches without one of them.

        Its neighbours are cut where they come nearest to each other, or to the end of the motion if it was the first or
        the last, and bent to meet there. So they are a guess: no car can drive the bend exactly, and it may touch
        something. Neighbours on both sides become one stretch: between two cusps, two cusps go.

        \return nothing when there would be no stretch left */
    std::vector<StretchGuess> withoutStretch(const std::vector<StretchGuess> &stretches, std::size_t index,
                                             const Vehicle &vehicle);
}  // namespace parking
