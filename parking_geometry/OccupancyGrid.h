#pragma once

#include "parking_geometry/Pose.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief What a map says of a cell. A map that says nothing of it (Unknown) will never say more. */
    enum class Cell : std::uint8_t
    {
        Free = 0,      ///< no obstacle in it
        Occupied = 1,  ///< an obstacle, as large as the cell
        Unknown = 2    ///< nothing was seen of it: an obstacle or not, as the user says
    };

    /** \brief A map of square cells.

        Cell (0, 0) is the lower left one; column i covers x in [i, i + 1] * resolution and row j likewise in the frame
        \e origin (the pose of the lower left corner of the map, yaw included). Outside of the map nothing is known;
        checkers treat it as occupied. */
    class OccupancyGrid
    {
    public:
        /** \brief An empty grid of no cells: usable only to be assigned to. */
        OccupancyGrid() = default;

        /** \brief A grid with every cell \e fill.

            Throws parking::Error when a side is zero, the resolution is not a positive finite number, the origin is not
            finite or the map would have more than 2^31 cells. */
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

        /** \brief Moves the map; the cells stay as they are. The pose must be finite, which is not checked. */
        void setOrigin(const Pose &origin)
        {
            origin_ = origin;
        }

        /** \brief What is known of a cell, which must lie in the map: that is not checked. */
        Cell at(std::size_t column, std::size_t row) const
        {
            return cells_[row * width_ + column];
        }

        /** \brief Changes a cell, which must lie in the map: that is not checked. */
        void set(std::size_t column, std::size_t row, Cell cell)
        {
            cells_[row * width_ + column] = cell;
        }

        /** \brief Cells row by row, lowest row first. */
        const std::vector<Cell> &cells() const
        {
            return cells_;
        }

        /** \brief The four corners of the map in the frame that the origin is given in, counter-clockwise. */
        std::vector<Eigen::Vector2d> outline() const;

    private:
        std::size_t width_{0};
        std::size_t height_{0};
        double resolution_{1.0};
        Pose origin_;
        std::vector<Cell> cells_;
    };
}  // namespace parking
