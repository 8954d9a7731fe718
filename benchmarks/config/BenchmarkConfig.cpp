#include "benchmarks/config/BenchmarkConfig.h"

#include "benchmarks/plan/PerceivedDrive.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>

#include <glob.h>

namespace fs = std::filesystem;

namespace parking
{
    namespace
    {
        constexpr std::size_t CONFIG_LIMIT = std::size_t(1) << 20;  // bytes

        /** A line "key = value" of a .cfg file. */
        struct ConfigLine
        {
            std::string section;  ///< that it is in, without brackets
            std::string key;      ///< text before the first equals sign
            std::string value;    ///< text after the first equals sign
            std::string where;    ///< "FILE:LINE: ", the beginning of messages

            /** Records in \e known that \e name is set here. Throws parking::Error naming both lines when it is set
                already: one of the two values would be ignored. */
            void noteOnce(std::map<std::string, std::string> &known, const std::string &name) const
            {
                const auto [first, isNew] = known.emplace(name, where);
                if (!isNew)
                    throw Error(inQuotes(key) + " is given twice, first at " +
                                first->second.substr(0, first->second.rfind(": ")) + "; leave one of them out");
            }
        };

        std::vector<ConfigLine> readConfigLines(const std::string &file)
        {
            const std::vector<std::string> known{"[problem]", "[benchmark]", "[planner]"};
            std::vector<ConfigLine> lines;
            std::istringstream stream(readFile(file, CONFIG_LIMIT));
            std::string line, section;
            for (std::size_t number = 1; std::getline(stream, line); ++number)
            {
                const std::string where = file + ":" + std::to_string(number) + ": ";
                const std::string_view content = trimmed(std::string_view(line).substr(0, line.find('#')));
                const std::size_t sign = content.find('=');
                if (content.empty())
                    continue;
                if (content.front() == '[')
                {
                    section = std::string(content);
                    if (std::find(known.begin(), known.end(), section) == known.end())
                        throw Error(where + unknownName("section", section, known));
                }
                else if (sign == std::string_view::npos)
                    throw Error(where + "expected 'key = value' or '[section]', not " + inQuotes(content));
                else if (section.empty())
                    throw Error(where + "the key " + inQuotes(content) +
                                " is in no section; expected [problem], [benchmark] or [planner] before it");
                else
                    lines.push_back({section.substr(1, section.size() - 2),
                                     std::string(trimmed(content.substr(0, sign))),
                                     std::string(trimmed(content.substr(sign + 1))), where});
            }
            return lines;
        }

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

        /** A name that becomes part of file names, and a single word in OMPL's logs. */
        std::string checkedName(const std::string &name)
        {
            if (name.empty() || name.front() == '.' ||
                !std::all_of(name.begin(), name.end(),
                             [](unsigned char c) {
                                 return std::isalnum(c) != 0 ||
                                        std::string("_.+-*").find(static_cast<char>(c)) != std::string::npos;
                             }))
                throw Error("a name must consist of letters, digits and _ . + - *, and " + inQuotes(name) +
                            " does not");
            return name;
        }

        /** A comparison reads an input once per experiment and again for the pictures: not possible for a pipe. */
        void refusePipe(const std::string &file)
        {
            std::error_code ignored;
            if (fs::is_fifo(file, ignored) || fs::is_socket(file, ignored))
                throw Error(file + ": is a pipe, which can be read only once; use a file");
        }

        /** Reads a vehicle early, so that an unknown vehicle is reported at its line. */
        std::string knownVehicle(const std::string &name)
        {
            refusePipe(name);
            if (!name.empty())
                readVehicle(name);
            return name;
        }

        SavePaths savePathsNamed(const std::string &key, const std::string &value)
        {
            choiceNamed(key, value, {"none", "shortest", "best", "all"});
            return value == "all" ? SavePaths::All : value == "none" ? SavePaths::None : SavePaths::Shortest;
        }

        /** A space by OMPL.app's name for it. */
        SpaceKind stateSpaceNamed(const std::string &key, const std::string &value)
        {
            if (value == "dubinssymmetric")
                throw Error(key + " = dubinssymmetric has curves that no car can drive; use dubins or reedsshepp");
            return choiceNamed(key, value, {"dubins", "reedsshepp"}) == "dubins" ? SpaceKind::Dubins
                                                                                 : SpaceKind::ReedsShepp;
        }

