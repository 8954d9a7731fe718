// SurroundOcc's voxels.

#include "parking_geometry/io/ScenarioReader.h"
#include "tests/fuzz/Fuzz.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        const std::string file = writeInput("voxels.npy", input);
        accepts(file,
                [&file]
                {
                    const parking::OccupancyGrid grid = parking::readSurroundOcc(file);
                    if (grid.width() != 200 || grid.height() != 200)
                        fail("a grid of another size");
                });
    }
}  // namespace parking_test::fuzz
