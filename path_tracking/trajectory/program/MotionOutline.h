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

        Every stretch is cut into intervals of equal duration. Between two stretches there is a standstill, and one at
        each end where the angle of the wheels is prescribed. */
    class MotionOutline
    {
    public:
        /** \param guesses one at least, a stretch each
            \param step seconds that an interval lasts, about
            \param initialSteering, finalSteering radians; without them the wheels are free there
            \param inPhases whether a stretch is cut where it is fastest, see MotionProblem::phaseEnds; else its
            intervals last equally long */
        MotionOutline(std::vector<StretchGuess> guesses, const Vehicle &vehicle, double step,
                      std::optional<double> initialSteering, std::optional<double> finalSteering, bool inPhases = true);

        /** \brief Seconds that driving along the path takes when the wheels need no time to turn. */
        double duration() const;

        /** \brief Writes directions, phases, nodes and what is fixed of them. */
        void write(MotionProblem &problem) const;

        /** \brief The guessed pose at a fraction of an interval; yaw continuous along the motion. */
        Pose poseAt(std::size_t interval, double fraction) const;

    private:
        void addInterval(int direction, std::size_t guess, double begin, bool endsPhase);
        void addStretch(std::size_t index, double step);
        void addNode(const GuessPoint &at, double duration, int fixed);

        double steeringRate_;
        bool inPhases_;
        std::vector<StretchGuess> guesses_;
        std::vector<std::size_t> guessOf_;  // per interval
        std::vector<double> begins_;        // per interval: seconds since the begin of the stretch
        std::vector<int> directions_;
        std::vector<std::uint8_t> phaseEnds_;
        std::vector<NodeVector> nodes_;
        std::vector<std::uint8_t> fixed_;
    };

    /** \brief Checkpoints at every node but the standing ones, and between them so that the motion goes no more than
        \e spacing metres from each to the next. The first and the last are fixed.

        \param directions per interval, 0 for a standstill
        \param poseAt the pose at a fraction of an interval */
    std::vector<GuessedCheckpoint> checkpointsAlong(
        const std::vector<int> &directions, double wheelbase, double spacing,
        const std::function<Pose(std::size_t interval, double fraction)> &poseAt);
}  // namespace parking
