#pragma once

#include "benchmarks/comparison/Experiment.h"
#include "benchmarks/comparison/ResultStore.h"
#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/comparison/UnitRunner.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/programs/BenchmarkOptions.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief What a comparison left in its folder. */
    struct ComparisonFiles
    {
        std::string folder;                 ///< of all results
        std::vector<std::string> logs;      ///< OMPL's logs, one for each experiment with runs
        std::string database;               ///< SQLite, in OMPL's schema
        std::string table;                  ///< Markdown
        std::string csv;                    ///< the same table with all figures
        std::string report;                 ///< HTML; empty when there is no python3 to make it
        std::string reportError;            ///< why there is none although there should be
        std::vector<std::string> pictures;  ///< SVG, one for each experiment with runs
        std::size_t missing{0};             ///< runs that are not there
    };

    /** \brief A comparison from beginning to end: configuration, runs, results. */
    class Comparison
    {
    public:
        /** \brief Reads the configuration and all scenarios. Throws parking::Error. */
        Comparison(const BenchmarkOptions &options, const PlannerRegistry &registry);

        /** \brief Does all runs of this shard that are not finished; those of an earlier start with the same
            configuration count, also when other planners have changed since. Makes the output folder, once all settings
            are found to be right. From then on until the end no other process can write the file of runs; one of a
            different comparison is set aside.

            \param stop once true, ends before the next run
            \return whether all are done. Throws parking::Error. */
        bool run(const std::atomic<bool> &stop);

        /** \brief Puts the finished runs together: logs, database, tables, pictures, report. Each replaces what was
            there once it is whole, so that it can be done again at any time; what killed processes have left unfinished
            goes away. Throws parking::Error, also while another process does the same in the folder. */
        ComparisonFiles write();

        /** \brief As the file says, with what the command line changes. */
        const BenchmarkConfig &config() const
        {
            return config_;
        }

        /** \brief Of all results. */
        const std::string &folder() const
        {
            return folder_;
        }
        /** \brief The file of this shard's runs. */
        std::string runsFile() const;

        /** \brief The table for the terminal, of what write() has put together. */
        const std::string &summary() const
        {
            return summary_;
        }

    private:
        nlohmann::json header(const std::vector<std::string> &setups) const;
        std::vector<std::string> inputs() const;
        /** By experiment and planner: of everything that its runs depend on, the program included. */
        nlohmann::json fingerprints() const;
        void openStore(const std::vector<std::string> &setups);
        /** Throws when something that is read would be written over. */
        void protectInputs() const;
        /** Says which experiments nobody can solve, and why. */
        void tellUnsolvable(UnitRunner &runner) const;
        /** Is it one of this comparison's, whatever program did it? */
        bool isWanted(const RunRecord &record) const;
        void gather();
        /** Log, paths and picture. */
        void writeExperiment(const Experiment &experiment, ComparisonFiles &files) const;

        BenchmarkOptions options_;
        const PlannerRegistry &registry_;
        BenchmarkConfig config_;
        std::vector<Experiment> experiments_;
        std::string folder_;
        std::unique_ptr<ResultStore> store_;
        nlohmann::json header_;
        std::vector<RunRecord> records_;
        std::string summary_;
    };
}  // namespace parking
