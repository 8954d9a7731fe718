#pragma once

#include "parking_geometry/OrientedBox.h"
#include "parking_geometry/Polygon.h"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The outlines of all obstacles of a world, found by where they are: for the referee, and written for it.

        Edges lie in square buckets of the world, a slanting one in those that it passes through. What lies outside of
        the bounds is entered at their rim, which is nearer than it is. */
    class Outlines
    {
    public:
        Outlines() = default;

        /** \brief \param bounds of the world that is asked about, not empty */
        explicit Outlines(const Box &bounds);

        /** \brief A solid obstacle. Self-intersecting ones are inside where a ray leaves them an odd number of times.
         */
        void add(const Polygon &polygon);

        /** \brief A piece of an outline that nothing is inside of. */
        void add(const Edge &edge);

        /** \brief Metres between the box's outline or interior and the nearest edge, 0 when they meet; exact if less
            than \e enough, otherwise some number from \e enough up to the distance. */
        double distance(const OrientedBox &box, double enough) const;

        /** \brief Is the point, which lies within the bounds, inside of a polygon? */
        bool isInside(const Eigen::Vector2d &point) const;

    private:
        /** An edge of a polygon, to be counted as crossed by a ray along the row. */
        struct RowEdge
        {
            Edge edge;
            std::size_t polygon;
        };

        std::size_t columnOf(double x) const;
        std::size_t rowOf(double y) const;

        Box bounds_;
        double side_{1.0};  ///< of a bucket, metres
        std::size_t columns_{1}, rows_{1};
        std::vector<Edge> edges_;
        std::vector<std::vector<std::size_t>> buckets_;  ///< indices of edges
        std::size_t polygons_{0};
        /** By rows of buckets, each polygon's edges in succession. */
        std::vector<std::vector<RowEdge>> rowEdges_;
    };
}  // namespace parking
