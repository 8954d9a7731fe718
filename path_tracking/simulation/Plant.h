#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/control/TrackingController.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <vector>

namespace parking
{
    /** \brief A time span of a drive. */
    struct TimeSpan
    {
        double begin{0.0};  ///< seconds since the first command
        double end{0.0};    ///< seconds, the first instant after the span

        /** \brief Whether \e time, in seconds, lies in the span. */
        bool contains(double time) const
        {
            return time >= begin && time < end;
        }
    };

    /** \brief Differences between the simulated car and the controller's model. With all zero the car is nominal. */
    struct Disturbances
    {
        double steeringLag{0.0};      ///< seconds, time constant of the wheels behind the servo
        double accelerationLag{0.0};  ///< seconds, time constant of the drive
        double positionNoise{0.0};    ///< metres, standard deviation of x and of y of each measurement
        double yawNoise{0.0};         ///< radians, standard deviation of each measurement
        double speedBias{0.0};        ///< relative error: the car moves (1 + bias) times as fast as measured
        double steeringOffset{0.0};   ///< radians, angle of the wheels to the left of the measured one
        double wheelbaseError{0.0};   ///< relative excess of the wheelbase over the controller's
        double brakeLoss{0.0};        ///< share of the commanded deceleration that is lost
        double delay{0.0};  ///< seconds between sending and arrival of a command, rounded to periods of the controller
        std::vector<TimeSpan> blind;  ///< when the measured pose is not a number
        std::vector<TimeSpan> stuck;  ///< when the wheels do not move
        std::uint64_t seed{1};        ///< of the noise

        /** \brief Disturbances of the figures in docs/trajectories-and-tracking.md: 0.1 s of steering lag, noise of 2
            cm and 0.5 degrees, 5 % of speed bias. */
        static Disturbances everyday(std::uint64_t seed);

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief A simulated car. */
    class Plant
    {
    public:
        /** \param step seconds of integration, positive */
        Plant(const Vehicle &vehicle, const Disturbances &disturbances, const Pose &pose, double steering, double step);

        /** \brief Actual state of the car. */
        struct State
        {
            Pose pose;                 ///< of the rear axle; yaw wrapped
            double speed{0.0};         ///< m/s over ground
            double steering{0.0};      ///< radians, of the wheels, offset included
            double acceleration{0.0};  ///< m/s^2 over ground
        };

        /** \brief The current state of the car. */
        State state() const;

        /** \brief Returns the next measurement; the noise advances with every call. */
        Measurement measure();

        /** \brief Executes \e command for \e duration seconds, and calls \e visit after each integration step. */
        void drive(const Command &command, double duration,
                   const std::function<void(double time, const State &)> &visit);

    private:
        double normal();
        bool isWithin(const std::vector<TimeSpan> &spans) const;
        Command arriving(const Command &command, double duration);
        double braked(double acceleration) const;

        Vehicle vehicle_;
        Disturbances disturbances_;
        double step_;
        std::mt19937_64 random_;
        Pose pose_;
        double speed_{0.0};         // as measured
        double acceleration_{0.0};  // as measured
        double servo_{0.0};         // where the servo is
        double wheels_{0.0};        // where the wheels are, as measured
        double time_{0.0};
        std::deque<Command> underWay_;  // commands that have not arrived, the oldest first
    };
}  // namespace parking
