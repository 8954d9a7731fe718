// paper_run: the paper's run from the start to standstill in the slot, with every choice that the paper leaves open.
// docs/paper-experiments.md says how.

#include "benchmarks/paper/run/PaperRunJson.h"
#include "benchmarks/paper/run/PaperTask.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/WriteFile.h"

#include <boost/program_options/positional_options.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace po = boost::program_options;

namespace
{
    using namespace parking;

    constexpr int DONE = 0;
    constexpr std::size_t MOST_REPEATS = 1000;

    const std::vector<std::string> ALGORITHMS{"basic_astar",  "experiment_1", "experiment_2", "experiment_3",
                                              "experiment_4", "experiment_5", "experiment_6", "improved_astar"};

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

    po::options_description describe()
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("algorithm", manyValues("NAME"), "a parameter set of the paper's; default: all eight of them");
        add("disc", oneValue("PLACE"),
            "middle: of the body, which is also the point that is planned and driven, as printed (default); ahead: the "
            "body's middle, seen from the rear axle that is planned and driven, as corrected; rear_axle");
        add("radius", oneValue("M"), "of the disc, metres (default 1.25)");
        add("lookup", oneValue("NAME"), "scan: look at every cell in the disc, as printed (default); field: distances");
        add("spline", oneValue("NAME"), "bspline (default), bezier or none; for algorithms that smooth");
        add("per-stretch", "a spline for each stretch between cusps, as corrected; else one through all, as printed");
        add("sampling", oneValue("N"), "every so many points one is a control point (default 3)");
        add("speed", oneValue("M/S"), "at which the wanted position goes along the way (default 1)");
        add("heading-weight", oneValue("N"), "W4 of the controller, per square radian (default 300)");
        add("align-distance", oneValue("M"), "d of the controller, metres (default 2)");
        add("set", manyValues("KEY=VALUE"), "sets a parameter of the planner, for example heuristic=manhattan");
        add("time-limit", oneValue("S"), "seconds for each search (default 5)");
        add("repeats", oneValue("N"), "times are the least of so many runs (default 1)");
        add("no-drive", "plan only");
        add("lines", "with the points of ways and drives");
        add("json", oneValue("FILE|-"), "where to write the runs (default -, standard output)");
        add("help", "this text");
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
        for (const std::string &each : result.algorithms)
            if (std::find(ALGORITHMS.begin(), ALGORITHMS.end(), each) == ALGORITHMS.end())
                throw Error(unknownName("algorithm", each, ALGORITHMS));
        for (const std::string &each : line.texts("set"))
            result.settings.push_back(keyAndValue("--set", each));
        PaperVariant &variant = result.variant;
        variant.place = discPlaceByName(line.text("disc").value_or("middle"));
        variant.radius = line.positive("radius").value_or(variant.radius);
        variant.lookup = discLookupByName(line.text("lookup").value_or("scan"));
        variant.spline = splineByName(line.text("spline").value_or("bspline"));
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

    int run(const std::vector<std::string> &arguments)
    {
        const Options options = readOptions(arguments);
        if (options.help)
        {
            std::cout << "usage: paper_run SCENARIO... [options]\n\n"
                         "The paper's run: manoeuvre, A*, one spline through both, and the drive to standstill in the\n"
                         "slot. Each SCENARIO is a YAML file with a slot; its map may be a frame of SurroundOcc.\n\n"
                      << describe() << "\nStatus: 0 done, whatever the runs came to; 2 bad input or usage\n";
            return DONE;
        }
        if (options.json != "-")
            requireOutputs({options.json}, options.scenarios);
        for (const std::string &algorithm : options.algorithms)
            parametersOf(algorithm, options);
        nlohmann::json runs = nlohmann::json::array();
        for (const std::string &file : options.scenarios)
        {
            Scenario scenario = readScenario(file);
            if (options.json != "-")
                requireNoInput({options.json}, scenario.files);
            const PaperTask task(std::move(scenario), options.variant);
            for (const std::string &algorithm : options.algorithms)
                runs.push_back(paperRunJson(file.substr(file.find_last_of('/') + 1), algorithm, task,
                                            runOf(task, parametersOf(algorithm, options), options), options.lines));
        }
        const std::string text = nlohmann::json{{"format", PAPER_RUN_FORMAT}, {"runs", runs}}.dump() + "\n";
        if (options.json == "-")
            std::cout << text << std::flush;
        else
            writeFileAtomically(options.json, text);
        return DONE;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("paper_run", argc, argv, run);
}
