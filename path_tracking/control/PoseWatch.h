#pragma once

namespace parking
{
    /** \brief Knows whether the car is still told where it is, and what to do about it when it is not.

        A few periods without a pose are bridged by dead reckoning. After more the car has to stop; standing it waits
        for the pose, with patience, until there have been as many good ones one after the other as may be missing. */
    class PoseWatch
    {
    public:
        /** \brief What a standing car may do. */
        enum class Verdict
        {
            Wait,   ///< stand and wait
            Back,   ///< the pose is back: it can be planned from where the car stands
            GiveUp  ///< the patience is at its end
        };

        /** \param bridged periods without a pose that are bridged \param patience seconds that a standing car waits
            \param period seconds of control */
        PoseWatch(int bridged, double patience, double period) : bridged_(bridged), patience_(patience), period_(period)
        {
        }

        /** \brief Takes over whether this period's measurement can be used. */
        void note(bool usable)
        {
            begun_ = begun_ || usable;
            missing_ = usable ? 0 : missing_ + 1;
            seen_ = usable ? seen_ + 1 : 0;
            lost_ = lost_ || isMissing();
        }

        /** \brief Has there been no pose for longer than is bridged, or never one? */
        bool isMissing() const
        {
            return !begun_ || missing_ > bridged_;
        }

        /** \brief Has that ever been so? */
        bool wasLost() const
        {
            return lost_;
        }

        /** \brief Asked once a period by a car that stands because the pose was lost. */
        Verdict stand()
        {
            if (seen_ > bridged_)
                return Verdict::Back;
            stood_ += period_;
            return stood_ > patience_ ? Verdict::GiveUp : Verdict::Wait;
        }

    private:
        int bridged_;
        double patience_, period_;
        bool begun_{false}, lost_{false};
        int missing_{0}, seen_{0};  // periods, one after the other
        double stood_{0.0};         // seconds
    };
}  // namespace parking
