#include "automatic_parking/AutomaticParking.h"

#include "automatic_parking/Replanning.h"
#include "automatic_parking/Stopwatch.h"
#include "automatic_parking/perception/ExtendedObstacles.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "path_tracking/trajectory/Splice.h"
#include "state_validity/fcl/FclContactTest.h"
#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

namespace parking
{
    namespace
    {
        std::string rounded(double value, double unit)
        {
            // A division keeps short decimals: 5.6 instead of 5.6000000000000005.
            return formatNumber(unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                                           : std::round(value / unit) * unit);
        }

        /** Share of the assumed braking that a planned drive uses; the rest is left for corrections. */
        constexpr double BRAKE_USED = 0.95;
        /** Minimum distance in metres that the guard keeps: poses are not known more accurately. */
        constexpr double MIN_GAP = 0.005;

        /** Expansions per gap of a search round extended obstacles, which may close the way to the goal. */
        constexpr std::uint64_t EXPANSIONS_ROUND_EXTENSIONS = 500;

        /** Seconds before the last moment to brake at which the car reacts to an obstacle. */
        constexpr double TIME_TO_DECIDE = 1.0;

        double yawBetween(const Pose &a, const Pose &b)
        {
            return std::abs(wrapAngle(a.yaw - b.yaw));
        }

    }  // namespace

    void ParkingParameters::validate() const
    {
        planning.validate();
        drive.validate();
        trajectory.trajectory.validate();
        const Require require("parking");
        require.notNegative("keptClearance", keptClearance);
        require.notNegative("minClearance", minClearance);
        require.notNegative("motionClearance", motionClearance);
        require.that(clearanceShare > 0.0 && clearanceShare < 1.0, "clearanceShare", clearanceShare, "between 0 and 1");
        require.positive("replanCrossTrack", replanCrossTrack);
        require.positive("replanHeadingError", replanHeadingError);
        require.positive("goalTolerance", goalTolerance);
        require.positive("goalYawTolerance", goalYawTolerance);
        require.notNegative("lookBack", lookBack);
        require.notNegative("stopClearance", stopClearance);
        require.notNegative("reactionTime", reactionTime);
        require.that(reactionLimit > 0.0, "reactionLimit", reactionLimit, "above 0");
        require.positive("minTimeGain", minTimeGain);
    }

    ParkingParameters::ParkingParameters()
    {
        trajectory.trajectory.finalSteering = std::nullopt;
        trajectory.trajectory.speedShare = 0.98;
        trajectory.trajectory.accelerationShare = 0.95;
        trajectory.trajectory.steeringShare = 0.97;
        trajectory.trajectory.steeringRateShare = 0.8;
        trajectory.trajectory.sharpest = false;
    }

    /** One call of park(): the current world and the drives so far. */
    class AutomaticParking::Session
    {
    public:
        Session(const ParkingParameters &parameters, const MapUpdate &update, const Scenario &scenario)
          : parameters_(parameters),
            update_(update),
            scenario_((scenario.vehicle.validate(), scenario)),
            world_(scenario, fclContactTest())
        {
        }

        /** Hides the obstacles of the scenario: from here on they serve only to find collisions. */
        void perceive(const std::shared_ptr<Perception> &perception, const PerceptionParameters &parameters,
                      const Pose &start)
        {
            truth_ = world_;
            Scenario placed = scenario_;
            placed.start = start;
            seen_ = std::make_unique<PerceivedWorld>(placed, perception, parameters);
            result_.history.map = seen_->map();
            remember(0.0, seen_->observe(0.0, start));
            const Pose nominal = scenario_.start;
            scenario_ = seen_->scenario();
            scenario_.start = nominal;
            world_ = ParkingWorld(scenario_, fclContactTest(), IndexedObstacles::LOCAL_REACH);
            Scenario closed = scenario_;
            closed.unknownIsOccupied = true;
            closed_ = ParkingWorld(closed, fclContactTest(), IndexedObstacles::LOCAL_REACH);
            if (parameters.unseenIsOccupied || parameters.obstacleExtension == 0.0)
                return;
            extension_ = std::make_unique<ExtendedObstacles>(seen_->scenario(), parameters.obstacleExtension);
            Scenario extended = scenario_;
            extended.grid = extension_->map();
            extended_ = ParkingWorld(extended, fclContactTest(), IndexedObstacles::LOCAL_REACH);
        }

