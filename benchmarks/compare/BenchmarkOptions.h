#pragma once

#include "benchmarks/compare/UnitRunner.h"
#include "benchmarks/planners/PlannerRegistry.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The command line of parking_benchmark. */
    struct BenchmarkOptions
    {
        bool help{false};                        ///< print the text of --help; only plugins is read, too
        std::string config;                      ///< the .cfg file
        std::string output;                      ///< output folder; empty: the configuration's, or results-NAME
        std::optional<double> timeLimit;         ///< limit of each run in seconds; default: the configuration's
        std::optional<std::size_t> runCount;     ///< runs of each planner on each problem; default: the configuration's
        std::optional<std::uint_fast32_t> seed;  ///< seed of all random numbers; default: the configuration's
        std::vector<std::string> scenarios;      ///< scenarios that replace the configuration's; empty: those
        std::vector<std::string> planners;       ///< planners of the configuration to run; empty: all
        std::vector<std::string> plugins;        ///< files whose planners are loaded
        std::size_t shard{0};                    ///< index of the part to execute, from 0
        std::size_t shards{1};                   ///< number of parts that the runs are divided into
        bool merge{false};                       ///< whether to merge runs without executing any
        std::vector<std::string> inputs;         ///< files or folders to merge; empty: the output folder
        bool fresh{false};                       ///< whether to repeat finished runs
        Isolation isolation{Isolation::Plugins};  ///< selects the runs that execute in their own process
        bool report{true};                        ///< whether to write the HTML report
        bool quiet{false};                        ///< whether to suppress progress messages
    };

    /** \brief Reads a command line without the program's name. Throws parking::Error with a one-line reason. */
    BenchmarkOptions readBenchmarkOptions(const std::vector<std::string> &arguments);

    /** \brief The text of --help. */
    std::string benchmarkHelp(const PlannerRegistry &registry);
}  // namespace parking
