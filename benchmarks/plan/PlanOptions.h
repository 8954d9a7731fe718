#pragma once

#include "automatic_parking/perception/SimulatedSensor.h"
#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/PlannerRegistry.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The command line of parking_plan. */
    struct PlanOptions
    {
        bool help{false};                        ///< print the text of --help; only plugins is read, too
        std::string scenario;                    ///< file
        std::string planner{"improved_astar"};   ///< name of a planner in the registry or in a plug-in
        std::string vehicle;                     ///< name or file; empty: the scenario's
        PlannerSettings settings;                ///< parameters of the planner
        std::optional<SpaceKind> space;          ///< state space; default: the planner's preference
        std::optional<FootprintKind> footprint;  ///< footprint; default: the planner's preference
        double circleRadius{0.0};                ///< radius in metres; 0: half of the car's width
        double timeLimit{5.0};                   ///< limit of each run in seconds
        std::size_t runs{1};                     ///< number of runs; the first run's path is the result
        std::uint_fast32_t seed{1};              ///< seed of the first run; each further run has the next number
        bool trajectory{false};                  ///< whether to optimise the path in time
        bool track{false};                       ///< whether to drive the trajectory, or the path without one
        /** With `track` only: the sensor of a car that does not know its world. The whole pipeline then drives. */
        std::optional<SensorParameters> perceive;
        std::string json;                  ///< JSON file; "-": standard output, empty: none
        std::string svg;                   ///< picture; empty: none
        std::string csv;                   ///< table of the trajectory, with `trajectory` only; empty: none
        std::string html;                  ///< page of the drive, with `track` only; empty: none
        std::vector<std::string> plugins;  ///< libraries whose planners are loaded

        /** \brief All files that the options write. */
        std::vector<std::string> outputFiles() const;
        /** \brief All files that the options read. */
        std::vector<std::string> inputFiles() const;
    };

    /** \brief Reads a command line without the program's name. Throws parking::Error with a one-line reason. */
    PlanOptions readPlanOptions(const std::vector<std::string> &arguments);

    /** \brief The text of --help. */
    std::string planHelp(const PlannerRegistry &registry);
}  // namespace parking
