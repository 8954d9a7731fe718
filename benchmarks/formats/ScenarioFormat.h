#pragma once

#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parking
{
    /** \brief What a file does not say, or shall say otherwise. */
    struct FormatOptions
    {
        std::string vehicle;        ///< name or file; empty: the file's, or the format's
        std::optional<Pose> start;  ///< in the coordinates of the file
        std::optional<Pose> goal;   ///< likewise
    };

    /** \brief A kind of file that holds a parking problem. A format is one source file, and a line in
        scenarioFormats(). */
    struct ScenarioFormat
    {
        const char *name;       ///< one word, for --to
        const char *extension;  ///< of files that are written: ".yaml"
        const char *text;       ///< one line for --help
        /** \brief Is this the beginning of such a file? */
        bool (*recognizes)(std::string_view begin);
        std::size_t largest;  ///< bytes of a file, at most
        /** \brief What a file holds whose \e content is in memory: \e file is not read, as pipes can be read once only.
            Throws parking::Error with one line naming the file. */
        Scenario (*parse)(const std::string &file, const std::string &content, const FormatOptions &options);
        /** \brief Writes \e file whole or not at all. Throws parking::Error; also for what the format cannot hold. */
        void (*write)(const Scenario &scenario, const std::string &file);

        /** \brief Reads \e file as one of this format, whatever it looks like. Throws parking::Error. */
        Scenario read(const std::string &file, const FormatOptions &options) const;
    };

    /** \brief All formats; the last one is what a file is taken for that none recognizes. */
    const std::vector<ScenarioFormat> &scenarioFormats();

    /** \brief The formats for texts of --help, a line each, and one where this build has no MATLAB files. */
    std::string scenarioFormatLines();

    /** \brief The format of this name. Throws parking::Error with the nearest one for any other. */
    const ScenarioFormat &scenarioFormat(std::string_view name);

    /** \brief The format of a file, recognised by its content. */
    const ScenarioFormat &formatOf(std::string_view content);

    /** \brief The format that a file to be written has by its name. Throws parking::Error listing what there is. */
    const ScenarioFormat &formatForName(const std::string &file);

    /** \brief Reads a scenario in any format. Throws parking::Error. */
    Scenario readAnyScenario(const std::string &file, const FormatOptions &options = {});

    /** \brief readAnyScenario() of what \e file holds, which is then not read. */
    Scenario parseAnyScenario(const std::string &file, const std::string &content, const FormatOptions &options = {});

    /** \brief Start and goal of \e options put into a scenario that was read from \e file. Throws parking::Error as the
        readers do for theirs: the start off the map, the goal too far away. */
    Scenario withOptions(Scenario scenario, const std::string &file, const FormatOptions &options);

    /** \brief The obstacles as polygons in the coordinates of the file: cells merged into rectangles. */
    std::vector<Polygon> obstaclePolygons(const Scenario &scenario);

    /** \brief This project's own. */
    ScenarioFormat yamlFormat();
    /** \brief TPCAP's cases. */
    ScenarioFormat tpcapFormat();
    /** \brief Bench-MR's scenes. */
    ScenarioFormat benchMrFormat();
    /** \brief CommonParking's cases. */
    ScenarioFormat commonParkingFormat();
}  // namespace parking
