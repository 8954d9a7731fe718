#include "parking_geometry/io/ScenarioReader.h"

#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"
#include "tests/support/PoseGap.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::errorOf;
using parking_test::expectError;
using parking_test::gap;
using parking_test::TemporaryFolder;

namespace
{
    /** Start at 10, 20; goal 5 m ahead; a triangle and a clockwise non-convex polygon. */
    const std::string CASE =
        "10,20,0.5,15,20,-0.25,2,3,5,"
        "12,25,14,25,13,27,"
        "20,10,22,10,22,12,21,10.5,20,12";

    const std::string SCENARIO =
        "# A comment\n"
        "name: example\n"
        "vehicle: vw_golf8\n"
        "start: [10, 20, 0.5]\n"
        "goal: [15.5, 20, -0.25]\n"
        "polygons:\n"
        "  - [[12, 25], [14, 25], [13, 27]]\n"
        "  - - [20, 10]\n"
        "    - [22, 10]\n"
        "    - [22, 12]\n";

    /** Shorter, without a name and a vehicle. */
    const std::string PLAIN =
        "start: [10, 20, 0.5]\n"
        "goal: [15.5, 20, -0.25]\n"
        "polygons:\n"
        "  - [[12, 25], [14, 25], [13, 27]]\n"
        "  - [[20, 10], [22, 10], [22, 12]]\n";

    /** The same text with one line replaced; an empty \e by removes it. */
    std::string with(std::string text, const std::string &line, const std::string &by)
    {
        const std::size_t at = text.find(line);
        EXPECT_NE(at, std::string::npos) << line;
        return text.replace(at, line.size(), by);
    }

    class ReaderTest : public testing::Test
    {
    protected:
        Scenario read(const std::string &text, const std::string &name = "example.yaml")
        {
            return readScenario(folder_.write(name, text));
        }
        Scenario readCase(const std::string &text)
        {
            return readScenario(folder_.write("case.csv", text));
        }
        void expectYamlError(const std::string &text, const std::vector<std::string> &parts)
        {
            SCOPED_TRACE(text);
            expectError([&] { read(text); }, parts);
        }
        void expectCaseError(const std::string &text, std::vector<std::string> parts)
        {
            SCOPED_TRACE(text);
            parts.emplace_back("case.csv: ");
            expectError([&] { readCase(text); }, parts);
        }

        TemporaryFolder folder_;
    };

    using TpcapReader = ReaderTest;
    using YamlReader = ReaderTest;
}  // namespace

TEST_F(TpcapReader, ReadsACaseIntoTheFrameOfItsStart)
{
    const Scenario scenario = readCase(CASE);
    EXPECT_EQ(scenario.name, "case");
    EXPECT_EQ(scenario.vehicle.name, "tpcap");
    EXPECT_EQ(scenario.start.x, 0.0);
    EXPECT_EQ(scenario.start.y, 0.0);
    EXPECT_EQ(scenario.start.yaw, 0.5);
    ASSERT_EQ(scenario.goals.size(), 1u);
    EXPECT_EQ(scenario.goals[0].x, 5.0);
    EXPECT_EQ(scenario.goals[0].y, 0.0);
    EXPECT_EQ(scenario.goals[0].yaw, -0.25);
    ASSERT_EQ(scenario.polygons.size(), 2u);
    EXPECT_EQ(scenario.polygons[0], (Polygon{{2, 5}, {4, 5}, {3, 7}}));
    ASSERT_EQ(scenario.polygons[1].size(), 5u);
    EXPECT_EQ(scenario.polygons[1][3], Eigen::Vector2d(11, -9.5));
    EXPECT_EQ(scenario.worldOffset, Eigen::Vector2d(10, 20));
    EXPECT_FALSE(scenario.grid);
    EXPECT_FALSE(scenario.slot);
    // Box of start, goal and obstacles, and 10 m more on every side.
    EXPECT_EQ(scenario.bounds.min, Eigen::Vector2d(-10, -20));
    EXPECT_EQ(scenario.bounds.max, Eigen::Vector2d(22, 17));
    const Pose world = scenario.toWorld(scenario.goals[0]);
    EXPECT_EQ(world.x, 15.0);
    EXPECT_EQ(world.y, 20.0);
}

TEST_F(TpcapReader, TakesBothLineEndsBlanksAndALastComma)
{
    const Scenario plain = readCase(CASE);
    for (const std::string &text :
         {CASE + "\n", CASE + "\r\n", CASE + ",\r\n", "\xEF\xBB\xBF" + CASE, with(CASE, "12,25,", "12,25,\n"),
          with(CASE, "12,25,", " 12 ,\t25 ,"), with(CASE, "10,20,", "+10,2.0e1,"), CASE + "\n\n"})
    {
        const Scenario scenario = readCase(text);
        EXPECT_EQ(scenario.polygons, plain.polygons) << text;
        EXPECT_EQ(scenario.start.yaw, plain.start.yaw);
    }
}

