#include "path_tracking/trajectory/program/BlockTridiagonal.h"

#include <cmath>

namespace parking
{
    namespace
    {
        /** Cholesky of the lower triangle of \e matrix in place, reciprocals on the diagonal. */
        bool factorizeBlock(NodeMatrix &matrix)
        {
            for (int j = 0; j < NODE_SIZE; ++j)
            {
                double pivot = matrix(j, j);
                for (int k = 0; k < j; ++k)
                    pivot -= matrix(j, k) * matrix(j, k);
                if (!(pivot > 0.0) || !std::isfinite(pivot))
                    return false;
                const double reciprocal = 1.0 / std::sqrt(pivot);
                matrix(j, j) = reciprocal;
                for (int i = j + 1; i < NODE_SIZE; ++i)
                {
                    double value = matrix(i, j);
                    for (int k = 0; k < j; ++k)
                        value -= matrix(i, k) * matrix(j, k);
                    matrix(i, j) = value * reciprocal;
                }
            }
            return true;
        }

        /** \e matrix times the inverse transpose of the \e factor. */
        void solveTransposed(const NodeMatrix &factor, NodeMatrix &matrix)
        {
            for (int j = 0; j < NODE_SIZE; ++j)
            {
                for (int k = 0; k < j; ++k)
                    matrix.col(j) -= factor(j, k) * matrix.col(k);
                matrix.col(j) *= factor(j, j);
            }
        }
    }  // namespace

    void BlockTridiagonal::reset(std::size_t size)
    {
        diagonal.assign(size, NodeMatrix::Zero());
        below.assign(size > 0 ? size - 1 : 0, NodeMatrix::Zero());
    }

    bool BlockTridiagonal::factorize(double shift)
    {
        factor_ = diagonal;
        coupling_ = below;
        for (std::size_t k = 0; k < factor_.size(); ++k)
        {
            factor_[k].diagonal().array() += shift;
            if (k > 0)
                factor_[k] -= coupling_[k - 1].lazyProduct(coupling_[k - 1].transpose());
            if (!factorizeBlock(factor_[k]))
                return false;
            if (k + 1 < factor_.size())
                solveTransposed(factor_[k], coupling_[k]);
        }
        return true;
    }

    void BlockTridiagonal::solve(std::vector<NodeVector> &vector) const
    {
        const std::size_t n = factor_.size();
        for (std::size_t k = 0; k < n; ++k)
        {
            if (k > 0)
                vector[k].noalias() -= coupling_[k - 1] * vector[k - 1];
            for (int i = 0; i < NODE_SIZE; ++i)
            {
                for (int j = 0; j < i; ++j)
                    vector[k][i] -= factor_[k](i, j) * vector[k][j];
                vector[k][i] *= factor_[k](i, i);
            }
        }
        for (std::size_t k = n; k-- > 0;)
        {
            if (k + 1 < n)
                vector[k].noalias() -= coupling_[k].transpose() * vector[k + 1];
            for (int i = NODE_SIZE; i-- > 0;)
            {
                for (int j = i + 1; j < NODE_SIZE; ++j)
                    vector[k][i] -= factor_[k](j, i) * vector[k][j];
                vector[k][i] *= factor_[k](i, i);
            }
        }
    }
}  // namespace parking
