#include "path_tracking/control/CarResponse.h"

#include "parking_geometry/text/Require.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double MIN_BRAKE = 0.3;      // m/s^2, minimum commanded deceleration for learning the brake
        constexpr double STEADY = 0.15;        // m/s^2, maximum change since the previous period
        constexpr double WEAKEST_BRAKE = 0.5;  // share of the command; less indicates a defect
        constexpr double BRAKE_GAIN = 0.4;     // share of a period's estimate that is applied
        constexpr double MIN_TURN = 0.015;     // radians, minimum expected turn of the wheels
        constexpr double HARDLY = 0.05;        // share of the expected turn up to which the wheels stand still
    }                                          // namespace

    void ResponseParameters::validate() const
    {
        const Require require("tracking");
        estimator.validate();
        for (const auto &[name, value] :
             {std::pair<const char *, double>{"steeringLag", steeringLag}, {"driveLag", driveLag}})
            require.that(value >= 0.0 && value <= 0.5, name, value, "from 0 to 0.5 seconds");
        require.that(commandDelay >= 0.0 && commandDelay <= 1.0, "commandDelay", commandDelay, "from 0 to 1 seconds");
        require.that(brakeScale > 0.0 && brakeScale <= 1.0, "brakeScale", brakeScale, "above 0 and up to 1");
    }

    CarResponse::CarResponse(const Vehicle &vehicle, const ResponseParameters &parameters, double period,
                             double steering)
      : vehicle_(vehicle),
        known_(parameters),
        period_(period),
        estimator_(vehicle.wheelbase, parameters.estimator),
        steeringLag_(parameters.steeringLag),
        driveLag_(parameters.driveLag),
        delay_(period, steering, static_cast<std::size_t>(std::lround(parameters.commandDelay / period)),
               parameters.delayIsSure),
        brakeScale_(parameters.brakeScale)
    {
    }

    void CarResponse::start(const Measurement &measurement)
    {
        estimator_.start(measurement);
    }

    void CarResponse::give(const Command &command)
    {
        delay_.give(command);
    }

    void CarResponse::reckon()
    {
        const Command &done = delay_.arrived();
        const double speed = estimator_.measuredSpeed();
        double after = speed + done.acceleration * period_;
        if (done.hold && after * speed <= 0.0)
            after = 0.0;
        estimator_.predict(period_, after, done.steering);
    }

    void CarResponse::take(const Measurement &measurement)
    {
        const Measurement before{{}, estimator_.measuredSpeed(), estimator_.measuredSteering()};
        delay_.learn(before, measurement);
        const Command &done = delay_.arrived(), &last = delay_.arrived(1);
        watchWheels(measurement);
        if (stuck_ == 0)
            steeringLag_.learn(period_, done.steering - last.steering, last.steering - before.steering,
                               done.steering - measurement.steering, LagEstimator::MIN_ANGLE);
        learnBrake(measurement);
        if (done.hold)
            driveLag_.hold();
        else
        {
            const bool brakes = done.acceleration * before.speed < 0.0;
            driveLag_.learn(period_, (brakes ? brakeScale_ : 1.0) * done.acceleration, before.speed, measurement.speed);
        }
        estimator_.predict(period_, measurement.speed, measurement.steering);
        if (isFinite(measurement.pose))
            estimator_.correct(measurement.pose);
    }

    void CarResponse::learnBrake(const Measurement &measurement)
    {
        const Command &done = delay_.arrived(), &last = delay_.arrived(1);
        const double before = estimator_.measuredSpeed(), sign = before < 0.0 ? -1.0 : 1.0;
        const double told = -sign * done.acceleration, slower = sign * (before - measurement.speed) / period_;
        // A car that stops within the period brakes for a part of it only.
        if (told < MIN_BRAKE || std::abs(done.acceleration - last.acceleration) > STEADY ||
            std::abs(before) < 1.5 * told * period_)
            return;
        brakeScale_ += BRAKE_GAIN * (std::clamp(slower / told, WEAKEST_BRAKE, 1.0) - brakeScale_);
    }

    void CarResponse::watchWheels(const Measurement &measurement)
    {
        // While the delay is uncertain, any delay is possible and the lag is unknown, too. Even wheels with the largest
        // expected lag move by more than this.
        const bool isSure = delay_.isSure();
        const double lag = isSure ? steeringLag_.lag() : 0.0;
        std::size_t delay = isSure ? delay_.periods() : 0;
        const std::size_t last = isSure ? delay : CommandDelay::MAX_PERIODS;
        double least = expectedTurn(delay, lag), most = least;
        while (++delay <= last)
        {
            const double turn = expectedTurn(delay, lag);
            least = std::min(least, turn);
            most = std::max(most, turn);
        }
        if (least < MIN_TURN && most > -MIN_TURN)
            return;
        const double expected = std::min(std::abs(least), std::abs(most));
        const double turned = std::abs(measurement.steering - estimator_.measuredSteering());
        stuck_ = turned < HARDLY * expected ? stuck_ + 1 : 0;
    }

    double CarResponse::expectedTurn(std::size_t delay, double lag) const
    {
        const double before = estimator_.measuredSteering();
        return LagStep(lag, period_).after(delay_.given(delay).steering, delay_.given(delay + 1).steering, before) -
               before;
    }

    ResponseParameters CarResponse::learnt() const
    {
        ResponseParameters result = known_;
        result.brakeScale = brakeScale_;
        if (!delay_.isSure())
            return result;
        result.commandDelay = delay_.time();
        result.delayIsSure = true;
        result.driveLag = driveLag_.lag();
        // Sticking wheels have raised the estimated lag.
        if (!wheelsStick())
            result.steeringLag = steeringLag_.lag();
        return result;
    }

    CarState CarResponse::now() const
    {
        CarState state;
        state.pose = estimator_.pose();
        state.speed = estimator_.speed();
        state.acceleration = estimator_.speedScale() * driveLag_.acceleration();
        state.wheels = estimator_.steering();
        state.commanded = delay_.arrived().steering;
        return state;
    }

    CarState CarResponse::ahead(Path *path) const
    {
        CarState state = now();
        for (std::size_t i = 0; i < delay_.periods(); ++i)
            state = after(state, delay_.underWay(i), brakeScale_, path);
        return state;
    }

    CarState CarResponse::after(const CarState &state, const Command &command, double brakeScale, Path *path) const
    {
        CarState next = state;
        const double offset = estimator_.steeringOffset();
        if (!wheelsStick())
        {
            const LagStep lag(steeringLag_.lag(), period_);
            next.wheels = lag.after(command.steering + offset, state.commanded + offset, state.wheels);
        }
        next.commanded = command.steering;

        double asked = command.acceleration;
        if (command.hold && asked * state.speed >= 0.0)
            asked = state.speed == 0.0 ? 0.0 : -std::copysign(vehicle_.maxAcceleration, state.speed);
        asked *= estimator_.speedScale() * (asked * state.speed < 0.0 ? brakeScale : 1.0);
        const double lag = driveLag_.lag(), late = unfollowed(lag, period_);
        const double mean = asked + late * (state.acceleration - asked);
        next.acceleration = lag > 0.0 ? asked + std::exp(-period_ / lag) * (state.acceleration - asked) : asked;
        next.speed = state.speed + mean * period_;
        double length = 0.5 * (state.speed + next.speed) * period_;
        if (command.hold && state.speed * next.speed <= 0.0)
        {
            length = mean != 0.0 ? -0.5 * state.speed * state.speed / mean : 0.0;
            next.speed = next.acceleration = 0.0;
        }
        const PathPiece piece(vehicle_.curvature(0.5 * (state.wheels + next.wheels)), length);
        next.pose = advance(state.pose, piece);
        next.driven += length;
        if (path != nullptr)
            path->append(piece);
        return next;
    }

    double CarResponse::accelerationFor(double wanted, double speed) const
    {
        const double scale = estimator_.speedScale() * (wanted * speed < 0.0 ? brakeScale_ : 1.0);
        return wanted / scale;
    }
}  // namespace parking
