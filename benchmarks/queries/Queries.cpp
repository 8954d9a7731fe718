#include "benchmarks/queries/Queries.h"

#include "benchmarks/config/BenchmarkConfig.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/referee/FreeSpace.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace fs = std::filesystem;

namespace parking
{
    namespace
    {
        constexpr double BESIDE = 3.0;          // metres added to the bounds of polygons without bounds
        constexpr double LEAST_MARGIN = 0.001;  // metres: a free pose must not depend on the rounding of a checker
        constexpr int TRIALS = 20000;
        constexpr double PUSH = 0.1, FARTHEST_PUSH = 6.0;  // metres
        constexpr std::size_t MAP_FILE_LIMIT = std::size_t(1) << 20;

        Pose rounded(const Pose &pose)
        {
            return {std::round(1e3 * pose.x) / 1e3, std::round(1e3 * pose.y) / 1e3, std::round(1e4 * pose.yaw) / 1e4};
        }

        QueryWorld mapWorld(const std::string &file, const std::string &vehicle)
        {
            QueryWorld world;
            world.name = fs::path(file).stem().string();
            world.scenario.grid = readRosMap(file, nullptr, &world.scenario.warnings);
            if (!vehicle.empty())
                world.scenario.vehicle = readVehicle(vehicle);
            return world;
        }

        /** Whether a YAML file is a map: it names an image. */
        bool isMap(const fs::path &file)
        {
            if (file.extension() != ".yaml" && file.extension() != ".yml")
                return false;
            const std::string text = "\n" + readFile(file.string(), MAP_FILE_LIMIT);
            return text.find("\nimage:") != std::string::npos && text.find("\nstart:") == std::string::npos;
        }

        void setRange(QueryWorld &world, double beside)
        {
            Scenario &scenario = world.scenario;
            if (scenario.grid)
            {
                const std::vector<Eigen::Vector2d> outline = scenario.grid->outline();
                world.range = {outline.front(), outline.front()};
                for (const Eigen::Vector2d &corner : outline)
                    world.range.include(corner);
                scenario.bounds = world.range;
                return;
            }
            Eigen::Vector2d around = Eigen::Vector2d::Constant(beside);
            world.range = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
            if (!scenario.polygons.empty())
                world.range = {scenario.polygons.front().front(), scenario.polygons.front().front()};
            for (const Polygon &polygon : scenario.polygons)
                for (const Eigen::Vector2d &corner : polygon)
                    world.range.include(corner);
            world.range = {world.range.min - around, world.range.max + around};
            around.setConstant(POLYGON_WORLD_MARGIN);
            scenario.bounds = {world.range.min - around, world.range.max + around};
        }

        std::string corners(const Polygon &polygon)
        {
            std::string text;
            for (const Eigen::Vector2d &corner : polygon)
                text += (text.empty() ? "[" : ", [") + formatNumber(corner.x()) + ", " + formatNumber(corner.y()) + "]";
            return "[" + text + "]";
        }

        std::string numbers(const Pose &pose)
        {
            return "[" + formatNumber(pose.x) + ", " + formatNumber(pose.y) + ", " + formatNumber(pose.yaw) + "]";
        }
    }  // namespace

    QueryWorld queryWorld(const std::string &name, const std::vector<Polygon> &polygons, const Vehicle &vehicle)
    {
        QueryWorld world;
        world.name = name;
        world.scenario.polygons = polygons;
        world.scenario.vehicle = vehicle;
        setRange(world, 0.0);
        return world;
    }

    std::vector<QueryWorld> worldsOf(const std::string &folderOrFile, const std::string &vehicle)
    {
        std::vector<std::string> maps, scenarios;
        std::error_code ignored;
        if (fs::is_directory(folderOrFile, ignored))
        {
            for (const auto &entry : fs::directory_iterator(folderOrFile))
                if (entry.is_regular_file(ignored) && isMap(entry.path()))
                    maps.push_back(entry.path().string());
            std::sort(maps.begin(), maps.end());
            try
            {
                scenarios = findScenarios(folderOrFile, "");
            }
            catch (const Error &)
            {
                if (maps.empty())
                    throw Error(inQuotes(folderOrFile) +
                                ": no world there (maps and scenarios as .yaml files, cases as .csv files)");
            }
        }
        else
            // A pipe cannot be read twice, and is treated as a scenario.
            (fs::is_regular_file(folderOrFile, ignored) && isMap(folderOrFile) ? maps : scenarios)
                .push_back(folderOrFile);
        std::vector<QueryWorld> worlds;
        for (const std::string &file : maps)
            worlds.push_back(mapWorld(file, vehicle));
        for (const std::string &file : scenarios)
        {
            QueryWorld world;
            world.scenario = readScenario(file, {vehicle});
            world.name = fs::path(file).stem().string();
            // A scenario on a map of the folder would be the same world twice.
            const bool isKnown = std::any_of(worlds.begin(), worlds.end(),
                                             [&](const QueryWorld &each)
                                             { return each.name == world.name + "_map" || each.name == world.name; });
            if (!isKnown)
                worlds.push_back(std::move(world));
        }
        for (QueryWorld &world : worlds)
            setRange(world, BESIDE);
        return worlds;
    }

