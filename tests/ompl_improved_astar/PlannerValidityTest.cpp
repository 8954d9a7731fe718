// Any state validity checker and motion validator will do, and the motion validator has the last word.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <string>

#include <ompl/base/DiscreteMotionValidator.h>

namespace
{
    using namespace parking_test;

    TEST(PlannerValidity, AnyStateValidityChecker)
    {
        const auto isClear = [](const Pose &pose, double slack)
        {
            return std::hypot(pose.x, pose.y - 1.0) > 3.0 - slack &&
                   std::hypot(pose.x - 5.0, pose.y + 5.0) > 2.0 - slack;
        };
        for (const auto &[space, parameters] : VARIANTS)
        {
            SCOPED_TRACE(testing::Message() << static_cast<int>(space) << ' ' << parameters);
            std::uint64_t checks = 0;
            PlanningProblem problem(
                space, square().bounds, [&](const Pose &pose) { return ++checks > 0 && isClear(pose, 0.0); },
                parameters);
            ASSERT_EQ(problem.from({{-9.0, 0.0, 0.0}}).to({{9.0, 0.0, 0.0}}).solve(), Status::EXACT_SOLUTION);
            EXPECT_GT(problem.planner->checkedStates(), 0u);
            EXPECT_LE(problem.planner->checkedStates(), checks);
            // Between the states that are checked the path may cut a corner a little.
            problem.isFree = [&](const Pose &pose)
            {
                return isClear(pose, 0.02);
            };
            problem.expectSound();
        }
    }

    bool isOnTheLeft(const Pose &pose)
    {
        return pose.x < 1.0;
    }

    class LeftChecker : public parking::FclFootprintChecker
    {
    public:
        using FclFootprintChecker::FclFootprintChecker;
        bool isValid(const ob::State *state) const override
        {
            return isOnTheLeft(parking::poseOf(state)) && FclFootprintChecker::isValid(state);
        }
    };

    template <class Base>
    class LeftValidator : public Base
    {
    public:
        using Base::Base;
        using Base::checkMotion;
        bool checkMotion(const ob::State *a, const ob::State *b) const override
        {
            return isOnTheLeft(parking::poseOf(b)) && Base::checkMotion(a, b);
        }
    };

    // Of two goals the nearer one is to the right, where a class of the user's own allows nothing.
    TEST(PlannerValidity, ClassesOfOnesOwnAreAskedAndTheMotionValidatorHasTheLastWord)
    {
        const Pose allowed{-6.0, 8.0, 3.0};
        const auto none = parking::ObstacleSet::fromPolygons({}, square().bounds);
        for (const std::string own : {"checker", "swept validator", "discrete validator", "map of the validator"})
            for (const auto &[space, parameters] : VARIANTS)
            {
                SCOPED_TRACE(testing::Message() << own << ", " << static_cast<int>(space) << parameters);
                PlanningProblem problem(space, square(), parameters);
                const ob::SpaceInformationPtr &si = problem.si;
                if (own == "checker")
                {
                    si->setStateValidityChecker(std::make_shared<LeftChecker>(si, none, problem.vehicle));
                    si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
                }
                else if (own == "swept validator")
                    si->setMotionValidator(std::make_shared<LeftValidator<parking::SweptMotionValidator>>(si));
                else if (own == "discrete validator")
                    si->setMotionValidator(std::make_shared<LeftValidator<ob::DiscreteMotionValidator>>(si));
                else
                {
                    problem.setObstacles(square({box(-0.2, -15.0, 0.2, 15.0)}));
                    si->setStateValidityChecker(
                        std::make_shared<parking::FclFootprintChecker>(si, none, problem.vehicle));
                }
                problem.from({{-8.0, 0.0, 0.0}}).to({{2.5, 0.0, 0.0}, allowed});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                problem.expectSound();
                EXPECT_TRUE(isSamePose(problem.poses().back(), allowed, SAME));
            }
    }

    TEST(PlannerValidity, CheckersThatKnowNoClearanceAreNotAskedForIt)
    {
        PlanningProblem problem(Space::ReedsShepp, square(), "preferred_clearance=0.3");
        const auto clearance = [](const Pose &pose)
        {
            return std::max(std::abs(pose.x) - 2.0, 1.0 - pose.y);
        };
        const auto checker = std::make_shared<CountingChecker>(problem.si, clearance, false);
        problem.si->setStateValidityChecker(checker);
        problem.si->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(problem.si));
        EXPECT_EQ(problem.from({LEFT}).to({RIGHT}).solve(), Status::EXACT_SOLUTION);
        EXPECT_GT(checker->states, 0u);
        EXPECT_EQ(checker->clearances, 0u);
    }
}  // namespace
