#include "parking_geometry/MakeScenario.h"

#include "tests/parking_geometry/ExpectError.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;

    Scenario somePlace(double x, double y)
    {
        Scenario scenario;
        scenario.start = {x, y, 7.0};
        scenario.goals = {{x + 10.0, y, 0.5}};
        scenario.polygons = {{{x + 3.0, y + 4.0}, {x + 5.0, y + 4.0}, {x + 5.0, y + 6.0}}};
        return scenario;
    }

    TEST(MakeScenario, BecomesLocalWhereverItLies)
    {
        for (const double far : {0.0, 1000.0, -4e9})
        {
            const Scenario scenario = makeScenario(somePlace(far, -far), "here");
            EXPECT_EQ(scenario.start.x, 0.0);
            EXPECT_EQ(scenario.start.y, 0.0);
            EXPECT_NEAR(scenario.start.yaw, 7.0 - 2.0 * PI, 1e-12);
            EXPECT_NEAR(scenario.goals.front().x, 10.0, 1e-6);
            EXPECT_NEAR(scenario.polygons.front().front().y(), 4.0, 1e-6);
            EXPECT_NEAR(scenario.toWorld(scenario.goals.front()).x, far + 10.0, 1e-6);
            EXPECT_NEAR(scenario.bounds.max.x(), 10.0 + POLYGON_WORLD_MARGIN, 1e-6);
        }
    }

    TEST(MakeScenario, GoalsInASlotAreExactWhereverItLies)
    {
        const auto goals = [](double far)
        {
            Scenario scenario = somePlace(far, -far);
            scenario.goals.clear();
            scenario.slot = ParkingSlot();
            scenario.slot->pose = {far + 5.5, -far - 3.25, 0.3};
            scenario.slot->entry = SlotEntry::Either;
            return makeScenario(scenario, "here").goals;
        };
        const std::vector<Pose> here = goals(0.0);
        for (const double far : {4e9, -5.5e9, MAX_COORDINATE})
        {
            const std::vector<Pose> there = goals(far);
            ASSERT_EQ(there.size(), 2u);
            for (std::size_t i = 0; i < 2; ++i)
            {
                EXPECT_EQ(there[i].x, here[i].x) << far;
                EXPECT_EQ(there[i].y, here[i].y) << far;
                EXPECT_EQ(there[i].yaw, here[i].yaw) << far;
            }
        }
    }

    TEST(MakeScenario, NamesWhatIsWrong)
    {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const auto expect = [](const auto &change, const std::string &words)
        {
            Scenario scenario = somePlace(0.0, 0.0);
            change(scenario);
            expectError([&] { makeScenario(scenario, "here"); }, {words});
        };
        expect([nan](Scenario &s) { s.start.yaw = nan; }, "here: start: yaw is nan");
        expect([nan](Scenario &s) { s.goals.front().x = nan; }, "here: goal: x is nan");
        expect([](Scenario &s) { s.goals.clear(); }, "neither goal nor slot");
        expect([](Scenario &s) { s.slot = ParkingSlot(); }, "both goal and slot");
        expect([](Scenario &s) { s.grid = OccupancyGrid(10, 10, 1.0); }, "both a map and polygons");
        expect([](Scenario &s) { s.goals.front().x = 2e5; }, "the goal lies 200000 m from the start");
        expect(
            [](Scenario &s)
            {
                s.polygons.clear();
                s.grid = OccupancyGrid(10, 10, 1.0);
                s.goals.front().x = 2e5;
            },
            "the goal lies 200000 m from the start");
        // Where doubles are too far apart; just before that the same world is understood.
        const auto move = [](Scenario &s, double x)
        {
            s = somePlace(x, 0.0);
        };
        const double beyond = std::nextafter(MAX_COORDINATE, 2e10);
        for (const double sign : {-1.0, 1.0})
        {
            expect([&](Scenario &s) { move(s, sign * beyond); }, "here: the start lies at ");
            expect([&](Scenario &s) { move(s, sign * 5e12); },
                   std::string(sign < 0.0 ? "at -" : "at ") +
                       "5000000000000, 0; coordinates of at most 10000000000 m are supported");
            Scenario last;
            move(last, sign * MAX_COORDINATE);
            EXPECT_EQ(makeScenario(last, "here").worldOffset.x(), sign * MAX_COORDINATE);
        }
        expect([](Scenario &s) { s.polygons.front().clear(); }, "polygon 1 has no corners");
        expect([nan](Scenario &s) { s.polygons.front()[1].y() = nan; }, "polygon 1: corner 2");
        expect([](Scenario &s) { s.polygons.push_back({{0, 5}, {1, 6}, {1, 5}, {0, 6}}); }, "polygon 2 crosses itself");
        expect([](Scenario &s) { s.vehicle.width = -1.0; }, "width");
    }
}  // namespace
