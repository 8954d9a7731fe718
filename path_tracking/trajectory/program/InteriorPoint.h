#pragma once

#include "path_tracking/trajectory/program/MotionProgram.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief How a MotionProgram is solved. */
    struct InteriorPointOptions
    {
        double firstBarrier{5e-3};        ///< seconds; a large one forgets where the search began
        double lastBarrier{2e-5};         ///< seconds
        std::size_t mostIterations{150};  ///< steps, after which the search ends as it is
    };

    /** \brief How a search ended. */
    enum class InteriorPointStatus
    {
        Converged,    ///< optimal to the last barrier, or hardly getting better there
        Feasible,     ///< joints and inequalities hold, but it is not optimal
        Infeasible,   ///< stuck where they do not hold
        Interrupted,  ///< was told to stop
    };

    /** \brief What solveMotion() found. */
    struct InteriorPointResult
    {
        InteriorPointStatus status{InteriorPointStatus::Infeasible};  ///< what the nodes are good for
        std::vector<NodeVector> nodes;                                ///< where the search ended
        std::size_t iterations{0};                                    ///< steps taken
        double cost{0.0};                                             ///< of the motion, as MotionWeights say
    };

    /** \brief Solves a motion program from its nodes by a primal-dual interior point method.

        Newton's method for the barrier problem (J. Nocedal and S. Wright, Numerical Optimization, chapter 19) with
        slacks. Slacks and multipliers are eliminated; joints enter as A^T A / softness, which leaves a block
        tridiagonal matrix whose Cholesky factorisation also tells whether the step descends: where it fails, a multiple
        of the identity is added. Steps are shortened until an exact penalty function falls.

        \param interrupted asked in every iteration (less than a millisecond each); may be empty */
    InteriorPointResult solveMotion(MotionProgram &program, const InteriorPointOptions &options,
                                    const std::function<bool()> &interrupted);
}  // namespace parking
