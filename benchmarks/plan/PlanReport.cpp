#include "benchmarks/plan/PlanReport.h"

#include "automatic_parking/ParkingWorld.h"
#include "automatic_parking/drawing/DriveAnimation.h"
#include "automatic_parking/drawing/DriveFigure.h"
#include "benchmarks/plan/PerceivedDrive.h"
#include "benchmarks/system/Counted.h"
#include "benchmarks/system/ProcessorTime.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/drawing/Svg.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr double MS = 1e3;                // milliseconds in a second
        constexpr double TRAJECTORY_STEP = 0.05;  // seconds between samples
        constexpr double NO_DISTANCE = 1e-6;      // metres from the goal, of paths that end there
        constexpr double DEGREES = 180.0 / PI;    // in a radian

        /** Whether the car steers at any time. */
        bool steers(const TimedMotion &motion)
        {
            return std::any_of(motion.knots.begin(), motion.knots.end(),
                               [](const MotionKnot &knot) { return knot.steering != 0.0; });
        }

        json vehicleJson(const Vehicle &vehicle)
        {
            json outline = json::array();
            for (const Eigen::Vector2d &corner : vehicle.outline)
                outline.push_back({corner.x(), corner.y()});
            return {{"name", vehicle.name},
                    {"wheelbase", vehicle.wheelbase},
                    {"front_overhang", vehicle.frontOverhang},
                    {"rear_overhang", vehicle.rearOverhang},
                    {"width", vehicle.width},
                    {"outline", outline},
                    {"max_steering_angle", vehicle.maxSteeringAngle},
                    {"max_speed", vehicle.maxSpeed},
                    {"max_acceleration", vehicle.maxAcceleration},
                    {"max_steering_rate", vehicle.maxSteeringRate},
                    {"min_turning_radius", vehicle.minTurningRadius()}};
        }

        json poseJson(const Scenario &scenario, const Pose &local)
        {
            const Pose pose = scenario.toWorld(local);
            return {{"x", pose.x}, {"y", pose.y}, {"yaw", pose.yaw}};
        }

        json pathJson(const Scenario &scenario, const SampledPath &path)
        {
            json states = json::array();
            for (const PathState &state : path)
            {
                json each = poseJson(scenario, state.pose);
                each["direction"] = state.direction;
                each["curvature"] = state.curvature;
                states.push_back(std::move(each));
            }
            return states;
        }

        /** JSON has no infinity: values that are not finite become null. */
        json number(double value)
        {
            return std::isfinite(value) ? json(value) : json(nullptr);
        }

        json whole(const std::optional<std::uint64_t> &count)
        {
            return count ? json(*count) : json(nullptr);
        }

        json timesJson(const TimeStatistics &times)
        {
            return {{"median", MS * times.median}, {"p99", MS * times.p99}, {"max", MS * times.max}};
        }

        json trackingJson(const PlanReport &result)
        {
            if (!result.drive)
                return {{"arrived", false}, {"message", result.driveError}};
            const Evaluation &figures = result.drive->evaluation;
            return {{"arrived", result.drive->arrived},
                    {"message", result.drive->message},
                    {"travel_time_s", figures.travelTime},
                    {"driven_length_m", figures.drivenLength},
                    {"mean_abs_acceleration", figures.meanAbsAcceleration},
                    {"mean_abs_steering_deg", figures.meanAbsSteering * DEGREES},
                    {"max_position_error_m", figures.maxPositionError},
                    {"final_position_error_m", figures.finalPositionError},
                    {"final_yaw_error_rad", figures.finalYawError},
                    {"corner_deviation_m", figures.cornerDeviation},
                    {"min_clearance_m", number(figures.minClearance)},
                    {"mpc_solve_ms", timesJson(figures.solveTime)},
                    {"collisions", figures.collisions}};
        }

        json perceptionJson(const SensorParameters &sensor, const ParkingResult &drive)
        {
            const ReactionFigures figures = reactionFigures(drive);
            return {{"range_m", sensor.range},
                    {"rate_hz", sensor.rate},
                    {"stops", figures.stops},
                    {"new_motions", figures.newMotions},
                    {"check_ms", timesJson(figures.check)},
                    {"new_motion_ms", timesJson(figures.motion)},
                    {"events", drive.events}};
        }

        /** Text such as "2 stops and 3 new motions, found in 24 ms (median) to 80 ms". */
        std::string perceptionText(const ParkingResult &drive)
        {
            const ReactionFigures figures = reactionFigures(drive);
            std::string text =
                counted(figures.stops, "stop") + " to plan and " + counted(figures.newMotions, "new motion");
            if (figures.newMotions > 0)
                text += ", found in " + formatNumber(MS * figures.motion.median, 0) + " ms (median) to " +
                        formatNumber(MS * figures.motion.max, 0) + " ms";
            return text + "; checks take " + formatNumber(MS * figures.check.median, 1) + " ms";
        }

        /** Text such as "1.20 m, 2 changes of direction, least clearance 0.123 m". */
        std::string pathText(const PlannedPath &path)
        {
            return formatNumber(path.length, 2) + " m, " + counted(path.cusps, "change") +
                   " of direction, least clearance " + formatNumber(path.clearance, 3) + " m";
        }

        json trajectoryJson(const Scenario &scenario, const Trajectory &trajectory, bool withSteeringRate)
        {
            json samples = json::array();
            for (const TrajectoryPoint &point : trajectory)
            {
                json each = poseJson(scenario, {point.x, point.y, point.yaw});
                each["t"] = point.t;
                each["v"] = point.v;
                each["steering"] = point.steering;
                each["acceleration"] = point.acceleration;
                if (withSteeringRate)
                    each["steering_rate"] = point.steeringRate;
                samples.push_back(std::move(each));
            }
            return samples;
        }

        void addTrajectoryTo(json &text, const Scenario &scenario, const PlanReport &result)
        {
            text["planned_trajectory"] = trajectoryJson(scenario, result.samples, true);
            if (!result.trajectory)
            {
                text["trajectory_optimization"] = {{"message", result.trajectoryError}};
                return;
            }
            const OptimizedTrajectory &optimized = result.trajectory->trajectory;
            const TpcapCost cost = tpcapCost(optimized.motion);
            text["trajectory_optimization"] = {{"duration_s", optimized.motion.duration()},
                                               {"time_ms", MS * result.trajectoryTime},
                                               {"fallback", optimized.fallback},
                                               {"message", optimized.reason},
                                               {"rounds", optimized.rounds},
                                               {"iterations", optimized.iterations},
                                               {"paths", result.trajectory->paths},
                                               {"path", optimized.path},
                                               {"tpcap_cost",
                                                {{"J", cost.total()},
                                                 {"time_s", cost.time},
                                                 {"control_effort", cost.controlEffort},
                                                 {"steering_integral", cost.steeringIntegral},
                                                 {"gear_changes", cost.gearChanges}}}};
        }

        /** Figures of a path that the referee rejects are meaningless. */
        std::string statusOf(const PlanRun &run)
        {
            if (run.path && !run.hasValidPath())
                return "invalid_path";
            return run.escapes && run.goalDistance < NO_DISTANCE ? "escaped" : toString(run.status);
        }

        json runJson(const PlanRun &run)
        {
            json each{{"status", statusOf(run)},
                      {"planning_time_ms", MS * run.planningTime},
                      {"first_solution_ms", run.isSolved() ? json(MS * run.firstSolutionTime) : json(nullptr)}};
            each["length_m"] = run.path ? json(run.path->length) : json(nullptr);
            each["cusps"] = run.path ? json(run.path->cusps) : json(nullptr);
            each["valid"] = run.path ? json(run.hasValidPath()) : json(nullptr);
            return each;
        }

        /** Removes the subject that starts the optimizer's messages: the output shows it already. */
        std::string withoutSubject(const std::string &message)
        {
            const std::string subject = "trajectory: ";
            return message.compare(0, subject.size(), subject) == 0 ? message.substr(subject.size()) : message;
        }

        std::string driveSummary(const DriveResult &drive)
        {
            const Evaluation &figures = drive.evaluation;
            std::string text = drive.message + " after " + formatNumber(figures.travelTime, 1) + " s, " +
                               formatNumber(100.0 * figures.finalPositionError, 1) + " cm from the end of the path, " +
                               counted(figures.collisions, "collision");
            if (figures.cornerDeviation > 0.0)
                text += " (no car can drive the path's corners; it leaves the path there by up to " +
                        formatNumber(figures.cornerDeviation, 2) + " m)";
            return text;
        }
    }  // namespace

    json parametersJson(const ompl::base::Planner &planner)
    {
        std::map<std::string, std::string> parameters;
        planner.params().getParams(parameters);
        json result = json::object();
        for (const auto &[name, value] : parameters)
        {
            double parsed = 0.0;
            const auto &parameter = planner.params().getParam(name);
            if (dynamic_cast<const ompl::base::SpecificParam<bool> *>(parameter.get()) != nullptr)
                result[name] = value != "0";
            else if (parseNumber(value, parsed))
                result[name] = parsed == std::trunc(parsed) && std::abs(parsed) < 1e15
                                   ? json(static_cast<std::int64_t>(parsed))
                                   : json(parsed);
            else
                result[name] = value;
        }
        return result;
    }

    int exitStatus(const PlanRun &run, bool isAllWritten)
    {
        constexpr int EXACT = 0, APPROXIMATE = 3, NOTHING = 4;
        if (!isAllWritten)
            return NOTHING;
        if (run.isSolved())
            return EXACT;
        return run.status == PlanStatus::Approximate && run.hasValidPath() ? APPROXIMATE : NOTHING;
    }

    std::vector<std::string> missingFiles(const PlanOptions &options, const PlanReport &result)
    {
        std::vector<std::string> missing;
        if (!result.first().path)
            return missing;
        if (!options.csv.empty() && !result.trajectory)
            missing.push_back(options.csv + " is not written: no trajectory: " + result.trajectoryError);
        if (!options.html.empty() && !result.drive)
            missing.push_back(options.html + " is not written: not driven: " + result.driveError);
        return missing;
    }

    json resultJson(const Problem &problem, const PlanOptions &options, const PlanReport &result)
    {
        const Scenario &scenario = problem.scenario();
        const PlanRun &run = result.first();
        json times = json::array(), runs = json::array(), goals = json::array();
        for (const PlanRun &each : result.runs)
        {
            times.push_back(MS * each.planningTime);
            runs.push_back(runJson(each));
        }
        for (const Pose &goal : scenario.goals)
            goals.push_back(poseJson(scenario, goal));
        json text{{"format", 1},
                  {"scenario", scenario.name},
                  {"scenario_file", options.scenario},
                  {"planner", result.planner},
                  {"parameters", result.parameters},
                  {"space", toString(problem.settings().space)},
                  {"footprint", toString(problem.settings().footprint)},
                  {"circle_radius_m", problem.circleRadius() > 0.0 ? json(problem.circleRadius()) : json(nullptr)},
                  {"seed", options.seed},
                  {"time_limit_s", options.timeLimit},
                  {"vehicle", vehicleJson(scenario.vehicle)},
                  {"start", poseJson(scenario, scenario.start)},
                  {"goals", std::move(goals)},
                  {"status", statusOf(run)},
                  {"reason", run.reason},
                  {"notice", run.notice},
                  {"map_loading_time_ms", MS * (problem.loadingTime() + run.mapLoadingTime)},
                  {"planning_time_ms", std::move(times)},
                  {"runs", std::move(runs)},
                  {"path", run.path ? pathJson(scenario, run.path->states()) : json::array()},
                  {"length_m", run.path ? json(run.path->length) : json(nullptr)},
                  {"cusps", run.path ? json(run.path->cusps) : json(nullptr)},
                  {"min_clearance_m", run.path ? number(run.path->clearance) : json(nullptr)},
                  {"goal_distance_m", run.path ? json(run.goalDistance) : json(nullptr)},
                  {"search",
                   {{"expanded", run.search.expanded},
                    {"generated", run.search.generated},
                    {"state_checks", run.search.stateChecks},
                    {"exact_checks", run.search.exactChecks},
                    {"open_list_operations", whole(run.search.openListOperations)},
                    {"open_list_comparisons", whole(run.search.openListComparisons)},
                    {"suboptimality_bound", number(run.suboptimalityBound)}}}};
        if (run.path)
            text["recheck"] = {{"valid", run.hasValidPath()},
                               {"states", run.path->recheck.states},
                               {"collisions", run.path->recheck.collisions},
                               {"fault", toString(run.path->recheck.fault)},
                               {"reason", run.path->recheck.reason}};
        if (options.trajectory)
            addTrajectoryTo(text, scenario, result);
        if (!options.track)
            return text;
        if (run.path)
            text["tracking"] = trackingJson(result);
        if (result.perceived)
            text["perception"] = perceptionJson(*options.perceive, *result.perceived);
        text["trajectory"] = result.drive ? trajectoryJson(scenario, result.drive->trajectory, false) : json::array();
        return text;
    }

    std::string resultSummary(const Problem &problem, const PlanReport &result)
    {
        const PlanRun &run = result.first();
        std::string text = problem.scenario().name + ": " + statusOf(run) + " (" + result.planner + ", " +
                           formatNumber(MS * run.planningTime, 1) + " ms; loading the map " +
                           formatNumber(MS * (problem.loadingTime() + run.mapLoadingTime), 1) + " ms)\n";
        if (!run.reason.empty())
            text += "  " + run.reason + "\n";
        if (!run.notice.empty())
            text += "  " + run.notice + "\n";
        if (result.runs.size() > 1)
        {
            std::size_t solved = 0;
            for (const PlanRun &each : result.runs)
                solved += each.isSolved() ? 1 : 0;
            text += "  solved " + std::to_string(solved) + " of " + counted(result.runs.size(), "run") + "\n";
        }
        if (run.path)
        {
            text += "  " + pathText(*run.path);
            if (run.status == PlanStatus::Approximate)
                text += ", ends " + formatNumber(run.goalDistance, 2) + " m from the goal";
            text += run.hasValidPath()
                        ? "\n  " + std::string(run.escapes ? "after the escape " : "") + "checked again at " +
                              std::to_string(run.path->recheck.states) + " poses: valid\n"
                        : "\n  checked again: NOT VALID, " + run.path->recheck.reason + "\n";
        }
        if (result.trajectory)
            text += "  trajectory: " + formatNumber(result.trajectory->trajectory.motion.duration(), 2) +
                    " s, found in " + formatNumber(MS * result.trajectoryTime, 1) + " ms" +
                    (result.trajectory->trajectory.fallback && steers(result.trajectory->trajectory.motion)
                         ? " (stops to steer: " + result.trajectory->trajectory.reason + ")"
                         : "") +
                    "\n";
        else if (!result.trajectoryError.empty())
            text += "  no trajectory: " + result.trajectoryError + "\n";
        if (result.drive)
            text += "  driven: " + driveSummary(*result.drive) + "\n";
        if (result.drive && result.perceived)
            text += "  perceived on the way: " + perceptionText(*result.perceived) + "\n";
        if (!result.driveError.empty())
            text += "  not driven: " + result.driveError + "\n";
        return text;
    }

    std::string resultSvg(const Problem &problem, const PlanReport &result)
    {
        const Scenario &scenario = problem.scenario();
        const PlanRun &run = result.first();
        const SampledPath path = run.path ? run.path->states() : SampledPath{};
        std::string subtitle =
            result.planner + ", " + statusOf(run) + ", " + formatNumber(MS * run.planningTime, 1) + " ms";
        if (run.path)
            subtitle += ", path of " + pathText(*run.path);
        if (result.trajectory)
            subtitle += ", trajectory of " + formatNumber(result.trajectory->trajectory.motion.duration(), 2) + " s";
        if (result.drive)
            subtitle += ", driven in " + formatNumber(result.drive->evaluation.travelTime, 1) + " s";
        SvgFigure figure(scenario.name, subtitle);
        const Trajectory driven = result.drive ? result.drive->trajectory : Trajectory();
        figure.setMap(driveMap(scenario, path, result.samples, driven));
        if (path.size() > 1)
            figure.addPlot(curvaturePlot(path, scenario.vehicle));
        if (!driven.empty() || !result.samples.empty())
            for (const SvgPlot &plot : drivePlots(driven, scenario.vehicle, result.samples))
                figure.addPlot(plot);
        return figure.toString();
    }

    void addTrajectory(const Problem &problem, PlanReport &result, bool isDriven)
    {
        constexpr double ERROR_OF_TRACKING = 0.02;  // metres, without disturbances
        const PlanRun &run = result.first();
        if (!run.path)
            return;
        const double begin = processorTime();
        try
        {
            QuickestTrajectoryOptions options;
            options.alternatives = run.status == PlanStatus::Exact && problem.isDrivable();
            options.forwardOnly = problem.settings().space == SpaceKind::Dubins;
            if (isDriven)
            {
                options.trajectory.margin =
                    std::max(options.trajectory.margin,
                             std::min(ERROR_OF_TRACKING, 0.5 * minClearance(problem.footprint(), run.path->path)));
                options.trajectory.sharpest = false;
            }
            result.trajectory =
                quickestTrajectory(problem.footprint(), problem.scenario().bounds, run.path->path, options);
            result.samples = sample(result.trajectory->trajectory.motion, problem.scenario().vehicle, TRAJECTORY_STEP);
        }
        catch (const Error &error)
        {
            result.trajectoryError = withoutSubject(error.what());
        }
        result.trajectoryTime = processorTime() - begin;
    }

    std::string resultCsv(const Problem &problem, const PlanReport &result)
    {
        Trajectory trajectory = result.samples;
        for (TrajectoryPoint &point : trajectory)
        {
            const Pose pose = problem.scenario().toWorld({point.x, point.y, point.yaw});
            point.x = pose.x;
            point.y = pose.y;
        }
        return toCsv(trajectory);
    }

    void addDrive(const Problem &problem, PlanReport &result, const std::optional<SensorParameters> &perceive)
    {
        const PlanRun &run = result.first();
        if (!run.path)
            return;
        if (!result.trajectoryError.empty())
        {
            // The path instead would be another drive than requested, and often one that no car can drive.
            result.driveError = "there is no trajectory to drive: " + result.trajectoryError;
            return;
        }
        try
        {
            if (perceive)
            {
                result.perceived = perceivedDrive(problem.scenario(), *perceive);
                const ParkingResult &drive = *result.perceived;
                if (drive.trajectory.empty())
                    result.driveError = drive.message;
                else
                    result.drive = DriveResult{
                        drive.parked(), drive.message, drive.trajectory, {}, drive.events, drive.evaluation, {}};
                return;
            }
            const ClosedLoop loop = problem.closedLoop();
            result.drive =
                result.trajectory ? loop.follow(result.trajectory->trajectory.motion) : loop.drive(run.path->path);
        }
        catch (const Error &error)
        {
            result.driveError = error.what();
        }
    }

    std::string resultHtml(const Problem &problem, const PlanReport &result)
    {
        const Scenario &scenario = problem.scenario();
        if (!result.drive)
            throw Error("there is no drive to show: " + (result.driveError.empty() ? "no path" : result.driveError));
        const Evaluation &figures = result.drive->evaluation;
        return driveAnimation(scenario, result.first().path->path, result.drive->trajectory, scenario.name,
                              {result.planner + ", " + formatNumber(figures.drivenLength, 1) + " m in " +
                                   formatNumber(figures.travelTime, 1) + " s, ends " +
                                   formatNumber(100.0 * figures.finalPositionError, 1) + " cm from the end of the path",
                               result.samples, result.perceived ? result.perceived->history : DriveHistory()});
    }
}  // namespace parking
