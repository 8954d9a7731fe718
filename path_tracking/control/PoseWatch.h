#pragma once

namespace parking
{
    /** \brief Monitors whether pose measurements arrive, and decides how a car without them proceeds.

        Dead reckoning bridges a few periods without a pose. After more, the car must stop and wait up to a time limit.
        It continues after as many consecutive poses as may be missing. */
    class PoseWatch
    {
    public:
        /** \brief Action of a standing car. */
        enum class Verdict
        {
            Wait,   ///< stand and wait
            Back,   ///< the pose is available again; planning may start from here
            GiveUp  ///< the time limit has passed
        };

        /** \param bridged number of consecutive periods without a pose that are bridged \param waitLimit seconds that a
            standing car waits \param period seconds of control */
        PoseWatch(int bridged, double waitLimit, double period)
          : bridged_(bridged),
            waitLimit_(waitLimit),
            period_(period)
        {
        }

        /** \brief Records whether the measurement of this period is usable. */
        void note(bool usable)
        {
            begun_ = begun_ || usable;
            missing_ = usable ? 0 : missing_ + 1;
            seen_ = usable ? seen_ + 1 : 0;
            lost_ = lost_ || isMissing();
        }

        /** \brief Whether the pose has been missing for longer than is bridged, or was never available. */
        bool isMissing() const
        {
            return !begun_ || missing_ > bridged_;
        }

        /** \brief Whether the pose has ever been missing for longer than is bridged. */
        bool wasLost() const
        {
            return lost_;
        }

        /** \brief Decides for a car that stands because its pose was lost. Call it once per period. */
        Verdict stand()
        {
            if (seen_ > bridged_)
                return Verdict::Back;
            stood_ += period_;
            return stood_ > waitLimit_ ? Verdict::GiveUp : Verdict::Wait;
        }

    private:
        int bridged_;
        double waitLimit_, period_;
        bool begun_{false}, lost_{false};
        int missing_{0}, seen_{0};  // consecutive periods
        double stood_{0.0};         // seconds
    };
}  // namespace parking
