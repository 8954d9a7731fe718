#include "benchmarks/worlds/Random.h"
#include "parking_geometry/curves/Biarc.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
    using namespace parking;

    TEST(Biarc, LeadsFromPoseToPoseExactly)
    {
        parking_test::Random random(7);
        for (int i = 0; i < 2000; ++i)
        {
            const int direction = i % 2 == 0 ? 1 : -1;
            const Pose from{random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-PI, PI)};
            const double share = i % 3 == 0 ? 1e-6 : 1.0;  // nearly straight ones, too
            const Pose to = compose(from, {direction * random.between(0.1, 3.0), share * random.between(-0.1, 0.1),
                                           share * random.between(-1.2, 1.2)});
            const auto path = biarc(from, to, direction);
            ASSERT_TRUE(path);
            ASSERT_LE(path->pieces.size(), 2u);
            for (const PathPiece &piece : path->pieces)
            {
                EXPECT_EQ(piece.direction(), direction);
                EXPECT_EQ(piece.sharpness, 0.0);
            }
            const Pose off = relativeTo(to, path->end());
            EXPECT_NEAR(off.x, 0.0, 1e-9);
            EXPECT_NEAR(off.y, 0.0, 1e-9);
            EXPECT_NEAR(off.yaw, 0.0, 1e-9);
        }
    }

    TEST(Biarc, OfPosesOnAnArcIsThatArc)
    {
        for (const double curvature : {-0.3, 0.0, 0.1})
            for (const double length : {-2.0, 0.5, 3.0})
            {
                const Pose from{1.0, -2.0, 0.7};
                const auto path = biarc(from, advance(from, curvature, length), length < 0.0 ? -1 : 1);
                ASSERT_TRUE(path);
                EXPECT_NEAR(path->length(), std::abs(length), 1e-9);
                for (const PathPiece &piece : path->pieces)
                    EXPECT_NEAR(piece.curvature, curvature, 1e-9);
            }
    }

    TEST(Biarc, NeverGoesAgainstItsDirection)
    {
        EXPECT_FALSE(biarc({}, {-1.0, 0.0, 0.0}, 1));
        EXPECT_FALSE(biarc({}, {1.0, 0.0, 0.0}, -1));
        EXPECT_FALSE(biarc({}, {}, 1));
    }
}  // namespace
