// Told to stop, the planner stops within 10 ms, whatever it is at.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <utility>

#include <ompl/util/Console.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;

    /** Milliseconds of processor time of this thread: other programs on the machine do not count. */
    double processorTime()
    {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    }

    void workFor(double milliseconds)
    {
        for (const double end = processorTime() + milliseconds; processorTime() < end;)
        {
        }
    }

    class PlannerTermination : public testing::Test
    {
    protected:
        void SetUp() override
        {
            ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        }

        /** Median over several runs of how long the planner goes on after it should stop, and that it was stopped. */
        static void expectPrompt(PlanningProblem &problem, double limit)
        {
            std::vector<double> late;
            for (int run = 0; run < 5; ++run)
            {
                problem.planner->clear();
                problem.pdef->clearSolutionPaths();
                const double end = processorTime() + limit * (0.6 + 0.2 * run);
                problem.planner->solve(ob::PlannerTerminationCondition([end] { return processorTime() >= end; }));
                late.push_back(processorTime() - end);
            }
            std::sort(late.begin(), late.end());
            EXPECT_LE(late[2], 10.0);
            EXPECT_GT(late[4], 0.0) << "the planner was never at work when the time was up";
        }
    };

    TEST_F(PlannerTermination, InTheOpen)
    {
        PlanningProblem problem(Space::ReedsShepp, openSite(500.0));
        problem.set("anytime", true);
        problem.set("analytic_expansion", false);
        problem.from({-450.0, -450.0, 0.0}).to({{450.0, 450.0, 1.0}});
        expectPrompt(problem, 40.0);
    }

    TEST_F(PlannerTermination, RoundAWallAcrossABigMap)
    {
        Site site = openSite(400.0);
        site.obstacles.push_back(box(-1.0, -400.0, 1.0, 390.0));
        PlanningProblem problem(Space::ReedsShepp, site);
        problem.set("anytime", true);
        problem.from({-300.0, -300.0, 0.0}).to({{300.0, -300.0, 1.0}});
        expectPrompt(problem, 40.0);
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
        expectPrompt(problem, 20.0);
    }

    TEST_F(PlannerTermination, WhileImproving)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.set("anytime", true);
        problem.from(AISLE).to({SLOT});
        expectPrompt(problem, 60.0);
    }

    TEST_F(PlannerTermination, WhileLoadingAMapBeforehand)
    {
        for (const char *model : {"car", "grid8"})
        {
            SCOPED_TRACE(model);
            PlanningProblem problem(Space::SE2, openSite(300.0));
            problem.set("motion_model", model);
            problem.set("obstacle_loading", "eager");
            problem.set("xy_resolution", 0.1);
            problem.from({-250.0, -250.0, 0.0}).to({{250.0, 250.0, 0.0}});
            expectPrompt(problem, std::string(model) == "car" ? 8.0 : 40.0);
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
            expectPrompt(problem, 40.0);
        }
    }

    // A checker of the user's own, a tenth of a millisecond for each state. At OMPL's resolution an expansion of the
    // grid models, with its turns on the spot, asks for some hundred states.
    TEST_F(PlannerTermination, WithASlowChecker)
    {
        for (const char *model : {"car", "grid8", "grid16"})
        {
            constexpr double SLOWNESS = 0.1;  // milliseconds
            SCOPED_TRACE(model);
            PlanningProblem problem(Space::SE2, openSite(20.0).bounds,
                                    [](const Pose &pose)
                                    {
                                        workFor(SLOWNESS);
                                        return std::abs(pose.x) > 1.0;
                                    });
            problem.si->setStateValidityCheckingResolution(0.01);
            problem.si->setup();
            problem.set("motion_model", model);
            problem.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
            expectPrompt(problem, 60.0);
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
                workFor(0.1);
                parking::setPose(state, {-2.5, 2.0, 0.0});
            }
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
        problem.pdef->setGoal(std::make_shared<NeverValid>(problem.si));
        expectPrompt(problem, 30.0);
    }
}  // namespace
