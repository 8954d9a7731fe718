#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/drawing/SvgFigure.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief The map of a scenario with the car along what is known best of its way: along \e driven, without it along
        \e planned, without that along \e path. The others are drawn beside it as thin broken lines; the legend says
        which is which.

        \param path,planned,driven in the scenario's coordinates; may be empty */
    SvgMap driveMap(const Scenario &scenario, const SampledPath &path, const Trajectory &planned,
                    const Trajectory &driven);

    /** \brief The paper's figures of a drive: the map with the car along its drive and the planned path beside it, and
        below it speed, acceleration and steering angle over time, with the car's limits.

        Stretches in reverse are tinted. Coordinates are local ones of \e scenario.
        \param planned may be without pieces: not drawn then \param driven may be empty: no plots then */
    SvgFigure driveFigure(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                          const std::string &title, const std::string &subtitle = {});

    /** \brief Speed, acceleration and steering angle over time, one plot each.

        \param driven may be empty \param planned what the drive follows, dashed beside it; may be empty */
    std::vector<SvgPlot> drivePlots(const Trajectory &driven, const Vehicle &vehicle, const Trajectory &planned = {});
}  // namespace parking
