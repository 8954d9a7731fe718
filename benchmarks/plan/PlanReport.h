#pragma once

#include "automatic_parking/AutomaticParking.h"
#include "automatic_parking/QuickestTrajectory.h"
#include "benchmarks/plan/PlanOptions.h"
#include "benchmarks/plan/PlanRun.h"
#include "path_tracking/simulation/ClosedLoop.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief All results of parking_plan. */
    struct PlanReport
    {
        std::string planner;                     ///< name in the registry
        nlohmann::json parameters;               ///< all parameters of the planner, see parametersJson()
        std::vector<PlanRun> runs;               ///< at least one run; the path of the first is the result
        std::optional<DriveResult> drive;        ///< the drive, with PlanOptions::track unless driveError is set
        std::optional<ParkingResult> perceived;  ///< the same drive in detail, with PlanOptions::perceive
        std::string driveError;                  ///< reason why the path cannot be driven; otherwise empty
        /** The trajectory, with PlanOptions::trajectory unless trajectoryError is set. */
        std::optional<QuickestTrajectory> trajectory;
        Trajectory samples;           ///< samples of the trajectory; empty without one
        std::string trajectoryError;  ///< reason why there is no trajectory; otherwise empty
        double trajectoryTime{0.0};   ///< processor time of the optimisation in seconds

        /** \brief The run whose path is the result. */
        const PlanRun &first() const
        {
            return runs.front();
        }
    };

    /** \brief All parameters of a planner, with numbers and switches in JSON's types. */
    nlohmann::json parametersJson(const ompl::base::Planner &planner);

    /** \brief Exit status of parking_plan.

        0 for an exact solution, 3 for an approximate one, 4 when the referee accepts no path or a requested file could
        not be written. */
    int exitStatus(const PlanRun &run, bool isAllWritten = true);

    /** \brief Requested files that have no content although a path was found, each with the reason. */
    std::vector<std::string> missingFiles(const PlanOptions &options, const PlanReport &result);

    /** \brief The result in the format that docs/benchmark-reference.md describes. */
    nlohmann::json resultJson(const Problem &problem, const PlanOptions &options, const PlanReport &result);

    /** \brief A summary of the result in a few lines. */
    std::string resultSummary(const Problem &problem, const PlanReport &result);

    /** \brief Picture of the map and of the path's curvature; with a trajectory or drive also speed, acceleration and
        steering angle.

        The car is drawn along the drive, else along the trajectory, else along the path. */
    std::string resultSvg(const Problem &problem, const PlanReport &result);

    /** \brief Optimises the path of the first run in time. The result stores the reason of a failure.

        \param isDriven whether a controller will drive it. Its margin is then the nominal tracking error (2 cm) if the
        path keeps twice that, and else half of the path's clearance */
    void addTrajectory(const Problem &problem, PlanReport &result, bool isDriven);

    /** \brief The optimised trajectory as a table, in the coordinates of the scenario's file. */
    std::string resultCsv(const Problem &problem, const PlanReport &result);

    /** \brief Drives the trajectory of the first run in closed loop, or its path when no trajectory was requested.

        The result stores the reason of a failure, such as a missing trajectory.
        \param perceive sensor of a car that does not know its world and plans on the way; absent for a known world */
    void addDrive(const Problem &problem, PlanReport &result,
                  const std::optional<SensorParameters> &perceive = std::nullopt);

    /** \brief A page that shows the drive (see driveAnimation()). Throws parking::Error without a drive. */
    std::string resultHtml(const Problem &problem, const PlanReport &result);
}  // namespace parking
