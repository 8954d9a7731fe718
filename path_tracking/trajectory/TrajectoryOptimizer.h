#pragma once

#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/program/ConvexPiece.h"
#include "path_tracking/trajectory/program/MotionProblem.h"
#include "state_validity/FootprintChecker.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    class MotionOutline;
    class StretchGuess;

    /** \brief Options of a TrajectoryOptimizer. */
    struct TrajectoryOptions
    {
        MotionWeights weights{1.0, 0.0, 0.0, 0.01};  ///< by default time, and a small proximity cost
        double margin{0.002};  ///< metres, minimum distance to obstacles beyond the checker's margin
        /** Metres beyond the checker's margin, kept where that costs little. A metre driven in contact costs
            weights.nearness, at half of this distance a quarter. */
        double preferredClearance{0.1};
        double step{0.3};  ///< seconds between two nodes, approximately

        // Used shares of the car's limits; a controller needs the rest for corrections.
        double speedShare{1.0};         ///< used share of the speed limit, in (0, 1]
        double accelerationShare{1.0};  ///< used share of the acceleration limit along the path, in (0, 1]
        /** Used share of the steering angle, in (0, 1]; the motion may fail where the path needs more. */
        double steeringShare{1.0};
        double steeringRateShare{1.0};  ///< used share of the steering rate, in (0, 1]

        /** Whether nodes are placed where the motion changes from one limit to another, instead of evenly. The motion
            is then 0.3 % faster. Disable it for motions that a controller follows: smoother changes leave more control
            margin, and errors by noise and lags are up to three times smaller. */
        bool sharpest{true};

        std::optional<double> initialSteering{0.0};  ///< radians at the start; if absent, the initial steering is free
        /** Speed at the start in m/s, in the direction of the path's first stretch. A moving car has an initial
           steering angle, and no motion by stopAndSteer(). */
        double initialSpeed{0.0};
        std::optional<double> finalSteering{0.0};  ///< radians at the end; if absent, the final steering is free
        std::size_t maxRounds{6};                  ///< maximum number of attempts along a path, and of improvements

        /** \brief Weights of the Trajectory Planning Competition of Automated Parking, divided by 100. */
        static MotionWeights tpcapWeights()
        {
            return {1.0, 0.1, 0.1, 0.0};
        }

        /** \brief Throws parking::Error naming the first field that is not finite or out of its range. */
        void validate() const;
    };

    /** \brief Result of optimising a trajectory. */
    struct OptimizedTrajectory
    {
        TimedMotion motion;  ///< collision-free, within the limits
        /** Whether the motion is that of stopAndSteer(). For a moving start it is then empty. */
        bool fallback{false};
        std::string reason;         ///< why no better motion was found; empty otherwise
        std::size_t path{0};        ///< index of the path from which it was optimised
        std::size_t rounds{0};      ///< number of programs solved
        std::size_t iterations{0};  ///< of the interior point method, over all programs
    };

    /** \brief Optimises the fastest trajectory near a path.

        The path is split at its cusps. Each stretch receives nodes in time, from a guess that drives along the path.
        Between two stretches and at the ends the car stands while it steers. A nonlinear program (see MotionProgram)
        moves all nodes to minimise the time. It also moves the cusps, and steers while the car drives.

        Obstacles are convex pieces. One line per checkpoint, chosen beforehand, separates each from the body (see
        SeparationPlan). Independent code integrates and sweeps the result (see collisionsOf()). After a collision the
        program is solved again with more checkpoints. After the last attempt the result is that of stopAndSteer().

        Deterministic. Const calls from several threads are safe. */
    class TrajectoryOptimizer
    {
    public:
        /** \param checker provides world, car and margin, and must outlive the optimiser

            Throws parking::Error for invalid options or an invalid car. */
        explicit TrajectoryOptimizer(const FootprintChecker &checker, TrajectoryOptions options = {});

        /** \brief The options as given. */
        const TrajectoryOptions &options() const
        {
            return options_;
        }

        /** \brief The best motion found near \e path, in the coordinates of the checker.

            If time is the only cost and the car starts at rest, it is never slower than stopAndSteer().

            \param interrupted polled about every millisecond; may be empty. Once it returns true, the result is the
            best motion found so far, otherwise that of stopAndSteer().
            Throws parking::Error for a path that no car can drive, that collides, or that takes more than
            LONGEST_MOTION with stops to steer. */
        OptimizedTrajectory optimize(const Path &path, const std::function<bool()> &interrupted = {}) const;

        /** \brief The best motion found near any of several paths between the same poses.

            One program is solved along each path. The best solutions, and those of nearly equal cost, are then
            improved. */
        OptimizedTrajectory optimizeBest(const std::vector<Path> &paths,
                                         const std::function<bool()> &interrupted = {}) const;

    private:
        class Search;

        double costOf(const TimedMotion &motion) const;
        MotionOutline outline(std::vector<StretchGuess> stretches, double step) const;
        void improve(const std::vector<Path> &paths, const std::vector<std::size_t> &which,
                     const std::function<bool()> &interrupted, OptimizedTrajectory &result) const;

        const FootprintChecker &checker_;
        TrajectoryOptions options_;
        Vehicle vehicle_;                // with the used shares of its limits
        std::vector<ConvexPiece> body_;  // parts of the body with the checker's margin
        std::vector<ConvexPiece> pieces_;
    };
}  // namespace parking
