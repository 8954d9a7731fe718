#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Degrees of the curves through control points. */
    enum SplineDegree : std::size_t
    {
        POLYLINE = 1,  ///< straight lines between the control points
        BSPLINE = 3,   ///< the paper's section "B-spline Curve": uniform knots, clamped at both ends
        BEZIER = 1000  ///< the paper's section "Bezier Curve": one polynomial for all control points
    };

    /** \brief The curve that the paper lays through the joined path of A* and manoeuvre: every \e sampling -th point of
        the polyline, and its last one, is a control point.

        As in the paper, the curve is checked neither for collisions nor for curvature; bsplineSmooth() checks both.

        \param points metres, at least one
        \param degree at least 1; reduced to what the control points allow
        \param sampling at least 1
        \param step maximum distance in metres between points of the result
        \return points along the curve, from the first one given to the last. */
    std::vector<Eigen::Vector2d> splineThrough(const std::vector<Eigen::Vector2d> &points, std::size_t degree,
                                               std::size_t sampling, double step);

    /** \brief Metres along points. */
    double lengthOf(const std::vector<Eigen::Vector2d> &points);

    /** \brief Radians that the line through the points turns in total, without turns of more than \e most, which are
        cusps. */
    double turningOf(const std::vector<Eigen::Vector2d> &points, double most);
}  // namespace parking
