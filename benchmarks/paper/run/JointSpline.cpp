#include "benchmarks/paper/run/JointSpline.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/text/NearestName.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        using Points = std::vector<Eigen::Vector2d>;

        constexpr std::size_t DEGREE = 3;
        constexpr double SAME_PLACE = 1e-9;  // metres

        /** De Casteljau: stable for any number of control points. */
        Eigen::Vector2d bezierAt(const Points &controls, double t)
        {
            Points points = controls;
            for (std::size_t count = points.size(); count > 1; --count)
                for (std::size_t i = 0; i + 1 < count; ++i)
                    points[i] = (1.0 - t) * points[i] + t * points[i + 1];
            return points.front();
        }

        /** De Boor's algorithm on the clamped uniform knots 0, ..., 0, 1, 2, ..., n, ..., n. \param u 0 to n */
        Eigen::Vector2d bsplineAt(const Points &controls, double u)
        {
            const std::size_t degree = std::min(DEGREE, controls.size() - 1), spans = controls.size() - degree;
            const auto knot = [degree, spans](std::size_t i)
            {
                return static_cast<double>(std::clamp(i, degree, degree + spans) - degree);
            };
            const std::size_t span = std::min(static_cast<std::size_t>(u), spans - 1) + degree;
            Points points(controls.begin() + static_cast<std::ptrdiff_t>(span - degree),
                          controls.begin() + static_cast<std::ptrdiff_t>(span + 1));
            for (std::size_t r = 1; r <= degree; ++r)
                for (std::size_t j = degree; j >= r; --j)
                {
                    const std::size_t i = span - degree + j;
                    const double begin = knot(i), end = knot(i + degree - r + 1);
                    const double share = (u - begin) / (end - begin);
                    points[j] = (1.0 - share) * points[j - 1] + share * points[j];
                }
            return points.back();
        }

        Points controlsOf(const Points &points, std::size_t sampling)
        {
            Points controls;
            for (std::size_t i = 0; i < points.size(); i += sampling)
                controls.push_back(points[i]);
            if ((points.size() - 1) % sampling != 0)
                controls.push_back(points.back());
            return controls;
        }
    }  // namespace

    SplineKind splineByName(const std::string &name)
    {
        if (name == "none")
            return SplineKind::None;
        if (name == "bspline")
            return SplineKind::Bspline;
        if (name == "bezier")
            return SplineKind::Bezier;
        throw Error(unknownName("spline", name, {"none", "bspline", "bezier"}));
    }

    Points splineThrough(const Points &points, SplineKind kind, std::size_t sampling, double step)
    {
        if (points.empty() || sampling < 1 || !(step > 0.0))
            throw Error("a spline takes at least one point, every first of them or fewer, and a positive step");
        const Points controls = kind == SplineKind::None ? points : controlsOf(points, sampling);
        const double pieces = std::max(1.0, std::ceil(lengthOf(controls) / step));
        Points curve{controls.front()};
        if (kind == SplineKind::None || controls.size() < 3)
        {
            for (std::size_t i = 1; i < controls.size(); ++i)
            {
                const Eigen::Vector2d way = controls[i] - controls[i - 1];
                const double parts = std::max(1.0, std::ceil(way.norm() / step));
                for (double part = 1.0; part <= parts; part += 1.0)
                    curve.push_back(controls[i - 1] + way * (part / parts));
            }
            return curve;
        }
        const double end = kind == SplineKind::Bezier
                               ? 1.0
                               : static_cast<double>(controls.size() - std::min(DEGREE, controls.size() - 1));
        // The curve is no longer than its control polygon, but does not move evenly with its parameter.
        for (auto count = static_cast<std::size_t>(pieces);; count += count / 2 + 1)
        {
            curve.resize(1);
            double longest = 0.0;
            for (std::size_t i = 1; i <= count; ++i)
            {
                const double t = end * static_cast<double>(i) / static_cast<double>(count);
                curve.push_back(kind == SplineKind::Bezier ? bezierAt(controls, t) : bsplineAt(controls, t));
                longest = std::max(longest, (curve.back() - curve[curve.size() - 2]).norm());
            }
            if (longest <= step)
                break;
        }
        curve.back() = points.back();
        return curve;
    }

    double lengthOf(const Points &points)
    {
        double length = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i)
            length += (points[i] - points[i - 1]).norm();
        return length;
    }

    double turningOf(const Points &points, double most)
    {
        double turning = 0.0, before = 0.0;
        bool begun = false;
        for (std::size_t i = 1; i < points.size(); ++i)
        {
            const Eigen::Vector2d way = points[i] - points[i - 1];
            if (way.norm() < SAME_PLACE)
                continue;
            const double heading = std::atan2(way.y(), way.x());
            if (const double turn = std::abs(wrapAngle(heading - before)); begun && turn <= most)
                turning += turn;
            before = heading;
            begun = true;
        }
        return turning;
    }
}  // namespace parking