        bool isKinematicCar(const std::string &key, const std::string &value)
        {
            if (value != "kinematic_car")
                throw Error(key + " = " + value + " has states with more than a pose; the only model is kinematic_car");
            return true;
        }

        bool isProcessorClock(const std::string &key, const std::string &value)
        {
            return choiceNamed(key, value, {"wall", "processor"}) == "processor";
        }

        using Text = const std::string &;

        /** Effect of a key on the options. */
        template <class Options>
        using Setter = std::function<void(Options &, Text key, Text value)>;

        /** Sets a member to the result of \e read for key and value. */
        template <class Options, class Member, class Read>
        Setter<Options> into(Member Options::*member, Read read)
        {
            return [=](Options &options, Text key, Text value)
            {
                options.*member = read(key, value);
            };
        }

        template <class Member, class Read>
        Setter<ProblemOptions> intoSettings(Member ProblemSettings::*member, Read read)
        {
            return [set = into(member, read)](ProblemOptions &options, Text key, Text value)
            {
                set(options.settings, key, value);
            };
        }

        Setter<ProblemOptions> intoPose(std::optional<Pose> ProblemOptions::*member, double Pose::*coordinate)
        {
            return [=](ProblemOptions &options, Text key, Text value)
            {
                std::optional<Pose> &pose = options.*member;
                if (!pose)
                    pose.emplace(Pose{NAN, NAN, NAN});
                (*pose).*coordinate = finiteNumber(key, value);
            };
        }

        /** Adapts a reader whose messages do not name the key. */
        template <class Read>
        auto ofValue(Read read)
        {
            return [read](Text /*key*/, Text value)
            {
                return read(value);
            };
        }

        auto positive(double max = std::numeric_limits<double>::infinity())
        {
            return [max](Text key, Text value)
            {
                return positiveNumber(key, value, max);
            };
        }

        double notNegative(Text key, Text value)
        {
            const double number = finiteNumber(key, value);
            if (number < 0.0)
                throw Error(key + " must not be negative, and " + inQuotes(value) + " is");
            return number;
        }

        /** Accepts OMPL.app's distance at which a goal counts as reached only if it is tiny. */
        void requireExactGoals(Text key, Text value)
        {
            constexpr double EXACT = 1e-4;  // metres: tolerance of the referee at the end of a path
            if (notNegative(key, value) > EXACT)
                throw Error(key +
                            " is OMPL.app's distance at which a goal counts as reached. Goals are reached exactly " +
                            "here, so it must be at most 0.0001. objective.threshold is the length at which anytime " +
                            "planners stop");
        }

        auto whole(std::size_t max)
        {
            return [max](Text key, Text value)
            {
                return wholeNumber(key, value, 1, max);
            };
        }

        auto oneOf(const std::vector<std::string> &known)
        {
            return [known](Text key, Text value)
            {
                return choiceNamed(key, value, known);
            };
        }

        template <class Options>
        using Keys = std::vector<std::pair<std::string, Setter<Options>>>;

        /** Meshes are part of the scenario that parking_convert makes of them. */
        void ofMeshes(ProblemOptions & /*options*/, Text /*key*/, Text /*value*/)
        {
        }

