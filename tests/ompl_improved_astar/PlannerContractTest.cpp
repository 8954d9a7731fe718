// What OMPL asks of every planner: that its checkers are asked, that wrong input is named, and the statuses.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <ompl/base/goals/GoalState.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerContract : public Silent<testing::Test>
    {
    };

    // What a class of one's own adds to the footprint or to the sweep counts.
    TEST_F(PlannerContract, ClassesDerivedFromOursAreAsked)
    {
        class NotInTheMiddle : public parking::FclFootprintChecker
        {
        public:
            using FclFootprintChecker::FclFootprintChecker;
            bool isValid(const ob::State *state) const override
            {
                const Pose pose = parking::poseOf(state);
                return (std::abs(pose.x) > 1.0 || pose.y > 5.0) && FclFootprintChecker::isValid(state);
            }
        };
        class NotBeyond : public parking::SweptMotionValidator
        {
        public:
            using SweptMotionValidator::checkMotion;
            using SweptMotionValidator::SweptMotionValidator;
            bool checkMotion(const ob::State *a, const ob::State *b) const override
            {
                return parking::poseOf(b).x < 9.0 && SweptMotionValidator::checkMotion(a, b);
            }
        };
        const Site site = openSite(15.0);
        PlanningProblem checked(Space::ReedsShepp, site);
        checked.si->setStateValidityChecker(std::make_shared<NotInTheMiddle>(checked.si, site.set(), checked.vehicle));
        checked.si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(checked.si));
        checked.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
        ASSERT_EQ(checked.solve(), Status::EXACT_SOLUTION);
        og::PathGeometric path = checked.path();
        path.interpolate(300);
        for (const ob::State *state : path.getStates())
            EXPECT_TRUE(checked.si->isValid(state)) << parking::poseOf(state).x << ", " << parking::poseOf(state).y;

        PlanningProblem swept(Space::ReedsShepp, site);
        swept.si->setMotionValidator(std::make_shared<NotBeyond>(swept.si));
        const Pose near{8.0, 3.0, 0.0};
        swept.from({-8.0, 0.0, 0.0}).to({{10.0, 0.0, 0.0}, near});
        ASSERT_EQ(swept.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(swept.poses().back(), near, SAME));
    }

    TEST_F(PlannerContract, AYawOfPiIsOutOfBoundsButNoEnd)
    {
        for (const Space space : {Space::SE2, Space::ReedsShepp})
            for (const bool another : {false, true})
            {
                PlanningProblem problem(space, openSite(15.0));
                const auto goals = std::make_shared<ob::GoalStates>(problem.si);
                ob::ScopedState<ob::SE2StateSpace> goal(problem.space);
                goal->setXY(8.0, 0.0);
                goal->setYaw(parking::PI);
                goals->addState(goal);
                if (another)
                    goals->addState(problem.state({8.0, 3.0, 0.0}));
                problem.from({-8.0, 0.0, 0.0});
                problem.pdef->setGoal(goals);
                const Status status = problem.solve();
                EXPECT_EQ(status, another ? Status::EXACT_SOLUTION : Status::APPROXIMATE_SOLUTION);
            }
    }

    TEST_F(PlannerContract, GridsAreNotLargerThanTheyCanBe)
    {
        PlanningProblem problem(Space::SE2, openSite(1500.0));
        problem.set("motion_model", "grid8");
        problem.set("xy_resolution", 0.5);
        problem.from({1490.0, 0.0, 0.0}).to({{1480.0, 0.0, 0.0}});
        try
        {
            problem.solve();
            FAIL() << "beyond its last column a grid sees nothing";
        }
        catch (const ompl::Exception &error)
        {
            EXPECT_NE(std::string(error.what()).find("xy_resolution must be at least 0.73"), std::string::npos)
                << error.what();
        }
        problem.set("xy_resolution", 0.75);
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
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
