#pragma once

#include "path_tracking/trajectory/program/MotionProgram.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief Options for solving a MotionProgram. */
    struct InteriorPointOptions
    {
        double firstBarrier{5e-3};       ///< seconds; with a large value the initial guess has little effect
        double lastBarrier{2e-5};        ///< seconds; the search ends at this barrier
        std::size_t maxIterations{150};  ///< maximum number of steps
    };

    /** \brief Status of a finished search. */
    enum class InteriorPointStatus
    {
        Converged,    ///< optimal at the last barrier, or without further progress
        Feasible,     ///< joints and inequalities are satisfied, but the solution is not optimal
        Infeasible,   ///< stuck where joints or inequalities are violated
        Interrupted,  ///< stopped by the caller
    };

    /** \brief Result of solveMotion(). */
    struct InteriorPointResult
    {
        InteriorPointStatus status{InteriorPointStatus::Infeasible};  ///< quality of the nodes
        std::vector<NodeVector> nodes;                                ///< final nodes of the search
        std::size_t iterations{0};                                    ///< steps taken
        double cost{0.0};                                             ///< of the motion, by MotionWeights
    };

    /** \brief Solves a motion program from its nodes by a primal-dual interior point method.

        It is Newton's method for the barrier problem (J. Nocedal and S. Wright, Numerical Optimization, chapter 19)
        with slacks. Slacks and multipliers are eliminated; joints enter as A^T A / softness. The remaining block
        tridiagonal matrix is factorised by Cholesky's method. If that fails, the step does not descend, and a multiple
        of the identity is added. Steps are shortened until an exact penalty function decreases.

        \param interrupted polled in every iteration (less than a millisecond each); may be empty */
    InteriorPointResult solveMotion(MotionProgram &program, const InteriorPointOptions &options,
                                    const std::function<bool()> &interrupted);
}  // namespace parking
