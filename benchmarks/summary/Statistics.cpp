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
        const auto certainty = [&below](std::size_t rank)
        {
            return 1.0 - 2.0 * boost::math::cdf(below, static_cast<double>(rank) - 1.0);
        };
        auto rank = static_cast<std::size_t>(boost::math::quantile(below, 0.5 * (1.0 - level))) + 1;
        while (rank > 0 && (2 * rank > count || certainty(rank) < level))
            --rank;
        if (rank == 0)
            return {values.front(), values.back(), 0.0};
        return {values[rank - 1], values[count - rank], certainty(rank)};
    }
}  // namespace parking