TEST_F(TpcapReader, KeepsItsPrecisionFarFromTheOrigin)
{
    // 4e9 m and a binary fraction: exact in a double, so nothing may be lost.
    const Scenario scenario = readCase(
        "4500000000.25,-5500000000.5,0,4500000003.75,-5500000001.5,1,1,3,"
        "4500000001.25,-5500000000.5,4500000002.25,-5500000000.5,4500000002.25,-5499999999.5");
    EXPECT_EQ(scenario.goals[0].x, 3.5);
    EXPECT_EQ(scenario.goals[0].y, -1.0);
    EXPECT_EQ(scenario.polygons[0], (Polygon{{1, 0}, {2, 0}, {2, 1}}));
    EXPECT_EQ(scenario.toWorld(scenario.goals[0]).x, 4500000003.75);
    EXPECT_EQ(scenario.toWorld(scenario.goals[0]).y, -5500000001.5);
}

TEST_F(TpcapReader, SaysWhatIsWrong)
{
    expectCaseError("1,2,3", {"too few numbers", "3", "the goal's x"});
    expectCaseError("1,2,3,4,5,6", {"too few numbers", "the number of obstacles"});
    expectCaseError("0,0,0,1,1,1,2,3", {"too few numbers", "2 obstacles"});
    expectCaseError("0,0,0,1,1,1,1,3,0,0,1,1,1", {"too few numbers", "6", "5"});
    expectCaseError("0,0,0,1,1,1,1,3,0,0,1,1,1,0,7", {"too many numbers", "6", "7"});
    expectCaseError("0,0,0,1,1,1,0,7", {"too many numbers"});
    expectCaseError("0,0,0,1,1,1,1,2,0,0,1,1", {"obstacle 1 has 2 corners", "at least 3"});
    expectCaseError("0,0,0,1,1,1,-1", {"number 7 is -1", "whole number"});
    expectCaseError("0,0,0,1,1,1,1.5", {"number 7 is 1.5"});
    expectCaseError("0,0,0,1,1,1,1e300", {"number 7"});
    expectCaseError("0,0,0,1,1,1,4000000000", {"number 7 is 4000000000", "the number of obstacles", "to 1000000000"});
    expectCaseError("0,0,0,1,1,1,1,4000000000,1", {"number 8 is 4000000000", "obstacle 1", "from 0 to 1000000000"});
    expectCaseError("0,0,0,1,1,1,999999999", {"too few numbers"});
    expectCaseError("0,0,nan,1,1,1,0", {"number 3 is 'nan'", "finite"});
    expectCaseError("0,0,0,inf,1,1,0", {"number 4 is 'inf'"});
    expectCaseError("0,0,0,1e999,1,1,0", {"number 4"});
    expectCaseError("0,0,0,x1,1,1,0", {"number 4 is 'x1'"});
    expectCaseError("0,0,0,1.0.0,1,1,0", {"number 4 is '1.0.0'"});
    expectCaseError("0,0,,1,1,1,0", {"number 3 is ''"});
    expectCaseError("0;0;0;1;1;1;0", {"number 1"});
    expectCaseError("0,0,0,1e7,1,1,0", {"the goal", "10000000 m from the start"});
    expectCaseError("0,2e10,0,0,2e10,1,0", {"the start lies at 0, 20000000000", "at most 10000000000 m"});
    expectCaseError("0,0,0,9,0,0,1,4,20,20,22,22,22,20,20,22", {"polygon 1 crosses itself"});
    expectCaseError("1e308,0,0,-1e308,1,1,0", {"the start lies at 1e+308, 0", "at most 10000000000 m"});
    expectCaseError("0,0,0,1,1,1,1,3,0,0,1,0,1e9,1", {"obstacle 1"});
    expectCaseError(std::string("0,0,0,\0,1,1,0", 13), {"number 4"});
}

TEST_F(TpcapReader, FileErrorsAreNamed)
{
    expectError([&] { readScenario(folder_.path("none.csv")); }, {"none.csv", "No such file"});
    std::filesystem::create_directory(folder_.path("folder.csv"));
    expectError([&] { readScenario(folder_.path("folder.csv")); }, {"folder.csv", "is a folder"});
    expectError([&] { read("", "empty.csv"); }, {"empty.csv", "is empty"});
    expectError([&] { read(" \r\n", "blank.csv"); }, {"blank.csv", "blanks"});
    expectError([&] { read("0,0,0", "folder.csv/case.csv"); }, {"case.csv", "too few"});
    expectError([&] { readScenario("/dev/zero"); }, {"/dev/zero", "device"});
    expectError([&] { read(std::string(17 << 20, ' '), "long.csv"); }, {"long.csv", "16 MiB"});
}

