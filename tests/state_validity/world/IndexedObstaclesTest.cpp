#include "state_validity/world/IndexedObstacles.h"

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Error.h"
#include "state_validity/FootprintChecker.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    OccupancyGrid randomMap(Random &random, std::size_t width, std::size_t height, double resolution)
    {
        OccupancyGrid map(width, height, resolution, {random.between(-50.0, 50.0), 3.0, random.between(-3.0, 3.0)});
        const double density = random.chance(0.3) ? 0.0 : std::exp(random.between(std::log(0.001), std::log(0.5)));
        for (std::size_t row = 0; row < height; ++row)
            for (std::size_t column = 0; column < width; ++column)
                if (random.chance(density))
                    map.set(column, row, random.chance(0.5) ? Cell::Occupied : Cell::Unknown);
        return map;
    }

    /** Single cells, lines and blocks, set and cleared, often at the border, in groups, and some of them twice. */
    GridUpdate randomUpdate(Random &random, const OccupancyGrid &map)
    {
        GridUpdate update;
        const std::size_t shapes = random.index(4) + (random.chance(0.05) ? 20 : 0);
        const std::size_t middleColumn = random.index(map.width()), middleRow = random.index(map.height());
        const bool isGroup = random.chance(0.5);
        for (std::size_t shape = 0; shape < shapes; ++shape)
        {
            std::size_t left = random.index(map.width()), low = random.index(map.height());
            if (isGroup)
            {
                left = std::min(map.width() - 1, middleColumn + random.index(20));
                low = std::min(map.height() - 1, middleRow + random.index(20));
            }
            if (random.chance(0.2))
                left = random.chance(0.5) ? 0 : map.width() - 1;
            if (random.chance(0.2))
                low = random.chance(0.5) ? 0 : map.height() - 1;
            const std::size_t width = random.chance(0.6) ? 1 : 1 + random.index(map.width()),
                              height = random.chance(0.6) ? 1 : 1 + random.index(map.height());
            const Cell cell = random.chance(0.6) ? Cell::Free : random.chance(0.8) ? Cell::Occupied : Cell::Unknown;
            for (std::size_t row = low; row < std::min(map.height(), low + height); ++row)
                for (std::size_t column = left; column < std::min(map.width(), left + width); ++column)
                    update.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), cell});
        }
        return update;
    }

    void expectSameField(const DistanceField &field, const DistanceField &anew, const OccupancyGrid &map)
    {
        for (std::size_t row = 0; row < map.height(); ++row)
            for (std::size_t column = 0; column < map.width(); ++column)
            {
                const double x = (static_cast<double>(column) + 0.5) * map.resolution(),
                             y = (static_cast<double>(row) + 0.5) * map.resolution();
                ASSERT_EQ(field.upperBound(x, y), anew.upperBound(x, y)) << column << ' ' << row;
                ASSERT_EQ(field.lowerBound(x, y), anew.lowerBound(x, y)) << column << ' ' << row;
                ASSERT_EQ(field.isInside(x, y), anew.isInside(x, y)) << column << ' ' << row;
            }
    }

    Vehicle smallCar()
    {
        Vehicle car;
        car.wheelbase = 0.7;
        car.frontOverhang = car.rearOverhang = 0.2;
        car.width = 0.5;
        return car;
    }

    /** Results of every kind of check, which fill the caches of \e checker. */
    std::vector<double> resultsOf(const FootprintChecker &checker, const std::vector<Pose> &poses)
    {
        std::vector<double> results;
        for (const Pose &pose : poses)
            for (const double each : {checker.isFree(pose) ? 1.0 : 0.0, checker.clearance(pose),
                                      checker.exactClearance(pose), checker.freeLength(pose, 0.3, 2.0)})
                results.push_back(each);
        return results;
    }
}  // namespace

TEST(IndexedObstacles, ManyUpdatesEqualAWorldMadeAnew)
{
    Random random(1);
    int updates = 0;
    while (updates < 10000)
    {
        const double resolution = random.between(0.05, 0.4);
        OccupancyGrid map = randomMap(random, 1 + random.index(90), 1 + random.index(90), resolution);
        const bool unknownIsOccupied = random.chance(0.5);
        const double reach = random.chance(0.1) ? HUGE_VAL : resolution * random.between(0.5, 140.0);
        IndexedObstacles world(ObstacleSet::fromGrid(map, unknownIsOccupied), 0.0, reach);
        for (int i = 0; i < 100; ++i, ++updates)
        {
            const GridUpdate update = randomUpdate(random, map);
            map.apply(update);
            world.update(update);
            const ObstacleSet anew = ObstacleSet::fromGrid(map, unknownIsOccupied);
            ASSERT_EQ(world.obstacles().cells(), anew.cells());
            expectSameField(world.field(), DistanceField(anew, 0.0, reach), map);
            if (HasFatalFailure())
            {
                FAIL() << "update " << updates << " of a map of " << map.width() << " x " << map.height() << ", reach "
                       << reach / resolution << " cells";
            }
        }
    }
}

