// Is a car free? The footprint check against FCL without a shortcut; where they differ, and for good measure where they
// do not, the oracle judges.

#include "state_validity/FootprintChecker.h"
#include "state_validity/fcl/FclContactTest.h"
#include "tests/fuzz/plans/SmallWorld.h"

#include <memory>

namespace parking_test::fuzz
{
    namespace
    {
        parking::OccupancyGrid smallGrid(Numbers &numbers)
        {
            const std::size_t side = 8 + numbers.below(40);
            parking::OccupancyGrid grid(side, side, 16.0 / static_cast<double>(side),
                                        {-8.0, -8.0, numbers.flag() ? 0.0 : numbers.between(-0.6, 0.6)});
            for (std::size_t left = numbers.below(12); left > 0; --left)
                grid.set(numbers.below(side), numbers.below(side),
                         numbers.flag() ? parking::Cell::Occupied : parking::Cell::Unknown);
            return grid;
        }
    }  // namespace

    void tryInput(const std::string &input)
    {
        Numbers numbers(input);
        const parking::Vehicle car = smallWorldCar(numbers);
        const double margin = numbers.flag() ? 0.0 : numbers.between(0.0, 0.3);
        accepts("",
                [&]
                {
                    const parking::Box bounds{{-REACH, -REACH}, {REACH, REACH}};
                    const bool isGrid = numbers.flag();
                    const World world = isGrid ? World("grid", smallGrid(numbers))
                                               : World("polygons", smallWorldPolygons(numbers), bounds);
                    const parking::FootprintChecker checker(world.obstacles, car, margin, parking::fclContactTest(),
                                                            fieldResolution(numbers));
                    const parking::PlainFclChecker fcl(world.obstacles, car, margin);
                    do
                    {
                        const parking::Pose pose{numbers.between(-REACH, REACH), numbers.between(-REACH, REACH),
                                                 numbers.between(-3.2, 3.2)};
                        const bool free = checker.isFree(pose), freeOfFcl = fcl.isFree(pose);
                        const bool surelyFree = world.oracle.isFree(pose, car, margin + 1e-8);
                        const bool surelyNot = !surelyFree && !world.oracle.isFree(pose, car, margin - 1e-8);
                        reached(surelyFree ? "free" : surelyNot ? "not free" : "touching");
                        if ((free && surelyNot) || (!free && surelyFree))
                            fail("the footprint check is wrong");
                        if (free != freeOfFcl && (surelyFree || surelyNot))
                            fail("FCL is wrong");
                        // What is said of the distance must not be more than it is.
                        if (!isGrid && free && surelyFree)
                        {
                            const double distance = world.oracle.clearance(pose, car, margin);
                            if (checker.clearance(pose) > distance + 1e-9)
                                fail("more clearance than there is");
                            if (std::abs(checker.exactClearance(pose) - distance) > 1e-9)
                                fail("not the exact clearance");
                        }
                    } while (!numbers.atEnd());
                });
    }
}  // namespace parking_test::fuzz
