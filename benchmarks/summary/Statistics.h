#pragma once

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief The quantile of \e values for \e share in [0, 1]: linear between the two values next to it (Hyndman and
        Fan, "Sample quantiles in statistical packages", 1996, type 7). Infinite values count as the largest; NaN
        without values. */
    double quantile(std::vector<double> values, double share);

    /** \brief An interval with the share of certainty that it really has. */
    struct ConfidenceInterval
    {
        double low;    ///< in the unit of the values
        double high;   ///< likewise
        double level;  ///< at least what was asked for, or 0 when there are too few values for that
    };

    /** \brief A confidence interval for the median that assumes nothing of the distribution but that the values are
        independent draws from it.

        Its ends are two of the values: the number of values below the median is binomially distributed with p = 1/2 (W.
        J. Conover, "Practical nonparametric statistics", 1999, section 3.2). The narrowest symmetric pair of ranks
        whose certainty is at least \e level; below 6 values there is none for 95 %, and the result is the whole range
        with level 0. Infinite values are welcome: time-outs are values too. */
    ConfidenceInterval medianInterval(std::vector<double> values, double level = 0.95);
}  // namespace parking
