#pragma once

#include "path_tracking/control/ActuatorLag.h"
#include "path_tracking/control/TrackingTypes.h"

#include <array>
#include <cstddef>
#include <deque>

namespace parking
{
    /** \brief Estimates the delay of commands in periods, and stores the commands on their way.

        A delay differs from a lag: the car first does not respond at all, then fully. For every possible delay, the
        class predicts the turn of the wheels and the change of speed over a period, each with its own learnt lag. The
        delay with the smallest prediction error is used.

        Once the same delay was best several times, it is fixed. The delay of a car does not change while it drives, but
        wheels that stick would look like a longer one. */
    class CommandDelay
    {
    public:
        static constexpr std::size_t MAX_PERIODS = 6;  ///< maximum delay, in periods

        /** \param period seconds of control
            \param steering radians, commanded before the first command
            \param periods initial delay, in periods
            \param sure whether that delay is certain and need not be learnt */
        CommandDelay(double period, double steering, std::size_t periods = 0, bool sure = false);

        /** \brief Records a command when it is sent. */
        void give(const Command &command);

        /** \brief Updates the estimate from the period between two measurements. */
        void learn(const Measurement &before, const Measurement &after);

        /** \brief Delay of a command in periods. */
        std::size_t periods() const
        {
            return periods_;
        }

        /** \brief Delay of a command in seconds. */
        double time() const
        {
            return static_cast<double>(periods_) * period_;
        }

        /** \brief Whether the delay was confirmed often enough. */
        bool isSure() const
        {
            return sure_ >= ENOUGH;
        }

        /** \brief The command sent \e ago periods before the newest one, at most MAX_PERIODS + 2. */
        const Command &given(std::size_t ago) const
        {
            return given_[given_.size() - 1 - ago];
        }

        /** \brief The command that the car executed \e ago periods before the last one. */
        const Command &arrived(std::size_t ago = 0) const
        {
            return given(periods_ + ago);
        }

        /** \brief The command that arrives in \e index periods, below periods(); 0 arrives next. */
        const Command &underWay(std::size_t index) const
        {
            return given_[given_.size() - periods_ + index];
        }

    private:
        static constexpr int ENOUGH = 5;  // correct predictions

        /** A possible delay with its prediction error. */
        struct Guess
        {
            LagEstimator wheels;
            DriveLagEstimator drive;
            double error{0.0};
        };

        double period_;
        std::size_t periods_;
        int sure_{0};
        std::deque<Command> given_;  // the newest last
        std::array<Guess, MAX_PERIODS + 1> guesses_;
    };
}  // namespace parking
