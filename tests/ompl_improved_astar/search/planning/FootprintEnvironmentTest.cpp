// What the search asks of the world, answered by the footprint checker within the bounds of the state space: against
// poses close together, whose clearance is exact.

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double TOLERANCE = 1e-3;

    /** A random world as the environment of a search. */
    struct Place
    {
        /** \brief \param cut metres by which the bounds of the rear axle lie within the world */
        explicit Place(std::uint64_t seed, double cut = 0.0)
          : world(seed % 2 == 0 ? randomPolygonWorld(seed) : randomGridWorld(seed)),
            checker(world.obstacles, vehicle),
            bounds{world.bounds.min + Eigen::Vector2d(cut, cut), world.bounds.max - Eigen::Vector2d(cut, 1.5 * cut)},
            environment(checker, bounds, TOLERANCE)
        {
        }

        /** Near to obstacles or anywhere. */
        Pose pose(Random &random) const
        {
            return random.chance(0.5) ? world.anywhere(random)
                                      : world.touching(random, vehicle, std::abs(random.magnitude(1e-4, 0.5)));
        }

        Vehicle vehicle;
        World world;
        FootprintChecker checker;
        Box bounds;
        FootprintEnvironment environment;
    };

    /** The least clearance of an arc, at its ends and every so many metres. */
    double leastClearance(const FootprintChecker &checker, const Pose &from, const Arc &arc, double step)
    {
        double least = std::numeric_limits<double>::infinity();
        const double steps = std::ceil(std::abs(arc.length) / step);
        for (double i = 0.0; i <= steps; i += 1.0)
            least = std::min(
                least, checker.exactClearance(advance(from, arc.curvature, arc.length * i / std::max(1.0, steps))));
        return least;
    }

}  // namespace

TEST(FootprintEnvironment, freeLengthsKeepTheClearanceEverywhereAndReachContactWithoutOne)
{
    int whole = 0, partly = 0, atBounds = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed)
    {
        Place place(seed, seed % 3 == 0 ? 4.0 : 0.0);
        Random random(seed);
        for (int i = 0; i < 1000; ++i)
        {
            const Pose from = place.pose(random);
            std::vector<Arc> arcs;
            for (std::size_t k = 1 + random.index(4); k > 0; --k)
                arcs.push_back({random.chance(0.3) ? 0.0 : random.between(-0.3, 0.3), random.magnitude(0.01, 8.0)});
            const bool isFree = place.environment.isFree(from);
            ASSERT_EQ(isFree, place.checker.exactClearance(from) > 0.0 && place.bounds.contains(from.x, from.y));
            // Nothing is known of clearances that cannot be swept.
            for (const double clearance : {0.5 * TOLERANCE, 1.01 * FootprintChecker::MAX_TOLERANCE})
                ASSERT_EQ(place.environment.freeLength(from, arcs[0], clearance), 0.0);
            const double clearance = i % 2 == 0 ? 0.0 : i % 4 == 1 ? TOLERANCE : random.between(TOLERANCE, 0.3);
            std::vector<double> lengths(arcs.size(), -1.0);
            place.environment.freeLengths(from, arcs.data(), arcs.size(), clearance, lengths.data());
            for (std::size_t k = 0; k < arcs.size(); ++k)
            {
                const auto &[curvature, length] = arcs[k];
                const double free = lengths[k];
                ASSERT_EQ(free, place.environment.freeLength(from, arcs[k], clearance)) << "alone as with others";
                ASSERT_TRUE(free >= 0.0 && free <= std::abs(length) && (isFree || free == 0.0));
                if (!isFree)
                    continue;
                const Arc driven{curvature, std::copysign(free, length)};
                ASSERT_TRUE(free == 0.0 || leastClearance(place.checker, from, driven, 0.02) > clearance - 1e-9);
                for (double at = 0.0; at < free; at += 0.01)
                {
                    const Pose pose = advance(from, curvature, std::copysign(at, length));
                    ASSERT_TRUE(place.bounds.contains(pose.x, pose.y));
                }
                // Just beyond its end is a wall, of one kind or the other: that near without a clearance, and not much
                // farther than the clearance from the way, since a body so enlarged reaches farthest at its corners.
                const Arc rest{curvature, std::copysign(2.0 * TOLERANCE, length)};
                const Pose end = advance(from, driven), beyond = advance(end, rest);
                const bool leaves = !place.bounds.contains(beyond.x, beyond.y);
                ++(free >= std::abs(length) ? whole : leaves ? atBounds : partly);
                if (free >= std::abs(length) || leaves)
                    continue;
                ASSERT_TRUE(clearance > 0.0 ||
                            leastClearance(place.checker, end, rest, 0.1 * TOLERANCE) < 3.0 * TOLERANCE);
                ASSERT_LT(leastClearance(place.checker, from, arcs[k], 0.02), 2.5 * std::max(TOLERANCE, clearance));
            }
        }
    }
    EXPECT_TRUE(whole > 500 && partly > 500 && atBounds > 50) << whole << " " << partly << " " << atBounds;
}

