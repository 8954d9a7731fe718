#include "ompl_improved_astar/search/planning/PathRelaxer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double LEAST_GAIN = 1e-3;     // metres of cost: smaller gains are not worth a new path
        constexpr std::size_t MOST_MOVES = 20;  // one after the other, before the pass goes on along the path

        /** In steps: forwards, to the left, turned to the left. */
        struct Move
        {
            double forwards, left, turn;
        };

        constexpr std::array<Move, 10> MOVES{{{1.0, 0.0, 0.0},
                                              {-1.0, 0.0, 0.0},
                                              {0.0, 1.0, 0.0},
                                              {0.0, -1.0, 0.0},
                                              {0.0, 0.0, 1.0},
                                              {0.0, 0.0, -1.0},
                                              {0.0, 1.0, 1.0},
                                              {0.0, -1.0, -1.0},
                                              {0.0, -1.0, 1.0},
                                              {0.0, 1.0, -1.0}}};

        /** Metres driven to the cusps of a path, in order. */
        std::vector<double> cuspsOf(const Path &path)
        {
            std::vector<double> cusps;
            for (const Stretch &stretch : path.stretches())
                if (stretch.first > 0)
                    cusps.push_back(stretch.begin);
            return cusps;
        }
    }  // namespace

    std::vector<Pose> PathRelaxer::movedPoses(const Pose &pose, double step)
    {
        const double cosine = std::cos(pose.yaw), sine = std::sin(pose.yaw);
        std::vector<Pose> poses;
        for (const Move &move : MOVES)
        {
            const double forwards = move.forwards * step, left = move.left * step;
            const Pose moved{pose.x + forwards * cosine - left * sine, pose.y + forwards * sine + left * cosine,
                             pose.yaw + move.turn * step / curves_.turningRadius()};
            if (environment_.isPassable(moved))
                poses.push_back(moved);
        }
        return poses;
    }

    std::vector<PathRelaxer::Span> PathRelaxer::spansAround(const Path &path, double driven,
                                                            std::size_t mostCusps) const
    {
        const double length = path.length();
        const auto within = [&](double radii)
        {
            const double reach = radii * curves_.turningRadius();
            return Span{std::max(0.0, driven - reach), std::min(length, driven + reach)};
        };
        std::vector<Span> spans{within(tuning_.relaxReach)};
        if (mostCusps == 0)
            return spans;
        const Span longest = within(tuning_.longestRelaxReach);
        const std::vector<double> cusps = cuspsOf(path);
        const auto before = std::lower_bound(cusps.begin(), cusps.end(), driven);
        const auto behind = std::upper_bound(before, cusps.end(), driven);
        const auto most = static_cast<std::ptrdiff_t>(mostCusps);
        for (std::ptrdiff_t k = 1; k <= most; ++k)
        {
            Span span = longest;
            if (before - cusps.begin() >= k)
                span.begin = std::max(span.begin, *(before - k));
            if (cusps.end() - behind >= k)
                span.end = std::min(span.end, *(behind + (k - 1)));
            if (std::none_of(spans.begin(), spans.end(),
                             [&](const Span &other) { return other.begin == span.begin && other.end == span.end; }))
                spans.push_back(span);
        }
        return spans;
    }

    std::optional<Path> PathRelaxer::leadThrough(const Span &span, const std::vector<Pose> &poses,
                                                 std::size_t mostCusps, const StopFunction &stop)
    {
        const GapBridge::Gap gap = bridge_.cutOut(priced_, span.begin, span.end);
        double bound = gap.cost - LEAST_GAIN;
        // One look instead of one at each pose.
        if (!bridge_.canCostLess(gap, bound))
            return std::nullopt;
        std::optional<Path> best;
        for (const Pose &pose : poses)
        {
            if (stop && stop())
                return std::nullopt;
            if (std::optional<GapBridge::Bridged> led = bridge_.lead(gap, pose, bound, mostCusps))
            {
                bound = led->cost;
                best = std::move(led->path);
            }
        }
        return best;
    }

    bool PathRelaxer::move(const std::vector<Pose> &poses, const std::vector<Span> &spans, std::size_t mostCusps,
                           const StopFunction &stop)
    {
        if (poses.empty())
            return false;
        for (const Span &span : spans)
        {
            std::optional<Path> led = leadThrough(span, poses, mostCusps, stop);
            if (!led)
                continue;
            // Closeness is sampled: the cost of the whole is not quite the sum of its parts'. Without this, two paths
            // replace each other for ever.
            std::optional<PricedPath> moved = pricePath(cost_, std::move(*led), environment_, stop);
            if (!moved)
                return false;
            if (!(moved->cost < priced_.cost - 0.5 * LEAST_GAIN) || !environment_.acceptPath(moved->path))
                continue;
            priced_ = std::move(*moved);
            return true;
        }
        return false;
    }

    bool PathRelaxer::pass(Path &path, const Pass &pass, std::size_t mostCusps, const StopFunction &stop)
    {
        bool improved = false;
        std::optional<PricedPath> priced = pricePath(cost_, path, environment_, stop);
        if (!priced)
            return false;
        priced_ = std::move(*priced);
        std::size_t moves = 0;
        for (std::size_t piece = 0; piece + 1 < priced_.path.pieces.size();)
        {
            if (stop && stop())
                break;
            double driven = 0.0;
            for (std::size_t k = 0; k <= piece; ++k)
                driven += priced_.path.pieces[k].driven();
            if (moves < MOST_MOVES && move(movedPoses(priced_.path.at(driven), pass.step),
                                           spansAround(priced_.path, driven, pass.cusps), mostCusps, stop))
            {
                // The pieces are others now, and what lies before them may gain by it.
                improved = true;
                ++moves;
                piece -= piece > 0 ? 1 : 0;
                continue;
            }
            ++piece;
            moves = 0;
        }
        if (improved)
            path = priced_.path;
        return improved;
    }
}  // namespace parking::search
