#include "parking_geometry/smoothing/StretchPart.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/support/PoseGap.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::gap;
using parking_test::RandomParking;

TEST(StretchPart, PartsAndCutsKeepPosesAndLengths)
{
    RandomParking random(72);
    std::size_t cuts = 0;
    for (int i = 0; i < 1000; ++i)
    {
        const Vehicle car = random.vehicle();
        const double full = 1.0 / car.minTurningRadius();
        const Path path = random.plannerPath(car, 1.0);
        for (const Stretch &stretch : path.stretches())
        {
            const StretchPart whole{path.part(stretch.first, stretch.last), false, false};
            const std::vector<StretchPart> parts = whole.cutAtLongArcs(1.5, 0.99 * full);
            cuts += parts.size() - 1;
            EXPECT_EQ(gap(parts.front().arcs.start, whole.arcs.start), 0.0);
            EXPECT_LT(gap(parts.back().arcs.end(), whole.arcs.end()), 1e-12);
            EXPECT_FALSE(parts.front().movingStart || parts.back().movingEnd);
            double length = 0.0;
            for (std::size_t k = 0; k < parts.size(); ++k)
            {
                length += parts[k].arcs.length();
                EXPECT_EQ(parts[k].direction(), stretch.direction);
                if (k == 0)
                    continue;
                // Both sides of a cut are halves of one arc, long enough and not at full lock.
                const PathPiece &before = parts[k - 1].arcs.pieces.back(), &after = parts[k].arcs.pieces.front();
                EXPECT_TRUE(parts[k].movingStart && parts[k - 1].movingEnd);
                EXPECT_LT(gap(parts[k].arcs.start, parts[k - 1].arcs.end()), 1e-12);
                EXPECT_EQ(after.curvature, before.curvature);
                EXPECT_GE(after.driven(), 0.75);
                EXPECT_LT(std::abs(after.curvature), 0.99 * full);
                EXPECT_GE(parts[k].arcs.pieces.size(), 2u);
            }
            EXPECT_NEAR(length, whole.arcs.length(), 1e-9);

            StretchPart moving = whole;
            moving.movingStart = moving.movingEnd = true;
            const std::size_t arcs = whole.arcs.pieces.size(), first = arcs / 3, last = arcs - arcs / 4;
            const StretchPart part = moving.part(first, last);
            ASSERT_EQ(part.arcs.pieces.size(), last - first);
            EXPECT_EQ(part.movingStart, first == 0);
            EXPECT_EQ(part.movingEnd, last == arcs);
        }
    }
    EXPECT_GT(cuts, 100u);
}
