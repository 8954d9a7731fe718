// How far can a car drive along an arc? Sweeps against looks every millimetre.

#include "state_validity/FootprintChecker.h"
#include "tests/fuzz/plans/SmallWorld.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        constexpr double TOLERANCE = 1e-3;
        Numbers numbers(input);
        const parking::Vehicle car = smallWorldCar(numbers);
        accepts(
            "",
            [&]
            {
                const World world("polygons", smallWorldPolygons(numbers), {{-REACH, -REACH}, {REACH, REACH}});
                const parking::FootprintChecker checker(world.obstacles, car, 0.0, {}, fieldResolution(numbers));
                parking::CheckCounts counts;
                do
                {
                    const parking::Pose from{numbers.between(-REACH, REACH), numbers.between(-REACH, REACH),
                                             numbers.between(-3.2, 3.2)};
                    double curvature = numbers.between(-0.5, 0.5);
                    if (numbers.flag())
                        curvature *= numbers.flag() ? 8.0 : 1e-5;
                    const double length = numbers.between(-4.0, 4.0), wanted = std::abs(length);
                    const double free = checker.freeLength(from, curvature, length, TOLERANCE, counts);
                    if (!(free >= 0.0 && free <= wanted))
                        fail("no length: " + std::to_string(free));
                    reached(free == wanted ? "whole" : free > 0.0 ? "stopped" : "barred");
                    if (free > 0.0 && !world.oracle.isArcFree(from, curvature, std::copysign(free, length), car, 1e-3))
                        fail("free as far as " + std::to_string(free) + " m, and not free");
                    if (free >= wanted)
                        continue;
                    // No less is called free than is: that far ahead the enlarged body touches something.
                    const double ahead = std::min(free + TOLERANCE + 1e-6, wanted);
                    bool touched = !world.oracle.isFree(from, car, 1.6 * TOLERANCE);
                    for (const int looks : {20, 2000})
                        for (int k = 0; k <= looks && !touched; ++k)
                            touched = !world.oracle.isFree(
                                parking::advance(from, curvature,
                                                 std::copysign(free + (ahead - free) * k / looks, length)),
                                car, TOLERANCE + 1e-6);
                    if (!touched)
                        fail("stopped after " + std::to_string(free) + " m by nothing");
                } while (!numbers.atEnd());
            });
    }
}  // namespace parking_test::fuzz
