#include "state_validity/ConvexDecomposition.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

TEST(ConvexDecomposition, PiecesAreConvexAndCoverThePolygonOnce)
{
    Random random(3);
    for (int i = 0; i < 2000; ++i)
    {
        Polygon polygon = i % 3 == 0 ? bay(5.5, 2.5, {0.0, 0.0, random.between(-PI, PI)})
                                     : star(random, random.between(-5.0, 5.0), 0.0, 2.0);
        if (signedArea(polygon) < 0.0)
            std::reverse(polygon.begin(), polygon.end());
        double area = 0.0;
        const std::vector<Polygon> pieces = convexPieces(polygon);
        for (const Polygon &piece : pieces)
        {
            area += signedArea(piece);
            for (std::size_t k = 0; k < piece.size(); ++k)
                ASSERT_GE(turn(piece[k], piece[(k + 1) % piece.size()], piece[(k + 2) % piece.size()]), 0.0);
        }
        ASSERT_NEAR(area, signedArea(polygon), 1e-9 * area);
        for (int k = 0; k < 50; ++k)
        {
            const Eigen::Vector2d point(random.between(-7.0, 7.0), random.between(-4.0, 4.0));
            int pieceCount = 0;
            for (const Polygon &piece : pieces)
                pieceCount += contains(piece, point);
            ASSERT_EQ(pieceCount, contains(polygon, point) ? 1 : 0);
        }
    }
}

TEST(ConvexDecomposition, StaysNearTheSmallestNumberOfPieces)
{
    // An octagon is one piece; a bay, which has two corners that turn right, needs three at most twelve.
    Polygon octagon;
    for (int i = 0; i < 8; ++i)
        octagon.emplace_back(std::cos(i * PI / 4.0), std::sin(i * PI / 4.0));
    EXPECT_EQ(convexPieces(octagon).size(), 1u);
    EXPECT_EQ(convexPieces(bay(5.5, 2.5, {})).size(), 3u);
}

TEST(ConvexDecomposition, CornersOnAStraightLineAndFlatPolygonsDoNoHarm)
{
    const Polygon withMiddles{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {1.0, 1.0}, {0.0, 2.0}, {0.0, 1.0}};
    double area = 0.0;
    for (const Polygon &piece : convexPieces(withMiddles))
        area += signedArea(piece);
    EXPECT_NEAR(area, signedArea(withMiddles), 1e-12);
    EXPECT_TRUE(convexPieces({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}).empty());
}

TEST(ConvexDecomposition, RefusesOutlinesThatCrossThemselves)
{
    // A pentagram winds twice round its middle.
    Polygon pentagram;
    for (int i = 0; i < 5; ++i)
        pentagram.emplace_back(std::cos(i * 4.0 * PI / 5.0), std::sin(i * 4.0 * PI / 5.0));
    EXPECT_THROW(convexPieces(pentagram), Error);
    // Touching itself is no crossing: a frame whose inner and outer outline are joined by a seam.
    const Polygon frame{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}, {0.0, 0.0},
                        {1.0, 1.0}, {1.0, 3.0}, {3.0, 3.0}, {3.0, 1.0}, {1.0, 1.0}};
    double area = 0.0;
    for (const Polygon &piece : convexPieces(frame))
        area += signedArea(piece);
    EXPECT_NEAR(area, 12.0, 1e-9);
}
