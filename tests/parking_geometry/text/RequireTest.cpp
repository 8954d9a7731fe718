// Each check takes what is right up to its boundary, and names what is wrong.

#include "parking_geometry/text/Require.h"

#include "tests/parking_geometry/ExpectError.h"

#include <gtest/gtest.h>

#include <limits>

using namespace parking;
using namespace parking_test;

namespace
{
    constexpr double TINY = std::numeric_limits<double>::denorm_min();
    constexpr double INF = std::numeric_limits<double>::infinity();
    const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    const Require REQUIRE("mill");
}  // namespace

TEST(Require, NamesThingFieldValueAndWhatIsRight)
{
    REQUIRE.that(true, "sails", 5.0, "four");
    EXPECT_EQ(errorOf([] { REQUIRE.that(false, "sails", 5.0, "four"); }), "mill: sails is 5; it must be four");
}

TEST(Require, NumbersAreTakenUpToTheirBoundary)
{
    REQUIRE.positive("speed", TINY);
    REQUIRE.notNegative("speed", 0.0);
    REQUIRE.finite("speed", -1e308);
    EXPECT_EQ(errorOf([] { REQUIRE.positive("speed", 0.0, "m/s"); }),
              "mill: speed is 0; it must be a positive number of m/s");
    EXPECT_EQ(errorOf([] { REQUIRE.positive("speed", -1.5); }), "mill: speed is -1.5; it must be a positive number");
    EXPECT_EQ(errorOf([] { REQUIRE.notNegative("speed", -0.25, "metres"); }),
              "mill: speed is -0.25; it must be a number of metres that is not negative");
    for (const double wrong : {INF, -INF, NOT_A_NUMBER})
    {
        const auto names = [&](const std::string &text)
        {
            return text.find("mill: speed is ") == 0;
        };
        EXPECT_TRUE(names(errorOf([&] { REQUIRE.positive("speed", wrong); })));
        EXPECT_TRUE(names(errorOf([&] { REQUIRE.notNegative("speed", wrong); })));
        EXPECT_TRUE(names(errorOf([&] { REQUIRE.finite("speed", wrong); })));
    }
}
