// A map's YAML file and, behind the first zero byte, its image.

#include "parking_geometry/io/ScenarioReader.h"
#include "tests/fuzz/Fuzz.h"

#include <cmath>

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        const std::size_t zero = input.find('\0');
        const std::string file = writeInput("map.yaml", input.substr(0, zero));
        writeInput("map.img", zero == std::string::npos ? "" : input.substr(zero + 1));
        accepts("",
                [&file]
                {
                    const parking::OccupancyGrid grid = parking::readRosMap(file);
                    if (grid.width() == 0 || grid.height() == 0 || !(grid.resolution() > 0.0))
                        fail("a map without cells");
                    const parking::Pose origin = grid.origin();
                    if (!std::isfinite(origin.x + origin.y + origin.yaw))
                        fail("a map that is nowhere");
                });
    }
}  // namespace parking_test::fuzz
