#pragma once

#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/studies/reliability/SoakFigures.h"
#include "benchmarks/studies/reliability/SoakWorlds.h"
#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/referee/Referee.h"
#include "state_validity/FootprintChecker.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace parking
{
    /** \brief What a worker plans. */
    struct SoakSettings
    {
        bool small{false};         ///< few obstacles and short ways, and nothing but plan(): as many queries as can be
        std::size_t perWorld{40};  ///< queries in a world before there is another one
        double timeLimit{0.05};    ///< seconds for each query that is put to a planner of OMPL
        std::uint64_t most{0};     ///< queries of all workers together, after which they stop; 0: no end
    };

    /** \brief Plans in random worlds, one after the other, and has every answer judged by the referee.

        One thread each; the figures may be read while it works. */
    class SoakWorker
    {
    public:
        /** \brief \param seed of all that is random in this worker \param queries counts those of all workers; must
            outlive them */
        SoakWorker(const SoakSettings &settings, std::uint64_t seed, std::atomic<std::uint64_t> &queries);

        /** \brief Works until \e stop. */
        void work(const std::atomic<bool> &stop);

        /** \brief What has been done so far. */
        SoakFigures figures() const;

    private:
        void newWorld();
        Pose anywhere();
        Pose anyGoal();
        void query();
        void judge(const Scenario &scenario, const search::PlanResult &result);
        void askOracle(const Scenario &scenario, const Path &path);
        void replan(const Path &path);
        void askOthers(const Scenario &scenario);
        bool isOver(const std::atomic<bool> &stop) const;

        SoakSettings settings_;
        std::uint64_t seed_;
        std::atomic<std::uint64_t> &all_;
        parking_test::Random random_;
        PlannerRegistry registry_;
        std::size_t turn_{0};  // of the other planners

        Scenario world_;
        std::vector<Pose> places_;  // to park at
        std::unique_ptr<FootprintChecker> checker_;

        mutable std::mutex mutex_;
        SoakFigures figures_;
    };
}  // namespace parking
