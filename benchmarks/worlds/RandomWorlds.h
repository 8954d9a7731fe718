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
    /** \brief A world with the oracle that judges it. */
    struct World
    {
        /** \brief Polygons within \e box. */
        World(const std::string &kind, const std::vector<parking::Polygon> &polygons, const parking::Box &box);

        /** \brief A grid, outside of which nothing is free. */
        World(const std::string &kind, const parking::OccupancyGrid &grid);

        /** \brief What the scenario has: a grid, or polygons within its bounds. */
        explicit World(parking::Scenario scenario);

        parking::Scenario scenario;         ///< name, obstacles, bounds and car; start and goal are not chosen
        std::string name;                   ///< kind and seed
        parking::ObstacleSet obstacles;     ///< as what is tested sees them
        PolygonOracle oracle;               ///< says what is right
        parking::Box bounds;                ///< a box round the free world, in the coordinates of the poses
        std::vector<parking::Edge> edges;   ///< outlines (of cells: diagonals), to make poses that touch them
        std::vector<parking::Pose> places;  ///< where a car could be asked to park: in slots and bays, free or not

        /** \brief A pose anywhere in the world. */
        parking::Pose anywhere(Random &random) const;

        /** \brief A pose with a random place of the body's outline at a random place of an obstacle's, up to \e off
            metres away from it in a random direction. */
        parking::Pose touching(Random &random, const parking::Vehicle &vehicle, double off) const;
    };

    /** \brief A rectangle of \e length by \e width metres round \e pose, along its heading. */
    parking::Polygon rectangle(double length, double width, const parking::Pose &pose);

    /** \brief A polygon round (x, y), its corners seen from there in order but at any distance: rarely convex. */
    parking::Polygon star(Random &random, double x, double y, double largest);

    /** \brief A slot with a wall on three sides, as one polygon that is not convex. */
    parking::Polygon bay(double length, double width, const parking::Pose &pose);

    /** \brief Parked cars, debris, bays, thin walls and posts of a centimetre in a box of 30 m, round \e offset. */
    World randomPolygonWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0});

    /** \brief A grid with single occupied cells, walls one cell thick and blocks; turned round \e offset. */
    World randomGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0});

    /** \brief A grid as a sensor leaves it: walls in flecks, and single cells strewn over what is free. */
    World noisyGridWorld(std::uint64_t seed, const Eigen::Vector2d &offset = {0.0, 0.0});

    /** \brief Two rows of cars like \e car on 30 m, a lane between them, or one row and a wall; where a car is missing
        is a place to park. */
    World parkingRowsWorld(std::uint64_t seed, const parking::Vehicle &car);

    /** \brief One or two bays on 30 m, each hardly larger than \e car, which is to be parked there. */
    World baysWorld(std::uint64_t seed, const parking::Vehicle &car);

    /** \brief One or two walls across 30 m, each with an opening, which may be too narrow. */
    World lanesWorld(std::uint64_t seed);
}  // namespace parking_test
