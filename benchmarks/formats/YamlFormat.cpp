// The project's own scenarios, and whatever else readScenario() understands.

#include "benchmarks/formats/YamlFormat.h"

#include "benchmarks/formats/ScenarioFormat.h"
#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

namespace parking
{
    namespace
    {
        std::string numbers(const Pose &pose)
        {
            return "[" + formatNumber(pose.x) + ", " + formatNumber(pose.y) + ", " + formatNumber(pose.yaw) + "]";
        }

        Scenario parse(const std::string &file, const std::string &content, const FormatOptions &options)
        {
            return withOptions(parseScenario(file, content, {options.vehicle}), file, options);
        }

        void write(const Scenario &scenario, const std::string &file)
        {
            writeFileAtomically(file, yamlText(scenario.vehicle, scenario.toWorld(scenario.start),
                                               scenario.toWorld(scenario.goals.front()), obstaclePolygons(scenario)));
        }
    }  // namespace

    std::string yamlText(const Vehicle &car, const Pose &start, const Pose &goal, const std::vector<Polygon> &polygons,
                         const std::string &map, bool unknownIsOccupied)
    {
        std::string text =
            "vehicle: {name: '" + oneLine(car.name) + "', wheelbase: " + formatNumber(car.wheelbase) +
            ", front_overhang: " + formatNumber(car.frontOverhang) +
            ", rear_overhang: " + formatNumber(car.rearOverhang) + ", width: " + formatNumber(car.width) +
            ", max_steering_angle: " + formatNumber(car.maxSteeringAngle) +
            ", max_speed: " + formatNumber(car.maxSpeed) + ", max_acceleration: " + formatNumber(car.maxAcceleration) +
            ", max_steering_rate: " + formatNumber(car.maxSteeringRate) + "}\n";
        text += "start: " + numbers(start) + "\ngoal: " + numbers(goal) + "\n";
        if (!map.empty())
            return text + "map: " + map + "\nunknown_is_occupied: " + (unknownIsOccupied ? "true" : "false") + "\n";
        text += "polygons:";
        for (const Polygon &polygon : polygons)
        {
            text += "\n  - [";
            for (std::size_t i = 0; i < polygon.size(); ++i)
                text +=
                    (i > 0 ? ", [" : "[") + formatNumber(polygon[i].x()) + ", " + formatNumber(polygon[i].y()) + "]";
            text += "]";
        }
        return text + (polygons.empty() ? " []\n" : "\n");
    }

    ScenarioFormat yamlFormat()
    {
        return {"yaml",
                ".yaml",
                "scenarios of this project, maps and voxels as they name them",
                [](std::string_view) { return true; },
                TEXT_FILE_LIMIT,
                parse,
                write};
    }
}  // namespace parking
