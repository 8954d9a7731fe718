#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/control/ActuatorLag.h"
#include "path_tracking/control/CommandDelay.h"
#include "path_tracking/control/PoseEstimator.h"
#include "path_tracking/control/TrackingTypes.h"

#include <functional>

namespace parking
{
    /** \brief What is known beforehand of how a car follows its commands; the rest is learnt while it drives. */
    struct ResponseParameters
    {
        EstimatorParameters estimator;  ///< of the filter that tells where the car is
        double steeringLag{0.0};        ///< seconds that the wheels lag behind their command
        double driveLag{0.0};           ///< seconds that the acceleration lags behind its command
        double commandDelay{0.0};       ///< seconds that a command takes to arrive
        bool delayIsSure{false};        ///< has that been seen, so that it need not be learnt?
        double brakeScale{1.0};         ///< share of a commanded deceleration that the car reaches, in (0, 1]

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief What a car is doing, as far as it is known or foretold. */
    struct CarState
    {
        Pose pose;                 ///< of the rear axle's midpoint
        double speed{0.0};         ///< m/s over ground, negative in reverse
        double acceleration{0.0};  ///< m/s^2 over ground
        double wheels{0.0};        ///< radians, where they really stand
        double commanded{0.0};     ///< radians, the steering angle commanded before
        double driven{0.0};        ///< metres since it was measured, signed
    };

    /** \brief How the car follows its commands: where it is, and what it will do.

        Learns from what is measured, a period at a time: the pose and the scale of the speed (PoseEstimator), how far
        wheels and drive lag behind, how late commands arrive, how much less than told the car slows down, and whether
        its wheels have stopped to follow at all. */
    class CarResponse
    {
    public:
        /** \param period seconds of control \param steering radians, commanded before the first command */
        CarResponse(const Vehicle &vehicle, const ResponseParameters &parameters, double period, double steering);

        /** \brief Begins with \e measurement. */
        void start(const Measurement &measurement);

        /** \brief Takes over what is measured at the end of a period. Without a pose the car is where speed and wheels
         * say. */
        void take(const Measurement &measurement);

        /** \brief Takes over a period in which speed or wheels were not measured: the car has done what it was told. */
        void reckon();

        /** \brief Sends off the command of the period that begins. Speeds and angles are those that are measured. */
        void give(const Command &command);

        /** \brief Where the car is. */
        const PoseEstimator &estimator() const
        {
            return estimator_;
        }
        /** \brief Seconds, time constant of the wheels behind their command. */
        double steeringLag() const
        {
            return steeringLag_.lag();
        }
        /** \brief Seconds, time constant of the acceleration behind its command. */
        double driveLag() const
        {
            return driveLag_.lag();
        }

        /** \brief Seconds that commands take to arrive. */
        double delay() const
        {
            return delay_.time();
        }

        /** \brief Share of the commanded deceleration that the car reaches, as far as has been seen. */
        double brakeScale() const
        {
            return brakeScale_;
        }

        /** \brief What is known now: what another CarResponse of this car may begin with. */
        ResponseParameters learnt() const;

        /** \brief Do the wheels stay where they are whatever they are told?

            Until the delay of commands is sure it is only said once wheels should have moved with any delay. */
        bool wheelsStick() const
        {
            return stuck_ >= STUCK_FOR;
        }

        /** \brief What the car is doing now. */
        CarState now() const;

        /** \brief What it will do when the command of this period arrives: all that are under way carried out.

            \param way when given, what it drives until then is added to it */
        CarState ahead(Path *way = nullptr) const;

        /** \brief What \e command makes of \e state in \e duration seconds, the piece of way added to \e way.

            \param brakeScale share of a commanded deceleration that the car reaches */
        CarState after(const CarState &state, const Command &command, double brakeScale, Path *way = nullptr) const;

        /** \brief The acceleration to command for one over ground, which may be beyond the car's limit. */
        double accelerationFor(double wanted, double speed) const;

    private:
        static constexpr int STUCK_FOR = 2;  // periods without any movement

        void learnBrake(const Measurement &measurement);
        void watchWheels(const Measurement &measurement);
        /** Radians by which wheels turn in the last period, by such a delay (periods) and lag (seconds). */
        double expectedTurn(std::size_t delay, double lag) const;

        Vehicle vehicle_;
        ResponseParameters known_;  // beforehand
        double period_;
        PoseEstimator estimator_;
        LagEstimator steeringLag_;
        DriveLagEstimator driveLag_;
        CommandDelay delay_;
        double brakeScale_{1.0};
        int stuck_{0};
    };
}  // namespace parking
