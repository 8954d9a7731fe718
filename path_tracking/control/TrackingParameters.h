#pragma once

#include "path_tracking/control/CarResponse.h"
#include "path_tracking/control/Mpc.h"
#include "path_tracking/reference/ReferencePath.h"
#include "path_tracking/trajectory/SpeedProfile.h"

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

        ResponseParameters response;  ///< what is known beforehand of how the car follows its commands
        /** Share by which the car may slow down less than its data say: what a guard is told of the way that a stop
            takes. */
        double brakeReserve{0.2};
        double guardPatience{1.0};  ///< seconds that a guard may keep the car standing before it is a safe stop

        double stopTolerance{0.005};      ///< metres before the end of a leg at which standing still counts as arrived
        double settleTime{1.5};           ///< seconds granted for that after the timed path has ended
        double arrivalTolerance{0.15};    ///< metres from the end of the path; standing farther off is not arriving
        double steeringTolerance{0.005};  ///< radians, of the wheels before the car moves off

        double maxCrossTrack{0.5};    ///< metres beside the path; beyond it the car stops
        double maxHeadingError{0.7};  ///< radians, likewise
        /** Seconds that a car which has stopped because its pose was lost waits for it. */
        double posePatience{10.0};
        double wheelPatience{10.0};  ///< seconds, likewise, because its wheels did not follow their command
        int maxFailures{3};          ///< consecutive solver failures or unusable measurements; more and the car stops

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;

        /** \brief What the timed path may ask of \e vehicle. */
        SpeedLimits limits(const Vehicle &vehicle) const;
    };
}  // namespace parking
