#pragma once

namespace parking
{
    /** \brief First-order lag over a step in which the command changes at a constant rate. The value after the step is
        ofCommand * (command after it) + ofBefore * (command before it) + ofValue * (value before it).

        It is exact for value' = (command - value) / lag. The wheels follow the steering command in this way. The speed
        follows the commanded speed, the integral of the commanded acceleration, when the acceleration lags. */
    struct LagStep
    {
        double ofCommand{1.0};  ///< share of the command after the step
        double ofBefore{0.0};   ///< share of the command before it
        double ofValue{0.0};    ///< share of the value before the step; the three shares sum to 1

        LagStep() = default;

        /** \param lag seconds, time constant; without a lag (0) the value equals the command \param duration seconds,
            of the step */
        LagStep(double lag, double duration);

        /** \brief The value after the step. \param before value before the step */
        double after(double command, double commandBefore, double before) const
        {
            return ofCommand * command + ofBefore * commandBefore + ofValue * before;
        }
    };

    /** \brief Share of a command step that the mean over \e duration seconds has not followed. It is 0 without a lag
        and increases with the lag. */
    double unfollowed(double lag, double duration);

    /** \brief Estimates the time constant of a first-order lag from how far a value trails its command.

        Suppose the command changes by c over a period of h seconds, and the value trailed by b before. Then it trails
        by the sum of c o and b q after it. Here q = exp(-h / T) and o = T / h (1 - q). Bisection finds the lag T that
        explains the measurement, and the estimate moves by a share of the difference.

        This holds for an angle behind a command of constant rate, and for the mean acceleration of a period behind a
        stepped command. Angles are used as measured: an offset common to command and measurement has no effect. */
    class LagEstimator
    {
    public:
        static constexpr double MIN_ANGLE = 0.005;  ///< radians, minimum change of steering for learning, see learn()

        /** \param lag seconds, initial estimate */
        explicit LagEstimator(double lag = 0.0) : lag_(lag)
        {
        }

        /** \brief Estimated lag in seconds, never negative. */
        double lag() const
        {
            return lag_;
        }

        /** \brief Updates the estimate from one period. Periods without information are skipped.

            \param duration seconds
            \param change of the command
            \param trailingBefore,trailing difference between command and value before and after the period
            \param least minimum sum of change and trailing for an update */
        void learn(double duration, double change, double trailingBefore, double trailing, double least);

    private:
        double lag_;
        int seen_{0};
    };

    /** \brief Estimates the lag of the drive behind its command, and the current acceleration. */
    class DriveLagEstimator
    {
    public:
        /** \param lag seconds, initial estimate */
        explicit DriveLagEstimator(double lag = 0.0) : estimator_(lag)
        {
        }

        /** \brief Estimated lag of the drive, in seconds. */
        double lag() const
        {
            return estimator_.lag();
        }

        /** \brief m/s^2, at the end of the last period. */
        double acceleration() const
        {
            return acceleration_;
        }

        /** \brief Updates the estimates from one period.

            \param duration seconds
            \param command m/s^2, held over the period
            \param speedBefore,speed m/s, measured at the start and the end of the period */
        void learn(double duration, double command, double speedBefore, double speed);

        /** \brief Handles a period in which the brake held the car: the lag is unchanged and the acceleration is 0. */
        void hold();

    private:
        LagEstimator estimator_;
        double acceleration_{0.0};
        double commandBefore_{0.0};
        double trailingBefore_{0.0};
    };
}  // namespace parking
