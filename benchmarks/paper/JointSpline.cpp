#include "benchmarks/paper/JointSpline.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/Pose.h"

#include <algorithm>
#include <cmath>

#include <unsupported/Eigen/Splines>

namespace parking
{
    namespace
    {
        using Points = std::vector<Eigen::Vector2d>;
        using Spline = Eigen::Spline<double, 2, Eigen::Dynamic>;

        constexpr double SAME_PLACE = 1e-9;  // metres

        Points controlsOf(const Points &points, std::size_t sampling)
        {
            Points controls;
            for (std::size_t i = 0; i + 1 < points.size(); i += sampling)
                controls.push_back(points[i]);
            controls.push_back(points.back());
            return controls;
        }
    }  // namespace

    Points splineThrough(const Points &points, std::size_t degree, std::size_t sampling, double step)
    {
        if (points.empty() || degree < 1 || sampling < 1 || !(step > 0.0))
            throw Error(
                "a spline requires at least one point, a degree and a sampling of at least 1 and a positive "
                "step");
        const Points controls = controlsOf(points, sampling);
        if (controls.size() < 2)
            return controls;
        const auto count = static_cast<Eigen::Index>(controls.size());
        const Eigen::Index order = std::min(static_cast<Eigen::Index>(degree), count - 1), spans = count - order;
        Spline::ControlPointVectorType columns(2, count);
        for (Eigen::Index i = 0; i < count; ++i)
            columns.col(i) = controls[static_cast<std::size_t>(i)];
        Spline::KnotVectorType knots(count + order + 1);
        for (Eigen::Index i = 0; i < knots.size(); ++i)
            knots[i] = static_cast<double>(std::clamp<Eigen::Index>(i - order, 0, spans));
        const Spline spline(knots, columns);
        // Span by span, so that the corners of a polyline are among the points.
        Points curve{controls.front()};
        for (Eigen::Index span = 0; span < spans; ++span)
        {
            const std::size_t begun = curve.size();
            const auto first = controls.begin() + span;
            const double reach = lengthOf({first, first + order + 1}) / static_cast<double>(order);
            auto parts = static_cast<Eigen::Index>(std::ceil(reach / step)) + 1;
            for (double longest = 2.0 * step; longest > step; parts += parts / 2 + 1)
            {
                curve.resize(begun);
                longest = 0.0;
                for (Eigen::Index i = 1; i <= parts; ++i)
                {
                    const double share = static_cast<double>(i) / static_cast<double>(parts);
                    curve.emplace_back(spline(static_cast<double>(span) + share));
                    longest = std::max(longest, (curve.back() - curve[curve.size() - 2]).norm());
                }
            }
        }
        curve.back() = controls.back();
        return curve;
    }

    double lengthOf(const Points &points)
    {
        double length = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i)
            length += (points[i] - points[i - 1]).norm();
        return length;
    }

    double turningOf(const Points &points, double max)
    {
        double turning = 0.0, before = 0.0;
        bool isFirst = true;
        for (std::size_t i = 1; i < points.size(); ++i)
        {
            const Eigen::Vector2d step = points[i] - points[i - 1];
            if (step.norm() < SAME_PLACE)
                continue;
            const double heading = std::atan2(step.y(), step.x()), turn = std::abs(wrapAngle(heading - before));
            if (!isFirst && turn <= max)
                turning += turn;
            before = heading;
            isFirst = false;
        }
        return turning;
    }
}  // namespace parking
