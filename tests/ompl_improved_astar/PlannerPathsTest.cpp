// Every reported path is exact, free and drivable: in random worlds, and where rounding decides.

#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace
{
    using namespace parking_test;

    // The space, the parameters and the distance from the origin in metres.
    const std::tuple<Space, const char *, double> VARIATIONS[] = {
        {Space::SE2, "", 0.0},
        {Space::ReedsShepp, "", 0.0},
        {Space::Dubins, "", 0.0},
        {Space::SymmetricDubins, "", 0.0},
        {Space::SE2, "turning_radius=2 steering_angles=7 preferred_clearance=0.5", 0.0},
        {Space::SE2, "turning_radius=5 bidirectional=0 search_from=start", 0.0},
        {Space::ReedsShepp, "steering_angles=5 bidirectional=0", 0.0},
        {Space::ReedsShepp, "obstacle_heuristic=0 detours=0 adaptive_resolution=0", 0.0},
        {Space::ReedsShepp, "shortening=0 obstacle_loading=eager open_list=linear", 0.0},
        {Space::SE2, "heuristic_weight_far=1 heuristic_weight_near=1 gear_change_penalty=3 reverse_penalty=1", 0.0},
        {Space::ReedsShepp, "anytime=1", 0.0},
        {Space::Dubins, "anytime=1 preferred_clearance=0", 0.0},
        {Space::SE2, "motion_model=grid8", 0.0},
        {Space::SE2, "motion_model=grid16 smoothing=none", 0.0},
        {Space::SE2, "", 4e3},
        {Space::ReedsShepp, "", 4e9},
        {Space::Dubins, "", 4e9}};

    class RandomPaths : public testing::TestWithParam<std::size_t>
    {
    };

    /** OMPL's states lie on the planner's exact path, at the distances driven. */
    void expectSameAsExactForm(const PlanningProblem &problem)
    {
        ASSERT_NE(problem.planner->solutionPath(), nullptr);
        const parking::Path &exact = *problem.planner->solutionPath();
        const std::vector<Pose> poses = problem.poses();
        // Coordinates in the billions are rounded to a micrometre. OMPL's curve that moves the car aside by as much is
        // longer than the path's piece.
        const double tolerance = std::abs(exact.start.x) > 1e9 ? 0.05 : 2e-3;
        EXPECT_TRUE(isSamePose(exact.start, poses.front(), SAME));
        EXPECT_TRUE(isSamePose(exact.end(), poses.back(), 1e-9 + 1e-15 * std::abs(poses.back().x)));
        double driven = 0.0;
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            driven += problem.driven(poses[i - 1], poses[i]);
            ASSERT_TRUE(isSamePose(exact.at(std::min(driven, exact.length())), poses[i], tolerance)) << i;
        }
        EXPECT_NEAR(driven, exact.length(), tolerance);
    }

    TEST_P(RandomPaths, AreSound)
    {
        constexpr std::uint64_t WORLDS = 20;
        const auto &[space, parameters, distance] = VARIATIONS[GetParam()];
        const Eigen::Vector2d offset(distance, -0.5 * distance);
        int exact = 0, approximate = 0;
        for (std::uint64_t seed = 1; seed <= WORLDS; ++seed)
        {
            SCOPED_TRACE("seed " + std::to_string(seed));
            Random random(seed);
            const World world = seed % 2 == 0 ? randomPolygonWorld(seed, offset) : randomGridWorld(seed, offset);
            PlanningProblem problem(space, Scene{{}, world.bounds}, parameters);
            problem.setObstacles(world.obstacles, world.oracle);
            const auto freePose = [&]
            {
                for (;;)
                    if (const Pose pose = world.anywhere(random); world.oracle.isFree(pose, problem.vehicle, 1e-6))
                        return pose;
            };
            problem.from({freePose()}).to({seed % 9 == 8 ? world.anywhere(random) : freePose()}).solveWithPolls(6000);
            if (problem.pdef->hasSolution())
                problem.expectSound(problem.pdef->hasExactSolution());
            if (problem.pdef->hasExactSolution() && problem.planner->parameters().motionModel == "car")
                expectSameAsExactForm(problem);
            exact += problem.pdef->hasExactSolution();
            approximate += problem.pdef->hasApproximateSolution();
        }
        EXPECT_GE(exact, 1);
        EXPECT_GE(approximate, 1);
    }

    INSTANTIATE_TEST_SUITE_P(Planner, RandomPaths, testing::Range(std::size_t{0}, std::size(VARIATIONS)));

    /** A wall behind the start at (-9, 0, 0), and one ahead of the goal at (7, 4, 0). */
    Scene bumperToWall(double gap)
    {
        const parking::Vehicle car;
        const double rear = -9.0 - car.rearOverhang - gap, front = 7.0 + car.wheelbase + car.frontOverhang + gap;
        return square({box(rear - 0.5, -2.0, rear, 2.0), box(front, 2.0, front + 0.5, 6.0)});
    }

    TEST(PlannerPaths, AreFoundInTightPlaces)
    {
        parking::Vehicle car, agile;
        agile.maxSteeringAngle = std::atan(agile.wheelbase / 0.5);
        const double front = car.wheelbase + car.frontOverhang + 0.3, side = 0.5 * car.width + 0.05;
        const Scene corridor = square({box(-1.0, side, 5.0, 2.0), box(-1.0, -2.0, 5.0, -side)});
        const Scene kerb = square({box(-15.0, -1.2, -car.rearOverhang - 0.3, 1.2), box(front, -1.2, 15.0, 1.2),
                                   box(-15.0, -2.0, 15.0, -1.2)});
        const Scene gap = square({box(-2.0, side, 2.0, 15.0), box(-2.0, -15.0, 2.0, -side)});
        const Pose behind{-9.0, 0.0, 0.0}, ahead{7.0, 4.0, 0.0};
        const struct
        {
            const char *name;
            Scene scene;
            Pose start, goal;
            double maxLength;
            bool forwards{true};  // possible in a Dubins space
            parking::Vehicle car{};
        } CASES[] = {
            {"perpendicular, nose down", SLOT_SCENE, AISLE, SLOT, 30.0, false},
            {"perpendicular, nose up", SLOT_SCENE, AISLE, {0.0, 1.0, 0.5 * parking::PI}, 40.0},
            {"out of the slot", SLOT_SCENE, SLOT, {-8.0, -3.0, parking::PI}, 30.0},
            {"parallel, 30 cm at either end", kerb, {-8.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, 40.0, false},
            {"5 cm on each side", gap, {-9.0, 1.0, 0.0}, {9.0, -1.0, 0.0}, 19.0},
            {"0.01 mm from walls", bumperToWall(1e-5), behind, ahead, 19.0},
            {"0.6 mm from walls", bumperToWall(6e-4), behind, ahead, 19.0},
            // Taken for a turn on the spot the last piece would be a circle.
            {"a last piece of a micrometre", corridor, {}, {3.0000009, 8.1e-13, 1.8e-6}, 3.01, true, agile},
        };
        for (const auto &each : CASES)
            for (const Space space : {Space::SE2, Space::ReedsShepp, Space::Dubins})
            {
                if (space == Space::Dubins && !each.forwards)
                    continue;
                SCOPED_TRACE(testing::Message() << each.name << ", space " << static_cast<int>(space));
                PlanningProblem problem(space, each.scene, "", each.car);
                ASSERT_EQ(problem.from({each.start}).to({each.goal}).solve(), Status::EXACT_SOLUTION);
                problem.expectSound();
                // Forwards only, a circle may come first.
                const double circle = space == Space::Dubins ? 2.0 * parking::PI * each.car.minTurningRadius() : 0.0;
                EXPECT_LT(problem.planner->solutionPath()->length(), each.maxLength + circle);
            }
    }

    // Cells of the search lie across the bounds, beyond which the checker knows more of the world.
    TEST(PlannerPaths, BeginAndEndAtTheBounds)
    {
        const Pose left{-9.0, 0.0, 0.0};
        const auto isInside = [](const Pose &pose)
        {
            return square().bounds.contains(pose.x, pose.y);
        };
        for (const bool byFootprint : {false, true})
            for (const double edge : {15.0, 14.99, 14.7})
                for (const Pose &at : {Pose{edge, 0.0, 0.0}, {9.0, edge, 0.0}, {9.0, -edge, 0.0}, {edge, edge, 0.0}})
                    for (const bool isReversed : {false, true})
                    {
                        SCOPED_TRACE(testing::Message() << byFootprint << ", " << at.x << ", " << at.y);
                        PlanningProblem problem(Space::ReedsShepp, square().bounds,
                                                [](const Pose &pose)
                                                { return std::abs(pose.x) > 1.2 || pose.y > 9.0; });
                        if (byFootprint)
                            problem.setObstacles(square({box(-0.2, -40.0, 0.2, 8.0)}, 40.0));
                        problem.from({isReversed ? at : left}).to({isReversed ? left : at});
                        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION) << problem.planner->reason();
                        problem.isFree = isInside;
                        problem.expectSound();
                    }
    }

    // OMPL's Reeds-Shepp space swerves along some short straight lines, which the last digits of their ends decide.
    TEST(PlannerPaths, StayStraightAlongShortLines)
    {
        Random random(1);
        int swerving = 0;
        for (int i = 0; i < 300; ++i)
        {
            const Pose start = random.poseIn(-12.0, 12.0);
            const double length = random.magnitude(0.01, 0.15);
            const Pose goal = advance(start, 0.0, length);
            PlanningProblem problem(Space::ReedsShepp, square({}, 20.0));
            ASSERT_EQ(problem.from({start}).to({goal}).solve(), Status::EXACT_SOLUTION);
            ASSERT_NEAR(problem.path().length(), std::abs(length), 1e-6);
            problem.expectSound();
            swerving += problem.driven(start, goal) > 1.01 * std::abs(length);
        }
        EXPECT_GT(swerving, 3);
    }

    // Half a circle in one step could be meant either way.
    TEST(PlannerPaths, KeepTheDirectionOfTurnsOnTheSpot)
    {
        for (const double turn : {3.1, -3.1, -6.0})
        {
            const parking::Path path{{}, {parking::PathPiece::turnOnTheSpot(turn)}};
            const std::vector<Pose> poses = parking::pathStates(path, {});
            double turned = 0.0;
            for (std::size_t i = 1; i < poses.size(); ++i)
            {
                const double step = parking::wrapAngle(poses[i].yaw - poses[i - 1].yaw);
                EXPECT_LE(std::abs(step), parking::PathPiece::LONGEST_TURN + SAME);
                turned += step;
            }
            EXPECT_NEAR(turned, turn, SAME);
        }
    }

    TEST(PlannerPaths, AreFoundFromNearlyTheGoal)
    {
        for (const double off : {0.0, 1e-12, 2e-12, 4e-12, 1e-11, 1e-10, 1e-9})
            for (const double yaw : {0.0, 0.7, -2.0, -0.5 * parking::PI})
            {
                PlanningProblem problem(Space::ReedsShepp, square());
                problem.from({{1.0, 2.0, yaw}}).to({{1.0, 2.0, yaw + off}});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION) << off << ", " << yaw;
                problem.expectSound();
            }
    }
}  // namespace
