#include "benchmarks/compare/BenchmarkOptions.h"

#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <limits>
#include <sstream>

namespace po = boost::program_options;

namespace parking
{
    namespace
    {
        constexpr std::size_t MAX_SHARDS = 100000;

        po::options_description describe()
        {
            po::options_description options("Options");
            auto add = options.add_options();
            add("output", oneValue("DIR"), "folder for all results (default: the configuration's, or results-NAME)");
            add("time", oneValue("S"), "limit in seconds for each run");
            add("runs", oneValue("N"), "runs of each planner on each problem");
            add("seed", oneValue("N"), "seed of all random numbers");
            add("scenarios", manyValues("FILE|DIR"), "use this scenario instead of the configuration's; repeatable");
            add("planner", manyValues("NAME"), "run only this planner of the configuration; repeatable");
            add("plugin", manyValues("FILE"), "load planners from a library (.so) or a Python file (.py); repeatable");
            add("shard", oneValue("I/N"), "execute part I of N (1/N to N/N), to be merged later");
            add("merge", "execute no runs: merge the runs in the output folder, or those of --from");
            add("from", manyValues("FILE|DIR"), "with --merge: file or folder of runs; repeatable");
            add("isolate",
                "execute each run in its own process, which contains crashes, hangs and exhausted memory (always "
                "for plug-ins)");
            add("no-isolate", "execute plug-ins in this process, too: only exceptions are contained");
            add("fresh", "repeat all runs, including finished ones");
            add("no-report", "leave out the HTML report");
            add("quiet", "print no progress");
            add("help", "print this text");
            return options;
        }

        void readShard(BenchmarkOptions &options, const std::string &text)
        {
            const std::size_t slash = text.find('/');
            std::size_t index = 0, count = 0;
            if (slash == std::string::npos || !parseCount(text.substr(0, slash), index) ||
                !parseCount(text.substr(slash + 1), count) || index < 1 || count < 1 || index > count ||
                count > MAX_SHARDS)
                throw Error("--shard must be I/N with I from 1 to N, for example 2/8, not " + inQuotes(text));
            options.shard = index - 1;
            options.shards = count;
        }
    }  // namespace

    BenchmarkOptions readBenchmarkOptions(const std::vector<std::string> &arguments)
    {
        po::options_description options = describe();
        options.add_options()("config", po::value<std::string>());
        const CommandLine line(arguments, options, po::positional_options_description().add("config", 1));
        BenchmarkOptions result;
        result.plugins = line.texts("plugin");
        result.help = line.given("help");
        if (result.help)
            return result;  // with the plug-ins, whose planners --help lists
        if (!line.given("config"))
            throw Error("no configuration given (see --help)");
        result.config = *line.text("config");
        result.output = line.text("output").value_or("");
        if (line.given("output") && result.output.empty())
            throw Error("--output must name a folder");
        result.timeLimit = line.positive("time", LONGEST_RUN);
        result.runCount = line.whole("runs", 1, 1000000);
        result.seed = line.whole("seed", 1, std::numeric_limits<std::uint32_t>::max());
        if (const auto shard = line.text("shard"))
            readShard(result, *shard);
        result.scenarios = line.texts("scenarios");
        result.planners = line.texts("planner");
        result.merge = line.given("merge");
        result.inputs = line.texts("from");
        result.fresh = line.given("fresh");
        result.report = !line.given("no-report");
        result.quiet = line.given("quiet");
        if (line.given("isolate") && line.given("no-isolate"))
            throw Error("--isolate and --no-isolate contradict each other");
        if (line.given("isolate") || line.given("no-isolate"))
            result.isolation = line.given("isolate") ? Isolation::All : Isolation::None;
        if (!result.inputs.empty() && !result.merge)
            throw Error("--from requires --merge");
        if (result.merge && (line.given("shard") || result.fresh))
            throw Error("--merge is not compatible with --shard and --fresh");
        return result;
    }

    std::string benchmarkHelp(const PlannerRegistry &registry)
    {
        std::ostringstream text;
        text << "usage: parking_benchmark CONFIG.cfg [options]\n\n"
                "Compares planners on parking problems and writes database, tables, pictures and an HTML report.\n"
                "CONFIG.cfg lists planners and scenarios (docs/benchmark-reference.md).\n"
                "Rerun the command to resume an interrupted comparison.\n\n"
                "Examples, run at the root of the project:\n"
                "  parking_benchmark benchmarks/bundled.cfg --runs 1\n"
                "  parking_benchmark benchmarks/bundled.cfg --scenarios benchmarks/scenarios/parallel.yaml --fresh\n\n"
             << describe() << '\n'
             << wrapped("Planners:", registry.names())
             << "\nStatus: 0 done, 1 runs or the report are missing, 2 invalid input or usage, 130 interrupted\n";
        return text.str();
    }
}  // namespace parking
