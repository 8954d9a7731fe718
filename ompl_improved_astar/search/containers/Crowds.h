#pragma once

#include "ompl_improved_astar/search/containers/CellTable.h"
#include "parking_geometry/Pose.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace parking::search
{
    /** \brief How often a search has expanded nodes in a place with about the same heading.

        Places are the squares of a grid, headings the sectors of a circle, the first of them centred on the x axis. */
    class Crowds
    {
    public:
        /** \brief Empty, and not usable before begin(). */
        Crowds() : counts_(FIRST_SLOTS)
        {
        }

        /** \brief Forgets all counts; memory is kept.

            \param side of a square, in metres
            \param sectors of the circle, at most 16 */
        void begin(double side, unsigned int sectors)
        {
            clear();
            side_ = side;
            sectors_ = sectors;
        }

        /** \brief Forgets all counts. */
        void clear()
        {
            counts_.clear();
        }

        /** \brief Counts an expansion at that pose. */
        void add(const Pose &pose)
        {
            const std::uint64_t place = placeOf(pose);
            counts_.set(place, at(place) + 1);
        }

        /** \brief Expansions that were counted in the place and the sector of that pose. */
        std::uint32_t at(const Pose &pose) const
        {
            return at(placeOf(pose));
        }

        /** \brief The same for what placeOf() gave. */
        std::uint32_t at(std::uint64_t place) const
        {
            const std::uint32_t count = counts_.find(place);
            return count == CellTable::NONE ? 0 : count;
        }

        /** \brief A number for the place and the sector of that pose. */
        std::uint64_t placeOf(const Pose &pose) const
        {
            // In this order all parts of the key count for the slot of a small table, too.
            constexpr std::uint64_t MASK = (std::uint64_t{1} << 28) - 1;  // what lies farther away shares counts
            const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(pose.x / side_))),
                       y = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(pose.y / side_)));
            const double turns = pose.yaw / (2.0 * PI);
            const auto sector = static_cast<std::uint64_t>(std::lround((turns - std::floor(turns)) * sectors_)) %
                                sectors_;  // the last half of a sector belongs to the first one
            return ((x & MASK) << 32) | ((y & MASK) << 4) | sector;
        }

        /** \brief The most bytes that the counts take up to their table's next growth. */
        std::size_t bytes() const
        {
            return counts_.bytes();
        }

    private:
        static constexpr std::size_t FIRST_SLOTS = 1u << 8;  // most searches end before they fill the half of it

        CellTable counts_;
        double side_{1.0};
        unsigned int sectors_{1};
    };
}  // namespace parking::search
