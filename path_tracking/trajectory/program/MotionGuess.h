#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief Point of a guessed motion. */
    struct GuessPoint
    {
        double t{0.0};         ///< seconds since the start of the stretch
        Pose pose;             ///< yaw not wrapped
        double speed{0.0};     ///< m/s, not negative
        double steering{0.0};  ///< radians
    };

    /** \brief Initial guess of a drive along a stretch, as fast as the acceleration allows.

        The steering angle is smoothed near its jumps; the guess ignores the steering rate. Nodes spread evenly over
        such a drive give the optimisation the most freedom. */
    class StretchGuess
    {
    public:
        /** \param path in one direction, without turns on the spot
            \param initialSpeed m/s at its start, not negative */
        StretchGuess(const Path &path, const Vehicle &vehicle, double initialSpeed = 0.0);

        /** \brief A drive through given poses and steering angles.
            \param points at least two, in order, with pose and steering angle; times and speeds are recomputed */
        StretchGuess(int direction, std::vector<GuessPoint> points, const Vehicle &vehicle);

        /** \brief Direction: 1 forwards, -1 in reverse. */
        int direction() const
        {
            return direction_;
        }

        /** \brief Poses and steering angles some centimetres apart. */
        const std::vector<GuessPoint> &points() const
        {
            return points_;
        }

        /** \brief Length in metres. */
        double length() const;

        /** \brief Duration in seconds. */
        double duration() const
        {
            return points_.back().t;
        }

        /** \brief Times at which acceleration ends and braking begins, in seconds. They are equal for a short
            stretch. */
        std::pair<double, double> fastest() const;

        /** \brief The point at \e t seconds, clamped to the stretch. */
        GuessPoint at(double t) const;

    private:
        void setSpeeds(const std::vector<double> &distances, const Vehicle &vehicle, double initialSpeed);

        int direction_;
        std::vector<GuessPoint> points_;
    };

    /** \brief Guesses for the stretches of a path; yaw is continuous along them.
        \param initialSpeed m/s at the start of the path, not negative */
    std::vector<StretchGuess> guessesAlong(const Path &path, const Vehicle &vehicle, double initialSpeed = 0.0);

    /** \brief The stretches of the motion given by the nodes of a problem, in order. */
    std::vector<StretchGuess> stretchesOf(const MotionProblem &problem, const Vehicle &vehicle);

    /** \brief The stretches without one of them.

        Its neighbours are cut at their nearest points and bent to meet there. If it was the first or last stretch, its
        neighbour is cut nearest to the end of the motion. The result is a guess only: no car drives the bend exactly,
        and it may collide. Neighbours on both sides become one stretch, so that two cusps disappear.

        \return nothing if no stretch would remain */
    std::vector<StretchGuess> withoutStretch(const std::vector<StretchGuess> &stretches, std::size_t index,
                                             const Vehicle &vehicle);
}  // namespace parking
