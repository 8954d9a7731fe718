#pragma once

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Scenario.h"
#include "state_validity/ObstacleSet.h"

#include <cstdint>
#include <string>
#include <vector>

namespace parking_test
{
    /** \brief A world with its reference checker. */
    struct World
    {
        /** \brief Polygons within \e box. */
        World(const std::string &kind, const std::vector<parking::Polygon> &polygons, const parking::Box &box);

        /** \brief A grid with an occupied outside. */
        World(const std::string &kind, const parking::OccupancyGrid &grid);

        /** \brief The obstacles of the scenario: a grid, or polygons within its bounds. */
        explicit World(parking::Scenario scenario);

        parking::Scenario scenario;         ///< name, obstacles, bounds and car; start and goal are not set
        std::string name;                   ///< kind and seed
        parking::ObstacleSet obstacles;     ///< obstacles as input of the tested code
        PolygonOracle oracle;               ///< reference checker of the world
        parking::Box bounds;                ///< a box round the free world, in the coordinates of the poses
        std::vector<parking::Edge> edges;   ///< outlines (of cells: diagonals), for poses that touch them
        std::vector<parking::Pose> places;  ///< poses to park at: in slots and bays, free or not

        /** \brief A random pose in the world. */
        parking::Pose anywhere(Random &random) const;

        /** \brief A pose whose outline is close to an obstacle's: random points of both are at most \e off metres apart
            in a random direction. */
        parking::Pose touching(Random &random, const parking::Vehicle &vehicle, double off) const;
    };

    /** \brief A rectangle of \e length by \e width metres round \e pose, along its heading. */
    parking::Polygon rectangle(double length, double width, const parking::Pose &pose);

    /** \brief A polygon round (x, y), whose corners are in angular order at any distance: rarely convex. */
    parking::Polygon star(Random &random, double x, double y, double largest);

    /** \brief A slot with a wall on three sides, as one polygon that is not convex. */
    parking::Polygon bay(double length, double width, const parking::Pose &pose);

    /** \brief Parked cars, debris, bays, thin walls and posts of a centimetre in a box of 30 m, round \e offset. */
    World randomPolygonWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0});

    /** \brief A grid with single occupied cells, walls one cell thick and blocks, rotated round \e offset. */
    World randomGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0});

    /** \brief A grid like a sensor's: walls with gaps, and single cells scattered over free space. */
    World noisyGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0});

    /** \brief Two rows of cars like \e car on 30 m with a lane between them, or one row and a wall; gaps are places to
        park. */
    World parkingRowsWorld(std::uint64_t seed, const parking::Vehicle &car);

    /** \brief One or two bays on 30 m, each slightly larger than \e car, which is to be parked there. */
    World baysWorld(std::uint64_t seed, const parking::Vehicle &car);

    /** \brief One or two walls across 30 m, each with an opening, which may be too narrow. */
    World lanesWorld(std::uint64_t seed);
}  // namespace parking_test