        using Problems = ProblemOptions;
        using Settings = ProblemSettings;
        const Keys<Problems> PROBLEM_KEYS{
            {"scenario", {}},  // for messages: set by readBenchmarkConfig()
            {"name", into(&Problems::name, ofValue(checkedName))},
            {"vehicle", into(&Problems::vehicle, ofValue(knownVehicle))},
            {"turningradius", into(&Problems::turningRadius, positive())},
            {"space", intoSettings(&Settings::space, ofValue(spaceByName))},
            {"statespace", intoSettings(&Settings::space, stateSpaceNamed)},
            {"control", into(&Problems::controls, isKinematicCar)},
            {"world", ofMeshes},
            {"robot", ofMeshes},
            {"footprint", intoSettings(&Settings::footprint, ofValue(footprintByName))},
            {"circle_radius", intoSettings(&Settings::circleRadius, positive())},
            {"start.x", intoPose(&Problems::start, &Pose::x)},
            {"start.y", intoPose(&Problems::start, &Pose::y)},
            {"start.theta", intoPose(&Problems::start, &Pose::yaw)},
            {"goal.x", intoPose(&Problems::goal, &Pose::x)},
            {"goal.y", intoPose(&Problems::goal, &Pose::y)},
            {"goal.theta", intoPose(&Problems::goal, &Pose::yaw)},
            {"volume.min.x", into(&Problems::minX, finiteNumber)},
            {"volume.min.y", into(&Problems::minY, finiteNumber)},
            {"volume.max.x", into(&Problems::maxX, finiteNumber)},
            {"volume.max.y", into(&Problems::maxY, finiteNumber)},
            {"objective", intoSettings(&Settings::objective, ofValue(objectiveByName))},
            {"objective.threshold", intoSettings(&Settings::threshold, notNegative)},
            {"threshold",
             [](Problems &, Text key, Text value)
             {
                 requireExactGoals(key, value);
             }},
            {"sampler", into(&Problems::sampler,
                             oneOf({"uniform", "gaussian", "obstacle_based", "bridge_test", "max_clearance"}))}};

        using Config = BenchmarkConfig;
        const Keys<Config> BENCHMARK_KEYS{
            {"time_limit", into(&Config::timeLimit, positive(LONGEST_RUN))},
            {"mem_limit", into(&Config::memoryLimit, positive())},
            {"run_count", into(&Config::runCount, whole(1000000))},
            {"output", into(&Config::output, ofValue([](Text value) { return value; }))},
            {"save_paths", into(&Config::savePaths, savePathsNamed)},
            {"seed", into(&Config::seed, whole(std::numeric_limits<std::uint32_t>::max()))},
            {"simplify", into(&Config::simplify, switchNamed)},
            {"track", into(&Config::track, switchNamed)},
            {"trajectory", into(&Config::trajectory, switchNamed)},
            {"perceive", into(&Config::perceive, sensorOf)},
            {"clock", into(&Config::processorTime, isProcessorClock)}};

        /** Sentence that names the replacement of a key of OMPL.app's files; empty for other keys. */
        std::string hintFor(const std::string &key)
        {
            const std::pair<const char *, const char *> hints[] = {
                {"solution_length", "the length of every path is in the results; leave it out"},
                {"longest_valid_segment_fraction", "motions are checked as a whole, not step by step; leave it out"},
                {"projection.", "projections are those of OMPL's spaces; leave it out"},
                {"standard_deviation", "samplers have their own parameters; leave it out"},
                {"nr_attempts", "samplers have their own parameters; leave it out"},
                {"nr_improve_attempts", "samplers have their own parameters; leave it out"}};
            for (const auto &[name, hint] : hints)
                if (key == name || (std::string(name).back() == '.' && key.compare(0, std::strlen(name), name) == 0))
                    return hint;
            for (const char *spatial :
                 {"start.z", "start.axis.", "goal.z", "goal.axis.", "volume.min.z", "volume.max.z"})
                if (key.compare(0, std::strlen(spatial), spatial) == 0)
                    return "problems with three dimensions are not supported";
            return "";
        }

        /** \param section name used in the message about an unknown key */
        template <class Options>
        void setByKey(const Keys<Options> &keys, const std::string &section, Options &options, Text key, Text value)
        {
            std::vector<std::string> names;
            for (const auto &[name, set] : keys)
            {
                if (name == key)
                    return set(options, key, value);
                names.push_back(name);
            }
            if (const std::string hint = hintFor(key); !hint.empty())
                throw Error("unknown key of " + section + " " + inQuotes(key) + "; " + hint);
            throw Error(unknownName("key of " + section, key, names));
        }

