#pragma once

#include "benchmarks/config/Experiment.h"
#include "benchmarks/plan/PlanRun.h"
#include "benchmarks/store/RunRecord.h"
#include "benchmarks/system/Isolation.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace parking
{
    /** \brief Which runs have a process of their own. */
    enum class Isolation
    {
        None,     ///< only exceptions of a planner do no harm then
        Plugins,  ///< those of planners from elsewhere
        All       ///< every run
    };

    /** \brief Takes over what OMPL's benchmark has measured, by typed names ("time REAL"): figures that the record does
        not have yet. */
    void takeOmplProperties(RunRecord &record, const std::map<std::string, std::string> &properties);

    /** \brief Does single runs of a comparison, each through ompl::tools::Benchmark.

        Every run has a planner, a problem definition, a goal and samplers of its own, made anew from the run's own
        seed: so it comes out the same whatever was run before it, as far as planners are deterministic (PRM and its kin
        are not: they use two threads). Problems are loaded when first needed, and kept. */
    class UnitRunner
    {
    public:
        /** \brief \param stop once true, the run under way ends early and must not be kept */
        UnitRunner(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                   const PlannerRegistry &registry, Isolation isolation, const std::atomic<bool> &stop);

        /** \brief Makes every planner on every experiment once, so that bad settings are found before hours of work.
            Throws parking::Error naming the line of the configuration, the planner and the experiment. */
        void checkSettings();

        /** \brief What the planner finds, or that it does not, or what happens to it, is in the record: an exception,
           and in a process of its own a crash, too much memory (more than the limit of the configuration), or that
           solve() does not come back within three times the time limit and two seconds. */
        RunRecord run(const Unit &unit);

        /** \brief The world of an experiment; read when first asked for. Throws parking::Error as Experiment::load()
            does. */
        const Problem &problem(std::size_t experiment);

        /** \brief The setup of an experiment in OMPL's words, for the log. */
        std::string setupText(std::size_t experiment);

    private:
        bool isIsolated(std::size_t planner) const;
        double patience() const;
        IsolationLimits limits() const;
        void checkSettings(std::size_t experiment, std::size_t planner);
        /** Without what comes of the run. */
        RunRecord recordOf(const Unit &unit) const;
        RunRecord runHere(const Unit &unit, const std::function<void()> &solved);
        RunRecord runApart(const Unit &unit);
        void benchmarkRun(RunRecord &record, const PlannerSpec &spec, const Problem &world,
                          const std::function<void()> &solved) const;
        void measure(RunRecord &record, const Problem &world, const PreparedPlanner &prepared) const;

        const BenchmarkConfig &config_;
        const std::vector<Experiment> &experiments_;
        const PlannerRegistry &registry_;
        Isolation isolation_;
        const std::atomic<bool> &stop_;
        std::map<std::size_t, std::unique_ptr<Problem>> problems_;
    };
}  // namespace parking
