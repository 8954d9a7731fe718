#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Options of the readers. */
    struct ReaderOptions
    {
        /** \brief Car that replaces the one of the scenario: a known name or a YAML file. If empty, the scenario's car
            is used, and for a TPCAP case the car of TPCAP. */
        std::string vehicle;
        std::optional<Pose> start{};  ///< replaces the start of the file; in its coordinates
        std::optional<Pose> goal{};   ///< replaces the goal or slot of the file; in its coordinates
    };

    /** \brief Reads a scenario file and detects its format from the content: YAML (see docs/scenarios.md) or a TPCAP
        case.

        A case is one line of comma-separated numbers: start x, y, yaw and goal x, y, yaw. The number of obstacles, the
        vertex count of each and all vertices follow. The origin of the local frame lies at the start.

        Throws parking::Error with one line naming the file and the invalid line or field, also for missing, empty,
        truncated and oversized files. For files of CommonParking and Bench-MR the message states the command that
        converts them. */
    Scenario readScenario(const std::string &file, const ReaderOptions &options = {});

    /** \brief Parses the content of a scenario file like readScenario(), for example of a pipe that can be read only
        once.

        \param file name in errors; relative paths in the text start at its folder
        \param text content of the file */
    Scenario parseScenario(const std::string &file, std::string text, const ReaderOptions &options = {});

    /** \brief Reads a ROS map_server map: the YAML file and the PGM (P2, P5) or PNG image that it names.

        Cells with occupancy above occupied_thresh are occupied, below free_thresh free, in between unknown. Both keys
        are required. The reader supports `negate`, `mode` and an origin with yaw as nav2 does.

        Unlike map servers, the reader treats a pixel that is not opaque as unknown in every mode. The trinary mode of
       map servers averages alpha with the colours. This turns the usual grey for unknown (205) into free in every image
        with an alpha channel.

        \param files unless it is null, the names of both files are appended to it
        \param warnings unless it is null, receives a sentence if free_thresh makes the usual grey for unknown free
        Throws parking::Error naming the file and the invalid line or field. */
    OccupancyGrid readRosMap(const std::string &yamlFile, std::vector<std::string> *files = nullptr,
                             std::vector<std::string> *warnings = nullptr);

    /** \brief Reads SurroundOcc occupancy voxels (.npy, int64 (n, 4) = ix, iy, iz, label) as a 200x200 grid of 0.5 m
        cells in the lidar frame.

        A cell is occupied if its column contains an object up to 2.2 m above the ground or if its ground is pavement or
        terrain. It is free if its ground is drivable and otherwise unknown. In three passes, unknown cells with at
        least five free neighbours become free because a lidar's rings leave gaps. Cells under the car become free too.

        Throws parking::Error naming the file and the invalid field. */
    OccupancyGrid readSurroundOcc(const std::string &npyFile);

    /** \brief A car by its name, or from a YAML file with the fields of Vehicle in snake case.

        A file must contain the sizes and the steering angle. Missing limits of speed, acceleration and steering rate
        are those of TPCAP.

        \param files unless it is null, the name of the file is appended to it if one is read
        Throws parking::Error naming the file and the invalid line or field. */
    Vehicle readVehicle(const std::string &nameOrFile, std::vector<std::string> *files = nullptr);
}  // namespace parking
