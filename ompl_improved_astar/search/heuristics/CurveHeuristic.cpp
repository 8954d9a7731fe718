#include "ompl_improved_astar/search/heuristics/CurveHeuristic.h"

#include "ompl_improved_astar/search/containers/FloatBits.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace parking::search
{
    namespace
    {
        using Cells = CurveTableCells;

        /** Lengths in turning radii by cell. A slot is one number, written and read whole: the key of its cell (33
            bits) and the length, a float that is not negative (31 bits); 0 is the key of no cell. A cell that finds its
            slot taken by another takes it over, and the other goes to the slot beside it: of two that want the same
            slot neither chases the other out.

            Only as many slots are in use as there are lengths to remember, up to all of them: the first query of a
            process would otherwise spend more on memory that was never touched than on the lengths. */
        class Table
        {
        public:
            /** \brief The length of the cell, computed by \e length() where it is not known. */
            template <class Length>
            float at(std::uint64_t key, const Length &length)
            {
                const std::uint64_t hash = (key ^ (key >> 17)) * 0x9e3779b97f4a7c15ull >> 32;
                const std::uint64_t mask = mask_.load(std::memory_order_relaxed);
                std::atomic<std::uint64_t> &first = slots_[hash & mask], &second = slots_[(hash & mask) ^ 1];
                const std::uint64_t atFirst = first.load(std::memory_order_relaxed);
                if (atFirst >> 31 == key)
                    return lengthOf(atFirst);
                std::uint64_t known = second.load(std::memory_order_relaxed);
                if (known >> 31 == key)
                    return lengthOf(known);
                // Where it was before the table grew.
                known = slots_[hash & (mask >> 1)].load(std::memory_order_relaxed);
                if (known >> 31 != key)
                    known = slots_[(hash & (mask >> 1)) ^ 1].load(std::memory_order_relaxed);
                if (known >> 31 != key)
                {
                    known = key << 31 | bitsOf(static_cast<float>(length()));
                    if (mask + 1 < slots_.size() && ++computed_ > mask / 2)
                        grow(mask);
                }
                second.store(atFirst, std::memory_order_relaxed);
                first.store(known, std::memory_order_relaxed);
                return lengthOf(known);
            }

        private:
            static float lengthOf(std::uint64_t known)
            {
                return floatOf(static_cast<std::uint32_t>(known & 0x7fffffffu));
            }

            void grow(std::uint64_t mask)
            {
                if (mask_.compare_exchange_strong(mask, 2 * mask + 1, std::memory_order_relaxed))
                    computed_ = 0;
            }

            std::array<std::atomic<std::uint64_t>, Cells::SLOTS> slots_{};
            std::atomic<std::uint64_t> mask_{Cells::FIRST_SLOTS - 1};  // of the slots in use
            std::atomic<std::uint64_t> computed_{0};                   // lengths since it grew last
        };

        /** Reeds-Shepp curves are as long one way as the other; Dubins curves are not. */
        Table &tableOf(CurveFamily family, bool backwards)
        {
            static Table tables[3];
            return tables[family == CurveFamily::ReedsShepp ? 0 : backwards ? 1 : 2];
        }
    }  // namespace

    void CurveHeuristic::begin(const HeuristicQuery &query)
    {
        const SearchParameters &parameters = query.parameters;
        curves_ = ReedsShepp(parameters.turningRadius,
                             parameters.forwardOnly ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
        backwards_ = query.side == Side::Goal;
        targets_ = query.targets;
        frames_.clear();
        for (const Pose &target : targets_)
            frames_.push_back({std::cos(target.yaw), std::sin(target.yaw)});
    }

    double CurveHeuristic::lowerBound(const Pose &pose)
    {
        double shortest = std::numeric_limits<double>::infinity();
        for (const Pose &target : targets_)
            shortest = std::min(shortest, backwards_ ? curves_.distance(target, pose) : curves_.distance(pose, target));
        return shortest;
    }

    double CurveHeuristic::estimate(const Pose &pose)
    {
        const double radius = curves_.turningRadius();
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < targets_.size(); ++i)
        {
            const auto &[cosine, sine] = frames_[i];
            const double dx = (pose.x - targets_[i].x) / radius, dy = (pose.y - targets_[i].y) / radius;
            const Pose relative{cosine * dx + sine * dy, cosine * dy - sine * dx,
                                wrapAngle(pose.yaw - targets_[i].yaw)};
            shortest = std::min(shortest, tabulated(relative));
        }
        return shortest * radius;
    }

    double CurveHeuristic::tabulated(const Pose &relative) const
    {
        const double farther = std::max(std::abs(relative.x), std::abs(relative.y));
        const bool near = farther < Cells::NEAR;
        const double cell = near ? Cells::NEAR_SIDE : Cells::FAR_SIDE;
        const int headings = near ? Cells::NEAR_HEADINGS : Cells::FAR_HEADINGS;
        const double column = std::round(relative.x / cell), row = std::round(relative.y / cell);
        const auto heading = (std::lround(relative.yaw / (2.0 * PI) * headings) + headings) % headings;
        const auto length = [&]
        {
            const ReedsShepp unit(1.0, curves_.family());
            const Pose target, centre{column * cell, row * cell, static_cast<double>(heading) * 2.0 * PI / headings};
            return backwards_ ? unit.distance(target, centre) : unit.distance(centre, target);
        };
        if (!(farther < Cells::FARTHEST * Cells::FAR_SIDE))
            return length();
        const auto twelveBits = [](double value)
        {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(value) & 0xfff);
        };
        const std::uint64_t key = (twelveBits(column) << 21) | (twelveBits(row) << 9) |
                                  (static_cast<std::uint64_t>(heading) << 1) | (near ? 1u : 0u);
        return tableOf(curves_.family(), backwards_).at(key, length);
    }
}  // namespace parking::search
