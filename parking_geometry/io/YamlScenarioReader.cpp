#include "parking_geometry/Error.h"
#include "parking_geometry/GoalRegion.h"
#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <filesystem>
#include <optional>

namespace parking
{
    namespace
    {
        /** Largest number of corners of all polygons of a world. */
        constexpr std::size_t MAX_CORNERS = 1000000;
        const char *const POLYGONS = "a list of polygons, each a list of [x, y], or [] for none";

        std::string besides(const std::string &file, const std::string &other)
        {
            return (std::filesystem::path(file).parent_path() / other).lexically_normal().string();
        }

        std::vector<Polygon> readPolygons(const YamlMap &map, const Eigen::Vector2d &offset)
        {
            std::vector<Polygon> polygons;
            std::size_t corners = 0;
            for (const YAML::Node &outline : map.list("polygons", POLYGONS))
            {
                const std::string which = "polygon " + std::to_string(polygons.size() + 1);
                if (!outline.IsSequence())
                    map.fail(outline, which + " must be a list of [x, y]");
                if (outline.size() == 0)
                    map.fail(outline, which + " has no corners");
                // By aliases, a file of a few lines can contain one polygon a million times.
                corners += outline.size();
                if (corners > MAX_CORNERS)
                    map.fail(outline, "the polygons have more than " + std::to_string(MAX_CORNERS) +
                                          " corners; draw such a world as a map");
                Polygon polygon;
                polygon.reserve(outline.size());
                for (const YAML::Node &corner : outline)
                {
                    const std::vector<double> xy = map.numbers(corner, 2, "a corner of " + which);
                    polygon.emplace_back(xy[0] - offset.x(), xy[1] - offset.y());
                }
                polygons.push_back(std::move(polygon));
            }
            return polygons;
        }

        /** Reads a map_server map or a SurroundOcc file. The first bytes determine the format, because extensions are
            arbitrary. */
        OccupancyGrid readGrid(const YamlMap &map, std::vector<std::string> &files, std::vector<std::string> &warnings)
        {
            const std::string name = map.textOr("map", "the path of a map, or a mapping with the key polygons");
            const std::string file = besides(map.file(), name);
            const std::string extension = std::filesystem::path(name).extension().string();
            if (extension == ".pgm" || extension == ".png")
                map.failAt("map", "map is the image " + inQuotes(name) +
                                      "; name the map's YAML file, which holds its resolution and origin");
            if (extension != ".npy")
                return readRosMap(file, &files, &warnings);
            files.push_back(file);
            return readSurroundOcc(file);
        }

        /** The mapping with the polygons: the scenario or the value of its key map; none for a grid. */
        std::optional<YamlMap> polygonsOf(const YamlMap &map)
        {
            if (map.has("polygons"))
                return map;
            if (!map.node("map").IsMap())
                return std::nullopt;
            YamlMap inner = map.map("map");
            inner.allowOnly({"polygons"});
            return inner;
        }

        /** The place of a part of the scenario, for errors that completeScenario() finds. */
        std::string placeOf(const YamlMap &map, ScenarioPart part, std::size_t index)
        {
            switch (part)
            {
                case ScenarioPart::Start:
                    return map.placeOf("start");
                case ScenarioPart::Goal:
                    return map.placeOf(map.has("goal") ? "goal" : "slot");
                case ScenarioPart::Map:
                    return map.placeOf("map");
                default:
                {
                    const YamlMap polygons = polygonsOf(map).value_or(map);
                    return polygons.place(polygons.node("polygons")[index]);
                }
            }
        }

        void readWorld(Scenario &scenario, const YamlMap &map)
        {
            if (map.has("map") == map.has("polygons"))
                map.fail(YAML::Node(), map.has("map") ? "both map and polygons are given; give one of them"
                                                      : "neither map nor polygons is given; one of them must be");
            if (const std::optional<YamlMap> polygons = polygonsOf(map))
            {
                if (map.has("unknown_is_occupied"))
                    map.failAt("unknown_is_occupied",
                               "unknown_is_occupied is given for a world of polygons; only cells of a map are unknown");
                scenario.polygons = readPolygons(*polygons, scenario.worldOffset);
                return;
            }
            scenario.grid = readGrid(map, scenario.files, scenario.warnings);
            Pose origin = scenario.grid->origin();
            origin.x -= scenario.worldOffset.x();
            origin.y -= scenario.worldOffset.y();
            scenario.grid->setOrigin(origin);
        }

        Pose toLocal(const Pose &world, const Eigen::Vector2d &offset)
        {
            return {world.x - offset.x(), world.y - offset.y(), world.yaw};
        }

