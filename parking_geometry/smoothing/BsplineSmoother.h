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
    struct BsplineOptions
    {
        int degree{3};            ///< 2 to 5; less where there are too few points. 3 and more: continuous curvature
        std::size_t sampling{3};  ///< every so many points one becomes a control point, at least 1
        double step{0.1};         ///< metres between the states of the result, at most
        double maxCurvature{std::numeric_limits<double>::infinity()};  ///< 1/m, re-checked with the collisions
    };

    struct BsplinePath
    {
        /** States with the heading and curvature of the curve, direction 1. In pieces that follow the polyline the
            curvature is 0 and the heading that of the edge on which the state is reached. */
        SampledPath path;

        std::size_t pieces{0};          ///< spans of the spline
        std::size_t denserPieces{0};    ///< spans that needed more control points than \e sampling gives
        std::size_t polylinePieces{0};  ///< spans that had to follow the polyline, corners and all
    };

    /** \brief The paper's smoothing of a grid path (section "B-spline Curve"): a clamped uniform B-spline whose control
        points are the first, every \e sampling -th and the last point of the polyline.

        The curve stays within the convex hulls of degree + 1 neighbouring control points, begins and ends at the
        polyline's ends, and may cut corners: see the other form for the check.

        \param points metres; neighbours that coincide are dropped
        Throws parking::Error for fewer than two distinct points and for options out of range. */
    SampledPath bsplineSmooth(const std::vector<Eigen::Vector2d> &points, int degree = 3, std::size_t sampling = 3);

    /** \brief The same, re-checked span by span against the world and the curvature limit.

        A span that fails gets all points of the polyline that lie within its reach as control points, and follows the
        polyline itself there when that is not enough. The polyline is taken to have been checked by who planned it. */
    BsplinePath bsplineSmooth(const std::vector<Eigen::Vector2d> &points, const BsplineOptions &options,
                              const Vehicle &vehicle, const FootprintQueries &world);
}  // namespace parking
