#include "benchmarks/config/Experiment.h"

#include "benchmarks/planners/PlannerRegistry.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <ompl/base/samplers/BridgeTestValidStateSampler.h>
#include <ompl/base/samplers/GaussianValidStateSampler.h>
#include <ompl/base/samplers/MaximizeClearanceValidStateSampler.h>
#include <ompl/base/samplers/ObstacleBasedValidStateSampler.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

#include <fnmatch.h>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        /** FNV-1a, 64 bits: the same on every machine and for every version of the library. */
        std::uint64_t hash(const std::string &text, std::uint64_t start = 0xcbf29ce484222325ULL)
        {
            for (const char c : text)
                start = (start ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
            // FNV mixes its upper bits badly for short texts.
            start ^= start >> 33;
            start *= 0xff51afd7ed558ccdULL;
            start ^= start >> 33;
            return start;
        }

        std::string hexadecimal(std::uint64_t value)
        {
            std::string text;
            for (int shift = 60; shift >= 0; shift -= 4)
                text += "0123456789abcdef"[(value >> shift) & 15U];
            return text;
        }

        void describe(std::string &text, const Pose &pose)
        {
            text += formatNumber(pose.x) + "," + formatNumber(pose.y) + "," + formatNumber(pose.yaw) + ";";
        }

        std::string digestOf(const Scenario &scenario)
        {
            std::string text;
            const Vehicle &car = scenario.vehicle;
            for (const double value :
                 {car.wheelbase, car.frontOverhang, car.rearOverhang, car.width, car.maxSteeringAngle, car.maxSpeed,
                  car.maxAcceleration, car.maxSteeringRate, scenario.worldOffset.x(), scenario.worldOffset.y()})
                text += formatNumber(value) + ",";
            for (const Eigen::Vector2d &corner : car.outline)
                text += "o" + formatNumber(corner.x()) + "," + formatNumber(corner.y()) + ",";
            describe(text, scenario.start);
            for (const Pose &goal : scenario.goals)
                describe(text, goal);
            for (const Polygon &polygon : scenario.polygons)
            {
                text += "p";
                for (const Eigen::Vector2d &corner : polygon)
                    text += formatNumber(corner.x()) + "," + formatNumber(corner.y()) + ",";
            }
            if (scenario.grid)
            {
                text += std::to_string(scenario.grid->width()) + "x" + formatNumber(scenario.grid->resolution()) +
                        (scenario.unknownIsOccupied ? "u" : "f");
                describe(text, scenario.grid->origin());
                for (const Cell cell : scenario.grid->cells())
                    text += static_cast<char>('0' + static_cast<int>(cell));
            }
            return hexadecimal(hash(text));
        }

        std::string describe(const ProblemOptions &options)
        {
            std::string text = options.vehicle + "/" + toString(options.settings.space) + "/" +
                               toString(options.settings.footprint) + "/" +
                               formatNumber(options.settings.circleRadius) + "/" +
                               formatNumber(options.settings.threshold) + "/" + options.sampler + "/";
            if (options.settings.objective != ObjectiveKind::Unset)
                text += toString(options.settings.objective) + "/";
            if (options.turningRadius)
                text += "r" + formatNumber(*options.turningRadius) + "/";
            for (const std::optional<double> &bound : {options.minX, options.minY, options.maxX, options.maxY})
                text += (bound ? formatNumber(*bound) : "") + ",";
            for (const std::optional<Pose> &pose : {options.start, options.goal})
                describe(text, pose.value_or(Pose{NAN, NAN, NAN}));
            return text;
        }

        std::string word(const std::string &name)
        {
            std::string result;
            for (const char c : name)
                result +=
                    std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("_.+-").find(c) != std::string::npos
                        ? c
                        : '_';
            return result.empty() || result.front() == '.' ? "scenario" + result : result;
        }

        Scenario readWithOptions(const std::string &file, const ProblemOptions &options)
        {
            Scenario scenario = readScenario(file, {options.vehicle, options.start, options.goal});
            if (options.turningRadius)
            {
                scenario.vehicle.maxSteeringAngle = scenario.vehicle.steeringAngle(1.0 / *options.turningRadius);
                scenario.vehicle.validate();
            }
            return scenario;
        }

        Scenario readFor(const BenchmarkConfig &config, const std::string &file, const ProblemOptions &options)
        {
            try
            {
                return readWithOptions(file, options);
            }
            catch (const Error &error)
            {
                throw Error(config.lineOf(file) + error.what());
            }
        }

        /** Name of experiments with this scenario, also matched by `only`. */
        std::string nameOf(const BenchmarkConfig &config, const std::string &file)
        {
            const ProblemOptions &common = config.planners.front().problem;
            return word(common.name.empty() ? readFor(config, file, common).name : common.name);
        }

        void setBounds(const Problem &problem, const ProblemOptions &options)
        {
            auto *space = problem.spaceInformation()->getStateSpace()->as<ob::SE2StateSpace>();
            ob::RealVectorBounds bounds = space->getBounds();
            const Eigen::Vector2d &offset = problem.scenario().worldOffset;
            const auto limit = [](double &bound, const std::optional<double> &given, double shift, bool low)
            {
                if (given)
                    bound = low ? std::max(bound, *given - shift) : std::min(bound, *given - shift);
            };
            limit(bounds.low[0], options.minX, offset.x(), true);
            limit(bounds.low[1], options.minY, offset.y(), true);
            limit(bounds.high[0], options.maxX, offset.x(), false);
            limit(bounds.high[1], options.maxY, offset.y(), false);
            for (const unsigned axis : {0U, 1U})
                if (!(bounds.low[axis] < bounds.high[axis]))
                {
                    const std::string name(1, "xy"[axis]);
                    const Box &world = problem.scenario().bounds;
                    throw SettingError({"problem.volume.min." + name, "problem.volume.max." + name},
                                       "the volume does not overlap the scenario's world, whose " + name +
                                           " ranges between " + formatNumber(world.min[axis] + offset[axis]) + " and " +
                                           formatNumber(world.max[axis] + offset[axis]));
                }
            space->setBounds(bounds);
        }

        template <class Sampler>
        ob::ValidStateSamplerPtr makeSampler(const ob::SpaceInformation *si)
        {
            return std::make_shared<Sampler>(si);
        }

        void setSampler(const Problem &problem, const std::string &name)
        {
            const ob::SpaceInformationPtr &si = problem.spaceInformation();
            if (name == "gaussian")
                si->setValidStateSamplerAllocator(makeSampler<ob::GaussianValidStateSampler>);
            else if (name == "obstacle_based")
                si->setValidStateSamplerAllocator(makeSampler<ob::ObstacleBasedValidStateSampler>);
            else if (name == "bridge_test")
                si->setValidStateSamplerAllocator(makeSampler<ob::BridgeTestValidStateSampler>);
            else if (name == "max_clearance")
                si->setValidStateSamplerAllocator(makeSampler<ob::MaximizeClearanceValidStateSampler>);
        }

        bool matches(const std::string &pattern, const std::string &scenario)
        {
            return fnmatch(pattern.c_str(), scenario.c_str(), 0) == 0;
        }

        /** Whether the planner runs on the scenario of this name. Records the patterns that matched. */
        bool isWanted(const PlannerSpec &spec, const std::string &scenario, std::set<std::string> &used)
        {
            bool wanted = spec.only.empty();
            for (const std::string &pattern : spec.only)
                if (matches(pattern, scenario))
                {
                    used.insert(pattern);
                    wanted = true;
                }
            return wanted;
        }

        /** Part of a name that distinguishes a setting from the common one. */
        std::string suffixOf(const ProblemOptions &options, const ProblemOptions &common)
        {
            std::string suffix;
            if (options.settings.space != common.settings.space)
                suffix += "_" + toString(options.settings.space);
            if (options.settings.footprint != common.settings.footprint ||
                options.settings.circleRadius != common.settings.circleRadius)
                suffix += "_" + toString(options.settings.footprint);
            if (options.settings.objective != common.settings.objective)
                suffix += "_" + toString(options.settings.objective);
            if (options.vehicle != common.vehicle)
                suffix += "_" + options.vehicle;
            return suffix.empty() ? "_variant" : suffix;
        }
    }  // namespace

    Scenario Experiment::scenario() const
    {
        return readWithOptions(scenarioFile, options);
    }

    std::unique_ptr<Problem> Experiment::load() const
    {
        try
        {
            auto problem = std::make_unique<Problem>(readWithOptions(scenarioFile, options), options.settings);
            setBounds(*problem, options);
            setSampler(*problem, options.sampler);
            problem->spaceInformation()->setup();
            return problem;
        }
        catch (const SettingError &error)
        {
            throw SettingError(error.settings(), scenarioFile + ": " + error.what());
        }
        catch (const Error &error)
        {
            const std::string text = error.what();
            throw Error(text.find(scenarioFile) == std::string::npos ? scenarioFile + ": " + text : text);
        }
    }

    std::vector<std::string> leaveOutPlannersOf(const std::vector<std::string> &replaced, BenchmarkConfig &config)
    {
        const auto isBound = [](const PlannerSpec &spec)
        {
            return !spec.only.empty();
        };
        if (std::none_of(config.planners.begin(), config.planners.end(), isBound))
            return {};  // no file needs to be read for its name
        std::vector<std::string> before, now;
        for (const std::string &file : replaced)
            try
            {
                before.push_back(nameOf(config, file));
            }
            catch (const Error &)
            {
                before.push_back(word(std::filesystem::path(file).stem().string()));  // unreadable files do not matter
            }
        for (const std::string &file : config.scenarios)
            now.push_back(nameOf(config, file));
        const auto names = [](const std::string &pattern, const std::vector<std::string> &scenarios)
        {
            return std::any_of(scenarios.begin(), scenarios.end(),
                               [&pattern](const std::string &each) { return matches(pattern, each); });
        };
        std::vector<PlannerSpec> kept;
        std::vector<std::string> out;
        for (PlannerSpec spec : config.planners)
        {
            const auto isOfThose = [&](const std::string &pattern)
            {
                return names(pattern, before) && !names(pattern, now);
            };
            spec.only.erase(std::remove_if(spec.only.begin(), spec.only.end(), isOfThose), spec.only.end());
            if (spec.only.empty() && isBound(config.planners[kept.size() + out.size()]))
                out.push_back(spec.name);
            else
                kept.push_back(std::move(spec));
        }
        if (kept.empty())
            return {};  // No planner is left: planExperiments() reports the reason.
        config.planners = std::move(kept);
        return out;
    }

    std::vector<Experiment> planExperiments(const BenchmarkConfig &config)
    {
        const auto world = config.problemLines.find("problem.world");
        if (config.scenarios.empty() && world != config.problemLines.end())
        {
            const std::filesystem::path file = config.file;
            throw Error(world->second + "the meshes of OMPL.app must be converted: parking_convert " + file.string() +
                        " " + std::filesystem::path(file).replace_extension(".yaml").string());
        }
        if (config.scenarios.empty())
            throw Error(config.file + ": no scenario; [problem] must name one, for example 'scenario = garage.yaml'");
        std::vector<Experiment> experiments;
        std::vector<std::string> names, scenarios;
        std::set<std::string> used;
        for (const std::string &file : config.scenarios)
        {
            const ProblemOptions &common = config.planners.front().problem;
            if (!common.name.empty() && config.scenarios.size() > 1)
                throw Error(config.lineOf(config.planners.front(), {"problem.name"}) +
                            "'name' in [problem] requires a single scenario, but there are " +
                            std::to_string(config.scenarios.size()));
            const std::string base = nameOf(config, file);
            scenarios.push_back(base);
            std::vector<Experiment> variants;
            for (std::size_t i = 0; i < config.planners.size(); ++i)
            {
                if (!isWanted(config.planners[i], base, used))
                    continue;
                const ProblemOptions &options = config.planners[i].problem;
                const std::string text = describe(options);
                const auto known =
                    std::find_if(variants.begin(), variants.end(),
                                 [&text](const Experiment &each) { return describe(each.options) == text; });
                if (known != variants.end())
                {
                    known->planners.push_back(i);
                    continue;
                }
                const std::string wanted = base + (text == describe(common) ? "" : word(suffixOf(options, common)));
                std::string name = wanted;
                for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number)
                    name = wanted + "_" + std::to_string(number);
                names.push_back(name);
                const Scenario scenario = readFor(config, file, options);
                variants.push_back({name, file, options, {i}, digestOf(scenario), scenario.files});
            }
            experiments.insert(experiments.end(), variants.begin(), variants.end());
        }
        for (const PlannerSpec &spec : config.planners)
            for (const std::string &pattern : spec.only)
                if (used.count(pattern) == 0)
                    throw Error(config.lineOf(spec, {"only"}) + "planner " + spec.name + ": " +
                                unknownName("scenario in 'only'", pattern, scenarios));
        return experiments;
    }

    std::string fingerprint(const BenchmarkConfig &config)
    {
        return hexadecimal(hash(
            formatNumber(config.timeLimit) + "/" + formatNumber(config.memoryLimit) + "/" +
            std::to_string(config.seed) + (config.simplify ? "/s" : "/") + (config.track ? "/t" : "/") +
            (config.processorTime ? "p" : "") + (config.trajectory ? "q" : "") +
            (config.perceive ? "v" + formatNumber(config.perceive->range) + "," + formatNumber(config.perceive->rate)
                             : "")));
    }

    std::string fingerprint(const BenchmarkConfig &config, const Experiment &experiment, const PlannerSpec &planner)
    {
        std::string text = fingerprint(config) + "\n" + experiment.name + "/" + experiment.digest + "/" +
                           describe(experiment.options) + "\n" + planner.name + "/" + planner.planner;
        for (const auto &[name, value] : planner.settings)
            text += "/" + name + "=" + value;
        return hexadecimal(hash(text));
    }

    std::string fileDigest(const std::string &file)
    {
        std::ifstream stream(file, std::ios::binary);
        if (!stream)
            return "";
        std::ostringstream text;
        text << stream.rdbuf();
        return hexadecimal(hash(text.str()));
    }

    std::uint32_t seedOf(const BenchmarkConfig &config, const std::vector<Experiment> &experiments, const Unit &unit)
    {
        const std::string key = std::to_string(config.seed) + "/" + experiments[unit.experiment].name + "/" +
                                config.planners[unit.planner].name + "/" + std::to_string(unit.run);
        const auto seed = static_cast<std::uint32_t>(hash(key) >> 32);
        return seed == 0 ? 1 : seed;
    }

    std::vector<Unit> planUnits(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                std::size_t shard, std::size_t shards)
    {
        std::vector<Unit> units;
        for (std::size_t run = 0; run < config.runCount; ++run)
            for (std::size_t experiment = 0; experiment < experiments.size(); ++experiment)
            {
                std::vector<Unit> round;
                for (const std::size_t planner : experiments[experiment].planners)
                    round.push_back({experiment, planner, run});
                std::sort(round.begin(), round.end(),
                          [&](const Unit &a, const Unit &b)
                          { return seedOf(config, experiments, a) < seedOf(config, experiments, b); });
                units.insert(units.end(), round.begin(), round.end());
            }
        if (shards == 1)
            return units;
        // Shuffled, then dealt out in turn, so that every shard gets its share of slow planners and problems.
        std::vector<std::size_t> order(units.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        const auto key = [&](std::size_t index)
        {
            return hash("shard", seedOf(config, experiments, units[index]) + 1ULL);
        };
        std::stable_sort(order.begin(), order.end(), [&key](std::size_t a, std::size_t b) { return key(a) < key(b); });
        std::vector<bool> mine(units.size(), false);
        for (std::size_t i = shard; i < order.size(); i += shards)
            mine[order[i]] = true;
        std::vector<Unit> selected;
        for (std::size_t i = 0; i < units.size(); ++i)
            if (mine[i])
                selected.push_back(units[i]);
        return selected;
    }
}  // namespace parking
