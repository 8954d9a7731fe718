#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Polygon.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "state_validity/FootprintChecker.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace parking::test
{
    inline const Box WIDE{{-60.0, -60.0}, {60.0, 60.0}};

    inline Polygon box(double x, double y, double length, double width, double angle)
    {
        Polygon corners;
        const double c = std::cos(angle), s = std::sin(angle);
        for (const Eigen::Vector2d &p : {Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(0.5, -0.5),
                                         Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(-0.5, 0.5)})
            corners.emplace_back(x + c * p.x() * length - s * p.y() * width,
                                 y + s * p.x() * length + c * p.y() * width);
        return corners;
    }

    /** The car with a body that reaches \e by metres farther on all sides. */
    inline Vehicle enlarged(Vehicle car, double by)
    {
        car.frontOverhang += by;
        car.rearOverhang += by;
        car.width += 2.0 * by;
        return car;
    }

    /** Boxes and triangles as near to the path as they fall without touching the car on it. */
    inline std::vector<Polygon> obstaclesBeside(const Path &path, const Vehicle &car, std::uint64_t seed, int attempts)
    {
        Random random(seed);
        const SampledPath states = path.sample(0.02);
        const Vehicle larger = enlarged(car, 0.01);  // what is between two states
        std::vector<Polygon> obstacles;
        for (int i = 0; i < attempts; ++i)
        {
            const Pose &near = states[random.index(states.size())].pose;
            Polygon obstacle = box(near.x + random.between(-6.0, 6.0), near.y + random.between(-6.0, 6.0),
                                   random.between(0.2, 5.0), random.between(0.2, 2.0), random.between(-PI, PI));
            if (random.chance(0.3))
                obstacle.pop_back();
            if (std::none_of(states.begin(), states.end(),
                             [&](const PathState &state) { return touches(state.pose, larger, {obstacle}); }))
                obstacles.push_back(obstacle);
        }
        return obstacles;
    }

    inline FootprintChecker checkerOf(const std::vector<Polygon> &obstacles, const Vehicle &car = {})
    {
        return FootprintChecker(ObstacleSet::fromPolygons(obstacles, WIDE), car);
    }

    /** Seconds that nobody who is at rest at both ends can drive \e length metres in. */
    inline double bangBang(double length, const Vehicle &car)
    {
        const double top = std::min(car.maxSpeed, std::sqrt(length * car.maxAcceleration));
        return length / top + top / car.maxAcceleration;
    }

    /** Seconds that nobody can drive the stretches of \e motion in: full acceleration and braking along each. */
    inline double bound(const TimedMotion &motion, const Vehicle &car)
    {
        double sum = 0.0, length = 0.0;
        for (std::size_t i = 1; i < motion.knots.size(); ++i)
        {
            const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
            length += 0.5 * std::abs(a.v + b.v) * (b.t - a.t);
            if (b.v != 0.0)
                continue;
            sum += length > 0.0 ? bangBang(length, car) : 0.0;
            length = 0.0;
        }
        return sum;
    }
}  // namespace parking::test
