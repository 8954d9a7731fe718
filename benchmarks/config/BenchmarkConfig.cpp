#include "benchmarks/config/BenchmarkConfig.h"

#include "benchmarks/config/ConfigChecks.h"
#include "benchmarks/config/ConfigLines.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

#include <glob.h>

namespace fs = std::filesystem;

namespace parking
{
    namespace
    {
        const std::vector<std::string> PROBLEM_KEYS{
            "scenario",     "name",         "vehicle",   "space",     "footprint",  "circle_radius", "start.x",
            "start.y",      "start.theta",  "goal.x",    "goal.y",    "goal.theta", "volume.min.x",  "volume.min.y",
            "volume.max.x", "volume.max.y", "objective", "threshold", "sampler"};
        const std::vector<std::string> BENCHMARK_KEYS{"time_limit", "mem_limit", "run_count", "output",
                                                      "save_paths", "seed",      "simplify",  "track",
                                                      "trajectory", "clock"};
        const std::vector<std::string> SAMPLERS{"uniform", "gaussian", "obstacle_based", "bridge_test"};

        double finiteNumber(const std::string &name, const std::string &text)
        {
            double value = 0.0;
            if (!parseNumber(text, value))
                throw Error(name + " must be a number, not " + inQuotes(text));
            return value;
        }

        bool switchNamed(const std::string &name, const std::string &text)
        {
            for (const char *word : {"1", "true", "yes", "on"})
                if (text == word)
                    return true;
            for (const char *word : {"0", "false", "no", "off"})
                if (text == word)
                    return false;
            throw Error(name + " must be true or false, not " + inQuotes(text));
        }

        std::string choiceNamed(const std::string &name, const std::string &text, const std::vector<std::string> &known)
        {
            if (std::find(known.begin(), known.end(), text) == known.end())
                throw Error(unknownName("value for " + name, text, known));
            return text;
        }

        /** Names or patterns of scenarios, separated by commas or blanks. */
        std::vector<std::string> patternsNamed(const std::string &name, const std::string &text)
        {
            std::string separated = text;
            std::replace(separated.begin(), separated.end(), ',', ' ');
            std::istringstream words(separated);
            std::vector<std::string> patterns;
            for (std::string word; words >> word;)
                patterns.push_back(word);
            if (patterns.empty())
                throw Error(name + " must name scenarios, for example 'garage, street*'");
            return patterns;
        }

        void setBenchmarkOption(BenchmarkConfig &config, const std::string &key, const std::string &value)
        {
            if (key == "time_limit")
                config.timeLimit = positiveNumber(key, value, LONGEST_RUN);
            else if (key == "mem_limit")
                config.memoryLimit = positiveNumber(key, value);
            else if (key == "run_count")
                config.runCount = wholeNumber(key, value, 1, 1000000);
            else if (key == "output")
                config.output = value;
            else if (key == "save_paths")
            {
                choiceNamed(key, value, {"none", "shortest", "all"});
                config.savePaths = value == "all"        ? SavePaths::All
                                   : value == "shortest" ? SavePaths::Shortest
                                                         : SavePaths::None;
            }
            else if (key == "seed")
                config.seed = wholeNumber(key, value, 1, std::numeric_limits<std::uint32_t>::max());
            else if (key == "simplify")
                config.simplify = switchNamed(key, value);
            else if (key == "clock")
            {
                if (value != "wall" && value != "processor")
                    throw Error(unknownName("clock", value, {"wall", "processor"}));
                config.processorTime = value == "processor";
            }
            else if (key == "track")
                config.track = switchNamed(key, value);
            else if (key == "trajectory")
                config.trajectory = switchNamed(key, value);
            else
                throw Error(unknownName("key of [benchmark]", key, BENCHMARK_KEYS));
        }

        std::string uniqueName(const BenchmarkConfig &config, const std::string &wanted, std::size_t self)
        {
            std::string name = wanted;
            for (int number = 2;; ++number)
            {
                bool taken = false;
                for (std::size_t i = 0; i < config.planners.size(); ++i)
                    taken = taken || (i != self && config.planners[i].name == name);
                if (!taken)
                    return name;
                name = wanted + "_" + std::to_string(number);
            }
        }

        void checkName(const std::string &name)
        {
            // Names become parts of file names, and single words in OMPL's logs.
            if (name.empty() || name.front() == '.' ||
                !std::all_of(name.begin(), name.end(),
                             [](unsigned char c) {
                                 return std::isalnum(c) != 0 ||
                                        std::string("_.+-*").find(static_cast<char>(c)) != std::string::npos;
                             }))
                throw Error("a name must consist of letters, digits and _ . + - *, and " + inQuotes(name) +
                            " does not");
        }