TEST_F(TpcapReader, ReadsTheRealCases)
{
    const std::filesystem::path data = std::filesystem::path(PARKING_SHARED_DATA) / "tpcap";
    if (!std::filesystem::is_directory(data))
        GTEST_SKIP() << "the TPCAP cases are not at " << data;
    int count = 0;
    for (const auto &entry : std::filesystem::directory_iterator(data))
    {
        const Scenario scenario = readScenario(entry.path().string());
        EXPECT_EQ(scenario.name, entry.path().stem().string());
        EXPECT_GE(scenario.polygons.size(), 2u);
        EXPECT_LE(std::abs(scenario.goals.at(0).yaw), PI);
        EXPECT_LT(std::hypot(scenario.goals[0].x, scenario.goals[0].y), 60.0);
        EXPECT_LT(scenario.bounds.size().maxCoeff(), 200.0);
        ++count;
    }
    EXPECT_GT(count, 0);
}

TEST_F(ReaderTest, TakesOtherPosesThanTheFiles)
{
    const Pose start{11.0, 20.0, 7.0}, goal{12.0, 20.5, -0.5};
    for (const std::string &text : {CASE, SCENARIO})
    {
        const std::string file = folder_.write("example.yaml", text);
        const Scenario given = readScenario(file, {"", start, goal});
        EXPECT_LT(gap(given.toWorld(given.start), {11.0, 20.0, 7.0 - 2.0 * PI}), 1e-12);
        EXPECT_LT(gap(given.toWorld(given.goals.front()), goal), 1e-12);
        EXPECT_EQ(given.polygons.size(), readScenario(file).polygons.size());
        expectError([&] { readScenario(file, {"", std::nullopt, Pose{1e6, 0.0, 0.0}}); }, {file, "the goal lies"});
    }
}

TEST_F(ReaderTest, NamesTheCommandForFormatsOfOthers)
{
    expectError([&] { read("MATLAB 5.0 MAT-file, Platform: GLNXA64", "Case07.mat"); },
                {"Case07.mat: is a MATLAB file", "parking_convert " + folder_.path("Case07.mat"), "Case07.yaml"});
    for (const std::string begin : {"<svg>", "\n <?xml version=\"1.0\"?><svg>", "\xEF\xBB\xBF<svg>"})
        expectError([&] { read(begin, "scene.svg"); },
                    {"scene.svg: is an SVG file", "scene.yaml --start X,Y,YAW --goal X,Y,YAW"});
    expectError([&] { read("\n{\"Frames\": {\"0\": {\"NfmAggregatedPolygonObjects\": []}}}", "scene.json"); },
                {"scene.json: is a ParkBench file", "parking_convert " + folder_.path("scene.json"), "scene.yaml"});
    EXPECT_EQ(read("{start: [0, 0, 0], goal: [1, 0, 0], polygons: []}", "a.yaml").goals.size(), 1u);  // YAML, too
    for (const std::string begin : {"<?xml version=\"1.0\"?>\n<osm version=\"0.6\">", "<OpenDRIVE>", "<commonRoad/>"})
        expectError([&] { read(begin, "lot.xodr"); }, {"lot.xodr: is XML", "YAML scenarios", ".csv", ".svg", ".mat"});
}

TEST_F(YamlReader, ReadsPolygonsVehicleStartAndGoal)
{
    const Scenario scenario = read(SCENARIO);
    EXPECT_EQ(scenario.name, "example");
    EXPECT_EQ(scenario.vehicle.name, "vw_golf8");
    EXPECT_EQ(scenario.start.yaw, 0.5);
    EXPECT_EQ(scenario.goals.at(0).x, 5.5);
    EXPECT_EQ(scenario.worldOffset, Eigen::Vector2d(10, 20));
    ASSERT_EQ(scenario.polygons.size(), 2u);
    EXPECT_EQ(scenario.polygons[1], (Polygon{{10, -10}, {12, -10}, {12, -8}}));
    EXPECT_EQ(scenario.bounds.min, Eigen::Vector2d(-10, -20));
    EXPECT_EQ(scenario.bounds.max, Eigen::Vector2d(22, 17));
    EXPECT_TRUE(scenario.unknownIsOccupied);
    EXPECT_EQ(read(with(SCENARIO, "name: example\n", "")).name, "example");
    EXPECT_EQ(read(with(SCENARIO, "name: example\n", ""), "other.yml").name, "other");
    EXPECT_EQ(read(with(SCENARIO, "vehicle: vw_golf8\n", "")).vehicle.name, "tpcap");
    EXPECT_EQ(read("start: [0, 0, 0]\ngoal: [1, 0, 0]\npolygons: []\n").polygons.size(), 0u);
    // Polygons may stand under map as well.
    EXPECT_EQ(read("start: [10, 20, 0]\ngoal: [11, 20, 0]\nmap:\n  polygons:\n    - [[12, 25], [14, 25], [13, 27]]\n")
                  .polygons,
              (std::vector<Polygon>{{{2, 5}, {4, 5}, {3, 7}}}));
}

