#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <filesystem>

namespace parking
{
    namespace
    {
        bool isFileName(const std::string &text)
        {
            const std::string extension = std::filesystem::path(text).extension().string();
            return extension == ".yaml" || extension == ".yml" || text.find('/') != std::string::npos;
        }

        /** The outline and the lengths that follow from it. Lengths that are given too are kept for validate(). */
        void readOutline(Vehicle &vehicle, const YamlMap &map)
        {
            Polygon outline;
            for (const YAML::Node &corner : map.list("outline", "a list of corners [x, y] in metres"))
            {
                const std::vector<double> xy = map.numbers(corner, 2, "a corner of outline");
                outline.emplace_back(xy[0], xy[1]);
                if (outline.size() > Vehicle::MAX_CORNERS)
                    map.failAt("outline", "outline has more than " + std::to_string(Vehicle::MAX_CORNERS) + " corners");
            }
            if (outline.empty())
                map.failAt("outline", "outline has no corners");
            vehicle.setOutline(outline);
            vehicle.frontOverhang = map.numberOr("front_overhang", vehicle.frontOverhang);
            vehicle.rearOverhang = map.numberOr("rear_overhang", vehicle.rearOverhang);
            vehicle.width = map.numberOr("width", vehicle.width);
        }
    }  // namespace

    Vehicle vehicleFromYaml(const YamlMap &map)
    {
        map.allowOnly({"name", "wheelbase", "front_overhang", "rear_overhang", "width", "outline", "max_steering_angle",
                       "max_speed", "max_acceleration", "max_steering_rate"});
        Vehicle vehicle;
        vehicle.name = map.has("name") ? map.text("name") : "custom";
        vehicle.wheelbase = map.number("wheelbase");
        if (map.has("outline"))
            readOutline(vehicle, map);
        else
        {
            vehicle.frontOverhang = map.number("front_overhang");
            vehicle.rearOverhang = map.number("rear_overhang");
            vehicle.width = map.number("width");
        }
        vehicle.maxSteeringAngle = map.number("max_steering_angle");
        vehicle.maxSpeed = map.numberOr("max_speed", vehicle.maxSpeed);
        vehicle.maxAcceleration = map.numberOr("max_acceleration", vehicle.maxAcceleration);
        vehicle.maxSteeringRate = map.numberOr("max_steering_rate", vehicle.maxSteeringRate);
        try
        {
            vehicle.validate();
        }
        catch (const FieldError &error)
        {
            map.failAt(map.has(error.field()) ? error.field() : "outline", error.what());
        }
        return vehicle;
    }

    Vehicle readVehicle(const std::string &nameOrFile, std::vector<std::string> *files)
    {
        const std::vector<std::string> names = vehicleNames();
        if (std::find(names.begin(), names.end(), nameOrFile) != names.end())
            return vehicleByName(nameOrFile);
        if (!isFileName(nameOrFile))
            throw Error(unknownName("vehicle", nameOrFile, names) + " (or the path of a .yaml file)");
        if (files != nullptr)
            files->push_back(nameOrFile);
        return vehicleFromYaml(YamlMap(nameOrFile, readFile(nameOrFile, TEXT_FILE_LIMIT)));
    }
}  // namespace parking
