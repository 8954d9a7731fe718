#include "path_tracking/trajectory/program/MotionOutline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double FEWEST_INTERVALS = 8.0;   // of a stretch
        constexpr double FEWEST_OF_PART = 3.0;     // of its acceleration and of its braking
        constexpr double LONG_AT_SPEED = 2.0;      // steps at full speed that form a phase
        constexpr double SPARE_STANDSTILL = 0.02;  // seconds

        constexpr int bit(int entry)
        {
            return 1 << entry;
        }

        constexpr int POSE = bit(NODE_X) | bit(NODE_Y) | bit(NODE_YAW);
    }  // namespace

    MotionOutline::MotionOutline(std::vector<StretchGuess> guesses, const Vehicle &vehicle, double step,
                                 std::optional<double> initialSteering, std::optional<double> finalSteering,
                                 bool inPhases)
      : steeringRate_(vehicle.maxSteeringRate),
        inPhases_(inPhases),
        guesses_(std::move(guesses))
    {
        const auto standstill = [&](GuessPoint at, double from, double to, int fixed)
        {
            at.steering = from;
            addNode(at, std::abs(to - from) / steeringRate_ + SPARE_STANDSTILL, fixed);
        };
        const GuessPoint begin = guesses_.front().at(0.0);
        const bool moves = begin.speed > 0.0;
        if (initialSteering && !moves)
        {
            standstill(begin, *initialSteering, begin.steering, POSE | bit(NODE_SPEED) | bit(NODE_STEERING));
            addInterval(0, 0, 0.0, false);
        }
        for (std::size_t i = 0; i < guesses_.size(); ++i)
        {
            const bool last = i + 1 == guesses_.size();
            addStretch(i, step);
            if (i == 0 && initialSteering && moves)
            {
                nodes_.front()[NODE_STEERING] = *initialSteering;
                fixed_.front() |= bit(NODE_STEERING);
            }
            const GuessPoint end = guesses_[i].at(guesses_[i].duration());
            if (!last)
                standstill(end, end.steering, guesses_[i + 1].at(0.0).steering, bit(NODE_SPEED));
            else if (finalSteering)
                standstill(end, end.steering, *finalSteering, POSE | bit(NODE_SPEED));
            else
                addNode(end, 0.0, POSE | bit(NODE_SPEED) | bit(NODE_DURATION));
            if (!last || finalSteering)
                addInterval(0, i, guesses_[i].duration(), false);
            if (last && finalSteering)
            {
                GuessPoint wheels = end;
                wheels.steering = *finalSteering;
                addNode(wheels, 0.0, POSE | bit(NODE_SPEED) | bit(NODE_STEERING) | bit(NODE_DURATION));
            }
        }
    }

    void MotionOutline::addNode(const GuessPoint &at, double duration, int fixed)
    {
        NodeVector node;
        node << at.pose.x, at.pose.y, at.pose.yaw, at.speed, at.steering, duration;
        nodes_.push_back(node);
        fixed_.push_back(static_cast<std::uint8_t>(fixed));
    }

    void MotionOutline::addInterval(int direction, std::size_t guess, double begin, bool endsPhase)
    {
        directions_.push_back(direction);
        guessOf_.push_back(guess);
        begins_.push_back(begin);
        phaseEnds_.push_back(endsPhase ? 1 : 0);
    }

    /** Phases end where the guess stops accelerating and starts braking, so that the program can place a node there.
        The speed is linear between nodes: without a node at its peak the peak is lost. */
    void MotionOutline::addStretch(std::size_t index, double step)
    {
        const StretchGuess &guess = guesses_[index];
        const auto [fast, brakes] = guess.fastest();
        std::vector<double> times{0.0, guess.duration()};
        double fewest = FEWEST_INTERVALS;
        if (inPhases_ && brakes > fast + LONG_AT_SPEED * step)
        {
            times = {0.0, fast, brakes, guess.duration()};
            fewest = FEWEST_OF_PART;
        }
        else if (inPhases_)
        {
            times = {0.0, 0.5 * (fast + brakes), guess.duration()};
            fewest = 0.5 * FEWEST_INTERVALS;
        }
        for (std::size_t phase = 0; phase + 1 < times.size(); ++phase)
        {
            const double begin = times[phase], length = times[phase + 1] - begin;
            const double count = std::max(fewest, std::ceil(length / step - 1e-9));
            const double h = length / count;
            for (double k = 0.0; k < count; k += 1.0)
            {
                const bool starts = phase == 0 && k == 0.0;
                addNode(guess.at(begin + k * h), h, starts ? bit(NODE_SPEED) | (index == 0 ? POSE : 0) : 0);
                addInterval(guess.direction(), index, begin + k * h, k + 1.0 == count);
            }
        }
    }

    double MotionOutline::duration() const
    {
        double sum = 0.0;
        for (const StretchGuess &guess : guesses_)
            sum += guess.duration();
        return sum;
    }

    void MotionOutline::write(MotionProblem &problem) const
    {
        problem.directions = directions_;
        problem.phaseEnds = phaseEnds_;
        problem.nodes = nodes_;
        problem.fixed = fixed_;
    }

    Pose MotionOutline::poseAt(std::size_t interval, double fraction) const
    {
        const double h = directions_[interval] != 0 ? nodes_[interval][NODE_DURATION] : 0.0;
        return guesses_[guessOf_[interval]].at(begins_[interval] + fraction * h).pose;
    }

    std::vector<GuessedCheckpoint> checkpointsAlong(
        const std::vector<int> &directions, double wheelbase, double spacing,
        const std::function<Pose(std::size_t interval, double fraction)> &poseAt)
    {
        std::vector<GuessedCheckpoint> points;
        for (std::size_t k = 0; k < directions.size(); ++k)
        {
            if (directions[k] == 0)
                continue;
            const Pose from = poseAt(k, 0.0), to = poseAt(k, 1.0);
            if (points.empty())
                points.push_back({k, 0.0, from, true});
            const double distance = positionDistance(from, to) + 0.5 * wheelbase * std::abs(to.yaw - from.yaw);
            const double parts = std::max(1.0, std::ceil(distance / spacing));
            for (double p = 1.0; p <= parts; p += 1.0)
                points.push_back({k, p / parts, poseAt(k, p / parts), false});
        }
        if (!points.empty())
            points.back().fixed = true;
        return points;
    }
}  // namespace parking
