#include "benchmarks/studies/reliability/SoakWorlds.h"

#include "benchmarks/worlds/RandomWorlds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace parking
{
    using parking_test::Random;

    namespace
    {
        std::vector<Polygon> strewnPolygons(Random &random, std::size_t most, double reach)
        {
            std::vector<Polygon> polygons;
            for (std::size_t left = random.index(most + 1); left > 0; --left)
            {
                const Pose at{
                    random.between(-reach, reach), random.between(-reach, reach),
                    random.chance(0.4) ? 0.5 * PI * static_cast<double>(random.index(4)) : random.between(-PI, PI)};
                switch (random.index(5))
                {
                    case 0:
                        polygons.push_back(parking_test::star(random, at.x, at.y, random.between(0.2, 2.5)));
                        break;
                    case 1:
                        polygons.push_back(parking_test::bay(5.5, 2.5, at));
                        break;
                    case 2:
                        polygons.push_back(
                            parking_test::rectangle(random.between(1.0, 10.0), random.between(0.002, 0.2), at));
                        break;
                    default:
                        polygons.push_back(parking_test::rectangle(4.7, 1.9, at));
                }
            }
            return polygons;
        }

        OccupancyGrid emptyGrid(Random &random, double resolution, double reach)
        {
            const auto side = static_cast<std::size_t>(2.0 * reach / resolution);
            return {side, side, resolution, {-reach, -reach, random.chance(0.7) ? 0.0 : random.between(-0.3, 0.3)}};
        }

        OccupancyGrid gridOfBlocks(Random &random, double reach)
        {
            OccupancyGrid grid = emptyGrid(random, std::array<double, 3>{0.1, 0.2, 0.5}[random.index(3)], reach);
            const std::size_t side = grid.width();
            for (std::size_t left = random.index(12); left > 0; --left)
            {
                const std::size_t column = random.index(side), row = random.index(side);
                const std::size_t width = 1 + random.index(side / 8), height = 1 + random.index(side / 8);
                for (std::size_t j = row; j < std::min(side, row + height); ++j)
                    for (std::size_t i = column; i < std::min(side, column + width); ++i)
                        grid.set(i, j, random.chance(0.1) ? Cell::Unknown : Cell::Occupied);
            }
            return grid;
        }

        /** Walls in flecks, and single cells strewn over what is free. */
        OccupancyGrid perceivedGrid(Random &random, double reach)
        {
            OccupancyGrid grid = emptyGrid(random, 0.2, reach);
            const std::size_t side = grid.width();
            for (std::size_t left = random.index(6); left > 0; --left)
                grid.set(random.index(side), random.index(side), Cell::Occupied);
            for (std::size_t wall = random.index(3); wall > 0; --wall)
            {
                const std::size_t at = random.index(side), begin = random.index(side), end = begin + side / 3;
                const bool upright = random.chance(0.5);
                for (std::size_t k = begin; k < std::min(side, end); ++k)
                    if (random.chance(0.5))
                        grid.set(upright ? at : k, upright ? k : at, Cell::Occupied);
            }
            return grid;
        }

        Box boxRound(const OccupancyGrid &grid)
        {
            const std::vector<Eigen::Vector2d> outline = grid.outline();
            Box box{outline.front(), outline.front()};
            for (const Eigen::Vector2d &corner : outline)
                box.include(corner);
            return box;
        }

        void takeGrid(SoakWorld &world, OccupancyGrid grid)
        {
            world.scenario.bounds = boxRound(grid);
            world.scenario.grid = std::move(grid);
        }

        void takePolygons(SoakWorld &world, std::vector<Polygon> polygons, double reach)
        {
            world.scenario.polygons = std::move(polygons);
            world.scenario.bounds = {{-reach, -reach}, {reach, reach}};
        }

        /** The rear axle of a car whose body lies round \e middle. */
        Pose axleAt(const Pose &middle, const Vehicle &car)
        {
            return compose(middle, {car.rearOverhang - 0.5 * car.length(), 0.0, 0.0});
        }

        /** A row of cars along y = 0, some of them missing, perhaps a second one or a wall on the other side of the
            lane. */
        void makeRows(SoakWorld &world, Random &random, double reach)
        {
            const Vehicle &car = world.scenario.vehicle;
            const bool along = random.chance(0.5);
            const double gap = random.between(0.3, 1.0), deep = along ? car.width : car.length();
            const double wide = along ? car.length() + 2.0 * gap : car.width + gap;
            const double slanted = along ? 0.0 : random.chance(0.3) ? PI / 4.0 : 0.5 * PI;
            const double lane = random.between(3.5, 7.0) + (along ? 0.0 : 1.5);
            std::vector<Polygon> polygons;
            for (const double side : {-0.5, 0.5})
            {
                if (side > 0.0 && random.chance(0.5))
                {
                    polygons.push_back(parking_test::rectangle(2.0 * reach, 0.2, {0.0, 0.5 * deep + lane, 0.0}));
                    continue;
                }
                const double y = side < 0.0 ? 0.0 : deep + lane;
                for (double x = -reach + wide; x < reach - wide; x += wide)
                {
                    const double yaw = slanted + (random.chance(0.5) ? 0.0 : PI);
                    if (random.chance(0.6))
                        polygons.push_back(parking_test::rectangle(
                            car.length(), car.width,
                            {x, y + random.between(-0.1, 0.1), yaw + random.between(-0.03, 0.03)}));
                    else
                        world.places.push_back(axleAt({x, y, wrapAngle(yaw)}, car));
                }
            }
            takePolygons(world, std::move(polygons), reach);
        }

        void makeBays(SoakWorld &world, Random &random, double reach)
        {
            const Vehicle &car = world.scenario.vehicle;
            std::vector<Polygon> polygons;
            for (std::size_t left = 1 + random.index(2); left > 0; --left)
            {
                const Pose at{random.between(-0.5, 0.5) * reach, random.between(-0.5, 0.5) * reach,
                              random.between(-PI, PI)};
                const double length = car.length() + random.between(0.1, 1.0);
                polygons.push_back(parking_test::bay(length, car.width + random.between(0.1, 0.9), at));
                for (const double turned : {0.0, PI})
                    world.places.push_back(axleAt(compose(at, {0.0, 0.0, turned}), car));
            }
            takePolygons(world, std::move(polygons), reach);
        }

        /** Walls across, each with an opening. */
        void makeLanes(SoakWorld &world, Random &random, double reach)
        {
            std::vector<Polygon> polygons;
            const std::size_t walls = 1 + random.index(2);
            for (std::size_t i = 1; i <= walls; ++i)
            {
                const double x = reach * (2.0 * static_cast<double>(i) / static_cast<double>(walls + 1) - 1.0);
                const double open = random.between(-0.7, 0.7) * reach, width = random.between(2.2, 6.0);
                const double below = open - 0.5 * width + reach, above = reach - open - 0.5 * width;
                const double thick = random.between(0.05, 0.5);
                if (below > 0.1)
                    polygons.push_back(parking_test::rectangle(thick, below, {x, -reach + 0.5 * below, 0.0}));
                if (above > 0.1)
                    polygons.push_back(parking_test::rectangle(thick, above, {x, reach - 0.5 * above, 0.0}));
            }
            takePolygons(world, std::move(polygons), reach);
        }

        SoakWorld withCar(Random &random)
        {
            SoakWorld world;
            world.scenario.name = "random";
            if (random.chance(0.3))
            {
                const std::vector<std::string> names = vehicleNames();
                world.scenario.vehicle = vehicleByName(names[random.index(names.size())]);
            }
            return world;
        }
    }  // namespace

    SoakWorld soakWorld(Random &random)
    {
        constexpr double REACH = 25.0;
        SoakWorld world = withCar(random);
        if (random.chance(0.4))
            takeGrid(world, gridOfBlocks(random, REACH));
        else
            takePolygons(world, strewnPolygons(random, 16, REACH - 3.0), REACH);
        return world;
    }

    SoakWorld smallSoakWorld(Random &random)
    {
        constexpr double REACH = 15.0, REACH_OF_GRIDS = 10.0;
        SoakWorld world = withCar(random);
        switch (random.index(6))
        {
            case 0:
                makeRows(world, random, REACH);
                break;
            case 1:
                makeBays(world, random, REACH);
                break;
            case 2:
                makeLanes(world, random, REACH);
                break;
            case 3:
                takeGrid(world, gridOfBlocks(random, REACH_OF_GRIDS));
                break;
            case 4:
                takeGrid(world, perceivedGrid(random, REACH_OF_GRIDS));
                break;
            default:
                takePolygons(world, strewnPolygons(random, 5, REACH - 3.0), REACH);
        }
        return world;
    }
}  // namespace parking