/** Two cells at some distance, in the same columns that are computed together and in others. */
TEST(IndexedObstacles, UpdatesOfTwoCellsEqualAWorldMadeAnew)
{
    for (std::uint32_t rows = 0; rows < 24; ++rows)
        for (const std::uint32_t column : {40, 62, 63, 64, 80})
            for (const bool isMirrored : {false, true})
            {
                OccupancyGrid map(128, 70, 0.5);
                IndexedObstacles world(ObstacleSet::fromGrid(map), 0.0, 10.0);
                const GridUpdate update{{63, isMirrored ? 25 : 25 + rows, Cell::Occupied},
                                        {column, isMirrored ? 25 + rows : 25, Cell::Occupied}};
                map.apply(update);
                world.update(update);
                expectSameField(world.field(), DistanceField(ObstacleSet::fromGrid(map), 0.0, 10.0), map);
                ASSERT_FALSE(HasFatalFailure()) << rows << ' ' << column;
            }
}

TEST(IndexedObstacles, ChecksAfterUpdatesEqualThoseOfACheckerMadeAnew)
{
    Random random(2);
    for (int world = 0; world < 30; ++world)
    {
        const double resolution = random.between(0.08, 0.4);
        OccupancyGrid map = randomMap(random, 20 + random.index(100), 20 + random.index(100), resolution);
        const double reach = random.chance(0.2) ? HUGE_VAL : random.between(0.3, 5.0);
        const auto shared = std::make_shared<IndexedObstacles>(ObstacleSet::fromGrid(map), 0.0, reach);
        const FootprintChecker body(shared, smallCar()), enlarged(shared, smallCar(), 0.2);
        EXPECT_EQ(&body.field(), &enlarged.field());
        for (int i = 0; i < 20; ++i)
        {
            std::vector<Pose> poses;
            for (int k = 0; k < 20; ++k)
                poses.push_back(
                    compose(map.origin(), {random.between(0.0, resolution * map.width()),
                                           random.between(0.0, resolution * map.height()), random.between(-PI, PI)}));
            resultsOf(body, poses);
            resultsOf(enlarged, poses);
            const GridUpdate update = randomUpdate(random, map);
            map.apply(update);
            shared->update(update);
            const auto anew = std::make_shared<IndexedObstacles>(ObstacleSet::fromGrid(map), 0.0, reach);
            ASSERT_EQ(resultsOf(body, poses), resultsOf(FootprintChecker(anew, smallCar()), poses));
            ASSERT_EQ(resultsOf(enlarged, poses), resultsOf(FootprintChecker(anew, smallCar(), 0.2), poses));
            ASSERT_EQ(shared->obstacles().edges().size(), anew->obstacles().edges().size());
            ASSERT_EQ(shared->obstacles().rectangles().size(), anew->obstacles().rectangles().size());
        }
    }
}

/** Below the reach a limited field equals the unlimited one. Beyond it only the bounds are weaker. */
TEST(IndexedObstacles, FieldWithALimitedReachKeepsItsBounds)
{
    Random random(3);
    for (int world = 0; world < 40; ++world)
    {
        const OccupancyGrid map =
            randomMap(random, 1 + random.index(300), 1 + random.index(300), random.between(0.05, 1.0));
        const ObstacleSet obstacles = ObstacleSet::fromGrid(map);
        const double cells = random.between(0.2, 150.0);
        const DistanceField whole(obstacles), limited(obstacles, 0.0, cells * map.resolution());
        const double expected = std::min(127.0, std::max(1.0, std::floor(cells))) * map.resolution();
        EXPECT_NEAR(limited.reach(), expected, 1e-6 * expected);
        for (int i = 0; i < 3000; ++i)
        {
            const double x = random.between(-1.0, map.width() * map.resolution() + 1.0),
                         y = random.between(-1.0, map.height() * map.resolution() + 1.0);
            const double far = limited.reach() + limited.errorBound();
            if (whole.upperBound(x, y) < far)
            {
                ASSERT_EQ(limited.lowerBound(x, y), whole.lowerBound(x, y));
                ASSERT_EQ(limited.upperBound(x, y), whole.upperBound(x, y));
                ASSERT_EQ(limited.closeUpperBound(x, y), whole.closeUpperBound(x, y));
                continue;
            }
            ASSERT_NEAR(limited.lowerBound(x, y), std::max(0.0, limited.reach() - limited.errorBound()),
                        2e-7 * limited.reach());
            ASSERT_LE(limited.lowerBound(x, y), whole.lowerBound(x, y));
            // The outside of the map is an obstacle, so the true distance is at most this.
            ASSERT_GE(limited.upperBound(x, y),
                      std::min({x, y, map.width() * map.resolution() - x, map.height() * map.resolution() - y}));
            ASSERT_GE(limited.closeUpperBound(x, y), whole.lowerBound(x, y));
            ASSERT_LT(limited.upperBound(x, y), HUGE_VAL);
        }
    }
}

