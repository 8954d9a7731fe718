// The spaces and checkers that the planner works with, and those that it refuses.

#include "benchmarks/worlds/Random.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/util/Exception.h>

namespace
{
    using namespace parking_test;
    using parking::PathPiece;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerSpaces : public Silent<testing::Test>
    {
    protected:
        static std::string refusal(og::ImprovedAStar &planner)
        {
            try
            {
                planner.setup();
            }
            catch (const ompl::Exception &error)
            {
                return error.what();
            }
            return "";
        }
    };

    const std::pair<Pose, Pose> QUERIES[] = {{AISLE, SLOT},
                                             {AISLE, {0.0, 1.0, 0.5 * parking::PI}},
                                             {SLOT, {-8.0, -3.0, parking::PI}},
                                             {{9.0, 8.0, 1.0}, {-9.0, 8.0, 4.0 - 2.0 * parking::PI}}};

    TEST_F(PlannerSpaces, PathsBeginAndEndExactlyAndPassEveryCheck)
    {
        for (const Space kind : {Space::SE2, Space::ReedsShepp})
            for (const auto &[start, goal] : QUERIES)
            {
                PlanningProblem problem(kind, slotSite());
                problem.from(start).to({goal});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                const std::vector<Pose> poses = problem.poses();
                EXPECT_TRUE(isSamePose(poses.front(), start, 0.0));
                EXPECT_TRUE(isSamePose(poses.back(), goal, 0.0));
                EXPECT_TRUE(problem.path().check());  // by the swept validator
                problem.si->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(problem.si));
                problem.space->setLongestValidSegmentFraction(0.0005);
                problem.space->setup();
                EXPECT_TRUE(problem.path().check());  // and by states 2 cm apart
            }
    }

    TEST_F(PlannerSpaces, InterpolationFollowsTheArcs)
    {
        for (const Space kind : {Space::SE2, Space::ReedsShepp, Space::Dubins})
        {
            PlanningProblem problem(kind, openSite(20.0));
            problem.from({-8.0, -3.0, 0.0}).to({{5.0, 6.0, -2.0}});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            const parking::Path &arcs = *problem.planner->solutionPath();
            og::PathGeometric path = problem.path();
            EXPECT_NEAR(kind == Space::SE2 ? arcs.length() : path.length(), arcs.length(), 1e-6);
            path.interpolate(2000);
            const parking::SampledPath exact = arcs.sample(0.001);
            std::size_t nearest = 0;
            for (const Pose &pose : PlanningProblem::posesOf(path))
            {
                double least = 1e9;
                for (std::size_t i = nearest; i < exact.size() && i < nearest + 2000; ++i)
                    if (const double off = positionDistance(exact[i].pose, pose) +
                                           0.1 * std::abs(parking::wrapAngle(exact[i].pose.yaw - pose.yaw));
                        off < least)
                    {
                        least = off;
                        nearest = i;
                    }
                ASSERT_LT(least, 2e-3);
            }
        }
    }

    TEST_F(PlannerSpaces, DubinsCarsNeverReverse)
    {
        Site site = openSite(20.0);
        site.obstacles = {box(-1.0, -6.0, 1.0, 6.0), box(6.0, -12.0, 7.0, 2.0)};
        for (const bool symmetric : {false, true})
            for (int i = 0; i < 8; ++i)
            {
                PlanningProblem problem(Space::Dubins, site.bounds);
                if (symmetric)
                {
                    const ob::RealVectorBounds bounds = problem.space->as<ob::SE2StateSpace>()->getBounds();
                    problem.space = std::make_shared<ob::DubinsStateSpace>(problem.vehicle.minTurningRadius(), true);
                    problem.space->as<ob::SE2StateSpace>()->setBounds(bounds);
                    problem.si = std::make_shared<ob::SpaceInformation>(problem.space);
                    problem.pdef = std::make_shared<ob::ProblemDefinition>(problem.si);
                }
                problem.setObstacles(site.set());
                problem.makePlanner();
                const Pose goal{12.0, -8.0 + 2.0 * i, 0.8 * i - parking::PI};
                problem.from({-10.0, 0.0, 0.4 * i}).to({goal});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION) << i;
                for (const PathPiece &segment : problem.planner->solutionPath()->pieces)
                    EXPECT_GT(segment.length, 0.0);
                EXPECT_TRUE(isSamePose(problem.poses().back(), goal, SAME));
                EXPECT_TRUE(problem.path().check());
            }
    }

    // The last piece may be shorter than any tolerance: taken for a turn on the spot it would be a circle.
    TEST_F(PlannerSpaces, ShortLastPiecesStayPieces)
    {
        parking::Vehicle car;
        car.wheelbase = 0.3;
        car.frontOverhang = car.rearOverhang = 0.1;
        car.width = 0.3;
        car.maxSteeringAngle = std::atan(car.wheelbase / 0.5);
        const parking::Box bounds{{-15.0, -15.0}, {15.0, 15.0}};
        for (const Space space : {Space::Dubins, Space::ReedsShepp})
        {
            PlanningProblem problem(space, bounds, car);
            problem.setObstacles(
                parking::ObstacleSet::fromPolygons({box(-1.0, 0.3, 5.0, 0.4), box(-1.0, -0.4, 5.0, -0.3)}, bounds));
            problem.makePlanner();
            problem.from({0.0, 0.0, 0.0}).to({{3.0000009, 8.1e-13, 1.8e-6}});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            EXPECT_LT(problem.path().length(), 3.01);
            EXPECT_TRUE(problem.path().check());
        }
    }

    // OMPL's Reeds-Shepp space swerves along some short straight lines, which the last digits of their ends decide.
    TEST_F(PlannerSpaces, ShortStraightLinesStayStraight)
    {
        Random random(1);
        int swerving = 0;
        for (int i = 0; i < 300; ++i)
        {
            const Pose start{random.between(-12.0, 12.0), random.between(-12.0, 12.0), random.between(-3.1, 3.1)};
            const double length = random.magnitude(0.01, 0.15);
            const Pose goal = advance(start, 0.0, length);
            PlanningProblem problem(Space::ReedsShepp, openSite(20.0));
            problem.from(start).to({goal});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            ob::ScopedState<> first(problem.si), last(problem.si);
            parking::setPose(first.get(), start);
            parking::setPose(last.get(), goal);
            swerving += problem.space->distance(first.get(), last.get()) > 1.01 * std::abs(length);
            ASSERT_NEAR(problem.path().length(), std::abs(length), 1e-6);
            ASSERT_TRUE(isSamePose(problem.poses().back(), goal, SAME));
        }
        EXPECT_GT(swerving, 3);
    }

    // A car parked a tenth of a millimetre from a wall is somewhere to start from and to drive to.
    TEST_F(PlannerSpaces, StartsAndGoalsMayAllButTouch)
    {
        const parking::Vehicle car;
        const double front = car.wheelbase + car.frontOverhang, rear = car.rearOverhang;
        for (const Space space : {Space::ReedsShepp, Space::SE2, Space::Dubins})
            for (const double gap : {1e-5, 1e-4, 6e-4})
            {
                SCOPED_TRACE(gap);
                // Behind the start and ahead of the goal.
                const Site site{{box(-9.0 - rear - gap - 0.5, -2.0, -9.0 - rear - gap, 2.0),
                                 box(7.0 + front + gap, 2.0, 7.0 + front + gap + 0.5, 6.0)},
                                {{-15.0, -15.0}, {15.0, 15.0}}};
                PlanningProblem problem(space, site);
                problem.from({-9.0, 0.0, 0.0}).to({{7.0, 4.0, 0.0}});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                EXPECT_TRUE(problem.path().check());
            }
    }

    TEST_F(PlannerSpaces, OtherSpacesAreRefused)
    {
        const auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
        plane->setBounds(-1.0, 1.0);
        const auto solid = std::make_shared<ob::SE3StateSpace>();
        ob::RealVectorBounds bounds(3);
        bounds.setLow(-1.0);
        bounds.setHigh(1.0);
        solid->setBounds(bounds);
        for (const ob::StateSpacePtr &space : {ob::StateSpacePtr(plane), ob::StateSpacePtr(solid)})
        {
            const auto si = std::make_shared<ob::SpaceInformation>(space);
            si->setStateValidityChecker([](const ob::State *) { return true; });
            og::ImprovedAStar planner(si);
            const std::string text = refusal(planner);
            EXPECT_NE(text.find("Reeds-Shepp"), std::string::npos) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos);
        }
    }

    TEST_F(PlannerSpaces, WhatIsRefusedIsRefusedAgain)
    {
        const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
        space->setBounds(-10.0, 10.0);
        const auto si = std::make_shared<ob::SpaceInformation>(space);
        si->setStateValidityChecker([](const ob::State * /*state*/) { return true; });
        si->setup();
        const auto pdef = std::make_shared<ob::ProblemDefinition>(si);
        ob::ScopedState<> start(space), goal(space);
        for (unsigned int i = 0; i < 3; ++i)
        {
            start[i] = 0.0;
            goal[i] = 1.0;
        }
        pdef->setStartAndGoalStates(start, goal);
        og::ImprovedAStar planner(si);
        planner.setProblemDefinition(pdef);
        for (int call = 0; call < 2; ++call)
            EXPECT_THROW(planner.solve(ob::timedPlannerTerminationCondition(0.5)), ompl::Exception);
    }

    TEST_F(PlannerSpaces, PartsArePlannedAnewWhereTheMotionValidatorHasTheLastWord)
    {
        // The part ends where boxes are in the way to the goal.
        const Site site{
            {box(40.52, -8.97, 41.68, -5.11), box(30.09, -17.63, 32.37, -13.80), box(41.76, -8.16, 44.07, -3.92),
             box(49.92, -11.56, 54.59, -7.80), box(30.74, -5.58, 35.25, -3.64), box(13.07, -19.71, 16.81, -16.04),
             box(32.17, -7.31, 36.11, -6.29), box(11.40, -1.31, 14.31, 1.04), box(27.00, -11.64, 28.34, -10.34),
             box(20.03, -9.18, 24.13, -5.40), box(11.57, 4.98, 15.74, 8.69), box(51.07, -15.74, 53.72, -12.46),
             box(47.83, -2.45, 51.35, 1.68), box(23.97, -4.52, 27.81, -2.51)},
            {{-10.0, -29.71}, {70.0, 18.69}}};
        const parking::FootprintChecker checker(site.set(), parking::Vehicle());
        const auto leastClearanceIn = [&](Space kind)
        {
            PlanningProblem problem(kind, site);
            problem.set("preferred_clearance", 0.3);
            problem.from({0.0, 0.0, 0.01});
            problem.to({{60.0, -8.27, 0.76}});
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            double least = 1e9;
            for (const parking::PathState &state : problem.planner->solutionPath()->sample(0.05))
                least = std::min(least, checker.clearance(state.pose));
            return least;
        };
        EXPECT_NEAR(leastClearanceIn(Space::SE2), leastClearanceIn(Space::ReedsShepp), 0.01);
    }

    TEST_F(PlannerSpaces, FarFromTheOriginWhatIsCalledExactIsFree)
    {
        // At four million kilometres OMPL rounds a Dubins curve to one with a whole circle more.
        constexpr double FAR = 4e9;
        for (const Space kind : {Space::Dubins, Space::ReedsShepp})
            for (std::uint64_t seed = 1; seed <= (kind == Space::Dubins ? 40 : 10); ++seed)
            {
                Random random(seed);
                Site site{{}, {{FAR - 15.0, FAR - 15.0}, {FAR + 15.0, FAR + 15.0}}};
                const auto somewhere = [&]
                {
                    return FAR + random.between(-13.0, 13.0);
                };
                for (int k = 0; k < 8; ++k)
                {
                    const double x = somewhere(), y = somewhere();
                    site.obstacles.push_back(box(x, y, x + random.between(0.3, 3.3), y + random.between(0.3, 3.3)));
                }
                PlanningProblem problem(kind, site);
                problem.set("approximate", false);
                const auto freePose = [&]
                {
                    for (;;)
                        if (const Pose pose{somewhere(), somewhere(), random.between(-3.1, 3.1)};
                            problem.si->isValid(problem.state(pose).get()))
                            return pose;
                };
                problem.from(freePose());
                problem.to({freePose()});
                if (problem.solve(0.5) == Status::EXACT_SOLUTION)
                {
                    EXPECT_TRUE(problem.path().check()) << seed;
                }
            }
    }

    TEST_F(PlannerSpaces, AlmostAtTheGoalAlready)
    {
        // A heading written with ten digits.
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from({0.0, 4.0, -0.5 * parking::PI}).to({{0.0, 4.0, -1.5707963268}});
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        for (const double off : {1e-12, 2e-12, 4e-12, 1e-11, 1e-10, 1e-9})
            for (const double yaw : {0.0, 0.7, -2.0})
            {
                PlanningProblem open(Space::ReedsShepp, openSite(15.0));
                open.from({1.0, 2.0, yaw}).to({{1.0, 2.0, yaw + off}});
                EXPECT_EQ(open.solve(), Status::EXACT_SOLUTION) << off << ", " << yaw;
            }
    }

    TEST_F(PlannerSpaces, GridsBelongOnAPlainSpace)
    {
        for (const Space kind : {Space::ReedsShepp, Space::Dubins})
            for (const char *model : {"grid8", "grid16"})
            {
                PlanningProblem problem(kind, openSite(15.0));
                problem.set("motion_model", model);
                const std::string text = refusal(*problem.planner);
                EXPECT_NE(text.find(model), std::string::npos) << text;
                EXPECT_NE(text.find("SE2StateSpace"), std::string::npos) << text;

                // Also when the model is changed after the setup.
                PlanningProblem later(kind, openSite(15.0));
                later.planner->setup();
                later.set("motion_model", model);
                later.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
                EXPECT_THROW(later.solve(), ompl::Exception);
            }
    }

    TEST_F(PlannerSpaces, AnyCheckerWillDo)
    {
        // A point among posts, in every space and with every model that goes with it.
        const auto isFree = [](const Pose &pose)
        {
            return std::hypot(pose.x, pose.y - 1.0) > 3.0 && std::hypot(pose.x - 5.0, pose.y + 5.0) > 2.0;
        };
        for (const auto &[kind, model] : {std::pair{Space::SE2, "car"},
                                          {Space::ReedsShepp, "car"},
                                          {Space::Dubins, "car"},
                                          {Space::SE2, "grid8"},
                                          {Space::SE2, "grid16"}})
        {
            PlanningProblem problem(kind, openSite(15.0).bounds, isFree);
            problem.set("motion_model", model);
            problem.from({-9.0, 0.0, 0.0}).to({{9.0, 0.0, 0.0}});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION) << model;
            EXPECT_TRUE(problem.path().check());
            og::PathGeometric path = problem.path();
            path.interpolate(1000);
            for (const Pose &pose : PlanningProblem::posesOf(path))
                EXPECT_TRUE(std::hypot(pose.x, pose.y - 1.0) > 2.98) << model;
            EXPECT_GT(problem.planner->checkedStates(), 0u);
            EXPECT_EQ(problem.planner->exactChecks(), 0u);
        }
    }

    TEST_F(PlannerSpaces, AnyMotionValidatorWillDo)
    {
        // A rule of the user's that no state tells: no motion may cross the line x = 0 but through a gate.
        class Gate : public ob::MotionValidator
        {
        public:
            using MotionValidator::MotionValidator;
            bool checkMotion(const ob::State *a, const ob::State *b) const override
            {
                const Pose from = parking::poseOf(a), to = parking::poseOf(b);
                return (from.x < 0.0) == (to.x < 0.0) || (from.y > 2.0 && to.y > 2.0);
            }
            bool checkMotion(const ob::State *a, const ob::State *b,
                             std::pair<ob::State *, double> &lastValid) const override
            {
                lastValid.second = 0.0;
                return checkMotion(a, b);
            }
        };
        for (const char *model : {"car", "grid8"})
        {
            PlanningProblem problem(Space::SE2, openSite(12.0).bounds, [](const Pose &) { return true; });
            problem.si->setMotionValidator(std::make_shared<Gate>(problem.si));
            problem.si->setup();
            problem.set("motion_model", model);
            problem.from({-4.0, 1.0, 0.0}).to({{4.0, 2.5, 0.0}});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION) << model;
            EXPECT_TRUE(problem.path().check()) << model;
        }
    }

    TEST_F(PlannerSpaces, TheBoundsOfTheSpaceHold)
    {
        // The checker's world is larger than the space.
        PlanningProblem problem(Space::ReedsShepp, {{-10.0, -4.0}, {10.0, 4.0}});
        problem.setObstacles(openSite(30.0).set());
        problem.makePlanner();
        problem.from({-8.0, 0.0, 0.0}).to({{-8.0, 1.0, parking::PI}});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        for (const parking::PathState &state : problem.planner->solutionPath()->sample(0.01))
            EXPECT_TRUE(std::abs(state.pose.x) <= 10.0 + 1e-9 && std::abs(state.pose.y) <= 4.0 + 1e-9);
        EXPECT_TRUE(problem.path().check());
    }
}  // namespace
