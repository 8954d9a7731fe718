#pragma once

#include "benchmarks/comparison/Experiment.h"
#include "benchmarks/comparison/RunRecord.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace parking
{
    /** \brief The log of an experiment in OMPL's format, as ompl::tools::Benchmark writes it.

        \param header of the file of results: machine, date, seed
        \param records those of the experiment, in any order */
    std::string experimentLog(const BenchmarkConfig &config, const Experiment &experiment, const nlohmann::json &header,
                              const std::vector<const RunRecord *> &records);
}  // namespace parking
