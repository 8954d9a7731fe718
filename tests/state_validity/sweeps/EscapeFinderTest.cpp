// Depths of contacts against geometry by hand and the oracle; escapes must never deepen a contact and must end free.

#include "state_validity/sweeps/EscapeFinder.h"

#include "benchmarks/worlds/RandomWorlds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    constexpr double MAX_DEPTH = 0.05, PRECISION = 2e-6;

    const Box FIELD{{-20.0, -20.0}, {20.0, 20.0}};

    FootprintChecker among(const std::vector<Polygon> &walls, double margin = 0.0)
    {
        return FootprintChecker(ObstacleSet::fromPolygons(walls, FIELD), Vehicle(), margin);
    }

    /** A wall across the lane of a car at the origin, into which its front reaches \e depth metres. */
    Polygon wallAhead(double depth)
    {
        const Vehicle car;
        return rectangle(2.0, 10.0, {car.wheelbase + car.frontOverhang - depth + 1.0, 0.0, 0.0});
    }

    /** A wall along the left side of a car at the origin. */
    Polygon wallBeside(double depth, double length)
    {
        return rectangle(length, 2.0, {Vehicle().centreOffset(), 0.5 * Vehicle().width - depth + 1.0, 0.0});
    }
}  // namespace

TEST(EscapeFinder, MeasuresTheDepthOfAContact)
{
    for (const double depth : {1e-5, 0.01, 0.0499})
    {
        const FootprintChecker checker = among({wallAhead(depth)}), wider = among({wallAhead(depth - 0.03)}, 0.03);
        EXPECT_NEAR(EscapeFinder(checker).depth({}, MAX_DEPTH), depth, PRECISION);
        EXPECT_NEAR(EscapeFinder(wider).depth({}, MAX_DEPTH), depth, PRECISION) << "with a margin";
    }
    const FootprintChecker deep = among({wallAhead(0.0501)}), clear = among({wallAhead(-0.001)});
    EXPECT_EQ(EscapeFinder(deep).depth({}, MAX_DEPTH), HUGE_VAL);
    EXPECT_EQ(EscapeFinder(clear).depth({}, MAX_DEPTH), 0.0);
    EXPECT_EQ(EscapeFinder(clear).depth({std::nan(""), 0.0, 0.0}, MAX_DEPTH), HUGE_VAL);
    // A post of no size within the body, and a body wholly inside of an obstacle.
    const FootprintChecker post = among({{{1.0, 0.5 * Vehicle().width - 0.02}}}),
                           inside = among({rectangle(30.0, 30.0, {})});
    EXPECT_NEAR(EscapeFinder(post).depth({}, MAX_DEPTH), 0.02, PRECISION);
    EXPECT_EQ(EscapeFinder(inside).depth({}, MAX_DEPTH), HUGE_VAL);
    EXPECT_TRUE(EscapeFinder(inside).find({}, MAX_DEPTH, 5.0, false).empty());
}

TEST(EscapeFinder, BacksAwayFromAWallButNotThroughIt)
{
    const FootprintChecker checker = among({wallAhead(0.0255)});
    const std::vector<Escape> escapes = EscapeFinder(checker).find({}, MAX_DEPTH, 5.0, false);
    ASSERT_FALSE(escapes.empty());
    EXPECT_NEAR(escapes.front().arc.length, -0.03, 1e-12) << "the first step of a centimetre that ends free";
    for (const Escape &escape : escapes)
        EXPECT_LT(escape.arc.length, 0.0);
    EXPECT_TRUE(EscapeFinder(checker).find({}, MAX_DEPTH, 5.0, true).empty()) << "forwards there is only the wall";
    EXPECT_TRUE(EscapeFinder(checker).find({}, 0.0254, 5.0, false).empty()) << "deeper than allowed";
    EXPECT_TRUE(EscapeFinder(checker).find({-1.0, 0.0, 0.0}, MAX_DEPTH, 5.0, false).empty()) << "free";
}

TEST(EscapeFinder, LeavesAWallBesideTheCarOnlyPastItsEnd)
{
    // Turning away swings the other end of the car into the wall.
    const FootprintChecker endless = among({wallBeside(0.02, 30.0)}), ends = among({wallBeside(0.02, 3.0)});
    EXPECT_TRUE(EscapeFinder(endless).find({}, MAX_DEPTH, 5.0, false).empty());
    EXPECT_FALSE(EscapeFinder(ends).find({}, MAX_DEPTH, 5.0, false).empty());
    // Between two walls nothing helps.
    const FootprintChecker between =
        among({wallAhead(0.02), rectangle(2.0, 10.0, {-Vehicle().rearOverhang + 0.02 - 1.0, 0.0, 0.0})});
    EXPECT_TRUE(EscapeFinder(between).find({}, MAX_DEPTH, 5.0, false).empty());
}

TEST(EscapeFinder, NeverDeepensAContactInRandomWorlds)
{
    const Vehicle car;
    int contacts = 0, found = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        const World world = seed % 2 ? randomGridWorld(seed) : randomPolygonWorld(seed);
        const FootprintChecker checker(world.obstacles, car);
        const EscapeFinder finder(checker);
        Random random(seed);
        for (int i = 0; i < 600; ++i)
        {
            const Pose start = world.touching(random, car, 0.05);
            const double depth = finder.depth(start, MAX_DEPTH);
            if (depth == 0.0 || std::isinf(depth))
                continue;
            ++contacts;
            EXPECT_TRUE(world.oracle.isFree(start, car, -depth - PRECISION));
            EXPECT_FALSE(world.oracle.isFree(start, car, -depth + PRECISION));
            const std::vector<Escape> escapes = finder.find(start, MAX_DEPTH, 5.0, false);
            found += escapes.empty() ? 0 : 1;
            double length = 0.0;
            for (const Escape &escape : escapes)
            {
                EXPECT_GE(std::abs(escape.arc.length), length) << "shortest first";
                length = std::abs(escape.arc.length);
                EXPECT_EQ(escape.depth, depth);
                EXPECT_TRUE(world.oracle.isFree(escape.end(), car));
                double least = depth;
                for (int step = 0; step * 0.002 < length; ++step)
                {
                    const Pose pose =
                        advance(start, escape.arc.curvature, std::copysign(0.002 * step, escape.arc.length));
                    if (step % 5 == 0)
                        least = std::min(least, finder.depth(pose, MAX_DEPTH));
                    ASSERT_TRUE(world.oracle.isFree(pose, car, -least - EscapeFinder::DEPTH_TOLERANCE - PRECISION))
                        << world.name << ", " << step;
                }
            }
        }
    }
    EXPECT_GT(contacts, 300);
    EXPECT_GT(found, contacts / 4);
}
