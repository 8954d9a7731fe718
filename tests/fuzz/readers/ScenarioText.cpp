// YAML scenarios: refused in one line, or read and then fit to be planned in.

#include "parking_geometry/io/ScenarioParts.h"
#include "tests/fuzz/Fuzz.h"

#include <cmath>

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        accepts("",  // the map or the vehicle that it names may be what is wrong
                [&input]
                {
                    const parking::Scenario scenario = parking::parseYamlScenario("fuzzed.yaml", input, "");
                    if (scenario.goals.empty())
                        fail("a scenario without a goal");
                    scenario.vehicle.validate();
                    for (const parking::Polygon &polygon : scenario.polygons)
                        for (const Eigen::Vector2d &corner : polygon)
                            if (!scenario.bounds.contains(corner.x(), corner.y()))
                                fail("an obstacle outside of the world");
                    for (const parking::Pose &goal : scenario.goals)
                        if (!std::isfinite(goal.x + goal.y + goal.yaw))
                            fail("a goal that is nowhere");
                });
    }
}  // namespace parking_test::fuzz
