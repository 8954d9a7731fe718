#pragma once

#include "benchmarks/config/BenchmarkConfig.h"

namespace parking
{
    /** \brief What single keys of a configuration do not tell: does all that is said of the problem, to all planners
       and to each, go together?

        Throws parking::Error naming file and line: for poses that lack a coordinate, a volume without an inside, a
        circle in a space of curves, and for the radius of a circle that there is none of. */
    void requireFittingSettings(const BenchmarkConfig &config);
}  // namespace parking
