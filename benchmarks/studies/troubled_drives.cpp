// Simulates many drives with disturbances, each with its seed. Writes a table of docs/results.md.

#include "benchmarks/studies/TroubledDrives.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <string>
#include <vector>

namespace po = boost::program_options;

namespace
{
    using namespace parking;

    po::options_description describe()
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("stop-and-steer", "drive the paths with stops to steer, not optimised trajectories");
        add("acceleration-share", oneValue("X"), "share of the car's acceleration that trajectories use");
        add("brake-reserve", oneValue("X"), "share of the brake kept in reserve");
        add("steering-rate-share", oneValue("X"), "share of the car's steering rate that trajectories use");
        add("steering-share", oneValue("X"), "share of the car's steering angle that trajectories use");
        add("nearness", oneValue("X"), "cost in seconds of a metre of contact with obstacles");
        add("kept", oneValue("M"), "preferred clearance of trajectories in metres");
        add("least", oneValue("M"), "clearance in metres that trajectories keep if the plan does");
        add("clearance-share", oneValue("X"), "minimum share of the plan's clearance that they keep");
        add("no-smoothing", "drive the planner's arcs without smoothing");
        add("drives", oneValue("N"), "number of drives (default 1000)");
        add("first", oneValue("N"), "number of the first drive, which is its seed (default 0)");
        add("verbose", "print a line for each drive");
        add("events", "print the events of each printed drive");
        add("help", "print this text");
        return options;
    }

    /** The parameters of the pipeline from \e line. Throws parking::Error for values out of their range. */
    ParkingParameters parametersOf(const CommandLine &line)
    {
        ParkingParameters parameters;
        parameters.planning.smooth = !line.given("no-smoothing");
        parameters.optimizeTrajectory = !line.given("stop-and-steer");
        const auto take = [&line](const char *option, double &value)
        {
            value = line.positive(option).value_or(value);
        };
        TrajectoryOptions &trajectory = parameters.trajectory.trajectory;
        take("acceleration-share", trajectory.accelerationShare);
        take("steering-rate-share", trajectory.steeringRateShare);
        take("steering-share", trajectory.steeringShare);
        take("nearness", trajectory.weights.nearness);
        take("brake-reserve", parameters.drive.tracking.brakeReserve);
        take("kept", parameters.keptClearance);
        take("least", parameters.minClearance);
        take("clearance-share", parameters.clearanceShare);
        parameters.validate();
        return parameters;
    }

    struct Row
    {
        std::size_t drives{0}, parked{0}, stoppedFree{0}, appeared{0}, avoidable{0}, avoidableHit{0}, inevitableHit{0},
            otherHit{0}, otherInevitable{0}, rolling{0}, broken{0};
        double impact{0.0}, fastest{0.0};
        double time{0.0};  // sum of seconds of the drives that parked

        void add(const TroubledDrive &drive)
        {
            const bool hit = drive.hitAppeared || drive.hitOther;
            ++drives;
            parked += drive.status == ParkingStatus::Parked && !hit ? 1 : 0;
            time += drive.status == ParkingStatus::Parked && !hit ? drive.duration : 0.0;
            stoppedFree += drive.status != ParkingStatus::Parked && !hit && drive.stands ? 1 : 0;
            appeared += drive.appeared ? 1 : 0;
            avoidable += drive.appeared && drive.avoidable ? 1 : 0;
            avoidableHit += drive.hitAppeared && drive.avoidable ? 1 : 0;
            inevitableHit += drive.hitAppeared && !drive.avoidable ? 1 : 0;
            otherHit += drive.hitOther && drive.otherAvoidable ? 1 : 0;
            otherInevitable += drive.hitOther && !drive.otherAvoidable ? 1 : 0;
            rolling += drive.stands ? 0 : 1;
            broken += drive.brokenLimit.empty() ? 0 : 1;
            if (drive.hitAppeared && !drive.avoidable)
                impact = std::max(impact, drive.impactSpeed);
            fastest = std::max(fastest, drive.fastest);
        }

        /** Whether all guarantees are kept. */
        bool good() const
        {
            return avoidableHit == 0 && otherHit == 0 && rolling == 0 && broken == 0;
        }
    };

    /** A row of a table in Markdown. */
    std::string joined(const std::vector<std::string> &cells)
    {
        std::string line = "|";
        for (const std::string &cell : cells)
            line += ' ' + cell + " |";
        return line + '\n';
    }

    std::string tableOf(const std::array<Row, TROUBLES> &rows)
    {
        const std::vector<std::string> head{"trouble",
                                            "drives",
                                            "parked",
                                            "stopped, touching nothing",
                                            "an obstacle appeared",
                                            "could be avoided",
                                            "and was hit",
                                            "could not",
                                            "and was hit",
                                            "at most, m/s",
                                            "anything else was hit",
                                            "not avoidable",
                                            "rolls at the end",
                                            "commands beyond a limit",
                                            "mean s to park"};
        std::string text = joined(head) + "|---|";
        for (std::size_t i = 1; i < head.size(); ++i)
            text += "--:|";
        text += '\n';
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const Row &row = rows[i];
            std::vector<std::string> cells{toString(static_cast<Trouble>(i))};
            for (const std::size_t count : {row.drives, row.parked, row.stoppedFree, row.appeared, row.avoidable,
                                            row.avoidableHit, row.appeared - row.avoidable, row.inevitableHit})
                cells.push_back(std::to_string(count));
            cells.push_back(formatNumber(row.impact, 1));
            for (const std::size_t count : {row.otherHit, row.otherInevitable, row.rolling, row.broken})
                cells.push_back(std::to_string(count));
            cells.push_back(row.parked > 0 ? formatNumber(row.time / static_cast<double>(row.parked), 1) : "");
            text += joined(cells);
        }
        return text;
    }

    int run(const std::vector<std::string> &arguments)
    {
        const po::options_description options = describe();
        po::options_description all;
        all.add(options).add_options()("scenario", po::value<std::vector<std::string>>());
        const CommandLine line(arguments, all, po::positional_options_description().add("scenario", -1));
        if (line.given("help"))
        {
            std::cout << "usage: troubled_drives SCENARIO... [options]\n\n"
                         "Simulates parking with disturbances of every kind in each scenario, and counts contacts.\n\n"
                         "Examples, run at the root of the project:\n"
                         "  troubled_drives benchmarks/scenarios/parallel.yaml --drives 14\n"
                         "  troubled_drives benchmarks/scenarios/perpendicular.yaml --drives 7 --first 100 --events\n\n"
                      << options;
            return 0;
        }
        if (!line.given("scenario"))
            throw Error("no scenario given (see --help)");
        std::vector<Scenario> scenarios;
        for (const std::string &file : line.texts("scenario"))
            scenarios.push_back(readScenario(file));
        const ParkingParameters parameters = parametersOf(line);
        const std::size_t drives = line.whole("drives", 1, 1000000).value_or(1000);
        const std::size_t first = line.whole("first", 0, 1000000000).value_or(0);
        std::array<Row, TROUBLES> rows;
        for (std::size_t i = first; i < first + drives; ++i)
        {
            const Scenario &scenario = scenarios[(i / TROUBLES) % scenarios.size()];
            const TroubledDrive drive = driveInTrouble(scenario, static_cast<Trouble>(i % TROUBLES), i, parameters);
            Row one;
            one.add(drive);
            rows[i % TROUBLES].add(drive);
            if (line.given("verbose") || !one.good())
                std::cerr << scenario.name << ", " << toString(drive.trouble) << ", drive " << i << ": "
                          << toString(drive.status) << (drive.hitAppeared ? ", hit the appeared obstacle" : "")
                          << (drive.appeared && !drive.avoidable ? " (not avoidable)" : "")
                          << (drive.hitOther ? ", hit another obstacle" : "")
                          << (drive.hitOther && !drive.otherAvoidable ? " (not avoidable)" : "")
                          << (drive.stands ? "" : ", rolls") << ", " << formatNumber(drive.impactSpeed) << " m/s "
                          << drive.brokenLimit << " (" << drive.message << ")" << std::endl;
            if ((line.given("verbose") || !one.good()) && line.given("events"))
                for (const std::string &event : drive.events)
                    std::cerr << "    " << event << std::endl;
        }
        std::cout << tableOf(rows);
        return std::all_of(rows.begin(), rows.end(), [](const Row &row) { return row.good(); }) ? 0 : 1;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("troubled_drives", argc, argv, run);
}
