#include "path_tracking/simulation/Evaluation.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    TimeStatistics timeStatistics(std::vector<double> values)
    {
        if (values.empty())
            return {};
        std::sort(values.begin(), values.end());
        const auto rank = [&values](double share)
        {
            const auto n = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
            return values[std::max<std::size_t>(n, 1) - 1];
        };
        return {rank(0.5), rank(0.99), values.back()};
    }
}  // namespace parking
