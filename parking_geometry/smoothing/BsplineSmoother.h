#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief How the paper's spline is laid through a grid path. */
    struct BsplineOptions
    {
        int degree{3};            ///< 2 to 5; less where there are too few points. 3 and more: continuous curvature
        std::size_t sampling{3};  ///< every so many points one becomes a control point, at least 1
        double step{0.2};         ///< metres between the poses of the curve that are joined by arcs, at most
        double maxCurvature{std::numeric_limits<double>::infinity()};  ///< 1/m, re-checked with the collisions
    };

    /** \brief The smoothed path, and how often the spline had to give way to obstacles. */
    struct BsplineResult
    {
        /** Forwards. Two arcs each join neighbouring poses of the curve, with its position and heading; spans that
            follow the polyline are straight, with turns on the spot at its corners. */
        Path path;

        std::size_t spans{0};          ///< of the spline
        std::size_t denserSpans{0};    ///< that needed more control points than \e sampling gives
        std::size_t polylineSpans{0};  ///< that had to follow the polyline, corners and all
    };

    /** \brief The paper's smoothing of a grid path (section "B-spline Curve"): a clamped uniform B-spline whose control
        points are the first, every \e sampling -th and the last point of the polyline.

        The curve stays within the convex hulls of degree + 1 neighbouring control points and begins and ends at the
        polyline's ends. It is checked span by span against the world and the curvature limit: a span that fails gets
        all points of the polyline that lie within its reach as control points, and follows the polyline itself there
        when that is not enough. The polyline is taken to have been checked by who planned it.

        \param points metres; neighbours that coincide are dropped
        Throws parking::Error for fewer than two distinct points and for options out of range. */
    BsplineResult bsplineSmooth(const std::vector<Eigen::Vector2d> &points, const BsplineOptions &options = {},
                                const Vehicle &vehicle = {}, const FootprintQueries &world = {});
}  // namespace parking
