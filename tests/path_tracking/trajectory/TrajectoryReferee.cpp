#include "tests/path_tracking/trajectory/TrajectoryReferee.h"

#include "benchmarks/worlds/PolygonOracle.h"

#include <cmath>
#include <limits>

namespace parking::test
{
    namespace
    {
        constexpr double FAR = std::numeric_limits<double>::infinity();
        const Box EVERYWHERE{{-FAR, -FAR}, {FAR, FAR}};

        void step(Pose &car, double v, double steering, double h, double wheelbase)
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
                return "the time does not increase" + at;
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
        return !parking_test::PolygonOracle(obstacles, EVERYWHERE).isFree(pose, vehicle);
    }

    Verdict judge(const Trajectory &trajectory, const Vehicle &vehicle, const std::vector<Polygon> &obstacles)
    {
        Verdict verdict;
        if (trajectory.size() < 2)
            return {"no trajectory", {}, 0.0};
        if (std::abs(trajectory.front().v) > 1e-9 || std::abs(trajectory.back().v) > 1e-9)
            return {"not at rest at its ends", {}, 0.0};
        const parking_test::PolygonOracle oracle(obstacles, EVERYWHERE);
        Pose car{trajectory.front().x, trajectory.front().y, trajectory.front().yaw};
        for (std::size_t i = 1; i < trajectory.size(); ++i)
        {
            const TrajectoryPoint &p = trajectory[i - 1], &q = trajectory[i];
            verdict.fault = checkLimits(p, q, vehicle);
            const double h = q.t - p.t, parts = std::ceil(h / 0.002);
            for (double k = 0.5; k < parts && verdict.fault.empty(); k += 1.0)
            {
                step(car, p.v + k / parts * (q.v - p.v), p.steering + k / parts * (q.steering - p.steering), h / parts,
                     vehicle.wheelbase);
                if (!oracle.isFree(car, vehicle))
                    verdict.fault = "touches an obstacle at " + std::to_string(p.t) + " s";
            }
            if (verdict.fault.empty() && (std::hypot(car.x - q.x, car.y - q.y) > 1e-3 ||
                                          std::abs(std::remainder(car.yaw - q.yaw, 2.0 * PI)) > 1e-3))
                verdict.fault = "the poses are not the car's at " + std::to_string(q.t) + " s";
            if (!verdict.fault.empty())
                return verdict;
        }
        verdict.end = car;
        verdict.duration = trajectory.back().t - trajectory.front().t;
        return verdict;
    }
}  // namespace parking::test
