#include "parking_geometry/curves/Clothoid.h"

#include "tests/parking_geometry/manoeuvres/RandomParking.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::RandomParking;

namespace
{
    ClothoidSegment randomSegment(RandomParking &random)
    {
        return {random.uniform(-0.4, 0.4), random.uniform(-1.0, 1.0), random.uniform(-3.0, 3.0)};
    }

    double gap(const Pose &a, const Pose &b)
    {
        return std::hypot(a.x - b.x, a.y - b.y);
    }
}  // namespace

TEST(Clothoid, IsTheLimitOfManySmallArcs)
{
    RandomParking random(1);
    for (int i = 0; i < 200; ++i)
    {
        const ClothoidSegment segment = randomSegment(random);
        const Pose start = random.pose(5.0);
        Pose pose = start;
        constexpr int ARCS = 4000;
        const double length = segment.length / ARCS;
        for (int k = 0; k < ARCS; ++k)
            pose = advance(pose, segment.curvature + segment.sharpness * std::abs(length) * (k + 0.5), length);
        const Pose exact = advance(start, segment, std::abs(segment.length));
        EXPECT_LT(gap(pose, exact), 1e-6);
        EXPECT_NEAR(pose.yaw, exact.yaw, 1e-9);
    }
}

TEST(Clothoid, WithoutSharpnessIsAnArc)
{
    RandomParking random(2);
    for (int i = 0; i < 10000; ++i)
    {
        const Pose start = random.pose(5.0);
        const double curvature = random.uniform(-0.5, 0.5), length = random.uniform(-9.0, 9.0);
        const Pose arc = advance(start, curvature, length);
        ASSERT_LT(gap(advance(start, ClothoidSegment{curvature, 0.0, length}, std::abs(length)), arc), 1e-12);
        // Hardly any sharpness takes the other branch, and must agree.
        ASSERT_LT(gap(advance(start, ClothoidSegment{curvature, 1e-14, length}, std::abs(length)), arc), 1e-10);
    }
}

TEST(Clothoid, DrivenBackEndsWhereItBegan)
{
    RandomParking random(3);
    for (int i = 0; i < 10000; ++i)
    {
        const ClothoidSegment segment = randomSegment(random);
        const Pose start = random.pose(5.0), end = advance(start, segment, std::abs(segment.length));
        const ClothoidSegment back{segment.endCurvature(), -segment.sharpness, -segment.length};
        const Pose again = advance(end, back, std::abs(back.length));
        ASSERT_LT(gap(start, again), 1e-11);
        ASSERT_NEAR(start.yaw, again.yaw, 1e-12);
        ASSERT_NEAR(back.endCurvature(), segment.curvature, 1e-12);
    }
}

TEST(Clothoid, SamplesLieOnThePathAtMostAStepApart)
{
    RandomParking random(4);
    for (int i = 0; i < 300; ++i)
    {
        ClothoidPath path{random.pose(5.0), {}};
        const double direction = random.coin() ? 1.0 : -1.0;
        double curvature = random.uniform(-0.3, 0.3);
        for (int k = 0; k < 5; ++k)
        {
            path.pieces.push_back({curvature, random.uniform(-0.4, 0.4), direction * random.uniform(0.01, 1.5)});
            curvature = path.pieces.back().endCurvature();
        }
        const double step = random.uniform(0.03, 0.5);
        for (const SampledPath &states : {path.sample(step), path.sampleEvenly(step)})
        {
            EXPECT_EQ(gap(states.front().pose, path.start), 0.0);
            EXPECT_LT(gap(states.back().pose, path.end()), 1e-11);
            EXPECT_NEAR(states.back().arcLength, path.length(), 1e-11);
            EXPECT_NEAR(states.back().curvature, curvature, 1e-11);
            for (std::size_t k = 1; k < states.size(); ++k)
            {
                ASSERT_LE(states[k].arcLength - states[k - 1].arcLength, step * (1.0 + 1e-9));
                ASSERT_GT(states[k].arcLength, states[k - 1].arcLength);
                ASSERT_EQ(states[k].direction, direction);
            }
        }
        // Within a piece the heading changes by the mean curvature exactly.
        const SampledPath states = path.sample(step);
        for (std::size_t k = 1; k < states.size(); ++k)
            ASSERT_NEAR(wrapAngle(states[k].pose.yaw - states[k - 1].pose.yaw),
                        direction * 0.5 * (states[k].curvature + states[k - 1].curvature) *
                            (states[k].arcLength - states[k - 1].arcLength),
                        1e-11);
        const SampledPath even = path.sampleEvenly(step);
        EXPECT_EQ(even.size(), static_cast<std::size_t>(std::ceil(path.length() / step)) + 1);
        for (const PathState &state : even)
        {
            Pose pose = path.start;
            double left = state.arcLength;
            for (const ClothoidSegment &segment : path.pieces)
            {
                const double driven = std::min(left, std::abs(segment.length));
                pose = advance(pose, segment, driven);
                left -= driven;
            }
            ASSERT_LT(gap(pose, state.pose), 1e-11);
        }
    }
}

TEST(Clothoid, APathWithoutPiecesIsItsStart)
{
    const ClothoidPath path{{1.0, 2.0, 0.5}, {}};
    EXPECT_EQ(path.length(), 0.0);
    ASSERT_EQ(path.sample(0.1).size(), 1u);
    ASSERT_EQ(path.sampleEvenly(0.1).size(), 1u);
    EXPECT_EQ(path.sampleEvenly(0.1).front().pose.x, 1.0);
}
