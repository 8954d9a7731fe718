#include "parking_geometry/curves/GearSegments.h"

#include "tests/parking_geometry/manoeuvres/RandomParking.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::RandomParking;

namespace
{
    double gap(const Pose &a, const Pose &b)
    {
        return std::hypot(a.x - b.x, a.y - b.y) + std::abs(wrapAngle(a.yaw - b.yaw));
    }

    Pose drive(const GearSegment &gear)
    {
        Pose pose = gear.start;
        for (const Arc &arc : gear.arcs)
            pose = advance(pose, arc.curvature, gear.direction * arc.length);
        return pose;
    }
}  // namespace

TEST(GearSegments, StretchesFollowEachOther)
{
    RandomParking random(71);
    for (int i = 0; i < 1000; ++i)
    {
        const Path path = random.plannerPath(random.vehicle(), 1.0);
        const std::vector<GearSegment> gears = gearSegments(path), sampled = gearSegments(path.sample(0.1));
        ASSERT_EQ(gears.size(), path.cusps() + 1);
        ASSERT_EQ(sampled.size(), gears.size());
        EXPECT_EQ(gap(gears.front().start, path.start), 0.0);
        EXPECT_LT(gap(gears.back().end, path.end()), 1e-12);
        double length = 0.0;
        for (std::size_t k = 0; k < gears.size(); ++k)
        {
            length += gears[k].length();
            EXPECT_LT(gap(drive(gears[k]), gears[k].end), 1e-12);
            EXPECT_FALSE(gears[k].movingStart || gears[k].movingEnd);
            if (k > 0)
            {
                EXPECT_EQ(gap(gears[k].start, gears[k - 1].end), 0.0);
                EXPECT_EQ(gears[k].direction, -gears[k - 1].direction);
            }
            for (std::size_t a = 0; a < gears[k].arcs.size(); ++a)
            {
                EXPECT_GT(gears[k].arcs[a].length, 0.0);
                if (a > 0)
                {
                    EXPECT_NE(gears[k].arcs[a].curvature, gears[k].arcs[a - 1].curvature);
                }
            }
            ASSERT_EQ(sampled[k].arcs.size(), gears[k].arcs.size());
            EXPECT_LT(gap(sampled[k].end, gears[k].end), 1e-9);
            for (std::size_t a = 0; a < gears[k].arcs.size(); ++a)
            {
                EXPECT_NEAR(sampled[k].arcs[a].curvature, gears[k].arcs[a].curvature, 1e-9);
                EXPECT_NEAR(sampled[k].arcs[a].length, gears[k].arcs[a].length, 1e-9);
            }
        }
        EXPECT_NEAR(length, path.length(), 1e-9);
    }
    EXPECT_TRUE(gearSegments(Path()).empty());
    EXPECT_TRUE(gearSegments(SampledPath()).empty());
    EXPECT_TRUE(gearSegments(SampledPath(3)).empty()) << "states that do not move";
}

TEST(GearSegments, PartsAndCutsKeepPosesAndLengths)
{
    RandomParking random(72);
    std::size_t cuts = 0;
    for (int i = 0; i < 1000; ++i)
    {
        const Vehicle car = random.vehicle();
        const double full = 1.0 / car.minTurningRadius();
        for (const GearSegment &gear : gearSegments(random.plannerPath(car, 1.0)))
        {
            const std::vector<GearSegment> pieces = gear.cutAtLongArcs(1.5, 0.99 * full);
            cuts += pieces.size() - 1;
            EXPECT_EQ(gap(pieces.front().start, gear.start), 0.0);
            EXPECT_EQ(gap(pieces.back().end, gear.end), 0.0);
            EXPECT_FALSE(pieces.front().movingStart || pieces.back().movingEnd);
            double length = 0.0;
            for (std::size_t k = 0; k < pieces.size(); ++k)
            {
                length += pieces[k].length();
                EXPECT_LT(gap(drive(pieces[k]), pieces[k].end), 1e-9);
                EXPECT_EQ(pieces[k].direction, gear.direction);
                if (k == 0)
                    continue;
                // Both sides of a cut are halves of one arc, long enough and not at full lock.
                EXPECT_TRUE(pieces[k].movingStart && pieces[k - 1].movingEnd);
                EXPECT_EQ(gap(pieces[k].start, pieces[k - 1].end), 0.0);
                EXPECT_EQ(pieces[k].arcs.front().curvature, pieces[k - 1].arcs.back().curvature);
                EXPECT_GE(pieces[k].arcs.front().length, 0.75);
                EXPECT_LT(std::abs(pieces[k].arcs.front().curvature), 0.99 * full);
                EXPECT_GE(pieces[k].arcs.size(), 2u);
            }
            EXPECT_NEAR(length, gear.length(), 1e-9);

            const std::size_t arcs = gear.arcs.size(), first = arcs / 3, last = arcs - arcs / 4;
            const GearSegment part = gear.part(first, last);
            ASSERT_EQ(part.arcs.size(), last - first);
            EXPECT_LT(gap(drive(part), part.end), 1e-9);
            EXPECT_LT(gap(gear.part(0, first).end, first > 0 ? part.start : gear.start), 1e-9);
            EXPECT_EQ(gap(gear.part(first, arcs).end, gear.end), 0.0);
        }
    }
    EXPECT_GT(cuts, 100u);
}
