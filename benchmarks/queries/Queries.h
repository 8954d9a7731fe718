#pragma once

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief A world for queries: obstacles and car of \e scenario, whose start and goals are to be chosen. */
    struct QueryWorld
    {
        std::string name;   ///< name in files and results
        Scenario scenario;  ///< obstacles and car
        Box range;          ///< bounds of rear axles
    };

    /** \brief A world of polygons with a car. */
    QueryWorld queryWorld(const std::string &name, const std::vector<Polygon> &polygons, const Vehicle &vehicle);

    /** \brief The worlds of a folder or a file: scenarios that readScenario() supports, without their queries, and ROS
        maps that are not part of such a scenario.

        \param vehicle name or file; empty: that of a scenario, for a map TPCAP's
        Throws parking::Error for a file that cannot be read, and when there is no world. */
    std::vector<QueryWorld> worldsOf(const std::string &folderOrFile, const std::string &vehicle);

    /** \brief Start and goal of a query. */
    struct Query
    {
        Pose start,  ///< pose of the rear axle, in the coordinates of the world's scenario
            goal;    ///< pose of the rear axle, in the coordinates of the world's scenario
        bool goalAtObstacle{
            false};  ///< whether the goal was pushed towards an obstacle up to contact, in steps of 0.1 m
    };

    /** \brief A random query whose start and goal are free, with the body enlarged by \e margin metres on all sides.

        Poses are rounded to millimetres and 1e-4 rad, so that files represent them exactly.

        \param atObstacle whether to push the goal towards an obstacle
        \return nothing when no free pose was found in many trials */
    std::optional<Query> drawQuery(const QueryWorld &world, parking_test::Random &random, double margin,
                                   bool atObstacle);

    /** \brief The YAML scenario of a query. It contains polygons; a grid is in the map file \e map. */
    std::string queryText(const QueryWorld &world, const Query &query, const std::string &map);

    /** \brief A grid as a ROS map: the YAML file for the image \e image, and the image itself (PGM). */
    std::string mapYaml(const OccupancyGrid &grid, const std::string &image);

    /** \brief The image of mapYaml() as PGM: white for free, black for occupied, grey for unknown cells. */
    std::string mapImage(const OccupancyGrid &grid);
}  // namespace parking
