#pragma once

#include "benchmarks/config/BenchmarkConfig.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief One scenario in one setting, and the planners that are compared on it. One OMPL log comes of it. */
    struct Experiment
    {
        std::string name;                   ///< unique; a single word that can be part of a file name
        std::string scenarioFile;           ///< path of the scenario's file
        ProblemOptions options;             ///< what is changed of the scenario, and how it is put
        std::vector<std::size_t> planners;  ///< indices into BenchmarkConfig::planners
        std::string digest;                 ///< of everything that the scenario's files say
        std::vector<std::string> files;     ///< all that the scenario is read from

        /** \brief Reads the scenario, with what the options change of it. Throws parking::Error naming the file. */
        Scenario scenario() const;

        /** \brief The same, with its world built. */
        std::unique_ptr<Problem> load() const;
    };

    /** \brief One run of one planner on one experiment. */
    struct Unit
    {
        std::size_t experiment{0};  ///< index into the list of experiments
        std::size_t planner{0};     ///< index into BenchmarkConfig::planners
        std::size_t run{0};         ///< number of the run, from 0
    };

    /** \brief For a configuration whose scenarios were replaced by others: leaves out the planners whose `only` names
        \e replaced scenarios and none of those that there are now, and what names such in the `only` of others. What
        names neither stays, for planExperiments() to refuse; so does all when nobody would be left.

        \return the names of those left out. Throws parking::Error for a scenario that cannot be read. */
    std::vector<std::string> leaveOutPlannersOf(const std::vector<std::string> &replaced, BenchmarkConfig &config);

    /** \brief The experiments of a comparison. Planners whose problem differs from others' (overrides in the .cfg) meet
        in experiments of their own, named after scenario and setting.

        Reads every scenario, so that a bad one is found before hours of work. Throws parking::Error. */
    std::vector<Experiment> planExperiments(const BenchmarkConfig &config);

    /** \brief All runs in the order in which they are done: every planner once on every experiment, then again.

        A drift of the machine thus meets all planners alike. Within a round the planners of an experiment take turns in
        an order that changes from round to round.

        \param shard, shards of N shards, which together have every unit once, the one of index \e shard (from 0): a
        fixed, evenly mixed selection */
    std::vector<Unit> planUnits(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                std::size_t shard = 0, std::size_t shards = 1);

    /** \brief Tells comparisons apart whose runs have nothing in common: depends on limits, seed and what is done with
        each path. */
    std::string fingerprint(const BenchmarkConfig &config);

    /** \brief Tells runs of the same name apart: depends on the above, the scenario and how it is put, the planner and
        its parameters, but not on the other planners or the number of runs, so that more can be added to what there
        is. */
    std::string fingerprint(const BenchmarkConfig &config, const Experiment &experiment, const PlannerSpec &planner);

    /** \brief A digest of a file's bytes; empty when it cannot be read. */
    std::string fileDigest(const std::string &file);

    /** \brief The seed of a run: depends on the comparison's seed, the names of experiment and planner, and the run's
        number only, and so neither on the order of the runs nor on the machine. */
    std::uint32_t seedOf(const BenchmarkConfig &config, const std::vector<Experiment> &experiments, const Unit &unit);
}  // namespace parking
