#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Variables of one node of a motion program: see MotionProgram. */
    constexpr int NODE_SIZE = 6;
    /** \brief A number for each variable of a node, in the order of NodeEntry. */
    using NodeVector = Eigen::Matrix<double, NODE_SIZE, 1>;
    /** \brief A block that couples the variables of two nodes, or those of one. */
    using NodeMatrix = Eigen::Matrix<double, NODE_SIZE, NODE_SIZE>;

    /** \brief A symmetric matrix of blocks that couples neighbours only, and its Cholesky factorisation.

        Row of blocks k holds diagonal[k], and left of it below[k - 1]. Time and memory grow linearly with the number
        of blocks. */
    class BlockTridiagonal
    {
    public:
        /** \brief Gives the matrix \e size rows of blocks, all zero. */
        void reset(std::size_t size);

        /** \brief Number of blocks on the diagonal. */
        std::size_t size() const
        {
            return diagonal.size();
        }

        /** \brief Factorises the matrix with \e shift added to its diagonal.
            \return false when that is not positive definite; there is no factorisation then */
        bool factorize(double shift);

        /** \brief Solves for \e vector, in place. Only after factorize() has returned true. */
        void solve(std::vector<NodeVector> &vector) const;

        std::vector<NodeMatrix> diagonal;  ///< only the lower triangles are read
        std::vector<NodeMatrix> below;     ///< below[k]: row k + 1, column k

    private:
        std::vector<NodeMatrix> factor_;  // lower triangles; the diagonals hold reciprocals
        std::vector<NodeMatrix> coupling_;
    };
}  // namespace parking
