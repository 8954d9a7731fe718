#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Polygon.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    Polygon reversed(Polygon polygon)
    {
        std::reverse(polygon.begin(), polygon.end());
        return polygon;
    }

    Polygon moved(Polygon polygon, const Eigen::Vector2d &by)
    {
        for (Eigen::Vector2d &corner : polygon)
            corner += by;
        return polygon;
    }

    /** An L: a 4 x 4 square without its upper right quarter. */
    const Polygon ELL = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
}  // namespace

TEST(Polygon, AreaIsSignedByOrientation)
{
    EXPECT_DOUBLE_EQ(signedArea(ELL), 12.0);
    EXPECT_DOUBLE_EQ(signedArea(reversed(ELL)), -12.0);
    EXPECT_EQ(signedArea({}), 0.0);
    EXPECT_EQ(signedArea({{1, 1}, {2, 2}}), 0.0);
    EXPECT_DOUBLE_EQ(signedArea({{0, 0}, {1, 1}, {2, 2}}), 0.0);
}

TEST(Polygon, AreaKeepsItsPrecisionFarFromTheOrigin)
{
    // Coordinates of this size are whole micrometres; the shoelace formula on them would err by hundreds.
    EXPECT_NEAR(signedArea(moved(ELL, {4.5e9, -5.5e9})), 12.0, 1e-5);
}

TEST(Polygon, CrossingsAreFoundAmongManySides)
{
    // A circle of many corners, two of which are swapped: found wherever they are. A hundred thousand sides take no
    // longer than they must.
    for (const std::size_t corners : {std::size_t{50}, std::size_t{100000}})
    {
        Polygon circle;
        for (std::size_t k = 0; k < corners; ++k)
        {
            const double angle = 2.0 * 3.14159265358979 * static_cast<double>(k) / static_cast<double>(corners);
            circle.emplace_back(20.0 * std::cos(angle), 20.0 * std::sin(angle));
        }
        EXPECT_FALSE(crossesItself(circle));
        for (std::size_t k = 0; k < corners; k += corners / 25)
        {
            Polygon twisted = circle;
            std::swap(twisted[k], twisted[(k + 1) % corners]);
            EXPECT_TRUE(crossesItself(twisted)) << k;
        }
    }
}

TEST(Polygon, ContainsAgreesWithTheWindingAngle)
{
    parking_test::Random random(11);
    int inside = 0;
    for (int i = 0; i < 400; ++i)
    {
        // Star-shaped about the origin, so simple whatever the radii.
        Polygon polygon;
        const int corners = 3 + random.below(9);
        for (int k = 0; k < corners; ++k)
        {
            const double angle = 2.0 * 3.14159265358979 * k / corners, radius = random.between(0.3, 2.3);
            polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
        for (int k = 0; k < 50; ++k)
        {
            const Eigen::Vector2d point(random.between(-2.5, 2.5), random.between(-2.5, 2.5));
            double turned = 0.0;
            for (std::size_t j = 0; j < polygon.size(); ++j)
            {
                const Eigen::Vector2d a = polygon[j] - point, b = polygon[(j + 1) % polygon.size()] - point;
                turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
            }
            const bool expected = std::abs(turned) > 3.0;
            EXPECT_EQ(contains(polygon, point), expected);
            EXPECT_EQ(contains(moved(polygon, {1e6, -1e6}), point + Eigen::Vector2d(1e6, -1e6)), expected);
            inside += expected;
        }
    }
    EXPECT_GT(inside, 1000);
}
