#pragma once

namespace parking
{
    /** \brief What a first-order lag makes of a command that moves evenly over a step: the value after the step is
        ofCommand * (command after it) + ofBefore * (command before it) + ofValue * (value before it).

        Exact, from value' = (command - value) / lag. The wheels follow the steering command so; and the speed follows
        the commanded speed (the integral of the commanded acceleration) so when the drive's acceleration lags. */
    struct LagStep
    {
        double ofCommand{1.0};  ///< share of the command after the step
        double ofBefore{0.0};   ///< share of the command before it
        double ofValue{0.0};    ///< share of the value before it; the three add up to 1

        LagStep() = default;

        /** \param lag seconds, time constant; 0: the value is the command \param duration seconds, of the step */
        LagStep(double lag, double duration);

        /** \brief The value after the step. \param before value before it */
        double after(double command, double commandBefore, double before) const
        {
            return ofCommand * command + ofBefore * commandBefore + ofValue * before;
        }
    };

    /** \brief Share of a step of the command that the mean over \e duration seconds has not followed; 0 without a lag,
        and the larger the longer that is. */
    double unfollowed(double lag, double duration);

    /** \brief Learns the time constant of a first-order lag from how far a value trails its command.

        Over a period in which the command changes by c, a value that trailed by b before trails by c o + b q after,
        with q = exp(-h / T) and o = T / h (1 - q); the lag T that explains what is seen is found by bisection, and a
        share of the difference is believed. This holds for an angle behind an evenly moving command, and for the mean
        acceleration of a period behind a stepped one. Angles are taken as measured: an offset, which command and
        measurement share, does not matter. */
    class LagEstimator
    {
    public:
        static constexpr double LEAST_ANGLE = 0.005;  ///< radians of steering that say something, see learn()

        /** \param lag seconds, known beforehand */
        explicit LagEstimator(double lag = 0.0) : lag_(lag)
        {
        }

        /** \brief Seconds, never negative. */
        double lag() const
        {
            return lag_;
        }

        /** \brief Learns from one period; periods that say nothing are left out.

            \param duration seconds
            \param change of the command
            \param trailingBefore,trailing how far the value was behind the command before and after
            \param least change and trailing together below which the period says nothing */
        void learn(double duration, double change, double trailingBefore, double trailing, double least);

    private:
        double lag_;
        int seen_{0};
    };

    /** \brief Learns how far the drive lags behind its command, and with it the acceleration of the moment. */
    class DriveLagEstimator
    {
    public:
        /** \param lag seconds, known beforehand */
        explicit DriveLagEstimator(double lag = 0.0) : estimator_(lag)
        {
        }

        /** \brief Seconds that the drive lags behind, as far as is known. */
        double lag() const
        {
            return estimator_.lag();
        }

        /** \brief m/s^2, at the end of the last period. */
        double acceleration() const
        {
            return acceleration_;
        }

        /** \brief Learns from one period.

            \param duration seconds
            \param command m/s^2, held over the period
            \param speedBefore,speed m/s, as measured at the begin and the end of the period */
        void learn(double duration, double command, double speedBefore, double speed);

        /** \brief The car has been held by its brake: nothing is learnt, and it does not accelerate. */
        void hold();

    private:
        LagEstimator estimator_;
        double acceleration_{0.0};
        double commandBefore_{0.0};
        double trailingBefore_{0.0};
    };
}  // namespace parking
