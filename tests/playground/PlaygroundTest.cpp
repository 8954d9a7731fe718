#include "playground/src/Playground.h"

#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "parking_geometry/io/ScenarioReader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace
{
    using namespace parking;

    Scenario bundled(const std::string &name)
    {
        return readScenario(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios/" + name + ".yaml");
    }

    void addPose(std::vector<double> &to, const Pose &pose)
    {
        to.insert(to.end(), {pose.x, pose.y, pose.yaw});
    }

    /** The numbers of a scene, in world coordinates, as the page writes them. */
    std::vector<double> numbersOf(const Scenario &scenario)
    {
        const Vehicle &car = scenario.vehicle;
        std::vector<double> numbers{car.wheelbase,       car.frontOverhang,    car.rearOverhang,
                                    car.width,           car.maxSteeringAngle, car.maxSpeed,
                                    car.maxAcceleration, car.maxSteeringRate,  static_cast<double>(car.outline.size())};
        for (const Eigen::Vector2d &corner : car.outline)
            numbers.insert(numbers.end(), {corner.x(), corner.y()});
        addPose(numbers, scenario.toWorld(scenario.start));
        if (scenario.slot)
        {
            const ParkingSlot &slot = *scenario.slot;
            numbers.insert(numbers.end(), {1.0, static_cast<double>(slot.kind)});
            addPose(numbers, scenario.toWorld(slot.pose));
            numbers.insert(numbers.end(),
                           {slot.length, slot.width, static_cast<double>(slot.entry), slot.angle,
                            static_cast<double>(slot.side), slot.depth.value_or(-1.0), slot.lateralOffset});
        }
        else
        {
            numbers.insert(numbers.end(), {0.0, static_cast<double>(scenario.goals.size())});
            for (const Pose &goal : scenario.goals)
                addPose(numbers, scenario.toWorld(goal));
        }
        if (scenario.grid)
        {
            const OccupancyGrid &grid = *scenario.grid;
            numbers.insert(numbers.end(), {1.0, static_cast<double>(grid.width()), static_cast<double>(grid.height()),
                                           grid.resolution()});
            addPose(numbers, scenario.toWorld(grid.origin()));
            numbers.push_back(scenario.unknownIsOccupied ? 1.0 : 0.0);
        }
        else
        {
            numbers.insert(numbers.end(), {0.0, static_cast<double>(scenario.polygons.size())});
            for (const Polygon &polygon : scenario.polygons)
                numbers.push_back(static_cast<double>(polygon.size()));
            for (const Polygon &polygon : scenario.polygons)
                for (const Eigen::Vector2d &corner : polygon)
                    numbers.insert(numbers.end(),
                                   {corner.x() + scenario.worldOffset.x(), corner.y() + scenario.worldOffset.y()});
        }
        return numbers;
    }

    bool setScene(const std::vector<double> &numbers)
    {
        std::copy(numbers.begin(), numbers.end(), playground_numbers(numbers.size()));
        return playground_scene(numbers.size());
    }

    bool setScene(const Scenario &scenario)
    {
        if (scenario.grid)
        {
            const auto &cells = scenario.grid->cells();
            std::uint8_t *to = playground_cells(cells.size());
            for (std::size_t i = 0; i < cells.size(); ++i)
                to[i] = static_cast<std::uint8_t>(cells[i]);
        }
        return setScene(numbersOf(scenario));
    }

    std::vector<double> output(PlaygroundOutput which)
    {
        const double *begin = playground_output(which);
        return {begin, begin + playground_output_size(which)};
    }

    class PlaygroundTest : public testing::Test
    {
    protected:
        void SetUp() override
        {
            playground_reset_parameters();
        }
    };

    TEST_F(PlaygroundTest, PlansAsTheCoreDoes)
    {
        for (const char *name :
             {"perpendicular", "parallel", "narrow_parallel", "underground_garage", "../../examples/forklift"})
        {
            const Scenario scenario = bundled(name);
            ASSERT_TRUE(setScene(scenario)) << playground_message();
            ASSERT_TRUE(playground_plan(1e9, 0.0)) << playground_message();
            PlanLimits limits;
            limits.time = std::numeric_limits<double>::infinity();
            const ScenarioPlanner planner(scenario);
            const ScenarioPlan plan = planner.plan({}, limits);
            const std::vector<double> summary = output(PLAYGROUND_SUMMARY);
            ASSERT_EQ(summary.size(), 17u);
            EXPECT_EQ(summary[16], 0.0) << "a car drives it";
            EXPECT_EQ(summary[0], 0.0) << name;
            EXPECT_NEAR(summary[1], plan.path.length(), 1e-9) << name;
            EXPECT_EQ(summary[2], static_cast<double>(plan.path.cusps())) << name;
            EXPECT_NEAR(summary[3], planner.clearance(plan), 1e-9) << name;
            EXPECT_EQ(summary[6], static_cast<double>(plan.statistics.expanded)) << name;
            const std::vector<double> path = output(PLAYGROUND_PATH);
            const Pose start = scenario.toWorld(scenario.start);
            ASSERT_EQ(path.size() % 7, 0u);
            EXPECT_NEAR(path[0], start.x, 1e-9);
            EXPECT_NEAR(path[1], start.y, 1e-9);
            EXPECT_EQ(output(PLAYGROUND_PIECES).size(), 4 * plan.path.pieces.size());
            EXPECT_EQ(output(PLAYGROUND_GOALS).size(), 3 * scenario.goals.size());
            ASSERT_TRUE(playground_trajectory(10.0)) << playground_message();
            EXPECT_GT(output(PLAYGROUND_TRAJECTORY).size(), 80u);
            ASSERT_TRUE(playground_trace(1e9, 1e6)) << playground_message();
            const std::vector<double> steps = output(PLAYGROUND_STEPS);
            EXPECT_EQ(steps[steps.size() - 4], summary[6]) << name;
            EXPECT_EQ(output(PLAYGROUND_START_TREE).size(), 9 * static_cast<std::size_t>(steps[steps.size() - 3]));
        }
    }

    TEST_F(PlaygroundTest, TellsItsParametersAndCars)
    {
        const auto table = nlohmann::json::parse(playground_parameters());
        ASSERT_EQ(table.size(), parameterTable().size());
        for (const auto &row : table)
        {
            const std::string type = row["type"], name = row["name"];
            if (type == "number" || type == "count")
                EXPECT_LE(row["least"].get<double>(), row["most"].get<double>()) << name;
            else if (type == "name")
                EXPECT_NE(std::find(row["names"].begin(), row["names"].end(), row["value"]), row["names"].end());
            else
                EXPECT_TRUE(row["value"].is_boolean()) << name;
            // Each takes its own default.
            const std::string value = row["value"].is_string() ? row["value"].get<std::string>() : row["value"].dump();
            EXPECT_TRUE(playground_set_parameter(name.c_str(), value.c_str())) << playground_message();
        }
        const auto cars = nlohmann::json::parse(playground_vehicles());
        EXPECT_EQ(cars.size(), vehicleNames().size());
        EXPECT_EQ(cars[0]["wheelbase"].get<double>(), vehicleByName(cars[0]["name"]).wheelbase);
    }

    TEST_F(PlaygroundTest, ParametersChangeThePlan)
    {
        ASSERT_TRUE(setScene(bundled("perpendicular")));
        ASSERT_TRUE(playground_set_parameter("parameter_set", "paper_improved_astar"));
        ASSERT_TRUE(playground_plan(10.0, 0.0)) << playground_message();
        EXPECT_EQ(output(PLAYGROUND_SUMMARY)[13], 1.0) << "a grid model plans for a disc";
        EXPECT_NE(output(PLAYGROUND_SUMMARY)[16], 0.0) << "a car cannot drive it";
        playground_reset_parameters();
        ASSERT_TRUE(playground_plan(10.0, 0.0));
        EXPECT_EQ(output(PLAYGROUND_SUMMARY)[13], 0.0);
    }

    TEST_F(PlaygroundTest, SaysWhatIsWrong)
    {
        const auto refused = [](bool done, const std::string &words)
        {
            EXPECT_FALSE(done);
            const std::string message = playground_message();
            EXPECT_NE(message.find(words), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos);
        };
        const std::vector<double> good = numbersOf(bundled("parallel"));
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const auto changed = [&good](std::size_t at, double value)
        {
            std::vector<double> numbers = good;
            numbers[at] = value;
            return numbers;
        };
        refused(setScene(std::vector<double>()), "the scene ends after 0 numbers");
        refused(playground_plan(1.0, 0.0), "there is no scene");
        refused(playground_trace(1.0, 1.0), "there is no scene");
        refused(playground_trajectory(1.0), "there is no plan");
        refused(setScene(std::vector<double>(good.begin(), good.end() - 1)), "the scene ends after");
        refused(setScene(changed(0, nan)), "wheelbase");
        refused(setScene(changed(9, nan)), "start: x is nan");
        refused(setScene(changed(13, 7.0)), "must be a whole number from 0 to 2");
        Scenario wrong = bundled("parallel");
        wrong.vehicle.outline = {{0.0, 0.0}, {0.0, 1.0}, {3.0, 0.0}};
        refused(setScene(numbersOf(wrong)), "outline is clockwise");
        std::vector<double> longer = good;
        longer.push_back(1.0);
        refused(setScene(longer), "are required");
        ASSERT_TRUE(setScene(good)) << playground_message();
        EXPECT_STREQ(playground_message(), "");
        refused(playground_plan(-1.0, 0.0), "time_limit");
        refused(playground_set_parameter("gear_change_penalt", "1"), "did you mean 'gear_change_penalty'");
        refused(playground_set_parameter("gear_change_penalty", "much"),
                "gear_change_penalty must be between 0 and 100");
        refused(playground_set_parameter("heading_bins", "7.5"), "heading_bins must be between 8 and 1440");
        refused(playground_set_parameter("detours", "1"), "detours must be true, false");
        refused(playground_set_parameter("motion_model", "bike"), "'bike'");
        EXPECT_EQ(playground_output(-1), nullptr);
        EXPECT_EQ(playground_output_size(99), 0u);
    }

    TEST_F(PlaygroundTest, KnowsWhereTheCarMayStand)
    {
        const Scenario scenario = bundled("parallel");
        ASSERT_TRUE(setScene(scenario));
        const Pose start = scenario.toWorld(scenario.start);
        EXPECT_TRUE(playground_is_free(start.x, start.y, start.yaw));
        EXPECT_FALSE(playground_is_free(start.x + 1e4, start.y, start.yaw));
    }

    TEST_F(PlaygroundTest, PlansByTheTextbook)
    {
        const Scenario scenario = bundled("perpendicular");
        ASSERT_TRUE(setScene(scenario));
        ASSERT_TRUE(playground_plan_by_textbook(60.0)) << playground_message();
        const std::vector<double> summary = output(PLAYGROUND_SUMMARY), path = output(PLAYGROUND_PATH);
        ASSERT_EQ(summary[0], 0.0) << playground_message();
        EXPECT_EQ(summary[16], 0.0) << "a car drives it";
        EXPECT_GT(summary[3], 0.0) << "clearance";
        const Pose goal = scenario.toWorld(scenario.goals.at(static_cast<std::size_t>(summary[12])));
        EXPECT_NEAR(path[path.size() - 7], goal.x, 1e-6);
        EXPECT_NEAR(path[path.size() - 6], goal.y, 1e-6);
        ASSERT_TRUE(playground_trace(1.0, 1.0)) << playground_message();
        const std::vector<double> tree = output(PLAYGROUND_START_TREE), steps = output(PLAYGROUND_STEPS);
        EXPECT_GT(tree.size(), 9u * 10u);
        EXPECT_EQ(output(PLAYGROUND_GOAL_TREE).size(), 0u);
        EXPECT_EQ(steps[steps.size() - 4], summary[6]) << "all expansions";
        ASSERT_TRUE(playground_trajectory(10.0)) << playground_message();
        EXPECT_GT(output(PLAYGROUND_TRAJECTORY).size(), 80u);
        // A start in an obstacle is reported as such.
        std::vector<double> blocked = numbersOf(scenario);
        const Polygon &obstacle = scenario.polygons.front();
        blocked[9] = obstacle.front().x() + scenario.worldOffset.x();
        blocked[10] = obstacle.front().y() + scenario.worldOffset.y();
        ASSERT_TRUE(setScene(blocked)) << playground_message();
        ASSERT_TRUE(playground_plan_by_textbook(1.0));
        EXPECT_EQ(output(PLAYGROUND_SUMMARY)[0], 4.0);
        EXPECT_NE(std::string(playground_message()).find("start"), std::string::npos);
    }

    TEST_F(PlaygroundTest, SamplesTheDistanceField)
    {
        const Scenario scenario = bundled("parallel");
        ASSERT_TRUE(setScene(scenario));
        ASSERT_TRUE(playground_field(100.0)) << playground_message();
        const std::vector<double> field = output(PLAYGROUND_FIELD);
        const auto columns = static_cast<std::size_t>(field[0]), rows = static_cast<std::size_t>(field[1]);
        ASSERT_EQ(field.size(), 5u + columns * rows);
        EXPECT_LE(std::max(columns, rows), 101u);
        const Eigen::Vector2d corner = scenario.polygons.front().front() + scenario.worldOffset;
        const auto at = [&](double x, double y)
        {
            const auto column = static_cast<std::size_t>(std::lround((x - field[3]) / field[2]));
            const auto row = static_cast<std::size_t>(std::lround((y - field[4]) / field[2]));
            return field[5 + row * columns + column];
        };
        const Pose start = scenario.toWorld(scenario.start);
        EXPECT_LT(at(corner.x(), corner.y()), 2.0 * field[2]);
        EXPECT_GT(at(start.x, start.y), 0.5);
    }
}  // namespace
