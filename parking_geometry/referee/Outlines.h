#pragma once

#include "parking_geometry/OrientedBox.h"
#include "parking_geometry/Polygon.h"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Spatial index of the outlines of all obstacles, used only by the referee.

        Square buckets store the edges that pass through them. Parts of edges outside of the bounds are stored in the
        outermost buckets. */
    class Outlines
    {
    public:
        Outlines() = default;

        /** \brief An index without outlines. \param bounds area of later queries, not empty */
        explicit Outlines(const Box &bounds);

        /** \brief Adds a solid obstacle. A self-intersecting polygon contains a point if a ray from it crosses the
            outline an odd number of times. */
        void add(const Polygon &polygon);

        /** \brief Adds an edge without an interior. */
        void add(const Edge &edge);

        /** \brief Distance in metres between the solid box and the nearest edge; 0 if they touch.

            The result is exact if it is less than \e enough. Otherwise it is a value between \e enough and the
            distance. */
        double distance(const OrientedBox &box, double enough) const;

        /** \brief Distance in metres between a solid simple polygon and the nearest edge, as for a box. */
        double distance(const Polygon &shape, double enough) const;

        /** \brief Whether the point is inside of a polygon. The point must lie within the bounds. */
        bool isInside(const Eigen::Vector2d &point) const;

    private:
        /** An edge of a polygon for the ray test along a row. */
        struct RowEdge
        {
            Edge edge;
            std::size_t polygon;
        };

        template <class Distance>
        double nearestEdge(const Box &round, double enough, const Distance &distance) const;
        std::size_t columnOf(double x) const;
        std::size_t rowOf(double y) const;

        Box bounds_;
        double side_{1.0};  ///< side of a bucket, metres
        std::size_t columns_{1}, rows_{1};
        std::vector<Edge> edges_;
        std::vector<std::vector<std::size_t>> buckets_;  ///< indices of edges per bucket
        std::size_t polygons_{0};
        /** Edges per row of buckets; those of a polygon are contiguous. */
        std::vector<std::vector<RowEdge>> rowEdges_;
    };
}  // namespace parking
