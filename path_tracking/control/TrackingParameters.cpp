#include "path_tracking/control/TrackingParameters.h"

#include "parking_geometry/text/Require.h"

namespace parking
{
    namespace
    {
        void checkShare(const Require &require, const char *field, double value)
        {
            require.that(value > 0.0 && value <= 1.0, field, value, "above 0 and up to 1");
        }
    }  // namespace

    void TrackingParameters::validate() const
    {
        const Require require("tracking");
        mpc.validate();
        reference.validate();
        checkShare(require, "speedShare", speedShare);
        checkShare(require, "accelerationShare", accelerationShare);
        checkShare(require, "steeringRateShare", steeringRateShare);
        response.validate();
        require.that(brakeReserve >= 0.0 && brakeReserve < 1.0, "brakeReserve", brakeReserve, "at least 0 and below 1");
        require.notNegative("guardWaitLimit", guardWaitLimit);
        require.notNegative("poseWaitLimit", poseWaitLimit);
        require.notNegative("wheelWaitLimit", wheelWaitLimit);
        require.positive("lateralAcceleration", lateralAcceleration);
        require.positive("stopTolerance", stopTolerance);
        require.positive("arrivalTolerance", arrivalTolerance);
        require.positive("settleTime", settleTime);
        require.positive("steeringTolerance", steeringTolerance);
        require.positive("maxCrossTrack", maxCrossTrack);
        require.positive("maxHeadingError", maxHeadingError);
        require.that(maxFailures >= 0, "maxFailures", maxFailures, "a count that is not negative");
    }

    SpeedLimits TrackingParameters::limits(const Vehicle &vehicle) const
    {
        SpeedLimits limits = SpeedLimits::of(vehicle);
        limits.speed *= speedShare;
        limits.acceleration *= accelerationShare;
        limits.steeringRate *= steeringRateShare;
        limits.lateralAcceleration = lateralAcceleration;
        return limits;
    }
}  // namespace parking
