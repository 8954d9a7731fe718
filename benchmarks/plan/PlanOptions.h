#pragma once

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
        bool help{false};                        ///< print the text of --help; all else but plugins is left out then
        std::string scenario;                    ///< file
        std::string planner{"improved_astar"};   ///< a name of the registry, or of a plug-in's planner
        std::string vehicle;                     ///< name or file; empty: the scenario's
        PlannerSettings settings;                ///< parameters of the planner
        std::optional<SpaceKind> space;          ///< without it: what the planner asks for
        std::optional<FootprintKind> footprint;  ///< likewise
        double circleRadius{0.0};                ///< metres; 0: half of the car's width
        double timeLimit{5.0};                   ///< seconds for each run
        std::size_t runs{1};                     ///< how often to plan; the first run's path is the result
        std::uint_fast32_t seed{1};        ///< of the first run's random numbers; every further run has the next one
        bool trajectory{false};            ///< optimise the path in time
        bool track{false};                 ///< drive the trajectory, or without one the path
        std::string json;                  ///< file, "-" for standard output, empty for none
        std::string svg;                   ///< file, empty for none
        std::string csv;                   ///< with trajectory only
        std::string html;                  ///< with track only
        std::vector<std::string> plugins;  ///< libraries with planners, to be loaded

        /** \brief The files to write. */
        std::vector<std::string> outputFiles() const;
        /** \brief The files to read, as far as the command line names them. */
        std::vector<std::string> inputFiles() const;
    };

    /** \brief Reads a command line (without the program's name). Throws parking::Error with one line saying what is
        wrong. */
    PlanOptions readPlanOptions(const std::vector<std::string> &arguments);

    /** \brief The text of --help. */
    std::string planHelp(const PlannerRegistry &registry);
}  // namespace parking
