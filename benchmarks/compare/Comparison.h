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
    /** \brief What is to be said of a comparison. */
    struct ComparisonResult
    {
        std::string text;         ///< the table for the terminal, and the files that were written
        std::string reportError;  ///< why there is no report although there should be
        std::size_t missing{0};   ///< runs that are not there
    };

    /** \brief A comparison from beginning to end: configuration, runs, results. */
    class Comparison
    {
    public:
        /** \brief Reads the configuration and all scenarios. Throws parking::Error. */
        Comparison(const BenchmarkOptions &options, const PlannerRegistry &registry);

        /** \brief Does all runs of this shard that are not finished; those of an earlier start with the same
            configuration count, also when other planners have changed since. Makes the output folder, once all settings
            are found to be right. From then on until the end no other process can write the database.

            \param stop once true, ends before the next run
            \return whether all are done. Throws parking::Error. */
        bool run(const std::atomic<bool> &stop);

        /** \brief Makes of the finished runs, those of other parts merged where the options say so, logs, tables,
            pictures and report. Each replaces what was there once it is whole, so that it can be done again at any
            time; what killed processes have left unfinished goes away. Throws parking::Error, also while another
            process does the same in the folder. */
        ComparisonResult write();

        /** \brief The database of this shard's runs. */
        std::string database() const;

    private:
        /** Throws when something that is read would be written over. */
        void protectInputs() const;
        /** Says which experiments nobody can solve, and why. */
        void tellUnsolvable(UnitRunner &runner) const;
        /** Rows of the table `experiments`: what the configuration says of each. */
        std::vector<Row> experimentRows() const;
        /** The same with machine and date. */
        std::vector<Row> experimentsOf(UnitRunner &runner) const;
        using Fingerprints = std::map<std::pair<std::string, std::string>, std::string>;
        /** By experiment and planner: of everything that its runs depend on; the program included, but for merging. */
        Fingerprints fingerprints() const;
        void select(const Fingerprints &fingerprints);
        /** Databases of other parts, to be merged. */
        std::vector<std::string> parts() const;
        void mergeParts();
        /** Log, paths and picture. */
        void writeExperiment(const Experiment &experiment, const std::vector<RunRecord> &records) const;

        BenchmarkOptions options_;
        const PlannerRegistry &registry_;
        BenchmarkConfig config_;
        std::vector<Experiment> experiments_;
        std::string folder_;
        std::unique_ptr<RunStore> store_;
    };
}  // namespace parking
