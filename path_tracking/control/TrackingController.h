#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/control/Mpc.h"
#include "path_tracking/control/TrackingTypes.h"
#include "path_tracking/reference/ReferencePath.h"
#include "path_tracking/reference/SpeedProfile.h"
#include "path_tracking/reference/TimedReference.h"
#include "path_tracking/simulation/ActuatorLag.h"
#include "path_tracking/simulation/PoseEstimator.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief How a path is driven. */
    struct TrackingParameters
    {
        MpcParameters mpc;              ///< of the controller on the legs, its period included
        ReferenceParameters reference;  ///< how the path is made drivable

        // The timed path keeps below the car's limits, so that the controller has something left to correct with.
        double speedShare{0.95};          ///< of the car's speed limit, in (0, 1]
        double accelerationShare{0.8};    ///< likewise
        double steeringRateShare{0.8};    ///< likewise
        double lateralAcceleration{1.0};  ///< m/s^2

        EstimatorParameters estimator;  ///< of the filter that tells where the car is
        double steeringLag{0.0};        ///< seconds that the wheels lag behind their command; learnt from there on
        double driveLag{0.0};           ///< seconds that the acceleration lags behind its command; learnt from there on

        double stopTolerance{0.005};      ///< metres before the end of a leg at which standing still counts as arrived
        double settleTime{1.5};           ///< seconds granted for that after the timed path has ended
        double arrivalTolerance{0.15};    ///< metres from the end of the path; standing farther off is not arriving
        double steeringTolerance{0.005};  ///< radians, of the wheels before the car moves off

        double maxCrossTrack{0.5};    ///< metres beside the path; beyond it the car stops
        double maxHeadingError{0.7};  ///< radians, likewise
        int maxFailures{3};           ///< consecutive solver failures or unusable measurements; more and the car stops

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;

        /** \brief What the timed path may ask of \e vehicle. */
        SpeedLimits limits(const Vehicle &vehicle) const;
    };

    /** \brief What the controller is about. */
    enum class TrackingMode
    {
        Steering,  ///< standing, turning the wheels to where the leg begins, or to where they shall end
        Driving,   ///< on a leg
        Braking,   ///< a safe stop: braking on the path
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
        std::string event;                          ///< empty, or what happened: a failure, the reason of a stop
    };

    /** \brief Drives a timed path or motion: model predictive control on the legs, steering at standstill between them.

        The horizon is filled from the reference by a clock of its own, which runs with time but waits for a car that
        falls behind. At the end of a leg the car comes to rest; the wheels are turned to where the next leg begins
        before it moves off. Legs need not begin or end with a period: what is left of one belongs to what follows. The
       pose is filtered: dead reckoning with measured speed and steering, corrected by a share of the difference to the
       measured pose.

        Safety: when the optimiser fails, the rest of its last answer is used for a few periods; when failures go on,
        the pose is lost or the car strays from the path, the car brakes with its full deceleration, steered along the
        path by a plain feedback law that needs no optimiser, and stands. Whatever happens, the command obeys the car's
        limits. */
    class TrackingController
    {
    public:
        /** \brief What answers the problem of a period; its answer is checked, whatever it is. */
        using Solve = std::function<MpcSolution(const MpcProblem &)>;

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

        /** \brief Asks for a safe stop; the next step begins it. \param reason appears as its event. */
        void requestStop(const std::string &reason);

    private:
        const TimedLeg &leg() const
        {
            return reference_->legs()[leg_];
        }

        bool takeMeasurement(const Measurement &measurement, TrackingStep &step);
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
        void standStill(TrackingStep &step, double steering, double rate);
        MpcProblem makeProblem() const;
        double steeringAt(double time) const;
        void endWithPeriod(TrackingStep &step);
        MpcSolution solve(const MpcProblem &problem);
        double withinSpeedLimit(double acceleration) const;
        bool useOldPlan(const std::string &why, TrackingStep &step);

        Vehicle vehicle_;
        TrackingParameters parameters_;
        std::shared_ptr<const TimedReference> reference_;
        Mpc mpc_;
        Solve solve_;

        PoseEstimator estimator_;
        SteeringLagEstimator steeringLag_;
        DriveLagEstimator driveLag_;
        bool held_{true};  // was the last command to hold the brake?

        TrackingMode mode_{TrackingMode::Steering};
        std::size_t leg_{0};
        bool turnsLast_{false};  // is it over but for the wheels, which turn to where they shall end?
        double clock_{0.0};      // seconds since the motion on the leg began, of the reference
        double waited_{0.0};     // seconds that the wheels have had to arrive, or that the clock has stood still
        double wheelsOff_{0.0};  // radians between the wheels and where the leg begins, a period ago
        bool started_{false};
        double s_{0.0};
        double beyond_{0.0};          // metres past an end of the leg
        double steeringBefore_{0.0};  // commanded the period before the last
        MpcControl last_;             // applied in the last period
        std::vector<MpcControl> plan_;
        std::size_t planAge_{0};
        int failures_{0};
        int lostMeasurements_{0};
        std::string stopRequest_;
    };
}  // namespace parking
