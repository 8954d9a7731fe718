#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/referee/Outlines.h"

#include <cstddef>
#include <optional>

#include <Eigen/Core>

namespace parking
{
    /** \brief Where the referee lets a shape stand, with code that has nothing in common with the checkers that
       planners use: no outline of an obstacle crosses the shape, and its middle is outside of all obstacles.

        A touch of up to a micrometre counts as free, since paths may end where numbers round. */
    class FreeSpace
    {
    public:
        /** \brief For the car's rectangle, or when \e circleRadius is positive for a disc round its rear axle. */
        explicit FreeSpace(const Scenario &scenario, double circleRadius = 0.0);

        /** \brief Is the shape at this local pose free of obstacles and inside of the world? */
        bool isFree(const Pose &pose) const;

        /** \brief Metres between the shape and the nearest obstacle or the end of the world; 0 where it touches one. It
           is exact if less than \e enough, otherwise some number from \e enough up to the distance. */
        double clearance(const Pose &pose, double enough) const;

        /** \brief The least clearance on a straight drive from a free pose: that of all that the shape covers.

            \param length metres, negative in reverse */
        double clearanceAlong(const Pose &from, double length, double enough) const;

        /** \brief Metres from the rear axle to the point of the shape that moves most when the heading turns. */
        double farthestPoint() const
        {
            return farthest_;
        }

    private:
        Pose toLocal(const Pose &pose) const;
        OrientedBox shapeAt(const Pose &local) const;
        double distance(const OrientedBox &shape, double enough) const;
        bool isInside(const Eigen::Vector2d &point) const;
        bool isOccupied(std::size_t column, std::size_t row) const;
        void addOutlinesOfCells();

        double radius_;
        double centreOffset_{0.0}, halfLength_{0.0}, halfWidth_{0.0};  ///< of the body; a disc is its middle
        double farthest_{0.0};

        Box bounds_;  ///< in the frame of the obstacles
        Outlines outlines_;
        std::optional<OccupancyGrid> grid_;
        bool unknownIsOccupied_;
    };
}  // namespace parking
