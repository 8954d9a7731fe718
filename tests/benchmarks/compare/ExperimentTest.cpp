// How a comparison is cut into experiments, runs and shards, and what tells comparisons apart.

#include "benchmarks/config/Experiment.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace
{
    using namespace parking;
    using parking_test::expectError;

    class ExperimentTest : public ::testing::Test
    {
    protected:
        ExperimentTest()
        {
            for (const char *name : {"a", "b", "c"})
                folder_.write(std::string(name) + ".yaml", "start: [0, 0, 0]\ngoal: [9, 0, 0]\npolygons: []\n");
        }

        BenchmarkConfig config(const std::string &planners, const std::string &scenarios = "scenario = *.yaml\n",
                               const std::string &benchmark = "run_count = 10\n")
        {
            return readBenchmarkConfig(folder_.write("set.cfg", "[problem]\n" + scenarios + "[benchmark]\n" +
                                                                    benchmark + "[planner]\n" + planners),
                                       registry_);
        }

        parking_test::TemporaryFolder folder_;
        const PlannerRegistry registry_ = PlannerRegistry::builtIn();
    };

    using Key = std::tuple<std::size_t, std::size_t, std::size_t>;

    std::set<Key> keysOf(const std::vector<Unit> &units)
    {
        std::set<Key> keys;
        for (const Unit &unit : units)
            keys.insert({unit.experiment, unit.planner, unit.run});
        return keys;
    }

    TEST_F(ExperimentTest, TheTurningRadiusIsThatOfTheCar)
    {
        const std::vector<Experiment> experiments = planExperiments(
            config("prm=\nrrt=\nrrt.problem.turningradius=7\n", "scenario = a.yaml\nturningradius = 4\n"));
        ASSERT_EQ(experiments.size(), 2U);
        EXPECT_NEAR(experiments[0].load()->scenario().vehicle.minTurningRadius(), 4.0, 1e-9);
        EXPECT_NEAR(experiments[1].scenario().vehicle.minTurningRadius(), 7.0, 1e-9);
        EXPECT_NE(experiments[0].digest, experiments[1].digest);
        expectError([&] { planExperiments(config("prm=\n", "scenario = a.yaml\nturningradius = 2000\n")); },
                    {"turns the car round a circle"});
    }

    TEST_F(ExperimentTest, SamplersAreThoseOfTheirName)
    {
        for (const char *name : {"gaussian", "obstacle_based", "bridge_test", "max_clearance"})
        {
            const auto problem =
                planExperiments(config("prm=\n", std::string("scenario = a.yaml\nsampler = ") + name + "\n"))[0].load();
            EXPECT_EQ(problem->spaceInformation()->allocValidStateSampler()->getName(), name);
        }
    }

    TEST_F(ExperimentTest, PlannersWithAProblemOfTheirOwnMeetInExperimentsOfTheirOwn)
    {
        const BenchmarkConfig set = config(
            "prm=\nrrt=\nrrt.problem.space=se2\nrrt.problem.footprint=circle\n"
            "sbl=\nsbl.problem.space=se2\nsbl.problem.footprint=circle\nsbl.only=b, c\n");
        const std::vector<Experiment> experiments = planExperiments(set);
        ASSERT_EQ(experiments.size(), 6U);
        EXPECT_EQ(experiments[0].name, "a");
        EXPECT_EQ(experiments[0].planners, (std::vector<std::size_t>{0}));
        EXPECT_EQ(experiments[1].name, "a_se2_circle");
        EXPECT_EQ(experiments[1].planners, (std::vector<std::size_t>{1}));
        EXPECT_EQ(experiments[3].name, "b_se2_circle");
        EXPECT_EQ(experiments[3].planners, (std::vector<std::size_t>{1, 2}));
        expectError([&] { planExperiments(config("prm=\nprm.only=d*\n")); }, {"planner PRM", "'d*'"});
        EXPECT_EQ(planExperiments(config("prm=\nrrt=\nrrt.problem.objective=driving\n"))[1].name, "a_driving");
    }

    TEST_F(ExperimentTest, WithOtherScenariosWhoIsRunOnTheFormerOnlyIsLeftOut)
    {
        const auto replaced = [this](const std::string &planners)
        {
            BenchmarkConfig set = config(planners, "scenario = a.yaml\nscenario = gone.yaml\n");
            const std::vector<std::string> before =
                std::exchange(set.scenarios, {folder_.path("b.yaml"), folder_.path("c.yaml")});
            const std::vector<std::string> out = leaveOutPlannersOf(before, set);
            return std::make_pair(set, out);
        };
        const auto [set, out] =
            replaced("prm=\nrrt=\nrrt.only=a\nsbl=\nsbl.only=a, b\nest=\nest.only=go*\nbiest=\nbiest.only=*\n");
        EXPECT_EQ(out, (std::vector<std::string>{"RRT", "EST"}));
        ASSERT_EQ(set.planners.size(), 3U);
        EXPECT_EQ(set.planners[1].only, (std::vector<std::string>{"b"}));
        const std::vector<Experiment> experiments = planExperiments(set);
        ASSERT_EQ(experiments.size(), 2U);
        EXPECT_EQ(experiments[0].planners, (std::vector<std::size_t>{0, 1, 2}));
        EXPECT_EQ(experiments[1].planners, (std::vector<std::size_t>{0, 2}));
        // What names no scenario at all is wrong as ever, and so is a comparison of nobody.
        expectError([&] { planExperiments(replaced("prm=\nrrt=\nrrt.only=d\n").first); },
                    {"set.cfg:9: planner RRT", "'d'", "b, c"});
        expectError([&] { planExperiments(replaced("prm=\nprm.only=a\n").first); }, {"set.cfg:8: planner PRM", "'a'"});
        EXPECT_TRUE(replaced("prm=\n").second.empty());
    }

    TEST_F(ExperimentTest, AVolumeWithNothingInItIsNamed)
    {
        const BenchmarkConfig set = config("prm=\nprm.problem.volume.min.y=1e6\n", "scenario = a.yaml\n");
        try
        {
            planExperiments(set).front().load();
            ADD_FAILURE() << "it was loaded";
        }
        catch (const SettingError &error)
        {
            EXPECT_EQ(set.lineOf(set.planners.front(), error.settings()), folder_.path("set.cfg") + ":7: ");
            EXPECT_NE(std::string(error.what()).find("whose y ranges between "), std::string::npos) << error.what();
        }
    }

    TEST_F(ExperimentTest, ScenariosOfTheSameNameAreToldApart)
    {
        const std::vector<Experiment> experiments =
            planExperiments(config("prm=\n", "scenario = a.yaml\nscenario = a.yaml\n"));
        EXPECT_EQ(experiments[0].name, "a");
        EXPECT_EQ(experiments[1].name, "a_2");
    }

    TEST_F(ExperimentTest, AllRunsAreDoneInRoundsInWhichPlannersTakeTurns)
    {
        const BenchmarkConfig set = config("prm=\nrrt=\nsbl=\nest=\n");
        const std::vector<Experiment> experiments = planExperiments(set);
        const std::vector<Unit> units = planUnits(set, experiments);
        ASSERT_EQ(units.size(), 3U * 4U * 10U);
        EXPECT_EQ(keysOf(units).size(), units.size());
        std::set<std::vector<std::size_t>> orders;
        for (std::size_t i = 0; i < units.size(); i += 4)
        {
            std::vector<std::size_t> order;
            for (std::size_t k = i; k < i + 4; ++k)
            {
                EXPECT_EQ(units[k].experiment, units[i].experiment);
                EXPECT_EQ(units[k].run, i / 12);
                order.push_back(units[k].planner);
            }
            orders.insert(order);
        }
        EXPECT_GT(orders.size(), 10U);  // of 24 possible ones
    }

    TEST_F(ExperimentTest, ShardsHaveEveryRunOnceAndAMixOfAll)
    {
        const BenchmarkConfig set = config("prm=\nrrt=\nsbl=\n");
        const std::vector<Experiment> experiments = planExperiments(set);
        const std::set<Key> all = keysOf(planUnits(set, experiments));
        for (const std::size_t shards : {2U, 3U, 7U, 200U})
        {
            std::set<Key> together;
            std::size_t least = all.size(), most = 0;
            for (std::size_t shard = 0; shard < shards; ++shard)
            {
                const std::vector<Unit> part = planUnits(set, experiments, shard, shards);
                EXPECT_EQ(keysOf(part), keysOf(planUnits(set, experiments, shard, shards)));
                for (const Key &key : keysOf(part))
                    EXPECT_TRUE(together.insert(key).second) << "twice";
                least = std::min(least, part.size());
                most = std::max(most, part.size());
                std::map<std::size_t, std::size_t> planners;
                for (const Unit &unit : part)
                    ++planners[unit.planner];
                if (shards == 2)
                {
                    for (const auto &[planner, count] : planners)
                        EXPECT_NEAR(static_cast<double>(count), 15.0, 7.0) << planner;
                }
            }
            EXPECT_EQ(together, all);
            EXPECT_LE(most - least, 1U);
        }
    }

    TEST_F(ExperimentTest, SeedsDependOnNamesAndNumbersOnly)
    {
        const BenchmarkConfig set = config("prm=\nrrt=\n"), swapped = config("rrt=\nprm=\n");
        const std::vector<Experiment> experiments = planExperiments(set), others = planExperiments(swapped);
        EXPECT_EQ(seedOf(set, experiments, {1, 0, 4}), seedOf(swapped, others, {1, 1, 4}));
        std::set<std::uint32_t> seeds;
        for (const Unit &unit : planUnits(set, experiments))
            seeds.insert(seedOf(set, experiments, unit));
        EXPECT_EQ(seeds.size(), 60U);
        EXPECT_EQ(seeds.count(0), 0U);
        BenchmarkConfig other = set;
        other.seed = 2;
        EXPECT_NE(seedOf(set, experiments, {0, 0, 0}), seedOf(other, experiments, {0, 0, 0}));
    }

    TEST_F(ExperimentTest, TheFingerprintTellsDifferentRunsApart)
    {
        // Of the first planner on the first problem.
        const auto print = [this](const std::string &planners, const std::string &scenarios = "scenario = *.yaml\n",
                                  const std::string &benchmark = "run_count = 10\n")
        {
            const BenchmarkConfig set = config(planners, scenarios, benchmark);
            return fingerprint(set, planExperiments(set).front(), set.planners.front());
        };
        const std::string same = print("prm=\n");
        EXPECT_EQ(print("prm=\n"), same);
        EXPECT_EQ(print("prm=\n", "scenario = *.yaml\n", "run_count = 20\noutput = elsewhere\n"), same);
        EXPECT_NE(print("prm=\nprm.max_nearest_neighbors=3\n"), same);
        EXPECT_EQ(print("prm=\nrrt=\n"), same);
        EXPECT_NE(print("rrt=\n"), same);
        EXPECT_NE(print("prm=\nprm.name=x\n"), same);
        EXPECT_EQ(print("prm=\n", "scenario = a.yaml\n"), same);
        EXPECT_NE(print("prm=\n", "scenario = b.yaml\n"), same);
        EXPECT_NE(print("prm=\n", "scenario = *.yaml\nspace = dubins\n"), same);
        EXPECT_NE(print("prm=\n", "scenario = *.yaml\nobjective = length\n"), same);
        EXPECT_NE(print("prm=\n", "scenario = *.yaml\nobjective = driving\n"),
                  print("prm=\n", "scenario = *.yaml\nobjective = length\n"));
        EXPECT_NE(print("prm=\n", "scenario = *.yaml\n", "time_limit = 1\n"), same);
        EXPECT_NE(print("prm=\n", "scenario = *.yaml\n", "seed = 2\n"), same);
        EXPECT_NE(print("prm=\n", "scenario = *.yaml\n", "track = 1\n"), same);
        folder_.write("a.yaml", "start: [0, 0, 0]\ngoal: [9, 0, 0]\npolygons: [[[4, 4], [5, 4], [5, 5]]]\n");
        EXPECT_NE(print("prm=\n"), same);  // another obstacle
    }

    TEST_F(ExperimentTest, OptionsChangeTheScenario)
    {
        const BenchmarkConfig set =
            config("prm=\n",
                   "scenario = a.yaml\nname = other\nstart.x = 1\nstart.y = 2\nstart.theta = 7\n"
                   "goal.x = 5\ngoal.y = 0\ngoal.theta = 0\nvehicle = smart_fortwo\nvolume.max.x = 6\n");
        const std::vector<Experiment> experiments = planExperiments(set);
        EXPECT_EQ(experiments.front().name, "other");
        const std::unique_ptr<Problem> problem = experiments.front().load();
        const Scenario &scenario = problem->scenario();
        EXPECT_NEAR(scenario.toWorld(scenario.start).x, 1.0, 1e-12);
        EXPECT_NEAR(scenario.start.yaw, 7.0 - 2.0 * PI, 1e-12);
        EXPECT_NEAR(scenario.toWorld(scenario.goals.front()).x, 5.0, 1e-12);
        EXPECT_EQ(scenario.vehicle.name, "smart_fortwo");
    }
}  // namespace
