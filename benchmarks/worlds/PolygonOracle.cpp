#include "benchmarks/worlds/PolygonOracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace parking_test
{
    using namespace parking;

    namespace
    {
        using Real = long double;  // at least as precise as double

        struct Point
        {
            Real x, y;
        };

        Real square(Real x, Real y)
        {
            return x * x + y * y;
        }

        /** Maximum distance in metres of the enlarged body from the middle of the rear axle. */
        double reachOf(const Vehicle &vehicle, double margin)
        {
            return 1e-9 +
                   std::hypot(std::max(vehicle.rearOverhang, vehicle.wheelbase + vehicle.frontOverhang) + margin,
                              0.5 * vehicle.width + margin) +
                   (vehicle.outline.empty() ? 0.0 : std::abs(margin));
        }

        /** Lower bound of the distance of the box from the rear axle. */
        double distance(const Pose &pose, const Box &box)
        {
            const Eigen::Vector2d at(pose.x, pose.y);
            return (box.min - at).cwiseMax(at - box.max).cwiseMax(0.0).norm();
        }
    }  // namespace

    /** The body at a pose; points of the world are transformed into its frame. */
    struct PolygonOracle::Body
    {
        Body(const Pose &pose, const Vehicle &vehicle, double margin)
          : x(pose.x),
            y(pose.y),
            cosine(std::cos(pose.yaw)),
            sine(std::sin(pose.yaw)),
            rear(-static_cast<Real>(vehicle.rearOverhang) - margin),
            front(static_cast<Real>(vehicle.wheelbase) + vehicle.frontOverhang + margin),
            side(0.5L * vehicle.width + margin),
            spread(vehicle.outline.empty() ? 0.0 : std::max(margin, 0.0))
        {
            // A positive margin of an outline is a distance, a negative one moves the sides inwards.
            const Polygon &corners = vehicle.outline;
            const std::size_t count = corners.size();
            for (std::size_t i = 0; i < count; ++i)
            {
                const Eigen::Vector2d in = (corners[i] - corners[(i + count - 1) % count]).normalized();
                const Eigen::Vector2d out = (corners[(i + 1) % count] - corners[i]).normalized();
                const Real more = std::min<Real>(margin, 0.0L) / (1.0L + in.dot(out));
                outline.push_back(
                    {corners[i].x() + more * (in.y() + out.y()), corners[i].y() - more * (in.x() + out.x())});
            }
        }

        Point toCar(const Point &point) const
        {
            const Real dx = point.x - x, dy = point.y - y;
            return {cosine * dx + sine * dy, cosine * dy - sine * dx};
        }

        Point toCar(const Eigen::Vector2d &point) const
        {
            return toCar(Point{point.x(), point.y()});
        }

        /** Corners relative to the rear axle, along the axes of the world. */
        std::vector<Point> corners() const
        {
            std::vector<Point> result = outline;
            if (result.empty())
                result = {{rear, -side}, {front, -side}, {front, side}, {rear, side}};
            for (Point &point : result)
                point = {cosine * point.x - sine * point.y, sine * point.x + cosine * point.y};
            return result;
        }

        /** Metres between the outermost corners and the sides of a box; not positive if a corner is outside. */
        Real distanceWithin(const Box &box) const
        {
            Real least = std::numeric_limits<Real>::infinity();
            for (const Point &corner : corners())
                least = std::min({least, x - box.min.x() + corner.x, box.max.x() - x - corner.x,
                                  y - box.min.y() + corner.y, box.max.y() - y - corner.y});
            return least - spread;
        }

        /** Whether the segment has a point in the closed body: the part of it between opposite sides, axis by axis. */
        bool touches(const Point &a, const Point &b) const
        {
            if (!outline.empty())
                return spread > 0.0L ? distanceToOutline(a, b) <= spread : meetsOutline(a, b);
            Real begin = 0.0L, end = 1.0L;
            return within(a.x, b.x, rear, front, begin, end) && within(a.y, b.y, -side, side, begin, end);
        }

        /** Whether the segment has a point in the closed outline: an end is inside, or sides are met. */
        bool meetsOutline(const Point &a, const Point &b) const
        {
            const auto turn = [](const Point &p, const Point &q, const Point &r)
            {
                return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
            };
            bool inside = false;
            Point from = outline.back();
            for (const Point &to : outline)
            {
                const Real ofFrom = turn(a, b, from), ofTo = turn(a, b, to);
                const Real ofA = turn(from, to, a), ofB = turn(from, to, b);
                const bool isApart =
                    std::max(a.x, b.x) < std::min(from.x, to.x) || std::min(a.x, b.x) > std::max(from.x, to.x) ||
                    std::max(a.y, b.y) < std::min(from.y, to.y) || std::min(a.y, b.y) > std::max(from.y, to.y);
                if (!isApart && ofFrom * ofTo <= 0.0L && ofA * ofB <= 0.0L)
                    return true;
                if ((from.y > a.y) != (to.y > a.y) && from.x + (a.y - from.y) * (to.x - from.x) / (to.y - from.y) > a.x)
                    inside = !inside;
                from = to;
            }
            return inside;
        }

        /** Distance of a segment from the solid outline. */
        Real distanceToOutline(const Point &a, const Point &b) const
        {
            if (meetsOutline(a, b))
                return 0.0L;
            const auto toSegment = [](const Point &p, const Point &from, const Point &to)
            {
                const Real dx = to.x - from.x, dy = to.y - from.y, length = square(dx, dy);
                const Real t =
                    length > 0.0L ? std::clamp(((p.x - from.x) * dx + (p.y - from.y) * dy) / length, 0.0L, 1.0L) : 0.0L;
                return square(p.x - from.x - t * dx, p.y - from.y - t * dy);
            };
            Real least = std::numeric_limits<Real>::infinity();
            Point from = outline.back();
            for (const Point &to : outline)
            {
                least = std::min({least, toSegment(a, from, to), toSegment(b, from, to), toSegment(from, a, b)});
                from = to;
            }
            return std::sqrt(least);
        }

        static bool within(Real a, Real b, Real low, Real high, Real &begin, Real &end)
        {
            if (std::max(a, b) < low || std::min(a, b) > high)
                return false;
            if (a == b)
                return true;
            const Real atLow = (low - a) / (b - a), atHigh = (high - a) / (b - a);
            begin = std::max(begin, std::min(atLow, atHigh));
            end = std::min(end, std::max(atLow, atHigh));
            return begin <= end;
        }

        /** If no side of the polygon has a point in the body, it lies outside or round all of the body. */
        template <class Corners>
        bool touches(const Corners &polygon) const
        {
            bool inside = false;
            const Point start = outline.empty() ? Point{0.0L, 0.0L} : outline.front();
            Point a = toCar(polygon.back());
            for (const auto &corner : polygon)
            {
                const Point b = toCar(corner);
                if (touches(a, b))
                    return true;
                // Whether a ray from a point of the body to the right is crossed. That point never touches a side, or
                // the body would.
                if ((a.y > start.y) != (b.y > start.y) && a.x - (a.y - start.y) * (b.x - a.x) / (b.y - a.y) > start.x)
                    inside = !inside;
                a = b;
            }
            return inside;
        }

        /** Distance of a segment outside of the body. */
        Real distance(const Point &a, const Point &b) const
        {
            if (!outline.empty())
                return distanceToOutline(a, b) - spread;
            const auto toBody = [this](const Point &p)
            {
                return square(std::max({rear - p.x, 0.0L, p.x - front}), std::max({-side - p.y, 0.0L, p.y - side}));
            };
            const auto toSegment = [&](Real px, Real py)
            {
                const Real dx = b.x - a.x, dy = b.y - a.y, length = square(dx, dy);
                const Real t =
                    length > 0.0L ? std::clamp(((px - a.x) * dx + (py - a.y) * dy) / length, 0.0L, 1.0L) : 0.0L;
                return square(px - a.x - t * dx, py - a.y - t * dy);
            };
            return std::sqrt(std::min({toBody(a), toBody(b), toSegment(rear, -side), toSegment(rear, side),
                                       toSegment(front, -side), toSegment(front, side)}));
        }

        Real x, y, cosine, sine;
        Real rear, front, side;
        Real spread;                 ///< distance that an outline must keep
        std::vector<Point> outline;  ///< of a body that is not a rectangle, in the frame of the car
    };

    PolygonOracle::PolygonOracle(std::vector<Polygon> obstacles, const Box &bounds)
      : obstacles_(std::move(obstacles)),
        bounds_(bounds)
    {
        for (const Polygon &polygon : obstacles_)
        {
            Box box{polygon.front(), polygon.front()};
            for (const Eigen::Vector2d &corner : polygon)
                box = {box.min.cwiseMin(corner), box.max.cwiseMax(corner)};
            boxes_.push_back(box);
        }
    }

    PolygonOracle::PolygonOracle(const OccupancyGrid &grid, bool unknownIsOccupied)
      : grid_(grid),
        unknownIsOccupied_(unknownIsOccupied)
    {
    }

    PolygonOracle::PolygonOracle(const Scenario &scenario)
      : PolygonOracle(scenario.grid ? PolygonOracle(*scenario.grid, scenario.unknownIsOccupied)
                                    : PolygonOracle(scenario.polygons, scenario.bounds))
    {
    }

    bool PolygonOracle::isFree(const Pose &pose, const Vehicle &vehicle, double margin) const
    {
        if (grid_)
            return isFreeOfCells(Body(pose, vehicle, margin));
        const double reach = reachOf(vehicle, margin);
        std::optional<Body> body;  // computed only near an obstacle, which is rare
        const auto madeBody = [&]() -> const Body &
        {
            return body ? *body : body.emplace(pose, vehicle, margin);
        };
        const bool isWithin = pose.x - bounds_.min.x() > reach && bounds_.max.x() - pose.x > reach &&
                              pose.y - bounds_.min.y() > reach && bounds_.max.y() - pose.y > reach;
        if (!isWithin && !(madeBody().distanceWithin(bounds_) > 0.0L))
            return false;
        for (std::size_t k = 0; k < obstacles_.size(); ++k)
            if (distance(pose, boxes_[k]) <= reach && madeBody().touches(obstacles_[k]))
                return false;
        return true;
    }

    double PolygonOracle::clearance(const Pose &pose, const Vehicle &vehicle, double margin) const
    {
        if (!isFree(pose, vehicle, margin))
            return 0.0;
        const Body body(pose, vehicle, margin);
        const double reach = reachOf(vehicle, margin);
        Real least = body.distanceWithin(bounds_);
        for (std::size_t k = 0; k < obstacles_.size(); ++k)
        {
            if (distance(pose, boxes_[k]) - reach > least)
                continue;
            Point a = body.toCar(obstacles_[k].back());
            for (const Eigen::Vector2d &corner : obstacles_[k])
            {
                const Point b = body.toCar(corner);
                least = std::min(least, body.distance(a, b));
                a = b;
            }
        }
        return static_cast<double>(least);
    }

    bool PolygonOracle::isArcFree(const Pose &from, double curvature, double length, const Vehicle &vehicle,
                                  double step, double margin) const
    {
        return isPathFree({from, {{curvature, length}}}, vehicle, step, margin);
    }

    bool PolygonOracle::isPathFree(const Path &path, const Vehicle &vehicle, double step, double margin) const
    {
        Pose pose = path.start;
        if (!isFree(pose, vehicle, margin))
            return false;
        const double reach = reachOf(vehicle, std::max(margin, 0.0));
        for (const PathPiece &piece : path.pieces)
        {
            const double steepest = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            // Both for the whole piece: the motion of the body, and the distance of the checks.
            const double moved = piece.driven() + (steepest * piece.driven() + std::abs(piece.turn)) * reach;
            const double apart = piece.driven() + std::abs(piece.turn) * reach;
            // Every pose is computed from the begin of the piece, so that rounding does not accumulate.
            const std::function<bool(double, double)> isPartFree = [&](double begin, double end)
            {
                const double half = 0.5 * (end - begin), middle = begin + half;
                PathPiece part(piece.curvature, middle * piece.length, piece.sharpness);
                part.turn = middle * piece.turn;
                const Pose at = advance(pose, part);
                if (isFree(at, vehicle, margin + half * moved))
                    return true;
                return isFree(at, vehicle, margin) &&
                       (2.0 * half * apart <= step || (isPartFree(begin, middle) && isPartFree(middle, end)));
            };
            const Pose end = advance(pose, piece);
            if (!isFree(end, vehicle, margin) || !isPartFree(0.0, 1.0))
                return false;
            pose = end;
        }
        return true;
    }

    bool PolygonOracle::isFreeOfCells(const Body &world) const
    {
        // The body in the frame of the map, in metres from its corner.
        const Pose &origin = grid_->origin();
        const Real c = std::cos(origin.yaw), s = std::sin(origin.yaw);
        const Real dx = world.x - origin.x, dy = world.y - origin.y;
        Body body = world;
        body.x = c * dx + s * dy;
        body.y = c * dy - s * dx;
        body.cosine = world.cosine * c + world.sine * s;
        body.sine = world.sine * c - world.cosine * s;

        const Real size = grid_->resolution();
        // One more cell on each side: a body that ends at a cell's border touches the adjacent cell.
        const auto index = [size](Real value, std::size_t count)
        {
            const long cell = static_cast<long>(std::floor(value / size));
            return static_cast<std::size_t>(std::clamp(cell, 0L, static_cast<long>(count) - 1));
        };
        constexpr Real INF = std::numeric_limits<Real>::infinity();
        Point low{INF, INF}, high{-INF, -INF};
        for (const Point &corner : body.corners())
        {
            low = {std::min(low.x, body.x + corner.x - body.spread), std::min(low.y, body.y + corner.y - body.spread)};
            high = {std::max(high.x, body.x + corner.x + body.spread),
                    std::max(high.y, body.y + corner.y + body.spread)};
        }
        if (!(low.x > 0.0L && low.y > 0.0L && high.x < size * static_cast<Real>(grid_->width()) &&
              high.y < size * static_cast<Real>(grid_->height())))
            return false;
        for (std::size_t row = index(low.y - size, grid_->height()); row <= index(high.y + size, grid_->height());
             ++row)
            for (std::size_t column = index(low.x - size, grid_->width());
                 column <= index(high.x + size, grid_->width()); ++column)
            {
                const Cell cell = grid_->at(column, row);
                if (cell == Cell::Free || (cell == Cell::Unknown && !unknownIsOccupied_))
                    continue;
                const Real x = size * static_cast<Real>(column), y = size * static_cast<Real>(row);
                if (body.touches(std::array<Point, 4>{{{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}}))
                    return false;
            }
        return true;
    }
}  // namespace parking_test
