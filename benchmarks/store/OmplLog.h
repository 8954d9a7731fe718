#pragma once

#include "benchmarks/store/Database.h"

#include <string>

namespace parking
{
    /** \brief The log of an experiment in the format of ompl::tools::Benchmark, from the database of a comparison. */
    std::string omplLog(const Database &database, const std::string &experiment);
}  // namespace parking
