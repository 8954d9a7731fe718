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
    /** \brief Parameters of a simulated drive. */
    struct ClosedLoopParameters
    {
        TrackingParameters tracking;  ///< of the controller
        Disturbances disturbances;    ///< differences between the simulated car and the controller's model

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief Median, 99th percentile and maximum of a set of durations (nearest rank; 0 for an empty set). */
    struct TimeStatistics
    {
        double median{0.0};  ///< in the unit of the values
        double p99{0.0};     ///< 99th percentile, in the unit of the values
        double max{0.0};     ///< in the unit of the values
    };

    /** \brief The statistics of \e values in any order. */
    TimeStatistics timeStatistics(std::vector<double> values);

    /** \brief The paper's evaluation parameters of a drive ("Evaluation Parameters"), and further figures.

        The planner measures its own planning time. The paper leaves its averages undefined. Here every average is over
        time, from the first command to the last standstill, standstills included. Accelerations and steering angles
        enter with their absolute value. */
    struct Evaluation
    {
        double plannedLength{0.0};        ///< metres of the reference
        double drivenLength{0.0};         ///< metres of the rear axle, both directions counted positive
        double plannedTime{0.0};          ///< seconds of the timed reference
        double travelTime{0.0};           ///< seconds from the first command to the last standstill
        double meanAbsAcceleration{0.0};  ///< m/s^2, time average of |dv/dt|
        double meanAbsSteering{0.0};      ///< radians, time average of |delta|
        double maxCrossTrack{0.0};        ///< metres, largest distance of the rear axle from the reference's leg
        double meanCrossTrack{0.0};       ///< metres, time average of the distance from the leg, while on a leg
        /** Metres, largest distance from the nearest place of the leg, including its ends. */
        double maxPositionError{0.0};
        double maxHeadingError{0.0};      ///< radians, against the heading at the nearest place of the leg
        double finalPositionError{0.0};   ///< metres from the last pose of the given path
        double finalYawError{0.0};        ///< radians, absolute, from the last pose of the given path
        double finalReferenceError{0.0};  ///< metres from the last pose of the reference (differs by rounded corners)
        double cornerDeviation{0.0};      ///< metres between path and reference at sharp corners
        /** Metres, minimum clearance along the drive; infinite without a clearance function. */
        double minClearance{std::numeric_limits<double>::infinity()};
        std::size_t collisions{0};      ///< checked poses in collision
        std::size_t checkedPoses{0};    ///< 0 without a clearance function
        std::size_t standstills{0};     ///< between legs
        TimeStatistics solveTime;       ///< seconds per optimisation
        std::size_t solves{0};          ///< optimisations, one per period on a leg
        std::size_t solverFailures{0};  ///< optimisations whose solution was unusable
    };

    /** \brief Record of one period of a drive. */
    struct DriveRecord
    {
        double t{0.0};             ///< seconds, start of the period
        Plant::State car;          ///< actual state at the start of the period
        Measurement measurement;   ///< received by the controller
        TrackingStep control;      ///< output of the controller
        double crossTrack{0.0};    ///< metres left of the reference, of the true pose
        double headingError{0.0};  ///< radians, of the true pose
    };

    /** \brief Result of a drive. */
    struct DriveResult
    {
        bool arrived{false};              ///< standing at the end of the path, not after a safe stop
        std::string message;              ///< why it ended: "arrived", or the reason of the stop
        Trajectory trajectory;            ///< driven trajectory, one point per period and one at the end
        std::vector<DriveRecord> log;     ///< a record per period
        std::vector<std::string> events;  ///< failures and stops, with their times
        Evaluation evaluation;            ///< figures of the drive
        ResponseParameters response;      ///< response of the car to commands, as learnt by the controller
    };

    /** \brief Drives a simulated car along a path or a timed motion.

        The controller runs once per period of the MPC, and the plant is integrated in steps of 5 ms. Collisions are
        checked each time the body has moved by 2 cm. A drive is stopped once it takes a minute more than twice its
        planned time. Equal inputs give equal results, except for the solver's times. */
    class ClosedLoop
    {
    public:
        /** \brief Signed distance in metres from the body at a pose to the nearest obstacle, or a lower bound of it. It
            is positive only at a free pose. */
        using Clearance = std::function<double(const Pose &)>;
        /** \brief Observer of each period. Returning false requests a safe stop, for example after a change of the
            map. */
        using Monitor = std::function<bool(const DriveRecord &)>;

        /** \brief Replaces the motion of follow() during the drive, called each period while the car drives or steers.

            It returns a motion that equals the followed one up to a time after TrackingStep::time, or nothing to keep
            it. */
        using Splice = std::function<std::optional<TimedMotion>(const DriveRecord &)>;

        /** \brief Throws parking::Error if \e vehicle or \e parameters are not valid. */
        ClosedLoop(const Vehicle &vehicle, const ClosedLoopParameters &parameters = {});

        /** \brief Sets the function that returns the distance to obstacles. If it is empty, nothing is checked. */
        void setClearance(Clearance clearance);

        /** \brief Sets the observer that may stop the drive; may be empty. */
        void setMonitor(Monitor monitor);

        /** \brief Sets the guard that checks each command (see TrackingController::Guard). */
        void setGuard(TrackingController::Guard guard);

        /** \brief Sets the function that replaces the motion of follow(); may be empty. */
        void setSplice(Splice splice);

        /** \brief Drives along \e path.

            \param start actual pose of the car; if absent, the start of the path
            \param initialSteering radians, of the wheels
            Throws parking::Error for a path that cannot be used or takes more than LONGEST_MOTION. Failures during the
            drive are in the result. */
        DriveResult drive(const Path &path, const std::optional<Pose> &start = std::nullopt,
                          double initialSteering = 0.0) const;

        /** \brief Drives \e motion with its timing. The wheels start at its initial angle.

            Throws parking::Error for a motion that cannot be used (see TimedReference). */
        DriveResult follow(const TimedMotion &motion, const std::optional<Pose> &start = std::nullopt) const;

    private:
        DriveResult run(TrackingController &controller, const Pose &goal, const Pose &start, double initialSteering,
                        const Splice &splice) const;

        Vehicle vehicle_;
        ClosedLoopParameters parameters_;
        Clearance clearance_;
        Monitor monitor_;
        Splice splice_;
        TrackingController::Guard guard_;
    };
}  // namespace parking
