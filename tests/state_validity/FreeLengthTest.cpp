#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "state_validity/FootprintChecker.h"

#include <cmath>
#include <iomanip>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    constexpr double TOLERANCE = 1e-3;

    struct Tally
    {
        int whole{0};    ///< motions proven free to the end
        int stopped{0};  ///< on the way
        int barred{0};   ///< that do not begin
    };

    /** Straight, gently curved, a car's full lock, and turning all but on the spot. */
    double anyCurvature(Random &random)
    {
        switch (random.index(6))
        {
            case 0:
                return 0.0;
            case 1:
                return random.magnitude(1e-9, 1e-3);
            case 2:
            case 3:
                return random.chance(0.5) ? 0.3327 : -0.3327;
            case 4:
                return random.magnitude(1e-3, 0.5);
            default:
                return random.magnitude(0.5, 4.0);
        }
    }

    /** \param rounding of poses in the world's coordinates, metres */
    void tryMotions(const World &world, const Vehicle &vehicle, int motions, std::uint64_t seed, Tally &tally,
                    double rounding = 0.0)
    {
        const FootprintChecker checker(world.obstacles, vehicle);
        Random random(seed);
        CheckCounts counts;
        for (int i = 0; i < motions;)
        {
            const Pose from = i % 3 == 0 ? world.anywhere(random)
                                         : world.touching(random, vehicle, std::abs(random.magnitude(1e-8, 0.5)));
            if (!checker.isFree(from))
                continue;
            ++i;
            const double curvature = anyCurvature(random), length = random.magnitude(0.05, 4.0);
            const double wanted = std::abs(length);
            const double free = checker.freeLength(from, curvature, length, TOLERANCE, counts);
            ASSERT_GE(free, 0.0);
            ASSERT_LE(free, wanted);
            // What is called free is free, looked at every millimetre.
            ASSERT_TRUE(world.oracle.isArcFree(from, curvature, std::copysign(free, length), vehicle, 1e-3, -rounding))
                << world.name << std::setprecision(17) << " from " << from.x << " " << from.y << " " << from.yaw
                << " curvature " << curvature << " length " << length << " free " << free;
            if (free >= wanted)
            {
                ++tally.whole;
                continue;
            }
            // And no less is called free than is, but for the tolerance: that far ahead the body, enlarged by it,
            // touches something.
            const double ahead = std::min(free + TOLERANCE + 1e-6, wanted);
            // (A corner may all but graze a corner for a moment only, so the looks get finer.)
            bool touched = false;
            for (const int looks : {20, 2000})
                for (int k = 0; k <= looks && !touched; ++k)
                {
                    const double driven = free + (ahead - free) * k / looks;
                    touched = !world.oracle.isFree(advance(from, curvature, std::copysign(driven, length)), vehicle,
                                                   TOLERANCE + 1e-6);
                }
            ASSERT_TRUE(touched) << world.name << std::setprecision(17) << " from " << from.x << " " << from.y << " "
                                 << from.yaw << " curvature " << curvature << " length " << length << " free " << free;
            ++(free > 0.0 ? tally.stopped : tally.barred);
            // Asked for less, the same motion is free as far as before.
            const double less = 0.99 * free;
            ASSERT_EQ(checker.freeLength(from, curvature, std::copysign(less, length), TOLERANCE, counts), less);
        }
    }

    void expectVaried(const Tally &tally)
    {
        EXPECT_GT(tally.whole, tally.stopped / 4);
        EXPECT_GT(tally.stopped, tally.whole / 4);
        EXPECT_GT(tally.barred, 100);
    }
}  // namespace

TEST(FreeLength, IsFreeAndStopsAtContact)
{
    Tally polygons, grids, others;
    Vehicle wide;  // wider than long, its axle at the very rear
    wide.wheelbase = 1.0;
    wide.frontOverhang = 0.2;
    wide.rearOverhang = 0.0;
    wide.width = 2.4;
    for (std::uint64_t seed = 0; seed < 20 && !HasFatalFailure(); ++seed)
    {
        tryMotions(randomPolygonWorld(seed), {}, 1000, seed, polygons);
        tryMotions(randomGridWorld(seed), {}, 500, seed, grids);
        if (seed >= 4)
            continue;
        tryMotions(randomPolygonWorld(seed, {4.1e9, -5.3e9}), {}, 1000, seed, others, 1e-6);
        tryMotions(randomGridWorld(seed, {1e6, 1e6}), wide, 1000, seed, others, 1e-9);
        tryMotions(randomPolygonWorld(seed), wide, 1000, seed, others);
    }
    expectVaried(polygons);
    expectVaried(grids);
    EXPECT_GT(others.stopped, 1000);
}

