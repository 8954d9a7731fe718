// Several calls of solve(): what continues a query, what begins a new one, and what is forgotten.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalState.h>

namespace
{
    using namespace parking_test;

    // Once there is a solution the next call needs no time for as good a one.
    TEST(PlannerQueries, SolutionsNeverGetWorse)
    {
        for (const auto &[space, parameters] : VARIANTS)
            for (const char *anytime : {"anytime=0", "anytime=1"})
            {
                SCOPED_TRACE(testing::Message() << static_cast<int>(space) << parameters << anytime);
                PlanningProblem problem(space, GAPS, parameters);
                problem.set(anytime);
                problem.from({LEFT}).to({RIGHT});
                double cost = HUGE_VAL, bound = HUGE_VAL;
                for (const unsigned int polls : {20000u, 1500u, 1u, 1500u, 0u})
                {
                    ASSERT_EQ(problem.solveWithPolls(polls), Status::EXACT_SOLUTION);
                    EXPECT_LE(problem.bestCost(), std::exchange(cost, problem.bestCost()));
                    EXPECT_GE(problem.planner->suboptimalityBound(), 1.0);
                    EXPECT_LE(problem.planner->suboptimalityBound(),
                              std::exchange(bound, problem.planner->suboptimalityBound()) + 1e-9);
                    problem.expectSound();
                }
            }
    }

    // With a checker of states an interrupted motion is checked again as a whole, so that each call needs more polls.
    TEST(PlannerQueries, ContinueAfterATimeOut)
    {
        const std::tuple<Space, const char *, bool> CASES[] = {
            {Space::ReedsShepp, "", false},
            {Space::Dubins, "", false},
            {Space::SE2, "motion_model=grid8", false},
            {Space::SE2, "motion_model=grid16 obstacle_loading=eager", false},
            {Space::ReedsShepp, "", true}};
        for (const auto &[space, parameters, byStates] : CASES)
        {
            SCOPED_TRACE(testing::Message() << static_cast<int>(space) << parameters << byStates);
            PlanningProblem problem =
                byStates ? PlanningProblem(space, square().bounds,
                                           [](const Pose &pose) { return std::hypot(pose.x, pose.y) > 3.0; })
                         : PlanningProblem(space, GAPS, parameters);
            problem.set("approximate=0");
            problem.from({LEFT}).to({RIGHT});
            Status status = Status::TIMEOUT;
            unsigned int calls = 0;
            for (; status == Status::TIMEOUT && calls < 20000; ++calls)
                status = problem.solveWithPolls(4 + calls);
            EXPECT_EQ(status, Status::EXACT_SOLUTION);
            EXPECT_GT(calls, 3u);
            EXPECT_TRUE(problem.path().check());
        }
    }

