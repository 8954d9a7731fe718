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
    /** \brief Where queries are drawn: obstacles and car of \e scenario, whose start and goals are to be chosen. */
    struct QueryWorld
    {
        std::string name;   ///< what files and results call it
        Scenario scenario;  ///< obstacles and car
        Box range;          ///< of rear axles
    };

    /** \brief A world of polygons with a car. */
    QueryWorld queryWorld(const std::string &name, const std::vector<Polygon> &polygons, const Vehicle &vehicle);

    /** \brief The worlds of a folder, or of one file: scenarios that readScenario() understands, without their own
        queries, and ROS maps that no scenario of the folder is needed for.

        \param vehicle name or file; empty: that of a scenario, for a map TPCAP's
        Throws parking::Error for what cannot be read, and when there is none. */
    std::vector<QueryWorld> worldsOf(const std::string &folderOrFile, const std::string &vehicle);

    /** \brief From where to where. */
    struct Query
    {
        Pose start,                  ///< of the rear axle, in the coordinates of the world's scenario
            goal;                    ///< likewise
        bool goalAtObstacle{false};  ///< it was pushed towards an obstacle as far as it goes, in steps of 0.1 m
    };

    /** \brief A random query whose start and goal are free, the body enlarged by \e margin metres on all sides.

        Poses are round (millimetres, and a ten-thousandth of a radian), so that files have them exactly.

        \param atObstacle push the goal towards an obstacle
        \return nothing when no free pose was found in many trials */
    std::optional<Query> drawQuery(const QueryWorld &world, parking_test::Random &random, double margin,
                                   bool atObstacle);

    /** \brief The YAML scenario of a query. Polygons are in it; a grid is in the map file \e map. */
    std::string queryText(const QueryWorld &world, const Query &query, const std::string &map);

    /** \brief A grid as a ROS map: the YAML file for the image \e image, and the image itself (PGM). */
    std::string mapYaml(const OccupancyGrid &grid, const std::string &image);

    /** \brief The image of mapYaml(): PGM, white where it is free, black where occupied, grey where unknown. */
    std::string mapImage(const OccupancyGrid &grid);
}  // namespace parking
