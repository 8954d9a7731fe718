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

    /** \brief The paper's curve along the joined path of A* and manoeuvre: every \e sampling -th point of the polyline,
        and its last one, is a control point.

        As in the paper, the curve is checked neither for collisions nor for curvature; bsplineSmooth() checks both.

        \param points metres, at least one
        \param degree at least 1; reduced to the number of control points
        \param sampling at least 1
        \param step maximum distance in metres between points of the result
        \return points along the curve, from the first given point to the last. */
    std::vector<Eigen::Vector2d> splineThrough(const std::vector<Eigen::Vector2d> &points, std::size_t degree,
                                               std::size_t sampling, double step);

    /** \brief Length of the line through points in metres. */
    double lengthOf(const std::vector<Eigen::Vector2d> &points);

    /** \brief Sum of the turns of the line through the points in radians, without turns above \e max, which are
        cusps. */
    double turningOf(const std::vector<Eigen::Vector2d> &points, double max);
}  // namespace parking
