#include "parking_geometry/io/ScenarioParts.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <filesystem>

namespace parking
{
    namespace
    {
        /** A growing box that refuses points too far from the start. */
        class Extent
        {
        public:
            Extent(const std::string &file, const Eigen::Vector2d &start) : file_(file), start_(start)
            {
                box_.min = box_.max = start;
            }

            void add(const Eigen::Vector2d &point, const std::string &what)
            {
                const double distance = (point - start_).lpNorm<Eigen::Infinity>();
                if (!(distance <= WORLD_REACH))  // also for what overflowed to NaN
                    throw Error(file_ + ": " + what + " lies " + formatNumber(distance) +
                                " m from the start; at most " + formatNumber(WORLD_REACH) + " m are supported");
                box_.include(point);
            }

            const Box &box() const
            {
                return box_;
            }

        private:
            const std::string &file_;
            Eigen::Vector2d start_;
            Box box_;
        };

        Box boundsOfMap(const Scenario &scenario, const std::string &file)
        {
            Extent extent(file, {scenario.start.x, scenario.start.y});
            const std::vector<Eigen::Vector2d> outline = scenario.grid->outline();
            Box box{outline.front(), outline.front()};
            for (const Eigen::Vector2d &corner : outline)
            {
                extent.add(corner, "a corner of the map");
                box.include(corner);
            }
            return box;
        }

        Box boundsOfPolygons(const Scenario &scenario, const std::string &file)
        {
            Extent extent(file, {scenario.start.x, scenario.start.y});
            for (const Pose &goal : scenario.goals)
                extent.add({goal.x, goal.y}, "the goal");
            for (std::size_t i = 0; i < scenario.polygons.size(); ++i)
                for (const Eigen::Vector2d &corner : scenario.polygons[i])
                    extent.add(corner, "a corner of obstacle " + std::to_string(i + 1));

            const Eigen::Vector2d margin(POLYGON_WORLD_MARGIN, POLYGON_WORLD_MARGIN);
            Box box{extent.box().min - margin, extent.box().max + margin};
            // A vehicle longer than the margin must still fit into the world where it starts and ends.
            std::vector<Pose> poses = scenario.goals;
            poses.push_back(scenario.start);
            for (const Pose &pose : poses)
                for (const Eigen::Vector2d &corner : scenario.vehicle.footprint(pose))
                    box.include(corner);
            return box;
        }

        void requireStartOnMap(const Scenario &scenario, const std::string &file)
        {
            const OccupancyGrid &grid = *scenario.grid;
            const Pose onMap = relativeTo(grid.origin(), scenario.start);
            const double width = static_cast<double>(grid.width()) * grid.resolution();
            const double height = static_cast<double>(grid.height()) * grid.resolution();
            if (onMap.x >= 0.0 && onMap.y >= 0.0 && onMap.x <= width && onMap.y <= height)
                return;
            throw Error(file + ": start outside the map: it lies at " + formatNumber(onMap.x) + ", " +
                        formatNumber(onMap.y) + " m from the map's lower left corner, and the map is " +
                        formatNumber(width) + " x " + formatNumber(height) + " m");
        }
    }  // namespace

    std::string scenarioName(const std::string &file)
    {
        return std::filesystem::path(file).stem().string();
    }

    void completeScenario(Scenario &scenario, const std::string &file)
    {
        if (scenario.grid)
            requireStartOnMap(scenario, file);
        scenario.bounds = scenario.grid ? boundsOfMap(scenario, file) : boundsOfPolygons(scenario, file);
    }
}  // namespace parking
