#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/drawing/SvgMap.h"
#include "parking_geometry/drawing/SvgPlot.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief A suitable view for a path: contains the car at all states, at the start and the goals, and the slot.

        \param margin metres between these shapes and the edge of the view */
    Box viewAround(const Scenario &scenario, const SampledPath &path = {}, double margin = 3.0);

    /** \brief Draws obstacles, unknown cells, the outside of the world, the slot, and the car at its start and goals.
        Labels the ticks with world coordinates. */
    void drawScenario(SvgMap &map, const Scenario &scenario);

    /** \brief Draws the track of the rear axle and footprints along it, with one colour per direction and a dot at
        every change of direction.

        \param what name of the track in the legend */
    void drawPath(SvgMap &map, const SampledPath &path, const Vehicle &vehicle, const std::string &what = "path");

    /** \brief As drawPath(), for a disc instead of the car. \param radius metres */
    void drawDiscPath(SvgMap &map, const SampledPath &path, double radius);

    /** \brief Draws a car from above. Its outline is the footprint, the dot is the pose.

        \param label entry in the legend, empty for none
        \return whether the car is visible */
    bool drawCar(SvgMap &map, const Pose &pose, const Vehicle &vehicle, const std::string &colour,
                 const std::string &label = {});

    /** \brief Draws another track as a thin line, for example the planned path of a driven car. \param dash as in
        SvgStyle */
    void drawTrack(SvgMap &map, const std::vector<Pose> &poses, const std::string &colour, const std::string &label,
                   const std::string &dash = "5 3");

    /** \brief A plot of the curvature over the driven length. Reverse stretches are tinted and the car's limits are
        marked. */
    SvgPlot curvaturePlot(const SampledPath &path, const Vehicle &vehicle);
}  // namespace parking
