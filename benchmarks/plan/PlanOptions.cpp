#include "benchmarks/plan/PlanOptions.h"

#include "benchmarks/plan/PerceivedDrive.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/text/Text.h"

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
            add("vehicle", oneValue("NAME|FILE"), "replace the scenario's car: a known name or a YAML file");
            add("set", manyValues("KEY=VALUE"), "set a parameter of the planner; repeatable");
            add("space", oneValue("NAME"), "reeds_shepp (default), dubins or se2 (default for the grid models)");
            add("footprint", oneValue("NAME"),
                "rectangle: the body of the car, also one with an outline (default); or circle (default for the grid "
                "models)");
            add("circle-radius", oneValue("M"), "radius in metres; default: half of the car's width");
            add("time-limit", oneValue("S"), "limit in seconds for each run (default 5)");
            add("runs", oneValue("N"),
                "plan N times with seeds seed, seed + 1, ... (default 1); report the path of the first run");
            add("seed", oneValue("N"), "seed of the random numbers (default 1)");
            add("trajectory", "optimise the path in time: the fastest trajectory near it");
            add("track",
                "drive with the model predictive controller: the trajectory, or without --trajectory the path, "
                "stopping at each jump of its curvature");
            add("perceive", oneValue("RANGE[,RATE]"),
                "with --track: the car knows only what a sensor of this range in metres has seen, with RATE frames "
                "per second (default 20), and plans on the way");
            add("json", oneValue("FILE|-"), "write the result; - for standard output");
            add("svg", oneValue("FILE"), "draw the result");
            add("csv", oneValue("FILE"), "with --trajectory: write it as a table t,x,y,yaw,v,a,steering,steering_rate");
            add("html", oneValue("FILE"), "with --track: write a page that shows the drive");
            add("plugin", manyValues("LIB.so"), "load planners from a library");
            add("help", "print this text");
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
            return result;  // with the plug-ins, whose planners --help lists
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
        if (const auto sensor = line.text("perceive"))
            result.perceive = sensorOf("--perceive", *sensor);
        result.json = line.outputFile("json").value_or("");
        result.svg = line.outputFile("svg").value_or("");
        result.html = line.outputFile("html").value_or("");
        result.csv = line.outputFile("csv").value_or("");
        if (line.given("csv") && !result.trajectory)
            throw Error("--csv writes the trajectory: it requires --trajectory");
        if (result.perceive && !result.track)
            throw Error("--perceive is about the drive: it requires --track");
        if (result.perceive && result.planner != "improved_astar")
            throw Error("--perceive plans on the way with improved_astar, not with " + inQuotes(result.planner));
        if (line.given("html") && !result.track)
            throw Error("--html shows the drive: it requires --track");
        return result;
    }

    std::string planHelp(const PlannerRegistry &registry)
    {
        std::ostringstream text;
        text << "usage: parking_plan SCENARIO [options]\n\n"
                "Plans a parking path in a YAML scenario or a TPCAP case, checks it again and reports it.\n"
                "parking_convert converts scenarios of other formats (docs/scenarios.md).\n\n"
                "Examples, run at the root of the project:\n"
                "  parking_plan benchmarks/scenarios/narrow_parallel.yaml --svg path.svg\n"
                "  parking_plan benchmarks/scenarios/parallel.yaml --trajectory --track --html drive.html\n"
                "  parking_plan benchmarks/scenarios/parallel.yaml --track --perceive 20 --html drive.html\n\n"
             << describe() << "\nPlanners:\n";
        for (const PlannerEntry &each : registry.entries())
            text << "  " << each.name << std::string(each.name.size() < 20 ? 22 - each.name.size() : 2, ' ')
                 << each.summary << "\n";
        text << '\n'
             << wrapped("Vehicles:", vehicleNames())
             << "\n"
                "Status: 0 exact solution, 3 approximate solution only, 4 no solution, or no content for\n"
                "--csv or --html, 2 invalid input or usage\n";
        return text.str();
    }
}  // namespace parking
