#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Polygon.h"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A rectangle at any angle, or with no size a point. */
    struct Rectangle
    {
        Eigen::Vector2d place{0.0, 0.0};  ///< of its frame, metres
        double cosine{1.0},               ///< of the heading of its frame
            sine{0.0};                    ///< of the same heading
        double rear{0.0},                 ///< metres from the frame to its trailing side, negative behind the frame
            front{0.0};                   ///< metres from the frame to its leading side
        double half{0.0};                 ///< metres to either side

        /** \brief A point in the frame of the rectangle. */
        Eigen::Vector2d toFrame(const Eigen::Vector2d &point) const
        {
            const Eigen::Vector2d off = point - place;
            return {cosine * off.x() + sine * off.y(), cosine * off.y() - sine * off.x()};
        }

        /** \brief Its centre, in the coordinates of the world. */
        Eigen::Vector2d middle() const
        {
            return place + 0.5 * (rear + front) * Eigen::Vector2d(cosine, sine);
        }

        /** \brief The axis-parallel box round it. */
        Box box() const;
    };

    /** \brief The outlines of all obstacles of a world, found by where they are: for the referee, and written for it.

        Edges lie in square buckets of the world, a slanting one in those that it passes through. What lies outside of
        the bounds is entered at their rim, which is nearer than it is. */
    class Outlines
    {
    public:
        /** \brief One of the straight lines of an outline. */
        struct Edge
        {
            Eigen::Vector2d from,  ///< one end, metres, in the coordinates of the world
                to;                ///< the other end
        };

        Outlines() = default;

        /** \brief \param bounds of the world that is asked about, not empty */
        explicit Outlines(const Box &bounds);

        /** \brief A solid obstacle. Self-intersecting ones are inside where a ray leaves them an odd number of times.
         */
        void add(const Polygon &polygon);

        /** \brief A piece of an outline that nothing is inside of. */
        void add(const Edge &edge);

        /** \brief Calls \e visit for each edge that may meet the box, some of them several times, until it says false.
            \return were all of them visited? */
        template <class Visit>
        bool visit(const Box &box, const Visit &visit) const
        {
            const std::size_t firstColumn = columnOf(box.min.x()), lastColumn = columnOf(box.max.x());
            for (std::size_t row = rowOf(box.min.y()); row <= rowOf(box.max.y()); ++row)
                for (std::size_t column = firstColumn; column <= lastColumn; ++column)
                    for (const std::size_t index : buckets_[row * columns_ + column].edges)
                        if (!visit(edges_[index]))
                            return false;
            return true;
        }

        /** \brief Metres between the rectangle's outline or interior and the nearest edge, 0 when they meet; exact if
            less than \e enough, otherwise some number from \e enough up to the distance. */
        double distance(const Rectangle &rectangle, double enough) const;

        /** \brief Is the point, which lies within the bounds, inside of a polygon? */
        bool isInside(const Eigen::Vector2d &point) const;

    private:
        struct Bucket
        {
            std::vector<std::size_t> edges;
            std::vector<std::size_t> polygons;  ///< small ones whose box meets the bucket
        };
        struct Solid
        {
            Polygon polygon;
            Box box;
        };
        /** An edge of a large polygon. */
        struct RowEdge
        {
            Edge edge;
            std::size_t polygon;
        };

        std::size_t columnOf(double x) const;
        std::size_t rowOf(double y) const;
        bool isInsideLarge(const Eigen::Vector2d &point) const;

        Box bounds_;
        double side_{1.0};  ///< of a bucket, metres
        std::size_t columns_{1}, rows_{1};
        std::vector<Bucket> buckets_;
        std::vector<Edge> edges_;
        std::vector<Solid> small_;
        std::size_t largeCount_{0};
        /** Of the polygons whose box meets too many buckets: by rows of buckets, each polygon's edges in succession. */
        std::vector<std::vector<RowEdge>> large_;
    };
}  // namespace parking