        /** One line of [planner]: `rrt=` adds an instance, `rrt.range=1` sets a parameter of the latest one. */
        void setPlannerOption(BenchmarkConfig &config, const ProblemOptions &base, const PlannerRegistry &registry,
                              const ConfigLine &line)
        {
            const auto &[section, key, value, where] = line;
            const std::size_t dot = key.find('.');
            const PlannerEntry &entry = registry.find(key.substr(0, dot));
            if (dot == std::string::npos)
            {
                if (!value.empty())
                    throw Error("nothing may follow '" + key + "=', which adds a planner; a parameter is set by '" +
                                key + ".parameter=value'");
                config.planners.push_back({entry.name, entry.name, {}, base, {}, {{"", where}}});
                config.planners.back().name = uniqueName(config, entry.name, config.planners.size() - 1);
                return;
            }
            const std::string parameter = key.substr(dot + 1);
            if (config.planners.empty() || config.planners.back().planner != entry.name)
                throw Error("'" + key + "' sets a parameter of a planner that is not the last one added; put '" +
                            key.substr(0, dot) + "=' before it");
            if (parameter.empty())
                throw Error("'" + key + "' names no parameter; one is set by '" + entry.name + ".parameter=value'");
            PlannerSpec &spec = config.planners.back();
            line.noteOnce(spec.lines, parameter);
            if (parameter == "name")
            {
                checkName(value);
                spec.name = value;
                if (uniqueName(config, value, config.planners.size() - 1) != value)
                    throw Error("there is already a planner called " + inQuotes(value));
            }
            else if (parameter == "only")
                spec.only = patternsNamed(key, value);
            else if (parameter == "problem.scenario" || parameter == "problem.name")
                throw Error("the scenario cannot be changed for one planner only; '" + key.substr(0, dot) +
                            ".only' says on which of them it is run");
            else if (parameter.compare(0, 8, "problem.") == 0)
                setProblemOption(spec.problem, parameter.substr(8), value);
            else
                spec.settings.emplace_back(parameter, value);
        }

        /** What a comparison reads once for each experiment and again for the pictures cannot come through a pipe. */
        void refusePipe(const std::string &file)
        {
            std::error_code ignored;
            if (fs::is_fifo(file, ignored) || fs::is_socket(file, ignored))
                throw Error(file + ": is a pipe; a comparison reads it more than once, so that it must be a file");
        }

        /** Maps and vehicles are YAML files too: a scenario is one that has a start. */
        bool isScenario(const fs::path &file)
        {
            if (file.extension() == ".csv")
                return true;
            if (file.extension() != ".yaml" && file.extension() != ".yml")
                return false;
            std::istringstream text(readFile(file.string(), std::size_t(16) << 20));
            for (std::string line; std::getline(text, line);)
                if (line.compare(0, 6, "start:") == 0)
                    return true;
            return false;
        }

        std::vector<std::string> matches(const std::string &pattern)
        {
            glob_t found{};
            std::vector<std::string> files;
            if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
                for (std::size_t i = 0; i < found.gl_pathc; ++i)
                    files.emplace_back(found.gl_pathv[i]);
            globfree(&found);
            return files;
        }

        /** case2 before case10. */
        bool naturallyBefore(const std::string &a, const std::string &b)
        {
            std::size_t i = 0, j = 0;
            const auto digit = [](char c)
            {
                return std::isdigit(static_cast<unsigned char>(c)) != 0;
            };
            while (i < a.size() && j < b.size())
            {
                if (!digit(a[i]) || !digit(b[j]))
                {
                    if (a[i] != b[j])
                        return a[i] < b[j];
                    ++i;
                    ++j;
                    continue;
                }
                const auto skip = [&digit](const std::string &text, std::size_t &at)
                {
                    while (at < text.size() && text[at] == '0')
                        ++at;
                    const std::size_t begin = at;
                    while (at < text.size() && digit(text[at]))
                        ++at;
                    return text.substr(begin, at - begin);
                };
                const std::string first = skip(a, i), second = skip(b, j);
                if (first != second)
                    return std::make_tuple(first.size(), first) < std::make_tuple(second.size(), second);
            }
            return a.size() - i < b.size() - j;
        }
    }  // namespace

    bool ProblemOptions::operator==(const ProblemOptions &other) const
    {
        const auto poses = [](const std::optional<Pose> &a, const std::optional<Pose> &b)
        {
            return a.has_value() == b.has_value() && (!a || (a->x == b->x && a->y == b->y && a->yaw == b->yaw));
        };
        return name == other.name && vehicle == other.vehicle && settings.space == other.settings.space &&
               settings.footprint == other.settings.footprint && settings.circleRadius == other.settings.circleRadius &&
               poses(start, other.start) && poses(goal, other.goal) && minX == other.minX && minY == other.minY &&
               maxX == other.maxX && maxY == other.maxY && settings.threshold == other.settings.threshold &&
               sampler == other.sampler;
    }

    std::string BenchmarkConfig::lineOf(const PlannerSpec &planner, const std::vector<std::string> &keys) const
    {
        for (const auto *lines : {&planner.lines, &problemLines})
            for (const std::string &key : keys)
                if (const auto line = lines->find(key); line != lines->end())
                    return line->second;
        const auto added = planner.lines.find("");
        return added == planner.lines.end() ? file + ": " : added->second;
    }

