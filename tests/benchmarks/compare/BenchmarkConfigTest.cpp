// Reading .cfg files: what they set, and where they say that something is wrong.

#include "benchmarks/compare/BenchmarkOptions.h"
#include "benchmarks/config/BenchmarkConfig.h"
#include "benchmarks/config/Experiment.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using parking_test::errorOf;
    using parking_test::expectError;

    class BenchmarkConfigTest : public ::testing::Test
    {
    protected:
        BenchmarkConfig read(const std::string &text)
        {
            return readBenchmarkConfig(folder_.write("set.cfg", text), registry_);
        }

        parking_test::TemporaryFolder folder_;
        const PlannerRegistry registry_ = PlannerRegistry::builtIn();
    };

    TEST_F(BenchmarkConfigTest, ReadsAllSections)
    {
        const BenchmarkConfig config = read(R"(# a comment
[problem]
scenario = a.yaml   # another
scenario = sub/b.csv
vehicle = tpcap
objective = length
objective.threshold = 3.5
threshold = 1e-15
start.x = 1
start.y = 2
start.theta = 0.5
volume.min.x = -7
sampler = gaussian

[benchmark]
time_limit = 2.5
mem_limit = 100
run_count = 7
output = out
save_paths = all
seed = 42
simplify = yes
clock = processor
track = 1

[planner]
rrt=
rrt.range=50
rrt=
rrt.name=short
rrt.range=0.5
rrt.goal_bias=0.1
rrt.problem.space=se2
rrt.problem.objective=driving
rrt.only=a, b*
rrt=
)");
        ASSERT_EQ(config.scenarios.size(), 2U);
        EXPECT_EQ(config.scenarios[0], folder_.path("a.yaml"));
        EXPECT_EQ(config.scenarios[1], folder_.path("sub/b.csv"));
        EXPECT_EQ(config.timeLimit, 2.5);
        EXPECT_EQ(config.memoryLimit, 100.0);
        EXPECT_EQ(config.runCount, 7U);
        EXPECT_EQ(config.output, "out");
        EXPECT_EQ(config.savePaths, SavePaths::All);
        EXPECT_EQ(config.seed, 42U);
        EXPECT_TRUE(config.simplify);
        EXPECT_TRUE(config.processorTime);
        EXPECT_TRUE(config.track);
        ASSERT_EQ(config.planners.size(), 3U);
        EXPECT_EQ(config.planners[0].name, "RRT");
        EXPECT_EQ(config.planners[0].planner, "RRT");
        EXPECT_EQ(config.planners[0].settings, (PlannerSettings{{"range", "50"}}));
        EXPECT_TRUE(config.planners[0].only.empty());
        EXPECT_EQ(config.planners[1].name, "short");
        EXPECT_EQ(config.planners[1].settings, (PlannerSettings{{"range", "0.5"}, {"goal_bias", "0.1"}}));
        EXPECT_EQ(config.planners[1].problem.settings.space, SpaceKind::SE2);
        EXPECT_EQ(config.planners[1].problem.settings.objective, ObjectiveKind::Driving);
        EXPECT_EQ(config.planners[1].only, (std::vector<std::string>{"a", "b*"}));
        EXPECT_EQ(config.planners[2].name, "RRT_2");
        const ProblemOptions &common = config.planners[2].problem;
        EXPECT_EQ(common.settings.space, SpaceKind::ReedsShepp);
        EXPECT_EQ(common.vehicle, "tpcap");
        EXPECT_EQ(common.settings.objective, ObjectiveKind::Length);
        EXPECT_EQ(common.settings.threshold, 3.5);
        EXPECT_EQ(common.sampler, "gaussian");
        ASSERT_TRUE(common.start.has_value());
        EXPECT_EQ(common.start->yaw, 0.5);
        EXPECT_FALSE(common.goal.has_value());
        EXPECT_EQ(common.minX.value_or(0.0), -7.0);
        EXPECT_FALSE(common.maxX.has_value());
    }

    TEST_F(BenchmarkConfigTest, PlannersStartFromTheProblemWhateverTheOrderOfTheSections)
    {
        const BenchmarkConfig config = read("[planner]\nprm=\n[problem]\nspace = dubins\nscenario = a.yaml\n");
        EXPECT_EQ(config.planners.front().problem.settings.space, SpaceKind::Dubins);
    }

    TEST_F(BenchmarkConfigTest, DefaultsAreThoseOfTheDocumentation)
    {
        const BenchmarkConfig config = read("[problem]\nscenario = a.yaml\n[planner]\nprm=\n");
        EXPECT_EQ(config.timeLimit, 5.0);
        EXPECT_EQ(config.runCount, 10U);
        EXPECT_EQ(config.savePaths, SavePaths::None);
        EXPECT_FALSE(config.simplify);
        EXPECT_FALSE(config.processorTime);
        EXPECT_FALSE(config.track);
    }

    TEST_F(BenchmarkConfigTest, AKeyIsGivenOnce)
    {
        const auto expectTwice = [&](const std::string &text, const std::string &key, int first, int second)
        {
            SCOPED_TRACE(text);
            const std::string file = folder_.path("set.cfg") + ":";
            EXPECT_EQ(errorOf([&] { read(text); }), file + std::to_string(second) + ": '" + key +
                                                        "' is given twice, first at " + file + std::to_string(first) +
                                                        "; leave one of them out");
        };
        const std::string problem = "[problem]\nscenario = a\n", planner = "[planner]\nrrt=\n";
        expectTwice(problem + "space = se2\n# x\nspace = se2\n" + planner, "space", 3, 5);
        expectTwice(problem + "[benchmark]\nrun_count = 1\n" + planner + "[benchmark]\nrun_count = 2\n", "run_count", 4,
                    8);
        expectTwice("[benchmark]\ntime_limit = 1\ntime_limit = 1\n" + problem + planner, "time_limit", 2, 3);
        expectTwice(problem + planner + "rrt.range=1\nRRT.range=2\n", "RRT.range", 5, 6);
        expectTwice(problem + planner + "rrt.name=a\nrrt.name=b\n", "rrt.name", 5, 6);
        expectTwice(problem + planner + "rrt.only=a\nrrt.only=b\n", "rrt.only", 5, 6);
        expectTwice(problem + planner + "rrt.problem.space=se2\nrrt.problem.space=se2\n", "rrt.problem.space", 5, 6);
        // Scenarios are many, planners have keys of their own, and what is said to all may be said anew to one.
        const BenchmarkConfig config = read(
            "[problem]\nscenario = a\nscenario = a\nspace = se2\n[planner]\n"
            "rrt=\nrrt.range=1\nrrt.problem.space=dubins\nrrt=\nrrt.range=1\n");
        EXPECT_EQ(config.scenarios.size(), 2U);
        EXPECT_EQ(config.planners[1].settings, config.planners[0].settings);
    }

    TEST_F(BenchmarkConfigTest, KnowsTheLinesOfSettings)
    {
        const BenchmarkConfig config = read(
            "[problem]\nscenario = a\nspace = se2\nfootprint = circle\n[planner]\nrrt=\n"
            "rrt.range=1\nrrt.problem.footprint=rectangle\nprm=\n");
        const std::string file = folder_.path("set.cfg") + ":";
        const PlannerSpec &rrt = config.planners[0], &prm = config.planners[1];
        EXPECT_EQ(config.lineOf(rrt, {"range"}), file + "7: ");
        EXPECT_EQ(config.lineOf(rrt, {"problem.space", "problem.footprint"}), file + "8: ");  // its own before others'
        EXPECT_EQ(config.lineOf(prm, {"problem.footprint", "problem.space"}), file + "4: ");
        EXPECT_EQ(config.lineOf(rrt, {"goal_bias"}), file + "6: ");
        EXPECT_EQ(config.lineOf(prm, {}), file + "9: ");
        EXPECT_EQ(config.lineOf(PlannerSpec{}, {"range"}), folder_.path("set.cfg") + ": ");
    }

    TEST_F(BenchmarkConfigTest, WhatIsSaidOfAProblemGoesTogether)
    {
        const auto refuse =
            [&](const std::string &problem, const std::string &planner, const std::vector<std::string> &parts)
        {
            SCOPED_TRACE(problem + planner);
            expectError([&] { read("[problem]\nscenario = a\n" + problem + "[planner]\nrrt=\n" + planner); }, parts);
        };
        refuse("start.x = 1\nstart.theta = 1\n", "", {"set.cfg:3: start ", "x, y and theta", "start.y is missing"});
        refuse("goal.x = 1\n", "rrt.problem.goal.y=1\n", {"set.cfg:6: goal ", "goal.theta is missing"});
        refuse("volume.min.y = 3\nvolume.max.y = 3\n", "",
               {"set.cfg:4: volume.max.y must be greater than volume.min.y, 3"});
        refuse("volume.max.x = 3\n", "rrt.problem.volume.min.x=4\n", {"set.cfg:6: volume.max.x must be", "4, not 3"});
        refuse("footprint = circle\n", "", {"set.cfg:3: footprint circle", "space se2"});
        refuse("", "rrt.problem.footprint=circle\n", {"set.cfg:5: footprint circle", "not reeds_shepp"});
        refuse("space = se2\nfootprint = circle\n", "rrt.problem.space=dubins\n", {"set.cfg:7: footprint", "dubins"});
        const std::vector<std::string> ignored{"circle_radius requires footprint = circle", "rectangle"};
        for (const std::string &each : ignored)
        {
            refuse("circle_radius = 1\n", "", {"set.cfg:3: ", each});
            refuse("space = se2\n", "rrt.problem.circle_radius=1\n", {"set.cfg:6: ", each});
            refuse("space = se2\nfootprint = circle\n",
                   "rrt.problem.footprint=rectangle\nrrt.problem.circle_radius=1\n", {"set.cfg:8: ", each});
        }
        // Of use to one planner at least.
        read(
            "[problem]\nscenario = a\ncircle_radius = 1\nspace = "
            "se2\n[planner]\nprm=\nrrt=\nrrt.problem.footprint=circle\n");
        read(
            "[problem]\nscenario = a\ncircle_radius = 1\nspace = se2\nfootprint = circle\n[planner]\nprm=\nrrt=\n"
            "rrt.problem.footprint=rectangle\n");
    }

    TEST_F(BenchmarkConfigTest, SaysWhatToWriteForKeysOfOmplApp)
    {
        const std::pair<const char *, const char *> hints[] = {
            {"threshold = 20", "objective.threshold"},
            {"threshold = 1e-3", "at most 0.0001"},
            {"threshold = -1", "negative"},
            {"objective = mechanical_work", "length, driving"},
            {"objective.threshold = -1", "negative"},
            {"statespace = dubinssymmetric", "dubins or reedsshepp"},
            {"statespace = reeds", "did you mean 'reedsshepp'"},
            {"turningradius = 0", "positive"},
            {"sampler = max_clearence", "did you mean 'max_clearance'"},
            {"start.z = 1", "three dimensions"},
            {"goal.axis.x = 1", "three dimensions"},
            {"solution_length = 1", "leave it out"},
            {"longest_valid_segment_fraction = 0.1", "leave it out"},
            {"standard_deviation = 0.1", "leave it out"},
            {"projection.cellsize.0 = 1", "leave it out"}};
        for (const auto &[line, hint] : hints)
        {
            const std::string key = std::string(line).substr(0, std::string(line).find(' '));
            expectError([&] { read(std::string("[problem]\nscenario = a\n") + line + "\n[planner]\nrrt=\n"); },
                        {"set.cfg:3: ", key, hint});
            expectError([&] { read(std::string("[problem]\nscenario = a\n[planner]\nrrt=\nrrt.problem.") + line); },
                        {"set.cfg:5: ", key, hint});
        }
        expectError([&] { read("[problem]\nscenario = a\ncontrol = dynamic_car\n[planner]\nrrt=\n"); },
                    {"set.cfg:3: ", "dynamic_car", "only model is kinematic_car"});
        for (const char *line : {"world = b.dae", "robot = b.dae", "scenario = b", "control = kinematic_car"})
            expectError([&] { read(std::string("[problem]\nscenario = a\n[planner]\nrrt=\nproblem.") + line); },
                        {"set.cfg:5: "});
        expectError([&] { read("[problem]\nscenario = a\n[planner]\nproblem.space = se2\nrrt=\n"); },
                    {"set.cfg:4: ", "'problem.space' follows no planner", "'space' in [problem]"});
        expectError([&] { read("[problem]\nscenario = a\nstatespace = dubins\nspace = dubins\n[planner]\nrrt=\n"); },
                    {"set.cfg:4: ", "'space' is given twice", "set.cfg:3"});
    }

    TEST_F(BenchmarkConfigTest, ReadsKeysOfOmplApp)
    {
        const BenchmarkConfig config = read(
            "[problem]\nscenario = a\nthreshold = 1e-6\nobjective.threshold = 0.0\nstatespace = dubins\n"
            "turningradius = 4\nsampler = max_clearance\n[benchmark]\nsave_paths = best\n[planner]\n"
            "rrtconnect.range=50\nrrtconnect=\nrrtconnect.range=100\nspars2=\nproblem.statespace=reedsshepp\n"
            "rrtconnect.goal_bias=1\nproblem.turningradius=5\n");
        ASSERT_EQ(config.planners.size(), 3U);
        EXPECT_EQ(config.savePaths, SavePaths::Shortest);
        EXPECT_EQ(config.planners[0].settings, (PlannerSettings{{"range", "50"}}));
        EXPECT_EQ(config.planners[0].problem.settings.space, SpaceKind::Dubins);
        EXPECT_EQ(config.planners[0].problem.turningRadius.value_or(0.0), 4.0);
        EXPECT_EQ(config.planners[0].problem.sampler, "max_clearance");
        EXPECT_EQ(config.planners[1].settings, (PlannerSettings{{"range", "100"}, {"goal_bias", "1"}}));
        EXPECT_EQ(config.planners[2].planner, "SPARStwo");
        EXPECT_EQ(config.planners[2].problem.settings.space, SpaceKind::ReedsShepp);
        EXPECT_EQ(config.planners[2].problem.turningRadius.value_or(0.0), 5.0);
    }

    TEST_F(BenchmarkConfigTest, WithAModelOfControlsPlannersAreThoseOfControls)
    {
        const BenchmarkConfig config = read(
            "[problem]\nscenario = a\ncontrol = kinematic_car\n[planner]\nkpiece=\nrrt=\nrrt.step=1\nest=\npdst=\n"
            "sycloprrt=\nsyclopest=\nsst=\ncontrol_rrt=\nimproved_astar=\n");
        std::string names;
        for (const PlannerSpec &spec : config.planners)
            names += spec.planner + " ";
        EXPECT_EQ(names,
                  "control_KPIECE1 control_RRT control_EST control_PDST control_SyclopRRT control_SyclopEST "
                  "control_SST control_RRT improved_astar ");
        EXPECT_EQ(config.planners[1].settings, (PlannerSettings{{"step", "1"}}));
    }

    TEST_F(BenchmarkConfigTest, TheScenarioOfMeshesIsTheConvertedFile)
    {
        const std::string text = "[problem]\nworld = a.dae\nrobot = b.dae\n[planner]\nrrt=\n";
        EXPECT_TRUE(read(text).scenarios.empty());  // another may come from the command line
        expectError([&] { planExperiments(read(text)); },
                    {"set.cfg:2: ", "parking_convert " + folder_.path("set.cfg") + " " + folder_.path("set.yaml")});
        folder_.write("set.yaml", "start: [0, 0, 0]\ngoal: [9, 0, 0]\npolygons: []\n");
        EXPECT_EQ(read(text).scenarios, (std::vector<std::string>{folder_.path("set.yaml")}));
    }

    TEST_F(BenchmarkConfigTest, FoldersAndPatternsStandForTheirScenariosInNaturalOrder)
    {
        folder_.write("cases/case10.csv", "1");
        folder_.write("cases/case9.csv", "1");
        folder_.write("cases/b.yaml", "name: b\nstart: [0, 0, 0]\n");
        folder_.write("cases/map.yaml", "image: x.pgm\n");
        folder_.write("cases/readme.md", "start: [0, 0, 0]\n");
        const auto names = [&](const std::string &pattern)
        {
            std::string text;
            for (const std::string &file : findScenarios(pattern, folder_.path("")))
                text += file.substr(file.rfind('/') + 1) + " ";
            return text;
        };
        EXPECT_EQ(names("cases"), "b.yaml case9.csv case10.csv ");
        EXPECT_EQ(names("cases/*.csv"), "case9.csv case10.csv ");
        EXPECT_EQ(names("cases/missing.yaml"), "missing.yaml ");  // reading it will say so
        expectError([&] { names("cases/*.txt"); }, {"no scenario"});
    }

    TEST_F(BenchmarkConfigTest, SelectsPlannersByTheirNamesInResults)
    {
        BenchmarkConfig config = read("[problem]\nscenario = a.yaml\n[planner]\nprm=\nrrt=\nrrt.name=mine\nsbl=\n");
        selectPlanners(config, {"mine", "PRM"});
        ASSERT_EQ(config.planners.size(), 2U);
        EXPECT_EQ(config.planners[0].name, "PRM");
        EXPECT_EQ(config.planners[1].name, "mine");
        expectError([&] { selectPlanners(config, {"mien"}); }, {"did you mean 'mine'"});
    }

    TEST(BenchmarkOptions, ReadsACommandLine)
    {
        const BenchmarkOptions options =
            readBenchmarkOptions({"--shard", "2/8", "set.cfg", "--runs", "3", "--time=0.5", "--plugin", "a.so",
                                  "--plugin", "b.so", "--output", "out", "--no-report"});
        EXPECT_EQ(options.config, "set.cfg");
        EXPECT_EQ(options.shard, 1U);
        EXPECT_EQ(options.shards, 8U);
        EXPECT_EQ(options.runCount.value_or(0), 3U);
        EXPECT_EQ(options.timeLimit.value_or(0.0), 0.5);
        EXPECT_EQ(options.plugins, (std::vector<std::string>{"a.so", "b.so"}));
        EXPECT_FALSE(options.report);
        EXPECT_TRUE(readBenchmarkOptions({"set.cfg"}).report);
        expectError([] { readBenchmarkOptions({"set.cfg", "--shard", "9/8"}); }, {"--shard", "I from 1 to N"});
        // Boost's message about this one never ends.
        expectError([] { readBenchmarkOptions({"set.cfg", "--%original_token%="}); }, {"no option", "original_token"});
    }
}  // namespace