TEST(FootprintEnvironment, keepsWhatIsKeptExactlyAndNothingElse)
{
    int kept = 0, missed = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed)
    {
        Place place(seed);
        Random random(seed);
        for (int i = 0; i < 500; ++i)
        {
            const Pose pose = place.pose(random);
            const double exact = place.checker.exactClearance(pose);
            for (const double clearance : {0.01, 0.1, 0.3, exact, random.between(0.0, 0.9)})
                if (clearance > 0.0 && place.environment.keeps(pose, clearance))
                {
                    ++kept;
                    ASSERT_GE(exact, clearance - 1e-9);
                }
                else
                {
                    ++missed;
                    ASSERT_LE(std::min(0.7 * exact, 0.9), clearance + 1e-9) << "but from corner to corner";
                }
        }
    }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(missed, 1000);
}

TEST(FootprintEnvironment, aMotionIsFreeWhereItsPosesAre)
{
    int free = 0, blocked = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed)
    {
        Place place(seed, seed % 3 == 0 ? 4.0 : 0.0);
        Random random(seed);
        for (int i = 0; i < 300; ++i)
        {
            const Pose from = place.pose(random);
            if (!place.environment.isFree(from))
                continue;
            const double turn = i % 3 == 0 ? 0.0 : random.between(-3.0, 3.0), reach = i % 5 == 0 ? 0.0 : 2.0;
            const Pose to{from.x + random.between(-reach, reach), from.y + random.between(-reach, reach),
                          wrapAngle(from.yaw + turn)};
            double least = std::numeric_limits<double>::infinity();
            bool isInside = true;
            for (int k = 0; k <= 200; ++k)
            {
                const double t = k / 200.0;
                const Pose pose{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.yaw + t * turn};
                least = std::min(least, place.checker.exactClearance(pose));
                isInside = isInside && place.bounds.contains(pose.x, pose.y);
            }
            const bool isFree = place.environment.isMotionFree(from, to);
            ++(isFree ? free : blocked);
            ASSERT_TRUE(isFree ? least > 0.0 && isInside : least < 0.05 || !isInside) << least;
        }
    }
    EXPECT_GT(free, 200);
    EXPECT_GT(blocked, 150);
}

TEST(FootprintEnvironment, aMotionAcrossAPostIsNotFreeAlthoughItsEndsAndItsMiddleAre)
{
    const Vehicle vehicle;
    const Pose from{0.0, -5.0, 0.0}, to{0.0, 5.0, 0.0}, post{1.0, 4.9 - 0.5 * vehicle.width, 0.0};
    const Box bounds{{-20.0, -20.0}, {20.0, 20.0}};
    const FootprintChecker checker(ObstacleSet::fromPolygons({rectangle(0.02, 0.02, post)}, bounds), vehicle);
    FootprintEnvironment environment(checker, bounds, TOLERANCE);
    EXPECT_TRUE(environment.isFree(from) && environment.isFree({}) && environment.isFree(to));
    EXPECT_FALSE(environment.isMotionFree(from, to));
}

