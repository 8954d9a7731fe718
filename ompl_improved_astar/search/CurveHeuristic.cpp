#include "ompl_improved_astar/search/CurveHeuristic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        // Cells in units of the turning radius and of a whole turn, near the targets and farther away.
        constexpr double NEAR = 1.5, NEAR_CELL = 0.04, FAR_CELL = 0.16;
        constexpr int NEAR_HEADINGS = 180, FAR_HEADINGS = 60;
        constexpr std::size_t SLOTS = 1u << 14;
    }  // namespace

    CurveHeuristic::CurveHeuristic(const ReedsShepp &curves) : curves_(curves), slots_(SLOTS)
    {
    }

    void CurveHeuristic::reset(bool backwards)
    {
        backwards_ = backwards;
        targets_.clear();
        ++generation_;
    }

    void CurveHeuristic::addTarget(const Pose &target)
    {
        targets_.push_back(target);
        ++generation_;
    }

    double CurveHeuristic::exact(const Pose &pose) const
    {
        double shortest = std::numeric_limits<double>::infinity();
        for (const Pose &target : targets_)
            shortest = std::min(shortest, backwards_ ? curves_.distance(target, pose) : curves_.distance(pose, target));
        return shortest;
    }

    double CurveHeuristic::approximate(const Pose &pose)
    {
        if (targets_.empty())
            return 0.0;
        const Pose &frame = targets_.front();
        const double dx = pose.x - frame.x, dy = pose.y - frame.y, radius = curves_.turningRadius();
        const bool near = std::max(std::abs(dx), std::abs(dy)) < NEAR * radius;
        const double cell = (near ? NEAR_CELL : FAR_CELL) * radius;
        const int headings = near ? NEAR_HEADINGS : FAR_HEADINGS;
        const double turn = wrapAngle(pose.yaw - frame.yaw) / (2.0 * PI) * headings;
        const auto column = static_cast<std::int64_t>(std::lround(dx / cell));
        const auto row = static_cast<std::int64_t>(std::lround(dy / cell));
        const auto heading = static_cast<std::int64_t>((std::lround(turn) + headings) % headings);
        const std::uint64_t key = (static_cast<std::uint64_t>(column & 0xffffff) << 36) |
                                  (static_cast<std::uint64_t>(row & 0xffffff) << 12) |
                                  (static_cast<std::uint64_t>(heading) << 1) | (near ? 1u : 0u);
        Slot &slot = slots_[((key ^ (key >> 29)) * 0x9e3779b97f4a7c15ull >> 32) & (SLOTS - 1)];
        if (slot.generation != generation_ || slot.key != key)
        {
            const Pose centre{frame.x + static_cast<double>(column) * cell, frame.y + static_cast<double>(row) * cell,
                              frame.yaw + static_cast<double>(heading) * 2.0 * PI / headings};
            slot = {key, generation_, static_cast<float>(exact(centre))};
        }
        return slot.value;
    }
}  // namespace parking::search
