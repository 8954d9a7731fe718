#include "parking_geometry/referee/Outlines.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double SIDE = 2.0;          // metres, of buckets in worlds of usual size
        constexpr double BUCKETS = 262144.0;  // no more than about these
        constexpr std::size_t SMALL = 64;     // buckets: a polygon is listed in each as long as these are no more
        constexpr double FIRST_LOOK = 0.25;   // metres round a rectangle, where mostly the nearest edge is

        std::size_t clampIndex(double value, std::size_t count)
        {
            return static_cast<std::size_t>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
        }

        double distanceToSegment(const Eigen::Vector2d &point, const Eigen::Vector2d &from, const Eigen::Vector2d &to)
        {
            const Eigen::Vector2d along = to - from;
            const double square = along.squaredNorm();
            const double share = square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
            return (point - from - share * along).norm();
        }

        /** Metres between the rectangle and a segment in its frame, or any number from \e enough up where it is more.
         */
        double distanceInFrame(const Rectangle &shape, const Eigen::Vector2d &from, const Eigen::Vector2d &to,
                               double enough)
        {
            const Eigen::Vector2d low = from.cwiseMin(to), high = from.cwiseMax(to);
            const double ahead = std::max(low.x() - shape.front, shape.rear - high.x());
            const double aside = std::max(low.y(), -high.y()) - shape.half;
            if (ahead >= enough || aside >= enough)
                return enough;
            // Where the segment runs between the lines through opposite sides.
            const Eigen::Vector2d along = to - from;
            double enter = 0.0, leave = 1.0;
            for (int axis = 0; axis < 2; ++axis)
            {
                const double least = axis == 0 ? shape.rear : -shape.half;
                const double most = axis == 0 ? shape.front : shape.half;
                if (along[axis] == 0.0)
                {
                    if (from[axis] < least || from[axis] > most)
                        leave = -1.0;
                    continue;
                }
                const double first = (least - from[axis]) / along[axis], second = (most - from[axis]) / along[axis];
                enter = std::max(enter, std::min(first, second));
                leave = std::min(leave, std::max(first, second));
            }
            if (enter <= leave)
                return 0.0;
            // Apart, so that an end of the segment or a corner of the rectangle is one of the two nearest points.
            double nearest = enough;
            for (const Eigen::Vector2d &end : {from, to})
                nearest = std::min(nearest, std::hypot(std::max({shape.rear - end.x(), 0.0, end.x() - shape.front}),
                                                       std::max(0.0, std::abs(end.y()) - shape.half)));
            for (const double x : {shape.rear, shape.front})
                for (const double y : {-shape.half, shape.half})
                    nearest = std::min(nearest, distanceToSegment({x, y}, from, to));
            return nearest;
        }
    }  // namespace

    Box Rectangle::box() const
    {
        const Eigen::Vector2d reach(0.5 * (front - rear) * std::abs(cosine) + half * std::abs(sine),
                                    0.5 * (front - rear) * std::abs(sine) + half * std::abs(cosine));
        return {middle() - reach, middle() + reach};
    }

    Outlines::Outlines(const Box &bounds) : bounds_(bounds)
    {
        const Eigen::Vector2d size = bounds_.size();
        side_ = std::max({SIDE, std::sqrt(size.x() * size.y() / BUCKETS), size.maxCoeff() / BUCKETS});
        columns_ = static_cast<std::size_t>(std::max(std::ceil(size.x() / side_), 1.0));
        rows_ = static_cast<std::size_t>(std::max(std::ceil(size.y() / side_), 1.0));
        buckets_.resize(columns_ * rows_);
        large_.resize(rows_);
    }

    std::size_t Outlines::columnOf(double x) const
    {
        return clampIndex((x - bounds_.min.x()) / side_, columns_);
    }

    std::size_t Outlines::rowOf(double y) const
    {
        return clampIndex((y - bounds_.min.y()) / side_, rows_);
    }

    void Outlines::add(const Polygon &polygon)
    {
        Box box{polygon.front(), polygon.front()};
        for (const Eigen::Vector2d &corner : polygon)
            box.include(corner);
        const std::size_t firstColumn = columnOf(box.min.x()), lastColumn = columnOf(box.max.x());
        const std::size_t firstRow = rowOf(box.min.y()), lastRow = rowOf(box.max.y());
        const bool isSmall = (lastColumn - firstColumn + 1) * (lastRow - firstRow + 1) <= SMALL;
        for (std::size_t row = firstRow; isSmall && row <= lastRow; ++row)
            for (std::size_t column = firstColumn; column <= lastColumn; ++column)
                buckets_[row * columns_ + column].polygons.push_back(small_.size());
        for (std::size_t i = 0; i < polygon.size(); ++i)
        {
            const Edge edge{polygon[i], polygon[(i + 1) % polygon.size()]};
            add(edge);
            for (std::size_t row = rowOf(std::min(edge.from.y(), edge.to.y()));
                 !isSmall && row <= rowOf(std::max(edge.from.y(), edge.to.y())); ++row)
                large_[row].push_back({edge, largeCount_});
        }
        if (isSmall)
            small_.push_back({polygon, box});
        else
            ++largeCount_;
    }

    void Outlines::add(const Edge &edge)
    {
        edges_.push_back(edge);
        const Eigen::Vector2d low = edge.from.cwiseMin(edge.to), high = edge.from.cwiseMax(edge.to);
        const std::size_t firstRow = rowOf(low.y()), lastRow = rowOf(high.y());
        for (std::size_t row = firstRow; row <= lastRow; ++row)
        {
            // The part of the edge in this row, a little more for rounding; a long slanting edge is in few buckets of
            // its box.
            double left = low.x(), right = high.x();
            if (firstRow < lastRow)
            {
                const double bottom = bounds_.min.y() + side_ * (static_cast<double>(row) - 0.01);
                const double slope = (edge.to.x() - edge.from.x()) / (edge.to.y() - edge.from.y());
                const double atBottom = edge.from.x() + slope * (std::clamp(bottom, low.y(), high.y()) - edge.from.y());
                const double atTop =
                    edge.from.x() + slope * (std::clamp(bottom + 1.02 * side_, low.y(), high.y()) - edge.from.y());
                left = std::max(left, std::min(atBottom, atTop) - 0.01 * side_);
                right = std::min(right, std::max(atBottom, atTop) + 0.01 * side_);
            }
            for (std::size_t column = columnOf(left); column <= columnOf(right); ++column)
                buckets_[row * columns_ + column].edges.push_back(edges_.size() - 1);
        }
    }

    double Outlines::distance(const Rectangle &rectangle, double enough) const
    {
        const Box box = rectangle.box();
        double nearest = enough;
        for (double reach = FIRST_LOOK;; reach *= 4.0)
        {
            const Eigen::Vector2d around = Eigen::Vector2d::Constant(std::min(reach, nearest));
            const Box seen{box.min - around, box.max + around};
            visit(seen,
                  [&](const Edge &edge)
                  {
                      nearest = std::min(nearest, distanceInFrame(rectangle, rectangle.toFrame(edge.from),
                                                                  rectangle.toFrame(edge.to), nearest));
                      return nearest > 0.0;
                  });
            const bool all =
                (seen.min.array() <= bounds_.min.array()).all() && (seen.max.array() >= bounds_.max.array()).all();
            if (nearest <= reach || all)
                return nearest;
        }
    }

    bool Outlines::isInside(const Eigen::Vector2d &point) const
    {
        for (const std::size_t index : buckets_[rowOf(point.y()) * columns_ + columnOf(point.x())].polygons)
            if (small_[index].box.contains(point.x(), point.y()) && contains(small_[index].polygon, point))
                return true;
        return isInsideLarge(point);
    }

    /** As contains(), for all large polygons at once. */
    bool Outlines::isInsideLarge(const Eigen::Vector2d &point) const
    {
        bool inside = false;
        std::size_t polygon = largeCount_;
        for (const RowEdge &entry : large_[rowOf(point.y())])
        {
            if (entry.polygon != polygon)
            {
                if (inside)
                    return true;
                polygon = entry.polygon;
            }
            const Eigen::Vector2d a = entry.edge.to - point, b = entry.edge.from - point;
            if ((a.y() > 0.0) == (b.y() > 0.0))
                continue;
            if ((a.x() * b.y() - a.y() * b.x() > 0.0) == (b.y() > a.y()))
                inside = !inside;
        }
        return inside;
    }
}  // namespace parking
