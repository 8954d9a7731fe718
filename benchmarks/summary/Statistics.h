#pragma once

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief The quantile of \e values for \e share in [0, 1]: linear between the two adjacent values (Hyndman and
        Fan, "Sample quantiles in statistical packages", 1996, type 7).
        Infinite values count as the largest; NaN without values. */
    double quantile(std::vector<double> values, double share);

    /** \brief An interval with its actual certainty. */
    struct ConfidenceInterval
    {
        double low;    ///< lower end, in the unit of the values
        double high;   ///< upper end, in the unit of the values
        double level;  ///< at least the requested level, or 0 with too few values
    };

    /** \brief A confidence interval for the median that only assumes independent draws from one distribution.

        Its ends are two of the values: the number of values below the median is binomially distributed with p = 1/2 (W.
        J. Conover, "Practical nonparametric statistics", 1999, section 3.2). The result is the narrowest symmetric pair
        of ranks with at least the certainty \e level. Fewer than 6 values have none for 95 %: the result is then the
        whole range with level 0. Infinite values, such as time-outs, are allowed. */
    ConfidenceInterval medianInterval(std::vector<double> values, double level = 0.95);
}  // namespace parking
