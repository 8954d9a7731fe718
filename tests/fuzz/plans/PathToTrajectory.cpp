// Paths of few arcs between boxes, optimised in time. The trajectory is one that the car can drive, and touches
// nothing.

#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "state_validity/sweeps/PathSweep.h"
#include "tests/fuzz/plans/SmallWorld.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        Numbers numbers(input);
        parking::Vehicle car = smallWorldCar(numbers);
        if (numbers.flag())
        {
            car.maxSpeed = numbers.between(0.2, 5.0);
            car.maxAcceleration = numbers.between(0.2, 3.0);
            car.maxSteeringRate = numbers.between(0.1, 1.5);
        }
        parking::Path path{{numbers.between(-6.0, 6.0), numbers.between(-6.0, 6.0), numbers.between(-3.14, 3.14)}, {}};
        const double sharpest = 1.0 / car.minTurningRadius();
        for (std::size_t left = 1 + numbers.below(5); left > 0; --left)
            path.append(
                {sharpest * (numbers.flag() ? numbers.between(-1.0, 1.0) : static_cast<double>(numbers.below(3)) - 1.0),
                 numbers.between(-5.0, 5.0)});
        const std::vector<parking::Polygon> polygons = smallWorldPolygons(numbers);
        accepts("",
                [&]
                {
                    const parking::FootprintChecker checker(
                        parking::ObstacleSet::fromPolygons(polygons, {{-20.0, -20.0}, {20.0, 20.0}}), car, 0.0, {},
                        fieldResolution(numbers));
                    bool touched = false;
                    for (const parking::PathState &state : path.sample(0.02))
                        touched = touched || parking::test::touches(state.pose, car, polygons);
                    reached(touched ? "touches" : isPathFree(checker, path) ? "free" : "near or between samples");
                    parking::TrajectoryOptions options;
                    options.maxRounds = 2;
                    const parking::TrajectoryOptimizer optimizer(checker, options);
                    std::size_t asked = 0;
                    const parking::OptimizedTrajectory found =
                        optimizer.optimize(path, [&asked] { return ++asked > 60; });
                    if (touched)
                        fail("a path that collides was taken");
                    const parking::test::Verdict verdict =
                        parking::test::judge(sample(found.motion, car, 0.05), car, polygons);
                    if (!verdict.fault.empty())
                        fail("the trajectory " + verdict.fault);
                    const parking::Pose wanted = path.end();
                    if (positionDistance(verdict.end, wanted) > 0.01 ||
                        std::abs(parking::wrapAngle(verdict.end.yaw - wanted.yaw)) > 0.01)
                        fail("the trajectory ends elsewhere");
                    reached(found.fallback ? found.reason : "optimised");
                });
    }
}  // namespace parking_test::fuzz
