#pragma once

#include "automatic_parking/ParkingPlanner.h"
#include "automatic_parking/QuickestTrajectory.h"
#include "automatic_parking/perception/DriveHistory.h"
#include "automatic_parking/perception/PerceivedWorld.h"
#include "parking_geometry/Scenario.h"
#include "path_tracking/simulation/ClosedLoop.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Parameters of the whole parking pipeline. */
    struct ParkingParameters
    {
        PlanningParameters planning;  ///< of every plan, including replans
        /** Parameters of the controller and of the simulated car. Disturbances use one clock for all drives. */
        ClosedLoopParameters drive;

        /** Whether to drive the fastest trajectory near the path, steering while driving. Otherwise the car drives the
            path itself, with standstills where its curvature jumps. */
        bool optimizeTrajectory{true};
        /** Options of the optimisation. The initial steering is that of the car. Margin and preferred clearance are at
            least those derived from minClearance and keptClearance for the plan. */
        QuickestTrajectoryOptions trajectory;
        double keptClearance{0.2};  ///< preferred clearance of a trajectory in metres, if the plan keeps it
        /** Required clearance of a trajectory in metres, if the plan keeps it; otherwise see clearanceShare. */
        double minClearance{0.15};
        /** Share of the plan's clearance that a trajectory must keep, if that is below minClearance. */
        double clearanceShare{0.9};
        /** Metres; a plan with less clearance is driven with standstills, because errors of a moving car would
            matter. */
        double motionClearance{0.03};

        /** Seconds from a change of the map to the earliest splice of a new motion. At 0 the car stops before it plans
            again. */
        double reactionTime{0.2};
        /** Seconds of computation for a new motion; if they do not suffice, the car stops. Infinite: equal inputs give
            equal drives. */
        double reactionLimit{std::numeric_limits<double>::infinity()};
        /** Seconds that a new motion must save if the driven one is still free. At most one such motion is searched in
            this time. */
        double minTimeGain{2.0};
        std::size_t maxReplans{3};        ///< number of plans after the first one, with the car at rest
        double replanCrossTrack{0.25};    ///< metres beside the path at which the car stops and replans
        double replanHeadingError{0.35};  ///< radians off the heading of the path at which the car stops and replans
        double goalTolerance{0.15};       ///< metres from the goal; a car that stands farther off replans
        double goalYawTolerance{0.0349};  ///< radians (2 degrees) from the goal; a car that stands farther off replans
        /** Metres of clearance on the path to a stop, at most half of the plan's clearance but at least 5 mm. A car
            that could not keep it slows down early. An obstacle that appears nearer to the path ahead causes a replan.
            drive.tracking.brakeReserve is the assumed loss of braking. */
        double stopClearance{0.03};
        double lookBack{0.1};  ///< metres of path behind the car that must stay free when the map changes

        /** \brief Defaults: trajectories that leave the controller a reserve for corrections, with a free final
            steering angle. */
        ParkingParameters();

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief Result of a change of the world during a drive. */
    enum class ReactionKind
    {
        Kept,    ///< the driven motion stays free
        Moving,  ///< continued in motion along another path
        Braked,  ///< braked to rest along the driven path, and continued along another one
        Better,  ///< continued along a quicker path, although the driven one stayed free
        Stopped  ///< no motion was found: a safe stop
    };

    /** \brief A change of the world during a drive, and the reaction to it. */
    struct Reaction
    {
        double time{0.0};                       ///< seconds since the first command
        ReactionKind kind{ReactionKind::Kept};  ///< the result
        double updateTime{0.0};                 ///< seconds, to perceive and to update the world
        double checkTime{0.0};                  ///< seconds, to check the driven motion
        double planningTime{0.0};               ///< seconds, for a new motion
    };

    /** \brief One plan and the drive along it. */
    struct ParkingLeg
    {
        std::string reason;  ///< why it was planned: "first plan", "the map has changed", ...
        double begin{0.0};   ///< seconds since the first command
        /** The latest plan. Its path has no pieces if the car already stands at the goal. */
        ParkingPlan plan;
        /** The driven trajectory with all new motions; absent if the path itself is driven. */
        std::optional<QuickestTrajectory> trajectory;
        double optimizationTime{0.0};  ///< seconds
        DriveResult drive;             ///< empty without a plan, or if the car already stands at the goal
    };

    /** \brief Result of parking, with the output of every stage. */
    struct ParkingResult
    {
        ParkingStatus status{ParkingStatus::NoPath};  ///< final status
        std::string message;                          ///< one line: the result, or the reason of the failure
        std::vector<ParkingLeg> legs;                 ///< one per plan; more than one after replanning
        /** All drives on one clock, planning time excluded; two equal points if the car never moves. */
        Trajectory trajectory;
        Evaluation evaluation;     ///< of all drives in total, with final errors relative to the goal
        double planningTime{0.0};  ///< seconds, of all plans and trajectories

        /** \brief Whether the car stands at its goal. */
        bool parked() const
        {
            return status == ParkingStatus::Parked;
        }

        /** \brief Events of all drives and plans, with their times. */
        std::vector<std::string> events;

        std::vector<Reaction> reactions;  ///< to changes of the world, in order of time
        DriveHistory history;             ///< what the car has seen and planned
    };

    /** \brief The whole pipeline of the paper in one call: it plans, smooths and drives in a given map, for a given
        car, start and slot.

        If a change of the map blocks the rest of the trajectory, the car continues on a new one without a stop: it
       starts where the car will be, with its speed and steering angle. If that is not possible, the car brakes, and the
       new trajectory continues from there (see replan()).

        The car stops, plans again from its estimated pose and drives on in these cases:
        - A change of the map blocks the rest of the path, and no trajectory is found from the moving car.
        - The car strays from the path, or its wheels do not follow.
        - Its pose was lost for a while.
        - It could not stop in time if it drove on.
        - It stands too far from the goal.

        A change of the map that leaves the rest of the path free does not affect the drive. */
    class AutomaticParking
    {
    public:
        /** \brief Returns a changed world, or nothing if it is unchanged. It is called each period with the seconds
            since the first command and the estimated pose of the car.

            Obstacles, goals and slot of the new scenario apply; its start and its car are ignored. Its coordinates must
            be those of the first one (same worldOffset). An invalid scenario leads to a safe stop. */
        using MapUpdate = std::function<std::optional<Scenario>(double time, const Pose &car)>;

        /** \brief Throws parking::Error for parameters out of their range. */
        explicit AutomaticParking(const ParkingParameters &parameters = {});

        /** \brief The parameters as given. */
        const ParkingParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Sets the function that reports changes of the world. If it is empty, the world is constant. */
        void setMapUpdate(MapUpdate update);

        /** \brief Sets the sensors of the car. The obstacles of a scenario then serve only for the collision check of
            the simulated drive; the car knows what it has perceived.

            The car plans on ground that it has not seen, unless \e parameters forbid it, and round the expected
            continuations of seen obstacles, if such a plan exists. It drives only as fast as it can stop on ground that
            it has seen. A perception that throws leads to a safe stop.

            \param perception one per drive, since it has a clock; null removes it
            Throws parking::Error for invalid parameters. */
        void setPerception(std::shared_ptr<Perception> perception, const PerceptionParameters &parameters = {});

        /** \brief Parks the car of \e scenario.

            Throws parking::Error for an invalid scenario (no goal, an invalid car). All other failures are in the
            result.
            \param start actual pose of the car, if it differs from that of the scenario */
        ParkingResult park(const Scenario &scenario, const std::optional<Pose> &start = std::nullopt) const;

        /** \brief Drives a given path, for example of an OMPL planner, in the world of \e scenario without replanning.
            The result has one leg, whose plan contains only the path. */
        ParkingResult drive(const Scenario &scenario, const Path &path) const;

    private:
        class Session;

        ParkingParameters parameters_;
        MapUpdate update_;
        std::shared_ptr<Perception> perception_;
        PerceptionParameters perceptionParameters_;
    };

    /** \brief How a car has reacted to changes of the world during a drive. */
    struct ReactionFigures
    {
        std::size_t stops{0};       ///< stops to plan, on the way and between legs
        std::size_t newMotions{0};  ///< motions that have replaced the driven one
        TimeStatistics check;       ///< seconds, of all changes: to take over the change and to check the driven motion
        TimeStatistics motion;      ///< seconds, of new motions: the same and planning
    };

    /** \brief The figures of all reactions of a drive. */
    ReactionFigures reactionFigures(const ParkingResult &result);

    /** \brief Combines the figures of several consecutive drives into those of one drive. */
    Evaluation combined(const std::vector<Evaluation> &drives);
}  // namespace parking
