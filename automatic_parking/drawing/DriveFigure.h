#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/drawing/SvgFigure.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief The paper's figures of a drive: the map with the planned and the driven path, and below it speed,
        acceleration and steering angle over time, with the car's limits.

        Stretches in reverse are tinted. Coordinates are local ones of \e scenario.
        \param planned may be without pieces: not drawn then \param driven may be empty: no plots then */
    SvgFigure driveFigure(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                          const std::string &title, const std::string &subtitle = {});

    /** \brief Speed, acceleration and steering angle over time, one plot each.

        \param planned what the drive follows, dashed; may be empty */
    std::vector<SvgPlot> drivePlots(const Trajectory &driven, const Vehicle &vehicle, const Trajectory &planned = {});
}  // namespace parking