        /** The name by which the line of a key is known: one for keys that set the same. */
        std::string lineName(const std::string &key)
        {
            return key == "problem.statespace" ? "problem.space" : key;
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

        void addPlanner(BenchmarkConfig &config, const ProblemOptions &base, const PlannerEntry &entry,
                        const std::string &where)
        {
            config.planners.push_back({entry.name, entry.name, {}, base, {}, {{"", where}}});
            config.planners.back().name = uniqueName(config, entry.name, config.planners.size() - 1);
        }

        /** The planner that a line sets a parameter of: the latest one of this name, which is added if there is none.
         */
        PlannerSpec &latest(BenchmarkConfig &config, const ProblemOptions &base, const PlannerEntry &entry,
                            const std::string &where)
        {
            std::vector<PlannerSpec> &all = config.planners;
            const auto found = std::find_if(all.rbegin(), all.rend(),
                                            [&entry](const PlannerSpec &each) { return each.planner == entry.name; });
            if (found != all.rend())
                return *found;
            addPlanner(config, base, entry, where);
            return all.back();
        }

        /** Reads one line of [planner]: `rrt=` adds an instance, `rrt.range=1` sets a parameter of the latest one, and
            `problem.space=se2` changes the problem of the latest planner. */
        void setPlannerOption(BenchmarkConfig &config, const ProblemOptions &base, const PlannerRegistry &registry,
                              const ConfigLine &line)
        {
            const auto &[section, key, value, where] = line;
            const std::size_t dot = key.find('.');
            const bool isOfLatest = dot != std::string::npos && key.compare(0, dot, "problem") == 0;
            if (isOfLatest && config.planners.empty())
                throw Error(inQuotes(key) + " follows no planner; write " + inQuotes(key.substr(dot + 1)) +
                            " in [problem] for all of them");
            const std::string name = isOfLatest ? config.planners.back().planner : key.substr(0, dot);
            const PlannerEntry &entry = base.controls ? registry.findWithControls(name) : registry.find(name);
            if (dot == std::string::npos)
            {
                if (!value.empty())
                    throw Error("no value may follow '" + key + "=', which adds a planner; set a parameter by '" + key +
                                ".parameter=value'");
                return addPlanner(config, base, entry, where);
            }
            const std::string parameter = isOfLatest ? key : key.substr(dot + 1);
            if (parameter.empty())
                throw Error("'" + key + "' has no parameter name; set a parameter by '" + entry.name +
                            ".parameter=value'");
            PlannerSpec &spec = latest(config, base, entry, where);
            line.noteOnce(spec.lines, lineName(parameter));
            if (parameter == "name")
            {
                spec.name = checkedName(value);
                const auto self = static_cast<std::size_t>(&spec - config.planners.data());
                if (uniqueName(config, value, self) != value)
                    throw Error("another planner already has the name " + inQuotes(value));
            }
            else if (parameter == "only")
                spec.only = patternsNamed(key, value);
            else if (parameter == "problem.scenario" || parameter == "problem.name" || parameter == "problem.world" ||
                     parameter == "problem.robot")
                throw Error("one planner cannot have its own scenario; select scenarios by '" + name + ".only'");
            else if (parameter == "problem.control")
                throw Error("control belongs to [problem]; one planner with controls is added by 'control_RRT='");
            else if (parameter.compare(0, 8, "problem.") == 0)
                setByKey(PROBLEM_KEYS, "[problem]", spec.problem, parameter.substr(8), value);
            else
                spec.settings.emplace_back(parameter, value);
        }

        /** Whether a file is a scenario: one with a start, unlike the YAML files of maps and vehicles. */
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

        void requireWholePoses(const BenchmarkConfig &config, const PlannerSpec &spec)
        {
            for (const bool isStart : {true, false})
            {
                const std::optional<Pose> &pose = isStart ? spec.problem.start : spec.problem.goal;
                if (!pose || isFinite(*pose))
                    continue;
                const std::string name = isStart ? "start" : "goal", key = "problem." + name;
                const char *missing = !std::isfinite(pose->x) ? ".x" : !std::isfinite(pose->y) ? ".y" : ".theta";
                throw Error(config.lineOf(spec, {key + ".x", key + ".y", key + ".theta"}) + name +
                            " requires x, y and theta; " + name + missing + " is missing");
            }
        }

        void requireVolume(const BenchmarkConfig &config, const PlannerSpec &spec)
        {
            const ProblemOptions &p = spec.problem;
            const auto require =
                [&](const char *axis, const std::optional<double> &min, const std::optional<double> &max)
            {
                const std::string low = std::string("volume.min.") + axis, high = std::string("volume.max.") + axis;
                if (min && max && !(*min < *max))
                    throw Error(config.lineOf(spec, {"problem." + high, "problem." + low}) + high +
                                " must be greater than " + low + ", " + formatNumber(*min) + ", not " +
                                formatNumber(*max));
            };
            require("x", p.minX, p.maxX);
            require("y", p.minY, p.maxY);
        }

        /** A radius without a circular footprint would be ignored. */
        void requireCircles(const BenchmarkConfig &config)
        {
            const std::string key = "problem.circle_radius";
            const auto isCircle = [](const PlannerSpec &spec)
            {
                return spec.problem.settings.footprint == FootprintKind::Circle;
            };
            const auto refuse = [](const std::string &line)
            {
                throw Error(line + "circle_radius requires footprint = circle; the footprint is a rectangle");
            };
            for (const PlannerSpec &spec : config.planners)
                if (spec.lines.count(key) > 0 && !isCircle(spec))
                    refuse(spec.lines.at(key));
            if (const auto common = config.problemLines.find(key);
                common != config.problemLines.end() &&
                std::none_of(config.planners.begin(), config.planners.end(), isCircle))
                refuse(common->second);
        }

        /** Checks combinations of keys: whether the settings of the problem fit together, for all planners and for
            each. */
        void requireFittingSettings(const BenchmarkConfig &config)
        {
            requireCircles(config);
            for (const PlannerSpec &spec : config.planners)
            {
                requireWholePoses(config, spec);
                requireVolume(config, spec);
                try
                {
                    checkSettings(spec.problem.settings);
                }
                catch (const Error &error)
                {
                    throw Error(config.lineOf(spec, {"problem.footprint", "problem.space"}) + error.what());
                }
            }
        }
    }  // namespace

