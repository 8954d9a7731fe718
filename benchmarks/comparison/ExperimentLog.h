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

    /** \brief Turns logs into a SQLite database in OMPL's schema with OMPL's own ompl_benchmark_statistics; a database
        that is there is replaced, once the new one is complete. Throws parking::Error when the program is missing or
        fails. */
    void makeDatabase(const std::vector<std::string> &logs, const std::string &database);

    /** \brief Throws parking::Error naming the package when ompl_benchmark_statistics is not there. */
    void requireStatisticsProgram();
}  // namespace parking
