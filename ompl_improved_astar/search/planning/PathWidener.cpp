#include "ompl_improved_astar/search/planning/PathWidener.h"

#include "ompl_improved_astar/search/models/CurveCheck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double SAMPLES_APART = 0.25;  // metres, where the environment does not know what is clear
        constexpr double FINE_APART = 0.1;      // metres, in search of the pose nearest to an obstacle
        constexpr double SAME_PART = 0.5;       // metres: parts nearer to each other are one
        constexpr double LEAST_GAIN = 1e-4;     // metres of cost: smaller gains are not worth a new path
        constexpr double LEVER = 2.0;           // metres: a turn moves the ends of the body by about as much per radian
        // To the side and by a turn, in preferred clearances.
        constexpr std::array<double, 9> ASIDE{-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0};
        // How far from that pose the path is left, and reached again, at least: in widths of the bend by which a car
        // gets to the side by the preferred clearance.
        constexpr std::array<double, 3> REACHES{1.5, 3.0, 6.0};
    }  // namespace

    std::vector<PathWidener::ClosePart> PathWidener::closeParts(const Path &path)
    {
        std::vector<ClosePart> parts;
        const auto add = [&parts](double begin, double end)
        {
            if (!parts.empty() && begin - parts.back().end < SAME_PART)
                parts.back().end = end;
            else
                parts.push_back({begin, end});
        };
        Pose pose = path.start;
        double driven = 0.0;
        for (const PathPiece &piece : path.pieces)
        {
            const Arc arc{piece.curvature, piece.length};
            const double length = piece.driven();
            double clear = 0.0;
            environment_.clearLengths(pose, &arc, 1, cost_.preferredClearance, &clear);
            if (clear < length)
            {
                const double rest = length - clear, samples = std::ceil(rest / SAMPLES_APART), apart = rest / samples;
                for (double i = 0.0; i < samples; i += 1.0)
                {
                    // Where the environment knows how far it is clear, it is nearer beyond.
                    const double at = clear + i * apart;
                    const Pose middle = advance(pose, piece, at + 0.5 * apart);
                    if ((i == 0.0 && clear > 0.0) || !environment_.keeps(middle, cost_.preferredClearance))
                        add(driven + at, driven + at + apart);
                }
                // At a cusp the car may be nearest of all.
                if (!environment_.keeps(advance(pose, piece), cost_.preferredClearance))
                    add(driven + length - std::min(length, 0.5 * FINE_APART), driven + length + 0.5 * FINE_APART);
            }
            driven += length;
            pose = advance(pose, piece);
        }
        return parts;
    }

    std::optional<double> PathWidener::nearestPlace(const Path &path, const ClosePart &part)
    {
        double least = cost_.preferredClearance;
        std::optional<double> nearest;
        const double samples = std::ceil((part.end - part.begin) / FINE_APART);
        for (double i = 0.0; i <= samples; i += 1.0)
        {
            const double place = part.begin + (part.end - part.begin) * i / samples;
            const double clearance = environment_.clearance(path.at(place));
            if (clearance < least)
            {
                least = clearance;
                nearest = place;
            }
        }
        return nearest;
    }

    std::vector<Pose> PathWidener::posesBeside(const Pose &pose)
    {
        // From the smallest change on.
        static const auto changes = []
        {
            std::vector<std::pair<double, double>> all;
            for (const double aside : ASIDE)
                for (const double turn : ASIDE)
                    all.emplace_back(aside, turn);
            std::stable_sort(all.begin(), all.end(),
                             [](const auto &a, const auto &b)
                             { return std::hypot(a.first, a.second) < std::hypot(b.first, b.second); });
            return all;
        }();
        std::vector<Pose> result;
        for (const auto &[aside, turn] : changes)
        {
            const double side = aside * cost_.preferredClearance;
            const Pose beside{pose.x - side * std::sin(pose.yaw), pose.y + side * std::cos(pose.yaw),
                              pose.yaw + turn * cost_.preferredClearance / LEVER};
            if (environment_.keeps(beside, strict_.preferredClearance) && environment_.isPassable(beside))
                result.push_back(beside);
            if (result.size() == tuning_.posesBeside)
                break;
        }
        return result;
    }

    PathWidener::Gap PathWidener::cutOut(const Path &path, double begin, double end)
    {
        const Path untilEnd = path.first(end);
        Gap gap{path.first(begin), path.rest(end), 0.0};
        const Path part = untilEnd.rest(begin);
        gap.cost = pathCost(strict_, part, environment_);
        if (!gap.before.pieces.empty())
            gap.cost += strict_.join(gap.before.pieces.back(), part.pieces.front());
        if (!gap.after.pieces.empty())
            gap.cost += strict_.join(part.pieces.back(), gap.after.pieces.front());
        return gap;
    }

    std::optional<PathWidener::Leg> PathWidener::shortest(const Pose &from, const Pose &to, const PathPiece *before,
                                                          const PathPiece *after, double bound)
    {
        ++connectionCount_;
        curves_.candidates(from, to, candidates_, bound);
        std::optional<Leg> best;
        for (const ReedsSheppCurve &curve : candidates_)
        {
            if (curve.count == 0)
                continue;
            double cost = curveCost(strict_, curve);
            if (before != nullptr)
                cost += strict_.join(*before, curve.pieces[0]);
            if (after != nullptr)
                cost += strict_.join(curve.pieces[curve.count - 1], *after);
            if (cost < (best ? best->cost : bound))
                best = Leg{cost, curve};
        }
        return best;
    }

    void PathWidener::lead(const Gap &gap, const Pose &through, Lead &best)
    {
        const double bound = gap.cost - LEAST_GAIN;
        const Pose from = gap.before.pieces.empty() ? gap.before.start : gap.before.end(), to = gap.after.start;
        const PathPiece *const before = gap.before.pieces.empty() ? nullptr : &gap.before.pieces.back();
        const PathPiece *const after = gap.after.pieces.empty() ? nullptr : &gap.after.pieces.front();
        const std::optional<Leg> there = shortest(from, through, before, nullptr, bound);
        if (!there)
            return;
        const std::optional<Leg> onward = shortest(through, to, nullptr, after, bound - there->cost);
        if (!onward)
            return;
        Path led = gap.before;
        for (std::size_t k = 0; k < there->curve.count; ++k)
            led.append(there->curve.pieces[k]);
        const double reach = led.length();
        for (std::size_t k = 0; k < onward->curve.count; ++k)
            led.append(onward->curve.pieces[k]);
        led.extend(gap.after);
        if (led.cusps() > best.mostCusps)
            return;
        const double join = strict_.join(there->curve.pieces[there->curve.count - 1], onward->curve.pieces[0]);
        std::vector<PricedCurve> one{{there->cost, &there->curve}}, other{{onward->cost + join, &onward->curve}};
        const auto isCheapAndFree = [&](const ReedsSheppCurve &, double spent)
        {
            return offerFreeCurves(environment_, strict_, through, to, other, CurveEnd::Start, bound - spent,
                                   [](const ReedsSheppCurve &, double) { return true; });
        };
        if (!offerFreeCurves(environment_, strict_, from, through, one, CurveEnd::Start, bound - other.front().first,
                             isCheapAndFree))
            return;
        // Closeness is sampled: the cost of the whole is not quite the sum of its parts'.
        const double cost = pathCost(strict_, led, environment_);
        if (cost < best.cost - LEAST_GAIN && environment_.acceptPath(led))
            best = {std::move(led), cost, reach, best.mostCusps};
    }

    bool PathWidener::pass(Path &path, const StopFunction &stop)
    {
        bool improved = false;
        double done = 0.0;  // metres along the path
        const std::size_t mostCusps = path.cusps() + 1;
        const double bend = std::sqrt(curves_.turningRadius() * cost_.preferredClearance);
        std::vector<ClosePart> parts = closeParts(path);
        for (std::size_t k = 0; k < parts.size(); ++k)
        {
            const ClosePart part = parts[k];
            const double whole = path.length();
            if (part.end <= done || part.begin <= 0.0 || part.end >= whole)
                continue;
            const std::optional<double> place = nearestPlace(path, part);
            if (!place)
                continue;
            const std::vector<Pose> poses = posesBeside(path.at(*place));
            if (poses.empty())
                continue;
            Lead best{path, pathCost(strict_, path, environment_), 0.0, mostCusps};
            for (const double bends : REACHES)
            {
                const double begin = std::min(part.begin, *place - bends * bend);
                const double end = std::max(part.end, *place + bends * bend);
                const Gap gap = cutOut(path, std::max(0.0, begin), std::min(whole, end));
                for (const Pose &through : poses)
                {
                    if (stop && stop())
                        return improved;
                    lead(gap, through, best);
                }
            }
            if (best.reach == 0.0)
                continue;
            path = std::move(best.path);
            improved = true;
            // What comes of it may still be near to something, and is looked at from there on.
            done = std::max(done + SAMPLES_APART, best.reach);
            parts = closeParts(path);
            k = static_cast<std::size_t>(-1);
        }
        return improved;
    }
}  // namespace parking::search