TEST(IndexedObstacles, ContactTestIsMadeAgainAfterAnUpdate)
{
    OccupancyGrid map(40, 40, 0.25);
    map.set(5, 20, Cell::Occupied);
    const auto world = std::make_shared<IndexedObstacles>(ObstacleSet::fromGrid(map), 0.0, 4.0);
    std::vector<std::size_t> made;
    const FootprintChecker checker(world, smallCar(), 0.0,
                                   [&made](const ObstacleSet &obstacles, const Body &) -> ContactTest
                                   {
                                       made.push_back(obstacles.rectangles().size());
                                       return [](const OrientedBox &)
                                       {
                                           return false;
                                       };
                                   });
    // The rear bumper is 0.7 nm from the cell.
    const Pose near{1.5 + 0.2 + 0.7e-9, 5.125, 0.0};
    EXPECT_TRUE(checker.isFree(near));
    EXPECT_TRUE(checker.isFree(near));
    EXPECT_EQ(made, std::vector<std::size_t>{1});
    world->update({{30, 30, Cell::Occupied}});
    EXPECT_TRUE(checker.isFree(near));
    EXPECT_EQ(made, (std::vector<std::size_t>{1, 2}));
    world->update({{30, 30, Cell::Occupied}});  // changes nothing
    EXPECT_TRUE(checker.isFree(near));
    EXPECT_EQ(made.size(), 2u);
    world->update({{6, 20, Cell::Occupied}});
    EXPECT_FALSE(checker.isFree(near));
}

TEST(IndexedObstacles, CopyDoesNotChangeWithItsSource)
{
    const auto world = std::make_shared<IndexedObstacles>(ObstacleSet::fromGrid(OccupancyGrid(40, 40, 0.25)), 0.0, 2.0);
    const std::shared_ptr<IndexedObstacles> copy = world->copy();
    const FootprintChecker ofWorld(world, smallCar()), ofCopy(copy, smallCar());
    const Pose middle{5.0, 5.0, 0.0};
    world->update({{20, 20, Cell::Occupied}});
    EXPECT_FALSE(ofWorld.isFree(middle));
    EXPECT_TRUE(ofCopy.isFree(middle));
    EXPECT_TRUE(copy->obstacles().rectangles().empty());
    EXPECT_EQ(world->obstacles().rectangles().size(), 1u);
    EXPECT_EQ(world->version(), 1u);
    EXPECT_EQ(copy->version(), 0u);
}

TEST(IndexedObstacles, RefusesBadInputAndChangesNothing)
{
    IndexedObstacles world(ObstacleSet::fromGrid(OccupancyGrid(10, 20, 0.5)), 0.0, 4.0);
    for (const CellChange &bad : {CellChange{10, 0, Cell::Free}, CellChange{0, 20, Cell::Occupied},
                                  CellChange{4294967295u, 0, Cell::Free}, CellChange{0, 0, static_cast<Cell>(3)}})
    {
        EXPECT_THROW(world.update({{9, 19, Cell::Occupied}, bad}), Error);
        EXPECT_EQ(world.obstacles().cells(), std::vector<std::uint8_t>(200, 0));
        EXPECT_EQ(world.version(), 0u);
    }
    world.update({{9, 19, Cell::Occupied}});
    EXPECT_EQ(world.obstacles().cells().back(), 1);
    EXPECT_EQ(world.version(), 1u);

    IndexedObstacles polygons(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {9.0, 9.0}}));
    EXPECT_THROW(polygons.update({{0, 0, Cell::Occupied}}), Error);
    for (const double reach : {0.0, -1.0, std::nan("")})
        EXPECT_THROW(IndexedObstacles(ObstacleSet::fromGrid(OccupancyGrid(9, 9, 0.5)), 0.0, reach), Error);
}
