#pragma once

#include "path_tracking/control/Mpc.h"
#include "path_tracking/reference/TimedReference.h"
#include "tests/path_tracking/TestPaths.h"

#include <cmath>

namespace parking::test
{
    /** What the car drives along a path within its limits. */
    inline TimedReference referenceOf(const Path &path)
    {
        return {ReferencePath(path, Vehicle()), SpeedLimits()};
    }

    /** The controller's question \e time seconds into leg \e leg, the car off by \e error (in its own frame) and by
        \e speedError. */
    inline MpcProblem problemOn(const TimedReference &reference, std::size_t leg, double time, const MpcParameters &mpc,
                                const Pose &error = {}, double speedError = 0.0)
    {
        const int direction = reference.legs()[leg].direction;
        const TimedState now = reference.at(leg, time);
        MpcProblem problem;
        problem.pose = compose(now.pose, error);
        problem.direction = direction;
        problem.speed = direction * std::max(0.0, now.speed + speedError);
        problem.steeringNow = problem.wheels = now.steering;
        problem.speedNow = direction * now.speed;
        problem.accelerationNow = direction * (now.speed - reference.at(leg, time - mpc.step).speed) / mpc.step;
        problem.last = {problem.accelerationNow, now.steering};
        for (std::size_t k = 1; k <= mpc.horizon; ++k)
        {
            const TimedState state = reference.at(leg, time + static_cast<double>(k) * mpc.step);
            problem.reference.push_back({state.pose, direction * state.speed, state.steering});
        }
        return problem;
    }

    /** A random question of the kind, with an error of some centimetres and degrees. */
    inline MpcProblem randomProblem(std::uint64_t seed, const MpcParameters &mpc)
    {
        Random random(seed);
        const Path path = seed % 3 == 0   ? randomReedsShepp(seed, 12.0)
                          : seed % 3 == 1 ? randomLattice(seed, 12.0)
                                          : randomSmooth(seed, 12.0);
        const TimedReference reference = referenceOf(path);
        const auto leg = static_cast<std::size_t>(random.below(static_cast<int>(reference.legs().size())));
        MpcProblem problem =
            problemOn(reference, leg, random.between(0.0, reference.legs()[leg].duration), mpc,
                      {random.between(-0.1, 0.1), random.between(-0.1, 0.1), random.between(-0.1, 0.1)},
                      random.between(-0.3, 0.3));
        if (seed % 4 == 1)
        {
            problem.steeringLag = random.between(0.0, 0.3);
            problem.driveLag = random.between(0.0, 0.3);
            problem.acceleration = random.between(-0.5, 0.5);
            problem.wheels += random.between(-0.05, 0.05);
        }
        problem.align = seed % 2 == 0;
        return problem;
    }
}  // namespace parking::test
