#pragma once

#include "path_tracking/control/CarResponse.h"
#include "path_tracking/control/Mpc.h"
#include "path_tracking/reference/ReferencePath.h"
#include "path_tracking/trajectory/SpeedProfile.h"

namespace parking
{
    /** \brief Parameters of a TrackingController. */
    struct TrackingParameters
    {
        MpcParameters mpc;              ///< of the controller on the legs, including its period
        ReferenceParameters reference;  ///< how the path is made drivable

        // The timed path keeps below the car's limits, so that the controller has something left to correct with.
        double speedShare{0.95};          ///< of the car's speed limit, in (0, 1]
        double accelerationShare{0.8};    ///< of the car's acceleration limit, in (0, 1]
        double steeringRateShare{0.8};    ///< of the car's steering rate, in (0, 1]
        double lateralAcceleration{1.0};  ///< m/s^2

        ResponseParameters response;  ///< initial knowledge of the car's response to commands
        /** Assumed loss of braking, as a share, in the stopping path that a guard receives. */
        double brakeReserve{0.2};
        double guardWaitLimit{1.0};  ///< seconds that a guard may keep the car standing before a safe stop

        double stopTolerance{0.005};      ///< metres before the end of a leg at which a standing car has arrived
        double settleTime{1.5};           ///< seconds to arrive after the timed path has ended
        double arrivalTolerance{0.15};    ///< metres from the end of the path; farther off the car has not arrived
        double steeringTolerance{0.005};  ///< radians, error of the wheels below which the car starts to move

        double maxCrossTrack{0.5};    ///< metres beside the path beyond which the car stops
        double maxHeadingError{0.7};  ///< radians off the heading of the path beyond which the car stops
        /** Seconds that a car which stopped without a pose waits for it. */
        double poseWaitLimit{10.0};
        double wheelWaitLimit{10.0};  ///< seconds that a car which stopped for stuck wheels waits for them
        int maxFailures{3};           ///< consecutive solver failures or unusable measurements before the car stops

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;

        /** \brief The limits of the timed path for \e vehicle. */
        SpeedLimits limits(const Vehicle &vehicle) const;
    };
}  // namespace parking
