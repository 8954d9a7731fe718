#include "benchmarks/worlds/RandomWorlds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace parking_test
{
    using namespace parking;

    namespace
    {
        Scenario scenarioOf(const std::string &name, const std::vector<Polygon> &polygons, const Box &box)
        {
            Scenario scenario;
            scenario.name = name;
            scenario.polygons = polygons;
            scenario.bounds = box;
            return scenario;
        }

        Scenario scenarioOf(const std::string &name, const OccupancyGrid &grid)
        {
            Scenario scenario;
            scenario.name = name;
            scenario.grid = grid;
            const std::vector<Eigen::Vector2d> outline = grid.outline();
            scenario.bounds = {outline.front(), outline.front()};
            for (const Eigen::Vector2d &corner : outline)
                scenario.bounds.include(corner);
            return scenario;
        }

        Eigen::Vector2d pointAt(const Pose &frame, double x, double y)
        {
            const Pose pose = compose(frame, {x, y, 0.0});
            return {pose.x, pose.y};
        }

        void occupy(OccupancyGrid &grid, Random &random, std::size_t width, std::size_t height)
        {
            const std::size_t column = random.index(grid.width()), row = random.index(grid.height());
            for (std::size_t j = row; j < std::min(grid.height(), row + height); ++j)
                for (std::size_t i = column; i < std::min(grid.width(), column + width); ++i)
                    grid.set(i, j, random.chance(0.1) ? Cell::Unknown : Cell::Occupied);
        }

        /** The pose of a car whose body has its centre at \e middle. */
        Pose axleAt(const Pose &middle, const Vehicle &car)
        {
            return compose(middle, {car.rearOverhang - 0.5 * car.length(), 0.0, 0.0});
        }

        constexpr double REACH = 15.0;  // metres, half the side of worlds with slots

        World parkingWorld(const std::string &kind, std::uint64_t seed, const std::vector<Polygon> &polygons)
        {
            return {kind + " " + std::to_string(seed), polygons, {{-REACH, -REACH}, {REACH, REACH}}};
        }
    }  // namespace

    World::World(const std::string &kind, const std::vector<Polygon> &polygons, const Box &box)
      : World(scenarioOf(kind, polygons, box))
    {
    }

    World::World(const std::string &kind, const OccupancyGrid &grid) : World(scenarioOf(kind, grid))
    {
    }

    World::World(Scenario made)
      : scenario(std::move(made)),
        name(scenario.name),
        obstacles(ObstacleSet::fromScenario(scenario)),
        oracle(scenario),
        bounds(scenario.bounds)
    {
        if (!scenario.grid)
        {
            for (const Polygon &polygon : scenario.polygons)
                for (std::size_t i = 0; i < polygon.size(); ++i)
                    edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
            const Eigen::Vector2d &a = bounds.min, &c = bounds.max;
            edges.push_back({a, {c.x(), a.y()}});
            edges.push_back({c, {a.x(), c.y()}});
            return;
        }
        const OccupancyGrid &grid = *scenario.grid;
        const auto corner = [&grid](std::size_t column, std::size_t row)
        {
            return pointAt(grid.origin(), static_cast<double>(column) * grid.resolution(),
                           static_cast<double>(row) * grid.resolution());
        };
        for (std::size_t row = 0; row < grid.height(); ++row)
            for (std::size_t column = 0; column < grid.width(); ++column)
                if (grid.at(column, row) != Cell::Free)
                    edges.push_back({corner(column, row), corner(column + 1, row + 1)});
    }

    Pose World::anywhere(Random &random) const
    {
        return {random.between(bounds.min.x(), bounds.max.x()), random.between(bounds.min.y(), bounds.max.y()),
                random.between(-PI, PI)};
    }

    Pose World::touching(Random &random, const Vehicle &vehicle, double off) const
    {
        const Edge &edge = edges[random.index(edges.size())];
        const double t = random.chance(0.4) ? static_cast<double>(random.index(2)) : random.between(0.0, 1.0);
        const double direction = random.between(-PI, PI);
        const Eigen::Vector2d at =
            edge.from + t * (edge.to - edge.from) + off * Eigen::Vector2d(std::cos(direction), std::sin(direction));
        double yaw = random.between(-PI, PI);
        if (random.chance(0.3))  // side along side
            yaw = std::atan2(edge.to.y() - edge.from.y(), edge.to.x() - edge.from.x());
        const auto corners = vehicle.footprint({0.0, 0.0, yaw});
        const std::size_t side = random.index(corners.size());
        const double along = random.chance(0.3) ? 0.0 : random.between(0.0, 1.0);
        const Eigen::Vector2d place = corners[side] + along * (corners[(side + 1) % corners.size()] - corners[side]);
        return {at.x() - place.x(), at.y() - place.y(), yaw};
    }

    Polygon rectangle(double length, double width, const Pose &pose)
    {
        Polygon polygon;
        for (const auto &[x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
            polygon.push_back(pointAt(pose, x * length, y * width));
        return polygon;
    }

    Polygon star(Random &random, double x, double y, double largest)
    {
        Polygon polygon;
        const std::size_t corners = 3 + random.index(8);
        const double turned = random.between(0.0, 2.0 * PI);
        for (std::size_t i = 0; i < corners; ++i)
        {
            const double angle =
                turned + 2.0 * PI * (static_cast<double>(i) + random.between(0.0, 0.6)) / static_cast<double>(corners);
            const double radius = largest * random.between(0.3, 1.0);
            polygon.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
        }
        return polygon;
    }

    Polygon bay(double length, double width, const Pose &pose)
    {
        const double l = 0.5 * length, w = 0.5 * width, t = 0.3;
        Polygon polygon;
        for (const auto &[x, y] :
             {std::pair{-l - t, -w - t}, {l, -w - t}, {l, -w}, {-l, -w}, {-l, w}, {l, w}, {l, w + t}, {-l - t, w + t}})
            polygon.push_back(pointAt(pose, x, y));
        return polygon;
    }

    World randomPolygonWorld(std::uint64_t seed, const Eigen::Vector2d &offset)
    {
        Random random(seed);
        std::vector<Polygon> polygons;
        const auto place = [&random]
        {
            return Pose{random.between(-14.0, 14.0), random.between(-14.0, 14.0),
                        random.chance(0.4) ? 0.5 * PI * static_cast<double>(random.index(4)) : random.between(-PI, PI)};
        };
        for (std::size_t i = 0; i < 5; ++i)
            polygons.push_back(rectangle(4.7, 1.9, place()));
        for (std::size_t i = 0; i < 4; ++i)
        {
            const Pose pose = place();
            polygons.push_back(star(random, pose.x, pose.y, random.between(0.2, 2.5)));
        }
        polygons.push_back(bay(5.5, 2.5, place()));
        for (std::size_t i = 0; i < 2; ++i)
        {
            const double length = random.between(2.0, 12.0), width = random.between(0.002, 0.02);
            polygons.push_back(rectangle(length, width, place()));
        }
        for (std::size_t i = 0; i < 4; ++i)
            polygons.push_back(rectangle(0.01, 0.01, place()));
        for (Polygon &polygon : polygons)
        {
            for (Eigen::Vector2d &corner : polygon)
                corner += offset;
            if (random.chance(0.5))
                std::reverse(polygon.begin(), polygon.end());
        }
        const Eigen::Vector2d reach = Eigen::Vector2d::Constant(15.0);
        return {"polygons " + std::to_string(seed), polygons, {offset - reach, offset + reach}};
    }

    World randomGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset)
    {
        Random random(seed);
        const double resolution = std::array<double, 4>{0.05, 0.1, 0.2, 0.5}[random.index(4)];
        const auto side = static_cast<std::size_t>(20.0 / resolution);
        const double yaw = random.chance(0.5) ? 0.0 : random.between(-PI, PI);
        OccupancyGrid grid(side, side, resolution, {offset.x(), offset.y(), yaw});
        for (std::size_t i = 0; i < 8; ++i)
            occupy(grid, random, 1, 1);
        for (std::size_t i = 0; i < 2; ++i)
            occupy(grid, random, 1 + random.index(side / 4), 1);
        for (std::size_t i = 0; i < 2; ++i)
        {
            const std::size_t width = 1 + random.index(side / 6);
            occupy(grid, random, width, 1 + random.index(side / 6));
        }
        return {"grid " + std::to_string(seed), grid};
    }

    World noisyGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset)
    {
        Random random(seed);
        constexpr double RESOLUTION = 0.1;
        constexpr std::size_t SIDE = 200;
        OccupancyGrid grid(SIDE, SIDE, RESOLUTION, {offset.x(), offset.y(), random.between(-3.0, 3.0)});
        const double strewn = random.between(5e-5, 5e-4);
        for (std::size_t i = 0; i < static_cast<std::size_t>(strewn * SIDE * SIDE); ++i)
        {
            const std::size_t column = random.index(SIDE);
            grid.set(column, random.index(SIDE), Cell::Occupied);
        }
        for (std::size_t wall = 0; wall < 3; ++wall)
        {
            const std::size_t at = random.index(SIDE - 2), begin = random.index(SIDE), length = random.index(SIDE / 2);
            const bool upright = random.chance(0.5);
            for (std::size_t k = begin; k < std::min(SIDE, begin + length); ++k)
                for (std::size_t t = at; t < at + 3; ++t)
                    if (random.chance(0.4))
                        grid.set(upright ? t : k, upright ? k : t, Cell::Occupied);
        }
        return {"noisy grid " + std::to_string(seed), grid};
    }

    World parkingRowsWorld(std::uint64_t seed, const Vehicle &car)
    {
        Random random(seed);
        const bool along = random.chance(0.5);
        const double gap = random.between(0.3, 1.0), deep = along ? car.width : car.length();
        const double wide = along ? car.length() + 2.0 * gap : car.width + gap;
        const double slanted = along ? 0.0 : random.chance(0.3) ? PI / 4.0 : 0.5 * PI;
        const double lane = random.between(3.5, 7.0) + (along ? 0.0 : 1.5);
        std::vector<Polygon> polygons;
        std::vector<Pose> places;
        for (const double y : {-0.5 * (deep + lane), 0.5 * (deep + lane)})
        {
            if (y > 0.0 && random.chance(0.5))
            {
                polygons.push_back(rectangle(2.0 * REACH, 0.2, {0.0, 0.5 * lane, 0.0}));
                continue;
            }
            for (double x = -REACH + wide; x < REACH - wide; x += wide)
            {
                const double yaw = slanted + (random.chance(0.5) ? 0.0 : PI);
                if (random.chance(0.4))
                {
                    places.push_back(axleAt({x, y, wrapAngle(yaw)}, car));
                    continue;
                }
                const double aside = random.between(-0.1, 0.1), askew = random.between(-0.03, 0.03);
                polygons.push_back(rectangle(car.length(), car.width, {x, y + aside, yaw + askew}));
            }
        }
        World world = parkingWorld("rows", seed, polygons);
        world.places = places;
        return world;
    }

    World baysWorld(std::uint64_t seed, const Vehicle &car)
    {
        Random random(seed);
        std::vector<Polygon> polygons;
        std::vector<Pose> places;
        for (std::size_t left = 1 + random.index(2); left > 0; --left)
        {
            const Pose at = random.poseIn(-0.5 * REACH, 0.5 * REACH);
            const double length = car.length() + random.between(0.1, 1.0);
            polygons.push_back(bay(length, car.width + random.between(0.1, 0.9), at));
            for (const double turned : {0.0, PI})
                places.push_back(axleAt(compose(at, {0.0, 0.0, turned}), car));
        }
        World world = parkingWorld("bays", seed, polygons);
        world.places = places;
        return world;
    }

    World lanesWorld(std::uint64_t seed)
    {
        Random random(seed);
        std::vector<Polygon> polygons;
        const std::size_t walls = 1 + random.index(2);
        for (std::size_t i = 1; i <= walls; ++i)
        {
            const double x = REACH * (2.0 * static_cast<double>(i) / static_cast<double>(walls + 1) - 1.0);
            const double width = random.between(2.2, 6.0), thick = random.between(0.05, 0.5);
            const double low = random.between(0.15, 0.85) * (2.0 * REACH - width), high = 2.0 * REACH - width - low;
            polygons.push_back(rectangle(thick, low, {x, 0.5 * low - REACH, 0.0}));
            polygons.push_back(rectangle(thick, high, {x, REACH - 0.5 * high, 0.0}));
        }
        return parkingWorld("lanes", seed, polygons);
    }
}  // namespace parking_test
