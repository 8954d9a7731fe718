#include "benchmarks/comparison/ExperimentLog.h"

#include "benchmarks/comparison/RunColumns.h"
#include "benchmarks/system/OmplBenchmarkCompatibility.h"
#include "parking_geometry/text/Text.h"

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/config.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr double PROGRESS_STEP = 0.05;  // seconds between samples of the best cost

        std::string packagedVersion()
        {
            return std::to_string(OMPL_VERSION_VALUE / 1000000) + "." +
                   std::to_string(OMPL_VERSION_VALUE / 1000 % 1000) + "." + std::to_string(OMPL_VERSION_VALUE % 1000);
        }

        /** Cost over time as Planner Arena plots it: at regular times and at each improvement. */
        ompl::tools::Benchmark::RunProgressData progressOf(const RunRecord &record, double limit)
        {
            ompl::tools::Benchmark::RunProgressData data;
            std::vector<double> times;
            const double total = std::min(limit, record.time.value_or(0.0));
            for (int i = 1; i * PROGRESS_STEP <= total; ++i)
                times.push_back(i * PROGRESS_STEP);
            for (const Improvement &each : record.progress)
                times.push_back(each.time);
            std::sort(times.begin(), times.end());
            times.erase(std::unique(times.begin(), times.end()), times.end());
            std::size_t next = 0;
            double cost = std::numeric_limits<double>::infinity();
            for (const double time : times)
            {
                while (next < record.progress.size() && record.progress[next].time <= time)
                    cost = record.progress[next++].cost;
                data.push_back({{"time REAL", formatNumber(time)}, {"best cost REAL", formatNumber(cost)}});
            }
            return data;
        }

        /** As a log lists the values of an enumeration. */
        std::string outcomeNames()
        {
            std::string text = runColumn("outcome").name;
            for (std::size_t i = 0; i < PLAN_STATUSES; ++i)
                text += "|" + toString(static_cast<PlanStatus>(i));
            return text;
        }

        /** OMPL's own writer, for data that were gathered run by run. */
        class LogWriter final : public ompl::tools::Benchmark
        {
        public:
            explicit LogWriter(ompl::geometric::SimpleSetup &setup) : ompl::tools::Benchmark(setup)
            {
            }

            CompleteExperiment &experiment()
            {
                return exp_;
            }
        };

        ompl::geometric::SimpleSetup emptySetup()
        {
            const auto space = std::make_shared<ompl::base::SE2StateSpace>();
            return ompl::geometric::SimpleSetup(space);
        }
    }  // namespace

    std::string experimentLog(const BenchmarkConfig &config, const Experiment &experiment, const json &header,
                              const std::vector<const RunRecord *> &records)
    {
        ompl::geometric::SimpleSetup setup = emptySetup();
        LogWriter writer(setup);
        ompl::tools::Benchmark::CompleteExperiment &data = writer.experiment();
        data.name = experiment.name;
        data.maxTime = config.timeLimit;
        data.maxMem = config.memoryLimit;
        data.runCount = static_cast<unsigned int>(config.runCount);
        data.seed = config.seed;
        data.host = header.value("host", "unknown");
        data.cpuInfo = header.value("cpu", "");
        data.startTime = ompl::time::point() + ompl::time::seconds(header.value("started", 0.0));
        data.totalDuration = 0.0;
        data.setupInfo = header.at("setups").value(experiment.name, "");
        for (const auto &[name, value] : header.at("parameters").items())
            data.parameters[name] = value.get<std::string>();
        for (const std::size_t index : experiment.planners)
        {
            ompl::tools::Benchmark::PlannerExperiment planner;
            planner.name = "geometric_" + config.planners[index].name;
            std::vector<const RunRecord *> own;
            for (const RunRecord *record : records)
                if (record->planner == config.planners[index].name)
                    own.push_back(record);
            if (own.empty())
                continue;
            std::sort(own.begin(), own.end(), [](const RunRecord *a, const RunRecord *b) { return a->run < b->run; });
            // Of a planner that fails early nobody knows them.
            for (auto record = own.begin(); record != own.end() && planner.common.empty(); ++record)
                for (const auto &[name, value] : (*record)->parameters)
                    planner.common[oneLine(name)] = oneLine(value);
            planner.progressPropertyNames = {"best cost REAL", "time REAL"};
            for (const RunRecord *record : own)
            {
                planner.runs.push_back(ompl_compatibility::runProperties(omplProperties(*record)));
                planner.runsProgressData.push_back(progressOf(*record, config.timeLimit));
                data.totalDuration += record->time.value_or(0.0);
            }
            data.planners.push_back(std::move(planner));
        }
        std::ostringstream text;
        writer.saveResultsToStream(text);
        std::string log = text.str();
        // Debian's package does not know its own version.
        const std::string blank = "OMPL version \n";
        if (log.compare(0, blank.size(), blank) == 0)
            log.replace(0, blank.size(), "OMPL version " + packagedVersion() + "\n");
        // It names the values of its own status only.
        const std::string one = "\n1 enum type\n";
        if (const std::size_t at = log.find(one); at != std::string::npos)
            log.replace(at, one.size(), "\n2 enum types\n" + outcomeNames() + "\n");
        return log;
    }
}  // namespace parking
