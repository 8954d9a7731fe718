#include "parking_geometry/smoothing/BsplineSmoother.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Biarc.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>

#include <unsupported/Eigen/Splines>

namespace parking
{
    namespace
    {
        using Eigen::Vector2d;
        using Spline = Eigen::Spline<double, 2, Eigen::Dynamic>;

        /** Distance in metres below which points coincide. */
        constexpr double SAME_PLACE = 1e-9;

        /** Difference in radians below which headings are equal. */
        constexpr double SAME_HEADING = 1e-9;

        constexpr int MIN_DEGREE = 2, MAX_DEGREE = 5;

        /** Derivative below which a curve has no heading. */
        constexpr double SLOW = 1e-9;

        std::vector<Vector2d> distinct(const std::vector<Vector2d> &points)
        {
            std::vector<Vector2d> result;
            for (const Vector2d &point : points)
            {
                if (!point.allFinite())
                    throw Error("B-spline: point " + std::to_string(&point - points.data()) +
                                " is not finite; coordinates must be finite numbers of metres");
                if (result.empty() || (point - result.back()).norm() > SAME_PLACE)
                    result.push_back(point);
            }
            if (result.size() < 2)
                throw Error("B-spline: there are " + std::to_string(result.size()) +
                            " distinct points; it takes at least 2");
            return result;
        }

        void check(const BsplineOptions &options)
        {
            const Require require("B-spline");
            require.that(options.degree >= MIN_DEGREE && options.degree <= MAX_DEGREE, "degree",
                         static_cast<double>(options.degree), "from 2 to 5");
            require.that(options.sampling >= 1, "sampling", static_cast<double>(options.sampling), "at least 1");
            require.positive("step", options.step, "metres");
            if (!(options.maxCurvature > 0.0))
                throw Error("B-spline: maximum curvature is " + formatNumber(options.maxCurvature) +
                            "; it must be a positive number of 1/m");
        }

        /** The spline for given multiplicities of the points of a polyline. */
        class Curve
        {
        public:
            /** \param multiplicity per point: 0 not used, 1 a control point, \e degree: the curve passes through it */
            Curve(const std::vector<Vector2d> &points, const std::vector<int> &multiplicity, int degree)
            {
                for (std::size_t i = 0; i < points.size(); ++i)
                    for (int copy = 0; copy < multiplicity[i]; ++copy)
                        origin_.push_back(i);
                const auto count = static_cast<Eigen::Index>(origin_.size());
                const Eigen::Index order = std::min<Eigen::Index>(degree, count - 1);
                degree_ = static_cast<std::size_t>(order);
                Spline::ControlPointVectorType controls(2, count);
                for (Eigen::Index i = 0; i < count; ++i)
                    controls.col(i) = points[origin_[static_cast<std::size_t>(i)]];
                spans_ = static_cast<std::size_t>(count - order);
                Spline::KnotVectorType knots(count + order + 1);
                for (Eigen::Index i = 0; i < knots.size(); ++i)
                    knots[i] = static_cast<double>(std::clamp<Eigen::Index>(i - order, 0, count - order)) /
                               static_cast<double>(count - order);
                spline_ = Spline(knots, controls);
            }

            std::size_t spans() const
            {
                return spans_;
            }

            /** The points of the polyline that determine a span: first and last index. */
            std::pair<std::size_t, std::size_t> reach(std::size_t span) const
            {
                return {origin_[span], origin_[span + degree_]};
            }

            /** Key of the shape of a span: spans with equal keys have the same states. Knots are uniform except at the
                ends, whose distance matters if it is below the degree. */
            std::vector<std::size_t> key(std::size_t span) const
            {
                std::vector<std::size_t> key(origin_.begin() + static_cast<std::ptrdiff_t>(span),
                                             origin_.begin() + static_cast<std::ptrdiff_t>(span + degree_ + 1));
                key.push_back(std::min(span, degree_));
                key.push_back(std::min(spans_ - 1 - span, degree_));
                return key;
            }

