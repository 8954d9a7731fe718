#include "path_tracking/simulation/Plant.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace parking
{
    namespace
    {
        constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    }

    Disturbances Disturbances::everyday(std::uint64_t seed)
    {
        Disturbances disturbances;
        disturbances.steeringLag = 0.1;
        disturbances.positionNoise = 0.02;
        disturbances.yawNoise = 0.5 * PI / 180.0;
        disturbances.speedBias = 0.05;
        disturbances.seed = seed;
        return disturbances;
    }

    void Disturbances::validate() const
    {
        const Require require("disturbances");
        require.notNegative("steeringLag", steeringLag);
        require.notNegative("accelerationLag", accelerationLag);
        require.notNegative("positionNoise", positionNoise);
        require.notNegative("yawNoise", yawNoise);
        require.that(std::abs(speedBias) < 1.0, "speedBias", speedBias, "above -1 and below 1");
        require.that(std::abs(steeringOffset) < 1.0, "steeringOffset", steeringOffset, "above -1 and below 1 radian");
        require.that(std::abs(wheelbaseError) < 1.0, "wheelbaseError", wheelbaseError, "above -1 and below 1");
        require.that(brakeLoss >= 0.0 && brakeLoss < 1.0, "brakeLoss", brakeLoss, "at least 0 and below 1");
        require.notNegative("delay", delay);
    }

    Plant::Plant(const Vehicle &vehicle, const Disturbances &disturbances, const Pose &pose, double steering,
                 double step)
      : vehicle_(vehicle),
        disturbances_(disturbances),
        step_(step),
        random_(disturbances.seed),
        pose_(pose),
        servo_(steering),
        wheels_(steering)
    {
        disturbances.validate();
        vehicle_.wheelbase *= 1.0 + disturbances.wheelbaseError;
        if (!(std::isfinite(step) && step > 0.0))
            throw Error("plant: the step is " + formatNumber(step) + "; it must be a positive number of seconds");
    }

    Plant::State Plant::state() const
    {
        const double share = 1.0 + disturbances_.speedBias;
        return {pose_, share * speed_, wheels_ + disturbances_.steeringOffset, share * acceleration_};
    }

    double Plant::normal()
    {
        // Box and Muller's transform: std::normal_distribution differs between standard libraries.
        const double u = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53;
        const double w = static_cast<double>(random_() >> 11) * 0x1p-53;
        return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * PI * w);
    }

    Measurement Plant::measure()
    {
        Measurement measurement{pose_, speed_, wheels_};
        measurement.pose.x += disturbances_.positionNoise * normal();
        measurement.pose.y += disturbances_.positionNoise * normal();
        measurement.pose.yaw = wrapAngle(measurement.pose.yaw + disturbances_.yawNoise * normal());
        if (isWithin(disturbances_.blind))
            measurement.pose = {NOT_A_NUMBER, NOT_A_NUMBER, NOT_A_NUMBER};
        return measurement;
    }

    bool Plant::isWithin(const std::vector<TimeSpan> &spans) const
    {
        return std::any_of(spans.begin(), spans.end(), [this](const TimeSpan &span) { return span.contains(time_); });
    }

    Command Plant::arriving(const Command &command, double duration)
    {
        // Until the first command arrives the car stands.
        const auto late = static_cast<std::size_t>(std::lround(disturbances_.delay / duration));
        if (underWay_.size() < late)
            underWay_.resize(late, Command{0.0, servo_, true});
        underWay_.push_back(command);
        const Command first = underWay_.front();
        underWay_.pop_front();
        return first;
    }

    double Plant::braked(double acceleration) const
    {
        return acceleration * speed_ < 0.0 ? (1.0 - disturbances_.brakeLoss) * acceleration : acceleration;
    }

    void Plant::drive(const Command &given, double duration,
                      const std::function<void(double time, const State &)> &visit)
    {
        const Command command = arriving(given, duration);
        const int steps = std::max(1, static_cast<int>(std::ceil(duration / step_ - 1e-9)));
        const double h = duration / steps;
        const double servoBegin = servo_;
        for (int i = 1; i <= steps; ++i)
        {
            // The servo moves to its command at a constant rate, within its limit.
            const double share = static_cast<double>(i) / steps;
            const double wanted = servoBegin + share * (command.steering - servoBegin);
            const double most = vehicle_.maxSteeringRate * h;
            servo_ += std::clamp(wanted - servo_, -most, most);
            servo_ = std::clamp(servo_, -vehicle_.maxSteeringAngle, vehicle_.maxSteeringAngle);
            const double wheelsBefore = wheels_;
            time_ += h;
            if (isWithin(disturbances_.stuck))
                servo_ = wheels_;
            wheels_ = disturbances_.steeringLag > 0.0
                          ? servo_ + (wheels_ - servo_) * std::exp(-h / disturbances_.steeringLag)
                          : servo_;

            double asked = std::clamp(command.acceleration, -vehicle_.maxAcceleration, vehicle_.maxAcceleration);
            if (command.hold && asked * speed_ >= 0.0)
                asked = speed_ == 0.0 ? 0.0 : -std::copysign(vehicle_.maxAcceleration, speed_);
            asked = braked(asked);
            acceleration_ = disturbances_.accelerationLag > 0.0
                                ? asked + (acceleration_ - asked) * std::exp(-h / disturbances_.accelerationLag)
                                : asked;
            const double speedBefore = speed_;
            speed_ += acceleration_ * h;
            // The brake cannot reverse the car.
            if (command.hold && (speedBefore == 0.0 || speedBefore * speed_ <= 0.0 || std::abs(speed_) < 1e-9))
            {
                speed_ = 0.0;
                acceleration_ = 0.0;
            }
            const double driven = 0.5 * (speedBefore + speed_) * h * (1.0 + disturbances_.speedBias);
            const double angle = 0.5 * (wheelsBefore + wheels_) + disturbances_.steeringOffset;
            pose_ = advance(pose_, vehicle_.curvature(angle), driven);
            pose_.yaw = wrapAngle(pose_.yaw);
            if (visit)
                visit(share * duration, state());
        }
    }
}  // namespace parking
