#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The obstacles of a world, in the form that every collision test of this library starts from.

        Everything is kept in a local frame near the obstacles: at 4e9 m a double resolves a micrometre only, so no
        arithmetic is done in world coordinates but the subtraction of the frame. Obstacles are solid; the outside of
        the bounds is an obstacle too. */
    class ObstacleSet
    {
    public:
        /** \brief A world of polygons (simple, either orientation, three or more corners) inside of \e bounds.

            Throws parking::Error for a polygon with fewer than three corners or a coordinate that is not finite, and
            for bounds that are empty or not finite. */
        static ObstacleSet fromPolygons(const std::vector<Polygon> &polygons, const Box &bounds);

        /** \brief A world of square cells; the outside of the map is an obstacle.

            \param unknownIsOccupied whether cells of which nothing is known are obstacles
            Throws parking::Error for a grid without cells. */
        static ObstacleSet fromGrid(const OccupancyGrid &grid, bool unknownIsOccupied = true);

        /** \brief The world of a scenario, polygons or grid, in the scenario's coordinates. */
        static ObstacleSet fromScenario(const Scenario &scenario);

        /** \brief The local frame, given in the caller's coordinates. Yaw is zero but for maps whose origin is
            turned. */
        const Pose &frame() const
        {
            return frame_;
        }

        /** \brief \e pose, given in the caller's coordinates, in the local frame. */
        Pose toLocal(const Pose &pose) const
        {
            if (frame_.yaw == 0.0)
                return {pose.x - frame_.x, pose.y - frame_.y, pose.yaw};
            return relativeTo(frame_, pose);
        }

        /** \brief The free world's box, local. */
        const Box &bounds() const
        {
            return bounds_;
        }

        /** \brief Outlines of all obstacles and of the bounds. */
        const std::vector<Edge> &edges() const
        {
            return edges_;
        }

        /** \brief Solid polygons, local, counter-clockwise; empty for a grid world. */
        const std::vector<Polygon> &polygons() const
        {
            return polygons_;
        }

        /** \brief Solid rectangles, local: occupied cells merged; empty for a polygon world. */
        const std::vector<Box> &rectangles() const
        {
            return rectangles_;
        }

        /** \brief Side of the cells of a grid world, 0 for a polygon world. */
        double cellSize() const
        {
            return cellSize_;
        }

        /** \brief Occupied cells of a grid world, row by row, 1 for occupied; empty for a polygon world. */
        const std::vector<std::uint8_t> &cells() const
        {
            return cells_;
        }

        /** \brief Cells in a row of cells(); 0 for a polygon world. */
        std::size_t columns() const
        {
            return columns_;
        }

        /** \brief Rows of cells(); 0 for a polygon world. */
        std::size_t rows() const
        {
            return rows_;
        }

        /** \brief Is the local point inside of an obstacle, or outside of the bounds? Undefined right on an outline. */
        bool covers(double x, double y) const;

    private:
        void addBoundsEdges();

        Pose frame_;
        Box bounds_{};
        std::vector<Edge> edges_;
        std::vector<Polygon> polygons_;
        std::vector<Box> rectangles_;
        double cellSize_{0.0};
        std::vector<std::uint8_t> cells_;
        std::size_t columns_{0};
        std::size_t rows_{0};
    };
}  // namespace parking
