#include "path_tracking/control/TrackingController.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/simulation/BicycleModel.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double LAG_ALLOWED = 0.05;         // metres behind the timed path at which its clock slows down
        constexpr double LAG_STOP = 0.25;            // metres behind at which the clock stops
        constexpr double STUCK_TIME = 5.0;           // seconds with a stopped clock until the safe stop
        constexpr double STEERING_WAIT_LIMIT = 2.0;  // seconds of waiting for wheels without progress
        constexpr double MIN_PROGRESS = 1e-4;        // radians per period that count as progress
        constexpr double NO_TIME = 1e-9;             // seconds
        constexpr double BETWEEN_EVENTS = 1.0;       // seconds without a refused command before one is reported again
        constexpr double SAME = 1e-3;                // metres, radians, m/s and seconds between equal references

        double towards(double from, double to, double most)
        {
            return std::clamp(to, from - most, from + most);
        }
    }  // namespace

    TrackingController::TrackingController(const Path &path, const Vehicle &vehicle,
                                           const TrackingParameters &parameters, double initialSteering, Solve solve)
      : TrackingController(
            (parameters.validate(), std::make_shared<TimedReference>(ReferencePath(path, vehicle, parameters.reference),
                                                                     parameters.limits(vehicle), initialSteering)),
            vehicle, parameters, initialSteering, std::move(solve))
    {
    }

    TrackingController::TrackingController(std::shared_ptr<const TimedReference> reference, const Vehicle &vehicle,
                                           const TrackingParameters &parameters, double initialSteering, Solve solve)
      : vehicle_(vehicle),
        parameters_((parameters.validate(), parameters)),
        reference_(std::move(reference)),
        mpc_(vehicle, parameters.mpc),
        solve_(std::move(solve)),
        response_(vehicle, parameters.response, parameters.mpc.step, initialSteering),
        poseWatch_(parameters.maxFailures, parameters.poseWaitLimit, parameters.mpc.step)
    {
        last_.steering = initialSteering;
        if (!reference_)
            throw Error("tracking: there is no reference");
        s_ = leg().beginLength;
        clock_ = -leg().standstill;
    }

    void TrackingController::setGuard(Guard guard)
    {
        guard_ = std::move(guard);
    }

    void TrackingController::requestStop(const std::string &reason)
    {
        stopRequest_ = reason.empty() ? "stop requested" : reason;
    }

    bool TrackingController::replaceReference(std::shared_ptr<const TimedReference> reference)
    {
        if (!reference)
            throw Error("tracking: there is no reference");
        if ((mode_ != TrackingMode::Driving && mode_ != TrackingMode::Steering) || turnsLast_)
            return false;
        const std::vector<TimedLeg> &now = reference_->legs(), &next = reference->legs();
        const auto startsAlike = [&](std::size_t i)
        {
            return now[i].direction == next[i].direction && std::abs(now[i].standstill - next[i].standstill) <= SAME &&
                   std::abs(now[i].beginLength - next[i].beginLength) <= SAME;
        };
        bool same = next.size() > leg_;
        for (std::size_t i = 0; same && i < leg_; ++i)
            same = startsAlike(i) && std::abs(now[i].endLength - next[i].endLength) <= SAME;
        if (same && mode_ == TrackingMode::Driving)
        {
            const TimedState a = reference_->at(leg_, clock_), b = reference->at(leg_, clock_);
            same = startsAlike(leg_) && isSamePose(a.pose, b.pose, SAME) && std::abs(a.speed - b.speed) <= SAME &&
                   std::abs(a.steering - b.steering) <= SAME;
        }
        if (!same)
            throw Error("tracking: the new reference differs from the driven one before the car");
        if (mode_ == TrackingMode::Steering)
            clock_ += reference_->beginOf(leg_) - reference->beginOf(leg_);
        reference_ = std::move(reference);
        return true;
    }

    TrackingStep TrackingController::step(const Measurement &measurement)
    {
        TrackingStep step;
        takeMeasurement(measurement, step);
        if (poseWatch_.isMissing())
            beginStop("the pose is lost", step);
        else if (!stopRequest_.empty())
            beginStop(std::exchange(stopRequest_, {}), step);
        locate(step);
        watch(step);
        bool over = mode_ == TrackingMode::Driving && legOver();
        if (over && (std::abs(estimator().measuredSpeed()) <= STANDING || mayReverse()))
        {
            nextLeg(step);
            over = false;
        }
        if (mode_ == TrackingMode::Steering)
            steer(step);
        if (mode_ == TrackingMode::Driving && over)
        {
            step.command = stand(last_.steering);
            clock_ += parameters_.mpc.step;
        }
        else if (mode_ == TrackingMode::Driving)
        {
            drive(step);
            if (mode_ == TrackingMode::Driving && guard_)
                askGuard(step);
        }
        if (mode_ == TrackingMode::Braking)
            brake(step);
        else if (mode_ == TrackingMode::Waiting)
            wait(step);
        else if (finished())
            step.command = stand(last_.steering);

        step.mode = mode_;
        step.leg = leg_;
        step.time = reference_->beginOf(leg_) + clock_;
        step.estimate = estimator().pose();
        last_ = {step.command.acceleration, step.command.steering};
        response_.give(step.command);
        return step;
    }

    void TrackingController::takeMeasurement(const Measurement &measurement, TrackingStep &step)
    {
        const bool odometry = std::isfinite(measurement.speed) && std::isfinite(measurement.steering);
        const bool usable = odometry && isFinite(measurement.pose);
        poseWatch_.note(usable);
        if (!started_)
        {
            // Dead reckoning needs a valid first measurement.
            started_ = usable;
            response_.start(usable ? measurement : Measurement{reference_->at(0, 0.0).pose, 0.0, last_.steering});
            return;
        }
        if (!usable && !poseWatch_.isMissing())
            step.event = "measurement not finite: dead reckoning";
        if (odometry)
            response_.take(measurement);
        else
            response_.reckon();
    }

    void TrackingController::locate(TrackingStep &step)
    {
        const PathProjection place = reference_->project(leg_, estimator().pose(), s_ - SEARCH, s_ + SEARCH);
        s_ = place.s;
        beyond_ = place.beyond;
        step.s = place.s;
        step.crossTrack = place.lateral;
        step.headingError = place.yaw;
    }

    void TrackingController::watch(TrackingStep &step)
    {
        if (mode_ != TrackingMode::Driving && mode_ != TrackingMode::Steering)
            return;
        if (std::abs(step.crossTrack) > parameters_.maxCrossTrack)
            beginStop(
                "the car is " + formatNumber(std::round(100.0 * std::abs(step.crossTrack))) + " cm beside the path",
                step);
        else if (std::abs(step.headingError) > parameters_.maxHeadingError)
            beginStop("the heading is " + formatNumber(std::round(std::abs(step.headingError) * 180.0 / PI)) +
                          " degrees off the path",
                      step);
        else if (std::abs(estimator().speed()) > 1.1 * vehicle_.maxSpeed + STANDING)
            beginStop("the car is faster than its limit", step);
        else if (leg().direction * estimator().speed() < -0.1 && mode_ == TrackingMode::Driving)
            beginStop("the car moves against the direction of the path", step);
        else if (response_.wheelsStick() && mode_ == TrackingMode::Driving)
        {
            stuckAt_ = estimator().measuredSteering();
            beginStop("the wheels do not follow their command", step);
        }
    }

    bool TrackingController::legOver() const
    {
        const double over = clock_ - leg().duration;
        if (over >= parameters_.settleTime)
            return true;
        const double left = leg().endLength - (s_ + beyond_);
        // With less than half a period to go the car may reverse within this period.
        const double braking = 0.5 * vehicle_.maxAcceleration * std::pow(0.5 * parameters_.mpc.step, 2);
        if (over >= -0.5 * parameters_.mpc.step && mayReverse() && left <= parameters_.stopTolerance + braking)
            return true;
        // Beyond the end the leg is over; shortly before it the timed path may finish.
        return left <= (over >= 0.0 ? parameters_.stopTolerance : 0.0);
    }

    bool TrackingController::isNearlyStanding() const
    {
        return std::abs(estimator().measuredSpeed()) <=
               std::max(STANDING, 0.5 * vehicle_.maxAcceleration * parameters_.mpc.step);
    }

    bool TrackingController::mayReverse() const
    {
        return isNearlyStanding() && leg_ + 1 < reference_->legs().size() &&
               reference_->legs()[leg_ + 1].standstill < parameters_.mpc.step;
    }

    void TrackingController::nextLeg(TrackingStep &step)
    {
        // The time until or since the planned end of the leg belongs to the next one.
        const double over = clock_ - leg().duration;
        waited_ = 0.0;
        wheelsOff_ = 0.0;
        if (leg_ + 1 == reference_->legs().size())
        {
            turnsLast_ = reference_->finalStandstill() > 0.0;
            if (turnsLast_)
                mode_ = TrackingMode::Steering;
            else
                arrive(step);
            return;
        }
        ++leg_;
        s_ = leg().beginLength;
        clock_ = over - leg().standstill;
        mode_ = TrackingMode::Steering;
        locate(step);
    }

    void TrackingController::arrive(TrackingStep &step)
    {
        const double off = positionDistance(estimator().pose(), reference_->end());
        mode_ = off <= parameters_.arrivalTolerance ? TrackingMode::Arrived : TrackingMode::Stopped;
        if (mode_ == TrackingMode::Stopped)
            step.event = "stopped " + formatNumber(std::round(100.0 * off)) + " cm from the end of the path";
    }

    void TrackingController::beginStop(const std::string &reason, TrackingStep &step)
    {
        if (mode_ != TrackingMode::Driving && mode_ != TrackingMode::Steering)
            return;
        mode_ = TrackingMode::Braking;
        step.event = "safe stop: " + reason;
    }

    Command TrackingController::standStill(double speed, double last, double steering, double rate) const
    {
        const double period = parameters_.mpc.step;
        Command command;
        command.hold = true;
        command.acceleration = std::clamp(-speed / period, -vehicle_.maxAcceleration, vehicle_.maxAcceleration);
        command.steering = towards(last, steering, rate * period);
        return command;
    }

    Command TrackingController::stand(double steering) const
    {
        return standStill(estimator().measuredSpeed(), last_.steering, steering, vehicle_.maxSteeringRate);
    }

    void TrackingController::steer(TrackingStep &step)
    {
        const double period = parameters_.mpc.step;
        const double target = turnsLast_ ? reference_->finalSteering() : leg().steering;
        const double off = std::abs(estimator().measuredSteering() - target);
        const bool standing = std::abs(estimator().measuredSpeed()) <= STANDING;
        const bool there = last_.steering == target && off <= parameters_.steeringTolerance;
        if (turnsLast_ && standing && there)
        {
            arrive(step);
            return;
        }
        // A leg that starts within this period may start if the wheels are ready in time.
        const double left = std::clamp(-clock_, 0.0, period);
        const bool inTime =
            off <= parameters_.steeringTolerance + reference_->steeringRate() * left &&
            std::abs(last_.steering - target) <= parameters_.steeringTolerance + reference_->steeringRate() * left;
        if (!turnsLast_ && (standing || (leg().standstill < period && isNearlyStanding())) &&
            clock_ + period > NO_TIME && (there || inTime))
        {
            mode_ = TrackingMode::Driving;
            clock_ = std::min(clock_, 0.0) - response_.delay();  // it starts when the first command arrives
            waited_ = 0.0;
            planAge_ = 0;
            plan_.clear();
            mpc_.reset();
            return;
        }
        // Wait for wheels that make progress; wheels that do not move are defective.
        waited_ = off < wheelsOff_ - MIN_PROGRESS || last_.steering != target ? 0.0 : waited_ + period;
        wheelsOff_ = off;
        if (waited_ > STEERING_WAIT_LIMIT)
        {
            if (standing)
                stuckAt_ = estimator().measuredSteering();
            beginStop(standing ? "the wheels do not follow their command" : "the car does not stand still", step);
            return;
        }
        step.command = standStill(estimator().measuredSpeed(), last_.steering, target, reference_->steeringRate());
        clock_ += period;
    }

    double TrackingController::steeringAt(double time) const
    {
        const double angle = reference_->at(leg_, time).steering, over = time - leg().duration;
        if (over <= 0.0)
            return angle;
        const bool last = leg_ + 1 == reference_->legs().size();
        return towards(angle, last ? reference_->finalSteering() : reference_->legs()[leg_ + 1].steering,
                       over * reference_->steeringRate());
    }

    MpcProblem TrackingController::makeProblem(const CarState &car) const
    {
        const double period = parameters_.mpc.step;
        const double clock = clock_ + response_.delay();  // arrival time of this command
        const double driveLag = response_.driveLag(), steeringLag = response_.steeringLag();
        MpcProblem problem;
        problem.pose = car.pose;
        problem.speed = car.speed;
        problem.last = {overGround(last_.acceleration, car), last_.steering + estimator().steeringOffset()};
        problem.wheels = car.wheels;
        problem.acceleration = car.acceleration;
        problem.driveLag = driveLag;
        problem.steeringLag = steeringLag;
        problem.direction = leg().direction;
        problem.steeringNow = steeringAt(clock + steeringLag);
        problem.speedNow = leg().direction * reference_->at(leg_, clock + driveLag).speed;
        problem.accelerationNow =
            (problem.speedNow - leg().direction * reference_->at(leg_, clock - period + driveLag).speed) / period;
        problem.align = positionDistance(reference_->end(), car.pose) < parameters_.mpc.alignDistance;
        problem.reference.reserve(parameters_.mpc.horizon);
        for (std::size_t k = 1; k <= parameters_.mpc.horizon; ++k)
        {
            const double time = clock + static_cast<double>(k) * period;
            // Commands must lead the car by its lags.
            problem.reference.push_back({reference_->at(leg_, time).pose,
                                         leg().direction * reference_->at(leg_, time + driveLag).speed,
                                         steeringAt(time + steeringLag)});
        }
        return problem;
    }

    double TrackingController::overGround(double acceleration, const CarState &car) const
    {
        return acceleration / response_.accelerationFor(1.0, acceleration * car.speed);
    }

    Command TrackingController::commandFor(const MpcControl &control, const CarState &car) const
    {
        Command command;
        command.acceleration = response_.accelerationFor(control.acceleration, car.speed);
        command.steering = control.steering - estimator().steeringOffset();
        return command;
    }

    bool TrackingController::useOldPlan(const std::string &why, const CarState &car, TrackingStep &step)
    {
        ++failures_;
        step.event = why;
        if (failures_ > parameters_.maxFailures || planAge_ >= plan_.size())
            return false;
        step.command = commandFor(plan_[planAge_], car);
        ++planAge_;
        return true;
    }

    MpcSolution TrackingController::solve(const MpcProblem &problem)
    {
        if (!solve_)
            return mpc_.solve(problem);
        try
        {
            return solve_(problem);
        }
        catch (const std::exception &error)
        {
            // A moving car needs its controller even if the optimiser throws.
            MpcSolution none;
            none.message = std::string("the solver failed: ") + error.what();
            return none;
        }
    }

    double TrackingController::withinSpeedLimit(double acceleration, const CarState &car) const
    {
        // Earlier commands still act, because the drive lags behind.
        const double scale = estimator().speedScale(), period = parameters_.mpc.step;
        const double coming = car.speed + car.acceleration * response_.driveLag();
        const double most = (vehicle_.maxSpeed - coming) / (scale * period);
        const double least = (-vehicle_.maxSpeed - coming) / (scale * period);
        return std::clamp(std::clamp(acceleration, least, most), -vehicle_.maxAcceleration, vehicle_.maxAcceleration);
    }

    void TrackingController::drive(TrackingStep &step)
    {
        const double period = parameters_.mpc.step;
        const CarState car = response_.ahead();
        const MpcProblem problem = makeProblem(car);
        const MpcSolution solution = solve(problem);
        step.solved = true;
        step.solveTime = solution.solveTime;
        step.iterations = solution.iterations;
        // The solution of an external optimiser may be invalid or beyond the limits.
        const bool good = solution.usable && !solution.controls.empty() &&
                          std::all_of(solution.controls.begin(), solution.controls.end(),
                                      [](const MpcControl &control) {
                                          return std::isfinite(control.acceleration) && std::isfinite(control.steering);
                                      });
        step.solverFailed = !good;
        if (good)
        {
            failures_ = 0;
            plan_ = solution.controls;
            planAge_ = 1;
            step.command = commandFor(plan_.front(), car);
        }
        else
        {
            const std::string why = solution.message.empty() ? "the solver gave no finite answer" : solution.message;
            if (!useOldPlan(why, car, step))
            {
                beginStop(why, step);
                return;
            }
        }
        step.command.acceleration = withinSpeedLimit(step.command.acceleration, car);
        endWithPeriod(car, step);
        step.command.steering =
            std::clamp(towards(last_.steering, step.command.steering, vehicle_.maxSteeringRate * period),
                       -vehicle_.maxSteeringAngle, vehicle_.maxSteeringAngle);

        const double behind = reference_->at(leg_, clock_).s - (s_ + beyond_);
        const double rate = std::clamp((LAG_STOP - behind) / (LAG_STOP - LAG_ALLOWED), 0.0, 1.0);
        clock_ += rate * period;
        waited_ = rate < 0.05 ? waited_ + period : 0.0;
        if (waited_ > STUCK_TIME)
            beginStop("the car does not move", step);
    }

    void TrackingController::endWithPeriod(const CarState &car, TrackingStep &step)
    {
        // A leg that ends within this period ends at rest, for any rest of the period.
        const double period = parameters_.mpc.step;
        const double scale = estimator().speedScale();
        const double speed = leg().direction * car.speed / scale;
        const double left =
            leg().endLength - (s_ + beyond_ + leg().direction * car.driven) - 0.5 * scale * speed * period;
        if (clock_ + response_.delay() + period < leg().duration || speed < 0.0 ||
            speed > vehicle_.maxAcceleration * period || std::abs(left) > parameters_.stopTolerance)
            return;
        step.command.hold = true;
        step.command.acceleration = -leg().direction * speed / period;
    }

    Command TrackingController::braking(const CarState &car, const PathProjection &place, double last) const
    {
        // Lateral error and heading error decay along the driven distance as e'' = -k1 e - k2 e'.
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
        // A small command towards straight wheels tests whether they move again.
        constexpr double TRIED = 0.1, TURNED = 0.02;
        wheelsAwaited_ += parameters_.mpc.step;
        const bool areBack = std::abs(estimator().measuredSteering() - *stuckAt_) >= TURNED;
        if (!areBack && wheelsAwaited_ <= parameters_.wheelWaitLimit)
        {
            const double target = std::clamp(*stuckAt_ - std::copysign(TRIED, *stuckAt_), -vehicle_.maxSteeringAngle,
                                             vehicle_.maxSteeringAngle);
            step.command = stand(target);
            return;
        }
        mode_ = TrackingMode::Stopped;
        step.event = areBack ? "the wheels turn again"
                             : "safe stop: the wheels have not followed their command for " +
                                   formatNumber(parameters_.wheelWaitLimit) + " s";
        if (areBack)
            step.interruption = "the wheels did not follow their command";
    }

    void TrackingController::waitForPose(TrackingStep &step)
    {
        const PoseWatch::Verdict verdict = poseWatch_.stand();
        if (verdict == PoseWatch::Verdict::Wait)
            return;
        mode_ = TrackingMode::Stopped;
        const bool isBack = verdict == PoseWatch::Verdict::Back;
        step.event = isBack ? "the pose is available again"
                            : "safe stop: the pose was lost and not recovered within " +
                                  formatNumber(parameters_.poseWaitLimit) + " s";
        if (isBack)
            step.interruption = "the pose was lost";
    }

    Path TrackingController::stoppingPath(const Command &command) const
    {
        constexpr int MAX_PERIODS = 600;
        const double brakes = std::min(response_.brakeScale(), 1.0 - parameters_.brakeReserve);
        Path path{estimator().pose(), {}};
        CarState car = response_.after(response_.ahead(&path), command, brakes, &path);
        double s = s_, last = command.steering;
        for (int i = 0; i < MAX_PERIODS && std::abs(car.speed) > STANDING; ++i)
        {
            const PathProjection place = reference_->project(leg_, car.pose, s - SEARCH, s + SEARCH);
            const Command next = braking(car, place, last);
            s = place.s;
            last = next.steering;
            car = response_.after(car, next, brakes, &path);
        }
        return path;
    }

    void TrackingController::askGuard(TrackingStep &step)
    {
        step.estimate = estimator().pose();
        step.leg = leg_;
        step.stoppingPath = stoppingPath(step.command);
        if (guard_(step))
        {
            refused_ = 0.0;
            allowed_ += parameters_.mpc.step;
            return;
        }
        const CarState car = response_.ahead();
        step.command = braking(car, reference_->project(leg_, car.pose, s_ - SEARCH, s_ + SEARCH), last_.steering);
        if (allowed_ >= BETWEEN_EVENTS && step.event.empty())
            step.event = "slowing down: the path to a stop is not free";
        allowed_ = 0.0;
        if (std::abs(estimator().speed()) <= STANDING)
            refused_ += parameters_.mpc.step;
        if (refused_ < parameters_.guardWaitLimit)
            return;
        step.interruption = "the car could not stop in time if it drove on";
        beginStop("the car could not stop in time if it drove on", step);
    }
}  // namespace parking
