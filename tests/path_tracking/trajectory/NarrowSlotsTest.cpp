// Random slots that are hardly larger than the car: where a trajectory has no room to be wrong.

#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace parking
{
    namespace
    {
        using test::box;
        using test::checkerOf;
        using test::enlarged;
        using test::Random;

        /** A slot, and a path out of it: the parked car stands in the origin. */
        struct Exit
        {
            Vehicle car;
            std::vector<Polygon> obstacles;
            Path path;
        };

        /** How far the car gets along an arc before it comes within \e room metres of an obstacle. */
        double freeWay(const Exit &exit, const Pose &from, double curvature, double most, double room)
        {
            const Vehicle larger = enlarged(exit.car, room);
            constexpr double STEP = 0.01;
            double driven = 0.0;
            while (
                driven < std::abs(most) &&
                !test::touches(advance(from, {curvature, std::copysign(driven + STEP, most)}), larger, exit.obstacles))
                driven += STEP;
            return driven;
        }

        /** Between two parked cars along a kerb: out of it at full lock, to and fro as often as it takes. */
        Exit parallelSlot(std::uint64_t seed)
        {
            Random random(seed);
            Exit exit;
            const Vehicle &car = exit.car;
            const double spare = random.between(0.7, 1.6), behind = random.between(0.3, 0.7) * spare;
            const double kerb = random.between(0.2, 0.45), rear = -car.rearOverhang - behind;
            const double front = rear + car.length() + spare, half = 0.5 * car.width;
            exit.obstacles = {box(rear - 2.0, 0.0, 4.0, car.width, 0.0), box(front + 2.0, 0.0, 4.0, car.width, 0.0),
                              box(0.0, -half - kerb - 0.5, 20.0, 1.0, 0.0)};
            const double lock = 1.0 / car.minTurningRadius();
            for (int stretch = 0; stretch < 40; ++stretch)
            {
                const Pose pose = exit.path.end();
                const bool forwards = stretch % 2 == 0;
                const double way = freeWay(exit, pose, forwards ? lock : -lock, forwards ? 4.0 : -4.0, 0.012);
                if (way > 0.0)
                    exit.path.append({forwards ? lock : -lock, forwards ? way : -way});
                if (forwards && way >= 3.99)
                    return exit;
            }
            exit.path = {};
            return exit;
        }

        /** Between two cars side by side: straight on, and round at full lock as soon as that is free. */
        Exit perpendicularSlot(std::uint64_t seed)
        {
            Random random(seed);
            Exit exit;
            const Vehicle &car = exit.car;
            const double left = random.between(0.05, 0.4), right = random.between(0.05, 0.4);
            const double mouth = car.wheelbase + car.frontOverhang + random.between(-0.5, 0.3);
            const double half = 0.5 * car.width, middle = mouth - 3.0;
            exit.obstacles = {box(middle, half + left + 1.0, 6.0, 2.0, 0.0),
                              box(middle, -half - right - 1.0, 6.0, 2.0, 0.0), box(mouth + 8.5, 0.0, 1.0, 30.0, 0.0)};
            const double lock = (random.chance(0.5) ? 1.0 : -1.0) / car.minTurningRadius();
            for (double straight = 0.5; straight < 5.0; straight += 0.05)
            {
                const Pose turn = advance({}, {0.0, straight});
                const double quarter = 0.5 * PI * car.minTurningRadius();
                if (freeWay(exit, turn, lock, quarter, 0.012) < quarter)
                    continue;
                exit.path.append({0.0, straight});
                exit.path.append({lock, quarter});
                return exit;
            }
            return exit;
        }

        void drivesOutAndIn(const Exit &exit, const std::string &which, int &optimised)
        {
            const FootprintChecker checker = checkerOf(exit.obstacles, exit.car);
            for (const Path &path : {exit.path, exit.path.reversed()})
            {
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                const test::Verdict verdict =
                    test::judge(sample(found.motion, exit.car, 0.05), exit.car, exit.obstacles);
                EXPECT_EQ(verdict.fault, "") << which;
                EXPECT_TRUE(isSamePose(verdict.end, path.end(), 5e-3)) << which;
                EXPECT_LE(found.motion.duration(), stopAndSteer(path, exit.car, 0.0, 0.0).duration() + 1e-9) << which;
                EXPECT_GE(found.motion.duration(), test::bound(found.motion, exit.car) - 1e-6) << which;
                optimised += found.fallback ? 0 : 1;
            }
        }

        TEST(NarrowSlots, AreLeftAndEntered)
        {
            for (const auto &[kind, slot] :
                 {std::pair("parallel slot ", &parallelSlot), {"perpendicular slot ", &perpendicularSlot}})
            {
                int slots = 0, optimised = 0;
                for (std::uint64_t seed = 1; seed <= 16; ++seed)
                {
                    const Exit exit = slot(seed);
                    if (exit.path.pieces.empty())
                        continue;
                    ++slots;
                    drivesOutAndIn(exit, kind + std::to_string(seed), optimised);
                }
                EXPECT_GE(slots, 12) << kind;
                EXPECT_GE(optimised + 1, 2 * slots) << kind;
            }
        }
    }  // namespace
}  // namespace parking
