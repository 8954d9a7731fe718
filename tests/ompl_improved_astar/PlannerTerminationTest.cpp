// Told to stop, the planner stops soon, whatever it is doing. Work is counted, not time.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{
    using namespace parking_test;

    /** A problem, and a count of the work done on it. */
    struct Load
    {
        PlanningProblem problem;
        std::function<std::uint64_t()> work;
        std::uint64_t limit;       // of the work between two polls, and after the last one
        unsigned int polls{1000};  // at most before the planner is told to stop
    };

    /** Planning by the footprint: each unit of work takes a tenth of a microsecond to a microsecond. */
    std::function<Load()> byFootprint(Space space, const Scene &scene, const Pose &start, const Pose &goal,
                                      const char *parameters, unsigned int polls = 1000)
    {
        return [=]
        {
            PlanningProblem problem(space, scene, parameters);
            problem.from({start}).to({goal});
            const auto work = [planner = problem.planner]
            {
                const auto done = planner->statistics();
                return planner->checkedStates() + done.expanded + done.generated + done.heuristicCells;
            };
            return Load{problem, work, 10000, polls};
        };
    }

    /** With a checker of states that may need a tenth of a millisecond for each, at OMPL's default resolution. */
    std::function<Load()> byStates(const char *parameters, double wall, std::uint64_t limit, unsigned int polls)
    {
        return [=]
        {
            const auto checks = std::make_shared<std::uint64_t>(0);
            const auto isFree = [checks, wall](const Pose &pose)
            {
                return ++*checks > 0 && std::abs(pose.x) >= wall;
            };
            PlanningProblem problem(Space::SE2, square({}, 20.0).bounds, isFree, parameters, 0.01);
            problem.from({{-8.0, 0.0, 0.0}}).to({{8.0, 0.0, 0.0}});
            return Load{problem, [checks] { return *checks; }, limit, polls};
        };
    }

    /** The clearance of a car of three discs on a plain with posts in its way. */
    double amongPosts(const Pose &pose)
    {
        double least = HUGE_VAL;
        for (const double ahead : {0.0, 1.3, 2.6})
            for (int post = -4; post <= 4; ++post)
                least = std::min(
                    least, positionDistance(advance(pose, 0.0, ahead), {20.0 * post, post % 2 == 0 ? -1.2 : 1.2, 0.0}));
        return least - 2.5;
    }

    std::function<Load()> byClearances(const char *parameters)
    {
        return [=]
        {
            PlanningProblem problem(
                Space::SE2, {{-100.0, -40.0}, {100.0, 40.0}}, [](const Pose &) { return true; }, parameters);
            const auto checker = std::make_shared<CountingChecker>(problem.si, amongPosts);
            problem.si->setStateValidityChecker(checker);
            problem.from({{-90.0, 0.0, 0.0}}).to({{90.0, 0.0, 0.0}});
            return Load{problem, [checker] { return checker->clearances; }, 64};
        };
    }

    Load byGoals()
    {
        PlanningProblem problem(Space::ReedsShepp, SLOT_SCENE);
        const auto region = std::make_shared<SampledRegion>(problem.si, [](unsigned int) { return IN_OBSTACLE; });
        problem.from({AISLE}).pdef->setGoal(region);
        return {problem, [region] { return region->samples; }, 10};
    }

    constexpr Space PLAIN = Space::SE2, CURVES = Space::ReedsShepp;
    constexpr Pose WEST{-250.0, -250.0, 0.0}, EAST{250.0, -250.0, 0.0};
    const Scene OPEN = square({}, 300.0), WALL = square({box(-1.0, -300.0, 1.0, 290.0)}, 300.0);

    const std::pair<const char *, std::function<Load()>> CASES[] = {
        {"while searching", byFootprint(CURVES, OPEN, WEST, EAST, "anytime=1 analytic_expansion=0")},
        {"while driving round a wall", byFootprint(CURVES, WALL, WEST, EAST, "anytime=1")},
        {"while shut in", byFootprint(CURVES, PEN, {}, {-10.0, 8.0, 0.0}, "obstacle_heuristic=0")},
        {"while improving", byFootprint(CURVES, SLOT_SCENE, AISLE, SLOT, "anytime=1")},
        {"while loading a map", byFootprint(PLAIN, WALL, WEST, EAST, "obstacle_loading=eager xy_resolution=0.15", 100)},
        {"while loading a grid",
         byFootprint(PLAIN, WALL, WEST, EAST, "motion_model=grid8 obstacle_loading=eager xy_resolution=0.15", 100)},
        {"while searching a grid", byFootprint(PLAIN, WALL, WEST, EAST, "motion_model=grid8 open_list=linear")},
        {"while checking states", byStates("", 1.0, 200, 1000)},
        {"while checking states of a grid of 16", byStates("motion_model=grid16", 1.0, 200, 1000)},
        {"while loading states of a grid", byStates("motion_model=grid8 obstacle_loading=eager", 0.0, 40, 100)},
        {"while loading states of a grid of 32", byStates("motion_model=grid32 obstacle_loading=eager", 0.0, 40, 100)},
        {"while measuring clearances", byClearances("")},
        {"while measuring clearances, anytime", byClearances("anytime=1")},
        {"while waiting for a goal", byGoals},
    };

    class Termination : public testing::TestWithParam<std::size_t>
    {
    };

    TEST_P(Termination, ComesSoon)
    {
        SCOPED_TRACE(CASES[GetParam()].first);
        const Load load = CASES[GetParam()].second();
        for (unsigned int most = 1; most <= load.polls; most *= 10)
        {
            SCOPED_TRACE(testing::Message() << most << " polls");
            load.problem.planner->clear();
            load.problem.pdef->clearSolutionPaths();
            unsigned int polls = 0;
            std::uint64_t last = load.work(), longest = 0;
            load.problem.planner->solve(ob::PlannerTerminationCondition(
                [&]
                {
                    if (polls <= most)
                    {
                        longest = std::max(longest, load.work() - std::min(load.work(), last));
                        last = load.work();
                    }
                    return ++polls > most;
                }));
            EXPECT_LE(longest, load.limit) << "between two polls";
            EXPECT_LE(load.work() - std::min(load.work(), last), load.limit) << "after it was told to stop";
            EXPECT_GT(polls, most) << "it was done before it was told to stop";
            EXPECT_LE(polls, most + 20) << "it went on polling";
        }
    }

    INSTANTIATE_TEST_SUITE_P(Planner, Termination, testing::Range(std::size_t{0}, std::size(CASES)));

    // A path found in time is returned even if there is no time left to compute its cost.
    TEST(PlannerTermination, LosesNoPathThatIsFound)
    {
        PlanningProblem problem = byClearances("")().problem;
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const double length = problem.path().length();
        bool wasSolved = false;
        std::size_t others = 0;
        for (unsigned int most = 1; !wasSolved || problem.path().length() != length; most += most / 16 + 1)
        {
            ASSERT_LT(most, 1000000u);
            problem.planner->clear();
            problem.pdef->clearSolutionPaths();
            problem.solveWithPolls(most);
            EXPECT_TRUE(problem.pdef->hasExactSolution() || !wasSolved) << "found with fewer polls than " << most;
            wasSolved = problem.pdef->hasExactSolution();
            if (!wasSolved)
                continue;
            ++others;
            EXPECT_GE(problem.bestCost(), problem.path().length() - 1e-3);
            EXPECT_LT(problem.bestCost(), 1.5 * problem.path().length());
        }
        EXPECT_GE(others, 2u) << "the time was never up between the first path and the last change to it";
    }
}  // namespace
