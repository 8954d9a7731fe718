#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/io/images/ImageRows.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <filesystem>
#include <utility>

namespace parking
{
    namespace
    {
        /** How pixels become occupancy; the names are map_server's. */
        enum class MapMode
        {
            Trinary,
            Scale,
            Raw
        };

        struct MapRules
        {
            MapMode mode{MapMode::Trinary};
            bool negate{false};
            double occupied{0.0};
            double free{0.0};

            /** What a pixel means.

                \param brightness of the pixel, \e white being the largest
                The probability is computed in map_server's own order, so that pixels whose value equals a threshold
                fall to the same side. */
            Cell operator()(std::uint32_t brightness, std::uint32_t white) const
            {
                if (brightness == NOT_OPAQUE)
                    return Cell::Unknown;
                const double dark = negate ? brightness : white - brightness;
                double probability = dark / white;
                if (mode == MapMode::Raw)
                {
                    // The pixel is the value of the message, whatever negate says, as for nav2: 0 to 100 percent,
                    // anything above says unknown.
                    const double percent = std::round(255.0 * brightness / white);
                    if (percent > 100.0)
                        return Cell::Unknown;
                    probability = percent / 100.0;
                }
                return probability > occupied ? Cell::Occupied : probability < free ? Cell::Free : Cell::Unknown;
            }
        };

        /** Throws for a key that says something of the map by another name than the one that is read, which is missing:
            free_threshold, occ_thresh, map_resolution. Else a missing key would be all that the message tells of. */
        void refuseOtherNames(const YamlMap &map)
        {
            const std::pair<const char *, const char *> parts[] = {
                {"image", "image"},   {"resolution", "resolution"}, {"origin", "origin"},
                {"negate", "negate"}, {"occ", "occupied_thresh"},   {"free", "free_thresh"}};
            for (const auto &[part, right] : parts)
                if (!map.has(right))
                    for (const std::string &key : map.keys())
                        if (lowerCase(key).find(part) != std::string::npos)
                            map.failAtKey(key, "unknown key " + inQuotes(key) + "; did you mean '" + right +
                                                   "', which is missing?");
        }

        double threshold(const YamlMap &map, const std::string &key)
        {
            const double value = map.number(key);
            if (value < 0.0 || value > 1.0)
                map.failAt(key, key + " is " + formatNumber(value) + "; it must be 0 to 1");
            return value;
        }

        /** Whether a pixel has the grey that map savers write for unknown cells. */
        bool isUnknownOfMapSavers(std::uint32_t brightness, std::uint32_t white)
        {
            return brightness != NOT_OPAQUE && std::uint64_t(255) * brightness == std::uint64_t(205) * white;
        }

        std::string percentText(std::size_t part, std::size_t all)
        {
            const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(all);
            return percent < 0.1 ? "less than 0.1 %" : formatNumber(std::round(10.0 * percent) / 10.0) + " %";
        }

        MapRules readRules(const YamlMap &map)
        {
            MapRules rules;
            if (map.has("mode"))
                rules.mode = static_cast<MapMode>(map.choiceInAnyCase("mode", {"trinary", "scale", "raw"}));
            rules.negate = map.has("negate") && map.flag("negate");
            rules.occupied = threshold(map, "occupied_thresh");
            rules.free = threshold(map, "free_thresh");
            if (rules.free > rules.occupied)
                map.failAt("free_thresh", "free_thresh is " + formatNumber(rules.free) + " and occupied_thresh " +
                                              formatNumber(rules.occupied) + "; the first must not be the larger one");
            return rules;
        }
    }  // namespace

    void checkImageSize(const std::string &file, std::size_t width, std::size_t height)
    {
        const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
        if (width == 0 || height == 0)
            throw Error(file + ": an image of " + size + " is not a map; both sides must be at least 1");
        if (width > (std::size_t(1) << 31) / height)
            throw Error(file + ": an image of " + size + " is too large; at most 2^31 pixels are read");
    }

    void decodeImage(const std::string &file, const std::string &bytes, const ImageSink &sink)
    {
        if (bytes.compare(0, 2, "P2") == 0 || bytes.compare(0, 2, "P5") == 0)
            decodePgm(file, bytes, sink);
        else if (bytes.compare(0, 4, "\x89PNG") == 0)
            decodePng(file, bytes, sink);
        else
            throw Error(file + ": is neither a PGM (P2, P5) nor a PNG image");
    }

    OccupancyGrid readRosMap(const std::string &yamlFile, std::vector<std::string> *files,
                             std::vector<std::string> *warnings)
    {
        const std::string text = readFile(yamlFile, TEXT_FILE_LIMIT);
        if (!trimmed(text).empty() && trimmed(text).front() == '<')
            throw Error(yamlFile +
                        ": is XML; a map is a YAML file that names a PGM or PNG image (see docs/scenarios.md)");
        const YamlMap map(yamlFile, text);
        map.refuseMisspelt({"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"});
        refuseOtherNames(map);
        const std::string name = map.text("image");
        const double resolution = map.number("resolution");
        if (resolution <= 0.0)
            map.failAt("resolution", "resolution is " + formatNumber(resolution) +
                                         "; it must be a positive number of metres per cell");
        const Pose origin = map.pose("origin");
        const MapRules rules = readRules(map);

        const std::string file = (std::filesystem::path(yamlFile).parent_path() / name).string();
        if (files != nullptr)
            files->insert(files->end(), {yamlFile, file});
        constexpr std::size_t IMAGE_LIMIT = (std::size_t(2) << 31) + (std::size_t(1) << 20);
        const std::string bytes = readFile(file, IMAGE_LIMIT);
        OccupancyGrid grid;
        std::uint32_t brightest = 0;
        std::size_t unknownMadeFree = 0;
        ImageSink sink;
        sink.begin = [&](std::size_t width, std::size_t height, std::uint32_t white)
        {
            grid = OccupancyGrid(width, height, resolution, origin, Cell::Unknown);
            brightest = white;
        };
        sink.row = [&](std::size_t row, const std::vector<std::uint32_t> &brightness)
        {
            for (std::size_t column = 0; column < brightness.size(); ++column)
            {
                const Cell cell = rules(brightness[column], brightest);
                grid.set(column, grid.height() - 1 - row, cell);
                unknownMadeFree += cell == Cell::Free && isUnknownOfMapSavers(brightness[column], brightest);
            }
        };
        decodeImage(file, bytes, sink);
        if (unknownMadeFree > 0 && rules.mode != MapMode::Raw && warnings != nullptr)
            warnings->push_back(map.placeOf("free_thresh") + ": free_thresh " + formatNumber(rules.free) +
                                " makes the grey of unknown ground (205 of 255) free: " +
                                percentText(unknownMadeFree, grid.cells().size()) +
                                " of the cells; 0.196 keeps them unknown");
        return grid;
    }
}  // namespace parking
