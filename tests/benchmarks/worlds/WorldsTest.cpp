// The generators and the oracle that all other tests stand on, by laws.

#include "benchmarks/worlds/MadeWorlds.h"
#include "benchmarks/worlds/RandomParking.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace
{
    using namespace parking_test;

    constexpr double FAR = std::numeric_limits<double>::infinity();
    const Box ENDLESS{{-FAR, -FAR}, {FAR, FAR}};

    const std::vector<std::function<World(std::uint64_t)>> GENERATORS{
        [](std::uint64_t seed) { return randomPolygonWorld(seed); },
        [](std::uint64_t seed) { return randomGridWorld(seed); },
        [](std::uint64_t seed) { return noisyGridWorld(seed); },
        [](std::uint64_t seed) { return parkingRowsWorld(seed, {}); },
        [](std::uint64_t seed) { return baysWorld(seed, {}); },
        lanesWorld};

    std::vector<Polygon> squaresOf(const OccupancyGrid &grid)
    {
        std::vector<Polygon> squares;
        const double size = grid.resolution();
        for (std::size_t row = 0; row < grid.height(); ++row)
            for (std::size_t column = 0; column < grid.width(); ++column)
                if (grid.at(column, row) != Cell::Free)
                    squares.push_back(
                        rectangle(size, size,
                                  compose(grid.origin(), {(static_cast<double>(column) + 0.5) * size,
                                                          (static_cast<double>(row) + 0.5) * size, 0.0})));
        return squares;
    }

    TEST(RandomWorlds, FollowFromTheirSeed)
    {
        for (const auto &make : GENERATORS)
        {
            const World world = make(7), same = make(7), other = make(8);
            SCOPED_TRACE(world.name);
            const auto obstacles = [](const World &of)
            {
                return of.scenario.grid ? squaresOf(*of.scenario.grid) : of.scenario.polygons;
            };
            EXPECT_FALSE(obstacles(world).empty());
            EXPECT_EQ(obstacles(world), obstacles(same));
            EXPECT_NE(obstacles(world), obstacles(other));
            ASSERT_EQ(world.places.size(), same.places.size());
            Random random(1);
            int free = 0;
            for (int i = 0; i < 200; ++i)
                free += world.oracle.isFree(world.anywhere(random), {}) ? 1 : 0;
            EXPECT_GT(free, 20);
            EXPECT_LT(free, 190);
        }
    }

    TEST(RandomWorlds, TouchingPosesTouch)
    {
        const World world = randomPolygonWorld(3);
        Random random(3);
        for (int i = 0; i < 500; ++i)
        {
            const Pose pose = world.touching(random, {}, 0.0);
            ASSERT_FALSE(world.oracle.isFree(pose, {}, 1e-9)) << i;
        }
    }

    TEST(RandomWorlds, CarsFitIntoTheirPlaces)
    {
        for (std::uint64_t seed = 1; seed <= 60; ++seed)
        {
            const Vehicle car = RandomParking(seed).vehicle();
            const World bays = baysWorld(seed, car), rows = parkingRowsWorld(seed, car);
            ASSERT_EQ(bays.places.size(), 2 * bays.scenario.polygons.size()) << seed;
            for (const Pose &place : bays.places)  // two bays may lie across each other
                ASSERT_TRUE(bays.places.size() > 2 || bays.oracle.clearance(place, car) > 0.049) << seed;
            // Slots askew to the row are not as wide as the car: only the others are free.
            for (const Pose &place : rows.places)
            {
                const double askew = std::abs(std::sin(2.0 * place.yaw));
                ASSERT_TRUE(askew > 0.5 || rows.oracle.isFree(place, car)) << seed;
            }
        }
    }

    TEST(MadeWorlds, FollowFromTheirSeed)
    {
        for (const std::string &kind : worldKinds())
        {
            SCOPED_TRACE(kind);
            const std::vector<Polygon> world = madeWorld(kind, "seven");
            EXPECT_GE(world.size(), 4U);
            EXPECT_EQ(world, madeWorld(kind, "seven"));
            EXPECT_NE(world, madeWorld(kind, "eight"));
            for (const Polygon &polygon : world)
                ASSERT_GE(polygon.size(), 3U);
        }
        EXPECT_THROW(madeWorld("street", "seven"), Error);
        EXPECT_EQ(seedOf(""), 0xcbf29ce484222325U);
        EXPECT_EQ(seedOf("a"), 0xaf63dc4c8601ec8cU);  // from the authors' test vectors
    }

    /** A box of 0.1 m moves up, down, left and right in steps that do not jump over a wall. */
    TEST(MadeWorlds, EveryPlaceOfAMazeIsReachedFromEveryOther)
    {
        constexpr double STEP = 0.35;
        Vehicle mover;
        mover.wheelbase = 0.05;
        mover.frontOverhang = mover.rearOverhang = 0.025;
        mover.width = 0.1;
        for (const char *seed : {"1", "2", "3", "4"})
        {
            const PolygonOracle oracle(madeWorld("maze", seed), ENDLESS);
            Box box{{0.0, 0.0}, {0.0, 0.0}};
            for (const Polygon &polygon : madeWorld("maze", seed))
                for (const Eigen::Vector2d &corner : polygon)
                    box.include(corner);
            const auto side = static_cast<std::size_t>(box.max.x() / STEP);
            std::vector<bool> open(side * side, false);
            std::vector<std::size_t> reached;
            std::size_t count = 0;
            for (std::size_t at = 0; at < open.size(); ++at)
            {
                const Pose pose{(static_cast<double>(at % side) + 0.5) * STEP,
                                (static_cast<double>(at / side) + 0.5) * STEP, 0.0};
                open[at] = pose.x < box.max.x() - 0.6 && pose.y < box.max.y() - 0.6 && oracle.isFree(pose, mover);
                count += open[at] ? 1 : 0;
                if (open[at] && reached.empty())
                    reached.push_back(at);
            }
            ASSERT_GT(count, side * side / 2);
            open[reached.front()] = false;
            for (std::size_t i = 0; i < reached.size(); ++i)
            {
                const std::size_t at = reached[i];
                for (const std::size_t next : {at % side > 0 ? at - 1 : at, at % side + 1 < side ? at + 1 : at,
                                               at >= side ? at - side : at, at + side < open.size() ? at + side : at})
                    if (open[next])
                    {
                        open[next] = false;
                        reached.push_back(next);
                    }
            }
            EXPECT_EQ(reached.size(), count) << seed;
        }
    }

    TEST(PolygonOracle, KnownDistances)
    {
        const Vehicle car;  // its middle of the rear axle at the origin, heading along x
        const double front = car.wheelbase + car.frontOverhang, side = 0.5 * car.width;
        const std::vector<std::pair<Polygon, double>> cases{
            {{{front + 2.0, -9.0}, {front + 3.0, -9.0}, {front + 3.0, 9.0}, {front + 2.0, 9.0}}, 2.0},
            {{{front + 3.0, side + 4.0}, {front + 9.0, side + 4.0}, {front + 9.0, side + 5.0}}, 5.0},
            {{{0.0, -side - 1.5}, {1.0, -side - 9.0}, {-1.0, -side - 9.0}}, 1.5},
            {{{0.5, 0.1}, {0.6, 0.1}, {0.5, 0.2}}, 0.0},                           // within the body
            {{{-99.0, -99.0}, {99.0, -99.0}, {99.0, 99.0}, {-99.0, 99.0}}, 0.0}};  // round it
        for (const auto &[polygon, distance] : cases)
            for (const Pose &at : {Pose{}, Pose{4.0e9, -5.0e9, 0.0}})
            {
                Polygon moved = polygon;
                for (Eigen::Vector2d &corner : moved)
                    corner += Eigen::Vector2d(at.x, at.y);
                const PolygonOracle oracle({moved}, ENDLESS);
                EXPECT_NEAR(oracle.clearance(at, car), distance, at.x > 0.0 ? 1e-6 : 1e-12);
                EXPECT_EQ(oracle.isFree(at, car), distance > 0.0);
            }
        EXPECT_NEAR(PolygonOracle({}, {{-9.0, -3.0}, {9.0, 4.0}}).clearance({}, car), 3.0 - side, 1e-12);
    }

    TEST(PolygonOracle, FreeIsWhatIsFartherThanTheMargin)
    {
        for (std::uint64_t seed = 1; seed <= 10; ++seed)
        {
            const World world = randomPolygonWorld(seed);
            Random random(seed);
            for (int i = 0; i < 300; ++i)
            {
                const Pose pose = world.touching(random, {}, random.between(0.0, 1.0));
                const double clearance = world.oracle.clearance(pose, {});
                ASSERT_EQ(clearance > 0.0, world.oracle.isFree(pose, {}));
                // The corners of a body that is enlarged move by more than the margin, and nothing by less.
                ASSERT_TRUE(clearance == 0.0 || world.oracle.isFree(pose, {}, clearance / std::sqrt(2.0) - 1e-9));
                ASSERT_FALSE(world.oracle.isFree(pose, {}, clearance + 1e-9));
            }
        }
    }

    TEST(PolygonOracle, CellsAreSquares)
    {
        int free = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed)
        {
            const World world = seed % 2 ? randomGridWorld(seed) : noisyGridWorld(seed);
            const PolygonOracle squares(squaresOf(*world.scenario.grid), ENDLESS);
            Random random(seed);
            for (int i = 0; i < 300; ++i)
            {
                const Pose pose = world.touching(random, {}, random.between(0.0, 1.0));
                const bool isFree = world.oracle.isFree(pose, {});
                free += isFree ? 1 : 0;
                // Outside of the map there are no squares.
                ASSERT_TRUE(!isFree || squares.isFree(pose, {}, -1e-9)) << seed;
                const Pose middle = compose(pose, {Vehicle().wheelbase / 2.0, 0.0, 0.0});
                const Pose inMap = relativeTo(world.scenario.grid->origin(), middle);
                const bool isWithin = inMap.x > 4.0 && inMap.y > 4.0 && inMap.x < 16.0 && inMap.y < 16.0;
                ASSERT_TRUE(isFree || !isWithin || !squares.isFree(pose, {}, 1e-9)) << seed;
            }
        }
        EXPECT_GT(free, 200);
    }

    TEST(PolygonOracle, PathsAreFreeWhereEachOfTheirPosesIs)
    {
        const Vehicle car;
        int free = 0;
        for (std::uint64_t seed = 1; seed <= 60; ++seed)
        {
            const World world = seed % 2 ? randomPolygonWorld(seed) : randomGridWorld(seed);
            RandomParking random(seed);
            Path path = random.plannerPath(car, 1.0);
            path.pieces.resize(1 + path.pieces.size() / 4);
            path.start = world.anywhere(random);
            for (int tries = 0; tries < 50 && !world.oracle.isFree(path.start, car, 0.2); ++tries)
                path.start = world.anywhere(random);
            bool surely = true, perhaps = true;
            for (const PathState &state : path.sample(5e-3))
            {
                surely = surely && world.oracle.isFree(state.pose, car, 1e-2);
                perhaps = perhaps && world.oracle.isFree(state.pose, car, -1e-2);
            }
            const bool isFree = world.oracle.isPathFree(path, car, 1e-3);
            ASSERT_TRUE(isFree || !surely) << seed;
            ASSERT_TRUE(!isFree || perhaps) << seed;
            free += isFree ? 1 : 0;
        }
        EXPECT_GT(free, 10);
        EXPECT_LT(free, 50);
    }
}  // namespace