    std::string BenchmarkConfig::lineOf(const PlannerSpec &planner, const std::vector<std::string> &keys) const
    {
        for (const auto *lines : {&planner.lines, &problemLines})
            for (const std::string &key : keys)
                if (const auto line = lines->find(key); line != lines->end())
                    return line->second;
        const auto added = planner.lines.find("");
        return added == planner.lines.end() ? file + ": " : added->second;
    }

    std::vector<std::string> findScenarios(const std::string &name, const std::string &folder)
    {
        if (trimmed(name).empty())
            throw Error("the name of a scenario is empty; name a file, a folder or a pattern");
        const fs::path path = fs::path(name).is_absolute() || folder.empty() ? fs::path(name) : fs::path(folder) / name;
        std::error_code ignored;
        std::vector<std::string> files;
        const bool isFolder = fs::is_directory(path, ignored);
        if (!isFolder && name.find_first_of("*?") == std::string::npos)
        {
            refusePipe(path.string());
            return {path.string()};
        }
        for (const std::string &each : matches((isFolder ? path / "*" : path).string()))
            if (fs::is_regular_file(each, ignored) && isScenario(each))
                files.push_back(each);
        if (files.empty())
            throw Error(inQuotes(path.string()) + ": no scenario there (.yaml files with a start, or .csv files)");
        // natural order: case2 before case10
        std::sort(files.begin(), files.end(),
                  [](const std::string &a, const std::string &b) { return strverscmp(a.c_str(), b.c_str()) < 0; });
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
        // Planners last in any order of the sections: they start from the common problem.
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
                        setByKey(PROBLEM_KEYS, "[problem]", base, line.key, line.value);
                        line.noteOnce(config.problemLines, lineName("problem." + line.key));
                    }
                    else if (line.section == "benchmark")
                    {
                        setByKey(BENCHMARK_KEYS, "[benchmark]", config, line.key, line.value);
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
        const fs::path converted = fs::path(file).replace_extension(".yaml");
        std::error_code ignored;
        if (config.scenarios.empty() && config.problemLines.count("problem.world") > 0 &&
            fs::is_regular_file(converted, ignored))
            config.scenarios.push_back(converted.string());
        if (config.planners.empty())
            throw Error(file + ": no planner; [planner] must add at least one, for example 'improved_astar='");
        requireFittingSettings(config);
        return config;
    }
}  // namespace parking
