// parking_convert: parking problems and results from one format into another. docs/formats.md says how.

#include "benchmarks/formats/HopeScenes.h"
#include "benchmarks/formats/ResultFormat.h"
#include "benchmarks/formats/ScenarioFormat.h"
#include "benchmarks/system/CommandLine.h"
#include "benchmarks/system/Counted.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/referee/FreeSpace.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace fs = std::filesystem;
namespace po = boost::program_options;

namespace
{
    using namespace parking;

    constexpr int DONE = 0, FAULTY = 1;
    constexpr std::size_t LARGEST = std::size_t(256) << 20;  // bytes of a file
    constexpr double SAME = 1e-6;  // metres and radians between what was read and what was written

    po::options_description describe()
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("to", oneValue("FORMAT"), "of OUTPUT (default: as its name ends; with --hope yaml)");
        add("check", "look at INPUT, and at OUTPUT once it is written; status 1 when something is wrong");
        add("vehicle", oneValue("NAME|FILE"), "the car (default: the file's, or the format's)");
        add("start", oneValue("X,Y,YAW"), "instead of the file's, or where the format says none");
        add("goal", oneValue("X,Y,YAW"), "likewise");
        add("hope", oneValue("LEVEL"), "generate problems of this level of HOPE; OUTPUT is a folder");
        add("count", oneValue("N"), "how many (default 10)");
        add("seed", oneValue("N"), "of the first of them; the others follow (default 1)");
        add("help", "this text");
        return options;
    }

    std::string help()
    {
        std::ostringstream text;
        text << "usage: parking_convert INPUT OUTPUT [options]\n"
                "       parking_convert INPUT --check\n"
                "       parking_convert --hope LEVEL OUTPUT [--count N] [--seed N] [--to FORMAT]\n\n"
                "Converts parking problems between formats, and results of parking_plan --json into those of others. "
                "What\nINPUT is its content tells.\n\n"
             << describe() << "\nFormats of problems, read and written:\n"
             << scenarioFormatLines() << "\nFormats of results, written:\n";
        for (const ResultFormat &format : resultFormats())
            text << "  " << std::left << std::setw(26) << format.name << std::setw(6) << format.extension << format.text
                 << "\n";
        text << "\nLevels of HOPE:";
        for (const std::string &level : hopeLevels())
            text << ' ' << level;
        text << "\n\nExamples:\n"
                "  parking_convert Case7.csv Case7.yaml --check\n"
                "  parking_convert Case07.mat case07.yaml\n"
                "  parking_convert parking1.svg parking1.yaml --start 3,-7.2,0 --goal 4.05,-2.6,1.5708 --check\n"
                "  parking_convert --hope complex hope --count 100 --seed 1\n"
                "  parking_plan case07.yaml --trajectory --json case07.json\n"
                "  parking_convert case07.json Case07.mat --to commonparking-trajectory --check\n\n"
                "Status: 0 done, 1 the check has found something, 2 bad input or usage\n";
        return text.str();
    }

    /** Refuses the options among these that were given although they would change nothing. */
    void requireNone(const CommandLine &line, const std::vector<std::string> &options, const std::string &why)
    {
        for (const std::string &each : options)
            if (line.given(each))
                throw Error("--" + each + " " + why + " (see --help)");
    }

    std::optional<Pose> poseOption(const CommandLine &line, const std::string &name)
    {
        const std::optional<std::string> text = line.text(name);
        if (!text)
            return std::nullopt;
        std::vector<double> numbers;
        std::istringstream fields(*text);
        for (std::string field; std::getline(fields, field, ',');)
        {
            double value = 0.0;
            if (!parseNumber(trimmed(field), value))
                throw Error("--" + name + " must be X,Y,YAW in metres and radians, not " + inQuotes(*text));
            numbers.push_back(value);
        }
        if (numbers.size() != 3)
            throw Error("--" + name + " must be X,Y,YAW in metres and radians, not " + inQuotes(*text));
        return Pose{numbers[0], numbers[1], numbers[2]};
    }

    /** What is wrong with a problem: nothing that a reader would refuse. */
    std::vector<std::string> faultsOf(const Scenario &scenario)
    {
        std::vector<std::string> faults;
        const FreeSpace space(scenario);
        if (!space.isFree(scenario.start))
            faults.emplace_back("the start is in collision");
        bool anyFree = false;
        for (const Pose &goal : scenario.goals)
            anyFree = anyFree || space.isFree(goal);
        if (!anyFree)
            faults.emplace_back("the goal is in collision");
        return faults;
    }

    std::string summaryOf(const Scenario &scenario)
    {
        const auto text = [&scenario](const Pose &local)
        {
            const Pose pose = scenario.toWorld(local);
            return formatNumber(pose.x) + "," + formatNumber(pose.y) + "," + formatNumber(pose.yaw);
        };
        return scenario.name + ": car " + scenario.vehicle.name + ", start " + text(scenario.start) + ", goal " +
               text(scenario.goals.front()) + ", " +
               (scenario.grid ? "a map of " + std::to_string(scenario.grid->width()) + " x " +
                                    std::to_string(scenario.grid->height()) + " cells"
                              : counted(scenario.polygons.size(), "obstacle"));
    }

    int report(const std::string &file, const std::vector<std::string> &faults)
    {
        for (const std::string &fault : faults)
            std::cout << file << ": " << fault << "\n";
        return faults.empty() ? DONE : FAULTY;
    }

    /** Does what was written say what was to be written? */
    std::vector<std::string> differences(const Scenario &written, const Scenario &wanted)
    {
        std::vector<std::string> faults;
        const double size = 1.0 + std::abs(wanted.worldOffset.x()) + std::abs(wanted.worldOffset.y());
        const double tolerance = std::max(SAME, 1e-14 * size);
        const auto same = [&](const Pose &a, const Pose &b)
        {
            return isSamePose(written.toWorld(a), wanted.toWorld(b), tolerance);
        };
        if (!same(written.start, wanted.start))
            faults.emplace_back("the start is not that of the input");
        if (!same(written.goals.front(), wanted.goals.front()))
            faults.emplace_back("the goal is not that of the input");
        const std::vector<Polygon> ours = obstaclePolygons(written), theirs = obstaclePolygons(wanted);
        if (ours.size() != theirs.size())
            faults.push_back(counted(ours.size(), "obstacle") + " instead of " + std::to_string(theirs.size()));
        else
            for (std::size_t i = 0; i < ours.size(); ++i)
                for (const Eigen::Vector2d &corner : theirs[i])
                {
                    double nearest = INFINITY;
                    for (const Eigen::Vector2d &each : ours[i])
                        nearest = std::min(nearest, (each - corner).norm());
                    if (nearest > tolerance)
                    {
                        faults.push_back("obstacle " + std::to_string(i + 1) +
                                         " has lost a corner; is the format for convex ones only?");
                        break;
                    }
                }
        return faults;
    }

    int convertScenario(const std::string &input, const std::string &content, const std::optional<std::string> &output,
                        const CommandLine &line)
    {
        const FormatOptions options{line.name("vehicle").value_or(""), poseOption(line, "start"),
                                    poseOption(line, "goal")};
        const Scenario scenario = parseAnyScenario(input, content, options);
        if (output)
            requireNoInput({*output}, scenario.files);
        const bool check = line.given("check");
        int status = DONE;
        if (check)
        {
            std::cout << summaryOf(scenario) << "\n";
            status = report(input, faultsOf(scenario));
        }
        if (!output)
            return status;
        const std::optional<std::string> to = line.text("to");
        const ScenarioFormat &format = to ? scenarioFormat(*to) : formatForName(*output);
        format.write(scenario, *output);
        if (!check)
            return DONE;
        // The car is not in every format, so it is given again.
        const int written = report(*output, differences(format.read(*output, {options.vehicle, {}, {}}), scenario));
        return std::max(status, written);
    }

    int convertResult(const std::string &input, const std::string &content, const std::optional<std::string> &output,
                      const CommandLine &line)
    {
        requireNone(line, {"start", "goal", "vehicle"}, "changes a problem, and " + inQuotes(input) + " is a result");
        const StoredResult result = parseResult(input, content);
        if (line.given("check"))
            std::cout << input << ": " << result.planner << ", " << result.status << ", path of "
                      << formatNumber(std::round(1e3 * result.path.length()) / 1e3) << " m in "
                      << counted(result.path.stretches().size(), "stretch", "stretches") << ", trajectory of "
                      << counted(result.trajectory.size(), "sample") << "\n";
        if (!output)
            return DONE;
        const std::optional<std::string> to = line.text("to");
        const ResultFormat &format = to ? resultFormat(*to) : resultFormatForName(*output);
        if (format.isTrajectory && result.trajectory.empty())
            throw Error(input + ": the result has no trajectory to write as " + format.name +
                        "; plan with --trajectory or --track");
        format.write(result, *output);
        if (!line.given("check"))
            return DONE;
        const std::string fault = format.check(result, *output);
        return report(*output, fault.empty() ? std::vector<std::string>{} : std::vector<std::string>{fault});
    }

    int generateHope(const std::string &level, const std::string &folder, const CommandLine &line)
    {
        const std::size_t count = line.whole("count", 1, 1000000).value_or(10);
        const std::size_t seed = line.whole("seed", 0, 1000000000).value_or(1);
        const ScenarioFormat &format = scenarioFormat(line.text("to").value_or("yaml"));
        std::error_code failed;
        fs::create_directories(folder, failed);
        if (failed)
            throw Error(inQuotes(folder) + ": cannot be made: " + failed.message());
        int status = DONE;
        for (std::size_t i = 0; i < count; ++i)
        {
            const Scenario scenario = hopeScene(level, seed + i);
            const std::string file = (fs::path(folder) / (scenario.name + format.extension)).string();
            format.write(scenario, file);
            if (line.given("check"))
                status = std::max(status, report(file, faultsOf(format.read(file, {}))));
        }
        std::cout << counted(count, "problem") << ": " << folder << "\n";
        return status;
    }

    int convert(const std::vector<std::string> &arguments)
    {
        po::options_description options = describe();
        options.add_options()("input", manyValues("FILE"));
        po::positional_options_description positional;
        positional.add("input", -1);
        const CommandLine line(arguments, options, positional);
        if (line.given("help"))
        {
            std::cout << help();
            return DONE;
        }
        const std::vector<std::string> files = line.texts("input");
        const std::optional<std::string> level = line.text("hope");
        const std::size_t most = level ? 1 : 2;
        if (files.empty())
            throw Error(level ? "--hope takes the name of a folder to write (see --help)"
                              : "no INPUT given (see --help)");
        if (files.size() > most)
            throw Error(inQuotes(files[most]) + " is one name too many (see --help)");
        if (level)
        {
            requireNone(line, {"start", "goal", "vehicle"}, "changes a file that is read, and --hope reads none");
            return generateHope(*level, files.front(), line);
        }
        requireNone(line, {"count", "seed"}, "goes with --hope only");
        const std::optional<std::string> output =
            files.size() > 1 ? std::optional<std::string>(files[1]) : std::nullopt;
        if (!output && !line.given("check"))
            throw Error("no OUTPUT given, and nothing to --check (see --help)");
        if (!output)
            requireNone(line, {"to"}, "is the format of OUTPUT, and there is none");
        if (output)
            requireOutputs({*output}, {files.front(), line.name("vehicle").value_or(files.front())});
        // Once: a pipe cannot be read again.
        const std::string content = readFile(files.front(), LARGEST);
        return looksLikeResult(content) ? convertResult(files.front(), content, output, line)
                                        : convertScenario(files.front(), content, output, line);
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("parking_convert", argc, argv, convert);
}