        ParkingResult park(const std::optional<Pose> &start)
        {
            // The estimated pose may differ from the true one; both continue from drive to drive.
            Pose truth = start.value_or(scenario_.start);
            std::string reason = "first plan";
            for (std::size_t count = 0;; ++count)
            {
                ParkingLeg leg;
                leg.reason = reason;
                leg.begin = time_;
                leg.plan = planned(parameters_.planning);
                result_.planningTime += leg.plan.planningTime + leg.plan.smoothingTime;
                refuseTooNarrow(leg.plan);
                note(reason + ": " + leg.plan.message);
                if (!leg.plan.found)
                {
                    finish(leg.plan.failure, leg.plan.message);
                    result_.legs.push_back(std::move(leg));
                    break;
                }
                goal_ = leg.plan.goal;
                result_.history.plans.push_back({time_, leg.plan.path});
                if (leg.plan.path.pieces.empty())
                {
                    result_.legs.push_back(std::move(leg));
                    stay(truth);
                    break;
                }
                optimize(leg);
                const bool driven = drive(leg, truth, count);
                result_.legs.push_back(std::move(leg));
                if (!driven)
                    break;
                const DriveResult &drive = result_.legs.back().drive;
                truth = {drive.trajectory.back().x, drive.trajectory.back().y, drive.trajectory.back().yaw};
                scenario_.start = drive.log.back().control.estimate;
                steering_ = drive.trajectory.back().steering;
                if (isFinished(drive, reason))
                    break;
                if (count >= parameters_.maxReplans)
                {
                    finish(drive.arrived ? ParkingStatus::MissedGoal : ParkingStatus::Stopped,
                           reason + ", and no replanning is left");
                    break;
                }
            }
            return close(truth);
        }

        ParkingResult follow(const Path &path)
        {
            ParkingLeg leg;
            leg.reason = "given path";
            leg.plan.found = true;
            leg.plan.path = path;
            leg.plan.message = "a given path";
            parameters_.replanCrossTrack = parameters_.replanHeadingError = std::numeric_limits<double>::infinity();
            Pose truth = scenario_.start;
            if (!path.pieces.empty())
            {
                truth = path.start;
                goal_ = leg.plan.goal = path.end();
                leg.plan.clearance = minClearance(world_.footprint(), path);
                result_.history.plans.push_back({0.0, path});
            }
            const bool driven = drive(leg, truth, 0);
            result_.legs.push_back(std::move(leg));
            if (driven)
            {
                const DriveResult &drive = result_.legs.back().drive;
                truth = {drive.trajectory.back().x, drive.trajectory.back().y, drive.trajectory.back().yaw};
                std::string reason;
                if (!isFinished(drive, reason))
                    finish(drive.arrived ? ParkingStatus::MissedGoal : ParkingStatus::Stopped, reason);
            }
            return close(truth);
        }

    private:
        void note(const std::string &event)
        {
            note(time_, event);
        }

        void note(double time, const std::string &event)
        {
            result_.events.push_back(rounded(time, 1e-3) + " s: " + event);
        }

        /** Adds a frame to the history of the drive. */
        void remember(double time, const GridUpdate &changes)
        {
            if (!changes.empty())
                result_.history.frames.push_back({time, changes});
        }

        void finish(ParkingStatus status, const std::string &message)
        {
            result_.status = status;
            result_.message = message;
        }

        /** The car already stands at the goal: there is nothing to drive. */
        void stay(const Pose &truth)
        {
            TrajectoryPoint point;
            point.t = time_;
            point.x = truth.x;
            point.y = truth.y;
            point.yaw = truth.yaw;
            point.steering = steering_;
            if (result_.trajectory.empty())
                result_.trajectory = {point, point};  // two equal points, so that it can be drawn like others
            finish(ParkingStatus::Parked, "parked");
        }

