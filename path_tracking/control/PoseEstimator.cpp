#include "path_tracking/control/PoseEstimator.h"

#include "parking_geometry/text/Require.h"
#include "path_tracking/simulation/BicycleModel.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

namespace parking
{
    namespace
    {
        constexpr double LARGEST_SCALE = 1.3;  // of the speed, and its inverse: larger ratios are impossible for wheels
        constexpr double LARGEST_OFFSET = 0.15;  // radians
    }                                            // namespace

    void EstimatorParameters::validate() const
    {
        const Require require("estimator");
        require.positive("positionNoise", positionNoise);
        require.positive("yawNoise", yawNoise);
        require.positive("speedBias", speedBias);
        require.positive("steeringOffset", steeringOffset);
        require.positive("drift", drift);
    }

    PoseEstimator::PoseEstimator(double wheelbase, const EstimatorParameters &parameters)
      : wheelbase_(wheelbase),
        parameters_((parameters.validate(), parameters))
    {
        start({});
    }

    void PoseEstimator::start(const Measurement &measurement)
    {
        pose_ = measurement.pose;
        speed_ = measurement.speed;
        steering_ = measurement.steering;
        speedScale_ = 1.0;
        steeringOffset_ = 0.0;
        Eigen::Matrix<double, 5, 1> deviations;
        deviations << parameters_.positionNoise, parameters_.positionNoise, parameters_.yawNoise, parameters_.speedBias,
            parameters_.steeringOffset;
        covariance_ = deviations.cwiseAbs2().asDiagonal();
    }

    void PoseEstimator::predict(double duration, double speed, double steering)
    {
        const double before = speedScale_ * speed_, after = speedScale_ * speed;
        const BicycleStep<double> moved =
            bicycleStep(pose_.yaw, before, (after - before) / duration, steering_ + steeringOffset_,
                        steering + steeringOffset_, duration, wheelbase_);
        const double driven = 0.5 * (speed_ + speed) * duration;  // as measured
        const double angle = 0.5 * (steering_ + steering) + steeringOffset_;
        const double cosine = std::cos(angle);
        const double yawPerOffset = speedScale_ * driven / (wheelbase_ * cosine * cosine);
        const double yawPerScale = driven * std::tan(angle) / wheelbase_;
        const double c = std::cos(pose_.yaw + 0.5 * moved.dyaw), s = std::sin(pose_.yaw + 0.5 * moved.dyaw);

        Eigen::Matrix<double, 5, 5> transition = Eigen::Matrix<double, 5, 5>::Identity();
        transition(0, 2) = -moved.dy;
        transition(1, 2) = moved.dx;
        transition(0, 3) = driven * c - 0.5 * moved.dy * yawPerScale;
        transition(1, 3) = driven * s + 0.5 * moved.dx * yawPerScale;
        transition(2, 3) = yawPerScale;
        transition(0, 4) = -0.5 * moved.dy * yawPerOffset;
        transition(1, 4) = 0.5 * moved.dx * yawPerOffset;
        transition(2, 4) = yawPerOffset;
        covariance_ = (transition * covariance_ * transition.transpose()).eval();
        // Errors of independent metres accumulate as a random walk.
        const double walk = parameters_.drift * parameters_.drift * std::abs(driven);
        for (int i = 0; i < 3; ++i)
            covariance_(i, i) += walk * (i == 2 ? 0.1 : 1.0);

        pose_ = {pose_.x + moved.dx, pose_.y + moved.dy, wrapAngle(pose_.yaw + moved.dyaw)};
        speed_ = speed;
        steering_ = steering;
    }

    void PoseEstimator::correct(const Pose &measured)
    {
        const Eigen::Vector3d innovation(measured.x - pose_.x, measured.y - pose_.y,
                                         wrapAngle(measured.yaw - pose_.yaw));
        const Eigen::Vector3d deviations(parameters_.positionNoise, parameters_.positionNoise, parameters_.yawNoise);
        const Eigen::Matrix<double, 5, 3> crossed = covariance_.leftCols<3>();
        const Eigen::Matrix3d expected =
            covariance_.topLeftCorner<3, 3>() + Eigen::Matrix3d(deviations.cwiseAbs2().asDiagonal());
        const Eigen::Matrix<double, 5, 3> gain = expected.llt().solve(crossed.transpose()).transpose();
        const Eigen::Matrix<double, 5, 1> change = gain * innovation;
        covariance_ -= gain * crossed.transpose();
        covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
        pose_ = {pose_.x + change[0], pose_.y + change[1], wrapAngle(pose_.yaw + change[2])};
        speedScale_ = std::clamp(speedScale_ + change[3], 1.0 / LARGEST_SCALE, LARGEST_SCALE);
        steeringOffset_ = std::clamp(steeringOffset_ + change[4], -LARGEST_OFFSET, LARGEST_OFFSET);
    }
}  // namespace parking
