// Evaluation runs of the whole pipeline: every problem given is planned, smoothed and driven once by a nominal car and
// once per seed by a disturbed one (0.1 s of steering lag, noise of 2 cm and 0.5 degrees, 5 % of speed bias). The table
// of docs/path-tracking.md comes from here.

#include "benchmarks/studies/DriveStudy.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace
{
    using namespace parking;

    constexpr double CM = 100.0;
    constexpr double DEGREES = 180.0 / PI;
    constexpr double MS = 1e3;

    /** What is asked of the figures. */
    constexpr double NOMINAL_ERROR = 0.05, NOMINAL_YAW = 1.0 / DEGREES, NOMINAL_CROSS_TRACK = 0.05;
    constexpr double DISTURBED_ERROR = 0.15, DISTURBED_YAW = 2.0 / DEGREES, SAFE_CLEARANCE = 0.2;

    struct Worst
    {
        std::size_t drives{0}, parked{0}, collided{0}, replanned{0};
        double finalError{0.0}, finalYaw{0.0}, crossTrack{0.0};
        double clearance{std::numeric_limits<double>::infinity()};

        void add(const ParkingResult &result)
        {
            const Evaluation &figures = result.evaluation;
            ++drives;
            parked += result.parked() ? 1 : 0;
            collided += figures.collisions > 0 ? 1 : 0;
            replanned += result.legs.size() > 1 ? 1 : 0;
            finalError = std::max(finalError, figures.finalPositionError);
            finalYaw = std::max(finalYaw, figures.finalYawError);
            crossTrack = std::max(crossTrack, figures.maxCrossTrack);
            clearance = std::min(clearance, figures.minClearance);
        }

        bool within(double error, double yaw) const
        {
            return drives == parked && finalError <= error && finalYaw <= yaw;
        }
    };

    struct Row
    {
        std::string name;
        bool planned{false};
        double planningTime{0.0}, length{0.0}, clearance{0.0};
        std::size_t cusps{0};
        Evaluation nominal;
        Worst nominalWorst, disturbed;

        /** Are the promised figures kept? */
        bool good() const
        {
            const bool safe = clearance <= SAFE_CLEARANCE || disturbed.collided == 0;
            return planned && nominalWorst.within(NOMINAL_ERROR, NOMINAL_YAW) && nominalWorst.collided == 0 &&
                   nominalWorst.crossTrack <= NOMINAL_CROSS_TRACK &&
                   (clearance <= SAFE_CLEARANCE || disturbed.within(DISTURBED_ERROR, DISTURBED_YAW)) && safe;
        }
    };

    Row evaluate(const Scenario &scenario, const ParkingParameters &parameters, std::size_t seeds, std::size_t first)
    {
        Row row;
        row.name = scenario.name;
        const ParkingResult nominal = AutomaticParking(parameters).park(scenario);
        row.planned = nominal.legs.front().plan.found;
        if (!row.planned)
            return row;
        const ParkingPlan &plan = nominal.legs.front().plan;
        row.planningTime = plan.planningTime + plan.smoothingTime;
        row.length = plan.path.length();
        row.cusps = plan.path.cusps();
        row.clearance = nominal.evaluation.minClearance;
        row.nominal = nominal.evaluation;
        row.nominalWorst.add(nominal);
        for (std::size_t i = 0; i < seeds; ++i)
        {
            ParkingParameters disturbed = parameters;
            disturbed.drive.disturbances = Disturbances::everyday(first + i);
            row.disturbed.add(AutomaticParking(disturbed).park(scenario));
        }
        return row;
    }

    std::string table(const std::vector<Row> &rows)
    {
        MarkdownTable result({"problem", "plan, ms", "length, m", "cusps", "planned clearance, cm", "time, s",
                              "mean abs. acceleration, m/s2", "mean abs. steering, deg", "nominal: final, cm", "deg",
                              "cross-track, cm", "hits", "disturbed: parked", "final, cm", "deg", "cross-track, cm",
                              "clearance, cm", "hits", "kept"});
        for (const Row &row : rows)
        {
            if (!row.planned)
            {
                result.add({row.name, "no path"});
                continue;
            }
            const Worst &nominal = row.nominalWorst, &disturbed = row.disturbed;
            result.add({row.name, formatNumber(MS * row.planningTime, 0), formatNumber(row.length, 1),
                        std::to_string(row.cusps), formatNumber(CM * row.clearance, 1),
                        formatNumber(row.nominal.travelTime, 1), formatNumber(row.nominal.meanAbsAcceleration, 2),
                        formatNumber(DEGREES * row.nominal.meanAbsSteering, 1),
                        formatNumber(CM * nominal.finalError, 1), formatNumber(DEGREES * nominal.finalYaw, 2),
                        formatNumber(CM * nominal.crossTrack, 1), std::to_string(nominal.collided),
                        std::to_string(disturbed.parked) + "/" + std::to_string(disturbed.drives) +
                            (disturbed.replanned > 0 ? " (" + std::to_string(disturbed.replanned) + " replanned)" : ""),
                        formatNumber(CM * disturbed.finalError, 1), formatNumber(DEGREES * disturbed.finalYaw, 2),
                        formatNumber(CM * disturbed.crossTrack, 1), formatNumber(CM * disturbed.clearance, 1),
                        std::to_string(disturbed.collided), row.good() ? "yes" : "NO"});
        }
        return result.text();
    }

    int run(const std::vector<std::string> &arguments)
    {
        DriveStudy study("tracking_evaluation", "Parks in every scenario, once as it is and many times disturbed.");
        auto add = study.options().add_options();
        add("seeds", oneValue("N"), "disturbed drives of each problem (default 20)");
        add("first-seed", oneValue("N"), "their first seed (default 1)");
        add("output", oneValue("FILE.md"), "write the table there, too");
        const std::optional<CommandLine> line = study.read(arguments);
        if (!line)
            return 0;
        const std::size_t seeds = line->whole("seeds", 1, 100000).value_or(20);
        const std::size_t first = line->whole("first-seed", 0, 1000000000).value_or(1);
        const ParkingParameters parameters = DriveStudy::parameters(*line);
        const std::string output = line->outputFile("output").value_or("");
        const std::vector<Scenario> scenarios = DriveStudy::scenarios(*line);
        std::vector<std::string> inputs;
        for (const Scenario &scenario : scenarios)
            inputs.insert(inputs.end(), scenario.files.begin(), scenario.files.end());
        if (!output.empty())
            requireOutputs({output}, inputs);
        std::vector<Row> rows;
        for (const Scenario &scenario : scenarios)
        {
            rows.push_back(evaluate(scenario, parameters, seeds, first));
            std::cerr << scenario.name << (rows.back().good() ? "" : ": figures missed, or no path") << std::endl;
        }
        const std::string result = table(rows);
        std::cout << result;
        if (!output.empty())
            writeFileAtomically(output, result);
        return std::all_of(rows.begin(), rows.end(), [](const Row &row) { return row.good(); }) ? 0 : 1;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("tracking_evaluation", argc, argv, run);
}
