#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/drawing/SvgFigure.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief The map of a scenario with the car along \e driven; if that is empty along \e planned, else along \e
        path. The others appear as thin dashed lines, which the legend names.

        \param path,planned,driven in the scenario's coordinates; may be empty */
    SvgMap driveMap(const Scenario &scenario, const SampledPath &path, const Trajectory &planned,
                    const Trajectory &driven);

    /** \brief The paper's figures of a drive. The map shows the car along its drive and the planned path. Plots below
        it show speed, acceleration and steering angle over time, with the car's limits.

        Stretches in reverse are tinted. Coordinates are local ones of \e scenario.
        \param planned not drawn without pieces
        \param driven if empty, there are no plots */
    SvgFigure driveFigure(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                          const std::string &title, const std::string &subtitle = {});

    /** \brief Speed, acceleration and steering angle over time, one plot each.

        \param driven may be empty
        \param planned the trajectory that the drive follows, drawn dashed; may be empty */
    std::vector<SvgPlot> drivePlots(const Trajectory &driven, const Vehicle &vehicle, const Trajectory &planned = {});
}  // namespace parking
