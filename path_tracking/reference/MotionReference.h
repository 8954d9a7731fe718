#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/reference/TimedReference.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <vector>

namespace parking
{
    /** \brief A motion in time, as what a controller follows: the wheels turn while the car rolls.

        A leg is what lies between two instants at rest. The motion is integrated once, in parts of at most 20 ms. */
    class MotionReference final : public TimedReference
    {
    public:
        /** \brief Throws parking::Error for a motion that is not finite, never drives, does not begin or end at rest,
            changes its direction without coming to rest, runs backwards in time, takes more than LONGEST_MOTION,
            or is more than the car can do. */
        MotionReference(const TimedMotion &motion, const Vehicle &vehicle);

        TimedState at(std::size_t leg, double time) const override;
        double steering(std::size_t leg, double s) const override;
        PathProjection project(std::size_t leg, const Pose &pose, double from, double to) const override;
        Pose end() const override;
        double steeringRate() const override;

    private:
        /** A moment of a leg. */
        struct Moment
        {
            double t;  // seconds since the leg's begin
            double s;  // metres driven since the start
            double speed, steering;
            Pose pose;  // yaw not wrapped
        };

        TimedState between(const Moment &a, const Moment &b, double time) const;
        const Moment &behind(std::size_t leg, double s) const;

        double steeringRate_;
        std::vector<std::vector<Moment>> moments_;  // per leg, two at least
    };
}  // namespace parking