TEST_F(YamlReader, IsRecognisedByContent)
{
    EXPECT_EQ(read(SCENARIO, "scenario.csv").vehicle.name, "vw_golf8");
    EXPECT_EQ(read(CASE, "case.yaml").polygons.size(), 2u);
    expectError([&] { read("hello\n", "hello.yaml"); }, {"hello.yaml:1", "'hello'", "mapping"});
    expectError([&] { read("hello\n", "hello.csv"); }, {"hello.csv", "number 1 is 'hello'"});
}

TEST_F(YamlReader, ReadsAVehicleGivenByItsFieldsOrAFile)
{
    const std::string fields =
        "vehicle: {name: mine, wheelbase: 2.5, front_overhang: 0.8, rear_overhang: 0.7, width: 1.7, "
        "max_steering_angle: 0.6}";
    const Scenario scenario = read(with(SCENARIO, "vehicle: vw_golf8", fields));
    EXPECT_EQ(scenario.vehicle.name, "mine");
    EXPECT_EQ(scenario.vehicle.rearOverhang, 0.7);
    folder_.write("cars/mine.yaml",
                  "wheelbase: 2.4\nfront_overhang: 0.8\nrear_overhang: 0.7\nwidth: 1.7\nmax_steering_angle: 0.6\n");
    EXPECT_EQ(read(with(SCENARIO, "vw_golf8", "cars/mine.yaml")).vehicle.wheelbase, 2.4);
    expectYamlError(with(SCENARIO, "vehicle: vw_golf8", "vehicle: {wheelbase: 2.5}"),
                    {"example.yaml:3", "front_overhang", "vehicle"});
    expectYamlError(with(SCENARIO, "vehicle: vw_golf8", with(fields, "width: 1.7", "width: 0")),
                    {"example.yaml:3: ", "width is 0"});
    const std::string outline =
        "vehicle: {wheelbase: 1.4, max_steering_angle: 1.2, "
        "outline: [[-0.5, -0.6], [-0.5, 0.4], [1.7, 0.4], [1.7, -0.6]]}";
    const Vehicle outlined = read(with(SCENARIO, "vehicle: vw_golf8", outline)).vehicle;
    EXPECT_EQ(outlined.outline.size(), 4u);
    EXPECT_GT(signedArea(outlined.outline), 0.0);
    EXPECT_EQ(outlined.rearOverhang, 0.5);
    EXPECT_EQ(outlined.width, 1.2);
    const auto expectOutlineError = [&](const std::string &old, const std::string &fresh, const std::string &part)
    {
        expectYamlError(with(SCENARIO, "vehicle: vw_golf8", with(outline, old, fresh)), {"example.yaml:3: ", part});
    };
    expectOutlineError("1.4, ", "1.4, width: 1.3, ", "width is 1.3; it must be 1.2 m");
    expectOutlineError("[1.7, -0.6]]", "[1.7, 0.4]]", "nearer than 1 mm");
    expectOutlineError("[-0.5, -0.6], ", "[1, 1], ", "crosses itself");
    expectOutlineError("[-0.5, -0.6], ", "[1], ", "a corner of outline");
    expectOutlineError("[-0.5, -0.6], ", "[.nan, 1], ", "a corner of outline");
    expectOutlineError("[[-0.5, -0.6], [-0.5, 0.4], [1.7, 0.4], [1.7, -0.6]]", "[]", "outline has no corners");
    expectOutlineError("[[-0.5, -0.6], [-0.5, 0.4], [1.7, 0.4], [1.7, -0.6]]", "3", "outline");
    expectYamlError(with(SCENARIO, "vw_golf8", "vw_golf9"), {"example.yaml:3", "'vw_golf9'", "'vw_golf8'"});
    expectYamlError(with(SCENARIO, "vw_golf8", "cars/none.yaml"), {"none.yaml", "No such file"});
}

