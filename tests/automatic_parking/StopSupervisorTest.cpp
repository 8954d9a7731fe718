#include "automatic_parking/StopSupervisor.h"

#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;

    TEST(StopSupervisorTest, allowsWhatEndsFreeAndKeepsItsGap)
    {
        Scenario scenario = openGround();
        const Vehicle &car = scenario.vehicle;
        const double bumper = car.wheelbase + car.frontOverhang;
        scenario.polygons = {box(10.0, -1.0, 10.5, 1.0)};
        const ParkingWorld world(scenario);
        const Pose start{scenario.start.x, 0.0, 0.0};
        const auto to = [&](double left)
        {
            return Path{start, {{0.0, 10.0 - left - bumper - start.x}}};
        };
        const StopSupervisor wide(world, 0.1), narrow(world, 0.0);
        EXPECT_TRUE(wide.allows(to(0.12)));
        EXPECT_FALSE(wide.allows(to(0.08)));
        EXPECT_TRUE(narrow.allows(to(0.08)));
        EXPECT_FALSE(narrow.allows(to(-0.01)));
        // A car that stands within the gap may go as long as it touches nothing, and away in any case.
        const Pose near = to(0.05).end(), touching = to(-0.1).end();
        EXPECT_TRUE(wide.allows({near, {{0.0, 0.03}}}));
        EXPECT_FALSE(wide.allows({near, {{0.0, 0.06}}}));
        EXPECT_TRUE(wide.allows({near, {}}));
        EXPECT_TRUE(wide.allows({touching, {{0.0, -0.5}}}));
    }
}  // namespace
