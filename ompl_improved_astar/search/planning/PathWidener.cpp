#include "ompl_improved_astar/search/planning/PathWidener.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double HARDLY_LESS = 0.98;    // of the preferred clearance is as good
        constexpr double LONG_STRIDE = 1.0;     // metres, where the car gets near to nothing in between,
        constexpr double MIDDLE_STRIDE = 0.25;  // or not so far
        constexpr double SHORT_STRIDE = 0.05;   // metres, elsewhere
        constexpr double FARTHEST_POINT = 1.5;  // turning radii from the rear axle to the body's, or not much more
        constexpr std::size_t POSES_BETWEEN_STOPS = 4;
        constexpr double SAME_PART = 0.5;    // metres: parts nearer to each other are one
        constexpr double LEAST_GAIN = 1e-4;  // metres of cost: smaller gains are not worth a new path
        constexpr double LEVER = 2.0;        // metres: a turn moves the ends of the body by about as much per radian
        // To the side and by a turn, in preferred clearances.
        constexpr std::array<double, 9> ASIDE{-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0};
        // How far from that pose the path is left, and reached again, at least: in widths of the bend by which a car
        // gets to the side by the preferred clearance.
        constexpr std::array<double, 3> REACHES{1.5, 3.0, 6.0};
    }  // namespace

    std::vector<PathWidener::ClosePart> PathWidener::closeParts(const Path &path, double from, const StopFunction &stop)
    {
        std::vector<ClosePart> parts;
        const double enough = HARDLY_LESS * cost_.preferredClearance;
        Pose pose = path.start;
        double driven = 0.0;
        std::size_t asked = 0;
        for (const PathPiece &piece : path.pieces)
        {
            const Arc arc{piece.curvature, piece.length};
            const double length = piece.driven();
            double clear = length;
            if (driven + length > from)
                environment_.clearLengths(pose, &arc, 1, cost_.preferredClearance, &clear);
            // No point of the body moves much farther than this per metre: where there is room, strides are long.
            const double speed = 1.0 + FARTHEST_POINT * std::abs(piece.curvature) * curves_.turningRadius();
            for (double at = std::max(clear, from - driven); clear < length;)
            {
                // Some checkers take long to tell clearances.
                if (++asked % POSES_BETWEEN_STOPS == 0 && stop && stop())
                    return parts;
                const Pose there = advance(pose, piece, at);
                double stride = SHORT_STRIDE;
                if (environment_.keeps(there, enough + speed * LONG_STRIDE))
                    stride = LONG_STRIDE;
                else if (environment_.keeps(there, enough + speed * MIDDLE_STRIDE))
                    stride = MIDDLE_STRIDE;
                else if (!environment_.keeps(there, enough))
                {
                    const double place = driven + at, clearance = environment_.clearance(there);
                    if (parts.empty() || place - parts.back().end > SAME_PART)
                        parts.push_back({place, place, place, clearance});
                    ClosePart &part = parts.back();
                    part.end = place;
                    if (clearance < part.clearance)
                    {
                        part.nearest = place;
                        part.clearance = clearance;
                    }
                }
                if (at >= length)
                    break;
                at = std::min(length, at + stride);
            }
            driven += length;
            pose = advance(pose, piece);
        }
        return parts;
    }

    std::vector<Pose> PathWidener::posesBeside(const Pose &pose, const StopFunction &stop)
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
        std::size_t asked = 0;
        for (const auto &[aside, turn] : changes)
        {
            if (result.size() >= tuning_.posesBeside)
                break;
            if (++asked % POSES_BETWEEN_STOPS == 0 && stop && stop())
                return {};
            const double side = aside * cost_.preferredClearance;
            const Pose beside{pose.x - side * std::sin(pose.yaw), pose.y + side * std::cos(pose.yaw),
                              pose.yaw + turn * cost_.preferredClearance / LEVER};
            if (environment_.keeps(beside, strict_.preferredClearance) && environment_.isPassable(beside))
                result.push_back(beside);
        }
        return result;
    }

    bool PathWidener::leadAside(const ClosePart &part, std::size_t mostCusps, double &reach, const StopFunction &stop)
    {
        /** The path with a part led aside, and metres along it to the pose aside. */
        struct Lead
        {
            PricedPath priced;
            double reach;
        };
        const std::vector<Pose> poses = posesBeside(priced_.path.at(part.nearest), stop);
        if (poses.empty())
            return false;
        // Of most paths no part is too near, or nothing beside it free, so that this is left until now.
        if (priced_.closeness.empty())
        {
            std::optional<PricedPath> priced = pricePath(strict_, priced_.path, environment_, stop);
            if (!priced)
                return false;
            priced_ = std::move(*priced);
        }
        const double bend = std::sqrt(curves_.turningRadius() * cost_.preferredClearance);
        const double whole = priced_.path.length(), mostCost = priced_.cost - LEAST_GAIN;
        std::vector<Lead> leads;
        for (const double bends : REACHES)
        {
            const double begin = std::min(part.begin, part.nearest - bends * bend);
            const double end = std::max(part.end, part.nearest + bends * bend);
            const GapBridge::Gap gap = bridge_.cutOut(priced_, std::max(0.0, begin), std::min(whole, end));
            for (const Pose &through : poses)
            {
                if (stop && stop())
                    return false;
                std::optional<GapBridge::Bridged> led = bridge_.lead(gap, through, gap.cost - LEAST_GAIN, mostCusps);
                if (!led)
                    continue;
                // Closeness is sampled: the cost of the whole is not quite the sum of its parts'.
                std::optional<PricedPath> priced = pricePath(strict_, std::move(led->path), environment_, stop);
                if (!priced)
                    return false;
                if (priced->cost < mostCost)
                    leads.push_back({std::move(*priced), led->reach});
            }
        }
        std::stable_sort(leads.begin(), leads.end(),
                         [](const Lead &a, const Lead &b) { return a.priced.cost < b.priced.cost; });
        for (Lead &each : leads)
        {
            if (stop && stop())
                return false;
            if (environment_.acceptPath(each.priced.path))
            {
                priced_ = std::move(each.priced);
                reach = each.reach;
                return true;
            }
        }
        return false;
    }

    bool PathWidener::pass(Path &path, const StopFunction &stop)
    {
        bool improved = false;
        double done = 0.0;  // metres along the path
        const std::size_t mostCusps = path.cusps() + 1;
        priced_ = {path, {}, 0.0};
        std::vector<ClosePart> parts = closeParts(path, 0.0, stop);
        isTooNear_ = false;
        for (std::size_t k = 0; k < parts.size() && !(stop && stop());)
        {
            const ClosePart part = parts[k++];
            double reach = 0.0;
            const bool isAtAnEnd = part.begin <= 0.0 || part.end >= priced_.path.length();
            if (isAtAnEnd || !leadAside(part, mostCusps, reach, stop))
            {
                isTooNear_ = true;
                continue;
            }
            improved = true;
            // What comes of it may still be near to something, and is looked at from there on.
            done = std::max(done + SAME_PART, reach);
            parts = closeParts(priced_.path, done, stop);
            k = 0;
        }
        // A way to a pose aside may be near to something, too.
        if (improved && !isTooNear_)
            isTooNear_ = !closeParts(priced_.path, 0.0, stop).empty();
        if (improved)
            path = priced_.path;
        return improved;
    }
}  // namespace parking::search
