#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/program/MotionGuess.h"
#include "path_tracking/trajectory/program/MotionProblem.h"
#include "path_tracking/trajectory/program/Separation.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace parking
{
    /** \brief The nodes of a motion program along guessed stretches, and the guessed poses between them.

        Each stretch is split into intervals of equal duration. A standstill lies between two stretches, and at each end
        with a prescribed steering angle. A first stretch that starts in motion has none. */
    class MotionOutline
    {
    public:
        /** \param guesses at least one, each for a stretch
            \param step seconds per interval, approximately
            \param initialSteering, finalSteering radians; if absent, the steering is free there
            \param inPhases whether a stretch is split where it is fastest, see MotionProblem::phaseEnds; otherwise its
            intervals have equal durations */
        MotionOutline(std::vector<StretchGuess> guesses, const Vehicle &vehicle, double step,
                      std::optional<double> initialSteering, std::optional<double> finalSteering, bool inPhases = true);

        /** \brief Seconds of the drive along the path if the car could steer instantly. */
        double duration() const;

        /** \brief Writes directions, phases, nodes and fixed entries. */
        void write(MotionProblem &problem) const;

        /** \brief The guessed pose at a fraction of an interval. Yaw is continuous along the motion. */
        Pose poseAt(std::size_t interval, double fraction) const;

    private:
        void addInterval(int direction, std::size_t guess, double begin, bool endsPhase);
        void addStretch(std::size_t index, double step);
        void addNode(const GuessPoint &at, double duration, int fixed);

        double steeringRate_;
        bool inPhases_;
        std::vector<StretchGuess> guesses_;
        std::vector<std::size_t> guessOf_;  // per interval
        std::vector<double> begins_;        // per interval: seconds since the start of the stretch
        std::vector<int> directions_;
        std::vector<std::uint8_t> phaseEnds_;
        std::vector<NodeVector> nodes_;
        std::vector<std::uint8_t> fixed_;
    };

    /** \brief Checkpoints at every node except standstills, and between them at most \e spacing metres apart. The first
        and the last are fixed.

        \param directions per interval, 0 for a standstill
        \param poseAt the pose at a fraction of an interval */
    std::vector<GuessedCheckpoint> checkpointsAlong(
        const std::vector<int> &directions, double wheelbase, double spacing,
        const std::function<Pose(std::size_t interval, double fraction)> &poseAt);
}  // namespace parking
