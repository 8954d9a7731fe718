#include "path_tracking/simulation/ClosedLoop.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/reference/TimedReference.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double PLANT_STEP = 0.005;     // seconds of integration
        constexpr double CHECK_DISTANCE = 0.02;  // metres, maximum movement of the body between two collision checks
        /** Time limit of a drive: this multiple of the planned time, plus seconds. */
        constexpr double TIME_RATIO = 2.0, EXTRA_TIME = 60.0;

        /** Computes the figures of a drive as it proceeds. */
        class Recorder
        {
        public:
            Recorder(const Vehicle &vehicle, const TrackingController &controller,
                     const ClosedLoop::Clearance &clearance)
              : controller_(controller),
                clearance_(clearance),
                reach_(std::hypot(std::max(vehicle.wheelbase + vehicle.frontOverhang, vehicle.rearOverhang),
                                  0.5 * vehicle.width))
            {
            }

            /** Checks the body at \e pose for collision. */
            void check(const Pose &pose)
            {
                ++figures_.checkedPoses;
                const double clearance = clearance_(pose);
                figures_.minClearance = std::min(figures_.minClearance, clearance);
                if (!(clearance > 0.0))
                    ++figures_.collisions;
                checked_ = pose;
            }

            /** Records one step of the plant with \e duration, which ended in \e state, on leg \e leg near \e s. */
            void move(const Plant::State &state, double duration, std::size_t leg, double s, bool onLeg)
            {
                const double driven = positionDistance(state.pose, last_.pose);
                figures_.drivenLength += driven;
                time_ += duration;
                accelerationTime_ += duration * std::abs(state.acceleration);
                steeringTime_ += duration * std::abs(state.steering);
                const Pose before = last_.pose;
                last_ = state;
                if (driven > 0.0 && onLeg)
                {
                    const PathProjection place = controller_.reference().project(leg, state.pose, s - 1.0, s + 1.0);
                    figures_.maxCrossTrack = std::max(figures_.maxCrossTrack, std::abs(place.lateral));
                    figures_.maxPositionError = std::max(figures_.maxPositionError, place.distance);
                    figures_.maxHeadingError = std::max(figures_.maxHeadingError, std::abs(place.yaw));
                    legTime_ += duration;
                    crossTrackTime_ += duration * std::abs(place.lateral);
                }
                // A check is due if the next step might exceed the distance.
                if (clearance_ && bodyMotion(checked_, state.pose) + bodyMotion(before, state.pose) >= CHECK_DISTANCE)
                    check(state.pose);
            }

            void begin(const Plant::State &state)
            {
                last_ = state;
                checked_ = state.pose;
                if (clearance_)
                    check(state.pose);
            }

            Evaluation finish(const Pose &wanted, double travelTime)
            {
                const TimedReference &reference = controller_.reference();
                if (clearance_)
                    check(last_.pose);
                figures_.plannedLength = reference.length();
                figures_.plannedTime = reference.duration();
                figures_.travelTime = travelTime;
                figures_.cornerDeviation = reference.cornerDeviation();
                figures_.standstills = reference.legs().size() - 1;
                if (time_ > 0.0)
                {
                    figures_.meanAbsAcceleration = accelerationTime_ / time_;
                    figures_.meanAbsSteering = steeringTime_ / time_;
                }
                if (legTime_ > 0.0)
                    figures_.meanCrossTrack = crossTrackTime_ / legTime_;
                figures_.finalPositionError = positionDistance(last_.pose, wanted);
                figures_.finalYawError = std::abs(wrapAngle(last_.pose.yaw - wanted.yaw));
                const Pose end = reference.end();
                figures_.finalReferenceError = positionDistance(last_.pose, end);
                figures_.solves = solveTimes_.size();
                figures_.solveTime = timeStatistics(std::move(solveTimes_));
                return figures_;
            }

            void note(const TrackingStep &step)
            {
                if (!step.solved)
                    return;
                solveTimes_.push_back(step.solveTime);
                if (step.solverFailed)
                    ++figures_.solverFailures;
            }

        private:
            /** Upper bound of the movement of any point of the body, in metres. */
            double bodyMotion(const Pose &from, const Pose &to) const
            {
                return positionDistance(to, from) + reach_ * std::abs(wrapAngle(to.yaw - from.yaw));
            }

            const TrackingController &controller_;
            const ClosedLoop::Clearance &clearance_;
            double reach_;
            Plant::State last_;
            Pose checked_;
            Evaluation figures_;
            std::vector<double> solveTimes_;
            double time_{0.0}, legTime_{0.0};
            double accelerationTime_{0.0}, steeringTime_{0.0}, crossTrackTime_{0.0};
        };
    }  // namespace

    TimeStatistics timeStatistics(std::vector<double> values)
    {
        if (values.empty())
            return {};
        std::sort(values.begin(), values.end());
        const auto rank = [&values](double share)
        {
            const auto n = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
            return values[std::max<std::size_t>(n, 1) - 1];
        };
        return {rank(0.5), rank(0.99), values.back()};
    }

    void ClosedLoopParameters::validate() const
    {
        tracking.validate();
        disturbances.validate();
    }

    ClosedLoop::ClosedLoop(const Vehicle &vehicle, const ClosedLoopParameters &parameters)
      : vehicle_(vehicle),
        parameters_(parameters)
    {
        vehicle.validate();
        parameters.validate();
    }

    void ClosedLoop::setClearance(Clearance clearance)
    {
        clearance_ = std::move(clearance);
    }

    void ClosedLoop::setMonitor(Monitor monitor)
    {
        monitor_ = std::move(monitor);
    }

    void ClosedLoop::setGuard(TrackingController::Guard guard)
    {
        guard_ = std::move(guard);
    }

    void ClosedLoop::setSplice(Splice splice)
    {
        splice_ = std::move(splice);
    }

    DriveResult ClosedLoop::drive(const Path &path, const std::optional<Pose> &start, double initialSteering) const
    {
        TrackingController controller(path, vehicle_, parameters_.tracking, initialSteering);
        return run(controller, path.end(), start.value_or(path.start), initialSteering, {});
    }

    DriveResult ClosedLoop::follow(const TimedMotion &motion, const std::optional<Pose> &start) const
    {
        auto reference = std::make_shared<TimedReference>(motion, vehicle_);
        const Pose goal = reference->end();
        const double steering = motion.knots.front().steering;
        TrackingController controller(std::move(reference), vehicle_, parameters_.tracking, steering);
        return run(controller, goal, start.value_or(motion.start), steering, splice_);
    }

    DriveResult ClosedLoop::run(TrackingController &controller, const Pose &goal, const Pose &start,
                                double initialSteering, const Splice &splice) const
    {
        if (!(controller.reference().duration() <= LONGEST_MOTION))
            throw Error("closed loop: the path takes " + formatNumber(std::round(controller.reference().duration())) +
                        " s; at most " + formatNumber(LONGEST_MOTION) + " s are driven");
        controller.setGuard(guard_);
        Plant plant(vehicle_, parameters_.disturbances, start, initialSteering, PLANT_STEP);
        Recorder recorder(vehicle_, controller, clearance_);
        recorder.begin(plant.state());

        const double period = parameters_.tracking.mpc.step;
        Pose wanted = goal;
        DriveResult result;
        double t = 0.0, trueS = 0.0;
        std::size_t trueLeg = 0;
        const auto addPoint = [&](double time, const Plant::State &state, double steeringRate)
        {
            result.trajectory.push_back({time, state.pose.x, state.pose.y, state.pose.yaw, state.speed,
                                         state.acceleration, state.steering, steeringRate});
        };
        const auto addEvent = [&](const std::string &event)
        {
            result.events.push_back(formatNumber(std::round(1000.0 * t) / 1000.0) + " s: " + event);
        };

        for (std::size_t count = 0;; ++count)
        {
            t = static_cast<double>(count) * period;
            if (t > EXTRA_TIME + TIME_RATIO * controller.reference().duration())
                controller.requestStop("the drive takes too long");
            DriveRecord record;
            record.t = t;
            record.car = plant.state();
            record.measurement = plant.measure();
            record.control = controller.step(record.measurement);
            recorder.note(record.control);
            if (record.control.leg != trueLeg)
            {
                trueLeg = record.control.leg;
                trueS = controller.reference().legs()[trueLeg].beginLength;
            }
            const PathProjection place =
                controller.reference().project(trueLeg, record.car.pose, trueS - 1.0, trueS + 1.0);
            trueS = place.s;
            record.crossTrack = place.lateral;
            record.headingError = place.yaw;
            if (!record.control.event.empty())
            {
                addEvent(record.control.event);
                if (controller.mode() == TrackingMode::Braking || controller.mode() == TrackingMode::Stopped)
                    result.message = record.control.event;
            }
            const bool over = controller.finished() && record.car.speed == 0.0;
            if (!over && monitor_ && !monitor_(record))
                controller.requestStop("the monitor requested it");
            if (!over && splice)
                if (const std::optional<TimedMotion> next = splice(record))
                {
                    auto reference = std::make_shared<TimedReference>(*next, vehicle_);
                    const Pose end = reference->end();
                    if (controller.replaceReference(std::move(reference)))
                        wanted = end;
                }
            result.log.push_back(record);
            if (over)
                break;
            const bool onLeg =
                record.control.mode == TrackingMode::Driving || record.control.mode == TrackingMode::Braking;
            double at = 0.0;
            Plant::State first = record.car;
            plant.drive(record.control.command, period,
                        [&](double time, const Plant::State &state)
                        {
                            if (at == 0.0)
                                first.acceleration = state.acceleration;
                            recorder.move(state, time - at, trueLeg, trueS, onLeg);
                            at = time;
                        });
            addPoint(t, first, (plant.state().steering - record.car.steering) / period);
        }
        addPoint(t, plant.state(), 0.0);
        result.arrived = controller.mode() == TrackingMode::Arrived;
        if (result.arrived)
            result.message = "arrived";
        result.evaluation = recorder.finish(wanted, t);
        result.response = controller.learntResponse();
        return result;
    }
}  // namespace parking
