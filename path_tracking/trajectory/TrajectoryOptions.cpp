#include "parking_geometry/text/Require.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"

namespace parking
{
    void TrajectoryOptions::validate() const
    {
        const Require require("trajectory");
        require.notNegative("time weight", weights.time);
        require.notNegative("effort weight", weights.effort);
        require.notNegative("steering weight", weights.steering);
        require.notNegative("nearness weight", weights.nearness);
        require.notNegative("preferred clearance", preferredClearance, "metres");
        require.positive("time weight", weights.time);
        require.notNegative("margin", margin, "metres");
        const auto share = [&require](const char *what, double value)
        {
            require.that(value > 0.0 && value <= 1.0, what, value, "above 0 and up to 1");
        };
        share("share of the speed", speedShare);
        share("share of the acceleration", accelerationShare);
        share("share of the steering angle", steeringShare);
        share("share of the steering rate", steeringRateShare);
        require.that(step >= 0.02 && step <= 2.0, "step", step, "from 0.02 to 2 seconds");
        if (initialSteering)
            require.finite("initial steering angle", *initialSteering, "radians");
        if (finalSteering)
            require.finite("final steering angle", *finalSteering, "radians");
    }
}  // namespace parking
