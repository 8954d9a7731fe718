// Outlines found by where they are: distances and insides against going through all of them.

#include "parking_geometry/referee/Outlines.h"

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
    using namespace parking;
    using parking_test::Random;

    const Box BOUNDS{{-60.0, -40.0}, {60.0, 40.0}};

    /** Small and large ones, a ring of many corners round a yard among them. */
    std::vector<Polygon> polygons(std::uint64_t seed)
    {
        Random random(seed);
        std::vector<Polygon> result;
        for (int i = 0; i < 12; ++i)
            result.push_back(parking_test::star(random, random.between(-50.0, 50.0), random.between(-30.0, 30.0),
                                                random.between(0.05, i < 9 ? 4.0 : 25.0)));
        Polygon ring;
        for (int i = 0; i <= 90; ++i)
            ring.emplace_back(20.0 + 18.0 * std::cos(0.06 * i), 18.0 * std::sin(0.06 * i));
        for (int i = 90; i >= 0; --i)
            ring.emplace_back(20.0 + 17.0 * std::cos(0.06 * i), 17.0 * std::sin(0.06 * i));
        result.push_back(ring);
        return result;
    }

    TEST(Outlines, KnowWhatLiesInsideOfPolygonsOfAnySize)
    {
        for (std::uint64_t seed = 1; seed <= 10; ++seed)
        {
            const std::vector<Polygon> world = polygons(seed);
            Outlines outlines(BOUNDS);
            for (const Polygon &polygon : world)
                outlines.add(polygon);
            Random random(seed + 100);
            int inside = 0;
            for (int i = 0; i < 5000; ++i)
            {
                const Eigen::Vector2d point(random.between(-60.0, 60.0), random.between(-40.0, 40.0));
                bool expected = false;
                for (const Polygon &polygon : world)
                    expected = expected || contains(polygon, point);
                ASSERT_EQ(outlines.isInside(point), expected) << point.transpose();
                inside += expected ? 1 : 0;
            }
            EXPECT_GT(inside, 100);
            EXPECT_LT(inside, 4900);
        }
    }

    TEST(Outlines, DistancesAreThoseToAllEdges)
    {
        const Vehicle car = vehicleByName("tpcap");
        for (std::uint64_t seed = 1; seed <= 10; ++seed)
        {
            const std::vector<Polygon> world = polygons(seed);
            Outlines outlines(BOUNDS);
            for (const Polygon &polygon : world)
                outlines.add(polygon);
            // No bounds are near: only polygons count here.
            const parking_test::PolygonOracle oracle(world, {{-1e4, -1e4}, {1e4, 1e4}});
            Random random(seed + 200);
            int far = 0;
            for (int i = 0; i < 2000; ++i)
            {
                const Pose pose{random.between(-55.0, 55.0), random.between(-35.0, 35.0), random.between(-PI, PI)};
                const Rectangle body{{pose.x, pose.y},
                                     std::cos(pose.yaw),
                                     std::sin(pose.yaw),
                                     -car.rearOverhang,
                                     car.wheelbase + car.frontOverhang,
                                     0.5 * car.width};
                if (!oracle.isFree(pose, car) && outlines.isInside(body.middle()))
                    continue;  // the oracle's distance is 0 inside of an obstacle, that to the outline is not
                const double expected = oracle.clearance(pose, car);
                far += expected > 4.0 ? 1 : 0;
                ASSERT_NEAR(outlines.distance(body, INFINITY), expected, 1e-9);
                for (const double enough : {0.05, 0.7, 3.0, 10.0})
                {
                    const double found = outlines.distance(body, enough);
                    if (expected < enough)
                    {
                        ASSERT_NEAR(found, expected, 1e-9);
                    }
                    else
                    {
                        ASSERT_GE(found, enough);
                        ASSERT_LE(found, expected + 1e-9);
                    }
                }
            }
            EXPECT_GT(far, 20);
        }
    }

    TEST(Outlines, APointIsARectangleWithoutSize)
    {
        Outlines outlines(BOUNDS);
        outlines.add(Outlines::Edge{{3.0, -5.0}, {3.0, 4.0}});
        Rectangle point;
        EXPECT_NEAR(outlines.distance(point, INFINITY), 3.0, 1e-12);
        point.place = {0.0, 8.0};
        EXPECT_NEAR(outlines.distance(point, INFINITY), 5.0, 1e-12);
        EXPECT_EQ(Outlines(BOUNDS).distance(point, INFINITY), INFINITY);
    }
}  // namespace
