#include "benchmarks/summary/Statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking
{
    namespace
    {
        /** Probability of at most \e k successes in \e n trials. */
        double binomialBelow(std::size_t k, std::size_t n, double p)
        {
            if (p <= 0.0)
                return 1.0;
            if (p >= 1.0)
                return k >= n ? 1.0 : 0.0;
            double sum = 0.0;
            const auto trials = static_cast<double>(n);
            for (std::size_t i = 0; i <= std::min(k, n); ++i)
            {
                const auto successes = static_cast<double>(i);
                sum += std::exp(std::lgamma(trials + 1.0) - std::lgamma(successes + 1.0) -
                                std::lgamma(trials - successes + 1.0) + successes * std::log(p) +
                                (trials - successes) * std::log1p(-p));
            }
            return std::min(1.0, sum);
        }

        /** The p at which a function of p that falls passes \e level. */
        template <class Falling>
        double solve(const Falling &falling, double level)
        {
            double low = 0.0, high = 1.0;
            for (int i = 0; i < 60; ++i)
            {
                const double middle = 0.5 * (low + high);
                (falling(middle) > level ? low : high) = middle;
            }
            return 0.5 * (low + high);
        }
    }  // namespace

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
        // Ranks r and n + 1 - r (from 1) enclose the median with certainty 1 - 2 P(B <= r - 1).
        std::size_t rank = 0;
        double certainty = 0.0;
        for (std::size_t r = 1; 2 * r <= count; ++r)
        {
            const double candidate = 1.0 - 2.0 * binomialBelow(r - 1, count, 0.5);
            if (candidate < level)
                break;
            rank = r;
            certainty = candidate;
        }
        if (rank == 0)
            return {values.front(), values.back(), 0.0};
        return {values[rank - 1], values[count - rank], certainty};
    }

    ConfidenceInterval shareInterval(std::size_t successes, std::size_t trials, double level)
    {
        if (trials == 0)
            return {0.0, 1.0, 0.0};
        const double tail = 0.5 * (1.0 - level);
        const double low =
            successes == 0 ? 0.0 : solve([&](double p) { return binomialBelow(successes - 1, trials, p); }, 1.0 - tail);
        const double high =
            successes == trials ? 1.0 : solve([&](double p) { return binomialBelow(successes, trials, p); }, tail);
        return {low, high, level};
    }
}  // namespace parking
