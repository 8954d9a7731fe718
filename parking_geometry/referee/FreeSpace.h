#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/referee/Outlines.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Where the referee lets a shape stand, with code that has nothing in common with the checkers that
       planners use: the shape is laid over the obstacles.

        Polygons: every edge is clipped against the body, and the body's middle must be outside. Cells: the body is laid
        over each occupied cell (separating axes). A touch of up to a micrometre counts as free, since paths may end
        where numbers round. */
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
        Rectangle shapeAt(const Pose &local) const;
        double distance(const Rectangle &shape, double enough) const;
        bool isBodyFree(const Pose &local) const;
        bool isDiscFree(const Eigen::Vector2d &centre) const;
        bool cellsFree(const Box &box, const Pose &local) const;
        std::size_t occupiedIn(std::size_t row, std::size_t first, std::size_t last) const;
        void addOutlinesOfCells();

        Vehicle vehicle_;
        double radius_;
        double farthest_;

        Box bounds_;  ///< in the frame of the obstacles
        Outlines outlines_;

        // A world of cells: occupied_[row * (columns + 1) + i] counts those in the first i columns of a row.
        bool isGrid_{false};
        Pose origin_;
        double cellSize_{1.0};
        std::size_t columns_{0}, rows_{0};
        std::vector<std::uint32_t> occupied_;
    };
}  // namespace parking
