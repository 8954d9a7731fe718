#pragma once

#include "benchmarks/planners/SolveRecord.h"
#include "benchmarks/problems/PlanRun.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace parking
{
    /** \brief A figure of a run, of any type that OMPL's logs know; enumerations are whole numbers here. */
    using FigureValue = std::variant<bool, std::int64_t, double>;

    /** \brief Everything that is kept of one run: a line in the file of results, a row in the database.

        A figure without a value was not measured. Each has a row in runColumns() that says its name, unit and meaning,
        and by which it goes to files and back: whoever adds a figure adds a member here and a row there. */
    struct RunRecord
    {
        std::string experiment;
        std::string planner;
        std::size_t run{0};
        std::uint32_t seed{0};
        std::string fingerprint;  ///< of everything that it depends on; see ResultStore

        // How it ended.
        std::optional<PlanStatus> outcome;
        std::string reason;  ///< one line on why there is no solution; empty where nobody tells
        std::optional<bool> success, late;
        // What it took.
        std::optional<double> firstSolutionTime, planningTime, cpuTime, mapLoadingTime, peakMemory;
        std::optional<std::uint64_t> nodesExpanded, motionsGenerated, statesChecked, exactChecks;
        // The path.
        std::optional<double> pathLength, leastClearance, distanceToGoal;
        std::optional<std::uint64_t> cusps, denseCollisions;
        std::optional<bool> denselyValid;
        // How it is shaped, and how far the obstacles are.
        std::optional<bool> attainsGoal;
        std::optional<double> angleOverLength, maxCurvature, normalizedCurvature, smoothness, reverseShare,
            meanClearance, medianClearance;
        // Driven from cusp to cusp as fast as the car can, with steering that is there at once.
        std::optional<double> profileTime, profileCost, profileJerk, standingSteeringTime;
        std::optional<std::uint64_t> standingSteerings;
        // The same path after OMPL's simplification.
        std::optional<double> simplificationTime, simplifiedLength, simplifiedClearance;
        std::optional<std::uint64_t> simplifiedCusps, simplifiedDenseCollisions;
        std::optional<bool> simplifiedDenselyValid;
        // The drive along it.
        std::optional<bool> drivenToTheEnd;
        std::optional<double> travelTime, drivenLength, meanAcceleration, meanSteeringAngle, greatestPositionError,
            finalPositionError, finalYawError, medianMpcTime;
        std::optional<std::uint64_t> drivingCollisions;
        std::optional<bool> driveAttainsGoal;
        std::optional<double> driveCollidingFrames, driveStandingTime, driveJerk;
        // The quickest trajectory near it.
        std::optional<double> trajectoryDuration, trajectoryCost, controlEffort, steeringIntegral, trajectoryTime;
        std::optional<std::uint64_t> trajectoryGearChanges;
        std::optional<bool> trajectoryStopsToSteer, trajectoryAttainsGoal;
        std::optional<double> trajectoryCollidingFrames, trajectoryStandingTime, trajectoryJerk;
        // What ompl::tools::Benchmark measures itself.
        std::optional<double> time, memory, validSegmentFraction;
        std::optional<ompl::base::PlannerStatus::StatusType> status;
        std::optional<bool> solved, approximateSolution, correctSolution, correctSolutionStrict;
        std::optional<double> solutionLength, solutionDifference, solutionClearance, solutionSmoothness;
        std::optional<std::uint64_t> solutionSegments, graphStates, graphMotions;

        /** What the planner tells of itself and nobody can know beforehand, by its own names without types. */
        std::map<std::string, FigureValue> reported;
        /** Of the planner, by OMPL's names. */
        std::map<std::string, std::string> parameters;
        std::vector<Improvement> progress;
        bool hasPath{false};
        bool exact{false};
        Path path;  ///< in local coordinates

        /** \brief Exact, valid when checked once more, and in time. */
        bool isSuccess() const
        {
            return success.value_or(false);
        }

        nlohmann::json toJson() const;

        /** \brief Throws parking::Error, or an exception of nlohmann's, when \e json is no record. */
        static RunRecord fromJson(const nlohmann::json &json);
    };
}  // namespace parking
