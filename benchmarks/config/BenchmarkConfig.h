#pragma once

#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/PlannerRegistry.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief How the scenarios of a comparison are put to its planners: the section [problem] of a .cfg file. */
    struct ProblemOptions
    {
        std::string name;            ///< instead of the scenario's; with a single scenario only
        std::string vehicle;         ///< name or file; empty: the scenario's
        ProblemSettings settings;    ///< in which terms planners are asked
        std::optional<Pose> start,   ///< instead of the scenario's, in the coordinates of its file
            goal;                    ///< likewise; instead of all its goals and its slot
        std::optional<double> minX,  ///< metres, of the rear axle, likewise; within the scenario's own bounds
            minY,                    ///< likewise
            maxX,                    ///< likewise
            maxY;                    ///< likewise
        std::string sampler;         ///< of valid states: empty, uniform, gaussian, obstacle_based or bridge_test
    };

    /** \brief One planner of a comparison, with its parameters. */
    struct PlannerSpec
    {
        std::string name;               ///< what results call it; unique
        std::string planner;            ///< of the registry
        PlannerSettings settings;       ///< set on every instance, after those of the registry
        ProblemOptions problem;         ///< that of the comparison, with what is set for this planner alone
        std::vector<std::string> only;  ///< patterns of the names of the scenarios that it is run on; empty: all
        /** "FILE:LINE: " of each of its keys, without the planner's name before them; "" for where it is added. */
        std::map<std::string, std::string> lines{};
    };

    /** \brief Which paths are written to files of their own. */
    enum class SavePaths
    {
        None,      ///< no path
        Shortest,  ///< of each planner on each problem
        All        ///< every path
    };

    /** \brief A comparison, as a .cfg file describes it (see docs/benchmark-reference.md). */
    struct BenchmarkConfig
    {
        std::string file;                    ///< that it was read from
        std::vector<std::string> scenarios;  ///< files, in the order given; those of a pattern or folder sorted
        std::map<std::string, std::string> scenarioLines;  ///< by scenario: "FILE:LINE: " where it is named
        double timeLimit{5.0};                             ///< seconds per run
        double memoryLimit{4096.0};                        ///< MB
        std::size_t runCount{10};                          ///< runs of each planner on each experiment
        std::string output;                                ///< folder; empty: the caller chooses
        SavePaths savePaths{SavePaths::None};              ///< which paths are written to files of their own
        std::uint_fast32_t seed{1};         ///< of the comparison; every run has its own from it, see seedOf()
        bool processorTime{false};          ///< limit and measure processor time instead of that of the wall clock
        bool simplify{false};               ///< let OMPL simplify each path, too, and report that beside it
        bool track{false};                  ///< drive each path with the controller
        bool trajectory{false};             ///< optimise each path in time
        std::vector<PlannerSpec> planners;  ///< in the order of the file
        std::map<std::string, std::string>
            problemLines{};  ///< "FILE:LINE: " of the keys of [problem], as "problem.KEY"

        /** \brief "FILE:LINE: " where a scenario is named, with which messages about it begin; empty when it is not. */
        std::string lineOf(const std::string &scenario) const
        {
            const auto line = scenarioLines.find(scenario);
            return line == scenarioLines.end() ? "" : line->second;
        }

        /** \brief "FILE:LINE: " of the first of these keys that is set, those of the planner alone before those of all;
            of where the planner is added when none of them is. */
        std::string lineOf(const PlannerSpec &planner, const std::vector<std::string> &keys) const;
    };

    /** \brief Reads a .cfg file like those of OMPL.app's ompl_benchmark: sections [problem], [benchmark] and [planner].

        Throws parking::Error naming file and line: for a section, key or planner that is not known with the nearest
        known one, for a value out of range with what would be right, for a key that is given twice, and for settings
        that do not go together. Parameters of planners are checked when the planner is made. */
    BenchmarkConfig readBenchmarkConfig(const std::string &file, const PlannerRegistry &registry);

    /** \brief Keeps only the planners of these names. Throws parking::Error for one that \e config has not. */
    void selectPlanners(BenchmarkConfig &config, const std::vector<std::string> &names);

    /** \brief The scenario files that a name stands for: the file itself, those of a folder that are scenarios, or
        those that match a pattern with * or ?. Relative names are looked up in \e folder. Throws parking::Error when
        there is none. */
    std::vector<std::string> findScenarios(const std::string &name, const std::string &folder);
}  // namespace parking
