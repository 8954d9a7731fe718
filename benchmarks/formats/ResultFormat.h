#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief What `parking_plan --json` has written of a run, in the coordinates of the scenario's file. */
    struct StoredResult
    {
        std::string planner;       ///< its name
        std::string status;        ///< exact, approximate, ...
        double planningTime{0.0};  ///< seconds, of the first run
        int caseId{1};             ///< for formats that number their problems
        Vehicle vehicle;           ///< the car
        Path path;                 ///< its pieces are the arcs between the states of the file
        Trajectory trajectory;     ///< the optimised one, or the driven one where there is no other; may be empty

        /** \brief Does the path end at the goal? */
        bool isSolved() const
        {
            return status == "exact";
        }
    };

    /** \brief The result that a file holds whose \e content is in memory.

        Throws parking::Error with one line naming the file and the field: for what is no result or has no path, for
        values of another type or out of range, and for a path or trajectory that jumps. */
    StoredResult parseResult(const std::string &file, const std::string &content);

    /** \brief Does what a file holds begin like JSON? */
    bool looksLikeResult(const std::string &content);

    /** \brief A kind of file in which results are handed in. A format is one source file, and a line in
        resultFormats(). */
    struct ResultFormat
    {
        const char *name;       ///< one word, for --to
        const char *extension;  ///< ".mat"
        const char *text;       ///< one line for --help
        bool isTrajectory;      ///< is it for results with a trajectory only?
        /** \brief Writes \e file whole or not at all. Throws parking::Error. */
        void (*write)(const StoredResult &result, const std::string &file);
        /** \brief What is wrong with a written file by the rules of those who read it; empty when nothing is. */
        std::string (*check)(const StoredResult &result, const std::string &file);
    };

    /** \brief All formats of results. */
    const std::vector<ResultFormat> &resultFormats();

    /** \brief The format of this name. Throws parking::Error with the nearest one for any other. */
    const ResultFormat &resultFormat(const std::string &name);

    /** \brief The first format with the extension of this file name. Throws parking::Error with all formats for any
        other. */
    const ResultFormat &resultFormatForName(const std::string &file);

    /** \brief CommonParking's path. */
    ResultFormat commonParkingPath();
    /** \brief CommonParking's trajectory. */
    ResultFormat commonParkingTrajectory();
    /** \brief A table of a trajectory. */
    ResultFormat tpcapTrajectory();
}  // namespace parking