/** Long motions are proven in parts; a contact at the very joint of two parts belongs to one of them. */
TEST(FreeLength, LosesNoContactBetweenItsParts)
{
    const Vehicle vehicle;
    const double front = vehicle.wheelbase + vehicle.frontOverhang;
    const Box bounds{{-10.0, -10.0}, {30.0, 10.0}};
    for (const double curvature : {0.0, 0.1, -0.3, 1.2})
    {
        // Where the first parts end: where a post makes the number of parts looked at change.
        for (int part = 1; part <= 2; ++part)
        {
            double before = 0.2, after = 3.0;
            const auto postAt = [&](double driven)
            {
                const Pose place = compose(advance({}, curvature, driven), {front, 0.3, 0.0});
                return ObstacleSet::fromPolygons({rectangle(1e-5, 1e-5, {place.x, place.y, 0.1})}, bounds);
            };
            const auto parts = [&](double driven, double &free)
            {
                CheckCounts counts;
                free = FootprintChecker(postAt(driven), vehicle).freeLength({}, curvature, 5.0, TOLERANCE, counts);
                return static_cast<int>(counts.byEdges);
            };
            double free = 0.0;
            while (after - before > 1e-15 * after && before < 0.5 * (before + after) && 0.5 * (before + after) < after)
            {
                const double middle = 0.5 * (before + after);
                (parts(middle, free) <= part + 1 ? before : after) = middle;
                ASSERT_LT(free, middle) << "curvature " << curvature << " post at " << std::setprecision(17) << middle;
                ASSERT_GT(free, middle - 3.0 * TOLERANCE) << curvature;
            }
            for (int step = -300; step <= 300; ++step)
            {
                const double driven = before + step * 1e-16;
                parts(driven, free);
                ASSERT_LT(free, driven) << curvature;
            }
        }
    }
}

TEST(FreeLength, DrivesAwayFromWhatItAllButTouches)
{
    // A wall so many metres behind the rear bumper.
    const Vehicle vehicle;
    for (const double gap : {1e-8, 1e-6, 1e-4, 9e-4, 1.1e-3})
    {
        const Box bounds{{-20.0, -20.0}, {20.0, 20.0}};
        const Polygon wall = rectangle(1.0, 8.0, {-vehicle.rearOverhang - gap - 0.5, 0.0, 0.0});
        const FootprintChecker checker(ObstacleSet::fromPolygons({wall}, bounds), vehicle);
        EXPECT_EQ(checker.freeLength({}, 0.0, 3.0), 3.0) << gap;
        // Straight back there is no more than the gap.
        EXPECT_LE(checker.freeLength({}, 0.0, -3.0), gap) << gap;
        // Turning swings a rear corner out backwards at once: 0 where the corner touches, not a nanometre more.
        const double free = checker.freeLength({}, 0.3, 1.0);
        EXPECT_TRUE(PolygonOracle({wall}, bounds).isArcFree({}, 0.3, free, vehicle, 1e-4)) << gap;
    }
}

TEST(FreeLength, DoesNotStartFromCollisionsOrContact)
{
    const Vehicle vehicle;
    const Box bounds{{-20.0, -20.0}, {20.0, 20.0}};
    for (const double gap : {-0.5, -1e-6, -1e-10, 0.0, 1e-10})
    {
        const Polygon wall = rectangle(1.0, 8.0, {-vehicle.rearOverhang - gap - 0.5, 0.0, 0.0});
        const FootprintChecker checker(ObstacleSet::fromPolygons({wall}, bounds), vehicle);
        EXPECT_EQ(checker.freeLength({}, 0.0, 3.0), 0.0) << gap;
    }
}

// What is swept with a large tolerance keeps it on all sides: looked at every centimetre.
TEST(FreeLength, KeepsAsMuchAsItIsSweptWith)
{
    int whole = 0, cut = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
    {
        const World world = seed % 2 ? randomGridWorld(seed) : randomPolygonWorld(seed);
        const FootprintChecker checker(world.obstacles, {});
        Random random(seed);
        CheckCounts counts;
        for (int i = 0; i < 400; ++i)
        {
            const double tolerance = i % 4 == 0 ? FootprintChecker::MAX_TOLERANCE : random.between(0.02, 0.3);
            const Pose from = world.anywhere(random);
            const FootprintChecker::SweepStart start = checker.sweepStart(from, tolerance, counts);
            if (start.enlargement < tolerance)
                continue;
            const double curvature = anyCurvature(random), length = random.magnitude(0.1, 5.0);
            const double clear = checker.freeLength(start, curvature, length, counts);
            ++(clear < std::abs(length) ? cut : whole);
            ASSERT_TRUE(world.oracle.isArcFree(from, curvature, std::copysign(clear, length), Vehicle(), 0.01,
                                               tolerance - 1e-9))
                << world.name << " " << i;
        }
    }
    EXPECT_GT(whole, 200);
    EXPECT_GT(cut, 200);
}

TEST(FreeLength, RefusesTolerancesThatItCannotSweepWith)
{
    const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-50.0, -50.0}, {50.0, 50.0}}), {});
    CheckCounts counts;
    for (const double tolerance : {0.0, -1e-3, 0.31, 1e9, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(checker.freeLength({}, 0.1, 3.0, tolerance, counts), Error) << tolerance;
    EXPECT_EQ(checker.freeLength({}, 0.1, 3.0, FootprintChecker::MAX_TOLERANCE, counts), 3.0);
}

TEST(FreeLength, HalfATurnInFreeSpaceAndNoLengthAtAll)
{
    const Box bounds{{-50.0, -50.0}, {50.0, 50.0}};
    const FootprintChecker checker(ObstacleSet::fromPolygons({}, bounds), {});
    EXPECT_EQ(checker.freeLength({}, 0.3, 100.0), 100.0) << "several times round";
    EXPECT_EQ(checker.freeLength({}, 5.0, -60.0), 60.0) << "many times round";
    EXPECT_EQ(checker.freeLength({}, 0.3, 0.0), 0.0);
    // Straight on to the end of the world.
    const double front = Vehicle().wheelbase + Vehicle().frontOverhang;
    EXPECT_NEAR(checker.freeLength({}, 0.0, 100.0), 50.0 - front, 2.1 * TOLERANCE);
}
