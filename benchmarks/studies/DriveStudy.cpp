#include "benchmarks/studies/DriveStudy.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"

#include <iostream>
#include <utility>

namespace parking
{
    namespace po = boost::program_options;

    DriveStudy::DriveStudy(std::string program, std::string purpose)
      : program_(std::move(program)),
        purpose_(std::move(purpose))
    {
        auto add = options_.add_options();
        add("stop-and-steer", "drive the paths with standstills, not optimised trajectories");
        add("acceleration-share", oneValue("X"), "of the car's acceleration that trajectories use");
        add("brake-reserve", oneValue("X"), "share of the brake that is not counted on");
        add("steering-rate-share", oneValue("X"), "of the car's steering rate that trajectories use");
        add("steering-share", oneValue("X"), "of its steering angle");
        add("nearness", oneValue("X"), "seconds that a metre in touch with obstacles is worth");
        add("kept", oneValue("M"), "metres that trajectories prefer to keep from obstacles");
        add("least", oneValue("M"), "metres that they do keep where the plan does");
        add("clearance-share", oneValue("X"), "of the plan's clearance that they keep in any case");
        add("no-smoothing", "drive the planner's arcs as they are");
        add("help", "this text");
    }

    std::optional<CommandLine> DriveStudy::read(const std::vector<std::string> &arguments) const
    {
        po::options_description all;
        all.add(options_).add_options()("scenario", po::value<std::vector<std::string>>());
        CommandLine line(arguments, all, po::positional_options_description().add("scenario", -1));
        if (line.given("help"))
        {
            std::cout << "usage: " << program_ << " SCENARIO... [options]\n\n" << purpose_ << "\n\n" << options_;
            return std::nullopt;
        }
        if (!line.given("scenario"))
            throw Error("no scenario given (see --help)");
        return line;
    }

    std::vector<Scenario> DriveStudy::scenarios(const CommandLine &line)
    {
        std::vector<Scenario> scenarios;
        for (const std::string &file : line.texts("scenario"))
            scenarios.push_back(readScenario(file));
        return scenarios;
    }

    ParkingParameters DriveStudy::parameters(const CommandLine &line)
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
        take("least", parameters.leastClearance);
        take("clearance-share", parameters.clearanceShare);
        parameters.validate();
        return parameters;
    }

    MarkdownTable::MarkdownTable(const std::vector<std::string> &head) : columns_(head.size())
    {
        add(head);
        text_ += "|---|";
        for (std::size_t i = 1; i < columns_; ++i)
            text_ += "--:|";
        text_ += "\n";
    }

    void MarkdownTable::add(const std::vector<std::string> &cells)
    {
        text_ += "|";
        for (std::size_t i = 0; i < columns_; ++i)
            text_ += i < cells.size() ? " " + cells[i] + " |" : " |";
        text_ += "\n";
    }
}  // namespace parking