        /** Optimises a trajectory that is faster than the path of \e leg. */
        void optimize(ParkingLeg &leg)
        {
            const Stopwatch watch;
            try
            {
                leg.trajectory = optimized(leg.plan, steering_, 0.0, {});
            }
            catch (const Error &error)
            {
                note(std::string("the car stops to steer: ") + error.what());
            }
            // In a changing world its motion is followed as any other, so that another one may continue it.
            if (leg.trajectory && leg.trajectory->trajectory.fallback && !update_ && !seen_)
            {
                note("the car stops to steer: " + leg.trajectory->trajectory.reason);
                leg.trajectory.reset();
            }
            leg.optimizationTime = watch.seconds();
            result_.planningTime += leg.optimizationTime;
        }

        /** A trajectory along \e plan, unless the plan must be driven with standstills. A car in motion searches no
            alternative paths, since it has no time for them. */
        std::optional<QuickestTrajectory> optimized(const ParkingPlan &plan, double steering, double speed,
                                                    const std::function<bool()> &interrupted) const
        {
            if (!parameters_.optimizeTrajectory || plan.clearance < parameters_.motionClearance)
                return std::nullopt;
            const Vehicle &car = scenario_.vehicle;
            QuickestTrajectoryOptions options = parameters_.trajectory;
            options.trajectory.initialSteering = std::clamp(steering, -car.maxSteeringAngle, car.maxSteeringAngle);
            options.trajectory.initialSpeed = speed;
            if (isReacting_)
            {
                options.alternatives = false;
                options.trajectory.maxRounds = 1;  // where the first round fails, further ones seldom succeed
            }
            options.trajectory.accelerationShare = std::min(options.trajectory.accelerationShare, accelerationShare());
            options.trajectory.margin =
                std::max(options.trajectory.margin,
                         std::min(parameters_.minClearance, parameters_.clearanceShare * plan.clearance));
            options.trajectory.preferredClearance =
                std::max(options.trajectory.preferredClearance, parameters_.keptClearance);
            if (plan.path.pieces.size() != plan.arcs.pieces.size())
                options.others.push_back(plan.arcs);
            return quickestTrajectory(planWorld_->footprint(), scenario_.bounds, plan.path, options, interrupted);
        }

        /** A plan from scenario_.start: round the expected continuations of seen obstacles, if there is one. */
        ParkingPlan planned(const PlanningParameters &parameters)
        {
            planWorld_ = &world_;
            if (extended_)
            {
                PlanningParameters careful = parameters;
                careful.expansionsPerGap = std::min(careful.expansionsPerGap, EXPANSIONS_ROUND_EXTENSIONS);
                careful.timeLimit = std::numeric_limits<double>::infinity();
                ParkingPlan plan = ParkingPlanner(careful).plan(scenario_, *extended_);
                if (plan.found)
                {
                    planWorld_ = &*extended_;
                    return plan;
                }
            }
            return ParkingPlanner(parameters).plan(scenario_, world_);
        }

        /** Share of the car's acceleration that plans use. */
        double accelerationShare() const
        {
            return BRAKE_USED * (1.0 - parameters_.drive.tracking.brakeReserve);
        }

        /** Required clearance while stopping and from new obstacles, derived from the clearance of \e leg. */
        double gapOf(const ParkingLeg &leg) const
        {
            return std::min(parameters_.stopClearance, std::max(MIN_GAP, 0.5 * leg.plan.clearance));
        }

        /** Rejects a plan on which the guard would stop the car, because it leads too close to obstacles. */
        void refuseTooNarrow(ParkingPlan &plan) const
        {
            if (!plan.found || plan.path.pieces.empty() || plan.clearance >= MIN_GAP ||
                world_.footprint().clearance(plan.path.start) < MIN_GAP)
                return;
            plan.found = false;
            plan.message =
                "the path leaves " + rounded(1e3 * plan.clearance, 0.1) + " mm to obstacles, too little to drive";
        }

