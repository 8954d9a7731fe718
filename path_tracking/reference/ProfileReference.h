#pragma once

#include "path_tracking/reference/SpeedProfile.h"
#include "path_tracking/reference/TimedReference.h"

namespace parking
{
    /** \brief A path with its speed profile, as what a controller follows: the car stands wherever its wheels have to
        turn by more than they can in motion. */
    class ProfileReference final : public TimedReference
    {
    public:
        /** \brief Takes over a path that is timed already. */
        explicit ProfileReference(SpeedProfile profile);

        /** \brief The path with its speeds. */
        const SpeedProfile &profile() const
        {
            return profile_;
        }

        TimedState at(std::size_t leg, double time) const override;
        double steering(std::size_t leg, double s) const override;
        PathProjection project(std::size_t leg, const Pose &pose, double from, double to) const override;
        Pose end() const override;
        double steeringRate() const override;
        double cornerDeviation() const override;

    private:
        SpeedProfile profile_;
    };
}  // namespace parking
