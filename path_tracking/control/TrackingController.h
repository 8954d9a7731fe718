#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/control/CarResponse.h"
#include "path_tracking/control/Mpc.h"
#include "path_tracking/control/PoseWatch.h"
#include "path_tracking/control/TrackingParameters.h"
#include "path_tracking/control/TrackingTypes.h"
#include "path_tracking/reference/TimedReference.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Activity of the controller. */
    enum class TrackingMode
    {
        Steering,  ///< standing, steering to the start of the leg, or to the required final angle
        Driving,   ///< on a leg
        Braking,   ///< braking on the path for a safe stop
        Waiting,   ///< standing after a safe stop until the pose is known or the wheels turn again
        Arrived,   ///< standing at the end of the path
        Stopped    ///< standing after a safe stop
    };

    /** \brief Output of the controller for one period. */
    struct TrackingStep
    {
        Command command;                            ///< for the car in this period
        TrackingMode mode{TrackingMode::Steering};  ///< at the end of this period
        std::size_t leg{0};                         ///< index into the legs of the reference
        Pose estimate;                              ///< of the car, filtered
        double s{0.0};                              ///< metres along the reference
        double time{0.0};                           ///< seconds since the start of the reference, by the clock
        double crossTrack{0.0};                     ///< metres to the left of the reference, of the estimate
        double headingError{0.0};                   ///< radians
        bool solved{false};                         ///< whether the optimiser ran
        bool solverFailed{false};                   ///< whether its solution was unusable
        double solveTime{0.0};                      ///< seconds
        int iterations{0};                          ///< of the optimiser
        /** Why the car stands after a safe stop although another drive may continue from here. Either the lost pose or
            the wheels have recovered, or the guard kept the car from moving on. Empty otherwise. */
        std::string interruption;
        /** Path from the estimate if the car obeys this command and then stops. It accounts for the learnt delay and
            lags, and for the reserve of braking. Set for guards only. */
        Path stoppingPath;
        std::string event;  ///< a failure, or the reason of a stop; otherwise empty
    };

    /** \brief Drives a timed path or motion: model predictive control on the legs, steering at standstill between them.

        A clock of the controller selects the reference of the horizon. It advances with time but waits for a car that
        falls behind. At the end of a leg the car stops, and steers to the start of the next leg before it moves. Legs
        need not begin or end with a period: the rest of a period belongs to the next leg.

        The pose is filtered: measured speed and steering predict it, and a share of the difference to the measured pose
        corrects it. Delays of commands are compensated: the horizon starts at the predicted pose on arrival.

        Safety: a guard may reject a command because of the path to a stop after it. The car then brakes along the path
        until the guard accepts a command. If the optimiser fails, the rest of its last solution is used for a few
        periods.

        The car makes a safe stop after repeated failures, without a pose, or far from the path. It brakes with full
        deceleration, and a simple feedback law without an optimiser steers it along the path. It then waits for the
        pose or the wheels. Once they recover, the drive is over and another one can begin.

        Every command obeys the car's limits. */
    class TrackingController
    {
    public:
        /** \brief Solver of the problem of a period. The controller checks each solution. */
        using Solve = std::function<MpcSolution(const MpcProblem &)>;
        /** \brief Whether a command is allowed. Otherwise the car brakes in this period.

            The car must be able to stop after an allowed command. A guard that rejects commands whose stopping path
            collides therefore prevents collisions, as long as the car performs as assumed. */
        using Guard = std::function<bool(const TrackingStep &)>;

        /** \brief Plans the drive along \e path from \e initialSteering.

            \param solve replaces the optimiser, for example to simulate failures; empty: Mpc
            Throws parking::Error for a path, a vehicle or parameters that cannot be used. */
        TrackingController(const Path &path, const Vehicle &vehicle, const TrackingParameters &parameters = {},
                           double initialSteering = 0.0, Solve solve = {});

        /** \brief Follows \e reference with its timing.

            Throws parking::Error for a vehicle or parameters that cannot be used, or a null reference. */
        TrackingController(std::shared_ptr<const TimedReference> reference, const Vehicle &vehicle,
                           const TrackingParameters &parameters = {}, double initialSteering = 0.0, Solve solve = {});

        /** \brief The timed legs that the controller follows. */
        const TimedReference &reference() const
        {
            return *reference_;
        }

        /** \brief The parameters as given. */
        const TrackingParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief The mode after the last step(). */
        TrackingMode mode() const
        {
            return mode_;
        }

        /** \brief Whether the drive is over, successfully or not. */
        bool finished() const
        {
            return mode_ == TrackingMode::Arrived || mode_ == TrackingMode::Stopped;
        }

        /** \brief Computes the command of the next period (of parameters().mpc.step seconds). */
        TrackingStep step(const Measurement &measurement);

        /** \brief Sets the guard that checks each command on a leg; may be empty. */
        void setGuard(Guard guard);

        /** \brief Replaces the part of the reference that is still ahead, while the car drives or steers.

            The legs before, and the state at the controller's clock, must be those of the present reference. Speed and
            steering are then continuous.

            \return whether it was replaced; not if the car makes a safe stop or has finished its last leg
            Throws parking::Error for a null reference or one that differs before. */
        bool replaceReference(std::shared_ptr<const TimedReference> reference);

        /** \brief Requests a safe stop, which begins with the next step. \param reason text of its event */
        void requestStop(const std::string &reason);

        /** \brief The learnt response of the car to commands, with which its next controller may start. */
        ResponseParameters learntResponse() const
        {
            return response_.learnt();
        }

    private:
        static constexpr double STANDING = 0.01;  // m/s that count as standing
        static constexpr double SEARCH = 1.5;     // metres of path searched for the car on either side

        const TimedLeg &leg() const
        {
            return reference_->legs()[leg_];
        }

        const PoseEstimator &estimator() const
        {
            return response_.estimator();
        }

        void takeMeasurement(const Measurement &measurement, TrackingStep &step);
        void locate(TrackingStep &step);
        void watch(TrackingStep &step);
        bool legOver() const;
        bool isNearlyStanding() const;
        bool mayReverse() const;
        void nextLeg(TrackingStep &step);
        void arrive(TrackingStep &step);
        void beginStop(const std::string &reason, TrackingStep &step);
        void steer(TrackingStep &step);
        void drive(TrackingStep &step);
        void brake(TrackingStep &step);
        void wait(TrackingStep &step);
        void waitForPose(TrackingStep &step);
        void waitForWheels(TrackingStep &step);
        Command braking(const CarState &car, const PathProjection &place, double last) const;
        Path stoppingPath(const Command &command) const;
        void askGuard(TrackingStep &step);
        Command standStill(double speed, double last, double steering, double rate) const;
        Command stand(double steering) const;
        MpcProblem makeProblem(const CarState &car) const;
        double overGround(double acceleration, const CarState &car) const;
        Command commandFor(const MpcControl &control, const CarState &car) const;
        double steeringAt(double time) const;
        void endWithPeriod(const CarState &car, TrackingStep &step);
        MpcSolution solve(const MpcProblem &problem);
        double withinSpeedLimit(double acceleration, const CarState &car) const;
        bool useOldPlan(const std::string &why, const CarState &car, TrackingStep &step);

        Vehicle vehicle_;
        TrackingParameters parameters_;
        std::shared_ptr<const TimedReference> reference_;
        Mpc mpc_;
        Solve solve_;

        Guard guard_;

        CarResponse response_;

        TrackingMode mode_{TrackingMode::Steering};
        std::size_t leg_{0};
        bool turnsLast_{false};  // whether only the final steering at standstill remains
        double clock_{0.0};      // seconds since the motion on the leg began, of the reference
        double waited_{0.0};     // seconds of waiting for the wheels, or with a stopped clock
        double wheelsOff_{0.0};  // radians between the wheels and where the leg begins, a period ago
        bool started_{false};
        double s_{0.0};
        double beyond_{0.0};                                       // metres past an end of the leg
        MpcControl last_;                                          // commanded in the last period
        double refused_{0.0};                                      // seconds that the guard has kept the car standing
        double allowed_{std::numeric_limits<double>::infinity()};  // seconds since the guard refused a command
        std::vector<MpcControl> plan_;
        std::size_t planAge_{0};
        int failures_{0};
        PoseWatch poseWatch_;
        std::optional<double> stuckAt_;  // radians, of wheels that the car stops for
        double wheelsAwaited_{0.0};      // seconds, standing
        std::string stopRequest_;
    };
}  // namespace parking
