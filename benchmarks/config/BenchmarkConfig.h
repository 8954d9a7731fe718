#pragma once

#include "automatic_parking/perception/SimulatedSensor.h"
#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/PlannerRegistry.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Changes to the scenarios of a comparison: the section [problem] of a .cfg file. */
    struct ProblemOptions
    {
        std::string name;                     ///< replaces the scenario's name; with a single scenario only
        std::string vehicle;                  ///< name or file; empty: the scenario's vehicle
        std::optional<double> turningRadius;  ///< replaces the vehicle's in metres, by its steering angle
        bool controls{false};      ///< whether names of planners are those of planners with controls, if there are such
        ProblemSettings settings;  ///< state space and footprint of the planning problem
        std::optional<Pose> start,   ///< replaces the scenario's start, in the coordinates of its file
            goal;                    ///< replaces all goals and the slot of the scenario
        std::optional<double> minX,  ///< lower bound of the rear axle's x in metres, within the scenario's bounds
            minY,                    ///< lower bound of the rear axle's y in metres, within the scenario's bounds
            maxX,                    ///< upper bound of the rear axle's x in metres, within the scenario's bounds
            maxY;                    ///< upper bound of the rear axle's y in metres, within the scenario's bounds
        std::string sampler;  ///< sampler of valid states: empty, uniform, gaussian, obstacle_based, bridge_test or
                              ///< max_clearance
    };

    /** \brief One planner of a comparison, with its parameters. */
    struct PlannerSpec
    {
        std::string name;               ///< unique name in the results
        std::string planner;            ///< name in the registry
        PlannerSettings settings;       ///< parameters set on every instance, after those of the registry
        ProblemOptions problem;         ///< problem of the comparison with the changes for this planner
        std::vector<std::string> only;  ///< patterns of scenario names that the planner runs on; empty: all scenarios
        /** "FILE:LINE: " by key without the planner's name; the key "" is the line that adds the planner. */
        std::map<std::string, std::string> lines{};
    };

    /** \brief Selects the paths that are written to separate files. */
    enum class SavePaths
    {
        None,      ///< no path
        Shortest,  ///< the shortest path of each planner on each problem
        All        ///< every path
    };

    /** \brief A comparison as described by a .cfg file (see docs/benchmark-reference.md). */
    struct BenchmarkConfig
    {
        std::string file;                    ///< name of the .cfg file
        std::vector<std::string> scenarios;  ///< files in the order given; those of a pattern or folder sorted
        std::map<std::string, std::string> scenarioLines;  ///< by scenario: "FILE:LINE: " of its line
        double timeLimit{5.0};                             ///< limit of each run in seconds
        double memoryLimit{4096.0};                        ///< limit of each isolated run in MB
        std::size_t runCount{10};                          ///< number of runs of each planner on each experiment
        std::string output;                                ///< output folder; empty: chosen by the caller
        SavePaths savePaths{SavePaths::None};              ///< selects the paths that are written to separate files
        std::uint_fast32_t seed{1};  ///< seed of the comparison, from which seedOf() derives that of each run
        bool processorTime{false};   ///< whether processor time is limited and measured instead of wall-clock time
        bool simplify{false};        ///< whether OMPL also simplifies each path, reported in columns of its own
        bool track{false};           ///< whether the controller drives each path
        bool trajectory{false};      ///< whether each path is optimised in time
        /** The sensor of further drives by the whole pipeline, in which the car knows only what it has seen. */
        std::optional<SensorParameters> perceive{};
        std::vector<PlannerSpec> planners;  ///< planners in the order of the file
        std::map<std::string, std::string>
            problemLines{};  ///< "FILE:LINE: " of the keys of [problem], by "problem.KEY"

        /** \brief "FILE:LINE: " of a scenario, the beginning of messages about it; empty when unknown. */
        std::string lineOf(const std::string &scenario) const
        {
            const auto line = scenarioLines.find(scenario);
            return line == scenarioLines.end() ? "" : line->second;
        }

        /** \brief "FILE:LINE: " of the first of these keys that is set: keys of the planner first, then common keys.
            Falls back to the line that adds the planner. */
        std::string lineOf(const PlannerSpec &planner, const std::vector<std::string> &keys) const;
    };

    /** \brief Reads a .cfg file like those of OMPL.app's ompl_benchmark: sections [problem], [benchmark] and [planner].

        A file of OMPL.app names meshes instead of a scenario. Its scenario is the file of the same name with the
        extension .yaml, written by parking_convert.

        Throws parking::Error naming file and line. Reasons are an unknown section, key or planner (with the nearest
        known one), or a value out of range (with the valid range). Others are a key given twice and incompatible
       settings. Parameters of planners are checked when the planner is created. */
    BenchmarkConfig readBenchmarkConfig(const std::string &file, const PlannerRegistry &registry);

    /** \brief Keeps only the planners of these names. Throws parking::Error for a name that \e config does not
        contain. */
    void selectPlanners(BenchmarkConfig &config, const std::vector<std::string> &names);

    /** \brief The scenario files of a name: the file itself, the scenarios in a folder, or the matches of a pattern
        with * or ?.
        Relative names are resolved in \e folder.
        Throws parking::Error when there are none. */
    std::vector<std::string> findScenarios(const std::string &name, const std::string &folder);
}  // namespace parking
