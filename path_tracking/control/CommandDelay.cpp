#include "path_tracking/control/CommandDelay.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double KEPT = 0.8;           // decay of the error per period
        constexpr double ANGLE = 0.005;        // radians, tolerance of a prediction
        constexpr double ACCELERATION = 0.15;  // m/s^2, tolerance of a prediction
        constexpr double WRONG = 9.0;          // maximum squared error: lags are unknown at first
        constexpr double RIGHT = 1.0;          // maximum squared error of a delay that may replace another
        constexpr double BETTER = 0.25;        // share of the error of another delay

        double squared(double value)
        {
            return value * value;
        }
    }  // namespace

    CommandDelay::CommandDelay(double period, double steering, std::size_t periods, bool sure)
      : period_(period),
        periods_(std::min(periods, MAX_PERIODS)),
        sure_(sure ? ENOUGH : 0),
        given_(MAX_PERIODS + 3, Command{0.0, steering, true})
    {
    }

    void CommandDelay::give(const Command &command)
    {
        given_.pop_front();
        given_.push_back(command);
    }

    void CommandDelay::learn(const Measurement &before, const Measurement &after)
    {
        if (isSure())
            return;
        double least = -1.0, most = 0.0;
        std::size_t best = periods_;
        for (std::size_t i = 0; i < guesses_.size(); ++i)
        {
            Guess &guess = guesses_[i];
            const Command &now = given(i), &last = given(i + 1);
            // First predict, then learn.
            const double angle =
                LagStep(guess.wheels.lag(), period_).after(now.steering, last.steering, before.steering);
            double error = squared((after.steering - angle) / ANGLE);
            const double gained = (after.speed - before.speed) / period_;
            double asked = now.acceleration;
            if (now.hold && before.speed == 0.0)
                asked = 0.0;
            const double late = unfollowed(guess.drive.lag(), period_);
            if (!now.hold || before.speed == 0.0)
                error += squared((gained - asked - late * (guess.drive.acceleration() - asked)) / ACCELERATION);
            guess.wheels.learn(period_, now.steering - last.steering, last.steering - before.steering,
                               now.steering - after.steering, LagEstimator::MIN_ANGLE);
            if (now.hold)
                guess.drive.hold();
            else
                guess.drive.learn(period_, now.acceleration, before.speed, after.speed);
            guess.error = KEPT * guess.error + std::min(error, WRONG);
            most = std::max(most, guess.error);
            if (least < 0.0 || guess.error < least)
            {
                least = guess.error;
                best = i;
            }
        }
        // If all predictions are equal, as at standstill, nothing is learnt.
        if (most < 4.0 || least > BETTER * most)
            return;
        if (best != periods_ && least < RIGHT && least < BETTER * guesses_[periods_].error)
        {
            periods_ = best;
            sure_ = 0;
        }
        else if (best == periods_)
            ++sure_;
    }
}  // namespace parking
