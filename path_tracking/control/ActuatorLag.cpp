#include "path_tracking/control/ActuatorLag.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double MIN_ACCELERATION = 0.05;  // m/s^2, minimum for learning
        constexpr double SHORTEST_LAG = 1e-3;      // seconds; shorter lags count as none
        constexpr double LONGEST_LAG = 0.5;        // seconds
        constexpr double GAIN = 0.2;  // share of a period's estimate that is applied; higher for the first periods
    }                                 // namespace

    double unfollowed(double lag, double duration)
    {
        return lag > 0.0 ? lag / duration * (1.0 - std::exp(-duration / lag)) : 0.0;
    }

    LagStep::LagStep(double lag, double duration)
    {
        if (!(lag > 0.0))
            return;
        // With q = exp(-h / T): value' = c' - T / h (1 - q) (c' - c) - q (c - value).
        ofValue = std::exp(-duration / lag);
        const double late = unfollowed(lag, duration);
        ofCommand = 1.0 - late;
        ofBefore = late - ofValue;
    }

    void LagEstimator::learn(double duration, double change, double trailingBefore, double trailing, double least)
    {
        const double sign = change + trailingBefore > 0.0 ? 1.0 : -1.0;
        const double c = sign * change, b = sign * trailingBefore;
        // If both have the same sign, the trailing grows with the lag. A value that overtook its command is ignored.
        if (c + b < least || std::min(c, b) < -0.1 * least)
            return;
        double low = SHORTEST_LAG, high = LONGEST_LAG;
        for (int i = 0; i < 20; ++i)
        {
            const double middle = 0.5 * (low + high);
            const double expected = c * unfollowed(middle, duration) + b * std::exp(-duration / middle);
            (expected < sign * trailing ? low : high) = middle;
        }
        const double observed = low <= SHORTEST_LAG ? 0.0 : low;
        ++seen_;
        lag_ += std::max(GAIN, 1.0 / (1.0 + seen_)) * (observed - lag_);
        if (lag_ < SHORTEST_LAG)
            lag_ = 0.0;
    }

    void DriveLagEstimator::learn(double duration, double command, double speedBefore, double speed)
    {
        const double mean = (speed - speedBefore) / duration;
        const double trailing = command - mean;
        estimator_.learn(duration, command - commandBefore_, trailingBefore_, trailing, MIN_ACCELERATION);
        commandBefore_ = command;
        trailingBefore_ = trailing;
        const double lag = estimator_.lag();
        acceleration_ =
            lag > 0.0 ? command - std::exp(-duration / lag) * trailing / unfollowed(lag, duration) : command - trailing;
    }

    void DriveLagEstimator::hold()
    {
        acceleration_ = 0.0;
        commandBefore_ = 0.0;
        trailingBefore_ = 0.0;
    }
}  // namespace parking
