#include "parking_geometry/referee/Outlines.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double SIDE = 2.0;          // metres, of buckets in worlds of usual size
        constexpr double BUCKETS = 262144.0;  // approximate largest number of buckets
        constexpr double FIRST_LOOK = 0.25;   // metres about a box, which in most cases contain the nearest edge

        std::size_t clampIndex(double value, std::size_t count)
        {
            return static_cast<std::size_t>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
        }

        /** Whether the segments have a point in common; touching counts unless rounding hides it. */
        bool intersect(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c,
                       const Eigen::Vector2d &d)
        {
            const auto areApart = [](double first, double second)
            {
                return (first > 0.0 && second > 0.0) || (first < 0.0 && second < 0.0);
            };
            return !areApart(turn(a, b, c), turn(a, b, d)) && !areApart(turn(c, d, a), turn(c, d, b)) &&
                   (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
                   (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
        }

        /** Number of turns of the outline about the point; not zero inside. */
        int winding(const Polygon &outline, const Eigen::Vector2d &point)
        {
            int turns = 0;
            for (std::size_t i = 0; i < outline.size(); ++i)
            {
                const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
                if (a.y() <= point.y() && b.y() > point.y() && turn(a, b, point) > 0.0)
                    ++turns;
                if (a.y() > point.y() && b.y() <= point.y() && turn(a, b, point) < 0.0)
                    --turns;
            }
            return turns;
        }

        /** Distance in metres between the solid polygon and a segment. If it is at least \e enough, any value from
            \e enough up to it. */
        double distanceTo(const Polygon &shape, const Box &round, const Edge &edge, double enough)
        {
            const Eigen::Vector2d low = edge.from.cwiseMin(edge.to), high = edge.from.cwiseMax(edge.to);
            if ((low - round.max).cwiseMax(round.min - high).maxCoeff() >= enough)
                return enough;
            double nearest = enough;
            for (std::size_t i = 0; i < shape.size(); ++i)
            {
                const Eigen::Vector2d &a = shape[i], &b = shape[(i + 1) % shape.size()];
                if (intersect(a, b, edge.from, edge.to))
                    return 0.0;
                nearest = std::min({nearest, distanceToSegment(a, edge.from, edge.to),
                                    distanceToSegment(edge.from, a, b), distanceToSegment(edge.to, a, b)});
            }
            return winding(shape, edge.from) != 0 ? 0.0 : nearest;
        }

        /** Distance in metres between the box and a segment in its frame. If it is at least \e enough, any value from
            \e enough up to it. */
        double distanceInFrame(const Eigen::Vector2d &half, const Eigen::Vector2d &from, const Eigen::Vector2d &to,
                               double enough)
        {
            if ((from.cwiseMin(to).cwiseMax(-from.cwiseMax(to)) - half).maxCoeff() >= enough)
                return enough;
            // Where the segment runs between the lines through opposite sides.
            const Eigen::Vector2d along = to - from;
            double enter = 0.0, leave = 1.0;
            for (int axis = 0; axis < 2; ++axis)
            {
                if (along[axis] == 0.0)
                {
                    if (std::abs(from[axis]) > half[axis])
                        leave = -1.0;
                    continue;
                }
                const double first = (-half[axis] - from[axis]) / along[axis];
                const double second = (half[axis] - from[axis]) / along[axis];
                enter = std::max(enter, std::min(first, second));
                leave = std::min(leave, std::max(first, second));
            }
            if (enter <= leave)
                return 0.0;
            // They do not intersect, so an end of the segment or a corner of the box is one of the two nearest points.
            double nearest = enough;
            for (const Eigen::Vector2d &end : {from, to})
                nearest = std::min(nearest, (end.cwiseAbs() - half).cwiseMax(0.0).norm());
            for (const double x : {-half.x(), half.x()})
                for (const double y : {-half.y(), half.y()})
                    nearest = std::min(nearest, distanceToSegment({x, y}, from, to));
            return nearest;
        }
    }  // namespace

    Outlines::Outlines(const Box &bounds) : bounds_(bounds)
    {
        const Eigen::Vector2d size = bounds_.size();
        side_ = std::max({SIDE, std::sqrt(size.x() * size.y() / BUCKETS), size.maxCoeff() / BUCKETS});
        columns_ = static_cast<std::size_t>(std::max(std::ceil(size.x() / side_), 1.0));
        rows_ = static_cast<std::size_t>(std::max(std::ceil(size.y() / side_), 1.0));
        buckets_.resize(columns_ * rows_);
        rowEdges_.resize(rows_);
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
        for (std::size_t i = 0; i < polygon.size(); ++i)
        {
            const Edge edge{polygon[i], polygon[(i + 1) % polygon.size()]};
            add(edge);
            const std::size_t last = rowOf(std::max(edge.from.y(), edge.to.y()));
            for (std::size_t row = rowOf(std::min(edge.from.y(), edge.to.y())); row <= last; ++row)
                rowEdges_[row].push_back({edge, polygons_});
        }
        ++polygons_;
    }

    void Outlines::add(const Edge &edge)
    {
        edges_.push_back(edge);
        const Eigen::Vector2d low = edge.from.cwiseMin(edge.to), high = edge.from.cwiseMax(edge.to);
        const std::size_t firstRow = rowOf(low.y()), lastRow = rowOf(high.y());
        for (std::size_t row = firstRow; row <= lastRow; ++row)
        {
            // The part of the edge in this row, slightly enlarged for rounding. A long slanting edge lies in few
            // buckets of its bounding box.
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
                buckets_[row * columns_ + column].push_back(edges_.size() - 1);
        }
    }

    double Outlines::distance(const OrientedBox &box, double enough) const
    {
        const Eigen::Vector2d half(box.halfLength, box.halfWidth);
        return nearestEdge(box.bounds(), enough,
                           [&](const Edge &edge, double nearest)
                           { return distanceInFrame(half, box.toFrame(edge.from), box.toFrame(edge.to), nearest); });
    }

    double Outlines::distance(const Polygon &shape, double enough) const
    {
        Box round{shape.front(), shape.front()};
        for (const Eigen::Vector2d &corner : shape)
            round.include(corner);
        return nearestEdge(round, enough,
                           [&](const Edge &edge, double nearest) { return distanceTo(shape, round, edge, nearest); });
    }

    /** The smallest distance of a shape with the bounding box \e round from an edge. */
    template <class Distance>
    double Outlines::nearestEdge(const Box &round, double enough, const Distance &distance) const
    {
        double nearest = enough;
        for (double reach = FIRST_LOOK;; reach *= 4.0)
        {
            const Eigen::Vector2d around = Eigen::Vector2d::Constant(std::min(reach, nearest));
            const Box seen{round.min - around, round.max + around};
            const std::size_t lastRow = rowOf(seen.max.y()), lastColumn = columnOf(seen.max.x());
            for (std::size_t row = rowOf(seen.min.y()); row <= lastRow; ++row)
                for (std::size_t column = columnOf(seen.min.x()); column <= lastColumn; ++column)
                    for (const std::size_t index : buckets_[row * columns_ + column])
                    {
                        nearest = std::min(nearest, distance(edges_[index], nearest));
                        if (nearest <= 0.0)
                            return 0.0;
                    }
            const bool all =
                (seen.min.array() <= bounds_.min.array()).all() && (seen.max.array() >= bounds_.max.array()).all();
            if (nearest <= reach || all)
                return nearest;
        }
    }

    /** Like contains(), for all polygons at once. */
    bool Outlines::isInside(const Eigen::Vector2d &point) const
    {
        bool inside = false;
        std::size_t polygon = polygons_;
        for (const RowEdge &entry : rowEdges_[rowOf(point.y())])
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
