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
        /** \brief Car to use instead of the one the file names: a known name or a YAML file; empty: the file's, and
            TPCAP's car for its cases. */
        std::string vehicle;
        std::optional<Pose> start{};  ///< instead of the file's, in the coordinates of the file
        std::optional<Pose> goal{};   ///< likewise; it takes the place of a slot, too
    };

    /** \brief Reads a scenario file, recognised by content: YAML (see docs/scenarios.md) or a TPCAP case.

        A case is one line of comma-separated numbers: start x, y, yaw, goal x, y, yaw, the number of obstacles, the
        vertex count of each, then all vertices. The local frame of either has its origin at the start.

        Throws parking::Error with one line naming the file and the line or field that is wrong. So do all readers here,
        also for missing, empty, truncated and absurdly large files. Files of CommonParking and Bench-MR are refused
        with the command that makes a scenario of them. */
    Scenario readScenario(const std::string &file, const ReaderOptions &options = {});

    /** \brief readScenario() of what \e file holds, which is then not read: for a pipe, which can be read once only.

        \param file named in errors, and where files that the text names are looked for */
    Scenario parseScenario(const std::string &file, std::string text, const ReaderOptions &options = {});

    /** \brief Reads a ROS map_server map: the YAML file and the PGM (P2, P5) or PNG image that it names.

        Cells with occupancy above occupied_thresh are occupied, below free_thresh free, in between unknown; `negate`,
        `mode` and an origin with yaw are honoured. One thing differs from map_server: a pixel that is not opaque is
        unknown in every mode. map_server's trinary mode averages alpha with the colours instead, which turns the usual
        grey for unknown (205) into free in every image that has an alpha channel.

        \param files the names of both files are added to it, unless it is null */
    OccupancyGrid readRosMap(const std::string &yamlFile, std::vector<std::string> *files = nullptr);

    /** \brief Reads SurroundOcc occupancy voxels (.npy, int64 (n, 4) = ix, iy, iz, label) as a 200x200 grid of 0.5 m
        cells in the lidar frame.

        A cell is occupied when something other than ground stands in its column up to 2.2 m above the ground, or when
        the ground is pavement or terrain; free when it is drivable; else unknown. Unknown cells with at least five free
        neighbours become free (three times), since a lidar's rings leave gaps, and so do those under the car itself. */
    OccupancyGrid readSurroundOcc(const std::string &npyFile);

    /** \brief A car by its name, or read from a YAML file with the fields of Vehicle in snake case.

        Without a field for it, a limit of speed, acceleration or steering rate is TPCAP's; the sizes and the steering
        angle must be given.

        \param files the name of the file, if one is read, is added to it, unless it is null */
    Vehicle readVehicle(const std::string &nameOrFile, std::vector<std::string> *files = nullptr);
}  // namespace parking
