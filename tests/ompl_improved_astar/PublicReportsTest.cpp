// Troubles that users of other planners report in public: numbers of the reports, scenes of our own.

#include "parking_geometry/referee/Referee.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{
    using namespace parking_test;

    /** A robot with its rear axle \e front metres behind its front and \e rear metres ahead of its back. */
    parking::Vehicle robot(double front, double rear, double width, double turningRadius)
    {
        parking::Vehicle result;
        result.wheelbase = 0.8 * front;
        result.frontOverhang = front - result.wheelbase;
        result.rearOverhang = rear;
        result.width = width;
        result.maxSteeringAngle = std::atan(result.wheelbase / turningRadius);
        return result;
    }

    /** A cell of a map with a resolution of 5 cm. */
    parking::Polygon cell(double x, double y)
    {
        return box(x - 0.025, y - 0.025, x + 0.025, y + 0.025);
    }

    /** Aisles from (-4, 0) along x, then from (4, 0) along y, and the blocks between them. */
    Scene aisle(double width)
    {
        const double half = 0.5 * width;
        return square({box(-4.5, half, 4.0 - half, 5.0), box(-4.5, -1.0, 4.0 + half + 0.5, -half),
                       box(4.0 + half, -half, 4.0 + half + 0.5, 5.0)});
    }

    /** An aisle and a bay 2.5 m wide at (0, 0), with a car \e gap metres behind the start at (-6, 3.5, 0). */
    Scene carBehind(double gap)
    {
        const double back = -6.0 - parking::Vehicle().rearOverhang - gap;
        return square({box(-8.0, -5.0, -1.25, 0.0), box(1.25, -5.0, 8.0, 0.0), box(-8.0, -5.5, 8.0, -5.0),
                       box(back - 4.5, 2.6, back, 4.4)});
    }

    struct Report
    {
        const char *name;
        parking::Vehicle car;
        Scene scene;
        Pose start, goal;
        double maxLength;  ///< metres
        std::size_t maxCusps;
        Space space{Space::ReedsShepp};
        bool isDirectFree{false};  ///< whether the shortest curve without obstacles is free
    };

    constexpr double QUARTER = 0.5 * parking::PI;
    const parking::Vehicle CAR;
    const parking::Vehicle LONG_ROBOT = robot(0.215, 1.01, 0.84, 0.3);  // footprint of navigation2 issue 4271
    const parking::Vehicle AISLE_ROBOT = robot(0.45, 0.45, 0.62, 0.4);  // footprint of navigation2 issue 5884
    const parking::Vehicle PATROL_ROBOT = robot(0.3, 0.3, 0.5, 0.3);    // turning radius of navigation2 issue 4080

    const Report REPORTS[] = {
        // github.com/ros-navigation/navigation2/issues/5329: two footprints are free, the turn between them is not.
        {"corner_between_two_poses", LONG_ROBOT, square({cell(-0.2, -0.9)}), {}, {0.3, 0.3, QUARTER}, 1.6, 0},
        // ... and a cell that lies inside all outlines of planned footprints is missed.
        {"cell_inside_the_footprint", LONG_ROBOT, square({cell(2.0, 0.0)}), {}, {4.0, 0.0, 0.0}, 4.4, 0},
        // github.com/ros-navigation/navigation2/issues/4271: large steps of the heading jump over a single point.
        {"corner_in_half_a_turn", LONG_ROBOT, square({cell(-0.4, 1.4)}), {}, {0.0, 0.6, parking::PI}, 1.2, 0},
        {"cell_on_the_way_of_a_car", CAR, square({cell(0.0, 0.3)}), {-9.0, 0.0, 0.0}, {9.0, 0.0, 0.0}, 18.3, 0},
        // github.com/ros-navigation/navigation2/issues/5884: no plan for 0.62 m x 0.9 m through an aisle of 1.1 m.
        {"turn_of_an_aisle", AISLE_ROBOT, aisle(1.1), {-3.0, 0.0, 0.0}, {4.0, 4.0, QUARTER}, 11.0, 0},
        {"turn_of_an_aisle_back", AISLE_ROBOT, aisle(1.1), {4.0, 4.0, -QUARTER}, {-3.0, 0.0, parking::PI}, 11.0, 0},
        {"turn_of_an_aisle_in_reverse", AISLE_ROBOT, aisle(1.1), {4.0, 4.0, QUARTER}, {-3.0, 0.0, 0.0}, 11.0, 0},
        // github.com/ros-navigation/navigation2/issues/4080: circles before a goal that is nearly reached.
        {"no_circle_ahead", PATROL_ROBOT, square(), {}, {0.6, 0.1, 0.0}, 0.7, 0, Space::Dubins, true},
        {"no_circle_at_the_goal", PATROL_ROBOT, square(), {}, {0.1, 0.05, 0.1}, 0.5, 2, Space::ReedsShepp, true},
        // github.com/ros-navigation/navigation2/issues/2525: loops on short paths, here of one cell of 5 cm.
        {"no_loop_of_one_cell", PATROL_ROBOT, square(), {}, {0.05, 0.05, 0.0}, 0.6, 2, Space::ReedsShepp, true},
        // github.com/autowarefoundation/autoware_universe/issues/8699: no plan with a vehicle close behind the start.
        {"car_10_cm_behind", CAR, carBehind(0.1), {-6.0, 3.5, 0.0}, {0.0, -3.5, QUARTER}, 16.0, 1},
        {"car_1_cm_behind", CAR, carBehind(0.01), {-6.0, 3.5, 0.0}, {0.0, -3.5, QUARTER}, 16.0, 1},
    };

    class PublicReports : public testing::TestWithParam<Report>
    {
    };

    TEST_P(PublicReports, AreNoTrouble)
    {
        const Report &each = GetParam();
        PlanningProblem problem(each.space, each.scene, "", each.car);
        const ob::ScopedState<> start = problem.state(each.start), goal = problem.state(each.goal);
        // The scenes have the difficulty of the reports: start and goal are free, the direct curve is not.
        ASSERT_TRUE(problem.isFree(each.start) && problem.isFree(each.goal));
        EXPECT_EQ(problem.si->checkMotion(start.get(), goal.get()), each.isDirectFree);

        ASSERT_EQ(problem.from({each.start}).to({each.goal}).solve(), Status::EXACT_SOLUTION);
        problem.expectSound();
        const parking::Path &path = *problem.planner->solutionPath();
        parking::Scenario scenario;
        scenario.vehicle = each.car;
        scenario.start = each.start;
        scenario.goals = {each.goal};
        scenario.polygons = each.scene.obstacles;
        scenario.bounds = each.scene.bounds;
        const parking::Verdict verdict = parking::check(scenario, path);
        EXPECT_TRUE(verdict.valid) << verdict.reason;
        EXPECT_TRUE(PolygonOracle(each.scene.obstacles, each.scene.bounds).isPathFree(path, each.car, 0.001));
        EXPECT_LE(path.length(), each.maxLength);
        EXPECT_LE(path.cusps(), each.maxCusps);
    }

    INSTANTIATE_TEST_SUITE_P(Planner, PublicReports, testing::ValuesIn(REPORTS),
                             [](const auto &each) { return std::string(each.param.name); });
}  // namespace
