// paper_run: the paper's run from the start to standstill in the slot, with options for the choices that the paper
// leaves open. See docs/paper.md.

#include "benchmarks/paper/PaperTask.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/WriteFile.h"

#include <boost/program_options/positional_options.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace po = boost::program_options;

namespace
{
    using namespace parking;
    using nlohmann::json;

    constexpr int FORMAT = 1;  // of the JSON
    constexpr std::size_t MOST_REPEATS = 1000;
    constexpr double DEGREES = 180.0 / PI;
    constexpr double MS = 1e3;
    constexpr double CUSP = 0.75 * PI;  // radians; larger turns of a curve are changes of direction

    const std::vector<std::string> ALGORITHMS{"basic_astar",  "experiment_1", "experiment_2", "experiment_3",
                                              "experiment_4", "experiment_5", "experiment_6", "paper_improved_astar"};

    struct Options
    {
        bool help{false}, lines{false}, drive{true};
        std::vector<std::string> scenarios, algorithms{ALGORITHMS};
        std::vector<std::pair<std::string, std::string>> settings;
        PaperVariant variant;
        std::size_t repeats{1};
        double timeLimit{5.0};
        std::string json{"-"};
    };

    /** The choice of this name. Throws parking::Error listing the names for another one. */
    template <class Choice>
    Choice chosen(const std::string &what, const std::string &name,
                  const std::vector<std::pair<std::string, Choice>> &choices)
    {
        std::vector<std::string> names;
        for (const auto &[known, choice] : choices)
        {
            if (known == name)
                return choice;
            names.push_back(known);
        }
        throw Error(unknownName(what, name, names));
    }

