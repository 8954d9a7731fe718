#include "benchmarks/comparison/UnitRunner.h"

#include "benchmarks/problems/PathQuality.h"
#include "benchmarks/system/QuietChildren.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/simulation/ClosedLoop.h"

#include <ompl/tools/benchmark/Benchmark.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <sstream>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double PROGRESS_INTERVAL = 0.05;  // seconds
        constexpr double LATE = 0.05;               // seconds after the time limit, which a busy machine may take
        constexpr double SIMPLIFY_SHARE = 1.0;      // of the time limit, at most
        constexpr double DEGREES = 180.0 / PI;

        using Properties = std::map<std::string, std::string>;

        void putReal(Properties &properties, const std::string &name, double value)
        {
            properties[name + " REAL"] = formatNumber(value);
        }

        void putInteger(Properties &properties, const std::string &name, std::uint64_t value)
        {
            properties[name + " INTEGER"] = std::to_string(value);
        }

        void putBoolean(Properties &properties, const std::string &name, bool value)
        {
            properties[name + " BOOLEAN"] = value ? "1" : "0";
        }

        void putPath(Properties &properties, const std::string &prefix, const PlannedPath &path)
        {
            putReal(properties, prefix + "path length", path.length);
            putInteger(properties, prefix + "cusps", path.cusps);
            putReal(properties, prefix + "least clearance", path.clearance);
            putBoolean(properties, prefix + "densely valid", path.recheck.valid);
            putInteger(properties, prefix + "dense collisions", path.recheck.collisions);
        }

        /** OMPL's simplification, on the solution in the problem definition. */
        void simplify(Properties &properties, const Problem &problem, const PreparedPlanner &prepared, double timeLimit,
                      bool exact)
        {
            const auto begin = std::chrono::steady_clock::now();
            prepared.setup->simplifySolution(SIMPLIFY_SHARE * timeLimit);
            putReal(properties, "simplification time",
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
            const auto *path =
                dynamic_cast<const ompl::geometric::PathGeometric *>(prepared.problem()->getSolutionPath().get());
            putPath(properties, "simplified ", readPath(problem, *path, exact));
        }

        /** The paper's figures of the drive. */
        void track(Properties &properties, const Problem &problem, const PlannedPath &path)
        {
            try
            {
                ClosedLoop loop(problem.scenario().vehicle);
                loop.setValidity([&problem](const Pose &pose) { return problem.footprint().isFree(pose); });
                const DriveResult drive = loop.drive(pathToDrive(path, problem.scenario().vehicle));
                const Evaluation &figures = drive.evaluation;
                putBoolean(properties, "driven to the end", drive.arrived);
                putReal(properties, "travel time", figures.travelTime);
                putReal(properties, "driven length", figures.drivenLength);
                putReal(properties, "mean acceleration", figures.meanAbsAcceleration);
                putReal(properties, "mean steering angle", figures.meanAbsSteering * DEGREES);
                putReal(properties, "greatest position error", figures.maxPositionError);
                putReal(properties, "final position error", figures.finalPositionError);
                putReal(properties, "final yaw error", figures.finalYawError);
                putInteger(properties, "collisions while driving", figures.collisions);
                putReal(properties, "median MPC time", figures.solveTime.median);
            }
            catch (const Error &)
            {
                putBoolean(properties, "driven to the end", false);
            }
        }
    }  // namespace

    UnitRunner::UnitRunner(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                           const PlannerRegistry &registry, const std::atomic<bool> &stop)
      : config_(config),
        experiments_(experiments),
        registry_(registry),
        stop_(stop)
    {
    }

    const Problem &UnitRunner::problem(std::size_t experiment)
    {
        std::unique_ptr<Problem> &slot = problems_[experiment];
        if (!slot)
            slot = experiments_[experiment].load();
        return *slot;
    }

    void UnitRunner::checkSettings()
    {
        for (std::size_t i = 0; i < experiments_.size(); ++i)
            for (const std::size_t index : experiments_[i].planners)
            {
                const PlannerSpec &spec = config_.planners[index];
                try
                {
                    problem(i).prepare(registry_.find(spec.planner), spec.settings);
                }
                catch (const Error &error)
                {
                    throw Error(config_.file + ": planner " + spec.name + " on " + experiments_[i].name + ": " +
                                error.what());
                }
            }
    }

    std::string UnitRunner::setupText(std::size_t experiment)
    {
        std::ostringstream text;
        const Problem &each = problem(experiment);
        each.spaceInformation()->printSettings(text);
        const Vehicle &vehicle = each.scenario().vehicle;
        text << "Scenario " << experiments_[experiment].scenarioFile << ", space " << toString(each.settings().space)
             << ", footprint " << toString(each.settings().footprint) << "\n"
             << "Vehicle " << vehicle.name << ": " << formatNumber(vehicle.length()) << " x "
             << formatNumber(vehicle.width) << " m, turning radius " << formatNumber(vehicle.minTurningRadius())
             << " m\n";
        return text.str();
    }

    RunRecord UnitRunner::run(const Unit &unit)
    {
        const PlannerSpec &spec = config_.planners[unit.planner];
        const Problem &world = problem(unit.experiment);
        RunRecord record;
        record.experiment = experiments_[unit.experiment].name;
        record.planner = spec.name;
        record.run = unit.run;
        record.seed = seedOf(config_, experiments_, unit);

        seedRandomNumbers(record.seed);
        const PreparedPlanner prepared = world.prepare(registry_.find(spec.planner), spec.settings);
        prepared.planner->setName(spec.name);
        if (prepared.measured != nullptr)
        {
            prepared.measured->setTimeLimit(config_.timeLimit);
            prepared.measured->setStop(&stop_);
        }

        const QuietChildren quiet;
        ompl::tools::Benchmark benchmark(*prepared.setup, record.experiment);
        benchmark.addPlanner(prepared.planner);
        // clear() has thrown samplers away; those that solve() makes shall not depend on how many were made before. And
        // describing the space, OMPL has checked a thousand states.
        benchmark.setPreRunEvent(
            [&](const ob::PlannerPtr &)
            {
                seedRandomNumbers(record.seed);
                world.resetCounts();
            });
        benchmark.setPostRunEvent(
            [&](const ob::PlannerPtr &, Properties &properties)
            {
                const auto status = static_cast<ob::PlannerStatus::StatusType>(
                    std::stoi(properties.count("status ENUM") > 0 ? properties["status ENUM"] : "0"));
                const PlanRun result = evaluateRun(world, prepared, status, config_.timeLimit);
                const bool exact = result.status == PlanStatus::Exact;
                if (prepared.measured != nullptr)
                {
                    // Without the millisecond that OMPL's own clock takes to notice the end.
                    putReal(properties, "time", result.planningTime + result.mapLoadingTime);
                    putReal(properties, "cpu time", result.cpuTime);
                    record.progress = prepared.measured->record()->improvements();
                }
                putReal(properties, "map loading time", world.loadingTime() + result.mapLoadingTime);
                putReal(properties, "planning time", result.planningTime);
                putInteger(properties, "run", record.run);
                putInteger(properties, "seed", record.seed);
                putInteger(properties, "outcome", static_cast<std::uint64_t>(result.status));
                putInteger(properties, "nodes expanded", result.search.expanded);
                putInteger(properties, "motions generated", result.search.generated);
                if (result.search.stateChecks > 0)  // nobody counts the checks of a disc
                {
                    putInteger(properties, "states checked", result.search.stateChecks);
                    putInteger(properties, "exact checks", result.search.exactChecks);
                }
                const bool valid = result.path && result.path->recheck.valid;
                // AIT* and LazyPRM* look at the clock too seldom: what they find after the limit is worth nothing.
                const bool late = exact && result.firstSolutionTime > config_.timeLimit + LATE;
                putBoolean(properties, "late", late);
                putBoolean(properties, "success", exact && valid && !late);
                if (exact)
                    putReal(properties, "first solution time", result.firstSolutionTime);
                if (!result.path)
                    return;
                putPath(properties, "", *result.path);
                putReal(properties, "distance to goal", result.goalDistance);
                record.hasPath = true;
                record.exact = exact;
                record.path = StoredPath::of(*result.path);
                if (config_.simplify && exact)
                    simplify(properties, world, prepared, config_.timeLimit, exact);
                if (config_.track)
                    track(properties, world, *result.path);
            });
        ompl::tools::Benchmark::Request request(config_.timeLimit, config_.memoryLimit, 1, PROGRESS_INTERVAL, false,
                                                false, false);
        ompl::msg::OutputHandler *handler = ompl::msg::getOutputHandler();
        ompl::msg::noOutputHandler();
        benchmark.benchmark(request);
        ompl::msg::useOutputHandler(handler);

        const auto &experiment = benchmark.getRecordedExperimentData();
        if (experiment.planners.empty() || experiment.planners.front().runs.empty())
            throw Error("planner " + spec.name + " on " + record.experiment + ": OMPL's benchmark recorded no run");
        record.properties = experiment.planners.front().runs.front();
        record.parameters = experiment.planners.front().common;
        return record;
    }
}  // namespace parking
