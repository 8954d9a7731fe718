#pragma once

#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief What an obstacle matrix knows of a cell: the paper's -1, 0 and 1. */
    enum class Traversability : std::int8_t
    {
        Impassable = -1,
        Unknown = 0,
        Traversable = 1
    };

    /** \brief The paper's obstacle matrix (section "Introducing Vehicle Volume"): for every cell of a grid whether the
       car can be there, found out when first asked for (lazily) or for all cells beforehand (eagerly).

        Where the car can be is told by a callable; with CircleValidityChecker::isFree it is the paper's test. A cell
       stands for its middle. One matrix belongs to one thread: asking it writes to it. */
    class ObstacleMatrix
    {
    public:
        /** \brief Is the car free of obstacles at (x, y)? Must give the same answer every time. */
        using Check = std::function<bool(double x, double y)>;

        /** \brief A matrix of which nothing is known yet.

            \param bounds what the cells cover; the last column and row may reach beyond
            \param resolution side of a cell in metres
            Throws parking::Error for bounds that are empty or not finite, for a resolution that is not a positive
           number or would need more than 2^30 cells, and for an empty callable. */
        ObstacleMatrix(const Bounds &bounds, double resolution, Check isFree);

        std::size_t columns() const
        {
            return columns_;
        }
        std::size_t rows() const
        {
            return rows_;
        }
        double resolution() const
        {
            return resolution_;
        }

        /** \brief The middle of a cell. */
        Eigen::Vector2d middle(std::size_t column, std::size_t row) const;

        /** \brief What is known of a cell by now. */
        Traversability known(std::size_t column, std::size_t row) const
        {
            return static_cast<Traversability>(cells_[row * columns_ + column]);
        }

        /** \brief Can the car be in the cell? Finds out when it is not known. */
        bool isTraversable(std::size_t column, std::size_t row);

        /** \brief The same for the cell of a point; false outside of the matrix and for points that are not finite. */
        bool isTraversableAt(double x, double y);

        /** \brief Finds out about every cell that is not known. */
        void fill();

        /** \brief Forgets everything. */
        void clear();

        /** \brief How often the callable was asked since construction or clear(). */
        std::size_t evaluations() const
        {
            return evaluations_;
        }

        /** \brief How long that took, in seconds of the wall clock. */
        double fillingTime() const
        {
            return fillingTime_;
        }

    private:
        void evaluate(std::size_t column, std::size_t row);

        Eigen::Vector2d origin_;
        double resolution_;
        Check isFree_;
        std::size_t columns_, rows_;
        std::vector<std::int8_t> cells_;
        std::size_t evaluations_{0};
        double fillingTime_{0.0};
    };
}  // namespace parking
