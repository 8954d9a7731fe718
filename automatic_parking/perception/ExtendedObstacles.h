#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief A map of seen cells whose obstacles continue on unseen ground.

        A sensor sees only the near side of an obstacle. A plan through the unseen part would be blocked soon. Here
        unknown cells within \e reach of an occupied one are occupied, too, by the distance of their centres. Seen cells
        stay as they are, and so do cells that a car at its start or at a goal touches. */
    class ExtendedObstacles
    {
    public:
        /** \brief Extends the obstacles in the grid of \e seen.

            \param seen a world with a grid; its start, goals and car determine the cells that stay as they are
            \param reach metres, at least 0 */
        ExtendedObstacles(const Scenario &seen, double reach);

        /** \brief The map with extended obstacles. */
        const OccupancyGrid &map() const
        {
            return map_;
        }

        /** \brief Takes over changes of the seen map.

            \param changes cells inside of the map, each at most once
            \return the changes of map(), each cell once, valid until the next call */
        const GridUpdate &update(const GridUpdate &changes);

    private:
        Cell extended(std::size_t cell) const;

        OccupancyGrid seen_, map_;
        std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> disc_;  // columns and rows from its centre
        std::vector<std::uint32_t> near_;                              // number of occupied cells within reach
        std::vector<bool> isKept_, isTouched_;
        GridUpdate changes_;
    };
}  // namespace parking