        /** Whether a command is allowed whose \e stoppingPath brings the car to rest.

            As long as every command is allowed, the car can stop without collision. This holds with the reserve of
            braking, the learnt delay of commands and the learnt response of the wheels, even if the wheels stick. If
            new obstacles violate it, the car stops immediately.

            The gap does not apply while the car is already closer than the gap, because of errors of measurement and
            control. If the estimated pose collides, every command is allowed, so that the car can leave. */
        bool canStop(const Path &stoppingPath) const
        {
            if (enlarged_ && enlarged_->isFree(stoppingPath.start))
                return isPathFree(*enlarged_, stoppingPath);
            const FootprintChecker &footprint = seenGround().footprint();
            return !footprint.isFree(stoppingPath.start) || isPathFree(footprint, stoppingPath);
        }

        /** The world in which the car must be able to stop: without ground that it has not seen. */
        const ParkingWorld &seenGround() const
        {
            return closed_ ? *closed_ : world_;
        }

        /** Drives the plan of \e leg. \return false if it cannot be driven */
        bool drive(ParkingLeg &leg, const Pose &truth, std::size_t count)
        {
            ClosedLoopParameters parameters = parameters_.drive;
            parameters.disturbances.seed += count;  // different noise on every drive
            for (std::vector<TimeSpan> Disturbances::*spans : {&Disturbances::blind, &Disturbances::stuck})
                for (TimeSpan &span : parameters.disturbances.*spans)
                    span = {span.begin - time_, span.end - time_};  // continues the clock
            parameters.tracking.accelerationShare =
                std::min(parameters.tracking.accelerationShare, accelerationShare());
            ClosedLoop loop(scenario_.vehicle, parameters);
            loop.setClearance(
                [this](const Pose &pose)
                {
                    const FootprintChecker &footprint = (truth_ ? *truth_ : world_).footprint();
                    return footprint.isFree(pose) ? footprint.clearance(pose) : 0.0;
                });
            cause_.clear();
            beginWatching(leg, 0.0);
            loop.setGuard([this](const TrackingStep &step) { return canStop(step.stoppingPath); });
            loop.setMonitor([this, &leg](const DriveRecord &record) { return watch(leg, record); });
            loop.setSplice([this](const DriveRecord &) { return std::exchange(next_, std::nullopt); });
            try
            {
                leg.drive = leg.trajectory ? loop.follow(leg.trajectory->trajectory.motion, truth)
                                           : loop.drive(leg.plan.path, truth, steering_);
            }
            catch (const Error &error)
            {
                finish(ParkingStatus::NotDrivable, error.what());
                note(result_.message);
                return false;
            }
            // The learnt response remains valid for the next drive.
            parameters_.drive.tracking.response = leg.drive.response;
            for (const DriveRecord &record : leg.drive.log)
                if (cause_.empty())
                    cause_ = record.control.interruption;
            for (TrajectoryPoint point : leg.drive.trajectory)
            {
                // A drive starts where the previous one has ended.
                if (!result_.trajectory.empty() && point.t == 0.0)
                    result_.trajectory.pop_back();
                point.t += time_;
                result_.trajectory.push_back(point);
            }
            for (const std::string &event : leg.drive.events)
                result_.events.push_back((time_ > 0.0 ? rounded(time_, 1e-3) + " s + " : "") + event);
            time_ = result_.trajectory.back().t;
            if (leg.drive.arrived || cause_.empty())
                note(leg.drive.message);
            return true;
        }

        bool isAt(const Pose &pose, const Pose &goal) const
        {
            return positionDistance(pose, goal) <= parameters_.goalTolerance &&
                   yawBetween(pose, goal) <= parameters_.goalYawTolerance;
        }

