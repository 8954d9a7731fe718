// Told to stop, the planner stops soon, whatever it is at. Work is counted, not time: no other program matters.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace
{
    using namespace parking_test;
    using parking::Pose;

    class PlannerTermination : public Silent<testing::Test>
    {
    protected:
        /** What the planner has done so far, in units of a tenth of a microsecond to a microsecond each. */
        static std::uint64_t workOf(const og::ImprovedAStar &planner)
        {
            const auto statistics = planner.statistics();
            return planner.checkedStates() + statistics.expanded + statistics.generated + statistics.heuristicCells;
        }

        /** Stopped at the first question, the tenth and so on until the \e latest, the planner does at most \e most
            units of work between one question and the next, and after the answer that stops it; and it does not go on
            asking. */
        static void expectPrompt(PlanningProblem &problem, std::uint64_t most, std::function<std::uint64_t()> work = {},
                                 unsigned int latest = 1000)
        {
            if (!work)
                work = [&problem]
                {
                    return workOf(*problem.planner);
                };
            for (unsigned int questions = 1; questions <= latest; questions *= 10)
            {
                SCOPED_TRACE(questions);
                problem.planner->clear();
                problem.pdef->clearSolutionPaths();
                unsigned int asked = 0;
                std::uint64_t last = work(), longest = 0;
                problem.planner->solve(ob::PlannerTerminationCondition(
                    [&]
                    {
                        const std::uint64_t now = work();
                        if (asked < questions)
                            longest = std::max(longest, now - std::min(now, last));
                        last = asked <= questions ? now : last;
                        return ++asked > questions;
                    }));
                EXPECT_LE(longest, most) << "between two questions";
                EXPECT_LE(work() - std::min(work(), last), most) << "after it was told to stop";
                EXPECT_GT(asked, questions) << "the planner was done before it was told to stop";
                EXPECT_LE(asked, questions + 20) << "it went on asking";
            }
        }
    };

    TEST_F(PlannerTermination, InTheOpen)
    {
        PlanningProblem problem(Space::ReedsShepp, openSite(500.0));
        problem.set("anytime", true);
        problem.set("analytic_expansion", false);
        problem.from({-450.0, -450.0, 0.0}).to({{450.0, 450.0, 1.0}});
        expectPrompt(problem, 2000);
    }

    TEST_F(PlannerTermination, RoundAWallAcrossABigMap)
    {
        Site site = openSite(400.0);
        site.obstacles.push_back(box(-1.0, -400.0, 1.0, 390.0));
        PlanningProblem problem(Space::ReedsShepp, site);
        problem.set("anytime", true);
        problem.from({-300.0, -300.0, 0.0}).to({{300.0, -300.0, 1.0}});
        expectPrompt(problem, 2000);
    }

    TEST_F(PlannerTermination, WithoutAWayOut)
    {
        // Walled in with a little room to move: the finest resolutions are searched to their ends.
        Site site = openSite(15.0);
        site.obstacles = {box(-4.0, -1.5, -3.0, 1.5), box(6.0, -1.5, 7.0, 1.5), box(-4.0, -2.5, 7.0, -1.5),
                          box(-4.0, 1.5, 7.0, 2.5)};
        PlanningProblem problem(Space::ReedsShepp, site);
        problem.set("obstacle_heuristic", false);
        problem.from({0.0, 0.0, 0.0}).to({{-10.0, 8.0, 0.0}});
        expectPrompt(problem, 2000);
    }

    TEST_F(PlannerTermination, WhileImproving)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.set("anytime", true);
        problem.from(AISLE).to({SLOT});
        expectPrompt(problem, 2000);
    }

    TEST_F(PlannerTermination, WhileLoadingAMapBeforehand)
    {
        for (const char *model : {"car", "grid8"})
        {
            SCOPED_TRACE(model);
            PlanningProblem problem(Space::SE2, openSite(300.0));
            problem.set("motion_model", model);
            problem.set("obstacle_loading", "eager");
            problem.set("xy_resolution", 0.15);
            problem.from({-250.0, -250.0, 0.0}).to({{250.0, 250.0, 0.0}});
            expectPrompt(problem, 2000, {}, 100);
            EXPECT_EQ(problem.planner->statistics().expanded, 0u)
                << "the map was loaded before all questions were asked";
        }
    }

    TEST_F(PlannerTermination, OnALargeGrid)
    {
        Site site = openSite(300.0);
        site.obstacles.push_back(box(-1.0, -300.0, 1.0, 290.0));
        for (const char *set : {"basic_astar", "improved_astar", "experiment_4"})
        {
            SCOPED_TRACE(set);
            PlanningProblem problem(Space::SE2, site);
            problem.set("parameter_set", set);
            problem.set("obstacle_loading", "lazy");
            problem.from({-250.0, -250.0, 0.0}).to({{250.0, -250.0, 0.0}});
            expectPrompt(problem, 2000);
        }
    }

    // A checker of the user's own may need a tenth of a millisecond for a state. At OMPL's resolution an expansion of
    // the grid models, with its turns on the spot, asks for some hundred states.
    TEST_F(PlannerTermination, WithAnyChecker)
    {
        for (const char *model : {"car", "grid8", "grid16"})
        {
            std::uint64_t checked = 0;
            SCOPED_TRACE(model);
            PlanningProblem problem(Space::SE2, openSite(20.0).bounds,
                                    [&checked](const Pose &pose)
                                    {
                                        ++checked;
                                        return std::abs(pose.x) > 1.0;
                                    });
            problem.si->setStateValidityCheckingResolution(0.01);
            problem.si->setup();
            problem.set("motion_model", model);
            problem.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
            expectPrompt(problem, 200, [&checked] { return checked; });
        }
    }

    // Whatever the number of headings in a cell.
    TEST_F(PlannerTermination, WhileAnyCheckerIsAskedBeforehand)
    {
        for (const char *model : {"grid8", "grid16", "grid32"})
        {
            std::uint64_t checked = 0;
            SCOPED_TRACE(model);
            PlanningProblem problem(Space::SE2, openSite(20.0).bounds,
                                    [&checked](const Pose &) { return ++checked > 0; });
            problem.set("motion_model", model);
            problem.set("obstacle_loading", "eager");
            problem.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
            expectPrompt(
                problem, 40, [&checked] { return checked; }, 100);
        }
    }

    TEST_F(PlannerTermination, WhileWaitingForAGoal)
    {
        class NeverValid : public ob::GoalSampleableRegion
        {
        public:
            using GoalSampleableRegion::GoalSampleableRegion;
            void sampleGoal(ob::State *state) const override
            {
                ++samples;
                parking::setPose(state, {-2.5, 2.0, 0.0});
            }
            mutable std::uint64_t samples{0};
            unsigned int maxSampleCount() const override
            {
                return std::numeric_limits<unsigned int>::max();
            }
            double distanceGoal(const ob::State * /*state*/) const override
            {
                return 1.0;
            }
        };
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE);
        const auto goal = std::make_shared<NeverValid>(problem.si);
        problem.pdef->setGoal(goal);
        expectPrompt(problem, 10, [&goal] { return goal->samples; });
    }
}  // namespace
