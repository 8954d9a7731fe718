// Several calls of solve(): going on, beginning anew, forgetting.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/goals/GoalState.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerSeveralCalls : public Silent<testing::Test>
    {
    };

    bool isClearOfPost(const Pose &pose)
    {
        return std::hypot(pose.x, pose.y) > 3.0;
    }

    TEST_F(PlannerSeveralCalls, SolvesAgainAtOnceWithAsGoodASolution)
    {
        for (const Space kind : {Space::ReedsShepp, Space::Dubins, Space::SE2})
        {
            PlanningProblem problem(kind, slotSite());
            const Pose goal = kind == Space::Dubins ? Pose{8.0, -6.0, 1.0} : SLOT;
            problem.from(AISLE).to({goal});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            const double length = problem.path().length();
            const auto expanded = problem.planner->statistics().expanded;
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            EXPECT_LE(problem.path().length(), length);
            EXPECT_EQ(problem.planner->statistics().expanded, expanded);
            // Known already, so that no time is needed.
            EXPECT_EQ(problem.solve(0.0), Status::EXACT_SOLUTION);
        }
    }

    TEST_F(PlannerSeveralCalls, SetUpAgainBeginsAnew)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_NE(problem.solveForQuestions(3), Status::EXACT_SOLUTION);
        problem.planner->setup();
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        problem.planner->setup();
        problem.pdef->clearSolutionPaths();
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_GT(problem.planner->statistics().expanded, 0u);
    }

    TEST_F(PlannerSeveralCalls, NobodyAsksATerminationConditionThatIsGone)
    {
        // The goal that is farther is behind a long wall: the way round it is asked for again by the bound.
        Site site = openSite(400.0);
        site.obstacles.push_back(box(-1.0, -400.0, 1.0, 390.0));
        site.obstacles.push_back(box(-20.0, -298.98, -19.0, -298.0));
        for (unsigned int questions = 1; questions < 400; questions += 9)
        {
            PlanningProblem problem(Space::ReedsShepp, site);
            problem.set("anytime", true);
            problem.from({-30.0, -300.0, 0.0}).to({{-10.0, -300.0, 0.0}, {30.0, -300.0, 1.0}});
            unsigned int asked = 0;
            bool isOver = false;
            const ob::PlannerTerminationCondition condition(
                [&]
                {
                    EXPECT_FALSE(isOver);
                    return ++asked > questions;
                });
            problem.planner->solve(condition);
            isOver = true;
            EXPECT_GE(problem.planner->suboptimalityBound(), 1.0);
        }
    }

    TEST_F(PlannerSeveralCalls, SolvesAgainOnGrids)
    {
        PlanningProblem problem(Space::SE2, openSite(15.0));
        problem.set("motion_model", "grid8");
        problem.from(AISLE).to({{8.0, 5.0, 0.0}});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const std::vector<Pose> first = problem.poses();
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(areSame(problem.poses(), first));
    }

    TEST_F(PlannerSeveralCalls, GoesOnAfterATimeout)
    {
        PlanningProblem whole(Space::ReedsShepp, slotSite());
        whole.from(AISLE).to({SLOT});
        ASSERT_EQ(whole.solve(), Status::EXACT_SOLUTION);

        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.set("approximate", false);
        problem.from(AISLE).to({SLOT});
        int calls = 0;
        Status status = Status::TIMEOUT;
        for (; status != Status::EXACT_SOLUTION && calls < 1000; ++calls)
        {
            status = problem.solveForQuestions(2);
            ASSERT_TRUE(status == Status::EXACT_SOLUTION || status == Status::TIMEOUT);
        }
        EXPECT_EQ(status, Status::EXACT_SOLUTION);
        EXPECT_GT(calls, 1);
        // As much work in pieces as in one go.
        EXPECT_LE(problem.planner->statistics().expanded, whole.planner->statistics().expanded);
        EXPECT_TRUE(problem.path().check());
    }

    // A checker that knows states only is asked whether to stop in the middle of motions. What was cut short there must
    // be looked at again, or the tree would stay without branches.
    TEST_F(PlannerSeveralCalls, GoesOnAfterATimeoutWithinAMotion)
    {
        PlanningProblem problem(Space::ReedsShepp, openSite(12.0).bounds, isClearOfPost);
        problem.set("approximate", false);
        problem.from({-9.0, 0.5, 0.0}).to({{9.0, 0.5, 0.0}});
        Status status = Status::TIMEOUT;
        unsigned int calls = 0;
        // A little longer each time: an expansion is begun anew in each call.
        for (; status != Status::EXACT_SOLUTION && calls < 500; ++calls)
            status = problem.solveForQuestions(3 + calls);
        EXPECT_EQ(status, Status::EXACT_SOLUTION);
        EXPECT_GT(calls, 3u);
        EXPECT_TRUE(problem.path().check());
    }

    TEST_F(PlannerSeveralCalls, GoesOnAfterATimeoutOnGrids)
    {
        for (const char *loading : {"lazy", "eager"})
        {
            PlanningProblem problem(Space::SE2, openSite(15.0));
            problem.set("motion_model", "grid16");
            problem.set("obstacle_loading", loading);
            problem.set("approximate", false);
            problem.from(AISLE).to({{8.0, 5.0, 0.0}});
            Status status = Status::TIMEOUT;
            int calls = 0;
            for (; status != Status::EXACT_SOLUTION && calls < 10000; ++calls)
                status = problem.solveForQuestions(4);
            EXPECT_EQ(status, Status::EXACT_SOLUTION) << loading;
            EXPECT_GT(calls, 1);
        }
    }

    TEST_F(PlannerSeveralCalls, ClearForgetsEverything)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const std::vector<Pose> first = problem.poses();
        const auto expanded = problem.planner->statistics().expanded;
        problem.planner->clear();
        EXPECT_EQ(problem.planner->statistics().expanded, 0u);
        EXPECT_EQ(problem.planner->solutionPath(), nullptr);
        EXPECT_FALSE(problem.planner->isSetup());
        problem.pdef->clearSolutionPaths();
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(areSame(problem.poses(), first));
        EXPECT_EQ(problem.planner->statistics().expanded, expanded);
    }

    TEST_F(PlannerSeveralCalls, ClearQueryKeepsOnlyWhatDoesNotDependOnTheQuery)
    {
        for (const char *model : {"car", "grid8"})
        {
            const Site site = slotSite();
            const std::vector<std::pair<Pose, Pose>> queries{
                {AISLE, {8.0, -6.0, 1.0}}, {{8.0, -8.0, 2.0}, {-9.0, 8.0, 0.0}}, {AISLE, {8.0, -6.0, 1.0}}};
            PlanningProblem kept(Space::SE2, site);
            kept.set("motion_model", model);
            for (const auto &[start, goal] : queries)
            {
                kept.planner->clearQuery();
                EXPECT_TRUE(kept.pdef->getStartStateCount() == 0 || kept.planner->isSetup());
                kept.pdef->clearStartStates();
                kept.pdef->clearSolutionPaths();
                kept.from(start).to({goal});
                ASSERT_EQ(kept.solve(), Status::EXACT_SOLUTION) << model;
                PlanningProblem fresh(Space::SE2, site);
                fresh.set("motion_model", model);
                fresh.from(start).to({goal});
                ASSERT_EQ(fresh.solve(), Status::EXACT_SOLUTION);
                EXPECT_TRUE(areSame(kept.poses(), fresh.poses())) << model;
                EXPECT_EQ(kept.planner->statistics().expanded, fresh.planner->statistics().expanded);
            }
        }
    }

    TEST_F(PlannerSeveralCalls, ClearQueryTakesUpANewMap)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        Site site = slotSite();
        site.obstacles.push_back(box(-3.0, -3.5, -2.5, -2.5));
        problem.setObstacles(site.set());
        EXPECT_FALSE(problem.path().check());
        problem.planner->clearQuery();
        problem.pdef->clearSolutionPaths();
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(problem.path().check());
    }

    TEST_F(PlannerSeveralCalls, AnotherCheckerBeginsANewQuery)
    {
        for (const bool anytime : {false, true})
        {
            PlanningProblem problem(Space::ReedsShepp, slotSite());
            problem.set("anytime", anytime);
            problem.from(AISLE).to({SLOT});
            ASSERT_EQ(problem.solve(0.2), Status::EXACT_SOLUTION);
            Site site = slotSite();
            site.obstacles.push_back(box(-3.0, -3.5, -2.5, -2.5));
            problem.setObstacles(site.set());
            problem.pdef->clearSolutionPaths();
            ASSERT_EQ(problem.solve(0.2), Status::EXACT_SOLUTION);
            EXPECT_TRUE(problem.path().check());
        }
    }

    TEST_F(PlannerSeveralCalls, AnotherCheckerOrValidatorAloneDoesToo)
    {
        const Pose left{-8.0, 0.0, 0.0}, right{8.0, 0.0, 0.0};
        const auto isAway = [](const Pose &pose)
        {
            return std::abs(pose.x) > 1.0 || pose.y > 2.0;
        };
        class NotThere : public ob::DiscreteMotionValidator
        {
        public:
            using DiscreteMotionValidator::checkMotion;
            using DiscreteMotionValidator::DiscreteMotionValidator;
            bool checkMotion(const ob::State *a, const ob::State *b) const override
            {
                return parking::poseOf(b).y > 0.5 && DiscreteMotionValidator::checkMotion(a, b);
            }
        };
        PlanningProblem checked(Space::ReedsShepp, openSite(15.0).bounds, [](const Pose &) { return true; });
        checked.from(left).to({right});
        ASSERT_EQ(checked.solve(), Status::EXACT_SOLUTION);
        checked.si->setStateValidityChecker([isAway](const ob::State *state)
                                            { return isAway(parking::poseOf(state)); });
        checked.pdef->clearSolutionPaths();
        ASSERT_EQ(checked.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(checked.path().check());

        PlanningProblem moved(Space::ReedsShepp, openSite(15.0).bounds, [](const Pose &) { return true; });
        moved.from(left).to({right});
        ASSERT_EQ(moved.solve(), Status::EXACT_SOLUTION);
        moved.si->setMotionValidator(std::make_shared<NotThere>(moved.si));
        moved.pdef->clearSolutionPaths();
        moved.solveForQuestions(2000);
        EXPECT_FALSE(moved.pdef->hasExactSolution()) << "no motion may end at the goal";
    }

    TEST_F(PlannerSeveralCalls, AnotherProblemDefinitionBeginsANewQuery)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        problem.pdef = std::make_shared<ob::ProblemDefinition>(problem.si);
        const Pose start{8.0, -8.0, 2.0}, goal{-9.0, 8.0, 0.0};
        problem.from(start).to({goal});
        problem.planner->setProblemDefinition(problem.pdef);
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().front(), start, SAME));
        EXPECT_TRUE(isSamePose(problem.poses().back(), goal, SAME));
    }

    TEST_F(PlannerSeveralCalls, AnotherGoalObjectBeginsANewQuery)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const Pose goal{8.0, -6.0, 1.0};
        problem.to({goal});
        problem.pdef->clearSolutionPaths();
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), goal, SAME));
    }

    TEST_F(PlannerSeveralCalls, AnotherParameterBeginsANewQuery)
    {
        PlanningProblem problem(Space::SE2, openSite(15.0));
        problem.from(AISLE).to({{8.0, 5.0, 0.0}});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const auto turnsOnTheSpot = [&problem]
        {
            const std::vector<parking::PathPiece> &pieces = problem.planner->solutionPath()->pieces;
            return std::any_of(pieces.begin(), pieces.end(), [](const auto &piece) { return piece.turn != 0.0; });
        };
        EXPECT_FALSE(turnsOnTheSpot());
        problem.set("motion_model", "grid8");
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(turnsOnTheSpot());
        EXPECT_GT(problem.planner->statistics().expanded, 0u);
    }
}  // namespace
