#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/program/ConvexPiece.h"
#include "path_tracking/trajectory/program/InteriorPoint.h"
#include "path_tracking/trajectory/program/MotionProblem.h"
#include "path_tracking/trajectory/program/Separation.h"
#include "state_validity/FootprintChecker.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief World of a motion program. All members are references. */
    struct MotionWorld
    {
        const FootprintChecker &checker;          ///< decides whether a motion is free
        const Vehicle &vehicle;                   ///< its wheelbase and its limits
        const std::vector<ConvexPiece> &body;     ///< parts of the body with the checker's margin, see partsOf()
        const std::vector<ConvexPiece> &pieces;   ///< the obstacles, in the coordinates of the checker
        const std::function<bool()> &interrupted; /**< polled during the search; may be empty */

        /** \brief Transforms a pose to the coordinates of the pieces. Its yaw is not wrapped. */
        Pose toLocal(const Pose &pose) const;
    };

    /** \brief Obstacles that a program considers, and the ends of its motion. */
    struct MotionView
    {
        SeparationOptions separation;  ///< selects obstacles and their distance
        double spacing{0.2};           ///< metres between checkpoints
        std::size_t path{0};           ///< index among the given paths
        Pose start;                    ///< first pose, in the coordinates of the checker
        Pose goal;                     ///< required last pose, in the coordinates of the checker
    };

    /** \brief Solution of a program. */
    struct MotionSolution
    {
        MotionProblem problem;  ///< with the nodes of the solution
        TimedMotion motion;     ///< in the coordinates of the checker
        double cost;            ///< by the weights of the problem
        MotionView view;        ///< data for solving the program again
    };

    /** \brief Result of solving a program. */
    struct MotionOutcome
    {
        std::optional<MotionSolution> solution;  ///< of the program; absent if there is none
        bool holds{false};                       ///< whether the motion reaches the goal without collision
        bool hasLearnt{false};                   ///< whether the motion touched obstacles that were not considered
        bool hasStrayed{false};                  ///< whether the motion collides for too long to serve as a guess
    };

    /** \brief Solves programs one after another and checks their motions by integration: each must reach the goal
        without collision.

        Obstacles that a motion touches are considered by all later programs. The solver counts work instead of time, so
        that equal inputs give equal outputs. The work of an iteration is the number of nodes plus a twelfth of the
        number of rows, at about 1.5 microseconds per unit. */
    class MotionSolver
    {
    public:
        /** \brief Guessed pose by interval and fraction of it. Separating lines are chosen there. */
        using Guess = std::function<Pose(std::size_t, double)>;

        /** \brief Creates a solver for \e world, which must outlive it. */
        explicit MotionSolver(const MotionWorld &world) : world_(world)
        {
        }

        /** \brief Solves a program with separating lines along \e guess. */
        MotionOutcome solve(MotionProblem problem, const InteriorPointOptions &options, const Guess &guess,
                            const MotionView &view);

        /** \brief Solves the program of a solution again, with separating lines along that solution. */
        MotionOutcome solveAgain(const MotionSolution &solution);

        /** \brief Solves the program of a solution again, with nodes where accelerations and steering rates change; see
            endPhasesAtChanges(). */
        MotionOutcome refine(MotionSolution solution);

        /** \brief Lowers the remaining budget of work; call it once a valid motion is available. */
        void lowerBudget()
        {
            isBudgetLowered_ = true;
        }

        /** \brief Whether work is left and the solver was not interrupted. */
        bool mayContinue() const;

        /** \brief Reason why the last program gave no valid motion. */
        const std::string &reason() const
        {
            return reason_;
        }

        /** \brief Number of programs solved. */
        std::size_t rounds() const
        {
            return rounds_;
        }

        /** \brief Number of iterations of all programs. */
        std::size_t iterations() const
        {
            return iterations_;
        }

    private:
        MotionOutcome solveFrom(const MotionSolution &solution, const InteriorPointOptions &options);
        double left() const;
        void stop();
        std::optional<double> minimize(MotionProblem &problem, InteriorPointOptions options);
        bool reachesGoal(const TimedMotion &motion, const MotionView &view) const;
        void check(MotionOutcome &outcome);

        const MotionWorld &world_;
        std::vector<std::size_t> touched_;  // pieces that motions touched
        bool isStopped_{false};             // by the caller
        bool isBudgetLowered_{false};
        double work_{0.0}, budget_{0.0};
        std::string reason_;
        std::size_t rounds_{0}, iterations_{0};
    };
}  // namespace parking
