#pragma once

#include "path_tracking/control/Mpc.h"
#include "path_tracking/reference/SpeedProfile.h"
#include "tests/path_tracking/TestPaths.h"

#include <cmath>

namespace parking::test
{
    /** The controller's question \e time seconds into leg \e leg of a timed path, the car off by \e error (in its own
        frame) and by \e speedError. */
    inline MpcProblem problemOn(const SpeedProfile &profile, std::size_t leg, double time, const MpcParameters &mpc,
                                const Pose &error = {}, double speedError = 0.0)
    {
        const ReferencePath &reference = profile.reference();
        const int direction = reference.legs()[leg].direction;
        const ProfilePoint now = profile.at(leg, time);
        MpcProblem problem;
        problem.pose = compose(reference.pose(leg, now.s), error);
        problem.direction = direction;
        problem.speed = direction * std::max(0.0, now.speed + speedError);
        problem.last = {direction * now.acceleration, reference.steering(leg, now.s)};
        problem.steeringNow = problem.last.steering;
        problem.speedNow = direction * now.speed;
        problem.accelerationNow = direction * now.acceleration;
        problem.wheels = problem.last.steering;
        for (std::size_t k = 1; k <= mpc.horizon; ++k)
        {
            const ProfilePoint point = profile.at(leg, time + static_cast<double>(k) * mpc.step);
            problem.reference.push_back(
                {reference.pose(leg, point.s), direction * point.speed, reference.steering(leg, point.s)});
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
        const SpeedProfile profile(path, Vehicle());
        const auto leg = static_cast<std::size_t>(random.below(static_cast<int>(profile.reference().legs().size())));
        MpcProblem problem =
            problemOn(profile, leg, random.between(0.0, profile.legDuration(leg)), mpc,
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
