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
    /** \brief Initial knowledge of the response of a car to its commands; the rest is learnt while it drives. */
    struct ResponseParameters
    {
        EstimatorParameters estimator;  ///< of the pose filter
        double steeringLag{0.0};        ///< seconds that the wheels lag behind their command
        double driveLag{0.0};           ///< seconds that the acceleration lags behind its command
        double commandDelay{0.0};       ///< seconds between sending a command and its arrival
        bool delayIsSure{false};        ///< whether the delay is certain, so that it is not learnt
        double brakeScale{1.0};         ///< share of a commanded deceleration that the car reaches, in (0, 1]

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief State of the car, estimated or predicted. */
    struct CarState
    {
        Pose pose;                 ///< of the rear axle's midpoint
        double speed{0.0};         ///< m/s over ground, negative in reverse
        double acceleration{0.0};  ///< m/s^2 over ground
        double wheels{0.0};        ///< radians, actual angle of the wheels
        double commanded{0.0};     ///< radians, the previous steering command
        double driven{0.0};        ///< metres since the last measurement, signed
    };

    /** \brief Model of a car's response to its commands: estimates its state and predicts its motion.

        It learns once per period from measurements: the pose and the scale of the speed (PoseEstimator), the lags of
        wheels and drive, the delay of commands and the loss of braking. It also detects wheels that
        have stopped following. */
    class CarResponse
    {
    public:
        /** \param period seconds of control \param steering radians, commanded before the first command */
        CarResponse(const Vehicle &vehicle, const ResponseParameters &parameters, double period, double steering);

        /** \brief Initialises the state with \e measurement. */
        void start(const Measurement &measurement);

        /** \brief Updates the state with the measurement at the end of a period. Without a pose, speed and wheels
            predict it. */
        void take(const Measurement &measurement);

        /** \brief Updates the state after a period without measured speed or wheels, assuming that the car obeyed its
            command. */
        void reckon();

        /** \brief Records the command of the period that begins. Speeds and angles are as measured. */
        void give(const Command &command);

        /** \brief The estimator of the pose. */
        const PoseEstimator &estimator() const
        {
            return estimator_;
        }
        /** \brief Time constant in seconds of the wheels behind their command. */
        double steeringLag() const
        {
            return steeringLag_.lag();
        }
        /** \brief Time constant in seconds of the acceleration behind its command. */
        double driveLag() const
        {
            return driveLag_.lag();
        }

        /** \brief Seconds between sending a command and its arrival. */
        double delay() const
        {
            return delay_.time();
        }

        /** \brief Learnt share of a commanded deceleration that the car reaches. */
        double brakeScale() const
        {
            return brakeScale_;
        }

        /** \brief The learnt parameters, with which another CarResponse of this car may start. */
        ResponseParameters learnt() const;

        /** \brief Whether the wheels stay where they are, independent of commands.

            While the delay of commands is uncertain, the result is true only if the wheels should have moved with any
            delay. */
        bool wheelsStick() const
        {
            return stuck_ >= STUCK_FOR;
        }

        /** \brief The current state of the car. */
        CarState now() const;

        /** \brief The predicted state when the command of this period arrives, after all pending commands.

            \param path if given, receives the path driven until then */
        CarState ahead(Path *path = nullptr) const;

        /** \brief The state after \e command is applied to \e state for \e duration seconds.

            \param brakeScale share of a commanded deceleration that the car reaches
            \param path if given, receives the piece of path */
        CarState after(const CarState &state, const Command &command, double brakeScale, Path *path = nullptr) const;

        /** \brief The command for a required acceleration over ground. It may exceed the car's limit. */
        double accelerationFor(double wanted, double speed) const;

    private:
        static constexpr int STUCK_FOR = 2;  // periods without any movement

        void learnBrake(const Measurement &measurement);
        void watchWheels(const Measurement &measurement);
        /** Predicted turn of the wheels in the last period in radians, for a delay in periods and a lag in seconds. */
        double expectedTurn(std::size_t delay, double lag) const;

        Vehicle vehicle_;
        ResponseParameters known_;  // initial
        double period_;
        PoseEstimator estimator_;
        LagEstimator steeringLag_;
        DriveLagEstimator driveLag_;
        CommandDelay delay_;
        double brakeScale_{1.0};
        int stuck_{0};
    };
}  // namespace parking
