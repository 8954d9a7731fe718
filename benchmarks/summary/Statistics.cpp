#include "benchmarks/summary/Statistics.h"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <limits>

namespace parking
{
    double quantile(std::vector<double> values, double share)
    {
        if (values.empty())
            return std::numeric_limits<double>::quiet_NaN();
        std::sort(values.begin(), values.end());
        const double position = share * static_cast<double>(values.size() - 1);
        const auto index = static_cast<std::size_t>(position);
        const double fraction = position - static_cast<double>(index);
        if (fraction == 0.0 || values[index] == values[index + 1])
            return values[index];
        return values[index] + fraction * (values[index + 1] - values[index]);
    }

    ConfidenceInterval medianInterval(std::vector<double> values, double level)
    {
        if (values.empty())
            return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(), 0.0};
        std::sort(values.begin(), values.end());
        const std::size_t count = values.size();
        const boost::math::binomial below(static_cast<double>(count), 0.5);
        // Ranks r and n + 1 - r (from 1) enclose the median with certainty 1 - 2 P(B <= r - 1).
        std::size_t rank = 0;
        double certainty = 0.0;
        for (std::size_t r = 1; 2 * r <= count; ++r)
        {
            const double candidate = 1.0 - 2.0 * boost::math::cdf(below, static_cast<double>(r - 1));
            if (candidate < level)
                break;
            rank = r;
            certainty = candidate;
        }
        if (rank == 0)
            return {values.front(), values.back(), 0.0};
        return {values[rank - 1], values[count - rank], certainty};
    }
}  // namespace parking
