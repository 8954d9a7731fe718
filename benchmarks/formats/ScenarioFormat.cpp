#include "benchmarks/formats/ScenarioFormat.h"

#include "benchmarks/formats/MatFile.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ObstacleSet.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace parking
{
    namespace
    {
        constexpr std::size_t BEGIN = 4096;  // bytes by which a format is recognised
        constexpr double WALL = 1.0;         // metres
    }                                        // namespace

    const std::vector<ScenarioFormat> &scenarioFormats()
    {
        static const std::vector<ScenarioFormat> formats{commonParkingFormat(), benchMrFormat(), tpcapFormat(),
                                                         yamlFormat()};
        return formats;
    }

    std::string scenarioFormatLines()
    {
        std::ostringstream lines;
        for (const ScenarioFormat &format : scenarioFormats())
            lines << "  " << std::left << std::setw(26) << format.name << std::setw(6) << format.extension
                  << format.text << "\n";
        if (!hasMatFiles())
            lines << "\nThis build has no MATLAB files (.mat): build it with libmatio-dev.\n";
        return lines.str();
    }

    const ScenarioFormat &scenarioFormat(std::string_view name)
    {
        std::vector<std::string> names;
        for (const ScenarioFormat &format : scenarioFormats())
        {
            if (format.name == name)
                return format;
            names.emplace_back(format.name);
        }
        throw Error(unknownName("format", std::string(name), names));
    }

    Scenario ScenarioFormat::read(const std::string &file, const FormatOptions &options) const
    {
        return parse(file, readFile(file, largest), options);
    }

    const ScenarioFormat &formatOf(std::string_view content)
    {
        for (const ScenarioFormat &format : scenarioFormats())
            if (format.recognizes(content.substr(0, BEGIN)))
                return format;
        return scenarioFormats().back();
    }

    const ScenarioFormat &formatForName(const std::string &file)
    {
        const std::string extension = std::filesystem::path(file).extension().string();
        std::string known;
        for (const ScenarioFormat &format : scenarioFormats())
        {
            if (extension == format.extension)
                return format;
            known += (known.empty() ? "" : ", ") + std::string(format.extension);
        }
        throw Error(inQuotes(file) + ": the name says no format; name one with --to, or end it with one of " + known);
    }

    Scenario readAnyScenario(const std::string &file, const FormatOptions &options)
    {
        std::size_t largest = 0;
        for (const ScenarioFormat &format : scenarioFormats())
            largest = std::max(largest, format.largest);
        return parseAnyScenario(file, readFile(file, largest), options);
    }

    Scenario parseAnyScenario(const std::string &file, const std::string &content, const FormatOptions &options)
    {
        const ScenarioFormat &format = formatOf(content);
        if (content.size() > format.largest)
            throw Error(file + ": is larger than the " + std::to_string(format.largest >> 20) + " MiB that are read");
        return format.parse(file, content, options);
    }

    Scenario withOptions(Scenario scenario, const std::string &file, const FormatOptions &options)
    {
        const auto local = [&scenario](const Pose &pose) -> Pose
        {
            return {pose.x - scenario.worldOffset.x(), pose.y - scenario.worldOffset.y(), wrapAngle(pose.yaw)};
        };
        if (options.start)
            scenario.start = local(*options.start);
        if (options.goal)
        {
            scenario.goals = {local(*options.goal)};
            scenario.slot.reset();
        }
        if (options.start || options.goal)
            completeScenario(scenario, file);
        return scenario;
    }

    std::vector<Polygon> obstaclePolygons(const Scenario &scenario)
    {
        std::vector<Polygon> polygons = scenario.polygons;
        if (scenario.grid)
        {
            const ObstacleSet obstacles = ObstacleSet::fromGrid(*scenario.grid, scenario.unknownIsOccupied);
            const Box &map = obstacles.bounds();
            const auto add = [&](const Eigen::Vector2d &low, const Eigen::Vector2d &high)
            {
                Polygon polygon;
                for (const Eigen::Vector2d &corner :
                     {low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())})
                {
                    const Pose place = compose(obstacles.frame(), {corner.x(), corner.y(), 0.0});
                    polygon.emplace_back(place.x, place.y);
                }
                polygons.push_back(std::move(polygon));
            };
            for (const Box &box : obstacles.rectangles())
                add(box.min, box.max);
            // Nobody leaves a map: a wall round it.
            const Eigen::Vector2d thick(WALL, WALL);
            add(map.min - thick, {map.max.x() + WALL, map.min.y()});
            add({map.min.x() - WALL, map.max.y()}, map.max + thick);
            add({map.min.x() - WALL, map.min.y()}, {map.min.x(), map.max.y()});
            add({map.max.x(), map.min.y()}, {map.max.x() + WALL, map.max.y()});
        }
        for (Polygon &polygon : polygons)
            for (Eigen::Vector2d &corner : polygon)
                corner += scenario.worldOffset;
        return polygons;
    }
}  // namespace parking
