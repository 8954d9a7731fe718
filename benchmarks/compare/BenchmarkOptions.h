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
        bool help{false};                         ///< print the text of --help; all else but plugins is left out then
        std::string config;                       ///< the .cfg file
        std::string output;                       ///< folder; empty: what the configuration says, or results-NAME
        std::optional<double> timeLimit;          ///< seconds per run; without it: the configuration's
        std::optional<std::size_t> runCount;      ///< runs of each planner on each problem; likewise
        std::optional<std::uint_fast32_t> seed;   ///< of all random numbers; likewise
        std::vector<std::string> scenarios;       ///< instead of the configuration's
        std::vector<std::string> planners;        ///< of the configuration's, those to run; empty: all
        std::vector<std::string> plugins;         ///< libraries with planners, to be loaded
        std::size_t shard{0};                     ///< from 0
        std::size_t shards{1};                    ///< parts that the runs are divided into
        bool merge{false};                        ///< only put together what is there
        std::vector<std::string> inputs;          ///< to merge: files or folders; empty: the output folder
        bool fresh{false};                        ///< do all runs again, whatever is finished
        Isolation isolation{Isolation::Plugins};  ///< which runs have a process of their own
        bool report{true};                        ///< make the HTML report, too
        bool quiet{false};                        ///< tell no progress
    };

    /** \brief Reads a command line (without the program's name). Throws parking::Error with one line. */
    BenchmarkOptions readBenchmarkOptions(const std::vector<std::string> &arguments);

    /** \brief The text of --help. */
    std::string benchmarkHelp(const PlannerRegistry &registry);
}  // namespace parking
