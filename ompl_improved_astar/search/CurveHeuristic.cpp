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
        constexpr std::size_t SLOTS = 1u << 13;
    }  // namespace

    CurveHeuristic::CurveHeuristic(const ReedsShepp &curves) : curves_(curves), slots_(SLOTS)
    {
    }

    void CurveHeuristic::reset(bool backwards)
    {
        targets_.clear();
        frames_.clear();
        if (backwards == backwards_ && curves_.turningRadius() == radius_ && curves_.family() == family_)
            return;
        backwards_ = backwards;
        radius_ = curves_.turningRadius();
        family_ = curves_.family();
        ++generation_;
    }

    void CurveHeuristic::addTarget(const Pose &target)
    {
        targets_.push_back(target);
        frames_.push_back({std::cos(target.yaw), std::sin(target.yaw)});
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
        float shortest = std::numeric_limits<float>::infinity();
        for (std::size_t i = 0; i < targets_.size(); ++i)
        {
            const auto &[cosine, sine] = frames_[i];
            const double dx = pose.x - targets_[i].x, dy = pose.y - targets_[i].y;
            shortest = std::min(shortest, tabulated({cosine * dx + sine * dy, cosine * dy - sine * dx,
                                                     wrapAngle(pose.yaw - targets_[i].yaw)}));
        }
        return shortest;
    }

    float CurveHeuristic::tabulated(const Pose &relative)
    {
        const bool near = std::max(std::abs(relative.x), std::abs(relative.y)) < NEAR * radius_;
        const double cell = (near ? NEAR_CELL : FAR_CELL) * radius_;
        const int headings = near ? NEAR_HEADINGS : FAR_HEADINGS;
        const double turn = relative.yaw / (2.0 * PI) * headings;
        const auto column = static_cast<std::int64_t>(std::lround(relative.x / cell));
        const auto row = static_cast<std::int64_t>(std::lround(relative.y / cell));
        const auto heading = static_cast<std::int64_t>((std::lround(turn) + headings) % headings);
        const std::uint64_t key = (static_cast<std::uint64_t>(column & 0xffffff) << 36) |
                                  (static_cast<std::uint64_t>(row & 0xffffff) << 12) |
                                  (static_cast<std::uint64_t>(heading) << 1) | (near ? 1u : 0u);
        Slot &slot = slots_[((key ^ (key >> 29)) * 0x9e3779b97f4a7c15ull >> 32) & (SLOTS - 1)];
        if (slot.generation != generation_ || slot.key != key)
        {
            const Pose target, centre{static_cast<double>(column) * cell, static_cast<double>(row) * cell,
                                      static_cast<double>(heading) * 2.0 * PI / headings};
            const double length = backwards_ ? curves_.distance(target, centre) : curves_.distance(centre, target);
            slot = {key, generation_, static_cast<float>(length)};
        }
        return slot.value;
    }
}  // namespace parking::search