        /** Makes the checkers of a drive. They see the changes of a perceived world. */
        void makeCheckers(const ParkingLeg &leg)
        {
            enlarged_ = seenGround().enlarged(gapOf(leg));
            withGap_ = closed_ ? world_.enlarged(gapOf(leg)) : enlarged_;
        }

        /** Prepares the checks of a drive of which \e driven metres are over. */
        void beginWatching(const ParkingLeg &leg, double driven)
        {
            makeCheckers(leg);
            isBlockedLater_ = false;
            keepsGap_ = withGap_ && isFreeFrom(leg, driven, *withGap_);
        }

        /** Monitors each period of a drive. \return false to request a safe stop */
        bool watch(ParkingLeg &leg, const DriveRecord &record)
        {
            if (!cause_.empty())
                return true;  // stopping already
            if (std::abs(record.control.crossTrack) > parameters_.replanCrossTrack)
                cause_ =
                    "the car is " + rounded(100.0 * std::abs(record.control.crossTrack), 1.0) + " cm beside the path";
            else if (std::abs(record.control.headingError) > parameters_.replanHeadingError)
                cause_ = "the heading is " + rounded(std::abs(record.control.headingError) * 180.0 / PI, 1.0) +
                         " degrees off the path";
            else if (update_ || seen_)
                try
                {
                    react(leg, record);
                }
                catch (const std::exception &error)
                {
                    // A moving car must stop on any error of the map or of the function that returns it.
                    cause_ = std::string("the changed map cannot be used: ") + error.what();
                    hopeless_ = true;
                }
            return cause_.empty();
        }

        /** Takes over changes of the world, and continues on another motion if they require or suggest it. */
        void react(ParkingLeg &leg, const DriveRecord &record)
        {
            Reaction reaction;
            reaction.time = leg.begin + record.t;
            const double driven = std::max(0.0, record.control.s - parameters_.lookBack);
            const Change change = seen_ ? look(reaction.time, record.control.estimate, reaction.updateTime)
                                        : takeOver(update_(reaction.time, record.control.estimate), leg);
            if (!change.any && !isBlockedLater_)
                return;
            const Stopwatch checking;
            std::string blocked = change.moved ? "the goal has changed" : "";
            if (change.closed)
                isBlockedLater_ = isBlocked(leg, driven);
            if (isBlockedLater_ && isUrgent(leg, record, driven))
                blocked = "the map has changed";
            reaction.checkTime = checking.seconds();
            hasOpened_ = hasOpened_ || change.opened;
            const bool mayImprove = hasOpened_ && reaction.time >= nextImprovement_;
            if (!blocked.empty() || mayImprove)
            {
                const Stopwatch planning;
                replanInMotion(leg, record, driven, blocked, reaction);
                reaction.planningTime = planning.seconds();
                result_.planningTime += reaction.planningTime;
            }
            result_.reactions.push_back(reaction);
        }

