#include "parking_geometry/MakeScenario.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        /** Throws for parts that lie too far from the start or overflowed to NaN. */
        void requireReach(const Scenario &scenario, const PlaceOfPart &placeOf)
        {
            const Eigen::Vector2d start(scenario.start.x, scenario.start.y);
            const auto require =
                [&](const Eigen::Vector2d &point, const std::string &what, ScenarioPart part, std::size_t index)
            {
                const double distance = (point - start).lpNorm<Eigen::Infinity>();
                if (!(distance <= WORLD_REACH))
                    throw Error(placeOf(part, index) + ": " + what + " lies " + formatNumber(distance) +
                                " m from the start; at most " + formatNumber(WORLD_REACH) + " m are supported");
            };
            for (const Pose &goal : scenario.goals)
                require({goal.x, goal.y}, "the goal", ScenarioPart::Goal, 0);
            if (scenario.grid)
                for (const Eigen::Vector2d &corner : scenario.grid->outline())
                    require(corner, "a corner of the map", ScenarioPart::Map, 0);
            for (std::size_t i = 0; i < scenario.polygons.size(); ++i)
                for (const Eigen::Vector2d &corner : scenario.polygons[i])
                    require(corner, "a corner of obstacle " + std::to_string(i + 1), ScenarioPart::Outline, i);
        }

        Box boxRound(const std::vector<Eigen::Vector2d> &points)
        {
            Box box{points.front(), points.front()};
            for (const Eigen::Vector2d &point : points)
                box.include(point);
            return box;
        }

        Box boundsOfPolygons(const Scenario &scenario)
        {
            std::vector<Pose> poses = scenario.goals;
            poses.push_back(scenario.start);
            std::vector<Eigen::Vector2d> points;
            for (const Pose &pose : poses)
                points.emplace_back(pose.x, pose.y);
            for (const Polygon &polygon : scenario.polygons)
                points.insert(points.end(), polygon.begin(), polygon.end());
            Box box = boxRound(points);
            box.min.array() -= POLYGON_WORLD_MARGIN;
            box.max.array() += POLYGON_WORLD_MARGIN;
            // A vehicle longer than the margin must still fit into the world where it starts and ends.
            for (const Pose &pose : poses)
                for (const Eigen::Vector2d &corner : scenario.vehicle.footprint(pose))
                    box.include(corner);
            return box;
        }

        void requireNear(const Eigen::Vector2d &start, const PlaceOfPart &placeOf)
        {
            if (!(start.lpNorm<Eigen::Infinity>() <= MAX_COORDINATE))
                throw Error(placeOf(ScenarioPart::Start, 0) + ": the start lies at " + formatNumber(start.x()) + ", " +
                            formatNumber(start.y()) + "; coordinates of at most " + formatNumber(MAX_COORDINATE) +
                            " m are supported: move the origin");
        }

        void requireStartOnMap(const Scenario &scenario, const PlaceOfPart &placeOf)
        {
            const OccupancyGrid &grid = *scenario.grid;
            const Pose onMap = relativeTo(grid.origin(), scenario.start);
            const double width = static_cast<double>(grid.width()) * grid.resolution();
            const double height = static_cast<double>(grid.height()) * grid.resolution();
            if (onMap.x >= 0.0 && onMap.y >= 0.0 && onMap.x <= width && onMap.y <= height)
                return;
            throw Error(placeOf(ScenarioPart::Start, 0) + ": start outside the map: it lies at " +
                        formatNumber(onMap.x) + ", " + formatNumber(onMap.y) +
                        " m from the map's lower left corner, and the map is " + formatNumber(width) + " x " +
                        formatNumber(height) + " m");
        }

        /** Checks a pose, and brings its yaw into [-pi, pi]. */
        Pose checked(Pose pose, const std::string &source, const std::string &what)
        {
            const Require require(source + ": " + what);
            require.finite("x", pose.x, "metres");
            require.finite("y", pose.y, "metres");
            require.finite("yaw", pose.yaw, "radians");
            pose.yaw = wrapAngle(pose.yaw);
            return pose;
        }

        void requireSimple(const Polygon &polygon, std::size_t number, const std::string &source)
        {
            const std::string which = source + ": polygon " + std::to_string(number);
            if (polygon.empty())
                throw Error(which + " has no corners");
            for (std::size_t i = 0; i < polygon.size(); ++i)
                if (!polygon[i].allFinite())
                    throw Error(which + ": corner " + std::to_string(i + 1) + " is " + formatNumber(polygon[i].x()) +
                                ", " + formatNumber(polygon[i].y()) + "; both must be finite numbers of metres");
        }

        Pose shifted(const Pose &pose, const Eigen::Vector2d &by)
        {
            return {pose.x - by.x(), pose.y - by.y(), pose.yaw};
        }
    }  // namespace

    void completeScenario(Scenario &scenario, const std::string &source, const PlaceOfPart &placeOf)
    {
        if (!placeOf)
        {
            completeScenario(scenario, source, [&source](ScenarioPart, std::size_t) { return source; });
            return;
        }
        const Pose start = scenario.toWorld(scenario.start);
        requireNear({start.x, start.y}, placeOf);
        for (std::size_t i = 0; i < scenario.polygons.size(); ++i)
            if (crossesItself(scenario.polygons[i]))
                throw Error(placeOf(ScenarioPart::Outline, i) + ": the outline of polygon " + std::to_string(i + 1) +
                            " crosses itself; list the corners in their order round it");
        if (scenario.grid)
            requireStartOnMap(scenario, placeOf);
        requireReach(scenario, placeOf);
        scenario.bounds = scenario.grid ? boxRound(scenario.grid->outline()) : boundsOfPolygons(scenario);
    }

    Scenario makeScenario(Scenario scenario, const std::string &source)
    {
        scenario.vehicle.validate();
        scenario.start = checked(scenario.start, source, "start");
        if (scenario.grid && !scenario.polygons.empty())
            throw Error(source + ": both a map and polygons are given; give one of them");
        if (scenario.slot)
        {
            if (!scenario.goals.empty())
                throw Error(source + ": both goal and slot are given; give one of them");
            scenario.slot->pose = checked(scenario.slot->pose, source, "slot");
        }
        else if (scenario.goals.empty())
            throw Error(source + ": neither goal nor slot is given; one of them must be");
        const Eigen::Vector2d offset(scenario.start.x, scenario.start.y);
        scenario.worldOffset = offset;
        scenario.start = shifted(scenario.start, offset);
        for (Pose &goal : scenario.goals)
            goal = shifted(checked(goal, source, "goal"), offset);
        if (scenario.slot)
        {
            // The goals follow from the local slot, because far away they would be rounded.
            scenario.slot->pose = shifted(scenario.slot->pose, offset);
            scenario.goals = scenario.slot->goals(scenario.vehicle);
        }
        for (std::size_t i = 0; i < scenario.polygons.size(); ++i)
        {
            requireSimple(scenario.polygons[i], i + 1, source);
            for (Eigen::Vector2d &corner : scenario.polygons[i])
                corner -= offset;
        }
        if (scenario.grid)
        {
            checked(scenario.grid->origin(), source, "origin");
            scenario.grid->setOrigin(shifted(scenario.grid->origin(), offset));
        }
        completeScenario(scenario, source);
        return scenario;
    }
}  // namespace parking
