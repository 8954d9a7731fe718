#include "benchmarks/plan/PlanOptions.h"

#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/Vehicle.h"

#include <limits>
#include <sstream>

namespace po = boost::program_options;

namespace parking
{
    namespace
    {
        constexpr std::size_t MAX_RUNS = 1000000;

        po::options_description describe()
        {
            po::options_description options("Options");
            auto add = options.add_options();
            add("planner", oneValue("NAME"), "planner (default improved_astar)");
            add("vehicle", oneValue("NAME|FILE"), "car instead of the scenario's: a known name or a YAML file");
            add("set", manyValues("KEY=VALUE"), "sets a parameter of the planner; may be given several times");
            add("space", oneValue("NAME"), "reeds_shepp (default), dubins or se2 (default for the grid models)");
            add("footprint", oneValue("NAME"), "rectangle (default) or circle (default for the grid models)");
            add("circle-radius", oneValue("M"), "metres; default: half of the car's width");
            add("time-limit", oneValue("S"), "seconds for each run (default 5)");
            add("runs", oneValue("N"),
                "plan N times with seeds seed, seed + 1, ... "
                "(default 1); the first run's path is the result");
            add("seed", oneValue("N"), "of the random numbers (default 1)");
            add("trajectory", "optimise the path in time: the fastest trajectory near it");
            add("track",
                "drive it with the model predictive controller: the trajectory, or without --trajectory the path, "
                "standing "
                "wherever its curvature jumps");
            add("json", oneValue("FILE|-"), "write the result, - to standard output");
            add("svg", oneValue("FILE"), "draw the result");
            add("csv", oneValue("FILE"),
                "with --trajectory: write it as a table, t,x,y,yaw,v,a,steering,steering_rate");
            add("html", oneValue("FILE"), "with --track: a page that shows the drive");
            add("plugin", manyValues("LIB.so"), "load planners from a library");
            add("help", "this text");
            return options;
        }
    }  // namespace

    std::vector<std::string> PlanOptions::outputFiles() const
    {
        std::vector<std::string> files;
        for (const std::string &each : {json == "-" ? "" : json, svg, csv, html})
            if (!each.empty())
                files.push_back(each);
        return files;
    }

    std::vector<std::string> PlanOptions::inputFiles() const
    {
        std::vector<std::string> files = plugins;
        files.push_back(scenario);
        if (!vehicle.empty())
            files.push_back(vehicle);
        return files;
    }

    PlanOptions readPlanOptions(const std::vector<std::string> &arguments)
    {
        po::options_description options = describe();
        options.add_options()("scenario", po::value<std::string>());
        const CommandLine line(arguments, options, po::positional_options_description().add("scenario", 1));
        PlanOptions result;
        result.plugins = line.texts("plugin");
        result.help = line.given("help");
        if (result.help)
            return result;  // with the plug-ins, whose planners it names
        if (!line.given("scenario"))
            throw Error("no scenario given (see --help)");
        result.scenario = *line.text("scenario");
        result.planner = line.text("planner").value_or(result.planner);
        result.vehicle = line.name("vehicle").value_or("");
        for (const std::string &each : line.texts("set"))
            result.settings.push_back(keyAndValue("--set", each));
        if (const auto space = line.text("space"))
            result.space = spaceByName(*space);
        if (const auto footprint = line.text("footprint"))
            result.footprint = footprintByName(*footprint);
        result.circleRadius = line.positive("circle-radius").value_or(result.circleRadius);
        result.timeLimit = line.positive("time-limit", LONGEST_RUN).value_or(result.timeLimit);
        result.runs = line.whole("runs", 1, MAX_RUNS).value_or(result.runs);
        result.seed = line.whole("seed", 1, std::numeric_limits<std::uint32_t>::max() - MAX_RUNS).value_or(result.seed);
        result.trajectory = line.given("trajectory");
        result.track = line.given("track");
        result.json = line.outputFile("json").value_or("");
        result.svg = line.outputFile("svg").value_or("");
        result.html = line.outputFile("html").value_or("");
        result.csv = line.outputFile("csv").value_or("");
        if (line.given("csv") && !result.trajectory)
            throw Error("--csv writes the trajectory and needs --trajectory");
        if (line.given("html") && !result.track)
            throw Error("--html shows the drive and needs --track");
        return result;
    }

    std::string planHelp(const PlannerRegistry &registry)
    {
        std::ostringstream text;
        text << "usage: parking_plan SCENARIO [options]\n\n"
                "Plans one parking problem. SCENARIO is a YAML scenario or a TPCAP case (docs/scenarios.md);\n"
                "parking_convert makes scenarios of other formats (docs/scenarios.md).\n\n"
             << describe() << "\nPlanners:\n";
        for (const PlannerEntry &each : registry.entries())
            text << "  " << each.name << std::string(each.name.size() < 20 ? 22 - each.name.size() : 2, ' ')
                 << each.summary << "\n";
        text << "\nVehicles:";
        for (const std::string &each : vehicleNames())
            text << ' ' << each;
        text << "\n\nStatus: 0 exact solution, 3 only an approximate one, 4 none found, or nothing to write with\n"
                "--csv or --html, 2 bad input or usage\n";
        return text.str();
    }
}  // namespace parking
