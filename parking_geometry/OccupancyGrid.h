#pragma once

#include "parking_geometry/Pose.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Occupancy of a cell in a map. */
    enum class Cell : std::uint8_t
    {
        Free = 0,      ///< contains no obstacle
        Occupied = 1,  ///< the whole cell is an obstacle
        Unknown = 2    ///< not observed; an option of the user decides whether it is an obstacle
    };

    /** \brief New occupancy of one cell. */
    struct CellChange
    {
        std::uint32_t column;  ///< index of the cell along x
        std::uint32_t row;     ///< index of the cell along y
        Cell cell;             ///< its new occupancy
    };

    /** \brief Changes of single cells of a map, in order. If a cell occurs several times, the last change counts. */
    using GridUpdate = std::vector<CellChange>;

    /** \brief Throws parking::Error unless all cells of \e update lie in a map of this size and have a valid
        occupancy. */
    void checkUpdate(const GridUpdate &update, std::size_t width, std::size_t height);

    /** \brief A map of square cells.

        The frame \e origin is the pose of the lower left corner of the map, including its yaw. In this frame cell (i,
        j) covers x in [i, i + 1] * resolution and y in [j, j + 1] * resolution. Checkers treat the outside of the map
        as occupied. */
    class OccupancyGrid
    {
    public:
        /** \brief A grid without cells. Assign another grid before use. */
        OccupancyGrid() = default;

        /** \brief A grid whose cells all have the value \e fill.

            Throws parking::Error if a side is zero, the resolution is not positive, a value is not finite or there are
            more than 2^31 cells. */
        OccupancyGrid(std::size_t width, std::size_t height, double resolution, const Pose &origin = {},
                      Cell fill = Cell::Free);

        /** \brief Number of columns. */
        std::size_t width() const
        {
            return width_;
        }

        /** \brief Number of rows. */
        std::size_t height() const
        {
            return height_;
        }
        /** \brief Side of a cell in metres. */
        double resolution() const
        {
            return resolution_;
        }

        /** \brief The lower left corner of the map in the frame of its user: metres, radians. */
        const Pose &origin() const
        {
            return origin_;
        }

        /** \brief Moves the map without changing its cells. \param origin finite; not checked */
        void setOrigin(const Pose &origin)
        {
            origin_ = origin;
        }

        /** \brief Occupancy of a cell. The indices must lie in the map, which is not checked. */
        Cell at(std::size_t column, std::size_t row) const
        {
            return cells_[row * width_ + column];
        }

        /** \brief Sets a cell. The indices must lie in the map, which is not checked. */
        void set(std::size_t column, std::size_t row, Cell cell)
        {
            cells_[row * width_ + column] = cell;
        }

        /** \brief Sets the cells of \e update. Throws parking::Error, and changes nothing, if a cell lies outside of
           the map. */
        void apply(const GridUpdate &update);

        /** \brief Cells row by row, lowest row first. */
        const std::vector<Cell> &cells() const
        {
            return cells_;
        }

        /** \brief Corners of the map, counter-clockwise, in the frame in which the origin is given. */
        std::vector<Eigen::Vector2d> outline() const;

    private:
        std::size_t width_{0};
        std::size_t height_{0};
        double resolution_{1.0};
        Pose origin_;
        std::vector<Cell> cells_;
    };
}  // namespace parking
