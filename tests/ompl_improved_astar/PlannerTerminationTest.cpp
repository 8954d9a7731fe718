// Told to stop, the planner stops soon, whatever it is at. Work is counted, not time: no other program matters.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <ompl/base/StateValidityChecker.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;

    /** A car of three discs on a plain with posts in its way; the distances are told exactly, and counted. */
    class AmongPosts : public ob::StateValidityChecker
    {
    public:
        explicit AmongPosts(const ob::SpaceInformationPtr &si) : StateValidityChecker(si)
        {
            specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::EXACT;
        }

        static parking::Box bounds()
        {
            return {{-100.0, -40.0}, {100.0, 40.0}};
        }

        bool isValid(const ob::State *state) const override
        {
            return gap(parking::poseOf(state)) > 0.0;
        }

        double clearance(const ob::State *state) const override
        {
            ++clearances;
            return std::max(0.0, gap(parking::poseOf(state)));
        }

        mutable std::uint64_t clearances{0};

    private:
        static double gap(const Pose &pose)
        {
            double least = std::numeric_limits<double>::infinity();
            for (const double ahead : {0.0, 1.3, 2.6})
                for (int post = -4; post <= 4; ++post)
                {
                    const Pose middle = advance(pose, 0.0, ahead);
                    const double y = post % 2 == 0 ? -1.2 : 1.2;
                    least = std::min(least, std::hypot(middle.x - 20.0 * post, middle.y - y) - 2.5);
                }
            return least;
        }
    };

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

    // Nor may those wait that tell clearances, which long paths and curves are asked about from end to end.
    TEST_F(PlannerTermination, WithACheckerThatTellsClearances)
    {
        for (const bool anytime : {false, true})
            for (const double preferred : {0.1, 1.0})
            {
                SCOPED_TRACE(testing::Message() << anytime << ' ' << preferred);
                PlanningProblem problem(Space::SE2, AmongPosts::bounds());
                const auto checker = std::make_shared<AmongPosts>(problem.si);
                problem.si->setStateValidityChecker(checker);
                problem.si->setStateValidityCheckingResolution(0.002);
                problem.si->setup();
                problem.makePlanner();
                problem.set("anytime", anytime);
                problem.set("preferred_clearance", preferred);
                problem.from({-90.0, 0.0, 0.0}).to({{90.0, 0.0, 0.0}});
                expectPrompt(problem, 64, [&checker] { return checker->clearances; });
            }
    }

    // A path that is found in time is returned even if there is no time any more to find out what it costs.
    TEST_F(PlannerTermination, WhileAFirstPathIsPriced)
    {
        PlanningProblem problem(Space::SE2, AmongPosts::bounds());
        const auto checker = std::make_shared<AmongPosts>(problem.si);
        problem.si->setStateValidityChecker(checker);
        problem.si->setup();
        problem.makePlanner();
        problem.from({-90.0, 0.0, 0.0}).to({{90.0, 0.0, 0.0}});
        ASSERT_EQ(problem.solve(), ob::PlannerStatus::EXACT_SOLUTION);
        const double length = problem.path().length();
        std::size_t others = 0;
        bool wasSolved = false;
        for (unsigned int questions = 1; !problem.pdef->hasExactSolution() || others < 5;
             questions += questions / 16 + 1)
        {
            SCOPED_TRACE(questions);
            ASSERT_LT(questions, 1000000u);
            problem.planner->clear();
            problem.pdef->clearSolutionPaths();
            const ob::PlannerStatus status = problem.solveForQuestions(questions);
            EXPECT_TRUE(status == ob::PlannerStatus::EXACT_SOLUTION || !wasSolved) << "it was found sooner before";
            wasSolved = wasSolved || status == ob::PlannerStatus::EXACT_SOLUTION;
            if (!wasSolved)
                continue;
            EXPECT_TRUE(problem.path().check());
            const double cost = std::stod(problem.planner->getPlannerProgressProperties().at("best cost REAL")());
            EXPECT_GE(cost, problem.path().length() - 1e-3);
            EXPECT_LT(cost, 1.5 * problem.path().length());
            if (problem.path().length() == length)
                break;
            ++others;
        }
        EXPECT_GE(others, 1u) << "the time was never up between the first path and the last touch to it";
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
