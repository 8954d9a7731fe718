#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace parking_test
{
    /** \brief Says whether a car's rectangle touches an obstacle: the judge of all other collision tests.

        Written to be obviously right, with nothing of the library in it: every obstacle is carried into the frame of
        the car in extended precision, where the body is an axis-parallel rectangle round the origin. Obstacles are
        solid and closed, so touching is a collision; the outside of the bounds, and the bounds themselves, are an
        obstacle. Exact up to about 1e-15 m, also where coordinates are in the billions: they are subtracted from each
        other before anything else. */
    class PolygonOracle
    {
    public:
        using Real = long double;  ///< at least as precise as double

        /** \brief Solid polygons, of any orientation, within \e bounds. */
        PolygonOracle(std::vector<parking::Polygon> obstacles, const parking::Box &bounds)
          : obstacles_(std::move(obstacles)),
            bounds_(bounds)
        {
            for (const parking::Polygon &polygon : obstacles_)
            {
                double radius = 0.0;
                for (const Eigen::Vector2d &corner : polygon)
                    radius = std::max(radius, (corner - polygon.front()).norm());
                radii_.push_back(radius * (1.0 + 1e-12));
            }
        }

        /** \brief The cells of \e grid that are occupied, those that are unknown too unless told otherwise. */
        explicit PolygonOracle(const parking::OccupancyGrid &grid, bool unknownIsOccupied = true)
          : grid_(grid),
            isGrid_(true),
            unknownIsOccupied_(unknownIsOccupied)
        {
        }

        /** \brief What the scenario has: a grid, or polygons within its bounds; in its local coordinates. */
        explicit PolygonOracle(const parking::Scenario &scenario)
          : PolygonOracle(scenario.grid ? PolygonOracle(*scenario.grid, scenario.unknownIsOccupied)
                                        : PolygonOracle(scenario.polygons, scenario.bounds))
        {
        }

        /** \param margin metres by which the body is enlarged on each side; negative to shrink it */
        bool isFree(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin = 0.0) const
        {
            const Car car(pose, vehicle, margin);
            return isGrid_ ? isFreeOfCells(car) : isFreeOfPolygons(car);
        }

        /** \brief The distance between the body and the nearest obstacle; 0 when they touch. Not for grids. */
        double clearance(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin = 0.0) const
        {
            const Car car(pose, vehicle, margin);
            if (!isFreeOfPolygons(car))
                return 0.0;
            Real least = std::numeric_limits<Real>::infinity();
            for (const Point &corner : car.corners())
                least = std::min({least, car.x + corner.x - bounds_.min.x(), bounds_.max.x() - car.x - corner.x,
                                  car.y + corner.y - bounds_.min.y(), bounds_.max.y() - car.y - corner.y});
            for (const parking::Polygon &polygon : obstacles_)
                for (std::size_t i = 0; i < polygon.size(); ++i)
                    least = std::min(least, car.distance(car.toCar(polygon[i].x(), polygon[i].y()),
                                                         car.toCar(polygon[(i + 1) % polygon.size()].x(),
                                                                   polygon[(i + 1) % polygon.size()].y())));
            return static_cast<double>(least);
        }

        /** \brief Is the body free every \e step metres along an arc, and at its end?

            Steps are left out where the body is free even when enlarged by more than it moves until then.

            \param length signed metres */
        bool isArcFree(const parking::Pose &from, double curvature, double length, const parking::Vehicle &vehicle,
                       double step, double margin = 0.0) const
        {
            const double farthest =
                std::hypot(std::max(vehicle.rearOverhang, vehicle.wheelbase + vehicle.frontOverhang), vehicle.width);
            const double speed = 1.0 + std::abs(curvature) * (farthest + std::max(margin, 0.0));
            // Margins to try, the one that held last time first: neighbouring poses are much alike.
            constexpr std::array<double, 9> MARGINS{1.2, 0.6, 0.3, 0.15, 0.075, 0.038, 0.019, 0.01, 0.005};
            std::size_t level = 0;
            for (double driven = 0.0;;)
            {
                const parking::Pose pose =
                    parking::advance(from, curvature, std::copysign(std::min(driven, std::abs(length)), length));
                double skipped = 0.0;
                for (level -= level > 0; level < MARGINS.size() && MARGINS[level] / speed > step; ++level)
                    if (isFree(pose, vehicle, margin + MARGINS[level]))
                    {
                        skipped = MARGINS[level] / speed;
                        break;
                    }
                if (skipped == 0.0)
                {
                    if (!isFree(pose, vehicle, margin))
                        return false;
                    skipped = step;
                }
                if (driven >= std::abs(length))
                    return true;
                driven += skipped;
            }
        }

    private:
        struct Point
        {
            Real x, y;
        };

        /** The body at a pose; points given in the world are brought into its frame. */
        struct Car
        {
            Car(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin)
              : x(pose.x),
                y(pose.y),
                cosine(std::cos(static_cast<Real>(pose.yaw))),
                sine(std::sin(static_cast<Real>(pose.yaw))),
                rear(-static_cast<Real>(vehicle.rearOverhang) - margin),
                front(static_cast<Real>(vehicle.wheelbase) + vehicle.frontOverhang + margin),
                side(0.5L * vehicle.width + margin)
            {
            }

            Point toCar(Real px, Real py) const
            {
                const Real dx = px - x, dy = py - y;
                return {cosine * dx + sine * dy, cosine * dy - sine * dx};
            }

            /** Corners relative to the rear axle, along the axes of the world. */
            std::array<Point, 4> corners() const
            {
                const auto at = [this](Real along, Real across)
                {
                    return Point{cosine * along - sine * across, sine * along + cosine * across};
                };
                return {at(rear, -side), at(front, -side), at(front, side), at(rear, side)};
            }

            /** Does the segment have a point in the closed body? The part of it between opposite sides, axis by
                axis. */
            bool touches(const Point &a, const Point &b) const
            {
                Real begin = 0.0L, end = 1.0L;
                return within(a.x, b.x, rear, front, begin, end) && within(a.y, b.y, -side, side, begin, end);
            }

            static bool within(Real a, Real b, Real low, Real high, Real &begin, Real &end)
            {
                if (a == b)
                    return a >= low && a <= high;
                const Real atLow = (low - a) / (b - a), atHigh = (high - a) / (b - a);
                begin = std::max(begin, std::min(atLow, atHigh));
                end = std::min(end, std::max(atLow, atHigh));
                return begin <= end;
            }

            Real distance(const Point &a, const Point &b) const
            {
                if (touches(a, b))
                    return 0.0L;
                const auto toBody = [this](const Point &p)
                {
                    return std::hypot(std::max({rear - p.x, 0.0L, p.x - front}),
                                      std::max({-side - p.y, 0.0L, p.y - side}));
                };
                const auto toSegment = [&](Real px, Real py)
                {
                    const Real dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
                    const Real t =
                        square > 0.0L ? std::clamp(((px - a.x) * dx + (py - a.y) * dy) / square, 0.0L, 1.0L) : 0.0L;
                    return std::hypot(px - a.x - t * dx, py - a.y - t * dy);
                };
                return std::min({toBody(a), toBody(b), toSegment(rear, -side), toSegment(rear, side),
                                 toSegment(front, -side), toSegment(front, side)});
            }

            Real x, y, cosine, sine;
            Real rear, front, side;
        };

        bool isFreeOfPolygons(const Car &car) const
        {
            for (const Point &corner : car.corners())
                if (!(car.x - bounds_.min.x() + corner.x > 0.0L && bounds_.max.x() - car.x - corner.x > 0.0L &&
                      car.y - bounds_.min.y() + corner.y > 0.0L && bounds_.max.y() - car.y - corner.y > 0.0L))
                    return false;
            const double reach = 1e-9 + static_cast<double>(std::hypot(std::max(-car.rear, car.front), car.side));
            for (std::size_t k = 0; k < obstacles_.size(); ++k)
            {
                const parking::Polygon &polygon = obstacles_[k];
                const double dx = polygon.front().x() - static_cast<double>(car.x);
                const double dy = polygon.front().y() - static_cast<double>(car.y);
                const double near = radii_[k] + reach;
                if (dx * dx + dy * dy > near * near)
                    continue;
                // When no side of the polygon has a point in the body, it lies outside or round all of the body.
                bool inside = false;
                Point a = car.toCar(polygon.back().x(), polygon.back().y());
                for (const Eigen::Vector2d &corner : polygon)
                {
                    const Point b = car.toCar(corner.x(), corner.y());
                    if (car.touches(a, b))
                        return false;
                    // A ray from the rear axle to the right: is it crossed? Never touched, or the body would be.
                    if ((a.y > 0.0L) != (b.y > 0.0L) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0.0L)
                        inside = !inside;
                    a = b;
                }
                if (inside)
                    return false;
            }
            return true;
        }

        bool isFreeOfCells(const Car &world) const
        {
            // The car in the frame of the map, counted in metres from its corner.
            const parking::Pose &origin = grid_.origin();
            const Real c = std::cos(static_cast<Real>(origin.yaw)), s = std::sin(static_cast<Real>(origin.yaw));
            const Real dx = world.x - origin.x, dy = world.y - origin.y;
            Car car = world;
            car.x = c * dx + s * dy;
            car.y = c * dy - s * dx;
            car.cosine = world.cosine * c + world.sine * s;
            car.sine = world.sine * c - world.cosine * s;

            const Real size = grid_.resolution();
            Real lowX = car.x, highX = car.x, lowY = car.y, highY = car.y;
            for (const Point &corner : car.corners())
            {
                lowX = std::min(lowX, car.x + corner.x);
                highX = std::max(highX, car.x + corner.x);
                lowY = std::min(lowY, car.y + corner.y);
                highY = std::max(highY, car.y + corner.y);
            }
            if (!(lowX > 0.0L && lowY > 0.0L && highX < size * static_cast<Real>(grid_.width()) &&
                  highY < size * static_cast<Real>(grid_.height())))
                return false;
            // One cell more on each side: a body that ends at a cell's border touches the cell beyond.
            const auto index = [size](Real value, std::size_t count, long more)
            {
                const long cell = static_cast<long>(std::floor(value / size)) + more;
                return static_cast<std::size_t>(std::clamp(cell, 0L, static_cast<long>(count) - 1));
            };
            for (std::size_t row = index(lowY, grid_.height(), -1); row <= index(highY, grid_.height(), 1); ++row)
                for (std::size_t column = index(lowX, grid_.width(), -1); column <= index(highX, grid_.width(), 1);
                     ++column)
                {
                    const parking::Cell cell = grid_.at(column, row);
                    if (cell == parking::Cell::Occupied || (cell == parking::Cell::Unknown && unknownIsOccupied_))
                        if (touchesCell(car, size * static_cast<Real>(column), size * static_cast<Real>(row), size))
                            return false;
                }
            return true;
        }

        /** Two rectangles are apart exactly when they are along an axis of one of them. */
        static bool touchesCell(const Car &car, Real x, Real y, Real size)
        {
            const std::array<Point, 4> cell{car.toCar(x, y), car.toCar(x + size, y), car.toCar(x + size, y + size),
                                            car.toCar(x, y + size)};
            const auto ranges = [](const std::array<Point, 4> &points)
            {
                std::array<Real, 4> range{points[0].x, points[0].x, points[0].y, points[0].y};
                for (const Point &p : points)
                    range = {std::min(range[0], p.x), std::max(range[1], p.x), std::min(range[2], p.y),
                             std::max(range[3], p.y)};
                return range;
            };
            const std::array<Real, 4> c = ranges(cell);
            if (c[0] > car.front || c[1] < car.rear || c[2] > car.side || c[3] < -car.side)
                return false;
            const std::array<Real, 4> b = ranges(car.corners());
            return car.x + b[0] <= x + size && car.x + b[1] >= x && car.y + b[2] <= y + size && car.y + b[3] >= y;
        }

        std::vector<parking::Polygon> obstacles_;
        std::vector<double> radii_;  ///< round the first corner of each obstacle
        parking::Box bounds_;
        parking::OccupancyGrid grid_;
        bool isGrid_{false};
        bool unknownIsOccupied_{true};
    };
}  // namespace parking_test
