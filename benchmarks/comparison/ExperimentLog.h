#pragma once

#include "benchmarks/comparison/Experiment.h"
#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/system/LockedFile.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The log of an experiment in OMPL's format, as ompl::tools::Benchmark writes it.

        \param header of the file of results: machine, date, seed
        \param records those of the experiment, in any order */
    std::string experimentLog(const BenchmarkConfig &config, const Experiment &experiment, const nlohmann::json &header,
                              const std::vector<const RunRecord *> &records);

    /** \brief Turns logs into a SQLite database in OMPL's schema with OMPL's own ompl_benchmark_statistics.

        While it lives no other process can write that database. */
    class DatabaseWriter
    {
    public:
        /** \brief Throws parking::Error when another process has it, or it cannot be written. */
        explicit DatabaseWriter(std::string database);
        ~DatabaseWriter();
        DatabaseWriter(const DatabaseWriter &) = delete;
        DatabaseWriter &operator=(const DatabaseWriter &) = delete;

        /** \brief A database that is there is replaced, once the new one is complete. Throws parking::Error when the
            program is missing or fails. */
        void write(const std::vector<std::string> &logs);

    private:
        std::string database_;
        std::optional<LockedFile> unfinished_;
    };

    /** \brief Throws parking::Error naming the package when ompl_benchmark_statistics is not there. */
    void requireStatisticsProgram();
}  // namespace parking