    TEST(PlannerQueries, TakeInStartsAndGoalsAddedMeanwhile)
    {
        const Pose farther{9.0, 10.0, 2.0}, goal{0.0, -5.0, 0.0}, start{-1.0, -5.0, 0.0};
        PlanningProblem problem(Space::ReedsShepp, SLOT_SCENE);
        ASSERT_EQ(problem.from({AISLE}).to({farther}).solve(), Status::EXACT_SOLUTION);
        problem.pdef->getGoal()->as<ob::GoalStates>()->addState(problem.state(goal));
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), goal, SAME));
        problem.pdef->addStartState(problem.state(start));
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().front(), start, SAME));
        EXPECT_TRUE(isSamePose(problem.poses().back(), goal, SAME));
    }

    // The loop of a car that plans again from where it is: OMPL's starts and goals change, its objects do not.
    TEST(PlannerQueries, BeginAgainWhenStartsOrGoalsAreReplaced)
    {
        const Pose start{-1.0, -5.0, 0.0}, goal{0.0, -7.0, 0.5};
        for (const char *change :
             {"start replaced", "start changed in place", "goal changed in place", "goals replaced"})
        {
            SCOPED_TRACE(change);
            PlanningProblem problem(Space::ReedsShepp, SLOT_SCENE);
            const auto single = std::make_shared<ob::GoalState>(problem.si);
            problem.from({AISLE}).to({SLOT});
            if (std::string(change) == "goal changed in place")
            {
                single->setState(problem.state(SLOT));
                problem.pdef->setGoal(single);
            }
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            problem.pdef->clearSolutionPaths();
            const bool isStart = std::string(change).find("start") == 0;
            if (std::string(change) == "start replaced")
            {
                problem.pdef->clearStartStates();
                problem.pdef->addStartState(problem.state(start));
            }
            else if (isStart)
                parking::setPose(problem.pdef->getStartState(0), start);
            else if (std::string(change) == "goal changed in place")
                single->setState(problem.state(goal));
            else
            {
                auto *states = problem.pdef->getGoal()->as<ob::GoalStates>();
                states->clear();
                states->addState(problem.state(goal));
            }
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            EXPECT_TRUE(isSamePose(problem.poses().front(), isStart ? start : AISLE, SAME));
            EXPECT_TRUE(isSamePose(problem.poses().back(), isStart ? SLOT : goal, SAME));
        }
    }

    TEST(PlannerQueries, BeginAgainWhenTheProblemChanges)
    {
        const Pose goal{8.0, -6.0, 1.0};
        Scene blocked = SLOT_SCENE;
        blocked.obstacles.push_back(box(-3.0, -6.0, -2.5, -2.5));
        for (const std::string change : {"definition", "goal", "map", "checker", "validator", "parameter", "setup"})
            for (const char *anytime : {"anytime=0", "anytime=1"})
                for (const bool isSolved : {false, true})
                {
                    SCOPED_TRACE(testing::Message() << change << ", " << anytime << isSolved);
                    PlanningProblem problem(Space::SE2, SLOT_SCENE, anytime);
                    problem.from({AISLE}).to({goal}).solveWithPolls(isSolved ? 4000 : 3);
                    ASSERT_EQ(problem.pdef->hasExactSolution(), isSolved);
                    problem.pdef->clearSolutionPaths();
                    const ob::StateValidityCheckerPtr checker = problem.si->getStateValidityChecker();
                    const ob::MotionValidatorPtr validator = problem.si->getMotionValidator();
                    if (change == "definition")
                        problem.pdef = std::make_shared<ob::ProblemDefinition>(problem.si);
                    if (change == "definition" || change == "goal")
                        problem.from({AISLE}).to({SLOT});
                    if (change == "map" || change == "checker" || change == "validator")
                        problem.setObstacles(blocked);
                    if (change == "checker")
                        problem.si->setMotionValidator(validator);
                    if (change == "validator")
                        problem.si->setStateValidityChecker(checker);
                    if (change == "parameter")
                        problem.set("turning_radius=5");
                    if (change == "setup")
                        problem.planner->setup();
                    problem.planner->setProblemDefinition(problem.pdef);
                    problem.solveWithPolls(40000);
                    // Only the search is guided by what the checker forbids.
                    EXPECT_TRUE(problem.pdef->hasExactSolution() || change == "validator");
                    if (problem.pdef->hasExactSolution())
                        problem.expectSound();
                }
    }

    TEST(PlannerQueries, AreForgottenWhenCleared)
    {
        const std::pair<Pose, Pose> queries[] = {{LEFT, RIGHT}, {{8.0, -12.0, 2.0}, {-9.0, 8.0, 0.0}}, {LEFT, RIGHT}};
        for (const auto &[space, parameters] : VARIANTS)
            for (const bool isWhole : {false, true})
            {
                SCOPED_TRACE(testing::Message() << static_cast<int>(space) << parameters << isWhole);
                PlanningProblem kept(space, GAPS, parameters);
                kept.set("approximate=0");
                kept.planner->setup();
                for (const auto &[start, goal] : queries)
                {
                    isWhole ? kept.planner->clear() : kept.planner->clearQuery();
                    EXPECT_EQ(kept.planner->solutionPath(), nullptr);
                    EXPECT_EQ(kept.planner->statistics().expanded, 0u);
                    EXPECT_EQ(kept.planner->isSetup(), !isWhole);
                    EXPECT_EQ(kept.planner->parameters().approximate, false);
                    kept.pdef->clearSolutionPaths();
                    ASSERT_EQ(kept.from({start}).to({goal}).solve(), Status::EXACT_SOLUTION);
                    PlanningProblem fresh(space, GAPS, parameters);
                    ASSERT_EQ(fresh.from({start}).to({goal}).solve(), Status::EXACT_SOLUTION);
                    EXPECT_TRUE(areEqual(kept.poses(), fresh.poses()));
                }
            }
    }

    // The planner does not notice a map that changes within its checker: the user calls clearQuery().
    TEST(PlannerQueries, TakeInAMapChangedInPlaceWhenCleared)
    {
        double radius = 0.0;
        PlanningProblem problem(Space::ReedsShepp, square().bounds,
                                [&radius](const Pose &pose) { return std::hypot(pose.x, pose.y) > radius; });
        for (radius = 0.0; radius < 4.0; radius += 3.0)
        {
            problem.planner->clearQuery();
            problem.pdef->clearSolutionPaths();
            ASSERT_EQ(problem.from({{-9.0, 0.1, 0.0}}).to({{9.0, 0.1, 0.0}}).solve(), Status::EXACT_SOLUTION);
            EXPECT_TRUE(problem.path().check());
        }
    }

    // The bound requires the route round the long wall to the farther goal, which is computed lazily.
    TEST(PlannerQueries, NeverPollAConditionOfACallThatHasReturned)
    {
        const Scene scene = square({box(-1.0, -400.0, 1.0, 390.0), box(-20.0, -298.98, -19.0, -298.0)}, 400.0);
        for (unsigned int most = 1; most < 400; most += 19)
        {
            PlanningProblem problem(Space::ReedsShepp, scene, "anytime=1");
            problem.from({{-30.0, -300.0, 0.0}}).to({{-10.0, -300.0, 0.0}, {30.0, -300.0, 1.0}});
            unsigned int polls = 0;
            bool hasReturned = false;
            const ob::PlannerTerminationCondition condition(
                [&]
                {
                    EXPECT_FALSE(hasReturned);
                    return ++polls > most;
                });
            problem.planner->solve(condition);
            hasReturned = true;
            EXPECT_GE(problem.planner->suboptimalityBound(), 1.0);
            ob::PlannerData data(problem.si);
            problem.planner->getPlannerData(data);
        }
    }
}  // namespace
