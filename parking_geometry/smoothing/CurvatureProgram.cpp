#include "parking_geometry/smoothing/CurvatureProgram.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Weight of the deviation at the end as a multiple of that along the path: practically an equality. */
        constexpr double END_WEIGHT = 1e6;

        /** Largest deviation at the end of a solution, metres and radians. A larger one means that there is no
            solution. */
        constexpr double END_TOLERANCE = 1e-5;

        constexpr int MAX_ITERATIONS = 40;
        constexpr double START_MULTIPLIER = 1.0;
        constexpr double FRACTION_TO_BOUNDARY = 0.99;

        /** Mean complementarity at which the cost is practically optimal. */
        constexpr double GAP_TOLERANCE = 1e-3;
    }  // namespace

    double CurvatureProgram::Bound::weight() const
    {
        return upperMultiplier / upperSlack + lowerMultiplier / lowerSlack;
    }

    double CurvatureProgram::Bound::gradient(double target) const
    {
        return upperMultiplier + (target - upperMultiplier * (1.0 + middle)) / upperSlack -
               (lowerMultiplier + (target - lowerMultiplier * (1.0 - middle)) / lowerSlack);
    }

    double CurvatureProgram::Bound::longestStep(double value, double target) const
    {
        double length = 1.0;
        const auto limit = [&](double slack, double multiplier, double slackChange)
        {
            const double change = (target - multiplier * slackChange) / slack - multiplier;
            if (slackChange < 0.0)
                length = std::min(length, -FRACTION_TO_BOUNDARY * slack / slackChange);
            if (change < 0.0)
                length = std::min(length, -FRACTION_TO_BOUNDARY * multiplier / change);
        };
        limit(upperSlack, upperMultiplier, 1.0 - (value - middle) - upperSlack);
        limit(lowerSlack, lowerMultiplier, 1.0 + (value - middle) - lowerSlack);
        return length;
    }

    void CurvatureProgram::Bound::step(double value, double target, double length)
    {
        const auto move = [&](double &slack, double &multiplier, double slackChange)
        {
            const double change = (target - multiplier * slackChange) / slack - multiplier;
            slack += length * slackChange;
            multiplier += length * change;
        };
        move(upperSlack, upperMultiplier, 1.0 - (value - middle) - upperSlack);
        move(lowerSlack, lowerMultiplier, 1.0 + (value - middle) - lowerSlack);
    }

    double CurvatureProgram::Bound::gap() const
    {
        return upperSlack * upperMultiplier + lowerSlack * lowerMultiplier;
    }

    void CurvatureProgram::reset(const Settings &settings, const std::vector<Interval> &intervals,
                                 const std::vector<Corridor> &corridors)
    {
        settings_ = settings;
        const std::size_t n = intervals.size();
        stages_.resize(n);
        x_.assign(n + 1, State::Zero());
        next_.assign(n + 1, State::Zero());
        u_.assign(n, 0.0);
        nextU_.assign(n, 0.0);
        corridors_.clear();
        for (const Corridor &corridor : corridors)
        {
            const double half = 0.5 * (corridor.high - corridor.low);
            corridors_.push_back(std::isfinite(half) ? Scaled{1.0 / half, 0.5 * (corridor.high + corridor.low) / half}
                                                     : Scaled());
        }
        for (std::size_t i = 0; i < n; ++i)
        {
            Stage &stage = stages_[i];
            const double h = intervals[i].length, k = intervals[i].curvature, square = k * k;
            stage.h = h;
            stage.reference = k;
            stage.maxRate = stage.rate = intervals[i].maxRate;
            stage.A << 1.0 - 0.5 * h * h * square, h, 0.5 * h * h, -h * square, 1.0 - 0.5 * h * h * square, h, 0.0, 0.0,
                1.0;
            stage.B << h * h * h / 6.0, 0.5 * h * h, h;
            stage.c << -0.5 * h * h * k, -h * k, 0.0;
        }
    }

    void CurvatureProgram::relinearise(const std::vector<State> &states, const std::vector<double> &lengths)
    {
        for (std::size_t i = 0; i < stages_.size(); ++i)
        {
            Stage &stage = stages_[i];
            const double h = stage.h, reference = stage.reference;
            const State middle = 0.5 * (states[i] + states[i + 1]);
            // Along the reference: y' = tan(psi) (1 - kRef y), psi' = k (1 - kRef y) / cos(psi) - kRef.
            const double tangent = std::tan(middle[1]), secant = std::sqrt(1.0 + tangent * tangent);
            const double stretch = 1.0 - reference * middle[0];
            const double yy = -reference * tangent, yp = stretch * secant * secant;
            const double py = -middle[2] * reference * secant, pp = middle[2] * stretch * secant * tangent;
            const double pk = stretch * secant, half = 0.5 * h * h;
            stage.A << 1.0 + h * yy + half * (yy * yy + yp * py), h * yp + half * yp * (yy + pp), half * yp * pk,
                h * py + half * py * (yy + pp), 1.0 + h * pp + half * (pp * pp + yp * py), h * pk + half * pp * pk, 0.0,
                0.0, 1.0;
            stage.B << half * h / 3.0 * yp * pk, half * pk + half * h / 3.0 * pp * pk, h;
            stage.c = states[i + 1] - stage.A * states[i] - stage.B * ((states[i + 1][2] - states[i][2]) / h);
            stage.c[2] = 0.0;
            stage.rate = stage.maxRate * lengths[i] / h;
        }
    }

    template <class Visit>
    void CurvatureProgram::forEachBound(const Visit &visit)
    {
        for (std::size_t i = 0; i < next_.size(); ++i)
            visit(curvatureBounds_[i], next_[i][2] / settings_.maxCurvature);
        for (std::size_t i = 0; i < nextU_.size(); ++i)
            visit(rateBounds_[i], nextU_[i] / stages_[i].rate);
        if (corridors_.empty())
            return;
        for (std::size_t i = 1; i + 1 < next_.size(); ++i)
            if (corridors_[i].scale > 0.0)
            {
                visit(frontBounds_[i], (next_[i][0] + settings_.front * next_[i][1]) * corridors_[i].scale);
                visit(rearBounds_[i], (next_[i][0] - settings_.rear * next_[i][1]) * corridors_[i].scale);
            }
    }

    void CurvatureProgram::newtonStep(double target)
    {
        const std::size_t n = stages_.size();
        const double weight = 1.0 / (settings_.tolerance * settings_.tolerance);
        const double lever = settings_.lever * settings_.lever, scale = 1.0 / settings_.maxCurvature;
        const double softness = 1.0 / (settings_.softRate * settings_.softRate);
        // The cost of node i and the cost to go from it have the form 1/2 x' P x + p' x.
        const auto addNode = [&](std::size_t i, double w, Eigen::Matrix3d &P, Eigen::Vector3d &p)
        {
            P(0, 0) += w;
            P(1, 1) += w * lever;
            const Bound &k = curvatureBounds_[i];
            P(2, 2) += k.weight() * scale * scale;
            p[2] += k.gradient(target) * scale;
            if (corridors_.empty() || i == 0 || i == n || corridors_[i].scale == 0.0)
                return;
            const auto corner = [&](const Bound &bound, double arm)
            {
                const double toBound = corridors_[i].scale;
                const double d = bound.weight() * toBound * toBound, g = bound.gradient(target) * toBound;
                P(0, 0) += d;
                P(0, 1) += d * arm;
                P(1, 0) += d * arm;
                P(1, 1) += d * arm * arm;
                p[0] += g;
                p[1] += g * arm;
            };
            corner(frontBounds_[i], settings_.front);
            corner(rearBounds_[i], -settings_.rear);
        };
        Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        addNode(n, weight * END_WEIGHT, P, p);
        if (settings_.endCurvature)
        {
            const double w = weight * END_WEIGHT * lever * lever;
            P(2, 2) += w;
            p[2] -= w * *settings_.endCurvature;
        }
        for (std::size_t i = n; i-- > 0;)
        {
            Stage &stage = stages_[i];
            const Bound &bound = rateBounds_[i];
            const double toBound = 1.0 / stage.rate;
            const Eigen::Vector3d PB = P * stage.B, pc = p + P * stage.c;
            const double quu = stage.B.dot(PB) + stage.h * softness + bound.weight() * toBound * toBound;
            const double qu = stage.B.dot(pc) + bound.gradient(target) * toBound;
            const Eigen::RowVector3d qux = PB.transpose() * stage.A;
            stage.gain = -qux / quu;
            stage.feedforward = -qu / quu;
            const Eigen::Matrix3d PA = P * stage.A;
            P.noalias() = stage.A.transpose() * PA + qux.transpose() * stage.gain;
            p.noalias() = stage.A.transpose() * pc + qux.transpose() * stage.feedforward;
            addNode(i, weight * stage.h, P, p);
        }
        next_[0] << 0.0, 0.0, settings_.startCurvature.value_or(-p[2] / P(2, 2));
        for (std::size_t i = 0; i < n; ++i)
        {
            const Stage &stage = stages_[i];
            nextU_[i] = stage.gain * next_[i] + stage.feedforward;
            next_[i + 1].noalias() = stage.A * next_[i] + stage.B * nextU_[i] + stage.c;
        }
    }

    bool CurvatureProgram::solve()
    {
        const std::size_t nodes = x_.size();
        const Bound fresh{1.0, 1.0, START_MULTIPLIER, START_MULTIPLIER, 0.0};
        curvatureBounds_.assign(nodes, fresh);
        rateBounds_.assign(nodes - 1, fresh);
        frontBounds_.assign(corridors_.empty() ? 0 : nodes, fresh);
        rearBounds_.assign(corridors_.empty() ? 0 : nodes, fresh);
        for (std::size_t i = 0; i < corridors_.size(); ++i)
            frontBounds_[i].middle = rearBounds_[i].middle = corridors_[i].middle;
        double gap = START_MULTIPLIER, centring = 0.1;
        for (int iteration = 1; iteration <= MAX_ITERATIONS; ++iteration)
        {
            const double target = centring * gap;
            newtonStep(target);
            double length = 1.0, worst = -1.0;
            forEachBound(
                [&](const Bound &bound, double value)
                {
                    length = std::min(length, bound.longestStep(value, target));
                    worst = std::max(worst, std::abs(value - bound.middle) - 1.0);
                });
            double sum = 0.0;
            std::size_t count = 0;
            forEachBound(
                [&](Bound &bound, double value)
                {
                    bound.step(value, target, length);
                    sum += bound.gap();
                    count += 2;
                });
            gap = sum / static_cast<double>(count);
            centring = length > 0.9 ? 0.02 : length > 0.5 ? 0.1 : 0.4;
            // The Newton point satisfies the dynamics, so it is the solution as soon as it satisfies the bounds.
            if (worst < 0.0 && gap < GAP_TOLERANCE)
            {
                x_ = next_;
                u_ = nextU_;
                return std::abs(x_.back()[0]) < END_TOLERANCE && std::abs(x_.back()[1]) < END_TOLERANCE &&
                       std::abs(x_.back()[2] - settings_.endCurvature.value_or(x_.back()[2])) < END_TOLERANCE;
            }
        }
        return false;
    }

    void CurvatureProgram::endSensitivity(std::vector<Eigen::Vector2d> &sensitivity) const
    {
        const std::size_t n = stages_.size();
        sensitivity.assign(n + 1, Eigen::Vector2d::Zero());
        Eigen::Matrix<double, 2, 2> toEnd = Eigen::Matrix2d::Identity();
        for (std::size_t i = n; i-- > 0;)
        {
            // The curvature is linear along the interval between two nodes. B refers to its change per metre.
            const Stage &stage = stages_[i];
            const Eigen::Vector2d atEnd = stage.B.head<2>() / stage.h;
            sensitivity[i] += toEnd * (stage.A.topRightCorner<2, 1>() - atEnd);
            sensitivity[i + 1] += toEnd * atEnd;
            toEnd *= stage.A.topLeftCorner<2, 2>();
        }
    }
}  // namespace parking
