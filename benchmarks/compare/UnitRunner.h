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
    /** \brief Selects the runs that execute in their own process. */
    enum class Isolation
    {
        None,     ///< no run; only exceptions are contained
        Plugins,  ///< runs of planners from plug-ins
        All       ///< every run
    };

    /** \brief Adds measurements of OMPL's benchmark to a record, by typed names such as "time REAL". Existing figures
        are kept. */
    void takeOmplProperties(RunRecord &record, const std::map<std::string, std::string> &properties);

    /** \brief Executes single runs of a comparison, each through ompl::tools::Benchmark.

        Every run creates its own planner, problem definition, goal and samplers from its own seed. Its result thus does
        not depend on other runs if the planner is deterministic (PRM and its variants use two threads and are not).
        Problems are loaded lazily and kept. */
    class UnitRunner
    {
    public:
        /** \brief \param stop set to true to end the current run early; its record must be discarded */
        UnitRunner(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                   const PlannerRegistry &registry, Isolation isolation, const std::atomic<bool> &stop);

        /** \brief Creates every planner on every experiment once, so that invalid settings are found before hours of
            work.
            Throws parking::Error naming the line of the configuration, the planner and the experiment. */
        void checkSettings();

        /** \brief Executes a run. The record stores the outcome in any case.

           Outcomes include exceptions; in an isolated run also crashes, exceeding the memory limit of the
           configuration, and a solve() that exceeds three times the time limit plus two seconds. */
        RunRecord run(const Unit &unit);

        /** \brief The world of an experiment, loaded lazily. Throws parking::Error as Experiment::load() does. */
        const Problem &problem(std::size_t experiment);

        /** \brief OMPL's description of an experiment's setup, for the log. */
        std::string setupText(std::size_t experiment);

    private:
        bool isIsolated(std::size_t planner) const;
        double wallTimeLimit() const;
        IsolationLimits limits() const;
        void checkSettings(std::size_t experiment, std::size_t planner);
        /** Record of a run without results. */
        RunRecord recordOf(const Unit &unit) const;
        RunRecord runHere(const Unit &unit, const std::function<void()> &solved);
        RunRecord runApart(const Unit &unit);
        void benchmarkRun(RunRecord &record, std::size_t planner, const Problem &world,
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
