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
        std::string experiment;   ///< its name
        std::string planner;      ///< what results call the planner, see PlannerSpec::name
        std::size_t run{0};       ///< number of the run, from 0
        std::uint32_t seed{0};    ///< of the run's random numbers
        std::string fingerprint;  ///< of everything that it depends on; see ResultStore

        // How it ended.
        std::optional<PlanStatus> outcome;  ///< exact, approximate, or why there is no path
        std::string reason;                 ///< one line on why there is no solution; empty where nobody tells
        std::optional<bool> success,        ///< see isSuccess()
            late;                           ///< the first solution came more than 0.05 s after the limit
        // What it took.
        std::optional<double> firstSolutionTime,     ///< seconds until the first exact solution, loading not included
            planningTime,                            ///< seconds of the planner, loading not included
            cpuTime,                                 ///< seconds of processor time of all threads, loading included
            mapLoadingTime,                          ///< seconds for obstacles and distance field
            peakMemory;                              ///< MB by which the process grew at most while the planner worked
        std::optional<std::uint64_t> nodesExpanded,  ///< of OMPL's planners: vertices of their graph
            motionsGenerated,                        ///< of OMPL's planners: edges of their graph
            statesChecked,                           ///< poses, those along motions included
            exactChecks,                             ///< of these, those that took the exact test
            openListOperations,                      ///< entries pushed and popped; of improved A* only
            openListComparisons;                     ///< of entries with each other; of improved A* only
        // The path.
        std::optional<double> pathLength,    ///< metres, as it is driven
            leastClearance,                  ///< metres between body (or disc) and obstacles along the path
            distanceToGoal;                  ///< metres from the end of the path to the nearest goal
        std::optional<std::uint64_t> cusps,  ///< changes of direction
            denseCollisions;                 ///< poses that collide when the path is checked once more
        std::optional<bool> denselyValid;    ///< what that check says
        // How it is shaped, and how far the obstacles are.
        std::optional<bool> attainsGoal;        ///< it ends within 1 cm (in x and in y) and 1 degree of a goal
        std::optional<double> angleOverLength,  ///< rad/m, see PathShape
            maxCurvature,                       ///< 1/m, see PathShape
            normalizedCurvature,                ///< radians, see PathShape
            smoothness,                         ///< 1/m^2, see PathShape
            reverseShare,                       ///< of the length
            meanClearance,                      ///< metres, see clearanceAlong()
            medianClearance;                    ///< metres, likewise
        // Driven from cusp to cusp as fast as the car can, with steering that is there at once.
        std::optional<double> profileTime,  ///< seconds
            profileCost,                    ///< TPCAP's J
            profileJerk,                    ///< m/s^3, mean of the absolute value
            standingSteeringTime;           ///< seconds in which the wheels turn at standstill; not in profileTime
        std::optional<std::uint64_t> standingSteerings;  ///< places where the curvature jumps
        // The same path after OMPL's simplification.
        std::optional<double> simplificationTime,      ///< seconds
            simplifiedLength,                          ///< metres
            simplifiedClearance;                       ///< metres
        std::optional<std::uint64_t> simplifiedCusps,  ///< changes of direction
            simplifiedDenseCollisions;                 ///< poses that collide when it is checked once more
        std::optional<bool> simplifiedDenselyValid;    ///< what that check says
        // The drive along it.
        std::optional<bool> drivenToTheEnd;              ///< did the controller get there?
        std::optional<double> travelTime,                ///< seconds
            drivenLength,                                ///< metres, both directions counted positive
            meanAcceleration,                            ///< m/s^2, mean of the absolute value
            meanSteeringAngle,                           ///< degrees, mean of the absolute value
            greatestPositionError,                       ///< metres from the path
            finalPositionError,                          ///< metres between the ends of drive and path
            finalYawError,                               ///< radians between the ends of drive and path
            medianMpcTime;                               ///< seconds, of a step of the controller
        std::optional<std::uint64_t> drivingCollisions;  ///< poses of the drive that collide
        std::optional<bool> driveAttainsGoal;            ///< it ends as near to a goal as attainsGoal asks
        std::optional<double> driveCollidingFrames,      ///< share of the frames, one a millisecond
            driveStandingTime,                           ///< seconds at less than 1 mm/s
            driveJerk;                                   ///< m/s^3, mean of the absolute value
        // The quickest trajectory near it.
        std::optional<double> trajectoryDuration,            ///< seconds to drive it
            trajectoryCost,                                  ///< TPCAP's J, see TpcapCost
            controlEffort,                                   ///< integral of a^2 + (v w)^2, in SI units
            steeringIntegral,                                ///< rad^2 s, integral of the squared steering angle
            trajectoryTime;                                  ///< seconds of processor time that optimising it took
        std::optional<std::uint64_t> trajectoryGearChanges;  ///< changes of direction
        std::optional<bool> trajectoryStopsToSteer,       ///< nothing better was found than the path with standstills
            trajectoryAttainsGoal;                        ///< it ends as near to a goal as attainsGoal asks
        std::optional<double> trajectoryCollidingFrames,  ///< share of the frames, one a millisecond
            trajectoryStandingTime,                       ///< seconds at less than 1 mm/s
            trajectoryJerk;                               ///< m/s^3, mean of the absolute value
        // What ompl::tools::Benchmark measures itself.
        std::optional<double> time,                                   ///< seconds of solve()
            memory,                                                   ///< MB, of the process
            validSegmentFraction;                                     ///< share of the motions found free
        std::optional<ompl::base::PlannerStatus::StatusType> status;  ///< what solve() returned
        std::optional<bool> solved,                                   ///< the planner calls its solution exact
            approximateSolution,                                      ///< the planner calls its solution approximate
            correctSolution,                                          ///< the path passes OMPL's check
            correctSolutionStrict;                                    ///< the path passes OMPL's stricter check
        std::optional<double> solutionLength,                         ///< metres, by the space's distances
            solutionDifference,                                       ///< what an approximate solution lacks
            solutionClearance,                                        ///< metres, mean over the path's states
            solutionSmoothness;                                       ///< of the path's states, as OMPL defines it
        std::optional<std::uint64_t> solutionSegments,                ///< motions of the path
            graphStates,                                              ///< vertices of the planner's graph
            graphMotions;                                             ///< edges of the planner's graph

        /** What the planner tells of itself and nobody can know beforehand, by its own names without types. */
        std::map<std::string, FigureValue> reported;
        /** Of the planner, by OMPL's names. */
        std::map<std::string, std::string> parameters;
        std::vector<Improvement> progress;  ///< each better solution, in order of time
        bool hasPath{false};                ///< is there a path, exact or not?
        bool exact{false};                  ///< does the planner say that it ends at a goal?
        Path path;                          ///< in local coordinates

        /** \brief Exact, valid when checked once more, and in time. */
        bool isSuccess() const
        {
            return success.value_or(false);
        }

        /** \brief As a line of the file of results; without the members that have no value. */
        nlohmann::json toJson() const;

        /** \brief Throws parking::Error, or an exception of nlohmann's, when \e json is no record. */
        static RunRecord fromJson(const nlohmann::json &json);
    };
}  // namespace parking
