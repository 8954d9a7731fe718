#include "tests/path_tracking/trajectory/TrajectoryReferee.h"

#include <algorithm>
#include <cmath>

namespace parking::test
{
    namespace
    {
        using Point = Eigen::Vector2d;

        double cross(const Point &o, const Point &a, const Point &b)
        {
            return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
        }

        bool sidesCross(const Point &a, const Point &b, const Point &c, const Point &d)
        {
            return (cross(a, b, c) > 0.0) != (cross(a, b, d) > 0.0) && (cross(c, d, a) > 0.0) != (cross(c, d, b) > 0.0);
        }

        bool inside(const std::vector<Point> &polygon, const Point &p)
        {
            bool odd = false;
            for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
                if ((polygon[i].y() > p.y()) != (polygon[j].y() > p.y()) &&
                    p.x() < (polygon[j].x() - polygon[i].x()) * (p.y() - polygon[i].y()) /
                                    (polygon[j].y() - polygon[i].y()) +
                                polygon[i].x())
                    odd = !odd;
            return odd;
        }

        struct Drive
        {
            double x, y, yaw;
        };

        void step(Drive &car, double v, double steering, double h, double wheelbase)
        {
            // The midpoint rule, whose error of third order is nothing at these steps.
            const double rate = v * std::tan(steering) / wheelbase, middle = car.yaw + 0.5 * h * rate;
            car.x += h * v * std::cos(middle);
            car.y += h * v * std::sin(middle);
            car.yaw += h * rate;
        }

        std::string checkLimits(const TrajectoryPoint &p, const TrajectoryPoint &q, const Vehicle &car)
        {
            const double h = q.t - p.t, slack = 1.0001;
            const auto over = [&](double value, double limit)
            {
                return std::abs(value) > limit * slack;
            };
            const std::string at = " at " + std::to_string(p.t) + " s";
            if (!(h > 0.0))
                return "time does not go on" + at;
            if (over(q.v, car.maxSpeed))
                return "too fast" + at;
            if (over((q.v - p.v) / h, car.maxAcceleration))
                return "accelerates too much" + at;
            if (over(q.steering, car.maxSteeringAngle))
                return "steers too far" + at;
            return over((q.steering - p.steering) / h, car.maxSteeringRate) ? "steers too fast" + at : "";
        }
    }  // namespace

    bool touches(const Pose &pose, const Vehicle &vehicle, const std::vector<Polygon> &obstacles)
    {
        const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), half = 0.5 * vehicle.width;
        const double front = vehicle.wheelbase + vehicle.frontOverhang, rear = -vehicle.rearOverhang;
        std::vector<Point> body;
        for (const Point &p : {Point(rear, -half), Point(front, -half), Point(front, half), Point(rear, half)})
            body.emplace_back(pose.x + c * p.x() - s * p.y(), pose.y + s * p.x() + c * p.y());
        for (const Polygon &obstacle : obstacles)
        {
            const std::vector<Point> corners(obstacle.begin(), obstacle.end());
            if (inside(corners, body[0]) || inside(body, corners[0]))
                return true;
            for (std::size_t i = 0; i < corners.size(); ++i)
                for (std::size_t k = 0; k < 4; ++k)
                    if (sidesCross(corners[i], corners[(i + 1) % corners.size()], body[k], body[(k + 1) % 4]))
                        return true;
        }
        return false;
    }

    Verdict judge(const Trajectory &trajectory, const Vehicle &vehicle, const std::vector<Polygon> &obstacles)
    {
        Verdict verdict;
        if (trajectory.size() < 2)
            return {"no trajectory", {}, 0.0};
        if (std::abs(trajectory.front().v) > 1e-9 || std::abs(trajectory.back().v) > 1e-9)
            return {"not at rest at its ends", {}, 0.0};
        Drive car{trajectory.front().x, trajectory.front().y, trajectory.front().yaw};
        for (std::size_t i = 1; i < trajectory.size(); ++i)
        {
            const TrajectoryPoint &p = trajectory[i - 1], &q = trajectory[i];
            verdict.fault = checkLimits(p, q, vehicle);
            const double h = q.t - p.t, parts = std::ceil(h / 0.002);
            for (double k = 0.5; k < parts && verdict.fault.empty(); k += 1.0)
            {
                step(car, p.v + k / parts * (q.v - p.v), p.steering + k / parts * (q.steering - p.steering), h / parts,
                     vehicle.wheelbase);
                if (touches({car.x, car.y, car.yaw}, vehicle, obstacles))
                    verdict.fault = "touches an obstacle at " + std::to_string(p.t) + " s";
            }
            if (verdict.fault.empty() && (std::hypot(car.x - q.x, car.y - q.y) > 1e-3 ||
                                          std::abs(std::remainder(car.yaw - q.yaw, 2.0 * PI)) > 1e-3))
                verdict.fault = "the poses are not the car's at " + std::to_string(q.t) + " s";
            if (!verdict.fault.empty())
                return verdict;
        }
        verdict.end = {car.x, car.y, car.yaw};
        verdict.duration = trajectory.back().t - trajectory.front().t;
        return verdict;
    }
}  // namespace parking::test
