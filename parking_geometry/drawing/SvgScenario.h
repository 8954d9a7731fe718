#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/drawing/SvgMap.h"
#include "parking_geometry/drawing/SvgPlot.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief What a picture of a path should show: the car at all states, at start and goals, and the slot, with some
        metres round them; far obstacles are left out. \param margin metres */
    Box viewAround(const Scenario &scenario, const SampledPath &path = {}, double margin = 3.0);

    /** \brief Draws obstacles, unknown cells, what lies outside of the world, the slot, and the car at its start and
        goals; the map's ticks get the world's coordinates. */
    void drawScenario(SvgMap &map, const Scenario &scenario);

    /** \brief Draws the track of the rear axle and the car along it, forwards and reverse in different colours, with a
        dot at every change of direction. Cars are thinned out so that they stay legible.

        \param what the car goes along, for the legend */
    void drawPath(SvgMap &map, const SampledPath &path, const Vehicle &vehicle, const std::string &what = "path");

    /** \brief Draws a car seen from above; its outer line is its footprint, the dot on it its pose.

        \param label names it in the legend, empty for none \return can it be seen? */
    bool drawCar(SvgMap &map, const Pose &pose, const Vehicle &vehicle, const std::string &colour,
                 const std::string &label = {});

    /** \brief Draws another track, for example what was planned where the car drove otherwise, as a thin line.

        \param dash as in SvgStyle */
    void drawTrack(SvgMap &map, const std::vector<Pose> &poses, const std::string &colour, const std::string &label,
                   const std::string &dash = "5 3");

    /** \brief Curvature over the metres driven, with reverse stretches tinted and the car's limits marked. */
    SvgPlot curvaturePlot(const SampledPath &path, const Vehicle &vehicle);
}  // namespace parking