    std::optional<Query> drawQuery(const QueryWorld &world, parking_test::Random &random, double margin,
                                   bool atObstacle)
    {
        Scenario larger = world.scenario;
        const double more = std::max(margin, LEAST_MARGIN);
        const bool isRectangle = larger.vehicle.outline.empty();
        if (isRectangle)
        {
            larger.vehicle.frontOverhang += more;
            larger.vehicle.rearOverhang += more;
            larger.vehicle.width += 2.0 * more;
        }
        const FreeSpace space(larger);
        const auto isFree = [&](const Pose &pose)
        {
            return space.isFree(pose) && (isRectangle || space.clearance(pose, more) >= more);
        };
        const auto pushed = [&](const Pose &from) -> std::optional<Pose>
        {
            const double direction = random.between(-PI, PI);
            Pose last = from;
            for (double distance = PUSH; distance <= FARTHEST_PUSH; distance += PUSH)
            {
                const Pose next = rounded(
                    {from.x + distance * std::cos(direction), from.y + distance * std::sin(direction), from.yaw});
                if (!isFree(next))
                    return distance > PUSH ? std::optional<Pose>(last) : std::nullopt;
                last = next;
            }
            return std::nullopt;
        };
        const auto draw = [&](bool near) -> std::optional<Pose>
        {
            for (int trial = 0; trial < TRIALS; ++trial)
            {
                const double x = random.between(world.range.min.x(), world.range.max.x());
                const double y = random.between(world.range.min.y(), world.range.max.y());
                const Pose pose = rounded({x, y, random.between(-PI, PI)});
                if (!isFree(pose))
                    continue;
                const std::optional<Pose> found = near ? pushed(pose) : pose;
                if (found)
                    return found;
            }
            return std::nullopt;
        };
        const std::optional<Pose> start = draw(false);
        const std::optional<Pose> goal = start ? draw(atObstacle) : std::nullopt;
        if (!goal)
            return std::nullopt;
        return Query{*start, *goal, atObstacle};
    }

    std::string queryText(const QueryWorld &world, const Query &query, const std::string &map)
    {
        const Scenario &scenario = world.scenario;
        const Vehicle &car = scenario.vehicle;
        std::string text = "vehicle: {name: '" + oneLine(car.name) + "'";
        const std::pair<const char *, double> fields[]{{"wheelbase", car.wheelbase},
                                                       {"front_overhang", car.frontOverhang},
                                                       {"rear_overhang", car.rearOverhang},
                                                       {"width", car.width},
                                                       {"max_steering_angle", car.maxSteeringAngle},
                                                       {"max_speed", car.maxSpeed},
                                                       {"max_acceleration", car.maxAcceleration},
                                                       {"max_steering_rate", car.maxSteeringRate}};
        for (const auto &[key, value] : fields)
            text += std::string(", ") + key + ": " + formatNumber(value);
        if (!car.outline.empty())
            text += ", outline: " + corners(car.outline);
        text += "}\nstart: " + numbers(query.start) + "\ngoal: " + numbers(query.goal) + "\n";
        if (scenario.grid)
            return text + "map: " + map + "\nunknown_is_occupied: " + (scenario.unknownIsOccupied ? "true" : "false") +
                   "\n";
        text += "polygons:";
        for (const Polygon &polygon : scenario.polygons)
            text += "\n  - " + corners(polygon);
        return text + (scenario.polygons.empty() ? " []\n" : "\n");
    }

    std::string mapYaml(const OccupancyGrid &grid, const std::string &image)
    {
        return "image: " + image + "\nresolution: " + formatNumber(grid.resolution()) +
               "\norigin: " + numbers(grid.origin()) + "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    }

    std::string mapImage(const OccupancyGrid &grid)
    {
        std::string text = "P5\n" + std::to_string(grid.width()) + " " + std::to_string(grid.height()) + "\n255\n";
        for (std::size_t row = grid.height(); row-- > 0;)
            for (std::size_t column = 0; column < grid.width(); ++column)
            {
                const Cell cell = grid.at(column, row);
                text += static_cast<char>(cell == Cell::Free ? 254 : cell == Cell::Occupied ? 0 : 205);
            }
        return text;
    }
}  // namespace parking
