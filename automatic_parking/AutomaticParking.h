#pragma once

#include "automatic_parking/ParkingPlanner.h"
#include "automatic_parking/QuickestTrajectory.h"
#include "parking_geometry/Scenario.h"
#include "path_tracking/simulation/ClosedLoop.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Everything that parking may be tuned with. */
    struct ParkingParameters
    {
        PlanningParameters planning;  ///< of every plan, the first one and replans
        /** Of the controller and of the simulated car. The time of disturbances runs on from drive to drive. */
        ClosedLoopParameters drive;

        /** Drive the fastest trajectory near the path, the wheels turning while the car rolls; otherwise the path
           itself with standstills wherever its curvature jumps. */
        bool optimizeTrajectory{true};
        /** How that is found. The wheels begin where they are; margin and preferred clearance are at least
            what leastClearance and keptClearance make of the plan's clearance. */
        QuickestTrajectoryOptions trajectory;
        double keptClearance{0.2};    ///< metres that a trajectory prefers to keep where the plan does
        double leastClearance{0.15};  ///< metres that it does keep, where the plan does,
        double clearanceShare{0.9};   ///< and where it does not, this share of what that keeps
        /** Metres; a plan that keeps less is driven with standstills: there the errors of a moving car would tell. */
        double motionClearance{0.03};

        std::size_t maxReplans{3};        ///< plans after the first one
        double replanCrossTrack{0.25};    ///< metres beside the path at which the car stops and replans
        double replanHeadingError{0.35};  ///< radians off the path's heading, likewise
        double goalTolerance{0.15};       ///< metres from the goal; a car that stands farther off replans
        double goalYawTolerance{0.0349};  ///< radians (2 degrees), likewise
        /** Metres that the body keeps on the way that it needs to stop (half of what the plan keeps, where that is
           less, but 5 mm); a car that could not slows down before. What appears nearer to the way ahead is a reason to
           replan. drive.tracking.brakeReserve is what it counts on the brake for. */
        double stopClearance{0.03};
        double lookBack{0.1};  ///< metres of path behind the car that a changed map must leave free, too

        /** \brief Trajectories that leave a controller something to correct with, and the wheels at the end as they
            are. */
        ParkingParameters();

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief One plan and the drive along it. */
    struct ParkingLeg
    {
        std::string reason;  ///< why it was planned: "first plan", "the map has changed", ...
        double begin{0.0};   ///< seconds since the first command
        ParkingPlan plan;    ///< its path has no pieces where the car stands at the goal already
        /** What is driven; absent when the path itself is. */
        std::optional<QuickestTrajectory> trajectory;
        double optimizationTime{0.0};  ///< seconds
        DriveResult drive;  ///< empty when there was nothing to drive: no plan, or the car stands at the goal
    };

    /** \brief What came of parking; every stage's output is kept. */
    struct ParkingResult
    {
        ParkingStatus status{ParkingStatus::NoPath};  ///< how it ended
        std::string message;                          ///< one line
        std::vector<ParkingLeg> legs;                 ///< a plan each; more than one after replanning
        /** Of all drives, time running on; the car plans in no time. Of a car that stays: its pose, twice. */
        Trajectory trajectory;
        Evaluation evaluation;     ///< of all drives together, final errors against the goal
        double planningTime{0.0};  ///< seconds, all plans and trajectories

        /** \brief Does the car stand at its goal? */
        bool parked() const
        {
            return status == ParkingStatus::Parked;
        }

        /** \brief What happened on the way, with times; plans included. */
        std::vector<std::string> events;
    };

    /** \brief The whole pipeline of the paper behind one call: map, car, start and slot in; plan, smooth, drive; result
        out.

        Parking again and again on the way: when the map changes so that the rest of the path is blocked, when the car
        strays from the path, when its wheels do not follow, when its pose was lost for a while, when it could not stop
       in time if it went on, and when it stands too far from the goal, it stops, plans from where it believes to stand,
       and drives on. A change of the map that leaves the rest of the path free does not disturb the drive. */
    class AutomaticParking
    {
    public:
        /** \brief Asked each period for a world that has changed: seconds since the first command, and the pose that
            the car believes in. Nothing: all is as before.

            Obstacles, goals and slot of the new scenario count; its start and its car do not. Its coordinates must be
            those of the first one (same worldOffset). An invalid scenario leads to a safe stop. */
        using MapUpdate = std::function<std::optional<Scenario>(double time, const Pose &car)>;

        /** \brief Throws parking::Error for parameters out of their range. */
        explicit AutomaticParking(const ParkingParameters &parameters = {});

        /** \brief The parameters as given. */
        const ParkingParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Whom to ask for a changed world; empty: the world stays as it is. */
        void setMapUpdate(MapUpdate update);

        /** \brief Parks the car of \e scenario.

            Throws parking::Error for an invalid scenario (no goal, an invalid car); everything else is in
            the result.
            \param start where the car really stands, when that is not where the scenario believes it to be */
        ParkingResult park(const Scenario &scenario, const std::optional<Pose> &start = std::nullopt) const;

        /** \brief Drives a path from elsewhere, that of an OMPL planner for example, in the world of \e
            scenario and without replanning. The result has one leg, whose plan holds nothing but the path. */
        ParkingResult drive(const Scenario &scenario, const Path &path) const;

    private:
        class Session;

        ParkingParameters parameters_;
        MapUpdate update_;
    };

    /** \brief The figures of several drives, one after the other, as if they were one. */
    Evaluation combined(const std::vector<Evaluation> &drives);
}  // namespace parking
