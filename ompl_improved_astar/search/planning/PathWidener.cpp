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
        constexpr std::size_t POSES_BETWEEN_STOPS = 4;
        constexpr double LEAST_GAIN = 1e-4;  // metres of cost: smaller gains are not worth a new path
        constexpr double LEVER = 2.0;        // metres: a turn moves the ends of the body by about as much per radian
        // How far from that pose the path is left, and reached again, at least: in widths of the bend by which a car
        // gets to the side by the preferred clearance.
        constexpr std::array<double, 3> REACHES{1.5, 3.0, 6.0};
        constexpr double AT_CUSP = 0.1;  // metres along the path: no farther from a cusp is at it

        /** By what a pose is changed, in preferred clearances. */
        struct Change
        {
            double along;  ///< in the direction of the heading,
            double aside;  ///< to the left of it,
            double turn;   ///< to the left: by so much at the ends of the body
        };

        /** To the side and by a turn, from the smallest change on. */
        std::vector<Change> changesSidewards()
        {
            constexpr std::array<double, 9> ASIDE{-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0};
            std::vector<Change> all;
            for (const double aside : ASIDE)
                for (const double turn : ASIDE)
                    all.push_back({0.0, aside, turn});
            std::stable_sort(all.begin(), all.end(),
                             [](const Change &a, const Change &b)
                             { return std::hypot(a.aside, a.turn) < std::hypot(b.aside, b.turn); });
            return all;
        }

        /** Farther and farther along, with turns. */
        std::vector<Change> changesBackwards()
        {
            std::vector<Change> all;
            for (const double along : {0.5, 1.0, 2.0, 3.0, 4.0, 6.0})
                for (const double turn : {0.0, -0.5, 0.5, -1.0, 1.0, -2.0, 2.0})
                    all.push_back({along, 0.0, turn});
            return all;
        }

        /** What begins with the first cusp of a path about so many metres along it. */
        std::optional<Stretch> behindCuspAt(const Path &path, double place)
        {
            for (const Stretch &stretch : path.stretches())
                if (stretch.first > 0 && std::abs(stretch.begin - place) <= AT_CUSP)
                    return stretch;
            return std::nullopt;
        }
    }  // namespace

    std::vector<Pose> PathWidener::posesNear(const ClosePart &part, const StopFunction &stop)
    {
        std::vector<Pose> result;
        std::size_t asked = 0;
        // Adds the first of the changed poses that have room.
        const auto add = [&](const Pose &pose, const std::vector<Change> &changes, double direction)
        {
            const std::size_t most = result.size() + tuning_.posesBeside;
            for (const Change &change : changes)
            {
                if (result.size() == most)
                    return true;
                if (++asked % POSES_BETWEEN_STOPS == 0 && stop && stop())
                    return false;
                const double along = direction * change.along * cost_.preferredClearance;
                const double aside = change.aside * cost_.preferredClearance;
                const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
                const Pose changed{pose.x + along * c - aside * s, pose.y + along * s + aside * c,
                                   pose.yaw + change.turn * cost_.preferredClearance / LEVER};
                if (environment_.keeps(changed, strict_.preferredClearance) && environment_.isPassable(changed))
                    result.push_back(changed);
            }
            return true;
        };
        static const std::vector<Change> backwards = changesBackwards(), sidewards = changesSidewards();
        const Path &path = priced_.path;
        if (const std::optional<Stretch> behind = behindCuspAt(path, part.nearest);
            behind && !add(path.at(behind->begin), backwards, behind->direction))
            return {};
        return add(path.at(part.nearest), sidewards, 1.0) ? result : std::vector<Pose>();
    }

    bool PathWidener::leadAside(const ClosePart &part, std::size_t mostCusps, double &reach, const StopFunction &stop)
    {
        /** The path with a part led aside, and metres along it to the pose aside. */
        struct Lead
        {
            PricedPath priced;
            double reach;
        };
        const std::vector<Pose> poses = posesNear(part, stop);
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
        std::vector<ClosePart> parts = close(path, 0.0, stop);
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
            done = std::max(done + PARTS_APART, reach);
            parts = close(priced_.path, done, stop);
            k = 0;
        }
        // A way to a pose aside may be near to something, too.
        if (improved && !isTooNear_)
            isTooNear_ = !close(priced_.path, 0.0, stop).empty();
        if (improved)
            path = priced_.path;
        return improved;
    }
}  // namespace parking::search
