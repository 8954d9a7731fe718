#include "parking_geometry/curves/PathArcs.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/support/PoseGap.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::gap;
using parking_test::RandomParking;

namespace
{
    /** Largest distance between the corners of a body that reaches \e reach metres ahead, at two poses. */
    double bodyGap(const Pose &a, const Pose &b, double reach)
    {
        double most = 0.0;
        for (const double ahead : {-reach, 0.0, reach})
        {
            const Pose p = compose(a, {ahead, 0.0, 0.0}), q = compose(b, {ahead, 0.0, 0.0});
            most = std::max(most, positionDistance(p, q));
        }
        return most;
    }
}  // namespace

TEST(PathArcs, KeepToTheClothoidWithinTheDeviation)
{
    RandomParking random(1);
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i)
    {
        const PathPiece piece(random.between(-0.4, 0.4), random.between(-3.0, 3.0), random.between(-1.0, 1.0));
        const Path path{random.pose(20.0), {piece}};
        const double reach = random.between(0.5, 6.0), deviation = std::pow(10.0, random.between(-5.0, -2.0));
        double driven = 0.0;
        visitArcs(path, reach, deviation,
                  [&](const Pose &from, const PathPiece &arc)
                  {
                      EXPECT_EQ(arc.sharpness, 0.0);
                      EXPECT_EQ(arc.direction(), piece.direction());
                      EXPECT_LT(gap(from, advance(path.start, piece, driven)), 1e-11);
                      for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
                      {
                          const double off = bodyGap(advance(from, arc, share * arc.driven()),
                                                     advance(path.start, piece, driven + share * arc.driven()), reach);
                          EXPECT_LE(off, deviation);
                          worst = std::max(worst, off / deviation);
                      }
                      driven += arc.driven();
                      EXPECT_NEAR(advance(from, arc).yaw, advance(path.start, piece, driven).yaw, 1e-11);
                      return true;
                  });
        ASSERT_NEAR(driven, piece.driven(), 1e-11);
    }
    EXPECT_GT(worst, 0.5) << "the bound is not wasteful";
}

TEST(PathArcs, OtherPiecesComeAsTheyAre)
{
    const Path path{{1.0, 2.0, 0.3}, {{0.1, 2.0}, PathPiece::turnOnTheSpot(0.4), {0.0, -1.0}, {0.0, -1.0, 0.2}}};
    std::size_t visited = 0;
    EXPECT_TRUE(visitArcs(path, 4.0, 1e-4,
                          [&](const Pose &from, const PathPiece &piece)
                          {
                              if (visited < 3)
                              {
                                  EXPECT_LT(gap(from, path.part(visited, 4).start), 1e-12);
                                  EXPECT_EQ(piece.length, path.pieces[visited].length);
                                  EXPECT_EQ(piece.turn, path.pieces[visited].turn);
                              }
                              ++visited;
                              return true;
                          }));
    EXPECT_GT(visited, 10u);
    std::size_t asked = 0;
    EXPECT_FALSE(visitArcs(path, 4.0, 1e-4, [&](const Pose &, const PathPiece &) { return ++asked < 6; }));
    EXPECT_EQ(asked, 6u) << "nothing is visited after a no";
}
