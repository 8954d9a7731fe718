// parking_plan: plans one scenario. See docs/benchmark-reference.md.

#include "benchmarks/plan/PlanOptions.h"
#include "benchmarks/plan/PlanReport.h"
#include "benchmarks/planners/PluginLoader.h"
#include "benchmarks/system/CommandLine.h"
#include "benchmarks/system/LongStep.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <ompl/util/Console.h>

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace
{
    constexpr int HELPED = 0;

    int plan(const std::vector<std::string> &arguments)
    {
        using namespace parking;
        const PlanOptions options = readPlanOptions(arguments);
        PlannerRegistry registry = PlannerRegistry::builtIn();
        loadPlugins(registry, options.plugins);
        if (options.help)
        {
            std::cout << planHelp(registry);
            return HELPED;
        }
        const PlannerEntry &entry = registry.find(options.planner);
        ProblemSettings settings = suitableSettings(entry, options.settings);
        settings.space = options.space.value_or(settings.space);
        settings.footprint = options.footprint.value_or(settings.footprint);
        if (options.circleRadius > 0.0 && settings.footprint != FootprintKind::Circle)
            throw Error("--circle-radius requires --footprint circle; the footprint is a rectangle");
        settings.circleRadius = options.circleRadius;
        requireOutputs(options.outputFiles(), options.inputFiles());

        const Problem problem = [&]
        {
            const LongStep step("reading " + options.scenario);
            Scenario scenario = readScenario(options.scenario, {options.vehicle});
            requireNoInput(options.outputFiles(), scenario.files);
            for (const std::string &warning : scenario.warnings)
                std::cerr << "parking_plan: " << warning << std::endl;
            return Problem(std::move(scenario), settings);
        }();
        PlanReport result;
        result.planner = entry.name;
        result.parameters = parametersJson(*problem.prepare(entry, options.settings).planner);
        for (std::size_t run = 0; run < options.runs; ++run)
        {
            const LongStep step("planning, run " + std::to_string(run + 1) + " of " + std::to_string(options.runs) +
                                ", at most " + formatNumber(options.timeLimit) + " s");
            result.runs.push_back(planOnce(problem, entry, options.settings, options.timeLimit, options.seed + run));
        }
        if (options.trajectory)
        {
            const LongStep step("optimising the trajectory");
            addTrajectory(problem, result, options.track);
        }
        if (options.track)
        {
            const LongStep step("driving");
            addDrive(problem, result, options.perceive);
        }

        if (!options.svg.empty())
            writeFileAtomically(options.svg, resultSvg(problem, result));
        if (!options.csv.empty() && result.trajectory)
            writeFileAtomically(options.csv, resultCsv(problem, result));
        if (!options.html.empty() && result.drive)
            writeFileAtomically(options.html, resultHtml(problem, result));
        if (!options.json.empty())
        {
            const std::string text = resultJson(problem, options, result).dump(1) + "\n";
            if (options.json == "-")
                std::cout << text;
            else
                writeFileAtomically(options.json, text);
        }
        if (options.json != "-")
            std::cout << resultSummary(problem, result);
        if (!std::cout.flush())
            throw Error("standard output cannot be written");
        const PlanRun &run = result.first();
        std::string trouble;
        if (!run.path)
            trouble = problem.whyUnsolvable();
        else if (!run.hasValidPath())
            trouble = run.reason;
        if (!trouble.empty())
            std::cerr << "parking_plan: " << options.scenario << ": " << trouble << std::endl;
        const std::vector<std::string> missing = missingFiles(options, result);
        for (const std::string &each : missing)
            std::cerr << "parking_plan: " << each << std::endl;
        return exitStatus(run, missing.empty());
    }
}  // namespace

int main(int argc, char **argv)
{
    // The results contain all messages of planners.
    ompl::msg::noOutputHandler();
    return parking::runProgram("parking_plan", argc, argv, plan);
}