    po::options_description describe()
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("algorithm", manyValues("NAME"), "a parameter set of the paper; default: all eight");
        add("disc", oneValue("PLACE"),
            "middle: of the body, which is also the point that is planned and driven, as printed (default); "
            "ahead: the body's middle, ahead of the rear axle that is planned and driven, as corrected; "
            "rear_axle");
        add("radius", oneValue("M"), "radius of the disc in metres (default 1.25)");
        add("lookup", oneValue("NAME"), "scan: every cell in the disc, as printed (default); field: a distance field");
        add("spline", oneValue("NAME"), "bspline (default), bezier or none; for algorithms that smooth");
        add("per-stretch",
            "one spline for each stretch between cusps, as corrected; otherwise one in total, as printed");
        add("sampling", oneValue("N"), "number of points per control point (default 3)");
        add("speed", oneValue("M/S"), "speed of the reference along the path (default 1)");
        add("heading-weight", oneValue("N"), "W4 of the controller, per square radian (default 300)");
        add("align-distance", oneValue("M"), "d of the controller in metres (default 2)");
        add("set", manyValues("KEY=VALUE"), "set a parameter of the planner, for example heuristic=manhattan");
        add("time-limit", oneValue("S"), "limit in seconds for each search (default 5)");
        add("repeats", oneValue("N"), "report the minimum time of N runs (default 1)");
        add("no-drive", "plan only");
        add("lines", "add the points of paths and drives");
        add("json", oneValue("FILE|-"), "output file for the runs (default -, standard output)");
        add("help", "print this text");
        return options;
    }

    Options readOptions(const std::vector<std::string> &arguments)
    {
        po::options_description options = describe();
        options.add_options()("scenario", po::value<std::vector<std::string>>());
        const CommandLine line(arguments, options, po::positional_options_description().add("scenario", -1));
        Options result;
        result.help = line.given("help");
        if (result.help)
            return result;
        result.scenarios = line.texts("scenario");
        if (result.scenarios.empty())
            throw Error("no scenario given (see --help)");
        if (line.given("algorithm"))
            result.algorithms = line.texts("algorithm");
        for (std::string &each : result.algorithms)
        {
            each = parameterSetName(each);
            if (std::find(ALGORITHMS.begin(), ALGORITHMS.end(), each) == ALGORITHMS.end())
                throw Error(unknownName("algorithm", each, ALGORITHMS));
        }
        for (const std::string &each : line.texts("set"))
            result.settings.push_back(keyAndValue("--set", each));
        PaperVariant &variant = result.variant;
        variant.place = chosen<DiscPlace>(
            "place of the disc", line.text("disc").value_or("middle"),
            {{"middle", DiscPlace::Middle}, {"ahead", DiscPlace::Ahead}, {"rear_axle", DiscPlace::RearAxle}});
        variant.radius = line.positive("radius").value_or(variant.radius);
        variant.scan = chosen<bool>("lookup", line.text("lookup").value_or("scan"), {{"scan", true}, {"field", false}});
        variant.degree = chosen<std::size_t>("spline", line.text("spline").value_or("bspline"),
                                             {{"none", POLYLINE}, {"bspline", BSPLINE}, {"bezier", BEZIER}});
        variant.acrossCusps = !line.given("per-stretch");
        variant.sampling = line.whole("sampling", 1, 100).value_or(variant.sampling);
        variant.drive.speed = line.positive("speed").value_or(variant.drive.speed);
        variant.drive.headingWeight = line.positive("heading-weight").value_or(variant.drive.headingWeight);
        variant.drive.alignDistance = line.positive("align-distance").value_or(variant.drive.alignDistance);
        result.timeLimit = line.positive("time-limit", LONGEST_RUN).value_or(result.timeLimit);
        result.repeats = line.whole("repeats", 1, MOST_REPEATS).value_or(result.repeats);
        result.drive = !line.given("no-drive");
        result.lines = line.given("lines");
        result.json = line.outputFile("json").value_or(result.json);
        return result;
    }

    PlannerParameters parametersOf(const std::string &algorithm, const Options &options)
    {
        PlannerParameters parameters = parameterSet(algorithm, PlannerParameters());
        for (const auto &[key, value] : options.settings)
            parameterNamed(key).setText(parameters, value);
        checkParameters(parameters);
        return parameters;
    }

    PaperRun runOf(const PaperTask &task, const PlannerParameters &parameters, const Options &options)
    {
        PaperRun run = task.run(parameters, options.timeLimit, options.drive);
        for (std::size_t k = 1; k < options.repeats; ++k)
        {
            const PaperRun again = task.run(parameters, options.timeLimit, false);
            run.loadingTime = std::min(run.loadingTime, again.loadingTime);
            run.planningTime = std::min(run.planningTime, again.planningTime);
        }
        return run;
    }

    /** Rounds to a tenth of a millimetre and similar: figures for readers and plots. */
    double rounded(double value)
    {
        return std::round(value * 1e4) / 1e4;
    }

    json poseJson(const Pose &pose)
    {
        return {rounded(pose.x), rounded(pose.y), rounded(pose.yaw)};
    }

    json pointsJson(const std::vector<Eigen::Vector2d> &points)
    {
        json list = json::array();
        for (const Eigen::Vector2d &point : points)
            list.push_back({rounded(point.x()), rounded(point.y())});
        return list;
    }

    json driveJson(const PaperDriveResult &drive, bool lines)
    {
        json text{{"stands", drive.stands},
                  {"travel_time_s", rounded(drive.travelTime)},
                  {"mean_abs_acceleration", drive.meanAcceleration},
                  {"mean_abs_steering_deg", drive.meanSteering * DEGREES},
                  {"final_position_error_m", rounded(drive.positionError)},
                  {"final_yaw_error_deg", rounded(drive.headingError * DEGREES)},
                  {"max_deviation_m", rounded(drive.greatestDeviation)},
                  {"colliding_share", drive.collidingShare},
                  {"solver_failures", drive.failures}};
        for (std::size_t i = 0; lines && i < drive.states.size(); ++i)
        {
            const PaperDriveState &state = drive.states[i];
            text["states"].push_back({rounded(state.time), rounded(state.pose.x), rounded(state.pose.y),
                                      rounded(state.pose.yaw), rounded(state.speed), rounded(state.acceleration),
                                      rounded(state.steering)});
        }
        return text;
    }

    json runJson(const std::string &scenario, const std::string &algorithm, const PaperTask &task, const PaperRun &run,
                 bool lines)
    {
        json text{{"scenario", scenario},
                  {"algorithm", algorithm},
                  {"status", run.status},
                  {"reason", run.reason},
                  {"manoeuvres", task.manoeuvres().size()},
                  {"map_loading_time_ms", MS * run.loadingTime},
                  {"planning_time_ms", MS * run.planningTime},
                  {"expanded", run.statistics.expanded},
                  {"open_list_operations", run.statistics.openListOperations},
                  {"open_list_comparisons", run.statistics.openListComparisons},
                  {"positions_checked", run.counts.positions},
                  {"cells_looked_at", run.counts.cells}};
        if (run.curve.empty())
            return text;
        text["approach_m"] = rounded(run.approachLength);
        text["approach_error_m"] = rounded(run.approachError);
        text["arrival_turn_deg"] = rounded(run.arrivalTurn * DEGREES);
        text["length_m"] = rounded(lengthOf(run.curve));
        text["turning_deg"] = rounded(turningOf(run.curve, CUSP) * DEGREES);
        text["approach_colliding_share"] = run.approachCollidingShare;
        text["goal"] = poseJson(run.goal);
        text["parking_start"] = poseJson(run.parkingStart);
        if (lines)
        {
            text["corners"] = pointsJson(run.corners);
            text["curve"] = pointsJson(run.curve);
        }
        if (!run.drive.states.empty())
            text["drive"] = driveJson(run.drive, lines);
        return text;
    }

    int run(const std::vector<std::string> &arguments)
    {
        const Options options = readOptions(arguments);
        if (options.help)
        {
            std::cout
                << "usage: paper_run SCENARIO... [options]\n\n"
                   "Executes the paper's run: manoeuvre, A*, one spline along both, and the drive to standstill.\n"
                   "Each SCENARIO is a YAML file, whose map may be a frame of SurroundOcc. Without a slot there is\n"
                   "no manoeuvre: A* plans to the goal.\n\n"
                   "Examples, run at the root of the project:\n"
                   "  paper_run benchmarks/paper/maps/perpendicular.yaml --algorithm paper_improved_astar\n"
                   "  paper_run benchmarks/scenarios/parallel.yaml --lookup field --disc ahead --json runs.json\n\n"
                << describe() << "\nStatus: 0 done with any status of the runs; 2 invalid input or usage\n";
            return 0;
        }
        if (options.json != "-")
            requireOutputs({options.json}, options.scenarios);
        for (const std::string &algorithm : options.algorithms)
            parametersOf(algorithm, options);
        json runs = json::array();
        for (const std::string &file : options.scenarios)
        {
            const Scenario scenario = readScenario(file);
            if (options.json != "-")
                requireNoInput({options.json}, scenario.files);
            for (const std::string &warning : scenario.warnings)
                std::cerr << "paper_run: " << warning << std::endl;
            const PaperTask task(scenario, options.variant);
            for (const std::string &algorithm : options.algorithms)
                runs.push_back(runJson(file.substr(file.find_last_of('/') + 1), algorithm, task,
                                       runOf(task, parametersOf(algorithm, options), options), options.lines));
        }
        const std::string text = json{{"format", FORMAT}, {"runs", runs}}.dump() + "\n";
        if (options.json == "-")
            std::cout << text << std::flush;
        else
            writeFileAtomically(options.json, text);
        return 0;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("paper_run", argc, argv, run);
}