        /** Searches a motion from the moving car; \e blocked tells why, and is empty if the driven one is free. */
        void replanInMotion(ParkingLeg &leg, const DriveRecord &record, double driven, const std::string &blocked,
                            Reaction &reaction)
        {
            reaction.kind = blocked.empty() ? ReactionKind::Kept : ReactionKind::Stopped;
            const double now = record.control.time;
            const bool drives =
                record.control.mode == TrackingMode::Driving || record.control.mode == TrackingMode::Steering;
            Replan found;
            found.failure = leg.trajectory ? "no motion is searched" : "the path is driven with stops to steer";
            hasOpened_ = false;
            nextImprovement_ = reaction.time + parameters_.minTimeGain;
            if (leg.trajectory && parameters_.reactionTime > 0.0 && drives)
            {
                const Stopwatch watch;
                const std::function<bool()> late = [&]
                {
                    return watch.seconds() > parameters_.reactionLimit;
                };
                PlanningParameters planning = parameters_.planning;
                planning.interrupted = late;
                planning.timeLimit = std::numeric_limits<double>::infinity();
                // Time matters more than clearance, which the trajectory keeps by itself.
                planning.clearanceCost = 0.0;
                planning.gaps = {2.0 * parameters_.motionClearance, parameters_.motionClearance};
                isReacting_ = true;
                const TimedMotion &motion = leg.trajectory->trajectory.motion;
                found = replan({motion, scenario_.vehicle, now, now + parameters_.reactionTime,
                                accelerationShare() * scenario_.vehicle.maxAcceleration,
                                [&](const Pose &pose)
                                {
                                    scenario_.start = pose;
                                    return planned(planning);
                                },
                                [&](const ParkingPlan &plan, double steering, double speed)
                                { return optimized(plan, steering, speed, late); },
                                [&](const TimedMotion &next)
                                {
                                    return isFree(next, driven, world_.footprint());
                                }});
                isReacting_ = false;
                if (late())
                    found.failure = "planning took too long";
                if (found.failure.empty() && blocked.empty() &&
                    found.motion.duration() > motion.duration() - parameters_.minTimeGain)
                    return;
            }
            if (!found.failure.empty())
            {
                if (!blocked.empty())
                    note(reaction.time, "stopping to plan: " + found.failure);
                cause_ = blocked;
                return;
            }
            reaction.kind = blocked.empty() ? ReactionKind::Better
                            : found.stops   ? ReactionKind::Braked
                                            : ReactionKind::Moving;
            note(reaction.time, (blocked.empty() ? "the map has changed" : blocked) + ": " + found.plan.message +
                                    (found.stops ? ", after braking" : ", in motion"));
            goal_ = found.plan.goal;
            result_.history.plans.push_back({reaction.time, found.plan.path});
            leg.plan = std::move(found.plan);
            leg.trajectory = std::move(found.trajectory);
            leg.trajectory->trajectory.motion = found.motion;
            next_ = std::move(found.motion);
            beginWatching(leg, driven);
        }

        /** What a change of the world may affect. */
        struct Change
        {
            bool any{false}, closed{false}, opened{false}, moved{false};
        };

        /** Takes over a frame of the sensors. Sets \e duration to the seconds that the update takes. */
        Change look(double time, const Pose &car, double &duration)
        {
            const GridUpdate &update = seen_->observe(time, car);
            const Stopwatch updating;
            Change change;
            change.any = !update.empty();
            for (const CellChange &cell : update)
                (cell.cell == Cell::Occupied ? change.closed : change.opened) = true;
            if (change.any)
            {
                world_.update(update);
                closed_->update(update);
                if (extended_)
                    extended_->update(extension_->update(update));
                remember(time, update);
            }
            duration = updating.seconds();
            return change;
        }

        /** Replaces the world, if there is a changed one. */
        Change takeOver(std::optional<Scenario> next, const ParkingLeg &leg)
        {
            if (!next)
                return {};
            Scenario &changed = *next;
            if (changed.worldOffset != scenario_.worldOffset)
                throw Error("scenario " + changed.name + ": a changed map must have the worldOffset of the first one");
            if (changed.goals.empty())
                throw Error("scenario " + changed.name + ": it has no goal");
            changed.start = scenario_.start;
            changed.vehicle = scenario_.vehicle;
            // Goals from perception jitter. The current goal stays valid if a car there would be within the tolerances.
            const bool moved = std::none_of(changed.goals.begin(), changed.goals.end(),
                                            [this](const Pose &goal) { return isAt(goal, goal_); });
            world_ = ParkingWorld(changed, fclContactTest());
            scenario_ = std::move(changed);
            makeCheckers(leg);
            return {true, true, true, moved};
        }

        /** Whether the car must decide now, because it is blocked within the time to stop and a second. A later
           decision knows more of the world, so the car changes its mind less often. */
        bool isUrgent(const ParkingLeg &leg, const DriveRecord &record, double driven) const
        {
            if (!leg.trajectory)
                return true;
            const double braking =
                std::abs(record.car.speed) / (accelerationShare() * scenario_.vehicle.maxAcceleration);
            const double until = record.control.time + parameters_.reactionTime + braking + TIME_TO_DECIDE;
            return !withGap_ || !isFree(beginOf(leg.trajectory->trajectory.motion, until), driven, *withGap_);
        }