TEST_F(YamlReader, ReadsASlot)
{
    const std::string slot =
        "slot:\n  kind: perpendicular\n  pose: [15, 15, 1.5707963267948966]\n  length: 5\n  width: 2.5\n";
    const std::string text = with(SCENARIO, "goal: [15.5, 20, -0.25]\n", slot);
    const Scenario reverse = read(text);
    ASSERT_TRUE(reverse.slot);
    EXPECT_EQ(reverse.slot->kind, SlotKind::Perpendicular);
    EXPECT_EQ(reverse.slot->entry, SlotEntry::Reverse);
    EXPECT_EQ(reverse.slot->pose.x, 5.0);
    ASSERT_EQ(reverse.goals.size(), 1u);
    // The middle of the body lies in the middle of the slot.
    const Vehicle &car = reverse.vehicle;
    EXPECT_NEAR(reverse.goals[0].x, 5.0, 1e-9);
    EXPECT_NEAR(reverse.goals[0].y, -5.0 - 0.5 * car.length() + car.rearOverhang, 1e-9);
    EXPECT_NEAR(reverse.goals[0].yaw, 0.5 * PI, 1e-9);
    EXPECT_EQ(read(with(text, "  length: 5\n", "  length: 5\n  entry: either\n")).goals.size(), 2u);
    const Scenario offset = read(with(text, "  length: 5\n", "  length: 5\n  depth: 0.2\n  lateral_offset: 0.1\n"));
    EXPECT_NEAR(offset.goals[0].x, 4.9, 1e-9);
    EXPECT_NEAR(offset.goals[0].y, -5.0 - 2.5 + 0.2 + car.rearOverhang, 1e-9);

    expectYamlError(with(text, "length: 5", "length: 4.2"), {"example.yaml:6", "length is 4.2", "cm"});
    expectYamlError(with(text, "width: 2.5", "width: -1"), {"example.yaml:6", "width"});
    expectYamlError(with(text, "  width: 2.5\n", ""), {"example.yaml:6", "'width' is missing in slot"});
    expectYamlError(with(text, "perpendicular", "diagonal"), {"example.yaml:6", "'diagonal'", "angled"});
    expectYamlError(with(text, "kind:", "knd:"), {"example.yaml:6", "'knd'", "did you mean 'kind'"});
    expectYamlError(with(text, "  length: 5\n", "  length: 5\n  entry: sideways\n"),
                    {"example.yaml:9", "'sideways'", "reverse"});
    expectYamlError(text + "goal: [1, 2, 3]\n", {"both goal and slot"});
    expectYamlError(with(text, "length: 5", "length: 1e9"), {"example.yaml:6", "length is 1000000000", "up to 1000"});
    expectYamlError(with(text, "width: 2.5", "width: 1001"), {"example.yaml:6", "width is 1001", "up to 1000"});
}

TEST_F(YamlReader, ReadsAGoalWithTolerances)
{
    const std::string goal = "goal: {pose: [15.5, 20, -0.25], tolerance: 0.2, yaw_tolerance: 0.1, heading: both}";
    const Scenario scenario = read(with(SCENARIO, "goal: [15.5, 20, -0.25]", goal));
    ASSERT_EQ(scenario.goals.size(), 42u);
    EXPECT_TRUE(isSamePose(scenario.goals[0], {5.5, 0.0, -0.25}, 1e-12));
    EXPECT_NEAR(positionDistance(scenario.goals.back(), scenario.goals[0]), 0.2, 1e-12);
    EXPECT_EQ(read(with(SCENARIO, "[15.5, 20, -0.25]", "{pose: [15.5, 20, 0]}")).goals.size(), 1u);
    EXPECT_EQ(read(with(SCENARIO, "[15.5, 20, -0.25]", "{pose: [15.5, 20, 0], heading: any}")).goals.size(), 16u);
    const auto refused = [this](const std::string &value, const std::string &part)
    {
        expectYamlError(with(SCENARIO, "[15.5, 20, -0.25]", value), {"example.yaml:5", part});
    };
    refused("{pose: [15.5, 20, 0], tolerance: -1}", "tolerance is -1");
    refused("{pose: [15.5, 20, 0], yaw_tolerance: 4}", "yaw_tolerance is 4");
    refused("{pose: [15.5, 20, 0], heading: all}", "'all'");
    refused("{pose: [15.5, 20, 0], tolerence: 1}", "did you mean 'tolerance'");
    expectYamlError(with(SCENARIO, "[15.5, 20, -0.25]", "{tolerance: 1}"), {"'pose' is missing"});
}

