#pragma once

#include "automatic_parking/perception/DriveHistory.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>

namespace parking
{
    /** \brief What driveAnimation() shows in addition to the drive. */
    struct DriveDetails
    {
        std::string subtitle;  ///< plain text
        /** The trajectory that the drive follows, in the coordinates of the scenario: dashed on the map and in the
            plots. May be empty. */
        Trajectory reference;
        /** What the car has seen and planned on the way; times as in the drive. The page shows unseen ground, seen
            obstacles and the latest plan at each moment. May be empty. */
        DriveHistory history;
    };

    /** \brief An HTML page that shows the drive: a single file without network access or external scripts.

        It contains the map with the planned path, and the car with its steered wheels, lights and track. The drive
       plays once, except for readers who prefer reduced motion. Buttons, a slider and the keys space and arrows play,
       pause and speed it up. Speed, acceleration and steering are plotted over time with a cursor. The page follows the
        reader's light or dark theme.

        \param planned not drawn without pieces, or if the history has plans
        \param driven a drive in the coordinates of \e scenario, times not decreasing
        \param title plain text
        Throws parking::Error for a drive of fewer than two points or with a number that is not finite. */
    std::string driveAnimation(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                               const std::string &title, const DriveDetails &details = {});

    /** \brief Writes driveAnimation() to \e file atomically. Throws parking::Error naming the file. */
    void writeDriveAnimation(const std::string &file, const Scenario &scenario, const Path &planned,
                             const Trajectory &driven, const std::string &title, const DriveDetails &details = {});
}  // namespace parking
