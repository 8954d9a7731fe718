#include "benchmarks/compare/Comparison.h"

#include "benchmarks/compare/UnitRunner.h"
#include "benchmarks/store/OmplLog.h"
#include "benchmarks/summary/ComparisonPictures.h"
#include "benchmarks/summary/ReportScript.h"
#include "benchmarks/summary/Summary.h"
#include "benchmarks/system/CommandLine.h"
#include "benchmarks/system/LongStep.h"
#include "benchmarks/system/Machine.h"
#include "benchmarks/system/Progress.h"
#include "benchmarks/system/Terminal.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <ompl/tools/benchmark/MachineSpecs.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <fnmatch.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace parking
{
    namespace
    {
        void makeFolder(const std::string &folder)
        {
            std::error_code error;
            fs::create_directories(folder, error);
            if (!fs::is_directory(folder))
                throw Error(folder + ": is not a folder and cannot be created" + (error ? ": " + error.message() : ""));
            if (access(folder.c_str(), W_OK) != 0)
                throw Error(folder + ": cannot be written: " + std::strerror(errno));
        }

        /** Removes temporary files of processes that were killed while writing them. */
        void removeRemains(const fs::path &folder)
        {
            std::vector<fs::path> remains;
            std::error_code ignored;
            for (const fs::path &each : {folder, folder / "pictures", folder / "paths"})
                for (const auto &entry : fs::directory_iterator(each, ignored))
                {
                    const std::string name = entry.path().filename().string();
                    if (fnmatch("*.new.??????", name.c_str(), 0) == 0 || fnmatch(".report-*", name.c_str(), 0) == 0)
                        remains.push_back(entry.path());
                }
            for (const fs::path &each : remains)
                fs::remove(each, ignored);
        }

        std::string numberText(double value)
        {
            return std::isfinite(value) ? formatNumber(value) : "";
        }

        std::string pathCsv(const Scenario &scenario, const RunRecord &record)
        {
            std::string text = "x,y,yaw,direction,curvature\n";
            const double sampling = samplingOf(record.path.length(), record.is("densely valid"));
            for (const PathState &state : record.path.sample(sampling))
            {
                const Pose pose = scenario.toWorld(state.pose);
                text += numberText(pose.x) + "," + numberText(pose.y) + "," + numberText(pose.yaw) + "," +
                        std::to_string(state.direction) + "," + numberText(state.curvature) + "\n";
            }
            return text;
        }
    }  // namespace

    Comparison::Comparison(const BenchmarkOptions &options, const PlannerRegistry &registry)
      : options_(options),
        registry_(registry),
        config_(readBenchmarkConfig(options.config, registry))
    {
        config_.timeLimit = options.timeLimit.value_or(config_.timeLimit);
        config_.runCount = options.runCount.value_or(config_.runCount);
        config_.seed = options.seed.value_or(config_.seed);
        std::vector<std::string> replaced;
        if (!options.scenarios.empty())
        {
            replaced.swap(config_.scenarios);
            config_.scenarioLines.clear();
            for (const std::string &name : options.scenarios)
            {
                const std::vector<std::string> found = findScenarios(name, "");
                config_.scenarios.insert(config_.scenarios.end(), found.begin(), found.end());
            }
        }
        if (!options.planners.empty())
            selectPlanners(config_, options.planners);
        folder_ = !options.output.empty()   ? options.output
                  : !config_.output.empty() ? config_.output
                                            : "results-" + fs::path(options.config).stem().string();
        std::optional<LongStep> step;
        if (!options_.quiet)
            step.emplace("reading the scenarios");
        std::string left;
        if (!replaced.empty())
            for (const std::string &name : leaveOutPlannersOf(replaced, config_))
                left += (left.empty() ? "" : ", ") + name;
        experiments_ = planExperiments(config_);
        protectInputs();
        step.reset();
        if (!left.empty())
            std::cerr << "parking_benchmark: " << config_.file << ": not run: 'only' names none of the scenarios of "
                      << "--scenarios: " << left << std::endl;
    }

    void Comparison::protectInputs() const
    {
        const fs::path folder(folder_);
        std::vector<std::string> outputs{database()}, inputs{config_.file};
        for (const char *name :
             {"summary.md", "summary.csv", "report.html", "statistics.json", "standings.csv", "pairs.csv"})
            outputs.push_back((folder / name).string());
        for (const Experiment &experiment : experiments_)
        {
            outputs.push_back((folder / (experiment.name + ".log")).string());
            outputs.push_back((folder / "pictures" / (experiment.name + ".svg")).string());
            inputs.insert(inputs.end(), experiment.files.begin(), experiment.files.end());
        }
        requireNoInput(outputs, inputs);
        // There may be one path per run, too many to inspect individually.
        std::error_code ignored;
        for (const std::string &input : inputs)
            if (config_.savePaths != SavePaths::None &&
                fs::equivalent(fs::absolute(input).parent_path(), folder / "paths", ignored))
                throw Error(inQuotes(input) + " is an input in the folder for paths; choose another --output");
    }

    void Comparison::reportUnsolvable(UnitRunner &runner) const
    {
        std::set<std::string> warned;
        for (std::size_t i = 0; i < experiments_.size(); ++i)
        {
            const Experiment &experiment = experiments_[i];
            for (const std::string &warning : runner.problem(i).scenario().warnings)
                if (warned.insert(warning).second)
                    std::cerr << "parking_benchmark: " << warning << std::endl;
            const std::string why = runner.problem(i).whyUnsolvable();
            if (why.empty())
                continue;
            const ProblemOptions &options = experiment.options;
            std::string given;
            if (options.start || options.goal)
                given = std::string(" (") +
                        (options.start && options.goal ? "start and goal are"
                         : options.start               ? "the start is"
                                                       : "the goal is") +
                        " given in " + config_.file + ")";
            std::cerr << "parking_benchmark: " << config_.lineOf(experiment.scenarioFile) << experiment.scenarioFile
                      << ": " << why << given << "; no run of " << experiment.name << " can solve it" << std::endl;
        }
    }

    std::string Comparison::database() const
    {
        const std::string part =
            options_.shards == 1 ? ""
                                 : "-" + std::to_string(options_.shard + 1) + "-of-" + std::to_string(options_.shards);
        return (fs::path(folder_) / ("benchmark" + part + ".db")).string();
    }

    std::vector<Row> Comparison::experimentRows() const
    {
        std::vector<Row> rows;
        for (const Experiment &experiment : experiments_)
            rows.push_back({{"name", experiment.name},
                            {"timelimit", config_.timeLimit},
                            {"memorylimit", config_.memoryLimit},
                            {"runcount", static_cast<std::int64_t>(config_.runCount)},
                            {"seed", std::to_string(config_.seed)}});
        return rows;
    }

    Comparison::Fingerprints Comparison::fingerprints() const
    {
        const std::string program = fileDigest("/proc/self/exe");
        std::map<std::string, std::string> libraries;
        Fingerprints result;
        for (const Experiment &experiment : experiments_)
            for (const std::size_t index : experiment.planners)
            {
                const PlannerSpec &planner = config_.planners[index];
                std::string &print = result[{experiment.name, planner.name}];
                print = fingerprint(config_, experiment, planner);
                if (options_.merge)
                    continue;  // Machines may have different builds of the program.
                const std::string &library = registry_.find(planner.planner).library;
                if (!library.empty() && libraries.count(library) == 0)
                    libraries[library] = "+" + fileDigest(library);
                print += "+" + program + libraries[library];
            }
        return result;
    }

    void Comparison::select(const Fingerprints &fingerprints)
    {
        std::vector<std::string> wanted;
        for (const auto &[names, print] : fingerprints)
            wanted.push_back(print);
        store_->select(wanted, config_.runCount);
    }

    std::vector<Row> Comparison::experimentsOf(UnitRunner &runner) const
    {
        const std::string cpu = ompl::machine::getCPUInfo();
        std::vector<Row> rows = experimentRows();
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            Row row{{"version", omplVersion()},
                    {"hostname", ompl::machine::getHostname()},
                    {"cpuinfo", cpu},
                    {"date", ompl::time::as_string(ompl::time::now())},
                    {"setup", runner.setupText(i) + "Configuration " + config_.file + "\n" + machineText() + "\n"}};
            for (const auto &[name, version] : machineVersions())
                row[name] = version;
            rows[i].merge(row);
        }
        return rows;
    }

    bool Comparison::run(const std::atomic<bool> &stop)
    {
        UnitRunner runner(config_, experiments_, registry_, options_.isolation, stop);
        runner.checkSettings();
        reportUnsolvable(runner);
        makeFolder(folder_);
        store_ = std::make_unique<RunStore>(database());
        if (options_.fresh)
            store_->forget();
        const auto prints = fingerprints();
        select(prints);
        store_->describe(experimentsOf(runner));
        const std::vector<Unit> units = planUnits(config_, experiments_, options_.shard, options_.shards);
        std::vector<Unit> left;
        std::vector<std::string> names;
        for (const Unit &unit : units)
            if (!store_->has(experiments_[unit.experiment].name, config_.planners[unit.planner].name, unit.run))
            {
                left.push_back(unit);
                names.push_back(config_.planners[unit.planner].name);
            }
        if (!options_.quiet && left.empty())
            std::cerr << "All " << units.size() << " runs are already finished; --fresh repeats them" << std::endl;
        else if (!options_.quiet && left.size() < units.size())
            std::cerr << "Resuming: " << units.size() - left.size() << " of " << units.size()
                      << " runs are already finished" << std::endl;
        Progress progress(names, config_.timeLimit, options_.quiet);
        for (const Unit &unit : left)
        {
            if (stop)
                return false;
            const std::string &planner = config_.planners[unit.planner].name;
            progress.begin(experiments_[unit.experiment].name, planner);
            const auto begin = std::chrono::steady_clock::now();
            RunRecord record = runner.run(unit);
            if (stop)
                return false;
            if (!options_.quiet && isFailure(record.outcome().value_or(PlanStatus::Timeout)))
                progress.note(failureText(record));
            record.fingerprint = prints.at({record.experiment, record.planner});
            store_->add(record);
            progress.end(planner, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        return true;
    }

    std::vector<std::string> Comparison::parts() const
    {
        std::vector<std::string> files;
        std::error_code ignored;
        const auto addFolder = [&](const std::string &folder, const char *pattern)
        {
            for (const auto &entry : fs::directory_iterator(folder, ignored))
                if (fnmatch(pattern, entry.path().filename().c_str(), 0) == 0 && entry.is_regular_file(ignored))
                    files.push_back(entry.path().string());
        };
        if (options_.inputs.empty())
            addFolder(folder_, "benchmark-*.db");
        for (const std::string &input : options_.inputs)
            if (!fs::is_directory(input, ignored))
                files.push_back(input);
            else if (addFolder(input, "benchmark*.db"); files.empty())
                throw Error(input + ": contains no runs to merge (benchmark*.db)");
        std::sort(files.begin(), files.end());
        return files;
    }

    void Comparison::mergeParts()
    {
        const std::vector<std::string> files = parts();
        if (files.empty() && !fs::exists(database()))
            throw Error(folder_ + ": contains no runs to merge (benchmark*.db)");
        const Fingerprints prints = fingerprints();
        const auto require = [&](const std::string &file, const std::vector<RunRecord> &records)
        {
            const auto isWanted = [&prints](const RunRecord &record)
            {
                const auto print = prints.find({record.experiment, record.planner});
                return print != prints.end() && record.fingerprint.find(print->second + "+") == 0;
            };
            if (!records.empty() && std::none_of(records.begin(), records.end(), isWanted))
                throw Error(file + ": contains the runs of another comparison than " + config_.file +
                            " with these options (configuration, scenarios, limits or seed differ)");
        };
        std::vector<StoredRuns> all;
        for (const std::string &file : files)
            require(file, all.emplace_back(RunStore::readFile(file)).records);
        if (files.empty())
            require(database(), RunStore::readFile(database()).records);
        makeFolder(folder_);  // Created only when the first record is available.
        store_ = std::make_unique<RunStore>(database());
        select(prints);
        for (const StoredRuns &part : all)
            store_->merge(part);
        store_->describe(experimentRows());
    }

    void Comparison::writeExperiment(const Experiment &experiment, const std::vector<RunRecord> &records) const
    {
        const fs::path folder(folder_);
        std::map<std::string, std::vector<const RunRecord *>> runs;  // by planner
        for (const RunRecord &record : records)
            runs[record.planner].push_back(&record);
        writeFileAtomically((folder / (experiment.name + ".log")).string(),
                            omplLog(store_->database(), experiment.name));

        const Scenario scenario = experiment.scenario();
        std::vector<std::pair<std::string, const RunRecord *>> best;
        for (const std::size_t index : experiment.planners)
        {
            const std::string &planner = config_.planners[index].name;
            best.emplace_back(planner, bestRun(runs[planner]));
            for (const RunRecord *record : runs[planner])
                if (record->hasPath && (config_.savePaths == SavePaths::All ||
                                        (config_.savePaths == SavePaths::Shortest && record == best.back().second)))
                    writeFileAtomically(
                        (folder / "paths" /
                         (experiment.name + "-" + planner + "-" + std::to_string(record->run()) + ".csv"))
                            .string(),
                        pathCsv(scenario, *record));
        }
        writeFileAtomically((folder / "pictures" / (experiment.name + ".svg")).string(),
                            comparisonSvg(scenario, experiment.name,
                                          circleRadiusOf(experiment.options.settings, scenario.vehicle), best));
    }

    ComparisonResult Comparison::write()
    {
        if (options_.merge)
            mergeParts();
        std::optional<LongStep> step;
        if (!options_.quiet)
            step.emplace("writing the results");
        ComparisonResult result;
        const fs::path folder(folder_);
        removeRemains(folder);
        makeFolder((folder / "pictures").string());
        if (config_.savePaths != SavePaths::None)
            makeFolder((folder / "paths").string());
        std::vector<SummaryRow> summaryRows;
        std::vector<RunRecord> failed;
        for (const Experiment &experiment : experiments_)
        {
            // One at a time, since there may be very many runs.
            const std::vector<RunRecord> records = store_->read(experiment.name);
            const std::size_t expected = experiment.planners.size() * config_.runCount;
            result.missing += expected - std::min(expected, records.size());
            if (records.empty())
                continue;
            for (SummaryRow &row : summarize(config_, {experiment}, records))
                summaryRows.push_back(std::move(row));
            std::copy_if(records.begin(), records.end(), std::back_inserter(failed),
                         [](const RunRecord &record)
                         { return isFailure(record.outcome().value_or(PlanStatus::Timeout)); });
            writeExperiment(experiment, records);
        }
        const std::string failures = failuresText(failed);
        const auto nameOf = [&folder](const char *name)
        {
            return (folder / name).string();
        };
        writeFileAtomically(nameOf("summary.md"), summaryMarkdown(summaryRows) + failures);
        writeFileAtomically(nameOf("summary.csv"), summaryCsv(summaryRows));
        result.text = summaryText(summaryRows, hasColour(STDOUT_FILENO)) + failures + "\nResults:\n    " + database() +
                      " (Planner Arena opens it)\n    " + nameOf("summary.md") + "\n    " + nameOf("summary.csv") +
                      "\n    " + nameOf("*.log") + " (of OMPL)\n    " + nameOf("pictures") + "\n";
        // Last, so that a failure does not affect the results.
        try
        {
            if (const std::string report = options_.report ? makeReport(folder_) : ""; !report.empty())
                result.text += "\nReport: " + report + "\n";
        }
        catch (const Error &error)
        {
            result.reportError = error.what();
        }
        return result;
    }
}  // namespace parking
