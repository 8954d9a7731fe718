#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace parking_test
{
    using namespace parking;

    /** \brief The exact answers of FootprintQueries for obstacles given as polygons (convex or not), written for
        clarity: every edge against the body's rectangle, in the frame of the car. Touching is free. */
    class PolygonWorld
    {
    public:
        /** \param touching how deep a body may reach into an obstacle and still count as touching, metres */
        PolygonWorld(const Vehicle &vehicle, std::vector<Polygon> obstacles, double touching = 1e-9)
          : vehicle_(vehicle),
            obstacles_(std::move(obstacles)),
            touching_(touching)
        {
            for (const Polygon &polygon : obstacles_)
            {
                Circle circle{Eigen::Vector2d::Zero(), 0.0};
                for (const Eigen::Vector2d &corner : polygon)
                    circle.centre += corner / static_cast<double>(polygon.size());
                for (const Eigen::Vector2d &corner : polygon)
                    circle.radius = std::max(circle.radius, (corner - circle.centre).norm());
                circles_.push_back(circle);
            }
            reach_ = std::hypot(0.5 * vehicle.length(), 0.5 * vehicle.width);
        }

        bool isFree(const Pose &pose) const
        {
            const Box body = box(-touching_);
            const Eigen::Vector2d centre = middle(pose);
            for (std::size_t k = 0; k < obstacles_.size(); ++k)
            {
                const Polygon &polygon = obstacles_[k];
                if ((circles_[k].centre - centre).norm() > circles_[k].radius + reach_)
                    continue;
                if (contains(polygon, centre))
                    return false;
                for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
                    if (cuts(body, toCar(pose, polygon[j]), toCar(pose, polygon[i])))
                        return false;
            }
            return true;
        }

        /** The exact distance; 0 when colliding or touching. */
        double clearance(const Pose &pose) const
        {
            const Box body = box(0.0);
            double least = std::numeric_limits<double>::infinity();
            const Eigen::Vector2d centre = middle(pose);
            for (std::size_t k = 0; k < obstacles_.size(); ++k)
            {
                const Polygon &polygon = obstacles_[k];
                if ((circles_[k].centre - centre).norm() - circles_[k].radius - reach_ > least)
                    continue;
                if (contains(polygon, centre))
                    return 0.0;
                for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
                    least = std::min(least, distance(body, toCar(pose, polygon[j]), toCar(pose, polygon[i])));
            }
            return least;
        }

        /** Callables that refer to this world; isPathFree is left to the library. */
        FootprintQueries queries() const
        {
            FootprintQueries result;
            result.isFree = [this](const Pose &pose)
            {
                return isFree(pose);
            };
            result.clearance = [this](const Pose &pose)
            {
                return clearance(pose);
            };
            return result;
        }

        /** Is the whole motion free? Poses are tested ever closer to each other until their distances to the obstacles
            cover all that the body may do between them, down to motions of \e finest metres. */
        bool isPathFree(const Path &path, double finest = 1e-4) const
        {
            Pose pose = path.start;
            for (const PathPiece &piece : path.pieces)
            {
                if (!isPieceFree(pose, piece, finest))
                    return false;
                pose = advance(pose, piece);
            }
            return true;
        }

    private:
        struct Circle
        {
            Eigen::Vector2d centre;
            double radius;
        };

        struct Box
        {
            double x0, x1, y;
        };

        Box box(double grown) const
        {
            return {-vehicle_.rearOverhang - grown, vehicle_.wheelbase + vehicle_.frontOverhang + grown,
                    0.5 * vehicle_.width + grown};
        }

        Eigen::Vector2d middle(const Pose &pose) const
        {
            const double ahead = 0.5 * (vehicle_.wheelbase + vehicle_.frontOverhang - vehicle_.rearOverhang);
            return {pose.x + ahead * std::cos(pose.yaw), pose.y + ahead * std::sin(pose.yaw)};
        }

        bool isPieceFree(const Pose &from, const PathPiece &piece, double finest) const
        {
            const double driven = 0.5 * piece.driven(), turn = 0.5 * piece.turn;
            PathPiece first(piece.curvature, 0.5 * piece.length, piece.sharpness);
            PathPiece second(piece.curvatureAt(driven), 0.5 * piece.length, piece.sharpness);
            first.turn = second.turn = turn;
            const Pose pose = advance(from, first);
            const double steepest = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            const double moved = driven + (steepest * driven + std::abs(turn)) * farthestCorner(vehicle_);
            const double distance = clearance(pose);
            if (distance > moved)
                return true;
            if (distance == 0.0 && !isFree(pose))
                return false;
            return moved < finest || (isPieceFree(from, first, finest) && isPieceFree(pose, second, finest));
        }

        static Eigen::Vector2d toCar(const Pose &pose, const Eigen::Vector2d &point)
        {
            const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
            const double dx = point.x() - pose.x, dy = point.y() - pose.y;
            return {c * dx + s * dy, c * dy - s * dx};
        }

        /** Does the segment meet the inside of the box (Liang and Barsky)? */
        static bool cuts(const Box &box, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
        {
            const Eigen::Vector2d d = b - a;
            double enter = 0.0, leave = 1.0;
            for (const auto &[p, q] : {std::pair{-d.x(), a.x() - box.x0},
                                       {d.x(), box.x1 - a.x()},
                                       {-d.y(), a.y() + box.y},
                                       {d.y(), box.y - a.y()}})
            {
                if (p == 0.0)
                {
                    if (q <= 0.0)
                        return false;
                }
                else if (p < 0.0)
                    enter = std::max(enter, q / p);
                else
                    leave = std::min(leave, q / p);
            }
            return enter < leave;
        }

        static double distance(const Box &box, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
        {
            if (cuts(box, a, b))
                return 0.0;
            const auto toBox = [&](const Eigen::Vector2d &p)
            {
                return std::hypot(std::max({box.x0 - p.x(), 0.0, p.x() - box.x1}),
                                  std::max(std::abs(p.y()) - box.y, 0.0));
            };
            const Eigen::Vector2d d = b - a;
            const auto toSegment = [&](double x, double y)
            {
                const Eigen::Vector2d p = Eigen::Vector2d(x, y) - a;
                const double t = d.squaredNorm() > 0.0 ? std::clamp(p.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
                return (p - t * d).norm();
            };
            return std::min({toBox(a), toBox(b), toSegment(box.x0, box.y), toSegment(box.x0, -box.y),
                             toSegment(box.x1, box.y), toSegment(box.x1, -box.y)});
        }

        Vehicle vehicle_;
        std::vector<Polygon> obstacles_;
        std::vector<Circle> circles_;  ///< round each obstacle
        double reach_{0.0};            ///< radius of the circle round the body
        double touching_;
    };
}  // namespace parking_test
