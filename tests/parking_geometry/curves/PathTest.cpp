// Laws of Path over random pieces: arcs, clothoids, turns on the spot, and what does nothing.

#include "parking_geometry/curves/Path.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/support/PoseGap.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::gap;
using parking_test::RandomParking;

namespace
{
    PathPiece clothoid(RandomParking &random)
    {
        return {random.between(-0.4, 0.4), random.between(-3.0, 3.0), random.between(-1.0, 1.0)};
    }

    PathPiece anyPiece(RandomParking &random)
    {
        switch (random.below(8))
        {
            case 0:
                return PathPiece::turnOnTheSpot(random.between(-PI, PI));
            case 1:
                return {random.between(-0.4, 0.4), 0.0};
            case 2:
                return {0.0, random.between(-3.0, 3.0)};
            case 3:
            case 4:
                return {random.between(-0.4, 0.4), random.between(-3.0, 3.0)};
            default:
                return clothoid(random);
        }
    }

    Path anyPath(RandomParking &random)
    {
        Path path{random.pose(20.0), {}};
        for (int count = random.below(12); count > 0; --count)
            path.pieces.push_back(anyPiece(random));
        return path;
    }

    bool isSame(const PathPiece &a, const PathPiece &b)
    {
        return a.length == b.length && a.turn == b.turn && a.sharpness == b.sharpness &&
               std::abs(a.curvature - b.curvature) < 1e-12;
    }
}  // namespace

TEST(PathPiece, WithSharpnessIsTheLimitOfManySmallArcs)
{
    RandomParking random(1);
    for (int i = 0; i < 200; ++i)
    {
        const PathPiece piece = clothoid(random);
        const Pose start = random.pose(5.0);
        Pose pose = start;
        constexpr int ARCS = 4000;
        const double length = piece.length / ARCS;
        for (int k = 0; k < ARCS; ++k)
            pose = advance(pose, piece.curvatureAt(std::abs(length) * (k + 0.5)), length);
        const Pose exact = advance(start, piece);
        EXPECT_LT(positionDistance(pose, exact), 1e-6);
        EXPECT_NEAR(pose.yaw, exact.yaw, 1e-9);
    }
}

TEST(PathPiece, DrivenBackEndsWhereItBegan)
{
    RandomParking random(3);
    for (int i = 0; i < 10000; ++i)
    {
        const PathPiece piece = anyPiece(random), back = piece.reversed();
        const Pose start = random.pose(5.0), again = advance(advance(start, piece), back);
        ASSERT_LT(positionDistance(start, again), 1e-11);
        ASSERT_NEAR(start.yaw, again.yaw, 1e-12);
        ASSERT_EQ(back.direction(), -piece.direction());
        ASSERT_EQ(back.driven(), piece.driven());
        ASSERT_NEAR(back.endCurvature(), piece.curvature, 1e-12);
        ASSERT_TRUE(isSame(back.reversed(), piece));
    }
}

