#pragma once

#include "benchmarks/store/Database.h"

#include <string>

namespace parking
{
    /** \brief The log of an experiment as ompl::tools::Benchmark writes it, of what is in the database of a
        comparison. */
    std::string omplLog(const Database &database, const std::string &experiment);
}  // namespace parking
