#pragma once

#include "benchmarks/comparison/Experiment.h"
#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/problems/PlanRun.h"

#include <atomic>
#include <map>
#include <memory>
#include <string>

namespace parking
{
    /** \brief Does single runs of a comparison, each through ompl::tools::Benchmark.

        Every run has a planner, a problem definition, a goal and samplers of its own, made anew from the run's own
        seed: so it comes out the same whatever was run before it, as far as planners are deterministic (PRM and its kin
        are not: they use two threads). Problems are loaded when first needed, and kept. */
    class UnitRunner
    {
    public:
        /** \brief \param stop once true, the run under way ends early and must not be kept */
        UnitRunner(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                   const PlannerRegistry &registry, const std::atomic<bool> &stop);

        /** \brief Makes every planner on every experiment once, so that bad settings are found before hours of work.
            Throws parking::Error naming the planner and the experiment. */
        void checkSettings();

        /** \brief Throws parking::Error when a planner refuses; what it finds, or that it does not, is in the
            record. */
        RunRecord run(const Unit &unit);

        const Problem &problem(std::size_t experiment);

        /** \brief The setup of an experiment in OMPL's words, for the log. */
        std::string setupText(std::size_t experiment);

    private:
        void measure(RunRecord &record, const Problem &world, const PreparedPlanner &prepared) const;

        const BenchmarkConfig &config_;
        const std::vector<Experiment> &experiments_;
        const PlannerRegistry &registry_;
        const std::atomic<bool> &stop_;
        std::map<std::size_t, std::unique_ptr<Problem>> problems_;
    };
}  // namespace parking
