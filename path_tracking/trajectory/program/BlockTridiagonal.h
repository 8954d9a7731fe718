#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Number of variables of a node of a motion program, see MotionProgram. */
    constexpr int NODE_SIZE = 6;
    /** \brief One number per variable of a node, in the order of NodeEntry. */
    using NodeVector = Eigen::Matrix<double, NODE_SIZE, 1>;
    /** \brief A block that couples the variables of one or two nodes. */
    using NodeMatrix = Eigen::Matrix<double, NODE_SIZE, NODE_SIZE>;

    /** \brief A symmetric block matrix that couples adjacent blocks only, and its Cholesky factorisation.

        Block row k contains diagonal[k], and below[k - 1] to its left. Time and memory grow linearly with the number of
        blocks. */
    class BlockTridiagonal
    {
    public:
        /** \brief Resizes the matrix to \e size block rows, all zero. */
        void reset(std::size_t size);

        /** \brief Number of blocks on the diagonal. */
        std::size_t size() const
        {
            return diagonal.size();
        }

        /** \brief Factorises the matrix with \e shift added to its diagonal.
            \return false if the sum is not positive definite; there is no factorisation then */
        bool factorize(double shift);

        /** \brief Solves for \e vector, in place. Requires a successful factorize(). */
        void solve(std::vector<NodeVector> &vector) const;

        std::vector<NodeMatrix> diagonal;  ///< only the lower triangles are read
        std::vector<NodeMatrix> below;     ///< below[k]: row k + 1, column k

    private:
        std::vector<NodeMatrix> factor_;  // lower triangles; the diagonals hold reciprocals
        std::vector<NodeMatrix> coupling_;
    };
}  // namespace parking
