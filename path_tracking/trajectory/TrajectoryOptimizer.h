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

    /** \brief What a TrajectoryOptimizer aims at. */
    struct TrajectoryOptions
    {
        MotionWeights weights{1.0, 0.0, 0.0, 0.01};  ///< by default time, and a little for what is near
        double margin{0.002};  ///< metres that body and obstacles keep beyond the checker's margin
        /** Metres beyond the checker's margin that they keep where that costs little: a metre driven in touch is worth
            weights.nearness, one at half of it a quarter. */
        double preferredClearance{0.1};
        double step{0.3};  ///< seconds between two nodes, about

        // What of the car's limits is used, so that a controller has something left to correct with. In (0, 1].
        double speedShare{1.0};         ///< of the speed limit
        double accelerationShare{1.0};  ///< of the acceleration limit, along the path
        double steeringShare{1.0};      ///< of the steering angle; where the path needs more the motion may fail
        double steeringRateShare{1.0};  ///< of the steering rate

        /** Whether nodes lie where the motion changes from one limit to another, instead of being spread evenly: 0.3 %
            quicker. A motion that is to be driven by a controller should do without: where it changes more gently
            there is more to correct with, and errors of noise and lags are up to three times smaller. */
        bool sharpest{true};

        std::optional<double> initialSteering{0.0};  ///< radians; without it the wheels may begin anywhere
        std::optional<double> finalSteering{0.0};    ///< likewise at the end
        std::size_t mostRounds{6};                   ///< attempts near a path, and improvements of a motion, at most

        /** \brief Weights of the Trajectory Planning Competition of Automated Parking, per 100. */
        static MotionWeights tpcapWeights()
        {
            return {1.0, 0.1, 0.1, 0.0};
        }

        /** \brief Throws parking::Error naming the first field that is not finite or out of its range. */
        void validate() const;
    };

    /** \brief What optimising a trajectory came to. */
    struct OptimizedTrajectory
    {
        TimedMotion motion;         ///< collision free, within the limits
        bool fallback{false};       ///< the motion is stopAndSteer()'s
        std::string reason;         ///< why there is none better; empty otherwise
        std::size_t path{0};        ///< which of the given paths it was made from
        std::size_t rounds{0};      ///< programs that were solved
        std::size_t iterations{0};  ///< of the interior point method, all rounds
    };

    /** \brief From a path to the fastest trajectory nearby.

        The path is cut at its cusps. Each stretch gets nodes in time, from a guess that drives along the path; between
        two stretches, and at the ends, the car stands as long as it turns its wheels. A nonlinear program (see
        MotionProgram) moves all of this to where it takes the least time: cusps too, and the wheels turn while the car
        rolls. Obstacles are convex pieces, each kept apart by one line per checkpoint, chosen beforehand (see
        SeparationPlan). The result is then integrated and swept by other code (see collisionsOf()); if it touches
        anything there is another round with more checkpoints, and after the last one the path is driven as it is (see
        stopAndSteer()).

        Deterministic. Const calls from several threads are safe. */
    class TrajectoryOptimizer
    {
    public:
        /** \brief \param checker is referred to: the world, the car and the margin that holds for everybody

            Throws parking::Error for invalid options and a car that is not valid. */
        explicit TrajectoryOptimizer(const FootprintChecker &checker, TrajectoryOptions options = {});

        /** \brief The options as given. */
        const TrajectoryOptions &options() const
        {
            return options_;
        }

        /** \brief The best motion found near \e path, in the coordinates of the checker.

            Never slower than stopping to steer, when time is all that counts.

            \param interrupted asked about every millisecond; once it says yes the path is driven as it is, unless the
            result is there already; may be empty
            Throws parking::Error for a path that no car can drive, that collides, or that takes more than
            LONGEST_MOTION when the car stops to steer. */
        OptimizedTrajectory optimize(const Path &path, const std::function<bool()> &interrupted = {}) const;

        /** \brief The best motion found near any of several paths, from the same pose to the same pose.

            One program is solved near each; the best, and those that nearly are, are then improved. */
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
        Vehicle body_;  // enlarged by the checker's margin, with what may be used of its limits
        std::vector<ConvexPiece> pieces_;
    };
}  // namespace parking