TEST_F(YamlReader, NamesLineAndKeyOfWhatIsWrong)
{
    expectYamlError(SCENARIO + "stat: 1\n", {"example.yaml:11", "'stat'", "did you mean 'start'"});
    expectYamlError(SCENARIO + "start: [0, 0, 0]\n", {"example.yaml:11", "'start' is given twice"});
    expectYamlError(with(SCENARIO, "start: [10, 20, 0.5]\n", ""), {"example.yaml", "'start' is missing"});
    expectYamlError(with(SCENARIO, "goal: [15.5, 20, -0.25]\n", ""), {"example.yaml", "neither goal nor slot"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "[10, 20]"),
                    {"example.yaml:4", "start has 2 entries", "3 numbers"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "[10, 20, 0.5, 0]"), {"example.yaml:4", "start has 4 entries"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "10"), {"example.yaml:4", "start is '10'"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "[10, .nan, 0.5]"), {"example.yaml:4", "start holds '.nan'"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "[10, nan, 0.5]"), {"example.yaml:4", "start holds 'nan'"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "[10, 20m, 0.5]"), {"example.yaml:4", "'20m'"});
    expectYamlError(with(SCENARIO, ", [13, 27]]", "]\n  - []"), {"example.yaml:8", "polygon 2 has no corners"});
    expectYamlError(with(SCENARIO, "[13, 27]", "[13]"), {"example.yaml:7", "a corner of polygon 1 has 1 entries"});
    expectYamlError(with(SCENARIO, "    - [22, 12]\n", "    - 22\n"), {"example.yaml:10", "polygon 2"});
    expectYamlError(with(SCENARIO, "[13, 27]", "[13, 2e8]"), {"example.yaml:7: ", "obstacle 1", "m from the start"});
    expectYamlError(with(SCENARIO, "[22, 12]", "[22, 2e8]"), {"example.yaml:8: ", "obstacle 2", "m from the start"});
    expectYamlError(with(SCENARIO, "[15.5, 20, -0.25]", "[15.5, 2e8, 0]"), {"example.yaml:5: the goal lies"});
    expectYamlError(with(SCENARIO, "[10, 20, 0.5]", "[10, 2e12, 0]"), {"example.yaml:4: the start lies"});
    const std::string crossing = "    - [22, 12]\n    - [20, 12]\n    - [25, 9]\n";
    expectYamlError(with(SCENARIO, "    - [22, 12]\n", crossing), {"example.yaml:8: ", "polygon 2 crosses itself"});
    expectYamlError(with(with(SCENARIO, "    - [22, 12]\n", crossing), "polygons:\n", "map:\n polygons:\n"),
                    {"example.yaml:9: ", "polygon 2 crosses itself"});
    expectYamlError("start: [0, 0, 0]\ngoal: [1, 0, 0]\npolygons: 3\n", {"example.yaml:3", "list of polygons"});
    expectYamlError("start: [0, 0, 0]\ngoal: [1, 0, 0]\n", {"neither map nor polygons"});
    expectYamlError(SCENARIO + "map: x.yaml\n", {"both map and polygons"});
    expectYamlError(SCENARIO + "unknown_is_occupied: perhaps\n", {"example.yaml:11", "'perhaps'", "true or false"});
    expectYamlError("start: [0, 0, 0\ngoal: 1\n", {"example.yaml:", "not valid YAML"});
    expectYamlError("name: \"\\\n\\\x01\"\n", {"example.yaml:", "not valid YAML", "escape"});
    expectYamlError("? [a, b]\n: 1\n", {"a key is a list"});
    expectYamlError(": : :\n", {"example.yaml"});
    expectYamlError("&a [*a]\n", {"example.yaml"});
    expectYamlError("# only: a comment\n", {"example.yaml", "must be a mapping"});
    expectYamlError("a: " + std::string(100000, '['), {"example.yaml"});
}

TEST_F(YamlReader, NamesTheLineOfAKeyThatWasLeftBlank)
{
    const std::string rest = "\n\n# nothing\n\ngoal: [15.5, 20, -0.25]\npolygons: []\n";
    for (const std::string blank : {"start:", "start: ", "start: # later", "start: ~", "start: null"})
        expectYamlError("name: a\n" + blank + rest, {"example.yaml:2: start is nothing"});
    expectYamlError(with(SCENARIO, "goal: [15.5, 20, -0.25]", "goal:"), {"example.yaml:5: goal is nothing"});
    expectYamlError("polygons: []\nstart: [1, 2, 3]\ngoal:\n\n", {"example.yaml:3: goal is nothing"});
    expectYamlError(with(SCENARIO, "name: example", "name:"), {"example.yaml:2: name is nothing"});
    expectYamlError(with(SCENARIO, "vehicle: vw_golf8", "vehicle:"), {"example.yaml:3: vehicle is nothing"});
    expectYamlError(SCENARIO + "unknown_is_occupied:\n\n", {"example.yaml:11: unknown_is_occupied is nothing"});
    expectYamlError("start: [1, 1, 0]\nmap:\ngoal: [2, 1, 0]\n", {"example.yaml:2: map is nothing"});
    expectYamlError(SCENARIO + "  -\n", {"example.yaml:", "polygon 3 must be a list"});
    const std::string slot = with(SCENARIO, "goal: [15.5, 20, -0.25]\n", "slot:\n");
    expectYamlError(slot, {"example.yaml:5: slot holds nothing", "must be a mapping"});
    for (const std::string key : {"pose", "kind", "length"})
    {
        std::string fields = "slot:\n  kind: parallel\n  length: 6\n  pose: [1, 2, 3]\n  width: 2\n";
        const std::size_t at = fields.find(key + ":") + key.size() + 1;
        fields.erase(at, fields.find('\n', at) - at);
        const auto line = std::to_string(5 + std::count(fields.begin(), fields.begin() + std::ptrdiff_t(at), '\n'));
        expectYamlError(with(slot, "slot:\n", fields), {"example.yaml:" + line + ": " + key + " is nothing"});
    }
}

