#pragma once

#include "ompl_improved_astar/search/containers/CellTable.h"
#include "parking_geometry/Pose.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace parking::search
{
    /** \brief Counts expansions per region: squares of a grid and eight sectors of heading. */
    class ExpansionDensity
    {
    public:
        /** \brief Removes all counts; memory is kept. \param side side of a square in metres */
        void begin(double side)
        {
            counts_.clear();
            side_ = side;
        }

        /** \brief Counts an expansion at \e pose. */
        void add(const Pose &pose)
        {
            counts_.set(keyOf(pose), at(pose) + 1);
        }

        /** \brief Number of expansions in the region of \e pose. */
        std::uint32_t at(const Pose &pose) const
        {
            const std::uint32_t count = counts_.find(keyOf(pose));
            return count == CellTable::NONE ? 0 : count;
        }

        /** \brief Upper limit of the bytes of the counts, including growth. */
        std::size_t bytes() const
        {
            return counts_.bytes();
        }

    private:
        static constexpr std::size_t FIRST_SLOTS = 1u << 8;  // most searches end before they fill half of it
        static constexpr unsigned int SECTORS = 8;

        std::uint64_t keyOf(const Pose &pose) const
        {
            constexpr std::uint64_t MASK = (std::uint64_t{1} << 28) - 1;  // what lies farther away shares counts
            const auto column = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(pose.x / side_))),
                       row = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(pose.y / side_)));
            const double turns = pose.yaw / (2.0 * PI);
            const auto sector =
                static_cast<std::uint64_t>(std::lround((turns - std::floor(turns)) * SECTORS)) % SECTORS;
            return ((column & MASK) << 32) | ((row & MASK) << 4) | sector;
        }

        CellTable counts_{FIRST_SLOTS};
        double side_{1.0};
    };
}  // namespace parking::search
