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
    /** \brief Where motions are looked for. All of it is referred to. */
    struct MotionWorld
    {
        const FootprintChecker &checker;          ///< says whether a motion holds
        const Vehicle &body;                      ///< enlarged by the checker's margin, with its limits
        const std::vector<ConvexPiece> &pieces;   ///< the obstacles, in the coordinates of the checker's obstacles
        const std::function<bool()> &interrupted; /**< asked again and again; may be empty */

        /** \brief A pose in the coordinates of the pieces; its yaw is not wrapped. */
        Pose toLocal(const Pose &pose) const;
    };

    /** \brief What of the world a program sees, and from where to where it leads. */
    struct MotionView
    {
        SeparationOptions separation;  ///< which obstacles, and how far from them
        double spacing{0.2};           ///< metres between checkpoints
        std::size_t path{0};           ///< which of several paths it follows
        Pose start;                    ///< where the motion begins, in the coordinates of the checker
        Pose goal;                     ///< where it has to end, likewise
    };

    /** \brief A solution of a program. */
    struct MotionSolution
    {
        MotionProblem problem;  ///< with the nodes of the solution
        TimedMotion motion;     ///< in the coordinates of the checker
        double cost;            ///< as the weights of the problem say
        MotionView view;        ///< what solving it again depends on
    };

    /** \brief What solving a program came to. */
    struct MotionOutcome
    {
        std::optional<MotionSolution> solution;  ///< of the program, if it has one
        bool holds{false};                       ///< does its motion reach the goal and touch nothing?
        bool hasLearnt{false};                   ///< did that run into what was not known to be in the way?
        bool hasStrayed{false};                  ///< was it in obstacles for so long that it is of no use as a guess?
    };

    /** \brief Solves programs, one after another, and looks whether what they give holds: whether the motion,
       integrated, reaches the goal and touches nothing.

        What one motion runs into is kept in view for all that follow. Work is counted: iterations, each by the nodes of
        its program and a twelfth of its rows, which is what takes the time (about 1.5 microseconds each). It is counted
        instead of time, so that equal input gives equal output. */
    class MotionSolver
    {
    public:
        /** \brief Where the car may be, by interval and fraction of it: the lines that keep obstacles apart are chosen
            there. */
        using Guess = std::function<Pose(std::size_t, double)>;

        /** \brief For motions in \e world, which is referred to. */
        explicit MotionSolver(const MotionWorld &world) : world_(world)
        {
        }

        /** \brief Solves a program with lines along \e guess. */
        MotionOutcome solve(MotionProblem problem, const InteriorPointOptions &options, const Guess &guess,
                            const MotionView &view);

        /** \brief Solves a solution's program again, with lines along that solution. */
        MotionOutcome solveAgain(const MotionSolution &solution);

        /** \brief The same with nodes where accelerations and steering rates change: see endPhasesAtChanges(). */
        MotionOutcome refine(MotionSolution solution);

        /** \brief From now on there is less work to be done: something that holds is there. */
        void spareWork()
        {
            spares_ = true;
        }

        /** \brief Was it not interrupted, and is there work left to be done? */
        bool mayGoOn() const;

        /** \brief Why the last program gave nothing that holds. */
        const std::string &reason() const
        {
            return reason_;
        }

        /** \brief Programs that were solved. */
        std::size_t rounds() const
        {
            return rounds_;
        }

        /** \brief Iterations of all of them. */
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
        std::vector<std::size_t> touched_;  // pieces that motions ran into
        bool isStopped_{false};             // by the caller
        bool spares_{false};
        double work_{0.0}, budget_{0.0};
        std::string reason_;
        std::size_t rounds_{0}, iterations_{0};
    };
}  // namespace parking
