#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"

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

        /** \brief Metres from the rear axle to the point of the shape that moves most when the heading turns. */
        double farthestPoint() const
        {
            return farthest_;
        }

    private:
        struct Edge
        {
            Eigen::Vector2d from, to;
        };

        void enterEdge(std::size_t index);
        bool isBodyFree(const Pose &local) const;
        bool isDiscFree(const Eigen::Vector2d &centre) const;
        bool insideObstacle(const Eigen::Vector2d &point) const;
        bool cellsFree(const Eigen::Vector2d &min, const Eigen::Vector2d &max, const Pose &local) const;
        std::size_t occupiedIn(std::size_t row, std::size_t first, std::size_t last) const;
        template <class Visit>
        bool visitEdges(const Eigen::Vector2d &min, const Eigen::Vector2d &max, const Visit &visit) const;

        Vehicle vehicle_;
        double radius_;
        double farthest_;

        // A world of polygons: edges by square buckets, row by row.
        std::vector<Polygon> polygons_;
        std::vector<Box> boxes_;
        std::vector<Edge> edges_;
        Box bounds_;
        double bucket_{0.0};  // metres, the side of one
        std::size_t bucketColumns_{0}, bucketRows_{0};
        std::vector<std::vector<std::size_t>> buckets_;

        // A world of cells: occupied_[row * (columns + 1) + i] counts those in the first i columns of a row.
        bool isGrid_{false};
        Pose origin_;
        double cellSize_{1.0};
        std::size_t columns_{0}, rows_{0};
        std::vector<std::uint32_t> occupied_;
    };
}  // namespace parking
