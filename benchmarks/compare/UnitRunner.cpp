#include "benchmarks/compare/UnitRunner.h"

#include "automatic_parking/QuickestTrajectory.h"
#include "benchmarks/metrics/DriveMetrics.h"
#include "benchmarks/metrics/PathMetrics.h"
#include "benchmarks/metrics/PeakMemory.h"
#include "benchmarks/plan/PerceivedDrive.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/store/RunColumns.h"
#include "benchmarks/system/ProcessorTime.h"
#include "ompl_improved_astar/DrivingCostObjective.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <ompl/tools/benchmark/Benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double PROGRESS_INTERVAL = 0.05;  // seconds
        constexpr double LATE = 0.05;               // seconds after the time limit that a busy machine may need
        constexpr double SIMPLIFY_SHARE = 1.0;      // ratio to the time limit, maximum
        constexpr double DEGREES = 180.0 / PI;
        // Multiple of the time limit after which an isolated planner is killed. Some planners of OMPL end 2 s late.
        constexpr double BUSY = 50.0;                           // maximum ratio of wall-clock time to processor time
        constexpr double SOLVE_SHARE = 3.0, SOLVE_GRACE = 2.0;  // ratio to the time limit; seconds in addition
        // The same limit for processing the path: simplification and drive take long.
        constexpr double MEASURE_SHARE = 10.0, MEASURE_GRACE = 60.0;

        RunRecord failedRun(RunRecord record, PlanStatus outcome, const std::string &reason)
        {
            record.set("outcome", outcome);
            record.reason = oneLine(reason);
            record.set("success", false);
            record.set("late", false);
            record.set("status", ob::PlannerStatus::CRASH);
            return record;
        }

        /** A figure as formatted by OMPL; empty when it cannot be read. */
        std::optional<FigureValue> figureFrom(const std::string &text, const std::string &type)
        {
            constexpr double LARGEST = 9007199254740992.0;  // A double does not represent all larger whole numbers.
            double number = 0.0;
            if (!parseNumber(text, number))
                return type == "REAL" && text == "inf"
                           ? std::optional<FigureValue>(std::numeric_limits<double>::infinity())
                           : std::nullopt;
            if (type == "BOOLEAN")
                return number != 0.0;
            if (type == "REAL")
                return number;
            return std::abs(number) < LARGEST ? std::optional<FigureValue>(static_cast<std::int64_t>(number))
                                              : std::nullopt;
        }

        /** Length, clearance and validity of a path. \param prefix of the columns' names */
        void putPath(RunRecord &record, const std::string &prefix, const PlannedPath &path)
        {
            record.set(prefix + "path length", path.length);
            record.set(prefix + "cusps", path.cusps);
            record.set(prefix + "least clearance", path.clearance);
            record.set(prefix + "densely valid", path.recheck.valid);
            record.set(prefix + "dense collisions", path.recheck.collisions);
        }

        /** All metrics of the path: shape, clearance, and the time of a car along it. */
        void putMetrics(RunRecord &record, const Problem &problem, const PlannedPath &planned)
        {
            // An invalid answer, or one that ends thousands of kilometres away, has no shape.
            if (planned.recheck.fault == Fault::NotFinite || planned.recheck.fault == Fault::NoPath ||
                !(planned.length < Referee::MAX_DISTANCE))
                return;
            const PathShape shape = shapeOf(planned.path);
            record.set("attains goal", attainsGoal(planned.end, problem.scenario().goals));
            record.set("angle over length", shape.angleOverLength);
            record.set("max curvature", shape.maxCurvature);
            record.set("normalized curvature", shape.normalizedCurvature);
            record.set("smoothness", shape.smoothness);
            record.set("reverse share", shape.reverseShare);
            const ClearanceFigures clearance =
                clearanceAlong(planned.path, [&problem](const Pose &pose, double enough)
                               { return problem.referee().space().clearance(pose, enough); });
            record.set("mean clearance", clearance.mean);
            record.set("median clearance", clearance.median);
            try
            {
                const CuspToCusp profile = cuspToCusp(planned.path, problem.scenario().vehicle);
                record.set("cusp to cusp time", profile.cost.time);
                record.set("cusp to cusp cost", profile.cost.total());
                record.set("cusp to cusp jerk", profile.meanJerk);
                record.set("steerings at standstill", profile.standingSteerings);
                record.set("steering at standstill time", profile.standingSteeringTime);
            }
            catch (const Error &)
            {
                // A car cannot drive it.
            }
        }

        /** Metrics of a drive or trajectory. \param prefix of the columns' names */
        void putDrive(RunRecord &record, const std::string &prefix, const DriveFigures &frames)
        {
            record.set(prefix + "attains goal", frames.attainsGoal);
            record.set(prefix + "colliding frames", frames.collidingShare());
            record.set(prefix + "standing time", frames.standingTime);
            record.set(prefix + "jerk", frames.meanJerk);
        }

        /** The path in the problem definition, whose type MeasuredPlanner has checked. */
        const ompl::geometric::PathGeometric &solutionOf(const PreparedPlanner &prepared)
        {
            return static_cast<const ompl::geometric::PathGeometric &>(*prepared.problem()->getSolutionPath());
        }

        /** OMPL's simplification, applied to the solution in the problem definition. */
        void simplify(RunRecord &record, const Problem &problem, const PreparedPlanner &prepared, double timeLimit)
        {
            const auto begin = std::chrono::steady_clock::now();
            prepared.setup->simplifySolution(SIMPLIFY_SHARE * timeLimit);
            record.set("simplification time",
                       std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
            putPath(record, "simplified ", readPath(problem, solutionOf(prepared), record.exact));
        }

        /** The paper's metrics of the drive. */
        void track(RunRecord &record, const Problem &problem, const PlannedPath &path)
        {
            record.set("driven to the end", false);
            try
            {
                const DriveResult drive = problem.closedLoop().drive(path.path);
                const Evaluation &figures = drive.evaluation;
                record.set("driven to the end", drive.arrived);
                record.set("travel time", figures.travelTime);
                record.set("driven length", figures.drivenLength);
                record.set("mean acceleration", figures.meanAbsAcceleration);
                record.set("mean steering angle", figures.meanAbsSteering * DEGREES);
                record.set("greatest position error", figures.maxPositionError);
                record.set("final position error", figures.finalPositionError);
                record.set("final yaw error", figures.finalYawError);
                record.set("collisions while driving", figures.collisions);
                record.set("median MPC time", figures.solveTime.median);
                putDrive(record, "drive ",
                         driveFigures(drive.trajectory, problem.scenario().goals, problem.footprint()));
            }
            catch (const Error &)
            {
                // A path that cannot be driven is a valid result, too.
            }
        }

        /** Drives of the whole pipeline: with a known map, and by what a sensor sees, in motion and stopping to plan.
         */
        void perceive(RunRecord &record, const Scenario &scenario, const SensorParameters &sensor)
        {
            const auto time = [&record](const std::string &column, const ParkingResult &drive)
            {
                if (drive.parked())
                    record.set(column, drive.trajectory.back().t);
            };
            time("known drive time", AutomaticParking().park(scenario));
            const ParkingResult stopping = perceivedDrive(scenario, sensor, true);
            time("stopping drive time", stopping);
            record.set("stopping stops", reactionFigures(stopping).stops);
            const ParkingResult drive = perceivedDrive(scenario, sensor);
            const ReactionFigures figures = reactionFigures(drive);
            record.set("perceived parked", drive.parked());
            time("perceived drive time", drive);
            record.set("perceived stops", figures.stops);
            record.set("perceived new motions", figures.newMotions);
            record.set("perceived least clearance", drive.evaluation.minClearance);
            record.set("median reaction time", figures.check.median);
            record.set("p99 reaction time", figures.check.p99);
            if (figures.newMotions == 0)
                return;
            record.set("median new motion time", figures.motion.median);
            record.set("max new motion time", figures.motion.max);
        }

        /** The fastest trajectory near the path. */
        void optimize(RunRecord &record, const Problem &problem, const PlannedPath &path)
        {
            const double begin = processorTime();
            try
            {
                QuickestTrajectoryOptions options;
                // Alternatives would show this project's planner instead of the compared one.
                options.alternatives = false;
                const OptimizedTrajectory found =
                    quickestTrajectory(problem.footprint(), problem.scenario().bounds, path.path, options).trajectory;
                const TpcapCost cost = tpcapCost(found.motion);
                record.set("trajectory duration", cost.time);
                record.set("trajectory cost", cost.total());
                record.set("trajectory control effort", cost.controlEffort);
                record.set("trajectory steering integral", cost.steeringIntegral);
                record.set("trajectory gear changes", cost.gearChanges);
                record.set("trajectory stops to steer", found.fallback);
                record.set("trajectory time", processorTime() - begin);
                putDrive(record, "trajectory ",
                         driveFigures(found.motion, problem.scenario().goals, problem.footprint()));
            }
            catch (const Error &)
            {
                // A path that cannot be driven has no trajectory.
            }
        }

        /** Outcome and effort of the run. */
        void putOutcome(RunRecord &record, const Problem &problem, const PlanRun &run, double timeLimit)
        {
            record.exact = run.status == PlanStatus::Exact;
            // AIT* and LazyPRM* check the clock too seldom: solutions after the limit do not count.
            const bool late = record.exact && run.firstSolutionTime > timeLimit + LATE;
            record.set("late", late);
            record.set("solvable", problem.whyUnsolvable().empty());
            record.set("outcome", run.status);
            record.reason = oneLine(run.reason);
            record.set("success", record.exact && run.hasValidPath() && !late);
            if (record.exact)
                record.set("first solution time", run.firstSolutionTime);
            record.set("planning time", run.planningTime);
            record.set("map loading time", problem.loadingTime() + run.mapLoadingTime);
            record.set("nodes expanded", run.search.expanded);
            record.set("motions generated", run.search.generated);
            record.set("open list operations", run.search.openListOperations);
            record.set("open list comparisons", run.search.openListComparisons);
            if (run.search.stateChecks > 0)  // The checks of a disc are not counted.
            {
                record.set("states checked", run.search.stateChecks);
                record.set("exact checks", run.search.exactChecks);
            }
        }
    }  // namespace

    void takeOmplProperties(RunRecord &record, const std::map<std::string, std::string> &properties)
    {
        for (const auto &[typedName, text] : properties)
        {
            const std::size_t blank = typedName.rfind(' ');
            if (blank == std::string::npos)
                continue;
            std::string name = typedName.substr(0, blank);
            std::replace(name.begin(), name.end(), '_', ' ');
            const std::string type = typedName.substr(blank + 1);
            const RunColumn *column = findRunColumn(name);
            const std::optional<FigureValue> value = figureFrom(text, type);
            if (value && (column == nullptr || type == toString(column->type)))
                record.figures.emplace(name, *value);  // Values measured here take precedence over OMPL's.
        }
    }

    UnitRunner::UnitRunner(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                           const PlannerRegistry &registry, Isolation isolation, const std::atomic<bool> &stop)
      : config_(config),
        experiments_(experiments),
        registry_(registry),
        isolation_(isolation),
        stop_(stop)
    {
        SolveRecord::countProcessorTime(config.processorTime);
    }

    const Problem &UnitRunner::problem(std::size_t experiment)
    {
        std::unique_ptr<Problem> &slot = problems_[experiment];
        if (!slot)
            slot = experiments_[experiment].load();
        return *slot;
    }

    bool UnitRunner::isIsolated(std::size_t planner) const
    {
        return isolation_ == Isolation::All ||
               (isolation_ == Isolation::Plugins && !registry_.find(config_.planners[planner].planner).library.empty());
    }

    double UnitRunner::wallTimeLimit() const
    {
        return config_.processorTime ? BUSY * config_.timeLimit : config_.timeLimit;
    }

    IsolationLimits UnitRunner::limits() const
    {
        return {SOLVE_SHARE * wallTimeLimit() + SOLVE_GRACE, MEASURE_SHARE * config_.timeLimit + MEASURE_GRACE,
                config_.memoryLimit};
    }

    void UnitRunner::checkSettings()
    {
        for (std::size_t i = 0; i < experiments_.size() && !stop_; ++i)
            for (const std::size_t index : experiments_[i].planners)
                checkSettings(i, index);
    }

    void UnitRunner::checkSettings(std::size_t experiment, std::size_t planner)
    {
        const PlannerSpec &spec = config_.planners[planner];
        const PlannerEntry &entry = registry_.find(spec.planner);
        const auto refuse = [&](const std::vector<std::string> &settings, const std::string &why)
        {
            throw Error(config_.lineOf(spec, settings) + "planner " + spec.name + " on " +
                        experiments_[experiment].name + ": " + oneLine(why));
        };
        try
        {
            problem(experiment);
        }
        catch (const SettingError &error)
        {
            refuse(error.settings(), error.what());
        }
        catch (const Error &error)
        {
            refuse({}, error.what());
        }
        const Problem &world = problem(experiment);
        std::string refusal;  // the setting (empty when unknown), a line end, and the reason
        const auto prepare = [&](const std::function<void()> & /*halfDone*/) -> std::string
        {
            try
            {
                world.prepare(entry, spec.settings);
            }
            catch (const SettingError &error)
            {
                return error.settings().front() + "\n" + error.what();
            }
            catch (const Error &error)
            {
                return std::string("\n") + error.what();
            }
            return "";
        };
        try
        {
            if (!isIsolated(planner))
                refusal = prepare({});
            else if (const IsolatedResult result = runIsolated(prepare, limits(), stop_);
                     result.end == IsolatedResult::End::Answered)
                refusal = result.text;
        }
        catch (const std::exception &)
        {
            // All other failures in the process are outcomes of the runs.
        }
        if (!refusal.empty())
            refuse({refusal.substr(0, refusal.find('\n'))}, refusal.substr(refusal.find('\n') + 1));
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

    RunRecord UnitRunner::recordOf(const Unit &unit) const
    {
        RunRecord record;
        record.experiment = experiments_[unit.experiment].name;
        record.planner = config_.planners[unit.planner].name;
        record.set("run", unit.run);
        record.set("seed", seedOf(config_, experiments_, unit));
        return record;
    }

    RunRecord UnitRunner::run(const Unit &unit)
    {
        problem(unit.experiment);  // Loaded here, since another process could not keep it.
        return isIsolated(unit.planner) ? runApart(unit) : runHere(unit, [] {});
    }

    RunRecord UnitRunner::runHere(const Unit &unit, const std::function<void()> &solved)
    {
        RunRecord record = recordOf(unit);
        try
        {
            benchmarkRun(record, unit.planner, problem(unit.experiment), solved);
        }
        catch (...)
        {
            const PlannerFailure failure = currentFailure("it");
            return failedRun(recordOf(unit), failure.status, failure.text);
        }
        return record;
    }

    RunRecord UnitRunner::runApart(const Unit &unit)
    {
        const IsolatedResult result = runIsolated(
            [&](const std::function<void()> &halfDone)
            { return runHere(unit, halfDone).toJson().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); },
            limits(), stop_);
        switch (result.end)
        {
            case IsolatedResult::End::Answered:
                try
                {
                    return RunRecord::fromJson(nlohmann::json::parse(result.text));
                }
                catch (const std::exception &)
                {
                    return failedRun(recordOf(unit), PlanStatus::InvalidAnswer,
                                     "it wrote into the channel of its answer");
                }
            case IsolatedResult::End::TimeUp:
                return failedRun(recordOf(unit), PlanStatus::Hang, result.text);
            case IsolatedResult::End::OutOfMemory:
                return failedRun(recordOf(unit), PlanStatus::Memory,
                                 result.text + " (the limit is " + formatNumber(config_.memoryLimit) + " MB)");
            case IsolatedResult::End::Exception:
                return failedRun(recordOf(unit), PlanStatus::Exception, result.text);
            case IsolatedResult::End::Died:
            case IsolatedResult::End::Stopped:
                break;
        }
        return failedRun(recordOf(unit), PlanStatus::Crash, result.text);
    }

    void UnitRunner::benchmarkRun(RunRecord &record, std::size_t planner, const Problem &world,
                                  const std::function<void()> &solved) const
    {
        const PlannerSpec &spec = config_.planners[planner];
        const auto seed = static_cast<std::uint32_t>(record.number("seed"));
        seedRandomNumbers(seed);
        const PreparedPlanner prepared = world.prepare(registry_.find(spec.planner), spec.settings);
        prepared.planner->setName(spec.name);
        prepared.planner->setTimeLimit(config_.timeLimit);
        prepared.planner->setStop(&stop_);

        ompl::tools::Benchmark benchmark(*prepared.setup, record.experiment);
        benchmark.addPlanner(prepared.planner);
        // clear() has discarded samplers; those created by solve() must not depend on how many existed. The description
        // of the space checked a thousand states.
        PeakMemory memory;
        benchmark.setPreRunEvent(
            [&](const ob::PlannerPtr &)
            {
                seedRandomNumbers(seed);
                world.resetCounts();
                memory.begin();
            });
        std::exception_ptr failure;
        benchmark.setPostRunEvent(
            [&](const ob::PlannerPtr &, std::map<std::string, std::string> &properties)
            {
                // In a shared process the memory of earlier runs is used again, and nothing grows.
                if (isIsolated(planner))
                    record.set("peak memory", memory.megabytes());
                solved();
                takeOmplProperties(record, properties);
                try
                {
                    measure(record, world, prepared);
                }
                catch (...)
                {
                    failure = std::current_exception();  // Not reported by OMPL
                }
            });
        ompl::tools::Benchmark::Request request(wallTimeLimit(), config_.memoryLimit, 1, PROGRESS_INTERVAL, false,
                                                false, false);
        benchmark.benchmark(request);

        if (failure)
            std::rethrow_exception(failure);
        const auto &experiment = benchmark.getRecordedExperimentData();
        if (!record.outcome() || experiment.planners.empty())
            throw Error("an exception, of which OMPL's benchmark reports no details");
        record.parameters = experiment.planners.front().common;
    }

    void UnitRunner::measure(RunRecord &record, const Problem &world, const PreparedPlanner &prepared) const
    {
        const auto status = record.figures.count("status") > 0
                                ? static_cast<ob::PlannerStatus::StatusType>(record.number("status"))
                                : ob::PlannerStatus::UNKNOWN;
        const PlanRun run = evaluateRun(world, prepared, status);
        putOutcome(record, world, run, config_.timeLimit);
        // Without the millisecond in which OMPL's clock detects the end.
        record.set("time", run.planningTime + run.mapLoadingTime);
        record.set("cpu time", run.cpuTime);
        record.progress = prepared.planner->record()->improvements();
        if (!run.path)
            return;
        putPath(record, "", *run.path);
        putMetrics(record, world, *run.path);
        if (const ob::OptimizationObjectivePtr objective = world.objective(); objective && run.hasValidPath())
            record.set("path cost", pathCost(solutionOf(prepared), objective).value());
        record.set("distance to goal", run.goalDistance);
        record.hasPath = true;
        record.path = run.path->path;
        if (config_.simplify && record.exact)
            simplify(record, world, prepared, config_.timeLimit);
        if (config_.track)
            track(record, world, *run.path);
        if (config_.trajectory)
            optimize(record, world, *run.path);
        if (config_.perceive && prepared.improved() != nullptr && world.isDrivable())
            perceive(record, world.scenario(), *config_.perceive);
    }
}  // namespace parking
