// The generated problems have the room that HOPE publishes for their level.

#include "benchmarks/formats/HopeScenes.h"

#include "parking_geometry/referee/FreeSpace.h"
#include "tests/parking_geometry/ExpectError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace
{
    using namespace parking;

    constexpr double LENGTH = 4.69;

    /** Least clearance of the car at its goal from obstacles whose middle is on one side of the body's. */
    double gapOn(double side, const Scenario &scenario)
    {
        const Pose &goal = scenario.goals.front();
        const double middle = goal.x + scenario.vehicle.centreOffset() * std::cos(goal.yaw);
        double least = 100.0;
        for (const Polygon &polygon : scenario.polygons)
        {
            Eigen::Vector2d centre(0.0, 0.0);
            for (const Eigen::Vector2d &corner : polygon)
                centre += corner / static_cast<double>(polygon.size());
            // Neither the kerb nor what is across the aisle.
            const double up = scenario.worldOffset.y(), reach = polygon.front().y() + up;
            if (side * (centre.x() - middle) < 0.5 || centre.y() + up < 0.0 || centre.y() + up > 5.5 || reach > 7.0)
                continue;
            Scenario one = scenario;
            one.polygons = {polygon};
            one.bounds = {{-100.0, -100.0}, {100.0, 100.0}};
            least = std::min(least, FreeSpace(one).clearance(goal, 50.0));
        }
        return least;
    }

    TEST(HopeScenes, HaveTheRoomOfTheirLevel)
    {
        const std::map<std::string, std::pair<double, double>> along{{"normal", {0.25 * LENGTH, 0.25 * LENGTH + 0.5}},
                                                                     {"complex", {0.9, 0.25 * LENGTH}},
                                                                     {"extreme", {0.6, 0.9}}},
            across{{"normal", {0.85, 1.2}}, {"complex", {0.4, 0.85}}};
        std::size_t bays = 0, slots = 0;
        for (const auto &[level, room] : along)
            for (std::uint64_t seed = 1; seed <= 30; ++seed)
            {
                const Scenario scenario = hopeScene(level, seed);
                const bool parallel = std::abs(std::cos(scenario.goals.front().yaw)) > 0.7;
                ++(parallel ? slots : bays);
                ASSERT_TRUE(parallel || level != "extreme");
                const auto [least, most] = parallel ? room : across.at(level);
                const double gap = gapOn(-1.0, scenario) + gapOn(1.0, scenario);
                EXPECT_GE(gap, least - 1e-6) << scenario.name;
                EXPECT_LE(gap, most + 1e-6) << scenario.name;
                const FreeSpace space(scenario);
                EXPECT_TRUE(space.isFree(scenario.start)) << scenario.name;
                EXPECT_TRUE(space.isFree(scenario.goals.front())) << scenario.name;
            }
        EXPECT_GT(bays, 15U);
        EXPECT_GT(slots, 45U);
    }

    TEST(HopeScenes, LevelsHaveNames)
    {
        EXPECT_EQ(hopeLevels(), (std::vector<std::string>{"normal", "complex", "extreme", "dlp"}));
        parking_test::expectError([] { hopeScene("extrem", 1); }, {"extrem", "extreme"});
    }
}  // namespace
