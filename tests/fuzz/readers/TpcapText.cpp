// Cases of TPCAP.

#include "parking_geometry/io/ScenarioParts.h"
#include "tests/fuzz/Fuzz.h"

#include <cmath>

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        accepts("fuzzed.csv",
                [&input]
                {
                    const parking::Scenario scenario = parking::parseTpcapCase("fuzzed.csv", input, "");
                    if (scenario.goals.size() != 1)
                        fail("a case without a goal");
                    for (const parking::Polygon &polygon : scenario.polygons)
                        for (const Eigen::Vector2d &corner : polygon)
                            if (!scenario.bounds.contains(corner.x(), corner.y()))
                                fail("an obstacle outside of the world");
                });
    }
}  // namespace parking_test::fuzz
