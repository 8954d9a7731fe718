#pragma once

#include "benchmarks/config/BenchmarkConfig.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief One scenario in one setting, and the planners compared on it. Each experiment yields one OMPL log. */
    struct Experiment
    {
        std::string name;                   ///< unique; a single word that can be part of a file name
        std::string scenarioFile;           ///< path of the scenario's file
        ProblemOptions options;             ///< changes to the scenario and its settings
        std::vector<std::size_t> planners;  ///< indices into BenchmarkConfig::planners
        std::string digest;                 ///< digest of the contents of all files of the scenario
        std::vector<std::string> files;     ///< all files that the scenario is read from

        /** \brief Reads the scenario and applies the options. Throws parking::Error naming the file. */
        Scenario scenario() const;

        /** \brief Reads the scenario, applies the options and builds its world. */
        std::unique_ptr<Problem> load() const;
    };

    /** \brief One run of one planner on one experiment. */
    struct Unit
    {
        std::size_t experiment{0};  ///< index into the list of experiments
        std::size_t planner{0};     ///< index into BenchmarkConfig::planners
        std::size_t run{0};         ///< number of the run, from 0
    };

    /** \brief Adapts `only` after the scenarios of a configuration were replaced.
        Removes planners whose `only` names \e replaced scenarios and none of the current ones, and removes such names
        from the `only` of others. Names that match neither remain, for planExperiments() to reject. Nothing is removed
        when no planner would remain.

        \return the names of the removed planners. Throws parking::Error for a scenario that cannot be read. */
    std::vector<std::string> leaveOutPlannersOf(const std::vector<std::string> &replaced, BenchmarkConfig &config);

    /** \brief The experiments of a comparison. Planners with different problems (overrides in the .cfg) get separate
        experiments, named after scenario and setting.
        Reads every scenario, so that a bad one is found before hours of work. Throws parking::Error. */
    std::vector<Experiment> planExperiments(const BenchmarkConfig &config);

    /** \brief All runs in the order of execution: every planner once on every experiment, then again.
        A drift of the machine thus affects all planners alike. Within a round the planners of an experiment alternate
        in an order that changes from round to round.

        \param shard index of the part to return, from 0
        \param shards number of parts, which together contain every unit once; each is a fixed, evenly mixed
        selection */
    std::vector<Unit> planUnits(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                std::size_t shard = 0, std::size_t shards = 1);

    /** \brief Identifies comparisons whose runs can be merged: depends on limits, seed and the processing of each
        path. */
    std::string fingerprint(const BenchmarkConfig &config);

    /** \brief Identifies runs that can be reused: depends on the comparison, the scenario and its settings, the planner
        and its parameters.
        Other planners and the number of runs do not matter, so that both can be extended. */
    std::string fingerprint(const BenchmarkConfig &config, const Experiment &experiment, const PlannerSpec &planner);

    /** \brief A digest of a file's bytes; empty when it cannot be read. */
    std::string fileDigest(const std::string &file);

    /** \brief The seed of a run: depends on the comparison's seed, the names of experiment and planner, and the run's
        number.
        It depends neither on the order of the runs nor on the machine. */
    std::uint32_t seedOf(const BenchmarkConfig &config, const std::vector<Experiment> &experiments, const Unit &unit);
}  // namespace parking