            /** States of a span, at most \e step apart; both of its ends are among them. */
            SampledPath sample(std::size_t span, double step) const
            {
                double controlLength = 0.0;
                for (std::size_t i = span; i < span + degree_; ++i)
                    controlLength += (control(i + 1) - control(i)).norm();
                const Polynomial polynomial = expand(span);
                // The control polygon spans as many pieces as the degree.
                const double guess = 1.0 + std::ceil(controlLength / static_cast<double>(degree_) / step);
                for (auto count = static_cast<std::size_t>(guess);; count += 1 + count / 4)
                {
                    SampledPath states;
                    states.reserve(count + 1);
                    double maxDistance = 0.0;
                    for (std::size_t i = 0; i <= count; ++i)
                    {
                        states.push_back(state(polynomial, static_cast<double>(i) / static_cast<double>(count)));
                        if (i > 0)
                            maxDistance = std::max(maxDistance, positionDistance(states[i].pose, states[i - 1].pose));
                    }
                    if (maxDistance <= 0.99 * step)
                        return states;
                }
            }

        private:
            /** Coefficients of a span by powers of the share driven. */
            using Polynomial = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, MAX_DEGREE + 1>;

            Vector2d control(std::size_t i) const
            {
                return spline_.ctrls().col(static_cast<Eigen::Index>(i));
            }

            /** Within a span the spline is a polynomial, which its derivatives at the beginning determine. */
            Polynomial expand(std::size_t span) const
            {
                const double width = 1.0 / static_cast<double>(spans_);
                const auto order = static_cast<Eigen::Index>(degree_);
                // The exact knot, so that it belongs to this span and not to the previous one.
                const double begin = static_cast<double>(span) / static_cast<double>(spans_);
                Polynomial polynomial = spline_.derivatives(begin, order).matrix();
                double scale = 1.0;
                for (Eigen::Index k = 1; k <= order; ++k)
                {
                    scale *= width / static_cast<double>(k);
                    polynomial.col(k) *= scale;
                }
                return polynomial;
            }

            /** The state at a share of the span, with a NaN heading where the derivative vanishes. */
            PathState state(const Polynomial &polynomial, double share) const
            {
                Vector2d position(0.0, 0.0), velocity(0.0, 0.0), acceleration(0.0, 0.0);
                for (Eigen::Index k = polynomial.cols() - 1; k >= 0; --k)
                {
                    acceleration = acceleration * share + 2.0 * velocity;
                    velocity = velocity * share + position;
                    position = position * share + polynomial.col(k);
                }
                const double speed = velocity.norm();
                PathState result;
                result.pose = {position.x(), position.y(), std::nan("")};
                if (speed * static_cast<double>(spans_) < SLOW)
                    return result;
                result.pose.yaw = std::atan2(velocity.y(), velocity.x());
                result.curvature =
                    (velocity.x() * acceleration.y() - velocity.y() * acceleration.x()) / (speed * speed * speed);
                return result;
            }

            Spline spline_;
            std::vector<std::size_t> origin_;
            std::size_t degree_{0}, spans_{0};
        };

        /** Appends \e states without those that do not move, and sets missing headings. */
        void append(SampledPath &path, const SampledPath &states)
        {
            for (const PathState &state : states)
            {
                if (path.empty())
                {
                    path.push_back(state);
                    continue;
                }
                const double dx = state.pose.x - path.back().pose.x, dy = state.pose.y - path.back().pose.y;
                if (std::hypot(dx, dy) < SAME_PLACE)
                {
                    if (std::isnan(path.back().pose.yaw))
                        path.back() = state;
                    continue;
                }
                if (std::isnan(path.back().pose.yaw))
                    path.back().pose.yaw = std::atan2(dy, dx);
                path.push_back(state);
                if (std::isnan(state.pose.yaw))
                    path.back().pose.yaw = std::atan2(dy, dx);
            }
        }

