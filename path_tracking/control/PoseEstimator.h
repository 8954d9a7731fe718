#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/control/TrackingTypes.h"

#include <Eigen/Core>

namespace parking
{
    /** \brief What the pose filter assumes of the sensors. */
    struct EstimatorParameters
    {
        double positionNoise{0.02};     ///< metres, standard deviation of x and y of a measured pose
        double yawNoise{0.00873};       ///< radians (0.5 degrees), likewise
        double speedBias{0.05};         ///< share of the speed by which odometry may be wrong
        double steeringOffset{0.0175};  ///< radians (1 degree) by which the wheels may stand off
        /** Metres and radians per metre driven that dead reckoning may err beyond the biases. */
        double drift{0.01};

        /** \brief Throws parking::Error naming the first field that is not a positive finite number. */
        void validate() const;
    };

    /** \brief Where the car is: an extended Kalman filter over pose, scale of the speed and offset of the steering.

        Dead reckoning with the measured speed and steering angle predicts, the measured pose corrects. The two biases
        are states, so that a wheel of another size or a bent steering are learnt on the way and can be compensated.
        While the car stands its pose does not change, and every measurement makes it better known. */
    class PoseEstimator
    {
    public:
        /** \brief Throws parking::Error for invalid \e parameters. \param wheelbase metres */
        PoseEstimator(double wheelbase, const EstimatorParameters &parameters);

        /** \brief Begins with \e measurement. */
        void start(const Measurement &measurement);

        /** \brief Dead reckoning over \e duration seconds, to \e speed and \e steering as measured at its end. */
        void predict(double duration, double speed, double steering);

        /** \brief Takes over a measured pose. */
        void correct(const Pose &measured);

        /** \brief Where the car is thought to be, of the rear axle. */
        const Pose &pose() const
        {
            return pose_;
        }

        /** \brief Speed over ground in m/s, the learnt scale applied. */
        double speed() const
        {
            return speedScale_ * speed_;
        }

        /** \brief Angle of the wheels in radians, the learnt offset applied. */
        double steering() const
        {
            return steering_ + steeringOffset_;
        }

        /** \brief As measured last, m/s, negative in reverse. */
        double measuredSpeed() const
        {
            return speed_;
        }

        /** \brief As measured last, radians. */
        double measuredSteering() const
        {
            return steering_;
        }

        /** \brief Speed over ground divided by measured speed. */
        double speedScale() const
        {
            return speedScale_;
        }

        /** \brief Radians that the wheels stand farther left than measured. */
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
