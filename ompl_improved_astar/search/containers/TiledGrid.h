#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace parking::search
{
    /** \brief A grid of cells of type T, of no fixed origin, whose memory grows with the area that is touched.

        Cells live in square tiles made when one of their cells is first asked for. clear() keeps the tiles for reuse.
        Columns and rows reach from -REACH to REACH - 1. */
    template <class T>
    class TiledGrid
    {
    public:
        static constexpr std::int32_t TILE = 32;                     ///< cells along the side of a tile
        static constexpr std::int32_t DIRECTORY = 128;               ///< tiles along the side of the grid
        static constexpr std::int32_t REACH = TILE * DIRECTORY / 2;  ///< cells from the origin to either side

        TiledGrid() : directory_(static_cast<std::size_t>(DIRECTORY) * DIRECTORY, 0)
        {
        }

        /** \brief Does the cell lie within reach? False for what is no number. */
        static bool contains(double column, double row)
        {
            return column >= -REACH && row >= -REACH && column < REACH && row < REACH;
        }

        /** \brief Does the cell lie within reach? */
        static bool contains(std::int32_t column, std::int32_t row)
        {
            return column >= -REACH && row >= -REACH && column < REACH && row < REACH;
        }

        /** \brief The cell, which starts as T(). Must be contained. The reference holds until clear(). */
        T &at(std::int32_t column, std::int32_t row)
        {
            const auto c = static_cast<std::uint32_t>(column + REACH), r = static_cast<std::uint32_t>(row + REACH);
            std::uint32_t &entry = directory_[r / TILE * DIRECTORY + c / TILE];
            if (entry == 0)
                entry = makeTile(r / TILE * DIRECTORY + c / TILE);
            return (*tiles_[entry - 1])[r % TILE * TILE + c % TILE];
        }

        /** \brief Calls visit(cell, column, row, diagonal) for the eight neighbours, row by row.

            \return false when some of them lie beyond the reach of the grid and were left out */
        template <class Visit>
        bool forEachNeighbour(std::int32_t column, std::int32_t row, const Visit &visit)
        {
            const auto c = static_cast<std::uint32_t>(column + REACH) % TILE,
                       r = static_cast<std::uint32_t>(row + REACH) % TILE;
            // Inside of a tile the neighbours lie at fixed distances in memory.
            const bool within = c > 0 && r > 0 && c + 1 < TILE && r + 1 < TILE;
            T *const cell = within ? &at(column, row) : nullptr;
            bool all = true;
            for (std::int32_t dr = -1; dr <= 1; ++dr)
                for (std::int32_t dc = -1; dc <= 1; ++dc)
                {
                    if (dr == 0 && dc == 0)
                        continue;
                    const bool diagonal = dr != 0 && dc != 0;
                    if (within)
                        visit(*(cell + dr * TILE + dc), column + dc, row + dr, diagonal);
                    else if (contains(column + dc, row + dr))
                        visit(at(column + dc, row + dr), column + dc, row + dr, diagonal);
                    else
                        all = false;
                }
            return all;
        }

        /** \brief Of the tiles in use. */
        std::size_t bytes() const
        {
            return touched_.size() * sizeof(Tile);
        }

        /** \brief Forgets the values of all cells; memory is kept. */
        void clear()
        {
            for (const std::uint32_t place : touched_)
                directory_[place] = 0;
            touched_.clear();
        }

    private:
        using Tile = std::array<T, static_cast<std::size_t>(TILE) * TILE>;

        std::uint32_t makeTile(std::uint32_t place)
        {
            const std::size_t used = touched_.size();
            if (used == tiles_.size())
                tiles_.push_back(std::make_unique<Tile>());
            tiles_[used]->fill(T());
            touched_.push_back(place);
            return static_cast<std::uint32_t>(used + 1);
        }

        std::vector<std::uint32_t> directory_;  // one more than the number of the tile, 0 where there is none
        std::vector<std::uint32_t> touched_;
        std::vector<std::unique_ptr<Tile>> tiles_;
    };
}  // namespace parking::search
