// Planners by name, and parameters as texts that must be what the planner makes of them.

#include "benchmarks/plan/PlanRun.h"
#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/planners/SolveRecord.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using parking_test::expectError;

    std::unique_ptr<Problem> openField()
    {
        const parking_test::TemporaryFolder folder;
        return std::make_unique<Problem>(readScenario(folder.write("field.yaml",
                                                                   "start: [0, 0, 0]\ngoal: [12, 3, 0.4]\n"
                                                                   "polygons: [[[5, 5], [6, 5], [6, 6]]]\n")),
                                         ProblemSettings{});
    }

    TEST(PlannerRegistry, SpellingDoesNotMatter)
    {
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        for (const char *name : {"RRTstar", "rrtstar", "RRT*", "rrt_star", "RRT-Star"})
            EXPECT_EQ(registry.find(name).name, "RRTstar") << name;
        EXPECT_EQ(registry.find("kpiece").name, "KPIECE1");
        EXPECT_EQ(registry.find("Improved A*").name, "improved_astar");
        expectError([&] { registry.find("RTTstar"); }, {"did you mean 'RRTstar'"});
    }

    TEST(PlannerRegistry, NamesAreTakenOnce)
    {
        PlannerRegistry registry = PlannerRegistry::builtIn();
        const ompl::base::PlannerAllocator allocate = registry.find("PRM").allocate;
        registry.add({"mine", "a planner", false, allocate, {}});
        EXPECT_TRUE(registry.knows("Mine"));
        expectError([&] { registry.add({"M_I_N_E", "again", false, allocate, {}}); }, {"already"});
        expectError([&] { registry.add({"a b", "", false, allocate, {}}); }, {"'a b'"});
        expectError([&] { registry.add({"", "", false, allocate, {}}); }, {"name"});
        expectError([&] { registry.add({"none", "", false, {}, {}}); }, {"allocator"});
        expectError([&] { registry.addAlias("PRM", "mine"); }, {"already"});
    }

    TEST(PlannerRegistry, EveryPlannerSolvesAnOpenField)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        for (const PlannerEntry &entry : registry.entries())
        {
            SCOPED_TRACE(entry.name);
            const PlanRun run = planOnce(*problem, entry, {}, entry.optimizing ? 0.3 : 20.0, 1);
            // SST builds a tree of random drives: too slow a way to promise anything in this time.
            if (entry.name == "SST" && run.status != PlanStatus::Exact)
                continue;
            ASSERT_EQ(run.status, PlanStatus::Exact);
            EXPECT_TRUE(run.path->recheck.valid) << run.path->recheck.reason;
            EXPECT_GT(run.path->length, 12.0);
            EXPECT_GT(run.firstSolutionTime, 0.0);
        }
    }

    TEST(PlannerRegistry, EveryInstanceHasAProblemOfItsOwn)
    {
        // RRTstar::setup() stores an objective in its problem definition, with which PRM would use all of its time.
        const std::unique_ptr<Problem> problem = openField();
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        planOnce(*problem, registry.find("RRTstar"), {}, 0.1, 1);
        const PlanRun run = planOnce(*problem, registry.find("PRM"), {}, 60.0, 1);
        EXPECT_EQ(run.status, PlanStatus::Exact);
        EXPECT_LT(run.planningTime, 30.0);
    }

    TEST(PlannerRegistry, TurningRadiusIsThatOfTheCar)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PreparedPlanner prepared = problem->prepare(PlannerRegistry::builtIn().find("improved_astar"), {});
        double radius = 0.0;
        prepared.planner->params().getParam("turning_radius")->getValue();
        ASSERT_NO_THROW(radius = std::stod(prepared.planner->params().getParam("turning_radius")->getValue()));
        EXPECT_NEAR(radius, problem->scenario().vehicle.minTurningRadius(), 1e-4);
    }

    TEST(PlannerSettings, RemovedParametersAreAnsweredWithWhatToUseInsteadByThePlannerThatHadThem)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        const auto prepare = [&](const char *planner)
        {
            problem->prepare(registry.find(planner), {{"clearance_weight", "1"}});
        };
        for (const char *planner : {"improved_astar", "hybrid_astar"})
            expectError([&] { prepare(planner); },
                        {"clearance_weight was removed: use preferred_clearance and clearance_cost"});
        expectError([&] { prepare("RRT"); }, {"unknown parameter of RRT 'clearance_weight'"});
    }

    TEST(PlannerSettings, ATurningRadiusThatWouldBeIgnoredIsRefused)
    {
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        const Scenario scenario = openField()->scenario();
        const auto prepareIn = [&](SpaceKind space, const char *planner, const std::string &radius = "7")
        {
            ProblemSettings settings;
            settings.space = space;
            const Problem problem(scenario, settings);
            return problem.prepare(registry.find(planner), {{"turning_radius", radius}})
                .planner->params()
                .getParam("turning_radius")
                ->getValue();
        };
        EXPECT_EQ(prepareIn(SpaceKind::SE2, "improved_astar"), "7");
        for (const char *planner : {"improved_astar", "hybrid_astar"})
        {
            expectError([&] { prepareIn(SpaceKind::ReedsShepp, planner); },
                        {"turning_radius", planner, "se2", "reeds_shepp", "max_steering_angle"});
            expectError([&] { prepareIn(SpaceKind::Dubins, planner); }, {"turning_radius", "dubins"});
            expectError([&] { prepareIn(SpaceKind::ReedsShepp, planner, "wide"); }, {"'wide'", "usual values"});
            // What a result says of the car's own.
            const std::string own = std::to_string(scenario.vehicle.minTurningRadius());
            EXPECT_NO_THROW(prepareIn(SpaceKind::ReedsShepp, planner, own)) << own;
        }
    }

    TEST(PlannerSettings, TextsMustBeOfTheParametersType)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        const auto set = [&](const std::string &planner, const std::string &name, const std::string &value)
        {
            return problem->prepare(registry.find(planner), {{name, value}})
                .planner->params()
                .getParam(name)
                ->getValue();
        };
        EXPECT_EQ(set("RRTstar", "delay_collision_checking", "no"), "0");
        EXPECT_EQ(set("RRTstar", "delay_collision_checking", "TRUE"), "1");
        EXPECT_EQ(set("improved_astar", "heading_bins", "90"), "90");
        for (const char *value : {"", "1x", "x", "nan", "-1"})
            expectError([&] { set("improved_astar", "heading_bins", value); }, {"heading_bins"});
        // 2^32 + 8, which is 8 in 32 bits.
        expectError([&] { set("improved_astar", "heading_bins", "4294967304"); }, {"heading_bins", "4294967304"});
        expectError([&] { set("RRTstar", "range", "far"); }, {"range", "far"});
        expectError([&] { set("RRTstar", "rnge", "1"); }, {"did you mean 'range'"});
        expectError([&] { set("reeds_shepp", "range", "1"); }, {"no parameters"});
    }

    TEST(PlannerSettings, PlannersOfTheProjectRefuseWhatIsOutOfRangeWhenItIsSet)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        struct Range
        {
            const char *planner, *name, *least, *most, *below, *above;
        };
        for (const Range &each :
             std::vector<Range>{{"textbook_hybrid_astar", "xy_resolution", "0.01", "10", "0", "10.1"},
                                {"textbook_hybrid_astar", "heading_bins", "1", "4000", "0", "4001"},
                                {"textbook_hybrid_astar", "steering_angles", "2", "1000", "1", "1001"},
                                {"textbook_hybrid_astar", "motion_length", "0.01", "100", "-0.5", "101"},
                                {"textbook_hybrid_astar", "reverse_penalty", "0", "1000", "-0.1", "1001"},
                                {"textbook_hybrid_astar", "gear_change_penalty", "0", "1000", "-0.1", "1001"},
                                {"textbook_hybrid_astar", "steering_penalty", "0", "1000", "-0.1", "1001"},
                                {"textbook_hybrid_astar", "expansion_interval", "1", "1000000", "0", "1000001"},
                                {"textbook_hybrid_astar", "heuristic_weight", "0", "1000", "-0.1", "1001"},
                                {"control_RRT", "step", "0.01", "10", "0", "10.1"},
                                {"control_SST", "goal_reach", "0.01", "1000", "0", "1001"}})
        {
            SCOPED_TRACE(std::string(each.planner) + " " + each.name);
            const PlannerEntry &entry = registry.find(each.planner);
            for (const char *value : {each.least, each.most})
                EXPECT_NO_THROW(problem->prepare(entry, {{each.name, value}}));
            for (const char *value : {each.below, each.above})
                expectError(
                    [&] {
                        problem->prepare(entry, {{each.name, value}});
                    },
                    {each.planner, std::string(each.name) + " must be between " + each.least + " and " + each.most +
                                       ", not " + value});
        }
    }

    TEST(PlannerSettings, AParameterSetComesFirst)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PreparedPlanner prepared = problem->prepare(PlannerRegistry::builtIn().find("improved_astar"),
                                                          {{"bidirectional", "1"}, {"parameter_set", "hybrid_astar"}});
        EXPECT_EQ(prepared.planner->params().getParam("bidirectional")->getValue(), "1");
        const PreparedPlanner plain = problem->prepare(PlannerRegistry::builtIn().find("hybrid_astar"), {});
        EXPECT_EQ(plain.planner->params().getParam("bidirectional")->getValue(), "0");
    }

    TEST(MeasuredPlanner, KeepsToTheSecondAndNotesWhenSolutionsImproved)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PreparedPlanner prepared = problem->prepare(PlannerRegistry::builtIn().find("RRTstar"), {});
        ASSERT_NE(prepared.measured, nullptr);
        prepared.measured->setTimeLimit(0.3);
        prepared.planner->solve(ompl::base::plannerNonTerminatingCondition());
        EXPECT_TRUE(prepared.measured->wasStopped());
        const SolveRecord &record = *prepared.measured->record();
        EXPECT_GE(record.wallTime(), 0.3);
        EXPECT_LT(record.wallTime(), 5.0);  // the machine may be busy
        const std::vector<Improvement> improvements = record.improvements();
        ASSERT_FALSE(improvements.empty());
        for (std::size_t i = 1; i < improvements.size(); ++i)
        {
            EXPECT_LT(improvements[i].cost, improvements[i - 1].cost);
            EXPECT_GE(improvements[i].time, improvements[i - 1].time);
        }
        EXPECT_NEAR(record.bestCost(), prepared.problem()->getSolutionPath()->length(), 1e-6);
    }

    TEST(MeasuredPlanner, ByProcessorTimeComesBackFromAPlannerThatSleeps)
    {
        // RRTConnect waits for another goal for as long as it may, as this one is in collision.
        const parking_test::TemporaryFolder folder;
        const Problem problem(readScenario(folder.write("goal.yaml",
                                                        "start: [0, 0, 0]\ngoal: [12, 0, 0]\n"
                                                        "polygons: [[[11, -2], [14, -2], [14, 2], [11, 2]]]\n")),
                              ProblemSettings{});
        const PreparedPlanner prepared = problem.prepare(PlannerRegistry::builtIn().find("RRTConnect"), {});
        prepared.measured->setTimeLimit(0.1);
        SolveRecord::Clock::countProcessorTime(true);
        prepared.planner->solve(ompl::base::plannerNonTerminatingCondition());  // or it never comes back
        SolveRecord::Clock::countProcessorTime(false);
        EXPECT_TRUE(prepared.measured->wasStopped());
    }

    /** Lets threads compute until \e record says that a limit is over, and says which processor time they had. */
    double timeUntilOver(double seconds, unsigned threads, bool processorTime)
    {
        SolveRecord record;
        SolveRecord::Clock::countProcessorTime(processorTime);
        record.begin();
        std::vector<std::thread> workers;
        for (unsigned k = 0; k < threads; ++k)
            workers.emplace_back(
                [&]
                {
                    while (!record.isOver(seconds))
                    {
                    }
                });
        for (std::thread &each : workers)
            each.join();
        record.end();
        SolveRecord::Clock::countProcessorTime(false);
        EXPECT_GE(record.wallTime(), seconds);
        return record.cpuTime();
    }

    TEST(SolveRecord, IsOverWhenTheProcessorTimeIsUpHoweverManyThreadsUseIt)
    {
        constexpr double LIMIT = 0.3;
        for (const unsigned threads : {1U, 2U, 7U})
        {
            const double used = timeUntilOver(LIMIT, threads, true);
            EXPECT_GE(used, LIMIT) << threads;
            // Whoever looked only after as much of the wall clock would come to twice the limit on two processors.
            EXPECT_LT(used, 1.4 * LIMIT) << threads;
        }
    }

    TEST(SolveRecord, IsOverWhenTheWallClockSaysSo)
    {
        for (const unsigned threads : {1U, 2U})
            timeUntilOver(0.05, threads, false);
    }

    /** Speaks of an approximate solution, and has none. */
    class Vague : public ompl::base::Planner
    {
    public:
        explicit Vague(const ompl::base::SpaceInformationPtr &si) : ompl::base::Planner(si, "Vague")
        {
        }

        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition & /*ptc*/) override
        {
            return ompl::base::PlannerStatus::APPROXIMATE_SOLUTION;
        }
    };

    TEST(MeasuredPlanner, AnApproximateSolutionIsAPath)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PreparedPlanner prepared = problem->prepare(PlannerRegistry::builtIn().find("RRT"), {});
        Measured<Vague> vague(prepared.setup->getSpaceInformation());
        vague.setProblemDefinition(prepared.problem());
        EXPECT_EQ(vague.solve(ompl::base::plannerNonTerminatingCondition()), ompl::base::PlannerStatus::TIMEOUT);
        EXPECT_EQ(vague.failure().kind, PlannerFailure::Kind::None);
    }

    TEST(MeasuredPlanner, GivingUpIsNotRunningOutOfTime)
    {
        // A wall from side to side, and no curve from start to goal that misses it.
        const parking_test::TemporaryFolder folder;
        const Problem problem(readScenario(folder.write("wall.yaml",
                                                        "start: [0, 0, 0]\ngoal: [12, 0, 0]\n"
                                                        "polygons: [[[5, -9], [6, -9], [6, 9], [5, 9]]]\n")),
                              ProblemSettings{});
        const PlannerRegistry registry = PlannerRegistry::builtIn();
        const PlannerEntry &entry = registry.find("reeds_shepp");
        EXPECT_EQ(planOnce(problem, entry, {}, 60.0, 1).status, PlanStatus::Infeasible);
        // Told to stop before it could try: that is no answer.
        const PreparedPlanner prepared = problem.prepare(entry, {});
        const ompl::base::PlannerStatus status =
            prepared.planner->solve(ompl::base::PlannerTerminationCondition([] { return true; }));
        EXPECT_TRUE(prepared.measured->wasStopped());
        EXPECT_EQ(evaluateRun(problem, prepared, status, 60.0).status, PlanStatus::Timeout);
    }

    /** A planner that says why it finds nothing. */
    class Resigned : public ompl::base::Planner
    {
    public:
        explicit Resigned(const ompl::base::SpaceInformationPtr &si) : ompl::base::Planner(si, "resigned")
        {
        }
        using ompl::base::Planner::solve;
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &) override
        {
            return ompl::base::PlannerStatus::TIMEOUT;
        }
        std::string reason() const
        {
            return "what for?";
        }
    };

    TEST(MeasuredPlanner, PassesOnWhyNothingWasFound)
    {
        const std::unique_ptr<Problem> problem = openField();
        const PlannerEntry entry{"resigned",
                                 "",
                                 false,
                                 [](const ompl::base::SpaceInformationPtr &si)
                                 { return std::make_shared<Measured<Resigned>>(si); },
                                 {}};
        const PlanRun run = planOnce(*problem, entry, {}, 60.0, 1);
        EXPECT_EQ(run.status, PlanStatus::Infeasible);
        EXPECT_EQ(run.reason, "what for?");
        EXPECT_EQ(planOnce(*problem, PlannerRegistry::builtIn().find("reeds_shepp"), {}, 60.0, 1).reason, "");
    }

    TEST(MeasuredPlanner, HasOneProgressPropertyOnly)
    {
        // Those of BIT* are read by the benchmark's thread while the search changes them.
        const std::unique_ptr<Problem> problem = openField();
        for (const char *name : {"BITstar", "ABITstar", "AITstar", "RRTstar"})
        {
            const PreparedPlanner prepared = problem->prepare(PlannerRegistry::builtIn().find(name), {});
            EXPECT_EQ(prepared.planner->getPlannerProgressProperties().size(), 1U) << name;
            EXPECT_EQ(prepared.planner->getPlannerProgressProperties().count("best cost REAL"), 1U) << name;
        }
    }
}  // namespace
