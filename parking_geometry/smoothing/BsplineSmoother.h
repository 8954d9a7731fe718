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
    /** \brief Options of bsplineSmooth(). */
    struct BsplineOptions
    {
        int degree{3};            ///< degree from 2 to 5, reduced for few points; continuous curvature from 3
        std::size_t sampling{3};  ///< distance between control points in points of the polyline, at least 1
        double step{0.2};         ///< largest distance between poses of the curve that arcs join, metres
        double maxCurvature{std::numeric_limits<double>::infinity()};  ///< curvature limit, 1/m
    };

    /** \brief The smoothed path and statistics of the spline. */
    struct BsplineResult
    {
        /** Path driven forwards. Two arcs join neighbouring poses of the curve. Spans that follow the polyline are
            straight, with turns on the spot at its corners. */
        Path path;

        std::size_t spans{0};          ///< number of spans of the spline
        std::size_t denserSpans{0};    ///< number of spans with more control points than \e sampling gives
        std::size_t polylineSpans{0};  ///< number of spans that follow the polyline with its corners
    };

    /** \brief Smooths a grid path like the paper (section "B-spline Curve"), by a clamped uniform B-spline.

        Its control points are the first, every \e sampling -th and the last point of the polyline. The curve begins and
        ends at the polyline's ends and stays within the convex hulls of degree + 1 neighbouring control points.

        The function checks each span against the world and the curvature limit. A span that fails gets all points of
        the polyline within its reach as control points. If it fails again, it follows the polyline, which the function
        does not check.

        \param points metres; coincident neighbours are dropped
        Throws parking::Error for fewer than two distinct points and for options out of range. */
    BsplineResult bsplineSmooth(const std::vector<Eigen::Vector2d> &points, const BsplineOptions &options = {},
                                const Vehicle &vehicle = {}, const FootprintQueries &world = {});
}  // namespace parking
