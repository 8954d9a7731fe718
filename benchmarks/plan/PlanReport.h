#pragma once

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
    /** \brief All that parking_plan has found out. */
    struct PlanReport
    {
        std::string planner;               ///< name in the registry
        nlohmann::json parameters;         ///< all of the planner's, see parametersJson()
        std::vector<PlanRun> runs;         ///< at least one; the first one's path is the result
        std::optional<DriveResult> drive;  ///< with PlanOptions::track, unless driveError says why not
        std::string driveError;            ///< why the path cannot be driven; empty otherwise
        /** With PlanOptions::trajectory, unless trajectoryError says why not. */
        std::optional<QuickestTrajectory> trajectory;
        Trajectory samples;           ///< of the trajectory; empty if there is none
        std::string trajectoryError;  ///< why there is no trajectory; empty otherwise
        double trajectoryTime{0.0};   ///< seconds of processor time

        /** \brief The run whose path is the result. */
        const PlanRun &first() const
        {
            return runs.front();
        }
    };

    /** \brief All parameters of a planner, with numbers and switches as such. */
    nlohmann::json parametersJson(const ompl::base::Planner &planner);

    /** \brief What parking_plan exits with: 0 for an exact solution, 3 for only an approximate one, 4 for none that the
        referee accepts, and where not all files could be written that were asked for. */
    int exitStatus(const PlanRun &run, bool isAllWritten = true);

    /** \brief For each file that was asked for and that there is nothing to write into, although a path was found: its
        name, and why. */
    std::vector<std::string> missingFiles(const PlanOptions &options, const PlanReport &result);

    /** \brief The result in the format that docs/benchmark-reference.md describes. */
    nlohmann::json resultJson(const Problem &problem, const PlanOptions &options, const PlanReport &result);

    /** \brief The result for a reader in a hurry: a few lines. */
    std::string resultSummary(const Problem &problem, const PlanReport &result);

    /** \brief Map, curvature of the path, and with a trajectory or a drive speed, acceleration and steering angle. The
        car is drawn along its drive, without one along the trajectory, without that along the path. */
    std::string resultSvg(const Problem &problem, const PlanReport &result);

    /** \brief Optimises the path of the first run in time. What cannot be driven is told in the result.

        \param isDriven a controller will drive it: then it keeps what nominal errors of tracking come to (2 cm), where
        the path keeps twice that, and else half of what the path keeps */
    void addTrajectory(const Problem &problem, PlanReport &result, bool isDriven);

    /** \brief The optimised trajectory as a table, in the coordinates of the scenario's file. */
    std::string resultCsv(const Problem &problem, const PlanReport &result);

    /** \brief Drives the trajectory of the first run in closed loop, or its path when none was asked for. What cannot
        be driven is told in the result; so is a trajectory that there should be and is not. */
    void addDrive(const Problem &problem, PlanReport &result);

    /** \brief A page that shows the drive (see driveAnimation()). Throws parking::Error when there is none. */
    std::string resultHtml(const Problem &problem, const PlanReport &result);
}  // namespace parking
