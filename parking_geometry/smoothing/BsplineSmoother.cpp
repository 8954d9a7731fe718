#include "parking_geometry/smoothing/BsplineSmoother.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Kinematics.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include <unsupported/Eigen/Splines>

namespace parking
{
    namespace
    {
        using Eigen::Vector2d;
        using Spline = Eigen::Spline<double, 2, Eigen::Dynamic>;

        /** Points nearer to each other than this are one, metres. */
        constexpr double SAME_PLACE = 1e-9;

        constexpr int MIN_DEGREE = 2, MAX_DEGREE = 5;

        /** Curves that hardly move with their parameter have no heading of their own. */
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

        /** The spline with the control points that each point of the polyline stands for. */
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

            /** The points of the polyline that shape a span: all from first to last. */
            std::pair<std::size_t, std::size_t> reach(std::size_t span) const
            {
                return {origin_[span], origin_[span + degree_]};
            }

            /** What the shape of a span depends on: two spans of equal keys have the same states. Knots are uniform but
                for the ends, whose distance counts while it is below the degree. */
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
                // The control polygon spans as many pieces as the degree says.
                const double guess = 1.0 + std::ceil(controlLength / static_cast<double>(degree_) / step);
                for (auto count = static_cast<std::size_t>(guess);; count += 1 + count / 4)
                {
                    SampledPath states;
                    states.reserve(count + 1);
                    double longest = 0.0;
                    for (std::size_t i = 0; i <= count; ++i)
                    {
                        states.push_back(state(polynomial, static_cast<double>(i) / static_cast<double>(count)));
                        if (i > 0)
                            longest = std::max(longest, std::hypot(states[i].pose.x - states[i - 1].pose.x,
                                                                   states[i].pose.y - states[i - 1].pose.y));
                    }
                    if (longest <= 0.99 * step)
                        return states;
                }
            }

        private:
            /** Coefficients of a span by powers of the share of it that is behind. */
            using Polynomial = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, MAX_DEGREE + 1>;

            Vector2d control(std::size_t i) const
            {
                return spline_.ctrls().col(static_cast<Eigen::Index>(i));
            }

            /** Within a span the spline is a polynomial: its derivatives at the beginning say all. */
            Polynomial expand(std::size_t span) const
            {
                const double width = 1.0 / static_cast<double>(spans_);
                const auto order = static_cast<Eigen::Index>(degree_);
                // The very knot, so that it counts as part of this span and not of the one before.
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

            /** Heading NaN where the curve does not move. */
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

        /** Appends \e states, dropping those that do not move and giving a heading to those without. */
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

        void measure(SampledPath &path)
        {
            for (std::size_t i = 1; i < path.size(); ++i)
            {
                const Pose &from = path[i - 1].pose, &to = path[i].pose;
                // Along the polyline, where headings jump at corners, chords are the distance driven.
                const bool straight = path[i - 1].curvature == 0.0 && path[i].curvature == 0.0;
                path[i].arcLength = path[i - 1].arcLength + (straight ? std::hypot(to.x - from.x, to.y - from.y)
                                                                      : std::abs(arcBetween(from, to).length));
            }
        }

        bool isAcceptable(const SampledPath &span, const BsplineOptions &options, const Vehicle &vehicle,
                          const FootprintQueries &world)
        {
            for (const PathState &state : span)
                if (std::abs(state.curvature) > options.maxCurvature)
                    return false;
            Path arcs{span.front().pose, {}};
            for (std::size_t i = 1; i < span.size(); ++i)
                arcs.pieces.emplace_back(arcBetween(span[i - 1].pose, span[i].pose));
            return isPathFree(world, vehicle, arcs);
        }
    }  // namespace

    SampledPath bsplineSmooth(const std::vector<Vector2d> &points, int degree, std::size_t sampling)
    {
        BsplineOptions options;
        options.degree = degree;
        options.sampling = sampling;
        return bsplineSmooth(points, options, Vehicle(), {}).path;
    }

    BsplinePath bsplineSmooth(const std::vector<Vector2d> &given, const BsplineOptions &options, const Vehicle &vehicle,
                              const FootprintQueries &world)
    {
        check(options);
        const std::vector<Vector2d> points = distinct(given);
        const int through = options.degree;
        std::vector<int> multiplicity(points.size(), 0);
        for (std::size_t i = 0; i < points.size(); i += options.sampling)
            multiplicity[i] = 1;
        multiplicity.back() = 1;
        // Most spans stay as they are when others get more control points.
        struct Span
        {
            SampledPath states;
            bool isAcceptable{false};
        };
        std::map<std::vector<std::size_t>, Span> known;
        BsplinePath result;
        for (bool again = true; again;)
        {
            again = false;
            const Curve curve(points, multiplicity, options.degree);
            result = BsplinePath();
            result.pieces = curve.spans();
            std::vector<int> next = multiplicity;
            for (std::size_t span = 0; span < curve.spans(); ++span)
            {
                const auto [at, isNew] = known.try_emplace(curve.key(span));
                Span &piece = at->second;
                if (isNew)
                    append(piece.states, curve.sample(span, options.step));
                if (piece.states.size() < 2)
                    continue;
                const auto [first, last] = curve.reach(span);
                int least = through;
                bool denser = false;
                for (std::size_t i = first; i <= last; ++i)
                {
                    least = std::min(least, multiplicity[i]);
                    denser = denser || (multiplicity[i] > 0 && i % options.sampling != 0 && i + 1 < points.size());
                }
                const bool isPolyline = least == through;
                result.polylinePieces += isPolyline;
                result.denserPieces += denser && !isPolyline;
                // Pieces of the polyline itself are as they were given; others rise by one step where they fail.
                if (isPolyline)
                    for (PathState &state : piece.states)
                        state.curvature = 0.0;
                else if (isNew)
                    piece.isAcceptable = isAcceptable(piece.states, options, vehicle, world);
                if (!isPolyline && !piece.isAcceptable)
                {
                    for (std::size_t i = first; i <= last; ++i)
                        next[i] = std::max(next[i], least == 0 ? 1 : through);
                    again = true;
                }
                append(result.path, piece.states);
            }
            multiplicity = next;
        }
        measure(result.path);
        return result;
    }
}  // namespace parking
