#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The obstacles of a world, input of all collision tests of this library.

        The coordinates are relative to a local frame near the obstacles. At 4e9 m a double resolves only a micrometre,
        so the only operation in world coordinates is the subtraction of the frame. Obstacles are solid. The outside of
        the bounds is an obstacle too. */
    class ObstacleSet
    {
    public:
        /** \brief A world of simple polygons of either orientation inside of \e bounds. Two corners are a segment, one
            is a point.

            Throws parking::Error for polygons without corners, coordinates that are not finite, and bounds that are
            empty or not finite. */
        static ObstacleSet fromPolygons(const std::vector<Polygon> &polygons, const Box &bounds);

        /** \brief A world of square cells; the outside of the map is an obstacle.

            \param unknownIsOccupied whether unknown cells are obstacles
            Throws parking::Error for a grid without cells. */
        static ObstacleSet fromGrid(const OccupancyGrid &grid, bool unknownIsOccupied = true);

        /** \brief The world of a scenario, polygons or grid, in the scenario's coordinates. */
        static ObstacleSet fromScenario(const Scenario &scenario);

        /** \brief The local frame in the caller's coordinates. Its yaw is zero except for maps with a rotated
            origin. */
        const Pose &frame() const
        {
            return frame_;
        }

        /** \brief Expresses \e pose, given in the caller's coordinates, in the local frame. */
        Pose toLocal(const Pose &pose) const
        {
            if (frame_.yaw == 0.0)
                return {pose.x - frame_.x, pose.y - frame_.y, pose.yaw};
            return relativeTo(frame_, pose);
        }

        /** \brief Bounds of the world in the local frame. */
        const Box &bounds() const
        {
            return bounds_;
        }

        /** \brief Edges of all obstacles and of the bounds, in the local frame. Those of a grid world are computed at
            the first call after a change. */
        const std::vector<Edge> &edges() const
        {
            return derived().edges;
        }

        /** \brief Edges of a grid world near \e box, including those of the bounds. They cover the part of edges()
            inside of the box. */
        std::vector<Edge> edgesNear(const Box &box) const;

        /** \brief Solid polygons in the local frame, counter-clockwise; empty for a grid world. */
        const std::vector<Polygon> &polygons() const
        {
            return polygons_;
        }

        /** \brief Solid rectangles of merged occupied cells in the local frame; empty for a polygon world. They are
            computed at the first call after a change. */
        const std::vector<Box> &rectangles() const
        {
            return derived().rectangles;
        }

        /** \brief All solid polygons and rectangles, in the caller's coordinates. */
        std::vector<Polygon> solids() const;

        /** \brief Side of the cells of a grid world in metres; 0 for a polygon world. */
        double cellSize() const
        {
            return cellSize_;
        }

        /** \brief Cells of a grid world, row by row, 1 for occupied; empty for a polygon world. */
        const std::vector<std::uint8_t> &cells() const
        {
            return cells_;
        }

        /** \brief Number of columns of cells(); 0 for a polygon world. */
        std::size_t columns() const
        {
            return columns_;
        }

        /** \brief Number of rows of cells(); 0 for a polygon world. */
        std::size_t rows() const
        {
            return rows_;
        }

        /** \brief Changes cells of a grid world. Const calls from other threads must not overlap with it.

            \return indices into cells() of the cells whose occupancy has changed, ascending
            Throws parking::Error, and changes nothing, for a polygon world and for cells outside of the map. */
        std::vector<std::size_t> update(const GridUpdate &update);

        /** \brief Whether the local point is inside of an obstacle or outside of the bounds. The result is undefined
            exactly on an outline. */
        bool covers(double x, double y) const;

    private:
        /** What follows from the obstacles, shared by copies with equal ones. */
        struct Derived
        {
            std::once_flag once;
            std::vector<Edge> edges;
            std::vector<Box> rectangles;
        };
        const Derived &derived() const;

        Pose frame_;
        Box bounds_{};
        std::vector<Polygon> polygons_;
        std::shared_ptr<Derived> derived_{std::make_shared<Derived>()};
        bool unknownIsOccupied_{true};
        double cellSize_{0.0};
        std::vector<std::uint8_t> cells_;
        std::size_t columns_{0};
        std::size_t rows_{0};
    };
}  // namespace parking
