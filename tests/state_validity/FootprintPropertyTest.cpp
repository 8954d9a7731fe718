// The promise of FootprintChecker, put to the oracle two million times: its answer, FCL's answer and the exact answer
// agree for every pose that is not within a nanometre of contact.
#include "state_validity/FootprintChecker.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/fcl/FclContactTest.h"

#include <iomanip>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    struct Tally
    {
        long poses{0};
        long free{0};
        long inBand{0};  ///< so near to contact that either answer is right
        CheckCounts counts;
    };

    void compare(const World &world, const Vehicle &vehicle, double margin, long poses, std::uint64_t seed,
                 Tally &tally)
    {
        const FootprintChecker checker(world.obstacles, vehicle, margin, fclContactTest());
        const FootprintChecker careful(world.obstacles, vehicle, margin);
        const PlainFclChecker fcl(world.obstacles, vehicle, margin);
        const double band = FootprintChecker::CONTACT_BAND;
        Random random(seed);
        Vehicle enlarged = vehicle;
        enlarged.frontOverhang += margin;
        enlarged.rearOverhang += margin;
        enlarged.width += 2.0 * margin;
        for (long i = 0; i < poses; ++i)
        {
            // One in four anywhere, one in four about touching, two in four at any distance from touching.
            Pose pose = world.anywhere(random);
            if (i % 4 == 1)
                pose = world.touching(random, enlarged, 0.0);
            else if (i % 4 > 1)
                pose = world.touching(random, enlarged, std::abs(random.magnitude(1e-10, 0.5)));
            const bool free = checker.isFree(pose, tally.counts);
            const bool surelyFree = world.oracle.isFree(pose, vehicle, margin + band);
            const bool surelyNot = !surelyFree && !world.oracle.isFree(pose, vehicle, margin - band);
            ASSERT_TRUE(free || !careful.isFree(pose)) << "without a contact test no further pose is free";
            ++tally.poses;
            tally.free += surelyFree;
            if (!surelyFree && !surelyNot)
            {
                ++tally.inBand;
                continue;
            }
            ASSERT_EQ(free, surelyFree) << world.name << std::setprecision(17) << ": " << pose.x << " " << pose.y << " "
                                        << pose.yaw;
            ASSERT_EQ(careful.isFree(pose), surelyFree) << "without a contact test";
            ASSERT_EQ(fcl.isFree(pose), surelyFree)
                << "FCL, " << world.name << std::setprecision(17) << ": " << pose.x << " " << pose.y << " " << pose.yaw;
        }
    }

    /** A fair test has enough of everything: free and not, near contact, and each tier deciding. */
    void expectVaried(const Tally &tally)
    {
        EXPECT_GT(tally.free, tally.poses / 20);
        EXPECT_LT(tally.free, tally.poses * 19 / 20);
        EXPECT_GT(tally.inBand, tally.poses / 2000);
        EXPECT_EQ(tally.counts.states, static_cast<std::uint64_t>(tally.poses));
        for (const std::uint64_t count : {tally.counts.byField, tally.counts.byCircles, tally.counts.byEdges})
            EXPECT_GT(count, tally.counts.states / 20);
        EXPECT_GT(tally.counts.byContactTest, 0u);
        EXPECT_EQ(tally.counts.states,
                  tally.counts.byField + tally.counts.byCircles + tally.counts.byEdges + tally.counts.byContactTest);
    }

    constexpr long POSES = 25000;

    const Eigen::Vector2d NEAR(3.0, -5.0), FAR(1e6, -1e6), VERY_FAR(4.1e9, -5.3e9);

    /** Worlds of one kind, and where they lie. */
    struct Place
    {
        const char *name;
        World (*make)(std::uint64_t seed, const Eigen::Vector2d &offset);
        Eigen::Vector2d offset;
        bool isVaried;  ///< poses far away snap to a raster of up to half a micrometre, so that few touch
    };

    World polygonsOrCells(std::uint64_t seed, const Eigen::Vector2d &offset)
    {
        return seed % 2 ? randomPolygonWorld(seed, offset) : randomGridWorld(seed, offset);
    }

    /** The competition's cases 13 to 15 lie about as far away as the last ones. */
    const Place PLACES[] = {{"AmongPolygons", randomPolygonWorld, NEAR, true},
                            {"OnGrids", randomGridWorld, NEAR, true},
                            {"OnNoisyMaps", noisyGridWorld, NEAR, true},
                            {"AThousandKilometresAway", polygonsOrCells, FAR, false},
                            {"AtFourBillionMetres", polygonsOrCells, VERY_FAR, false}};

    using FootprintProperty = testing::TestWithParam<Place>;
}  // namespace

TEST_P(FootprintProperty, AgreesWithTheOracleAndFcl)
{
    const Place &place = GetParam();
    Tally tally;
    for (std::uint64_t seed = 100; seed < 120 && !HasFatalFailure(); ++seed)
        compare(place.make(seed, place.offset), {}, 0.0, POSES, seed, tally);
    EXPECT_GT(tally.free, tally.poses / 20);
    if (place.isVaried)
        expectVaried(tally);
}

INSTANTIATE_TEST_SUITE_P(Places, FootprintProperty, testing::ValuesIn(PLACES),
                         [](const auto &each) { return each.param.name; });

TEST(FootprintVariants, AgreesWithMarginsAndOtherVehicles)
{
    Tally tally;
    Vehicle small;
    small.wheelbase = 0.4;
    small.frontOverhang = small.rearOverhang = 0.05;
    small.width = 0.45;
    Vehicle wide;  // wider than long, its axle at the very rear
    wide.wheelbase = 1.0;
    wide.frontOverhang = 0.2;
    wide.rearOverhang = 0.0;
    wide.width = 2.4;
    for (std::uint64_t seed = 500; seed < 506 && !HasFatalFailure(); ++seed)
    {
        const World world = seed % 2 ? randomPolygonWorld(seed) : randomGridWorld(seed);
        compare(world, {}, 0.15, POSES / 2, seed, tally);
        compare(world, small, 0.0, POSES / 2, seed, tally);
        compare(world, wide, 0.02, POSES / 2, seed, tally);
    }
    expectVaried(tally);
}

/** With cells larger than the body the field alone cannot tell inside from outside of a small obstacle. */
TEST(FootprintVariants, AgreesWhenTheFieldIsCoarserThanTheBody)
{
    Vehicle small;
    small.wheelbase = 0.4;
    small.frontOverhang = small.rearOverhang = 0.05;
    small.width = 0.45;
    for (std::uint64_t seed = 600; seed < 604; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        const FootprintChecker checker(world.obstacles, small, 0.0, fclContactTest(), 3.0);
        Random random(seed);
        for (int i = 0; i < 20000; ++i)
        {
            const Pose pose = world.anywhere(random);
            if (world.oracle.isFree(pose, small, 1e-9) != world.oracle.isFree(pose, small, -1e-9))
                continue;
            ASSERT_EQ(checker.isFree(pose), world.oracle.isFree(pose, small)) << seed;
        }
    }
}
