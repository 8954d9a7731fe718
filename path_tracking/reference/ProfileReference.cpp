#include "path_tracking/reference/ProfileReference.h"

#include <utility>

namespace parking
{
    ProfileReference::ProfileReference(SpeedProfile profile) : profile_(std::move(profile))
    {
        const std::vector<ReferenceLeg> &legs = profile_.reference().legs();
        for (std::size_t i = 0; i < legs.size(); ++i)
            legs_.push_back({legs[i].direction, legs[i].beginLength, legs[i].endLength, profile_.steeringTime(i),
                             profile_.legDuration(i), legs[i].steering.front().angle});
        finalSteering_ = legs.back().steering.back().angle;
    }

    TimedState ProfileReference::at(std::size_t leg, double time) const
    {
        const ProfilePoint point = profile_.at(leg, time);
        return {point.s, point.speed, profile_.reference().steering(leg, point.s),
                profile_.reference().pose(leg, point.s)};
    }

    double ProfileReference::steering(std::size_t leg, double s) const
    {
        return profile_.reference().steering(leg, s);
    }

    PathProjection ProfileReference::project(std::size_t leg, const Pose &pose, double from, double to) const
    {
        return profile_.reference().project(leg, pose, from, to);
    }

    Pose ProfileReference::end() const
    {
        return profile_.reference().end();
    }

    double ProfileReference::steeringRate() const
    {
        return profile_.limits().steeringRate;
    }

    double ProfileReference::cornerDeviation() const
    {
        return profile_.reference().corners().deviation;
    }
}  // namespace parking
