#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/control/TrackingTypes.h"

#include <Eigen/Core>

namespace parking
{
    /** \brief Assumed errors of the sensors. */
    struct EstimatorParameters
    {
        double positionNoise{0.02};     ///< metres, standard deviation of x and y of a measured pose
        double yawNoise{0.00873};       ///< radians (0.5 degrees), standard deviation of a measured yaw
        double speedBias{0.05};         ///< relative error of the measured speed
        double steeringOffset{0.0175};  ///< radians (1 degree), offset of the wheels
        /** Metres and radians per metre driven, error of dead reckoning beyond the biases. */
        double drift{0.01};

        /** \brief Throws parking::Error naming the first field that is not a positive finite number. */
        void validate() const;
    };

    /** \brief Estimates the pose of the car: an extended Kalman filter over pose, scale of the speed and offset of the
        steering.

        Measured speed and steering predict the pose by dead reckoning; the measured pose corrects it. The two biases
        are states, so that a different wheel size or a bent steering is learnt and compensated. While the car stands
        its pose is constant, and every measurement refines it. */
    class PoseEstimator
    {
    public:
        /** \brief Throws parking::Error for invalid \e parameters. \param wheelbase metres */
        PoseEstimator(double wheelbase, const EstimatorParameters &parameters);

        /** \brief Initialises the state with \e measurement. */
        void start(const Measurement &measurement);

        /** \brief Predicts the pose by dead reckoning over \e duration seconds, to \e speed and \e steering measured at
            its end. */
        void predict(double duration, double speed, double steering);

        /** \brief Corrects the state with a measured pose. */
        void correct(const Pose &measured);

        /** \brief Estimated pose of the rear axle. */
        const Pose &pose() const
        {
            return pose_;
        }

        /** \brief Speed over ground in m/s, with the learnt scale. */
        double speed() const
        {
            return speedScale_ * speed_;
        }

        /** \brief Angle of the wheels in radians, with the learnt offset. */
        double steering() const
        {
            return steering_ + steeringOffset_;
        }

        /** \brief Last measured speed in m/s, negative in reverse. */
        double measuredSpeed() const
        {
            return speed_;
        }

        /** \brief Last measured steering angle in radians. */
        double measuredSteering() const
        {
            return steering_;
        }

        /** \brief Speed over ground divided by measured speed. */
        double speedScale() const
        {
            return speedScale_;
        }

        /** \brief Angle of the wheels to the left of the measured one, in radians. */
        double steeringOffset() const
        {
            return steeringOffset_;
        }

    private:
        double wheelbase_;
        EstimatorParameters parameters_;
        Pose pose_;
        double speed_{0.0};
        double steering_{0.0};
        double speedScale_{1.0};
        double steeringOffset_{0.0};
        Eigen::Matrix<double, 5, 5> covariance_;  // x, y, yaw, scale, offset
    };
}  // namespace parking
