// What OMPL asks of every planner: solving again, going on, forgetting, and the statuses.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <string>

#include <ompl/base/goals/GoalState.h>
#include <ompl/util/Console.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerContract : public testing::Test
    {
    protected:
        void SetUp() override
        {
            ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        }
    };

    bool isClearOfPost(const Pose &pose)
    {
        return std::hypot(pose.x, pose.y) > 3.0;
    }

    TEST_F(PlannerContract, SolvesAgainAtOnceWithAsGoodASolution)
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

    TEST_F(PlannerContract, SolvesAgainOnGrids)
    {
        PlanningProblem problem(Space::SE2, openSite(15.0));
        problem.set("motion_model", "grid8");
        problem.from(AISLE).to({{8.0, 5.0, 0.0}});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const std::vector<Pose> first = problem.poses();
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(areSame(problem.poses(), first));
    }

    TEST_F(PlannerContract, GoesOnAfterATimeout)
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
    TEST_F(PlannerContract, GoesOnAfterATimeoutWithinAMotion)
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

    TEST_F(PlannerContract, GoesOnAfterATimeoutOnGrids)
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

    TEST_F(PlannerContract, ClearForgetsEverything)
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

    TEST_F(PlannerContract, ClearQueryKeepsOnlyWhatDoesNotDependOnTheQuery)
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

    TEST_F(PlannerContract, ClearQueryTakesUpANewMap)
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

    // A motion validator that knows another map than the checker has the last word.
    TEST_F(PlannerContract, TheMotionValidatorHasTheLastWord)
    {
        PlanningProblem problem(Space::ReedsShepp, openSite(15.0));
        const auto empty =
            std::static_pointer_cast<parking::FclFootprintChecker>(problem.si->getStateValidityChecker());
        Site site = openSite(15.0);
        site.obstacles.push_back(box(-1.0, -15.0, 1.0, 15.0));
        problem.setObstacles(site.set());
        problem.si->setStateValidityChecker(empty);
        // Of two goals the nearer one is behind a wall that only the validator knows.
        const Pose before{-8.0, 10.0, parking::PI};
        problem.from({-8.0, 0.0, 0.0}).to({{2.5, 0.0, 0.0}, before});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), before, SAME));
        EXPECT_TRUE(problem.path().check());
    }

    TEST_F(PlannerContract, AnotherProblemDefinitionBeginsANewQuery)
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

    TEST_F(PlannerContract, AnotherGoalObjectBeginsANewQuery)
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

    TEST_F(PlannerContract, AnotherParameterBeginsANewQuery)
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

    TEST_F(PlannerContract, TakesNoTimeWhenThereIsNone)
    {
        for (const char *model : {"car", "grid8"})
        {
            PlanningProblem problem(Space::SE2, slotSite());
            problem.set("motion_model", model);
            problem.from(AISLE).to({SLOT});
            EXPECT_EQ(problem.solve(0.0), Status::TIMEOUT);
            EXPECT_EQ(problem.planner->statistics().expanded, 0u);
            EXPECT_FALSE(problem.pdef->hasSolution());
            ob::PlannerData data(problem.si);
            problem.planner->getPlannerData(data);
            EXPECT_EQ(data.numVertices(), 0u);
        }
    }

    TEST_F(PlannerContract, NamesWhatIsWrongWithTheInput)
    {
        const Pose inObstacle{-2.5, 2.0, 0.0}, outside{40.0, 0.0, 0.0};
        for (const char *model : {"car", "grid8"})
            for (const Pose &bad : {inObstacle, outside})
            {
                PlanningProblem badStart(Space::SE2, slotSite());
                badStart.set("motion_model", model);
                badStart.from(bad).to({SLOT});
                EXPECT_EQ(badStart.solve(), Status::INVALID_START) << model;
                EXPECT_FALSE(badStart.pdef->hasSolution());

                PlanningProblem badGoal(Space::SE2, slotSite());
                badGoal.set("motion_model", model);
                badGoal.set("approximate", false);
                badGoal.from(AISLE).to({bad});
                EXPECT_EQ(badGoal.solve(), Status::INVALID_GOAL) << model;
                EXPECT_FALSE(badGoal.pdef->hasSolution());
            }
    }

    TEST_F(PlannerContract, RefusesGoalsThatOfferNoStates)
    {
        class AnyPlaceOnTheRight : public ob::Goal
        {
        public:
            using ob::Goal::Goal;
            bool isSatisfied(const ob::State *state) const override
            {
                return parking::poseOf(state).x > 5.0;
            }
        };
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE);
        problem.pdef->setGoal(std::make_shared<AnyPlaceOnTheRight>(problem.si));
        EXPECT_EQ(problem.solve(), Status::UNRECOGNIZED_GOAL_TYPE);
    }

    TEST_F(PlannerContract, WantsAProblem)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        const og::ImprovedAStar &unused = *problem.planner;
        EXPECT_EQ(unused.statistics().expanded, 0u);
        og::ImprovedAStar planner(problem.si);
        EXPECT_THROW(planner.solve(ob::timedPlannerTerminationCondition(1.0)), ompl::Exception);
        EXPECT_THROW(problem.solve(), ompl::Exception);  // no goal
    }

    TEST_F(PlannerContract, EndsNearGoalsThatCannotBeReached)
    {
        struct Case
        {
            const char *model;
            Site site;
            Pose goal;
        };
        Site blocked = openSite(15.0);
        blocked.obstacles.push_back(box(5.0, -3.0, 9.0, 3.0));
        for (const Case &each :
             {Case{"car", closedSite(), {8.0, 0.0, 0.0}}, Case{"grid8", closedSite(), {8.0, 0.0, 0.0}},
              Case{"car", blocked, {7.0, 0.0, 0.0}}, Case{"grid8", blocked, {7.0, 0.0, 0.0}}})
        {
            PlanningProblem problem(Space::SE2, each.site);
            problem.set("motion_model", each.model);
            problem.from({-8.0, 1.0, 0.0}).to({each.goal});
            ASSERT_EQ(problem.solve(), Status::APPROXIMATE_SOLUTION) << each.model;
            EXPECT_TRUE(problem.pdef->hasApproximateSolution());
            const std::vector<Pose> poses = problem.poses();
            EXPECT_TRUE(isSamePose(poses.front(), {-8.0, 1.0, 0.0}, SAME));
            EXPECT_TRUE(problem.path().check()) << each.model;
            double difference = -1.0;
            problem.pdef->getGoal()->isSatisfied(problem.path().getStates().back(), &difference);
            EXPECT_GT(difference, 0.0);
            EXPECT_DOUBLE_EQ(problem.pdef->getSolutionDifference(), difference);
            // The front all but touches the wall, or the rear where the car may turn round.
            EXPECT_LT(positionDistance(poses.back(), each.goal), std::string(each.model) == "car" ? 9.5 : 12.3)
                << each.model;

            problem.pdef->clearSolutionPaths();
            problem.set("approximate", false);
            const Status without = problem.solve();
            EXPECT_TRUE(without == nothingLeft() || without == Status::INVALID_GOAL);
            EXPECT_FALSE(problem.pdef->hasSolution());
        }
    }

    TEST_F(PlannerContract, StartAtTheGoal)
    {
        for (const char *model : {"car", "grid8"})
        {
            PlanningProblem problem(Space::SE2, slotSite());
            problem.set("motion_model", model);
            problem.from(AISLE).to({AISLE});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            EXPECT_EQ(problem.path().length(), 0.0);
            EXPECT_GE(problem.path().getStateCount(), 2u);
            EXPECT_TRUE(isSamePose(problem.poses().back(), AISLE, SAME));
        }
    }

    TEST_F(PlannerContract, SameInputSamePath)
    {
        for (const Space kind : {Space::SE2, Space::ReedsShepp})
        {
            std::vector<Pose> first;
            for (int run = 0; run < 3; ++run)
            {
                PlanningProblem problem(kind, slotSite());
                problem.from(AISLE).to({SLOT, {0.0, 1.0, 0.5 * parking::PI}});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                if (run == 0)
                    first = problem.poses();
                EXPECT_TRUE(areSame(problem.poses(), first));
            }
        }
    }
}  // namespace