        ParkingSlot readSlot(const YamlMap &map, const Eigen::Vector2d &offset)
        {
            map.allowOnly({"kind", "pose", "length", "width", "entry", "angle", "side", "depth", "lateral_offset"});
            ParkingSlot slot;
            slot.kind = static_cast<SlotKind>(map.choice("kind", {"perpendicular", "parallel", "angled"}));
            slot.pose = toLocal(map.pose("pose"), offset);
            slot.length = map.number("length");
            slot.width = map.number("width");
            if (map.has("entry"))
                slot.entry = static_cast<SlotEntry>(map.choice("entry", {"reverse", "forward", "either"}));
            slot.angle = map.numberOr("angle", slot.angle);
            if (map.has("angle") && slot.kind != SlotKind::Angled)
                map.failAt("angle", "angle is given for a slot of the kind " + map.text("kind") +
                                        "; only angled slots have one");
            if (map.has("side"))
                slot.side = static_cast<SlotSide>(map.choice("side", {"right", "left", "either"}));
            if (map.has("depth"))
                slot.depth = map.number("depth");
            slot.lateralOffset = map.numberOr("lateral_offset", 0.0);
            return slot;
        }

        std::vector<Pose> readGoalRegion(const YamlMap &scenario, const Eigen::Vector2d &offset)
        {
            const YamlMap map = scenario.map("goal");
            map.allowOnly({"pose", "tolerance", "yaw_tolerance", "heading"});
            GoalRegion region;
            region.pose = toLocal(map.pose("pose"), offset);
            region.tolerance = map.numberOr("tolerance", 0.0);
            region.yawTolerance = map.numberOr("yaw_tolerance", 0.0);
            if (map.has("heading"))
                region.heading = static_cast<GoalHeading>(map.choice("heading", {"fixed", "both", "any"}));
            try
            {
                return region.goals();
            }
            catch (const Error &error)
            {
                scenario.failAt("goal", error.what());
            }
        }

        void readGoals(Scenario &scenario, const YamlMap &map)
        {
            if (map.has("goal") == map.has("slot"))
                map.fail(YAML::Node(), map.has("goal") ? "both goal and slot are given; give one of them"
                                                       : "neither goal nor slot is given; one of them must be");
            if (map.has("goal"))
            {
                scenario.goals = map.node("goal").IsMap()
                                     ? readGoalRegion(map, scenario.worldOffset)
                                     : std::vector<Pose>{toLocal(map.pose("goal"), scenario.worldOffset)};
                return;
            }
            scenario.slot = readSlot(map.map("slot"), scenario.worldOffset);
            try
            {
                scenario.slot->validate();
                scenario.goals = scenario.slot->goals(scenario.vehicle);
            }
            catch (const Error &error)
            {
                map.failAt("slot", error.what());
            }
        }

        Vehicle readVehicleOf(const YamlMap &map, const std::string &instead, std::vector<std::string> &files)
        {
            if (!instead.empty())
                return readVehicle(instead, &files);
            if (!map.has("vehicle"))
                return Vehicle();
            if (map.node("vehicle").IsMap())
                return vehicleFromYaml(map.map("vehicle"));
            const std::string name = map.textOr(
                "vehicle", "the name of a car, the path of a vehicle file, or a mapping with the car's fields");
            const std::string extension = std::filesystem::path(name).extension().string();
            if (extension == ".yaml" || extension == ".yml")
                return readVehicle(std::filesystem::absolute(besides(map.file(), name)).string(), &files);
            try
            {
                return vehicleByName(name);
            }
            catch (const Error &error)
            {
                map.failAt("vehicle", error.what());
            }
        }
    }  // namespace

    Scenario parseYamlScenario(const std::string &file, const std::string &text, const std::string &vehicle)
    {
        const YamlMap map(file, text);
        map.allowOnly({"name", "map", "polygons", "vehicle", "start", "goal", "slot", "unknown_is_occupied"});
        Scenario scenario;
        scenario.name = map.has("name") ? map.text("name") : scenarioName(file);
        scenario.files = {file};
        scenario.vehicle = readVehicleOf(map, vehicle, scenario.files);
        const Pose start = map.pose("start");
        scenario.worldOffset = {start.x, start.y};
        scenario.start = {0.0, 0.0, start.yaw};
        scenario.unknownIsOccupied = map.has("unknown_is_occupied") ? map.flag("unknown_is_occupied") : true;
        readWorld(scenario, map);
        readGoals(scenario, map);
        completeScenario(scenario, file,
                         [&map](ScenarioPart part, std::size_t index) { return placeOf(map, part, index); });
        return scenario;
    }
}  // namespace parking
