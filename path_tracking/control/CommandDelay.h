#pragma once

#include "path_tracking/control/ActuatorLag.h"
#include "path_tracking/control/TrackingTypes.h"

#include <array>
#include <cstddef>
#include <deque>

namespace parking
{
    /** \brief Learns how many periods a command takes until it reaches the car, and keeps those that are under way.

        A command that is late is no lag: for a while nothing happens at all, and then everything. For every number of
        periods in question it is foretold how the wheels turn and how the speed changes over a period, each with a lag
        of its own that is learnt; the number that foretells best is taken. Once it has done so several times it is
        kept: the delay of a car does not change while it drives, but wheels that stick would look as if it had. */
    class CommandDelay
    {
    public:
        static constexpr std::size_t MOST = 6;  ///< periods that are thought of

        /** \param period seconds of control
            \param steering radians, commanded before the first command
            \param periods of delay, known beforehand
            \param sure is that number certain? Then nothing is learnt */
        CommandDelay(double period, double steering, std::size_t periods = 0, bool sure = false);

        /** \brief A command is sent off. */
        void give(const Command &command);

        /** \brief Learns from the period that \e before and \e after were measured around. */
        void learn(const Measurement &before, const Measurement &after);

        /** \brief Periods that a command takes to arrive. */
        std::size_t periods() const
        {
            return periods_;
        }

        /** \brief Seconds. */
        double time() const
        {
            return static_cast<double>(periods_) * period_;
        }

        /** \brief Has the delay been seen often enough to be sure? */
        bool isSure() const
        {
            return sure_ >= ENOUGH;
        }

        /** \brief What was sent off \e ago periods before the newest command, at most MOST + 2. */
        const Command &given(std::size_t ago) const
        {
            return given_[given_.size() - 1 - ago];
        }

        /** \brief What the car did in the last period, \e ago periods before it. */
        const Command &arrived(std::size_t ago = 0) const
        {
            return given(periods_ + ago);
        }

        /** \brief What it will be told in \e index periods: 0 is what arrives next; below periods(). */
        const Command &underWay(std::size_t index) const
        {
            return given_[given_.size() - periods_ + index];
        }

    private:
        static constexpr int ENOUGH = 5;  // periods that were foretold

        /** One number of periods, and how well it foretells. */
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
        std::array<Guess, MOST + 1> guesses_;
    };
}  // namespace parking