TEST_F(YamlReader, SaysWhichFilesAScenarioWasReadFrom)
{
    const auto names = [this](const Scenario &scenario)
    {
        std::string text;
        for (const std::string &file : scenario.files)
            text += std::filesystem::relative(file, folder_.path("")).string() + " ";
        return text;
    };
    const std::string fields =
        "wheelbase: 2.4\nfront_overhang: 0.8\nrear_overhang: 0.7\nwidth: 1.7\nmax_steering_angle: 0.6\n";
    folder_.write("cars/mine.yaml", fields);
    const std::string other = folder_.write("other.yaml", fields);
    folder_.write(
        "maps/lot.yaml",
        "image: ../images/lot.pgm\nresolution: 0.5\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
    folder_.write("images/lot.pgm", "P2 2 2 1 1 1 1 1");
    EXPECT_EQ(names(read(SCENARIO)), "example.yaml ");
    const std::string text = "start: [0.5, 0.5, 0]\ngoal: [0.6, 0.5, 0]\nmap: maps/lot.yaml\nvehicle: cars/mine.yaml\n";
    EXPECT_EQ(names(read(text)), "example.yaml cars/mine.yaml maps/lot.yaml images/lot.pgm ");
    EXPECT_EQ(names(readScenario(folder_.path("example.yaml"), {other})),
              "example.yaml other.yaml maps/lot.yaml images/lot.pgm ");
    EXPECT_EQ(names(readScenario(folder_.write("case.csv", CASE), {other})), "case.csv other.yaml ");
    EXPECT_EQ(names(readScenario(folder_.path("case.csv"), {"vw_golf8"})), "case.csv ");
}

TEST_F(YamlReader, ParsesWhatWasReadAlready)
{
    const std::string file = folder_.path("none.yaml");
    EXPECT_EQ(parseScenario(file, "\xEF\xBB\xBF" + SCENARIO).polygons.size(), 2u);
    EXPECT_EQ(parseScenario(file, CASE, {"vw_golf8"}).vehicle.name, "vw_golf8");
    expectError([&] { parseScenario(file, " \n"); }, {"none.yaml", "blanks"});
    expectError([&] { parseScenario(file, "goal: [1, 2, 3]"); }, {"none.yaml:1: key 'start' is missing"});
}

TEST_F(YamlReader, AliasesDoNotMultiplyCornersWithoutBound)
{
    // A thousand corners by name, a hundred thousand times: 1 MB that asks for 1.6 GB.
    std::string text = "start: [0, 0, 0]\ngoal: [1, 0, 0]\npolygons:\n- &a [";
    for (int i = 0; i < 1000; ++i)
        text += (i > 0 ? ",[1," : "[1,") + std::to_string(i) + "]";
    text += "]\n";
    for (int i = 0; i < 100000; ++i)
        text += "- *a\n";
    expectYamlError(text, {"example.yaml:4", "1000000 corners"});
}

TEST_F(YamlReader, PutsAMapIntoTheFrameOfTheStart)
{
    folder_.write(
        "maps/lot.yaml",
        "image: lot.pgm\nresolution: 0.5\norigin: [4000000000, 100, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
    folder_.write(
        "maps/lot.pgm", "P2 20 10 1\n" +
                            []
                            {
                                std::string s;
                                for (int i = 0; i < 200; ++i)
                                    s += i == 0 ? "0 " : "1 ";
                                return s;
                            }());
    const std::string text = "start: [4000000004, 102, 0]\ngoal: [4000000006, 103, 0]\nmap: maps/lot.yaml\n";
    const Scenario scenario = read(text);
    ASSERT_TRUE(scenario.grid);
    EXPECT_EQ(scenario.grid->origin().x, -4.0);
    EXPECT_EQ(scenario.grid->origin().y, -2.0);
    EXPECT_EQ(scenario.grid->at(0, 9), Cell::Occupied);
    EXPECT_EQ(scenario.bounds.min, Eigen::Vector2d(-4, -2));
    EXPECT_EQ(scenario.bounds.max, Eigen::Vector2d(6, 3));
    EXPECT_EQ(scenario.goals.at(0).x, 2.0);
    EXPECT_TRUE(scenario.polygons.empty());

    // Both sides of the map's edge.
    EXPECT_NO_THROW(read(with(text, "4000000004, 102", "4000000010, 105")));
    for (const std::string outside :
         {"4000000010.5, 102", "3999999999.5, 102", "4000000004, 99.5", "4000000004, 105.5"})
        expectYamlError(with(text, "4000000004, 102", outside), {"example.yaml:1: start outside the map"});
}

TEST_F(YamlReader, ATurnedMapIsBoundedByItsBox)
{
    folder_.write("lot.yaml",
                  "image: lot.pgm\nresolution: 1\norigin: [1, 1, 1.5707963267948966]\noccupied_thresh: "
                  "0.65\nfree_thresh: 0.196\n");
    folder_.write("lot.pgm", "P2 4 2 1  1 1 1 1 1 1 1 1");
    const Scenario scenario = read("start: [0, 2, 0]\ngoal: [0, 3, 0]\nmap: lot.yaml\n");
    EXPECT_NEAR(scenario.bounds.min.x(), -1.0, 1e-9);
    EXPECT_NEAR(scenario.bounds.max.x(), 1.0, 1e-9);
    EXPECT_NEAR(scenario.bounds.min.y(), -1.0, 1e-9);
    EXPECT_NEAR(scenario.bounds.max.y(), 3.0, 1e-9);
    expectYamlError("start: [2, 2, 0]\ngoal: [0, 3, 0]\nmap: lot.yaml\n", {"start outside the map"});
}

TEST_F(YamlReader, RefusesWhatHasNoMeaning)
{
    const std::string slot = "slot:\n  kind: angled\n  pose: [15, 15, 1]\n  length: 7\n  width: 2.5\n  angle: 0.8\n";
    const std::string text = with(PLAIN, "goal: [15.5, 20, -0.25]\n", slot);
    EXPECT_EQ(read(text).slot->angle, 0.8);
    for (const std::string kind : {"parallel", "perpendicular"})
        expectYamlError(with(text, "angled", kind), {"example.yaml:7: angle", kind, "only angled"});
    // The entry of a parallel slot says which way the car drives into it, though not how it stands there.
    for (const std::string entry : {"reverse", "forward", "either"})
        EXPECT_EQ(read(with(with(text, "angled", "parallel"), "angle: 0.8", "entry: " + entry)).goals.size(), 1u);
    expectYamlError(PLAIN + "unknown_is_occupied: false\n",
                    {"example.yaml:6: unknown_is_occupied", "polygons", "only cells of a map"});
    folder_.write("lot.yaml",
                  "image: lot.pgm\nresolution: 0.5\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
    folder_.write("lot.pgm", "P2 2 2 1 1 1 1 1");
    const std::string map = "start: [0.5, 0.5, 0]\ngoal: [0.6, 0.5, 0]\nmap: lot.yaml\n";
    EXPECT_FALSE(read(map + "unknown_is_occupied: false\n").unknownIsOccupied);
    EXPECT_TRUE(read(map).unknownIsOccupied);
}

TEST_F(YamlReader, AFileHoldsOneDocument)
{
    for (const std::string end : {"---\n", "...\n", "---\n# nothing\n", "---\n---\n", "...\n\n", "--- ~\n"})
        EXPECT_EQ(read(PLAIN + end).polygons.size(), 2u) << end;
    EXPECT_EQ(read("%YAML 1.2\n---\n" + PLAIN).polygons.size(), 2u);
    const std::string second = "a second YAML document begins here";
    expectYamlError(PLAIN + "---\nstart: [0, 0, 0]\n", {"example.yaml:7: " + second});
    expectYamlError(PLAIN + "...\nwhatever\n", {"example.yaml:7: " + second});
    expectYamlError(PLAIN + "---\n---\n\n- 1\n", {"example.yaml:9: " + second});
    expectYamlError("{start: [0, 0, 0], goal: [1, 0, 0], polygons: []} x\n", {"example.yaml:1: " + second});
    expectYamlError("{start: [0, 0, 0], goal: [1, 0, 0], polygons: []},\n", {"example.yaml:1: " + second});
    expectYamlError(PLAIN + "--- {\n", {"example.yaml:", "not valid YAML"});
    expectYamlError("---\n---\n" + PLAIN, {"example.yaml:3: " + second});
}

TEST_F(YamlReader, SaysWhatElseAValueMayBe)
{
    for (const std::string blank : {"polygons:", "polygons: # later", "polygons: ~"})
    {
        const std::string poses = "start: [1, 1, 0]\ngoal: [2, 1, 0]\n";
        expectYamlError(poses + blank + "\n",
                        {"example.yaml:3: polygons is nothing", "list of polygons", "[] for none"});
        expectYamlError(poses + "map:\n  " + blank + "\n", {"example.yaml:4: polygons is nothing"});
    }
    expectYamlError(PLAIN + "vehicle: [1]\n",
                    {"example.yaml:6: vehicle is a list; it must be the name", "file", "mapping"});
    expectYamlError("start: [0, 0, 0]\ngoal: [1, 0, 0]\nmap: [1]\n",
                    {"example.yaml:3: map is a list; it must be the path", "mapping"});
}
