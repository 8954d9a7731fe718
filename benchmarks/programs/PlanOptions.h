#pragma once

#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/problems/Problem.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The command line of parking_plan. */
    struct PlanOptions
    {
        bool help{false};
        std::string scenario;
        std::string planner{"improved_astar"};
        std::string vehicle;  ///< name or file; empty: the scenario's
        PlannerSettings settings;
        std::optional<SpaceKind> space;  ///< without it: what the planner asks for
        std::optional<FootprintKind> footprint;
        double circleRadius{0.0};
        double timeLimit{5.0};
        std::size_t runs{1};
        std::uint_fast32_t seed{1};
        bool trajectory{false};
        bool track{false};
        std::string json;  ///< file, "-" for standard output, empty for none
        std::string svg;
        std::string csv;   ///< with trajectory only
        std::string html;  ///< with track only
        std::vector<std::string> plugins;
    };

    /** \brief Reads a command line (without the program's name). Throws parking::Error with one line saying what is
        wrong. */
    PlanOptions readPlanOptions(const std::vector<std::string> &arguments);

    /** \brief The text of --help. */
    std::string planHelp(const PlannerRegistry &registry);
}  // namespace parking
