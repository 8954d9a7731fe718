#include "benchmarks/programs/Comparison.h"

#include "benchmarks/comparison/ExperimentLog.h"
#include "benchmarks/comparison/UnitRunner.h"
#include "benchmarks/database/DatabaseWriter.h"
#include "benchmarks/summary/ComparisonPictures.h"
#include "benchmarks/summary/ReportScript.h"
#include "benchmarks/summary/Summary.h"
#include "benchmarks/system/CommandLine.h"
#include "benchmarks/system/LongStep.h"
#include "benchmarks/system/Machine.h"
#include "benchmarks/system/Progress.h"
#include "benchmarks/system/QuietChildren.h"
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
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <fnmatch.h>
#include <unistd.h>

namespace fs = std::filesystem;
using nlohmann::json;

namespace parking
{
    namespace
    {
        void makeFolder(const std::string &folder)
        {
            std::error_code error;
            fs::create_directories(folder, error);
            if (!fs::is_directory(folder))
                throw Error(folder + ": is no folder and cannot be made one" + (error ? ": " + error.message() : ""));
            if (access(folder.c_str(), W_OK) != 0)
                throw Error(folder + ": cannot be written: " + std::strerror(errno));
        }

        /** Files that somebody was killed over while writing them. */
        void removeRemains(const fs::path &folder)
        {
            std::vector<fs::path> remains;
            std::error_code ignored;
            for (const fs::path &each : {folder, folder / "pictures", folder / "paths"})
                for (const auto &entry : fs::directory_iterator(each, ignored))
                {
                    const std::string name = entry.path().filename().string();
                    if (fnmatch("*.new.??????", name.c_str(), 0) == 0 || fnmatch(".report-*", name.c_str(), 0) == 0 ||
                        fnmatch("benchmark.db.new[.-]*", name.c_str(), 0) == 0)
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
            const double sampling = samplingOf(record.path.length(), record.denselyValid.value_or(false));
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
            std::cerr << "parking_benchmark: " << config_.file << ": not run, as 'only' names none of the scenarios of "
                      << "--scenarios: " << left << std::endl;
    }

    void Comparison::protectInputs() const
    {
        const fs::path folder(folder_);
        std::vector<std::string> outputs{runsFile()}, inputs{config_.file};
        for (const char *name : {"benchmark.db", "summary.md", "summary.csv", "report.html", "statistics.json",
                                 "standings.csv", "pairs.csv"})
            outputs.push_back((folder / name).string());
        for (const Experiment &experiment : experiments_)
        {
            outputs.push_back((folder / (experiment.name + ".log")).string());
            outputs.push_back((folder / "pictures" / (experiment.name + ".svg")).string());
            inputs.insert(inputs.end(), experiment.files.begin(), experiment.files.end());
        }
        requireNoInput(outputs, inputs);
        // There are too many paths, for each run one, to look at them one by one.
        std::error_code ignored;
        for (const std::string &input : inputs)
            if (config_.savePaths != SavePaths::None &&
                fs::equivalent(fs::absolute(input).parent_path(), folder / "paths", ignored))
                throw Error(inQuotes(input) + " is an input where the paths are to be written; name another --output");
    }

    void Comparison::tellUnsolvable(UnitRunner &runner) const
    {
        for (std::size_t i = 0; i < experiments_.size(); ++i)
        {
            const Experiment &experiment = experiments_[i];
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

    std::string Comparison::runsFile() const
    {
        const std::string part =
            options_.shards == 1 ? ""
                                 : "-" + std::to_string(options_.shard + 1) + "-of-" + std::to_string(options_.shards);
        return (fs::path(folder_) / ("runs" + part + ".jsonl")).string();
    }

    json Comparison::header(const std::vector<std::string> &setups) const
    {
        const std::string cpu = []
        {
            const QuietChildren quiet;
            return ompl::machine::getCPUInfo();
        }();
        json result{
            {"fingerprint", fingerprint(config_)},
            {"fingerprints", fingerprints()},
            {"config", config_.file},
            {"host", ompl::machine::getHostname()},
            {"cpu", cpu},
            {"machine", machineText()},
            {"parameters", machineParameters()},
            {"seed", config_.seed},
            {"time_limit", config_.timeLimit},
            {"started", std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count()}};
        json texts = json::object();
        for (std::size_t i = 0; i < experiments_.size(); ++i)
            texts[experiments_[i].name] = setups[i] + machineText() + "\n";
        result["setups"] = std::move(texts);
        return result;
    }

    json Comparison::fingerprints() const
    {
        const std::string program = fileDigest("/proc/self/exe");
        std::map<std::string, std::string> libraries;
        json result = json::object();
        for (const Experiment &experiment : experiments_)
            for (const std::size_t index : experiment.planners)
            {
                const PlannerSpec &planner = config_.planners[index];
                const std::string &library = registry_.find(planner.planner).library;
                if (!library.empty() && libraries.count(library) == 0)
                    libraries[library] = "+" + fileDigest(library);
                result[experiment.name][planner.name] =
                    fingerprint(config_, experiment, planner) + "+" + program + libraries[library];
            }
        return result;
    }

    void Comparison::openStore(const std::vector<std::string> &setups)
    {
        store_ = std::make_unique<ResultStore>(runsFile(), header(setups), options_.fresh);
        if (!store_->setAside().empty() && !options_.quiet)
            std::cerr << "Runs of an earlier comparison were moved to " << store_->setAside() << std::endl;
        if (!store_->damage().empty())
            std::cerr << "parking_benchmark: " << store_->damage() << std::endl;
    }

    bool Comparison::run(const std::atomic<bool> &stop)
    {
        UnitRunner runner(config_, experiments_, registry_, options_.isolation, stop);
        runner.checkSettings();
        tellUnsolvable(runner);
        makeFolder(folder_);
        std::vector<std::string> setups;
        for (std::size_t i = 0; i < experiments_.size(); ++i)
            setups.push_back(runner.setupText(i));
        openStore(setups);
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
            std::cerr << "All " << units.size() << " runs are already finished; --fresh does them again" << std::endl;
        else if (!options_.quiet && left.size() < units.size())
            std::cerr << "Going on: " << units.size() - left.size() << " of " << units.size()
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
            if (!options_.quiet && isFailure(record.outcome.value_or(PlanStatus::Timeout)))
                progress.note(failureText(record));
            store_->add(std::move(record));
            progress.end(planner, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        return true;
    }

    std::vector<std::string> Comparison::inputs() const
    {
        std::vector<std::string> files;
        const auto addFolder = [&files](const std::string &folder)
        {
            for (const auto &entry : fs::directory_iterator(folder))
            {
                const std::string name = entry.path().filename().string();
                if (name.compare(0, 4, "runs") == 0 && entry.path().extension() == ".jsonl" && entry.is_regular_file())
                    files.push_back(entry.path().string());
            }
        };
        if (!options_.merge)
            return {runsFile()};
        std::error_code ignored;
        if (options_.inputs.empty() && fs::is_directory(folder_, ignored))
            addFolder(folder_);
        for (const std::string &input : options_.inputs)
        {
            if (fs::is_directory(input, ignored))
                addFolder(input);
            else
                files.push_back(input);
        }
        std::sort(files.begin(), files.end());
        if (files.empty())
        {
            std::string folders;
            for (const std::string &input : options_.inputs)
                folders += (folders.empty() ? "" : ", ") + input;
            throw Error((folders.empty() ? folder_ : folders) + ": holds no runs to merge (runs*.jsonl)");
        }
        return files;
    }

    bool Comparison::isWanted(const RunRecord &record) const
    {
        if (record.run >= config_.runCount)
            return false;
        for (const Experiment &experiment : experiments_)
            if (experiment.name == record.experiment)
                for (const std::size_t index : experiment.planners)
                    if (config_.planners[index].name == record.planner)
                    {
                        // Machines may have programs of their own; the rest of a fingerprint tells those apart.
                        const std::string wanted = fingerprint(config_, experiment, config_.planners[index]) + "+";
                        return record.fingerprint.compare(0, wanted.size(), wanted) == 0;
                    }
        return false;
    }

    void Comparison::gather()
    {
        std::map<std::tuple<std::string, std::string, std::size_t>, RunRecord> known;
        std::set<std::string> hosts;
        header_ = nullptr;
        const auto take = [&](const json &header, const std::vector<RunRecord> &records)
        {
            hosts.insert(header.value("host", "unknown"));
            if (header_.is_null() || header.value("started", 0.0) < header_.value("started", 0.0))
                header_ = header;
            for (const RunRecord &record : records)
                if (isWanted(record))
                    known.emplace(std::make_tuple(record.experiment, record.planner, record.run), record);
        };
        if (store_)
            take(store_->header(), store_->records());
        else
            for (const std::string &file : inputs())
            {
                StoredResults stored = ResultStore::read(file);
                if (!stored.damage.empty())
                    std::cerr << "parking_benchmark: " << stored.damage << std::endl;
                if (!stored.records.empty() && std::none_of(stored.records.begin(), stored.records.end(),
                                                            [this](const RunRecord &each) { return isWanted(each); }))
                    throw Error(file + ": holds the runs of another comparison than " + config_.file +
                                " with these options (configuration, scenarios, limits or seed differ)");
                take(stored.header, stored.records);
            }
        std::string names;
        for (const std::string &host : hosts)
            names += (names.empty() ? "" : "+") + host;
        header_["host"] = names;
        records_.clear();
        for (auto &[key, record] : known)
            records_.push_back(std::move(record));
    }

    void Comparison::writeExperiment(const Experiment &experiment, ComparisonFiles &files) const
    {
        const fs::path folder(folder_);
        std::vector<const RunRecord *> own;
        for (const RunRecord &record : records_)
            if (record.experiment == experiment.name)
                own.push_back(&record);
        if (own.empty())
            return;
        const std::string log = (folder / (experiment.name + ".log")).string();
        writeFileAtomically(log, experimentLog(config_, experiment, header_, own));
        files.logs.push_back(log);

        const Scenario scenario = experiment.scenario();
        std::vector<std::pair<std::string, const RunRecord *>> best;
        for (const std::size_t index : experiment.planners)
        {
            const std::string &planner = config_.planners[index].name;
            std::vector<const RunRecord *> runs;
            for (const RunRecord *record : own)
                if (record->planner == planner)
                    runs.push_back(record);
            best.emplace_back(planner, bestRun(runs));
            for (const RunRecord *record : runs)
                if (record->hasPath && (config_.savePaths == SavePaths::All ||
                                        (config_.savePaths == SavePaths::Shortest && record == best.back().second)))
                    writeFileAtomically((folder / "paths" /
                                         (experiment.name + "-" + planner + "-" + std::to_string(record->run) + ".csv"))
                                            .string(),
                                        pathCsv(scenario, *record));
        }
        const std::string picture = (folder / "pictures" / (experiment.name + ".svg")).string();
        writeFileAtomically(picture, comparisonSvg(scenario, experiment.name, best));
        files.pictures.push_back(picture);
    }

    ComparisonFiles Comparison::write()
    {
        gather();
        if (!options_.inputs.empty())
            makeFolder(folder_);  // now that there is something to put into it
        std::optional<LongStep> step;
        if (!options_.quiet)
            step.emplace("writing the results");
        ComparisonFiles files;
        files.folder = folder_;
        const fs::path folder(folder_);
        const auto summaryRows = summarize(config_, experiments_, records_);
        const std::string failures = failuresText(records_);
        summary_ = summaryText(summaryRows) + failures;
        std::size_t expected = 0;
        files.database = (folder / "benchmark.db").string();
        DatabaseWriter database(files.database);  // first, as it keeps others from writing here
        removeRemains(folder);
        makeFolder((folder / "pictures").string());
        if (config_.savePaths != SavePaths::None)
            makeFolder((folder / "paths").string());
        for (const Experiment &experiment : experiments_)
        {
            expected += experiment.planners.size() * config_.runCount;
            writeExperiment(experiment, files);
        }
        files.missing = expected - std::min(expected, records_.size());
        database.write(files.logs);
        files.table = (folder / "summary.md").string();
        writeFileAtomically(files.table, summaryMarkdown(summaryRows) + failures);
        files.csv = (folder / "summary.csv").string();
        writeFileAtomically(files.csv, summaryCsv(summaryRows));
        // Last, and whatever happens to it does not harm the results.
        try
        {
            if (options_.report)
                files.report = makeReport(folder_);
        }
        catch (const Error &error)
        {
            files.reportError = error.what();
        }
        return files;
    }
}  // namespace parking
