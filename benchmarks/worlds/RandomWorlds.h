#pragma once

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "state_validity/ObstacleSet.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace parking_test
{
    /** \brief A world with the oracle that judges it. */
    struct World
    {
        /** \brief Polygons within \e box. */
        World(std::string worldName, const std::vector<parking::Polygon> &polygons, const parking::Box &box)
          : name(std::move(worldName)),
            obstacles(parking::ObstacleSet::fromPolygons(polygons, box)),
            oracle(polygons, box),
            bounds(box)
        {
            for (const parking::Polygon &polygon : polygons)
                for (std::size_t i = 0; i < polygon.size(); ++i)
                    edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
            const Eigen::Vector2d &a = box.min, &c = box.max;
            edges.push_back({a, {c.x(), a.y()}});
            edges.push_back({c, {a.x(), c.y()}});
        }

        /** \brief A grid, outside of which nothing is free. */
        World(std::string worldName, const parking::OccupancyGrid &grid)
          : name(std::move(worldName)),
            obstacles(parking::ObstacleSet::fromGrid(grid)),
            oracle(grid)
        {
            const std::vector<Eigen::Vector2d> outline = grid.outline();
            bounds.min = bounds.max = outline.front();
            for (const Eigen::Vector2d &corner : outline)
                bounds.include(corner);
            const double size = grid.resolution();
            const auto corner = [&grid, size](std::size_t column, std::size_t row)
            {
                const parking::Pose pose =
                    compose(grid.origin(), {static_cast<double>(column) * size, static_cast<double>(row) * size, 0.0});
                return Eigen::Vector2d(pose.x, pose.y);
            };
            for (std::size_t row = 0; row < grid.height(); ++row)
                for (std::size_t column = 0; column < grid.width(); ++column)
                    if (grid.at(column, row) != parking::Cell::Free)
                        edges.push_back({corner(column, row), corner(column + 1, row + 1)});
        }

        std::string name;                  ///< kind and seed
        parking::ObstacleSet obstacles;    ///< as what is tested sees them
        PolygonOracle oracle;              ///< says what is right
        parking::Box bounds;               ///< a box round the free world, in the coordinates of the poses
        std::vector<parking::Edge> edges;  ///< outlines (of cells: diagonals), to make poses that touch them

        /** \brief A pose anywhere in the world. */
        parking::Pose anywhere(Random &random) const
        {
            return {random.between(bounds.min.x(), bounds.max.x()), random.between(bounds.min.y(), bounds.max.y()),
                    random.between(-parking::PI, parking::PI)};
        }

        /** \brief A pose with a random place of the body's outline at a random place of an obstacle's, up to \e off
            metres away from it in a random direction. */
        parking::Pose touching(Random &random, const parking::Vehicle &vehicle, double off) const
        {
            const parking::Edge &edge = edges[random.index(edges.size())];
            const double t = random.chance(0.4) ? static_cast<double>(random.index(2)) : random.between(0.0, 1.0);
            const double direction = random.between(-parking::PI, parking::PI);
            const Eigen::Vector2d at =
                edge.from + t * (edge.to - edge.from) + off * Eigen::Vector2d(std::cos(direction), std::sin(direction));
            double yaw = random.between(-parking::PI, parking::PI);
            if (random.chance(0.3))  // side along side
                yaw = std::atan2(edge.to.y() - edge.from.y(), edge.to.x() - edge.from.x());
            const auto corners = vehicle.footprint({0.0, 0.0, yaw});
            const std::size_t side = random.index(4);
            const double along = random.chance(0.3) ? 0.0 : random.between(0.0, 1.0);
            const Eigen::Vector2d place = corners[side] + along * (corners[(side + 1) % 4] - corners[side]);
            return {at.x() - place.x(), at.y() - place.y(), yaw};
        }
    };

    /** \brief A rectangle of \e length by \e width metres round \e pose, along its heading. */
    inline parking::Polygon rectangle(double length, double width, const parking::Pose &pose)
    {
        parking::Polygon polygon;
        for (const auto &[x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        {
            const parking::Pose corner = compose(pose, {x * length, y * width, 0.0});
            polygon.emplace_back(corner.x, corner.y);
        }
        return polygon;
    }

    /** \brief A polygon round (x, y), its corners seen from there in order but at any distance: rarely convex. */
    inline parking::Polygon star(Random &random, double x, double y, double largest)
    {
        parking::Polygon polygon;
        const std::size_t corners = 3 + random.index(7);
        const double turned = random.between(0.0, 2.0 * parking::PI);
        for (std::size_t i = 0; i < corners; ++i)
        {
            const double angle = turned + 2.0 * parking::PI * (static_cast<double>(i) + random.between(0.0, 0.7)) /
                                              static_cast<double>(corners);
            const double radius = largest * random.between(0.25, 1.0);
            polygon.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
        }
        return polygon;
    }

    /** \brief A slot with a wall on three sides, as one polygon that is not convex. */
    inline parking::Polygon bay(double length, double width, const parking::Pose &pose)
    {
        const double l = 0.5 * length, w = 0.5 * width, t = 0.3;
        parking::Polygon polygon;
        for (const auto &[x, y] :
             {std::pair{-l - t, -w - t}, {l, -w - t}, {l, -w}, {-l, -w}, {-l, w}, {l, w}, {l, w + t}, {-l - t, w + t}})
        {
            const parking::Pose corner = compose(pose, {x, y, 0.0});
            polygon.emplace_back(corner.x, corner.y);
        }
        return polygon;
    }

    /** \brief Parked cars, debris, bays, thin walls and posts of a centimetre in a box of 30 m, round \e offset. */
    inline World randomPolygonWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0})
    {
        Random random(seed);
        std::vector<parking::Polygon> polygons;
        const auto place = [&random]
        {
            return parking::Pose{random.between(-14.0, 14.0), random.between(-14.0, 14.0),
                                 random.chance(0.4) ? 0.5 * parking::PI * static_cast<double>(random.index(4))
                                                    : random.between(-parking::PI, parking::PI)};
        };
        for (std::size_t i = 0; i < 5; ++i)
            polygons.push_back(rectangle(4.7, 1.9, place()));
        for (std::size_t i = 0; i < 4; ++i)
        {
            const parking::Pose pose = place();
            polygons.push_back(star(random, pose.x, pose.y, random.between(0.2, 2.5)));
        }
        polygons.push_back(bay(5.5, 2.5, place()));
        for (std::size_t i = 0; i < 2; ++i)
            polygons.push_back(rectangle(random.between(2.0, 12.0), random.between(0.002, 0.02), place()));
        for (std::size_t i = 0; i < 4; ++i)
            polygons.push_back(rectangle(0.01, 0.01, place()));
        for (parking::Polygon &polygon : polygons)
        {
            for (Eigen::Vector2d &corner : polygon)
                corner += offset;
            if (random.chance(0.5))
                std::reverse(polygon.begin(), polygon.end());
        }
        return {"polygons " + std::to_string(seed),
                polygons,
                {offset - Eigen::Vector2d(15.0, 15.0), offset + Eigen::Vector2d(15.0, 15.0)}};
    }

    /** \brief A grid with single occupied cells, walls one cell thick and blocks; turned round \e offset. */
    inline World randomGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0})
    {
        Random random(seed);
        const double resolution = std::vector<double>{0.05, 0.1, 0.2, 0.5}[random.index(4)];
        const auto side = static_cast<std::size_t>(20.0 / resolution);
        const double yaw = random.chance(0.5) ? 0.0 : random.between(-parking::PI, parking::PI);
        parking::OccupancyGrid grid(side, side, resolution, {offset.x(), offset.y(), yaw});
        const auto fill = [&](std::size_t column, std::size_t row, std::size_t width, std::size_t height)
        {
            for (std::size_t j = row; j < std::min(side, row + height); ++j)
                for (std::size_t i = column; i < std::min(side, column + width); ++i)
                    grid.set(i, j, random.chance(0.1) ? parking::Cell::Unknown : parking::Cell::Occupied);
        };
        for (std::size_t i = 0; i < 8; ++i)
            fill(random.index(side), random.index(side), 1, 1);
        for (std::size_t i = 0; i < 2; ++i)
            fill(random.index(side), random.index(side), 1 + random.index(side / 4), 1);
        for (std::size_t i = 0; i < 2; ++i)
            fill(random.index(side), random.index(side), 1 + random.index(side / 6), 1 + random.index(side / 6));
        return {"grid " + std::to_string(seed), grid};
    }

    /** \brief A grid as a sensor leaves it: walls in flecks, and single cells strewn over what is free. */
    inline World noisyGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0})
    {
        Random random(seed);
        constexpr double RESOLUTION = 0.1;
        constexpr std::size_t SIDE = 200;
        parking::OccupancyGrid grid(SIDE, SIDE, RESOLUTION, {offset.x(), offset.y(), random.between(-3.0, 3.0)});
        const double strewn = random.between(5e-5, 5e-4);
        for (std::size_t i = 0; i < static_cast<std::size_t>(strewn * SIDE * SIDE); ++i)
            grid.set(random.index(SIDE), random.index(SIDE), parking::Cell::Occupied);
        for (std::size_t wall = 0; wall < 3; ++wall)
        {
            const std::size_t at = random.index(SIDE - 2), begin = random.index(SIDE), length = random.index(SIDE / 2);
            const bool upright = random.chance(0.5);
            for (std::size_t k = begin; k < std::min(SIDE, begin + length); ++k)
                for (std::size_t t = at; t < at + 3; ++t)
                    if (random.chance(0.4))
                        grid.set(upright ? t : k, upright ? k : t, parking::Cell::Occupied);
        }
        return {"noisy grid " + std::to_string(seed), grid};
    }
}  // namespace parking_test
