// How a TrackingController stops: what it needs to, when it must, and what it does then.

#include "parking_geometry/text/Text.h"
#include "path_tracking/control/TrackingController.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    Command TrackingController::braking(const CarState &car, const PathProjection &place, double last) const
    {
        // Lateral error and heading error decay along the driven way as e'' = -k1 e - k2 e'.
        constexpr double K1 = 0.5, K2 = 1.2;
        const double curvature = vehicle_.curvature(reference_->steering(leg_, place.s)) - K1 * place.lateral -
                                 leg().direction * K2 * place.yaw;
        return standStill(
            car.speed / estimator().speedScale(), last,
            std::clamp(vehicle_.steeringAngle(curvature), -vehicle_.maxSteeringAngle, vehicle_.maxSteeringAngle),
            vehicle_.maxSteeringRate);
    }

    void TrackingController::brake(TrackingStep &step)
    {
        const CarState car = response_.ahead();
        if (std::abs(estimator().speed()) <= STANDING && std::abs(car.speed) <= STANDING)
        {
            mode_ = poseWatch_.wasLost() || stuckAt_ ? TrackingMode::Waiting : TrackingMode::Stopped;
            step.command = stand(last_.steering);
            return;
        }
        step.command = braking(car, reference_->project(leg_, car.pose, s_ - SEARCH, s_ + SEARCH), last_.steering);
    }

    void TrackingController::wait(TrackingStep &step)
    {
        step.command = stand(last_.steering);
        if (poseWatch_.wasLost())
            waitForPose(step);
        else
            waitForWheels(step);
    }

    void TrackingController::waitForWheels(TrackingStep &step)
    {
        // They are told to turn a little towards the middle, and are back when they do.
        constexpr double TRIED = 0.1, TURNED = 0.02;
        wheelsAwaited_ += parameters_.mpc.step;
        step.wheelsAreBack = std::abs(estimator().measuredSteering() - *stuckAt_) >= TURNED;
        if (!step.wheelsAreBack && wheelsAwaited_ <= parameters_.wheelPatience)
        {
            const double target = std::clamp(*stuckAt_ - std::copysign(TRIED, *stuckAt_), -vehicle_.maxSteeringAngle,
                                             vehicle_.maxSteeringAngle);
            step.command = stand(target);
            return;
        }
        mode_ = TrackingMode::Stopped;
        step.event = step.wheelsAreBack ? "the wheels turn again"
                                        : "safe stop: the wheels do not follow their command, and have not for " +
                                              formatNumber(parameters_.wheelPatience) + " s";
    }

    void TrackingController::waitForPose(TrackingStep &step)
    {
        const PoseWatch::Verdict verdict = poseWatch_.stand();
        if (verdict == PoseWatch::Verdict::Wait)
            return;
        mode_ = TrackingMode::Stopped;
        step.poseIsBack = verdict == PoseWatch::Verdict::Back;
        step.event = step.poseIsBack ? "the pose is back"
                                     : "safe stop: the pose was lost, and not back after " +
                                           formatNumber(parameters_.posePatience) + " s";
    }

    Path TrackingController::stoppingWay(const Command &command) const
    {
        constexpr int MOST_PERIODS = 600;
        const double brakes = std::min(response_.brakeScale(), 1.0 - parameters_.brakeReserve);
        Path way{estimator().pose(), {}};
        CarState car = response_.after(response_.ahead(&way), command, brakes, &way);
        double s = s_, last = command.steering;
        for (int i = 0; i < MOST_PERIODS && std::abs(car.speed) > STANDING; ++i)
        {
            const PathProjection place = reference_->project(leg_, car.pose, s - SEARCH, s + SEARCH);
            const Command next = braking(car, place, last);
            s = place.s;
            last = next.steering;
            car = response_.after(car, next, brakes, &way);
        }
        return way;
    }

    void TrackingController::askGuard(TrackingStep &step)
    {
        step.estimate = estimator().pose();
        step.leg = leg_;
        step.stoppingWay = stoppingWay(step.command);
        if (guard_(step))
        {
            refused_ = 0.0;
            return;
        }
        const CarState car = response_.ahead();
        step.command = braking(car, reference_->project(leg_, car.pose, s_ - SEARCH, s_ + SEARCH), last_.steering);
        if (refused_ == 0.0 && step.event.empty())
            step.event = "slowing down: the way to a stop is not free";
        if (std::abs(estimator().speed()) <= STANDING)
            refused_ += parameters_.mpc.step;
        step.blocked = refused_ >= parameters_.guardPatience;
        if (step.blocked)
            beginStop("the car cannot go on and still stop in time", step);
    }
}  // namespace parking
