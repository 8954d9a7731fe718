#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace parking::search
{
    /** \brief A grid of cells of type T whose memory grows with the area that is accessed.

        Cells are stored in square tiles that are created on first access. clear() keeps the tiles for reuse.
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

        /** \brief Whether the cell lies within reach. False for numbers that are not finite. */
        template <class Number>
        static bool contains(Number column, Number row)
        {
            return column >= -REACH && row >= -REACH && column < REACH && row < REACH;
        }

        /** \brief The cell, initially T(). Must be contained. The reference is valid until clear(). */
        T &at(std::int32_t column, std::int32_t row)
        {
            std::uint32_t &entry = directory_[tileOf(column, row)];
            if (entry == 0)
                entry = makeTile(tileOf(column, row));
            return (*tiles_[entry - 1])[placeInTile(column, row)];
        }

        /** \brief The cell, or nullptr if its tile was never accessed. Must be contained. */
        const T *find(std::int32_t column, std::int32_t row) const
        {
            const std::uint32_t entry = directory_[tileOf(column, row)];
            return entry == 0 ? nullptr : &(*tiles_[entry - 1])[placeInTile(column, row)];
        }

        /** \brief Calls visit(column, row, cell) for all cells of the tiles in use. */
        template <class Visit>
        void forEach(const Visit &visit) const
        {
            for (std::size_t tile = 0; tile < touched_.size(); ++tile)
                for (std::uint32_t place = 0; place < TILE * TILE; ++place)
                    visit(static_cast<std::int32_t>(touched_[tile] % DIRECTORY * TILE + place % TILE) - REACH,
                          static_cast<std::int32_t>(touched_[tile] / DIRECTORY * TILE + place / TILE) - REACH,
                          (*tiles_[tile])[place]);
        }

        /** \brief Bytes of the tiles in use. */
        std::size_t bytes() const
        {
            return touched_.size() * sizeof(Tile);
        }

        /** \brief Resets all cells; memory is kept. */
        void clear()
        {
            for (const std::uint32_t place : touched_)
                directory_[place] = 0;
            touched_.clear();
        }

    private:
        using Tile = std::array<T, static_cast<std::size_t>(TILE) * TILE>;

        static std::uint32_t tileOf(std::int32_t column, std::int32_t row)
        {
            return static_cast<std::uint32_t>(row + REACH) / TILE * DIRECTORY +
                   static_cast<std::uint32_t>(column + REACH) / TILE;
        }

        static std::uint32_t placeInTile(std::int32_t column, std::int32_t row)
        {
            return static_cast<std::uint32_t>(row + REACH) % TILE * TILE +
                   static_cast<std::uint32_t>(column + REACH) % TILE;
        }

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