    void setProblemOption(ProblemOptions &options, const std::string &key, const std::string &value)
    {
        const auto part = [&](std::optional<Pose> &pose)
        {
            if (!pose)
                pose.emplace(Pose{NAN, NAN, NAN});
            (key.back() == 'x' ? pose->x : key.back() == 'y' ? pose->y : pose->yaw) = finiteNumber(key, value);
        };
        if (key == "name")
        {
            checkName(value);
            options.name = value;
        }
        else if (key == "vehicle")
        {
            refusePipe(value);
            if (!value.empty())
                readVehicle(value);  // so that one that is not known is found here, where its line is
            options.vehicle = value;
        }
        else if (key == "space")
            options.settings.space = spaceByName(value);
        else if (key == "footprint")
            options.settings.footprint = footprintByName(value);
        else if (key == "circle_radius")
            options.settings.circleRadius = positiveNumber(key, value);
        else if (key == "start.x" || key == "start.y" || key == "start.theta")
            part(options.start);
        else if (key == "goal.x" || key == "goal.y" || key == "goal.theta")
            part(options.goal);
        else if (key == "volume.min.x")
            options.minX = finiteNumber(key, value);
        else if (key == "volume.min.y")
            options.minY = finiteNumber(key, value);
        else if (key == "volume.max.x")
            options.maxX = finiteNumber(key, value);
        else if (key == "volume.max.y")
            options.maxY = finiteNumber(key, value);
        else if (key == "objective")
            choiceNamed(key, value, {"length"});
        else if (key == "threshold")
            options.settings.threshold = positiveNumber(key, value);
        else if (key == "sampler")
            options.sampler = choiceNamed(key, value, SAMPLERS);
        else
            throw Error(unknownName("key of [problem]", key, PROBLEM_KEYS));
    }

    std::vector<std::string> findScenarios(const std::string &name, const std::string &folder)
    {
        if (trimmed(name).empty())
            throw Error("the name of a scenario is empty; name a file, a folder or a pattern");
        const fs::path path = fs::path(name).is_absolute() || folder.empty() ? fs::path(name) : fs::path(folder) / name;
        std::error_code ignored;
        std::vector<std::string> files;
        if (fs::is_directory(path, ignored))
            for (const std::string &each : matches((path / "*").string()))
            {
                if (fs::is_regular_file(each, ignored) && isScenario(each))
                    files.push_back(each);
            }
        else if (name.find_first_of("*?") != std::string::npos)
            for (const std::string &each : matches(path.string()))
            {
                if (fs::is_regular_file(each, ignored) && isScenario(each))
                    files.push_back(each);
            }
        else
        {
            refusePipe(path.string());
            return {path.string()};
        }
        if (files.empty())
            throw Error(inQuotes(path.string()) + ": no scenario there (.yaml files with a start, or .csv files)");
        std::sort(files.begin(), files.end(), naturallyBefore);
        return files;
    }

    void selectPlanners(BenchmarkConfig &config, const std::vector<std::string> &names)
    {
        std::vector<std::string> known;
        for (const PlannerSpec &spec : config.planners)
            known.push_back(spec.name);
        for (const std::string &name : names)
            if (std::find(known.begin(), known.end(), name) == known.end())
                throw Error(unknownName("planner of " + config.file, name, known));
        std::vector<PlannerSpec> selected;
        for (PlannerSpec &spec : config.planners)
            if (std::find(names.begin(), names.end(), spec.name) != names.end())
                selected.push_back(std::move(spec));
        config.planners = std::move(selected);
    }

    BenchmarkConfig readBenchmarkConfig(const std::string &file, const PlannerRegistry &registry)
    {
        const std::vector<ConfigLine> lines = readConfigLines(file);
        BenchmarkConfig config;
        config.file = file;
        ProblemOptions base;
        std::map<std::string, std::string> benchmarkLines;
        const std::string folder = fs::path(file).parent_path().string();
        // Planners last, whatever the order of the sections: they start from the problem of all.
        for (const bool planners : {false, true})
            for (const ConfigLine &line : lines)
            {
                if ((line.section == "planner") != planners)
                    continue;
                try
                {
                    if (line.section == "problem" && line.key == "scenario")
                    {
                        const std::vector<std::string> found = findScenarios(line.value, folder);
                        config.scenarios.insert(config.scenarios.end(), found.begin(), found.end());
                        for (const std::string &each : found)
                            config.scenarioLines.emplace(each, line.where);
                    }
                    else if (line.section == "problem")
                    {
                        setProblemOption(base, line.key, line.value);
                        line.noteOnce(config.problemLines, "problem." + line.key);
                    }
                    else if (line.section == "benchmark")
                    {
                        setBenchmarkOption(config, line.key, line.value);
                        line.noteOnce(benchmarkLines, line.key);
                    }
                    else
                        setPlannerOption(config, base, registry, line);
                }
                catch (const Error &error)
                {
                    throw Error(line.where + error.what());
                }
            }
        if (config.planners.empty())
            throw Error(file + ": no planner; [planner] must add at least one, for example 'improved_astar='");
        requireFittingSettings(config);
        return config;
    }
}  // namespace parking