TEST(FootprintEnvironment, whoStandsOnTheBoundsDrivesAwayFromThem)
{
    const Vehicle vehicle;
    const Box bounds{{-10.0, -10.0}, {10.0, 10.0}};
    const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-30.0, -30.0}, {30.0, 30.0}}), vehicle);
    FootprintEnvironment environment(checker, bounds, TOLERANCE);
    for (int quarter = 0; quarter < 4; ++quarter)
        for (const double skew : {0.0, 1e-12, -1e-12})
        {
            const double yaw = 0.5 * PI * quarter;
            const Pose on{std::clamp(12.0 * std::cos(yaw), -10.0, 10.0), std::clamp(12.0 * std::sin(yaw), -10.0, 10.0),
                          yaw + skew};
            SCOPED_TRACE(testing::Message() << on.x << " " << on.y << " " << on.yaw);
            ASSERT_TRUE(environment.isFree(on));
            EXPECT_FALSE(environment.isFree(advance(on, 0.0, 1e-6)));
            EXPECT_EQ(environment.freeLength(on, {0.0, -3.0}), 3.0);
            EXPECT_EQ(environment.freeLength(on, {0.2, -3.0}), 3.0);
            EXPECT_LT(environment.freeLength(on, {0.0, 0.1}), 0.1);
            const Pose before = advance(on, 0.0, -3.0);
            EXPECT_NEAR(environment.freeLength(before, {0.0, 3.0}), 3.0, 1.1 * TOLERANCE);
            for (const double beyond : {1e-8, 1.0})
                EXPECT_LT(environment.freeLength(before, {0.0, 3.0 + beyond}), 3.0);
        }
    EXPECT_EQ(environment.freeLength({10.1, 0.0, PI}, {0.0, 3.0}), 0.0);
}

/** The room at a point is an upper bound, and close: were it too high by much, discs would go where they do not fit,
   and lead the search there. */
TEST(FootprintEnvironment, roomIsNeverBelowTheDistanceToTheNearestObstacleNorMuchAbove)
{
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        Place place(seed);
        Vehicle point;  // nearly one
        point.wheelbase = point.width = 0.01;
        point.frontOverhang = point.rearOverhang = 0.0;
        const FootprintChecker exact(place.world.obstacles, point);
        Random random(seed);
        const double error = place.checker.field().errorBound();
        for (int i = 0; i < 2000; ++i)
        {
            const Pose at = place.world.anywhere(random);
            const double distance = exact.exactClearance(at), room = place.environment.roomAt(at.x, at.y);
            ASSERT_GE(room, distance - 1e-5);
            ASSERT_TRUE(distance <= 0.0 || room <= distance + 2.0 * error + 0.02);
        }
    }
}

TEST(FootprintEnvironment, headingsAreBlockedOnlyWhereAllPosesOfTheCellCollide)
{
    int blocked = 0, open = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed)
    {
        Place place(seed);
        Random random(seed);
        const double side = random.between(0.1, 0.9);
        const int headings = 8 + random.below(121);
        const BlockedHeadings cells = place.environment.blockedHeadings(side, headings);
        for (int i = 0; i < 150; ++i)
        {
            const Pose middle = i % 2 == 0 ? place.world.anywhere(random)
                                           : advance(place.pose(random), 0.0, place.vehicle.centreOffset());
            const HeadingSet set = cells(middle.x, middle.y);
            for (int k = 0; k < headings; ++k)
            {
                if ((set[static_cast<std::size_t>(k / 64)] >> (k % 64) & 1U) == 0)
                {
                    ++open;
                    continue;
                }
                ++blocked;
                // Corners, edges and what lies between.
                for (int sample = 0; sample < 45; ++sample)
                {
                    const double dx = 0.5 * (sample % 3 - 1) * side, dy = 0.5 * (sample / 3 % 3 - 1) * side;
                    const double yaw = 2.0 * PI * (k + 0.25 * (sample / 9)) / headings - PI;
                    const Pose body{middle.x + dx, middle.y + dy, wrapAngle(yaw)};
                    ASSERT_FALSE(place.checker.isFree(advance(body, 0.0, -place.vehicle.centreOffset())));
                }
            }
            for (std::size_t k = static_cast<std::size_t>(headings); k < 128; ++k)
                ASSERT_EQ(set[k / 64] >> (k % 64) & 1U, 0U) << "there is no such heading";
        }
    }
    EXPECT_GT(blocked, 5000);
    EXPECT_GT(open, 5000);
}

TEST(FootprintEnvironment, theJudgeHasTheLastWordOnWholePaths)
{
    DiscCarWorld judge({{-9.0, -9.0}, {9.0, 9.0}});
    Place place(0);
    FootprintEnvironment judged(place.checker, place.bounds, TOLERANCE, &judge);
    EXPECT_TRUE(judged.acceptPath({}));
    judge.acceptsPaths = false;
    EXPECT_FALSE(judged.acceptPath({}));
    EXPECT_TRUE(place.environment.acceptPath({}));
}