TEST(Path, SamplesLieOnThePathAtMostAStepApart)
{
    RandomParking random(5);
    for (int i = 0; i < 2000; ++i)
    {
        const Path path = anyPath(random);
        const double step = random.between(0.03, 0.5);
        const SampledPath states = path.sample(step);
        EXPECT_LT(gap(states.front().pose, path.start), 1e-15);
        EXPECT_LT(gap(states.back().pose, path.end()), 1e-11);
        EXPECT_NEAR(pathLength(states), path.length(), 1e-11);
        // Every state lies where the pieces lead, and every end of a piece is among the states.
        Pose pose = path.start;
        double before = 0.0;
        std::size_t at = 0;
        for (const PathPiece &piece : path.pieces)
        {
            if (piece.length == 0.0 && piece.turn == 0.0)
                continue;
            const double end = before + piece.driven();
            for (++at; at < states.size(); ++at)
            {
                const double driven = states[at].arcLength - before;
                ASSERT_LE(states[at].arcLength - states[at - 1].arcLength, step * (1.0 + 1e-9));
                ASSERT_LT(gap(states[at].pose, advance(pose, piece, std::min(driven, piece.driven()))), 1e-10);
                if (piece.turn == 0.0)
                {
                    ASSERT_EQ(states[at].direction, piece.direction());
                    ASSERT_NEAR(states[at].curvature, piece.curvatureAt(driven), 1e-9);
                    // The heading changes by the mean curvature exactly.
                    const double from = states[at - 1].arcLength - before;
                    const double mean = 0.5 * (piece.curvatureAt(from) + piece.curvatureAt(driven));
                    ASSERT_NEAR(wrapAngle(states[at].pose.yaw - states[at - 1].pose.yaw),
                                wrapAngle(piece.direction() * mean * (driven - from)), 1e-9);
                }
                if (piece.turn != 0.0 || states[at].arcLength >= end - 1e-9)
                    break;
            }
            ASSERT_LT(at, states.size());
            pose = advance(pose, piece);
            before = end;
        }
        EXPECT_EQ(at, states.size() - 1);
    }
}

TEST(Path, StretchesCoverThePathAndAlternate)
{
    RandomParking random(7);
    std::size_t turns = 0;
    for (int i = 0; i < 2000; ++i)
    {
        const Path path = anyPath(random);
        const std::vector<Stretch> stretches = path.stretches();
        double length = 0.0;
        for (std::size_t k = 0; k < stretches.size(); ++k)
        {
            const Stretch &stretch = stretches[k];
            ASSERT_LT(stretch.first, stretch.last);
            if (k > 0)
            {
                ASSERT_EQ(stretch.first, stretches[k - 1].last);
                ASSERT_EQ(stretch.direction, -stretches[k - 1].direction);
                // A turn at a cusp comes before what is driven after it.
                ASSERT_NE(path.pieces[stretch.first - 1].direction(), 0);
            }
            for (std::size_t p = stretch.first; p < stretch.last; ++p)
            {
                ASSERT_NE(path.pieces[p].direction(), -stretch.direction);
                turns += path.pieces[p].turn != 0.0;
            }
            ASSERT_NEAR(stretch.begin, length, 1e-12);
            length += path.part(stretch.first, stretch.last).length();
        }
        EXPECT_NEAR(length, path.length(), 1e-12);
        if (stretches.empty())
        {
            EXPECT_EQ(path.length(), 0.0);
            continue;
        }
        EXPECT_EQ(stretches.front().first, 0u);
        EXPECT_EQ(stretches.back().last, path.pieces.size());
        EXPECT_EQ(path.cusps(), stretches.size() - 1);
    }
    EXPECT_GT(turns, 1000u);
}

TEST(Path, ATurnOnTheSpotIsNoCuspAndNoWay)
{
    const Path path{{}, {{0.0, 1.0}, PathPiece::turnOnTheSpot(0.5 * PI), {0.0, 1.0}, {0.0, -3.0}}};
    EXPECT_EQ(path.cusps(), 1u);
    EXPECT_EQ(path.length(), 5.0);
    EXPECT_LT(gap(path.end(), {1.0, -2.0, 0.5 * PI}), 1e-12);
    const SampledPath states = path.sample(10.0);
    ASSERT_EQ(states.size(), 5u);
    EXPECT_EQ(states[2].arcLength, states[1].arcLength);
    EXPECT_LT(gap(states[2].pose, {1.0, 0.0, 0.5 * PI}), 1e-12);
    const Path onlyTurn{{}, {PathPiece::turnOnTheSpot(1.0)}};
    EXPECT_TRUE(onlyTurn.stretches().empty());
    EXPECT_EQ(onlyTurn.cusps(), 0u);
    EXPECT_EQ(onlyTurn.sample(0.1).size(), 2u);
}

