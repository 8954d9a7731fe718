#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief What DenseCheck found. */
    struct DenseResult
    {
        bool valid{true};
        std::size_t states{0};      ///< poses tested
        std::size_t collisions{0};  ///< of those in collision
        double maxCurvature{0.0};   ///< 1/m, largest magnitude along the path
        std::string reason;         ///< of the first thing found wrong; empty when valid
    };

    /** \brief Goes over a finished path once more, with code that has nothing in common with the checkers that planners
        use: the shape is laid over the obstacles every few millimetres.

        Polygons: every edge is clipped against the body, and the body's middle must be outside. Cells: the body is laid
        over each occupied cell (separating axes). A touch of up to a micrometre counts as free, since paths may end
        where numbers round. */
    class DenseCheck
    {
    public:
        /** \brief Poses between which no point of the body moves farther than this are tested. */
        static constexpr double STEP = 0.005;

        /** \brief For the car's rectangle, or when \e circleRadius is positive for a disc round its rear axle. */
        explicit DenseCheck(const Scenario &scenario, double circleRadius = 0.0);

        /** \brief Is the shape at this local pose free of obstacles and inside of the world? */
        bool isFree(const Pose &pose) const;

        /** \brief Tests \e path.

            \param straight whether the states are joined by straight lines, with the heading turning evenly, instead of
            by arcs
            \param maxCurvature 1/m, the most that the path may have; 0: any. Arcs must also join: each state must lie
            where the arc from the one before ends. */
        DenseResult check(const SampledPath &path, bool straight, double maxCurvature) const;

    private:
        struct Edge
        {
            Eigen::Vector2d from, to;
        };

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

        // A world of polygons: edges by square buckets, first_[k] to first_[k + 1] of bucketEdges_ in bucket k.
        std::vector<Polygon> polygons_;
        std::vector<Box> boxes_;
        std::vector<Edge> edges_;
        Box bounds_;
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
