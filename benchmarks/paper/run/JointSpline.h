#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The paper's two curves (sections "Bezier Curve" and "B-spline Curve"). */
    enum class SplineKind
    {
        None,     ///< the polyline itself
        Bspline,  ///< cubic, uniform knots, clamped at both ends
        Bezier    ///< one curve of as high a degree as there are control points
    };

    /** \brief Of none, bspline or bezier. Throws parking::Error listing these for another name. */
    SplineKind splineByName(const std::string &name);

    /** \brief The curve that the paper lays through the joined path of A* and manoeuvre: every \e sampling -th point of
        the polyline, and its last one, is a control point.

        As the paper has it, nobody asks whether the curve is free or how sharply it turns; bsplineSmooth() does.

        \param points metres, at least one
        \param sampling at least 1
        \param step metres between points of the result, at most
        \return points along the curve, from the first one given to the last. */
    std::vector<Eigen::Vector2d> splineThrough(const std::vector<Eigen::Vector2d> &points, SplineKind kind,
                                               std::size_t sampling, double step);

    /** \brief Metres along points. */
    double lengthOf(const std::vector<Eigen::Vector2d> &points);

    /** \brief Radians that the line through the points turns in all, not counting turns of more than \e most: a way
        that comes back on itself has cusps there. */
    double turningOf(const std::vector<Eigen::Vector2d> &points, double most);
}  // namespace parking
