#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"
#include "tests/parking_geometry/io/TestImages.h"

#include <filesystem>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    class SurroundOcc : public testing::Test
    {
    protected:
        TemporaryFolder folder_;
    };
}  // namespace

TEST_F(SurroundOcc, ClassifiesColumnsByWhatACarWouldMeet)
{
    std::vector<std::int64_t> voxels;
    const auto add = [&voxels](std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t label)
    {
        voxels.insert(voxels.end(), {x, y, z, label});
    };
    for (std::int64_t x = 40; x < 60; ++x)
        for (std::int64_t y = 10; y < 20; ++y)
            add(x, y, 4, 11);
    add(45, 15, 6, 4);     // a car on the road
    add(46, 15, 8, 15);    // 2.0 m above the road: in the way
    add(47, 15, 9, 15);    // 2.5 m above: a bridge
    add(48, 15, 3, 16);    // below the road
    add(49, 15, 5, 0);     // noise
    add(60, 15, 4, 13);    // pavement beside the road
    add(61, 15, 6, 16);    // a bush where no ground was seen: the nearest ground decides
    add(50, 15, 4, 14);    // terrain and road in one cell: drivable
    add(190, 150, 7, 15);  // a wall far from any ground
    const OccupancyGrid grid = readSurroundOcc(folder_.write("frame.npy", encodeNpy(voxels)));
    EXPECT_EQ(grid.width(), 200u);
    EXPECT_EQ(grid.height(), 200u);
    EXPECT_EQ(grid.resolution(), 0.5);
    EXPECT_EQ(grid.origin().x, -50.0);
    EXPECT_EQ(grid.origin().y, -50.0);
    EXPECT_EQ(grid.at(45, 15), Cell::Occupied);
    EXPECT_EQ(grid.at(46, 15), Cell::Occupied);
    EXPECT_EQ(grid.at(47, 15), Cell::Free);
    EXPECT_EQ(grid.at(48, 15), Cell::Free);
    EXPECT_EQ(grid.at(49, 15), Cell::Free);
    EXPECT_EQ(grid.at(50, 15), Cell::Free);
    EXPECT_EQ(grid.at(60, 15), Cell::Occupied);
    EXPECT_EQ(grid.at(61, 15), Cell::Occupied);
    EXPECT_EQ(grid.at(190, 150), Cell::Occupied);
    EXPECT_EQ(grid.at(120, 120), Cell::Unknown);
    // Under the car itself, whose rear axle is 0.94 m behind the lidar and which heads along +y.
    EXPECT_EQ(grid.at(100, 100), Cell::Free);
    EXPECT_EQ(grid.at(100, 104), Cell::Free);
    EXPECT_EQ(grid.at(100, 106), Cell::Unknown);
    EXPECT_EQ(grid.at(103, 100), Cell::Unknown);
}

TEST_F(SurroundOcc, ClosesGapsOfTheLidarRings)
{
    std::vector<std::int64_t> voxels;
    for (std::int64_t x = 10; x < 20; ++x)
        for (std::int64_t y = 10; y < 20; ++y)
            if (x != 15)
                voxels.insert(voxels.end(), {x, y, 2, 11});
    const OccupancyGrid grid = readSurroundOcc(folder_.write("frame.npy", encodeNpy(voxels)));
    EXPECT_EQ(grid.at(15, 15), Cell::Free);  // 6 free neighbours
    EXPECT_EQ(grid.at(9, 15), Cell::Unknown);
    EXPECT_EQ(grid.at(20, 15), Cell::Unknown);
}

TEST_F(SurroundOcc, MeasuresHeightsFromTheLowestAndNearestGround)
{
    const std::vector<std::int64_t> voxels = {
        30, 30, 4, 11, 30, 30, 7, 11, 30, 30, 9, 15,  // ground at two heights: the upper one does not count
        60, 50, 2, 11, 64, 50, 9, 11, 62, 50, 8, 15,  // ground equally near on both sides: the first one counts
        90, 50, 9, 11, 94, 50, 2, 11, 92, 50, 8, 15,
        20, 84, 9, 11, 25, 80, 2, 11, 20, 80, 8, 15,  // ground in the next row but nearer than in the same one
    };
    const OccupancyGrid grid = readSurroundOcc(folder_.write("frame.npy", encodeNpy(voxels)));
    EXPECT_EQ(grid.at(30, 30), Cell::Free);
    EXPECT_EQ(grid.at(62, 50), Cell::Unknown);  // 3 m above the road: a bridge
    EXPECT_EQ(grid.at(92, 50), Cell::Unknown);  // below the road
    EXPECT_EQ(grid.at(20, 80), Cell::Unknown);
    const OccupancyGrid low = readSurroundOcc(folder_.write(
        "frame.npy",
        encodeNpy({60, 50, 5, 11, 64, 50, 9, 11, 62, 50, 8, 15, 20, 84, 5, 11, 25, 80, 9, 11, 20, 80, 8, 15})));
    EXPECT_EQ(low.at(62, 50), Cell::Occupied);
    EXPECT_EQ(low.at(20, 80), Cell::Occupied);
}

