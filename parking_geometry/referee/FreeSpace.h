#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/referee/Outlines.h"

#include <cstddef>
#include <optional>

#include <Eigen/Core>

namespace parking
{
    /** \brief Collision test of the referee. It shares no code with the checkers that planners use.

        A shape is free if no outline of an obstacle crosses it and one of its points is outside of all obstacles.

        An overlap of up to a micrometre counts as free because of rounding at the ends of paths. */
    class FreeSpace
    {
    public:
        /** \brief Tests the car's body or, if \e circleRadius is positive, a disc about its rear axle. */
        explicit FreeSpace(const Scenario &scenario, double circleRadius = 0.0);

        /** \brief Whether the shape at this local pose touches no obstacle and lies within the world. */
        bool isFree(const Pose &pose) const;

        /** \brief Distance in metres between the shape and the nearest obstacle or the end of the world; 0 if they
            touch.

            The result is exact if it is less than \e enough. Otherwise it is a value between \e enough and the
            distance. */
        double clearance(const Pose &pose, double enough) const;

        /** \brief Minimum clearance on a straight drive from a free pose, with \e enough as for clearance(). For a body
            with an outline, that of its bounding rectangle, a lower bound.

            \param length metres, negative in reverse */
        double clearanceAlong(const Pose &from, double length, double enough) const;

        /** \brief Whether the shape has an outline, that is, it is neither a rectangle nor a disc. */
        bool hasOutline() const
        {
            return !outline_.empty();
        }

        /** \brief Largest distance in metres of a point of the shape from the rear axle. */
        double farthestPoint() const
        {
            return farthest_;
        }

    private:
        Pose toLocal(const Pose &pose) const;
        OrientedBox shapeAt(const Pose &local) const;
        double distance(const OrientedBox &shape, double enough) const;
        double distance(const Polygon &shape, double enough) const;
        bool isInside(const Eigen::Vector2d &point) const;
        bool isOccupied(std::size_t column, std::size_t row) const;
        void addOutlinesOfCells();

        double radius_;
        double centreOffset_{0.0}, halfLength_{0.0}, halfWidth_{0.0};  ///< of the body; a disc has half lengths of 0
        double farthest_{0.0};
        Polygon outline_, smaller_;  ///< of a body that is no rectangle, and that moved inwards by the allowed overlap

        Box bounds_;  ///< bounds in the frame of the obstacles
        Outlines outlines_;
        std::optional<OccupancyGrid> grid_;
        bool unknownIsOccupied_;
    };
}  // namespace parking