        /** The curve through \e states, which two arcs or one line join; without pieces if its curvature is too
            large. */
        Path pathThrough(const SampledPath &states, bool isStraight, double maxCurvature)
        {
            const Pose &begin = states.front().pose, &end = states.back().pose;
            if (isStraight)  // even if its speed in the parameter is uneven
                return {{begin.x, begin.y, std::atan2(end.y - begin.y, end.x - begin.x)},
                        {{0.0, positionDistance(end, begin)}}};
            Path path{begin, {}};
            if (std::any_of(states.begin(), states.end(),
                            [&](const PathState &state) { return std::abs(state.curvature) > maxCurvature; }))
                return path;
            for (std::size_t i = 1; i < states.size(); ++i)
            {
                const Pose &from = states[i - 1].pose, &to = states[i].pose;
                if (const std::optional<Path> arcs = biarc(from, to, 1))
                    path.extend(*arcs);
                else
                    path.append({0.0, positionDistance(to, from)});
            }
            return path;
        }

        /** Appends \e span, after a turn on the spot if its initial heading differs from that at the end of the
            path. */
        void append(Path &path, double &yaw, const Path &span)
        {
            if (path.pieces.empty())
                path.start = span.start;
            else if (const double turn = wrapAngle(span.start.yaw - yaw); std::abs(turn) > SAME_HEADING)
                path.append(PathPiece::turnOnTheSpot(turn));
            path.extend(span);
            yaw = span.end().yaw;
        }

        /** Result for one span. Most spans do not change if others get more control points. */
        struct Span
        {
            SampledPath states;
            Path path;  // without pieces if the curvature of the states is too large
            bool isAcceptable{false};
        };

        bool isAcceptable(const Path &span, double maxCurvature, const Vehicle &vehicle, const FootprintQueries &world)
        {
            return !span.pieces.empty() &&
                   std::all_of(span.pieces.begin(), span.pieces.end(),
                               [&](const PathPiece &piece) { return std::abs(piece.curvature) <= maxCurvature; }) &&
                   isPathFree(world, vehicle, span);
        }
    }  // namespace

    BsplineResult bsplineSmooth(const std::vector<Vector2d> &given, const BsplineOptions &options,
                                const Vehicle &vehicle, const FootprintQueries &world)
    {
        check(options);
        const std::vector<Vector2d> points = distinct(given);
        const int all = options.degree;  // multiplicity of a point through which the curve passes
        std::vector<int> multiplicity(points.size(), 0);
        for (std::size_t i = 0; i < points.size(); i += options.sampling)
            multiplicity[i] = 1;
        multiplicity.back() = 1;
        std::map<std::vector<std::size_t>, Span> known;
        BsplineResult result;
        std::vector<const Span *> spans;
        for (bool again = true; again;)
        {
            again = false;
            const Curve curve(points, multiplicity, options.degree);
            result = BsplineResult();
            result.spans = curve.spans();
            spans.clear();
            std::vector<int> next = multiplicity;
            for (std::size_t k = 0; k < curve.spans(); ++k)
            {
                const auto [at, isNew] = known.try_emplace(curve.key(k));
                Span &span = at->second;
                if (isNew)
                    append(span.states, curve.sample(k, options.step));
                if (span.states.size() < 2)
                    continue;
                const auto [first, last] = curve.reach(k);
                int lowest = all;
                bool denser = false;
                for (std::size_t i = first; i <= last; ++i)
                {
                    lowest = std::min(lowest, multiplicity[i]);
                    denser = denser || (multiplicity[i] > 0 && i % options.sampling != 0 && i + 1 < points.size());
                }
                const bool isPolyline = lowest == all;
                result.polylineSpans += isPolyline;
                result.denserSpans += denser && !isPolyline;
                if (isNew)
                    span.path = pathThrough(span.states, last == first + 1, options.maxCurvature);
                if (isNew && !isPolyline)
                    span.isAcceptable = isAcceptable(span.path, options.maxCurvature, vehicle, world);
                // Spans of the polyline are final. Other spans that fail advance by one step.
                if (!isPolyline && !span.isAcceptable)
                {
                    for (std::size_t i = first; i <= last; ++i)
                        next[i] = std::max(next[i], lowest == 0 ? 1 : all);
                    again = true;
                }
                spans.push_back(&span);
            }
            multiplicity = next;
        }
        double yaw = 0.0;
        for (const Span *span : spans)
            append(result.path, yaw, span->path);
        return result;
    }
}  // namespace parking