TEST_F(SurroundOcc, GivesTheMapsThatWereMadeFromTheRealFrames)
{
    const std::filesystem::path data = PARKING_SHARED_DATA;
    if (!std::filesystem::is_directory(data / "surroundocc"))
        GTEST_SKIP() << "the SurroundOcc frames are not at " << data;
    for (const std::string frame : {"00", "03", "05", "08"})
    {
        const OccupancyGrid ours =
            readSurroundOcc((data / "surroundocc" / ("frame" + frame + "_occ_xyzl.npy")).string());
        const OccupancyGrid theirs = readRosMap((data / "maps" / ("surroundocc_f" + frame + ".yaml")).string());
        EXPECT_EQ(ours.cells(), theirs.cells());
        EXPECT_EQ(ours.origin().x, theirs.origin().x);
    }
}

TEST_F(SurroundOcc, NamesWhatIsWrong)
{
    const std::vector<std::int64_t> good = {1, 2, 3, 4, 5, 6, 7, 8};
    const auto expectNpyError = [this](const std::string &bytes, std::vector<std::string> parts)
    {
        parts.emplace_back("x.npy: ");
        expectError([&] { readSurroundOcc(folder_.write("x.npy", bytes)); }, parts);
    };
    EXPECT_NO_THROW(readSurroundOcc(folder_.write("x.npy", encodeNpy(good))));
    expectNpyError("hello", {"not a .npy file"});
    expectNpyError("\x93NUMPY\x01", {"truncated"});
    expectNpyError(encodeNpy(good).substr(0, 60), {"truncated", "header"});
    expectNpyError(encodeNpy(good, "<f8"), {"'<f8'", "int64"});
    expectNpyError(encodeNpy(good, ">i8"), {"'>i8'"});
    expectNpyError(encodeNpy(good, "<i8", "True"), {"column by column"});
    expectNpyError(encodeNpy(good, "<i8", "False", "(8,)"), {"shape", "(n, 4)"});
    expectNpyError(encodeNpy(good, "<i8", "False", "(4, 2)"), {"(4, 2)", "(n, 4)"});
    expectNpyError(encodeNpy(good, "<i8", "False", "(1, 2, 4)"), {"(1, 2, 4)"});
    expectNpyError(encodeNpy(good, "<i8", "False", "(3, 4)"), {"truncated", "96", "64"});
    expectNpyError(encodeNpy(good, "<i8", "False", "(1, 4)"), {"too long", "32", "64"});
    expectNpyError(encodeNpy(good, "<i8", "False", "(99999999999999, 4)"), {"99999999999999 voxels"});
    expectNpyError(encodeNpy({}), {"0 voxels"});
    expectNpyError(encodeNpy({1, 2, 3, 4, 200, 6, 7, 8}), {"voxel 2", "ix 200", "199"});
    expectNpyError(encodeNpy({1, -2, 3, 4}), {"voxel 1", "iy -2"});
    expectNpyError(encodeNpy({1, 2, 16, 4}), {"iz 16"});
    expectNpyError(encodeNpy({1, 2, 3, 300}), {"label 300"});
    expectError([this] { readSurroundOcc(folder_.path("none.npy")); }, {"none.npy"});
}

TEST_F(SurroundOcc, ServesAsTheMapOfAScenario)
{
    folder_.write("frame.npy", encodeNpy({100, 100, 4, 11, 110, 100, 5, 4}));
    const Scenario scenario = readScenario(
        folder_.write("scenario.yaml", "map: frame.npy\nstart: [0, -0.94, 1.5707963]\ngoal: [0, 5, 1.5707963]\n"));
    ASSERT_TRUE(scenario.grid);
    EXPECT_EQ(scenario.grid->at(110, 100), Cell::Occupied);
    EXPECT_EQ(scenario.grid->origin().y, -50.0 + 0.94);
    EXPECT_TRUE(scenario.unknownIsOccupied);
}
