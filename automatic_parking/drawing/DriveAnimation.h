#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>

namespace parking
{
    /** \brief A page that shows the car parking: an HTML file that needs nothing else, neither network nor scripts from
        elsewhere.

        The map with the planned path, the car with its wheels turning, its lights and the track behind it; buttons to
        play, to pause and to go faster, a slider, the keys space and arrows; speed, acceleration and steering over time
        with a cursor.

        \param planned may be without pieces: not drawn then
        \param driven a drive in the coordinates of \e scenario, times not decreasing
        \param title,subtitle plain text
        \param reference the trajectory that the drive was to follow, in the coordinates of \e scenario: dashed on the
       map and beside what was driven over time; may be empty Throws parking::Error for a drive of fewer than two points
       or with a number that is not finite. */
    std::string driveAnimation(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                               const std::string &title, const std::string &subtitle = {},
                               const Trajectory &reference = {});

    /** \brief Writes driveAnimation() to \e file, whole or not at all. Throws parking::Error naming the file, too. */
    void writeDriveAnimation(const std::string &file, const Scenario &scenario, const Path &planned,
                             const Trajectory &driven, const std::string &title, const std::string &subtitle = {});
}  // namespace parking
