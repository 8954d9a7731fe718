#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/control/TrackingController.h"
#include "path_tracking/simulation/Plant.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief How a drive is simulated. */
    struct ClosedLoopParameters
    {
        TrackingParameters tracking;  ///< of the controller
        Disturbances disturbances;    ///< what makes the simulated car differ from the controller's model

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief Median, 99th percentile and maximum of a set of durations (nearest rank; 0 for an empty set). */
    struct TimeStatistics
    {
        double median{0.0};  ///< in the unit of the values
        double p99{0.0};     ///< likewise
        double max{0.0};     ///< likewise
    };

    /** \brief The paper's evaluation parameters of a drive ("Evaluation Parameters"; planning time is the planner's),
        and what else is worth knowing.

        The paper leaves its averages undefined. Here: every average is over time, from the first command to the last
        standstill, standstills included; accelerations and steering angles enter with their absolute value. */
    struct Evaluation
    {
        double plannedLength{0.0};        ///< metres of the reference
        double drivenLength{0.0};         ///< metres of the rear axle, both directions counted positive
        double plannedTime{0.0};          ///< seconds of the timed reference
        double travelTime{0.0};           ///< seconds from the first command to the last standstill
        double meanAbsAcceleration{0.0};  ///< m/s^2, time average of |dv/dt|
        double meanAbsSteering{0.0};      ///< radians, time average of |delta|
        double maxCrossTrack{0.0};        ///< metres, largest distance of the rear axle from the reference's leg
        double meanCrossTrack{0.0};       ///< metres, time average of it while on a leg
        double maxPositionError{0.0};     ///< metres, largest distance from the nearest place of the leg, its ends too
        double maxHeadingError{0.0};      ///< radians, against the heading at the nearest place of the leg
        double finalPositionError{0.0};   ///< metres from the last pose of the path as it was given
        double finalYawError{0.0};        ///< radians, absolute, likewise
        double finalReferenceError{0.0};  ///< metres from the last pose of the reference (differs by rounded corners)
        double cornerDeviation{0.0};      ///< metres between path and reference, where it has sharp corners
        /** Metres, least of the clearances along the drive; infinity without a clearance to ask. */
        double minClearance{std::numeric_limits<double>::infinity()};
        std::size_t collisions{0};      ///< checked poses in collision
        std::size_t checkedPoses{0};    ///< 0 when there was nobody to ask
        std::size_t standstills{0};     ///< between legs
        TimeStatistics solveTime;       ///< seconds per optimisation
        std::size_t solves{0};          ///< optimisations, one for each period on a leg
        std::size_t solverFailures{0};  ///< of these, with an answer that was of no use
    };

    /** \brief One period of the drive. */
    struct DriveRecord
    {
        double t{0.0};             ///< seconds, begin of the period
        Plant::State car;          ///< what it was really doing then
        Measurement measurement;   ///< what the controller was told
        TrackingStep control;      ///< what it made of it
        double crossTrack{0.0};    ///< metres left of the reference, of the true pose
        double headingError{0.0};  ///< radians, of the true pose
    };

    /** \brief What came of a drive. */
    struct DriveResult
    {
        bool arrived{false};              ///< standing at the end of the path, not after a safe stop
        std::string message;              ///< why it ended: "arrived", or the reason of the stop
        Trajectory trajectory;            ///< the driven one, a point per period and one at the end
        std::vector<DriveRecord> log;     ///< a record per period
        std::vector<std::string> events;  ///< with their times: failures, stops
        Evaluation evaluation;            ///< figures of the drive
        ResponseParameters response;      ///< how the car follows its commands, as the controller has learnt it
    };

    /** \brief Drives a simulated car along a path, or through a motion in time.

        The controller runs once per period of the MPC, the plant is integrated in steps of 5 ms between, and collisions
        are checked wherever the body has moved by 2 cm. A drive that takes a minute more than twice its planned time is
        stopped. Equal inputs give equal results (but for the solver's times). */
    class ClosedLoop
    {
    public:
        /** \brief Signed distance in metres from the body at a pose to the nearest obstacle, positive only at a free
            pose; a lower bound will do. */
        using Clearance = std::function<double(const Pose &)>;
        /** \brief Looks at each period; returning false asks for a safe stop (a changed map, for example). */
        using Monitor = std::function<bool(const DriveRecord &)>;

        /** \brief Throws parking::Error when \e vehicle or \e parameters are not valid. */
        ClosedLoop(const Vehicle &vehicle, const ClosedLoopParameters &parameters = {});

        /** \brief Whom to ask how near obstacles are; empty: nothing is checked. */
        void setClearance(Clearance clearance);

        /** \brief Who may stop the drive; empty: nobody. */
        void setMonitor(Monitor monitor);

        /** \brief Asked before every command of a drive (see TrackingController::Guard). */
        void setGuard(TrackingController::Guard guard);

        /** \brief Drives along \e path.

            \param start where the car really stands; the begin of the path when absent
            \param initialSteering radians, of the wheels
            Throws parking::Error for a path that cannot be used or takes more than LONGEST_MOTION; what happens on
            the way is in the result. */
        DriveResult drive(const Path &path, const std::optional<Pose> &start = std::nullopt,
                          double initialSteering = 0.0) const;

        /** \brief Drives \e motion as it is timed; the wheels stand at first as they do there.

            Throws parking::Error for a motion that cannot be used (see TimedReference). */
        DriveResult follow(const TimedMotion &motion, const std::optional<Pose> &start = std::nullopt) const;

    private:
        DriveResult run(TrackingController &controller, const Pose &goal, const Pose &start,
                        double initialSteering) const;

        Vehicle vehicle_;
        ClosedLoopParameters parameters_;
        Clearance clearance_;
        Monitor monitor_;
        TrackingController::Guard guard_;
    };
}  // namespace parking