        /** Whether the rest of the drive is blocked in the changed world.

            Obstacles closer than the guard's gap would be passed at creeping speed without a reserve for control
           errors. If they were as close before the change, the plan has accepted them. */
        bool isBlocked(const ParkingLeg &leg, double driven)
        {
            const bool keptGap = keepsGap_;
            keepsGap_ = withGap_ && isFreeFrom(leg, driven, *withGap_);
            return !keepsGap_ && (keptGap || !isFreeFrom(leg, driven, world_.footprint()));
        }

        /** Whether the drive is free after its first \e driven metres. */
        bool isFreeFrom(const ParkingLeg &leg, double driven, const FootprintChecker &checker) const
        {
            return leg.trajectory ? isFree(leg.trajectory->trajectory.motion, driven, checker)
                                  : isPathFree(checker, leg.plan.path.rest(driven));
        }

        bool isFree(const TimedMotion &motion, double driven, const FootprintChecker &checker) const
        {
            return collisionsOf(restOf(motion, scenario_.vehicle, driven), checker, 1).empty();
        }

        /** Whether parking is finished. Otherwise \e reason is set to that of the replan. */
        bool isFinished(const DriveResult &drive, std::string &reason)
        {
            if (drive.evaluation.collisions > 0)
            {
                finish(ParkingStatus::Collision, "the driven car touched an obstacle");
                return true;
            }
            if (!drive.arrived)
            {
                reason = cause_.empty() ? drive.message : cause_;
                if (!cause_.empty() && !hopeless_)
                    return false;
                // The controller stopped for a reason that another path would not remove, or there is no map for one.
                finish(ParkingStatus::Stopped, reason);
                return true;
            }
            const Pose stands = drive.log.back().control.estimate;
            if (!isAt(stands, goal_))
            {
                reason = "the car stands " + rounded(100.0 * positionDistance(stands, goal_), 0.1) + " cm and " +
                         rounded(yawBetween(stands, goal_) * 180.0 / PI, 0.1) + " degrees from the goal";
                return false;
            }
            finish(ParkingStatus::Parked, "parked");
            return true;
        }

        ParkingResult close(const Pose &truth)
        {
            std::vector<Evaluation> drives;
            for (const ParkingLeg &leg : result_.legs)
                if (!leg.drive.trajectory.empty())
                    drives.push_back(leg.drive.evaluation);
            result_.evaluation = combined(drives);
            if (!result_.trajectory.empty())
            {
                result_.evaluation.finalPositionError = positionDistance(truth, goal_);
                result_.evaluation.finalYawError = yawBetween(truth, goal_);
            }
            return std::move(result_);
        }

        ParkingParameters parameters_;
        const MapUpdate &update_;
        Scenario scenario_;
        ParkingWorld world_;
        Pose goal_;
        double time_{0.0};
        double steering_{0.0};
        bool hopeless_{false};                              // whether planning again is useless
        std::unique_ptr<PerceivedWorld> seen_;              // null if the world is known
        std::optional<ParkingWorld> truth_, closed_;        // of a perceived world: the true one, and the seen ground
        std::unique_ptr<ExtendedObstacles> extension_;      // expected obstacles on unseen ground; null without them
        std::optional<ParkingWorld> extended_;              // the perceived world with them
        std::shared_ptr<const FootprintChecker> enlarged_;  // the body with its clearance while stopping
        std::shared_ptr<const FootprintChecker> withGap_;   // the same where the car plans, on unseen ground, too
        const ParkingWorld *planWorld_{&world_};            // of the latest plan
        bool isBlockedLater_{false};                        // whether the driven motion is blocked
        bool keepsGap_{false};                              // whether the rest of the drive keeps that clearance
        bool isReacting_{false};                            // whether a motion from the moving car is searched
        bool hasOpened_{false};                             // whether ground has become free since the last search
        double nextImprovement_{0.0};                       // seconds, when a quicker motion may be searched
        std::optional<TimedMotion> next_;                   // replaces the driven motion in this period
        std::string cause_;                                 // why watch() stopped the current drive; empty otherwise
        ParkingResult result_;
    };

