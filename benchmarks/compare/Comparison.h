#pragma once

#include "benchmarks/compare/BenchmarkOptions.h"
#include "benchmarks/compare/UnitRunner.h"
#include "benchmarks/config/Experiment.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/store/RunRecord.h"
#include "benchmarks/store/RunStore.h"

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief Outcome of a comparison. */
    struct ComparisonResult
    {
        std::string text;         ///< text for the terminal: the table and the files written
        std::string reportError;  ///< reason why the requested report is missing; empty otherwise
        std::size_t missing{0};   ///< number of missing runs
    };

    /** \brief A comparison from beginning to end: configuration, runs, results. */
    class Comparison
    {
    public:
        /** \brief Reads the configuration and all scenarios. Throws parking::Error. */
        Comparison(const BenchmarkOptions &options, const PlannerRegistry &registry);

        /** \brief Executes all unfinished runs of this shard.

            Runs of an earlier start with the same configuration count as finished, also when other planners have
            changed. Creates the output folder after all settings were found valid, and locks the database until the
            end.

            \param stop set to true to end before the next run
            \return whether all runs are finished. Throws parking::Error. */
        bool run(const std::atomic<bool> &stop);

        /** \brief Writes logs, tables, pictures and report from the finished runs, after merging other parts if the
            options require it.

            Each file is replaced when its successor is complete, so that a call can be repeated at any time. Temporary
            files of killed processes are removed. Throws parking::Error, also while another process writes in the
            folder. */
        ComparisonResult write();

        /** \brief The database of this shard's runs. */
        std::string database() const;

    private:
        /** Throws when an output would overwrite an input. */
        void protectInputs() const;
        /** Reports experiments without a possible solution, with the reason. */
        void reportUnsolvable(UnitRunner &runner) const;
        /** Rows of the table `experiments` with the settings of the configuration. */
        std::vector<Row> experimentRows() const;
        /** Rows of the table `experiments` with the settings, the machine and the date. */
        std::vector<Row> experimentsOf(UnitRunner &runner) const;
        using Fingerprints = std::map<std::pair<std::string, std::string>, std::string>;
        /** By experiment and planner: a digest of everything that affects the runs, including the program unless
            merging. */
        Fingerprints fingerprints() const;
        void select(const Fingerprints &fingerprints);
        /** Databases of other parts, to be merged. */
        std::vector<std::string> parts() const;
        void mergeParts();
        /** Writes log, paths and picture of an experiment. */
        void writeExperiment(const Experiment &experiment, const std::vector<RunRecord> &records) const;

        BenchmarkOptions options_;
        const PlannerRegistry &registry_;
        BenchmarkConfig config_;
        std::vector<Experiment> experiments_;
        std::string folder_;
        std::unique_ptr<RunStore> store_;
    };
}  // namespace parking
