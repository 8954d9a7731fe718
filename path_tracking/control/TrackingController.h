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
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief What the controller is about. */
    enum class TrackingMode
    {
        Steering,  ///< standing, turning the wheels to where the leg begins, or to where they shall end
        Driving,   ///< on a leg
        Braking,   ///< a safe stop: braking on the path
        Waiting,   ///< standing after a safe stop until the pose is known, or the wheels turn, again
        Arrived,   ///< standing at the end of the path
        Stopped    ///< standing after a safe stop
    };

    /** \brief What the controller did and saw in one period. */
    struct TrackingStep
    {
        Command command;                            ///< for the car in this period
        TrackingMode mode{TrackingMode::Steering};  ///< after this period was decided
        std::size_t leg{0};                         ///< index into the legs of the reference
        Pose estimate;                              ///< of the car, filtered
        double s{0.0};                              ///< metres along the reference
        double crossTrack{0.0};                     ///< metres to the left of the reference, of the estimate
        double headingError{0.0};                   ///< radians
        bool solved{false};                         ///< was the optimiser asked?
        bool solverFailed{false};                   ///< and was its answer useless?
        double solveTime{0.0};                      ///< seconds
        int iterations{0};                          ///< of the optimiser
        /** Why the car stands after a safe stop though another drive may lead on from here: what it waited for is back,
            or the guard kept it from going on. Empty otherwise. */
        std::string interruption;
        /** What the car drives from the estimate on when it obeys this command and then stops: with the delay and the
            lags that were learnt, and the brake in reserve. Only a guard gets to see it. */
        Path stoppingWay;
        std::string event;  ///< empty, or what happened: a failure, the reason of a stop
    };

    /** \brief Drives a timed path or motion: model predictive control on the legs, steering at standstill between them.

        The horizon is filled from the reference by a clock of its own, which runs with time but waits for a car that
        falls behind. At the end of a leg the car comes to rest; the wheels are turned to where the next leg begins
        before it moves off. Legs need not begin or end with a period: what is left of one belongs to what follows. The
       pose is filtered: dead reckoning with measured speed and steering, corrected by a share of the difference to the
       measured pose.

        Commands that take their time to arrive are reckoned with: the horizon begins where the car will be by then.

        Safety: a guard may refuse a command, for the way that the car would need to stop after it; then the car brakes
        along the path instead, until the guard lets it go on. When the optimiser fails, the rest of its last answer is
       used for a few periods; when failures go on, the pose is lost or the car strays from the path, the car brakes
       with its full deceleration, steered along the path by a plain feedback law that needs no optimiser, and stands.
       There it waits for a pose that was lost, or for wheels that stick: when they are back the drive is over, and
       another one can begin.
       Whatever happens, the command obeys the car's limits. */
    class TrackingController
    {
    public:
        /** \brief What answers the problem of a period; its answer is checked, whatever it is. */
        using Solve = std::function<MpcSolution(const MpcProblem &)>;
        /** \brief May this be commanded? Otherwise the car brakes in this period.

            What it allows, it must have been able to stop after; so a guard that refuses what leads to a touch before
            standstill keeps a car that is as good as is assumed from any. */
        using Guard = std::function<bool(const TrackingStep &)>;

        /** \brief Plans the drive along \e path from \e initialSteering.

            \param solve replaces the optimiser (to try another one, or failures); empty: Mpc
            Throws parking::Error for a path, a vehicle or parameters that cannot be used. */
        TrackingController(const Path &path, const Vehicle &vehicle, const TrackingParameters &parameters = {},
                           double initialSteering = 0.0, Solve solve = {});

        /** \brief Follows \e reference, in the way that it is timed.

            Throws parking::Error for a vehicle or parameters that cannot be used, and without a reference. */
        TrackingController(std::shared_ptr<const TimedReference> reference, const Vehicle &vehicle,
                           const TrackingParameters &parameters = {}, double initialSteering = 0.0, Solve solve = {});

        /** \brief What is followed: the timed legs. */
        const TimedReference &reference() const
        {
            return *reference_;
        }

        /** \brief The parameters as given. */
        const TrackingParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief What the controller is about since the last step(). */
        TrackingMode mode() const
        {
            return mode_;
        }

        /** \brief Is the drive over, well or not? */
        bool finished() const
        {
            return mode_ == TrackingMode::Arrived || mode_ == TrackingMode::Stopped;
        }

        /** \brief Decides the next period (of parameters().mpc.step seconds). */
        TrackingStep step(const Measurement &measurement);

        /** \brief Whom to ask before each command on a leg; empty: nobody. */
        void setGuard(Guard guard);

        /** \brief Asks for a safe stop; the next step begins it. \param reason appears as its event. */
        void requestStop(const std::string &reason);

        /** \brief How the car follows its commands, as far as it has been learnt: what its next controller may begin
            with. */
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
        Path stoppingWay(const Command &command) const;
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
        bool turnsLast_{false};  // is it over but for the wheels, which turn to where they shall end?
        double clock_{0.0};      // seconds since the motion on the leg began, of the reference
        double waited_{0.0};     // seconds that the wheels have had to arrive, or that the clock has stood still
        double wheelsOff_{0.0};  // radians between the wheels and where the leg begins, a period ago
        bool started_{false};
        double s_{0.0};
        double beyond_{0.0};   // metres past an end of the leg
        MpcControl last_;      // commanded in the last period
        double refused_{0.0};  // seconds that the guard has kept the car standing
        std::vector<MpcControl> plan_;
        std::size_t planAge_{0};
        int failures_{0};
        PoseWatch poseWatch_;
        std::optional<double> stuckAt_;  // radians, of wheels that the car stops for
        double wheelsAwaited_{0.0};      // seconds, standing
        std::string stopRequest_;
    };
}  // namespace parking
