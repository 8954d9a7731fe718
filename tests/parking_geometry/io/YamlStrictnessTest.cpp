// What a scenario file may not hold: keys that mean nothing where they stand, and a second document.

#include "parking_geometry/io/ScenarioReader.h"

#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace parking;

namespace
{
    const std::string GOAL = "goal: [15.5, 20, -0.25]\n";
    const std::string SCENARIO = "start: [10, 20, 0.5]\n" + GOAL +
                                 "polygons:\n"
                                 "  - [[12, 25], [14, 25], [13, 27]]\n"
                                 "  - [[20, 10], [22, 10], [22, 12]]\n";

    std::string with(std::string text, const std::string &part, const std::string &by)
    {
        const std::size_t at = text.find(part);
        EXPECT_NE(at, std::string::npos) << part;
        return text.replace(at, part.size(), by);
    }

    Scenario read(const std::string &text)
    {
        return parseScenario("example.yaml", text);
    }

    void expectYamlError(const std::string &text, const std::vector<std::string> &parts)
    {
        SCOPED_TRACE(text);
        parking_test::expectError([&] { read(text); }, parts);
    }
}  // namespace

TEST(YamlStrictness, RefusesWhatHasNoMeaning)
{
    const std::string slot = "slot:\n  kind: angled\n  pose: [15, 15, 1]\n  length: 7\n  width: 2.5\n  angle: 0.8\n";
    const std::string text = with(SCENARIO, GOAL, slot);
    EXPECT_EQ(read(text).slot->angle, 0.8);
    for (const std::string kind : {"parallel", "perpendicular"})
        expectYamlError(with(text, "angled", kind), {"example.yaml:7: angle", kind, "only angled"});
    // The entry of a parallel slot says which way the car drives into it, though not how it stands there.
    for (const std::string entry : {"reverse", "forward", "either"})
        EXPECT_EQ(read(with(with(text, "angled", "parallel"), "angle: 0.8", "entry: " + entry)).goals.size(), 1u);
    expectYamlError(SCENARIO + "unknown_is_occupied: false\n",
                    {"example.yaml:6: unknown_is_occupied", "polygons", "only cells of a map"});
    const parking_test::TemporaryFolder folder;
    folder.write("lot.yaml", "image: lot.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
    folder.write("lot.pgm", "P2 2 2 1 1 1 1 1");
    const std::string map = "start: [0.5, 0.5, 0]\ngoal: [0.6, 0.5, 0]\nmap: lot.yaml\n";
    EXPECT_FALSE(parseScenario(folder.path("a.yaml"), map + "unknown_is_occupied: false\n").unknownIsOccupied);
    EXPECT_TRUE(parseScenario(folder.path("a.yaml"), map).unknownIsOccupied);
}

TEST(YamlStrictness, AFileHoldsOneDocument)
{
    for (const std::string end : {"---\n", "...\n", "---\n# nothing\n", "---\n---\n", "...\n\n", "--- ~\n"})
        EXPECT_EQ(read(SCENARIO + end).polygons.size(), 2u) << end;
    EXPECT_EQ(read("%YAML 1.2\n---\n" + SCENARIO).polygons.size(), 2u);
    const std::string second = "a second YAML document begins here";
    expectYamlError(SCENARIO + "---\nstart: [0, 0, 0]\n", {"example.yaml:7: " + second});
    expectYamlError(SCENARIO + "...\nwhatever\n", {"example.yaml:7: " + second});
    expectYamlError(SCENARIO + "---\n---\n\n- 1\n", {"example.yaml:9: " + second});
    expectYamlError("{start: [0, 0, 0], goal: [1, 0, 0], polygons: []} x\n", {"example.yaml:1: " + second});
    expectYamlError("{start: [0, 0, 0], goal: [1, 0, 0], polygons: []},\n", {"example.yaml:1: " + second});
    expectYamlError(SCENARIO + "--- {\n", {"example.yaml:", "not valid YAML"});
    expectYamlError("---\n---\n" + SCENARIO, {"example.yaml:3: " + second});
}

TEST(YamlStrictness, SaysWhatElseAValueMayBe)
{
    for (const std::string blank : {"polygons:", "polygons: # later", "polygons: ~"})
    {
        const std::string poses = "start: [1, 1, 0]\ngoal: [2, 1, 0]\n";
        expectYamlError(poses + blank + "\n",
                        {"example.yaml:3: polygons is nothing", "list of polygons", "[] for none"});
        expectYamlError(poses + "map:\n  " + blank + "\n", {"example.yaml:4: polygons is nothing"});
    }
    expectYamlError(SCENARIO + "vehicle: [1]\n",
                    {"example.yaml:6: vehicle is a list; it must be the name", "file", "mapping"});
    expectYamlError("start: [0, 0, 0]\ngoal: [1, 0, 0]\nmap: [1]\n",
                    {"example.yaml:3: map is a list; it must be the path", "mapping"});
}
