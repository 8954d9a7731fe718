// Planners by name, and parameters as texts that must be what the planner makes of them.

#include "benchmarks/plan/PlanRun.h"
#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/MeasuredPlanner.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "ompl_improved_astar/DrivingCostObjective.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{
    namespace ob = ompl::base;
    using namespace parking;
    using parking_test::expectError;

    Problem problemOf(const std::string &goal, const std::string &polygon, const ProblemSettings &settings = {})
    {
        const parking_test::TemporaryFolder folder;
        return Problem(readScenario(folder.write(
                           "world.yaml", "start: [0, 0, 0]\ngoal: " + goal + "\npolygons: [[" + polygon + "]]\n")),
                       settings);
    }

    Problem openField(const ProblemSettings &settings = {})
    {
        return problemOf("[12, 3, 0.4]", "[5, 5], [6, 5], [6, 6]", settings);
    }

    /** The planners, and a field with one obstacle aside. */
    class Planners : public ::testing::Test
    {
    protected:
        PreparedPlanner prepare(const std::string &planner, const PlannerSettings &settings = {}) const
        {
            return field_.prepare(registry_.find(planner), settings);
        }

        PlanRun plan(const std::string &planner, double timeLimit) const
        {
            return planOnce(field_, registry_.find(planner), {}, timeLimit, 1);
        }

        PlannerRegistry registry_{PlannerRegistry::builtIn()};
        const Problem field_{openField()};
    };

    std::string valueOf(const PreparedPlanner &prepared, const std::string &parameter)
    {
        return prepared.planner->params().getParam(parameter)->getValue();
    }

    TEST_F(Planners, AnytimePlannersStopAtAPathShorterThanTheThreshold)
    {
        constexpr double LIMIT = 3.0;  // seconds
        ProblemSettings settings;
        settings.threshold = 100.0;
        // Round a wall, so that there is something to improve.
        const auto behindAWall = [](const ProblemSettings &each)
        {
            return problemOf("[14, 1, 0]", "[6, -6], [6.5, -6], [6.5, 5], [6, 5]", each);
        };
        const Problem easy = behindAWall(settings), none = behindAWall({});
        settings.threshold = 1.0;
        const Problem impossible = behindAWall(settings);
        for (const char *planner : {"improved_astar", "hybrid_astar"})
        {
            const PlannerEntry &entry = registry_.find(planner);
            const PlannerSettings anytime{{"anytime", "1"}};
            const PlanRun run = planOnce(easy, entry, anytime, LIMIT, 1);
            EXPECT_TRUE(run.isSolved()) << planner;
            EXPECT_LT(run.planningTime, 0.5 * LIMIT) << planner;
            // Without anytime it is as if there were none.
            const PlanRun first = planOnce(none, entry, {}, LIMIT, 1), same = planOnce(easy, entry, {}, LIMIT, 1);
            EXPECT_EQ(first.path.value().length, same.path.value().length) << planner;
        }
        EXPECT_GT(planOnce(impossible, registry_.find("improved_astar"), {{"anytime", "1"}}, 0.2, 1).planningTime,
                  0.15);
    }

    TEST_F(Planners, MinimiseTheObjectiveAndRecordTheCostOfTheirPaths)
    {
        for (const ObjectiveKind kind : {ObjectiveKind::Unset, ObjectiveKind::Length, ObjectiveKind::Driving})
            for (const char *planner : {"improved_astar", "hybrid_astar", "RRTConnect", "PRM", "RRTstar", "BITstar"})
            {
                SCOPED_TRACE(toString(kind) + " " + planner);
                ProblemSettings settings;
                settings.objective = kind;
                const Problem problem = openField(settings);
                const PlannerEntry &entry = registry_.find(planner);
                const PreparedPlanner prepared = problem.prepare(entry, {});
                const auto objective = prepared.problem()->getOptimizationObjective();
                EXPECT_EQ(problem.objective() == nullptr, kind == ObjectiveKind::Unset);
                // Those to the first solution would use up their time limit.
                ASSERT_EQ(objective != nullptr,
                          entry.optimizing || (kind != ObjectiveKind::Unset && prepared.improved() != nullptr));
                const bool isDriving = dynamic_cast<const DrivingCostObjective *>(objective.get()) != nullptr;
                EXPECT_EQ(isDriving, objective != nullptr && kind == ObjectiveKind::Driving);
                prepared.planner->setTimeLimit(0.3);
                if (prepared.planner->solve(ob::plannerNonTerminatingCondition()) != ob::PlannerStatus::EXACT_SOLUTION)
                    continue;  // a machine with other load
                const auto &path =
                    dynamic_cast<const ompl::geometric::PathGeometric &>(*prepared.problem()->getSolutionPath());
                const double cost =
                    kind == ObjectiveKind::Unset ? path.length() : pathCost(path, problem.objective()).value();
                EXPECT_LE(prepared.planner->record()->bestCost(), cost + 1e-6);
                if (!entry.optimizing)
                {
                    EXPECT_NEAR(prepared.planner->record()->bestCost(), cost, 1e-6);
                }
            }
    }

    TEST_F(Planners, AreFoundHoweverTheyAreSpelt)
    {
        for (const char *name : {"RRTstar", "rrtstar", "RRT*", "rrt_star", "RRT-Star"})
            EXPECT_EQ(registry_.find(name).name, "RRTstar") << name;
        EXPECT_EQ(registry_.find("kpiece").name, "KPIECE1");
        EXPECT_EQ(registry_.find("Improved A*").name, "improved_astar");
        expectError([&] { registry_.find("RTTstar"); }, {"did you mean 'RRTstar'"});
    }

    TEST_F(Planners, HaveNamesThatAreTakenOnce)
    {
        const ompl::base::PlannerAllocator allocate = registry_.find("PRM").allocate;
        registry_.add({"mine", "a planner", false, allocate, {}});
        EXPECT_EQ(registry_.find("Mine").name, "mine");
        for (const auto &[name, part] : std::vector<std::pair<std::string, std::string>>{
                 {"M_I_N_E", "already"}, {"kpiece", "already"}, {"a b", "'a b'"}, {"", "name"}})
            expectError([&, name = name] { registry_.add({name, "", false, allocate, {}}); }, {part});
        expectError([&] { registry_.add({"none", "", false, {}, {}}); }, {"allocator"});
    }

    TEST_F(Planners, SolveAnOpenField)
    {
        for (const PlannerEntry &entry : registry_.entries())
        {
            SCOPED_TRACE(entry.name);
            const PlanRun run = plan(entry.name, entry.optimizing ? 0.3 : 20.0);
            // SST builds a tree of random drives: too slow a way to promise anything in this time.
            if (entry.name == "SST" && run.status != PlanStatus::Exact)
                continue;
            ASSERT_EQ(run.status, PlanStatus::Exact);
            EXPECT_TRUE(run.path->recheck.valid) << run.path->recheck.reason;
            EXPECT_GT(run.path->length, 12.0);
            EXPECT_GT(run.firstSolutionTime, 0.0);
        }
    }

    TEST_F(Planners, HaveProblemsOfTheirOwn)
    {
        // RRTstar::setup() stores an objective in its problem definition, with which PRM would use all of its time.
        plan("RRTstar", 0.1);
        const PlanRun run = plan("PRM", 60.0);
        EXPECT_EQ(run.status, PlanStatus::Exact);
        EXPECT_LT(run.planningTime, 30.0);
    }

    TEST_F(Planners, OfControlsLeaveTheSettingsOfTheSpaceAsTheyAre)
    {
        const auto settings = [this]
        {
            std::ostringstream text;
            field_.spaceInformation()->printSettings(text);
            return text.str();
        };
        const std::string before = settings();
        EXPECT_EQ(plan("control_RRT", 20.0).status, PlanStatus::Exact);
        EXPECT_EQ(settings(), before);
    }

    TEST_F(Planners, AnswerRemovedParametersWithWhatToUseInsteadWhereTheyHadThem)
    {
        for (const auto &[planner, part] : std::vector<std::pair<std::string, std::string>>{
                 {"improved_astar", "clearance_weight was removed: use preferred_clearance and clearance_cost"},
                 {"hybrid_astar", "clearance_weight was removed"},
                 {"RRT", "unknown parameter of RRT 'clearance_weight'"}})
            expectError([&, planner = planner] { prepare(planner, {{"clearance_weight", "1"}}); }, {part});
    }

    TEST_F(Planners, HaveTheCarsTurningRadiusAndRefuseAnotherThatWouldBeIgnored)
    {
        const double radius = field_.scenario().vehicle.minTurningRadius();
        EXPECT_NEAR(std::stod(valueOf(prepare("improved_astar"), "turning_radius")), radius, 1e-4);
        ProblemSettings settings;
        settings.space = SpaceKind::SE2;
        const PlannerEntry &improved = registry_.find("improved_astar");
        EXPECT_EQ(valueOf(openField(settings).prepare(improved, {{"turning_radius", "7"}}), "turning_radius"), "7");
        settings.space = SpaceKind::Dubins;
        const Problem dubins = openField(settings);
        expectError([&] { dubins.prepare(improved, {{"turning_radius", "7"}}); }, {"turning_radius", "dubins"});
        for (const char *planner : {"improved_astar", "hybrid_astar"})
        {
            expectError(
                [&] {
                    prepare(planner, {{"turning_radius", "7"}});
                },
                {"turning_radius", planner, "se2", "reeds_shepp", "max_steering_angle"});
            expectError([&] { prepare(planner, {{"turning_radius", "wide"}}); }, {"'wide'", "usual values"});
            // What a result says of the car's own.
            EXPECT_NO_THROW(prepare(planner, {{"turning_radius", std::to_string(radius)}}));
        }
    }

    TEST_F(Planners, TakeTextsOfTheParametersTypeOnly)
    {
        EXPECT_EQ(valueOf(prepare("RRTstar", {{"delay_collision_checking", "no"}}), "delay_collision_checking"), "0");
        EXPECT_EQ(valueOf(prepare("RRTstar", {{"delay_collision_checking", "TRUE"}}), "delay_collision_checking"), "1");
        EXPECT_EQ(valueOf(prepare("improved_astar", {{"heading_bins", "90"}}), "heading_bins"), "90");
        struct Refused
        {
            const char *planner, *name, *value, *part;
        };
        for (const Refused &each : std::vector<Refused>{{"improved_astar", "heading_bins", "", "heading_bins"},
                                                        {"improved_astar", "heading_bins", "1x", "heading_bins"},
                                                        {"improved_astar", "heading_bins", "x", "heading_bins"},
                                                        {"improved_astar", "heading_bins", "nan", "heading_bins"},
                                                        {"improved_astar", "heading_bins", "-1", "heading_bins"},
                                                        // 2^32 + 8, which is 8 in 32 bits
                                                        {"improved_astar", "heading_bins", "4294967304", "4294967304"},
                                                        {"RRTstar", "range", "far", "far"},
                                                        {"RRTstar", "rnge", "1", "did you mean 'range'"},
                                                        {"reeds_shepp", "range", "1", "no parameters"}})
            expectError([&] { prepare(each.planner, {{each.name, each.value}}); }, {each.part});
    }

    TEST_F(Planners, OfTheProjectRefuseWhatIsOutOfRangeWhenItIsSet)
    {
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
            for (const char *value : {each.least, each.most})
                EXPECT_NO_THROW(prepare(each.planner, {{each.name, value}}));
            for (const char *value : {each.below, each.above})
                expectError(
                    [&] {
                        prepare(each.planner, {{each.name, value}});
                    },
                    {each.planner, std::string(each.name) + " must be between " + each.least + " and " + each.most +
                                       ", not " + value});
        }
    }

    TEST_F(Planners, TakeAParameterSetFirst)
    {
        EXPECT_EQ(valueOf(prepare("improved_astar", {{"bidirectional", "1"}, {"parameter_set", "hybrid_astar"}}),
                          "bidirectional"),
                  "1");
        EXPECT_EQ(valueOf(prepare("hybrid_astar"), "bidirectional"), "0");
    }

    TEST_F(Planners, KeepToTheSecondAndNoteWhenSolutionsImproved)
    {
        const PreparedPlanner prepared = prepare("RRTstar");
        prepared.planner->setTimeLimit(0.3);
        prepared.planner->solve(ompl::base::plannerNonTerminatingCondition());
        EXPECT_TRUE(prepared.planner->wasStopped());
        const SolveRecord &record = *prepared.planner->record();
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

    TEST_F(Planners, ThatSleepComeBackByProcessorTime)
    {
        // RRTConnect waits for another goal for as long as it may, as this one is in collision.
        const Problem problem = problemOf("[12, 0, 0]", "[11, -2], [14, -2], [14, 2], [11, 2]");
        const PreparedPlanner prepared = problem.prepare(registry_.find("RRTConnect"), {});
        prepared.planner->setTimeLimit(0.1);
        SolveRecord::countProcessorTime(true);
        prepared.planner->solve(ompl::base::plannerNonTerminatingCondition());  // or it never comes back
        SolveRecord::countProcessorTime(false);
        EXPECT_TRUE(prepared.planner->wasStopped());
    }

    TEST_F(Planners, ThatGiveUpHaveNotRunOutOfTime)
    {
        // A wall from side to side, and no curve from start to goal that misses it.
        const Problem problem = problemOf("[12, 0, 0]", "[5, -9], [6, -9], [6, 9], [5, 9]");
        const PlannerEntry &entry = registry_.find("reeds_shepp");
        EXPECT_EQ(planOnce(problem, entry, {}, 60.0, 1).status, PlanStatus::Infeasible);
        // Told to stop before it could try: that is no answer.
        const PreparedPlanner prepared = problem.prepare(entry, {});
        const ompl::base::PlannerStatus status =
            prepared.planner->solve(ompl::base::PlannerTerminationCondition([] { return true; }));
        EXPECT_TRUE(prepared.planner->wasStopped());
        EXPECT_EQ(evaluateRun(problem, prepared, status).status, PlanStatus::Timeout);
    }

    TEST_F(Planners, HaveOneProgressPropertyOnly)
    {
        // Those of BIT* are read by the benchmark's thread while the search changes them.
        for (const char *name : {"BITstar", "ABITstar", "AITstar", "RRTstar"})
        {
            const PreparedPlanner prepared = prepare(name);
            EXPECT_EQ(prepared.planner->getPlannerProgressProperties().size(), 1U) << name;
            EXPECT_EQ(prepared.planner->getPlannerProgressProperties().count("best cost REAL"), 1U) << name;
        }
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

    TEST_F(Planners, HaveAPathWhereTheySpeakOfAnApproximateSolution)
    {
        const PreparedPlanner prepared = prepare("RRT");
        MeasuredPlanner vague(std::make_shared<Vague>(field_.spaceInformation()));
        vague.setProblemDefinition(prepared.problem());
        EXPECT_EQ(vague.solve(ompl::base::plannerNonTerminatingCondition()), ompl::base::PlannerStatus::TIMEOUT);
        EXPECT_FALSE(vague.failure());
    }

    /** Lets threads compute until \e record says that a limit is over, and says which processor time they had. */
    double timeUntilOver(double seconds, unsigned threads, bool processorTime)
    {
        SolveRecord record;
        SolveRecord::countProcessorTime(processorTime);
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
        SolveRecord::countProcessorTime(false);
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
}  // namespace