    AutomaticParking::AutomaticParking(const ParkingParameters &parameters)
      : parameters_((parameters.validate(), parameters))
    {
    }

    void AutomaticParking::setMapUpdate(MapUpdate update)
    {
        update_ = std::move(update);
    }

    void AutomaticParking::setPerception(std::shared_ptr<Perception> perception, const PerceptionParameters &parameters)
    {
        parameters.validate();
        perception_ = std::move(perception);
        perceptionParameters_ = parameters;
    }

    ParkingResult AutomaticParking::park(const Scenario &scenario, const std::optional<Pose> &start) const
    {
        Session session(parameters_, update_, scenario);
        if (perception_)
            session.perceive(perception_, perceptionParameters_, start.value_or(scenario.start));
        return session.park(start);
    }

    ParkingResult AutomaticParking::drive(const Scenario &scenario, const Path &path) const
    {
        const MapUpdate none;
        return Session(parameters_, none, scenario).follow(path);
    }

    ReactionFigures reactionFigures(const ParkingResult &result)
    {
        ReactionFigures figures;
        figures.stops = result.legs.empty() ? 0 : result.legs.size() - 1;
        std::vector<double> checks, motions;
        for (const Reaction &reaction : result.reactions)
        {
            const double checked = reaction.updateTime + reaction.checkTime;
            checks.push_back(checked);
            if (reaction.kind == ReactionKind::Kept || reaction.kind == ReactionKind::Stopped)
                continue;
            motions.push_back(checked + reaction.planningTime);
            figures.stops += reaction.kind == ReactionKind::Braked ? 1 : 0;
        }
        figures.newMotions = motions.size();
        figures.check = timeStatistics(std::move(checks));
        figures.motion = timeStatistics(std::move(motions));
        return figures;
    }

    Evaluation combined(const std::vector<Evaluation> &drives)
    {
        if (drives.empty())
            return {};
        Evaluation all = drives.front();
        for (std::size_t i = 1; i < drives.size(); ++i)
        {
            const Evaluation &next = drives[i];
            const double time = all.travelTime + next.travelTime;
            const auto average = [&](double Evaluation::*field)
            {
                if (time > 0.0)
                    all.*field = (all.*field * all.travelTime + next.*field * next.travelTime) / time;
            };
            average(&Evaluation::meanAbsAcceleration);
            average(&Evaluation::meanAbsSteering);
            average(&Evaluation::meanCrossTrack);
            for (double Evaluation::*field : {&Evaluation::plannedLength, &Evaluation::drivenLength,
                                              &Evaluation::plannedTime, &Evaluation::travelTime})
                all.*field += next.*field;
            for (double Evaluation::*field : {&Evaluation::maxCrossTrack, &Evaluation::maxPositionError,
                                              &Evaluation::maxHeadingError, &Evaluation::cornerDeviation})
                all.*field = std::max(all.*field, next.*field);
            for (double Evaluation::*field :
                 {&Evaluation::finalPositionError, &Evaluation::finalYawError, &Evaluation::finalReferenceError})
                all.*field = next.*field;
            all.minClearance = std::min(all.minClearance, next.minClearance);
            for (std::size_t Evaluation::*field :
                 {&Evaluation::collisions, &Evaluation::checkedPoses, &Evaluation::solves, &Evaluation::solverFailures})
                all.*field += next.*field;
            all.standstills += next.standstills + 1;  // the car also stood between the drives
            // The percentile of several sets does not follow from theirs; the largest one is an upper bound.
            all.solveTime.median = std::max(all.solveTime.median, next.solveTime.median);
            all.solveTime.p99 = std::max(all.solveTime.p99, next.solveTime.p99);
            all.solveTime.max = std::max(all.solveTime.max, next.solveTime.max);
        }
        return all;
    }
}  // namespace parking