TEST(Path, TheRestEndsWhereThePathDoes)
{
    RandomParking random(23);
    for (int i = 0; i < 300; ++i)
    {
        const Path path = anyPath(random);
        const double length = path.length(), driven = random.between(0.0, length);
        const Path rest = path.rest(driven);
        EXPECT_NEAR(rest.length(), length - driven, 1e-9);
        EXPECT_LT(gap(rest.end(), path.end()), 1e-9);
        EXPECT_LT(gap(path.at(driven), rest.start), 1e-12);
        // It begins where the path is by then: a rest of the rest is the rest of both.
        EXPECT_LT(gap(path.rest(0.5 * driven).rest(0.5 * driven).start, rest.start), 1e-9);
    }
    // A turn where the rest begins is still to be made.
    const Path corner{{}, {{0.0, 2.0}, PathPiece::turnOnTheSpot(1.0), {0.0, 1.0}}};
    EXPECT_EQ(corner.rest(2.0).pieces.size(), 2U);
    EXPECT_LT(gap(corner.at(2.0), {2.0, 0.0, 0.0}), 1e-12);
    EXPECT_LT(gap(corner.at(2.5), {2.0 + 0.5 * std::cos(1.0), 0.5 * std::sin(1.0), 1.0}), 1e-12);
    EXPECT_TRUE(corner.rest(3.0).pieces.empty());
}

TEST(Path, CutsWhereAPieceEndsLeaveNoSlivers)
{
    RandomParking random(31);
    for (int i = 0; i < 300; ++i)
    {
        const Path path = anyPath(random);
        double driven = 0.0;
        for (const PathPiece &whole : path.pieces)
        {
            driven += whole.driven();
            for (const double off : {-5e-10, -1e-14, 0.0, 1e-14, 5e-10})
            {
                const Path rest = path.rest(driven + off);
                EXPECT_LT(gap(path.at(driven), rest.start), 1e-12);
                EXPECT_NEAR(rest.length(), path.length() - driven, 1e-12);
                for (const PathPiece &piece : rest.pieces)
                    EXPECT_TRUE(piece.turn != 0.0 || piece.driven() > 1e-6) << piece.driven();
            }
            // What is longer than a hair is cut.
            if (driven > 0.0)
            {
                EXPECT_NEAR(path.rest(driven - 1e-8).length(), path.length() - driven + 1e-8, 1e-12);
            }
        }
    }
}

TEST(Path, AppendingMergesArcsAndDropsWhatDoesNothing)
{
    Path path;
    path.append({0.1, 1.0});
    path.append({0.1, 2.0});
    path.append({0.1, 0.0});
    ASSERT_EQ(path.pieces.size(), 1u);
    EXPECT_EQ(path.pieces[0].length, 3.0);
    path.append({0.1, -1.0});
    EXPECT_EQ(path.pieces.size(), 2u) << "the other direction";
    path.append({0.1, -1.0, 0.01});
    path.append({0.1, -1.0, 0.01});
    EXPECT_EQ(path.pieces.size(), 4u) << "clothoids";
    path.append(PathPiece::turnOnTheSpot(0.3));
    path.append({0.0, 1.0});
    EXPECT_EQ(path.pieces.size(), 6u);

    RandomParking random(9);
    for (int i = 0; i < 2000; ++i)
    {
        const Path whole = anyPath(random);
        Path appended{whole.start, {}}, extended{whole.start, {}};
        for (const PathPiece &piece : whole.pieces)
            appended.append(piece);
        extended.extend(whole.part(0, whole.pieces.size() / 2));
        extended.extend(whole.part(whole.pieces.size() / 2, whole.pieces.size()));
        for (const Path &each : {appended, extended})
        {
            EXPECT_LT(gap(each.end(), whole.end()), 1e-11);
            EXPECT_NEAR(each.length(), whole.length(), 1e-12);
            EXPECT_EQ(each.cusps(), whole.cusps());
            EXPECT_LE(each.pieces.size(), whole.pieces.size());
        }
    }
}
