#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "path_tracking/reference/ReferencePath.h"
#include "path_tracking/trajectory/SpeedProfile.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A drive from one standstill to the next, in time. */
    struct TimedLeg
    {
        int direction{1};         ///< 1 forwards, -1 in reverse
        double beginLength{0.0};  ///< metres driven before it
        double endLength{0.0};    ///< metres driven at its end
        double standstill{0.0};   ///< seconds before it, during which the wheels turn
        double duration{0.0};     ///< seconds of motion
        double steering{0.0};     ///< radians, of the wheels where it begins
    };

    /** \brief Where the car should be at a moment. */
    struct TimedState
    {
        double t{0.0};         ///< seconds since the motion on the leg began
        double s{0.0};         ///< metres driven since the start
        double speed{0.0};     ///< m/s along the leg, not negative
        double steering{0.0};  ///< radians
        Pose pose;             ///< yaw wrapped
    };

    /** \brief Where a pose is beside a leg. */
    struct PathProjection
    {
        double s{0.0};         ///< metres since the begin of the path, of the nearest place
        double lateral{0.0};   ///< metres that the pose is to the left of that place, seen along the car
        double yaw{0.0};       ///< heading there minus the path's, radians
        double beyond{0.0};    ///< metres that the pose is past that place along the leg; not 0 only at its ends
        double distance{0.0};  ///< metres between pose and place; more than |lateral| beyond an end of the leg
    };

    /** \brief What a TrackingController follows: legs between standstills, in time.

        Made from a path, which is then driven as fast as limits allow, or from a motion, which is in time already. Held
       as moments no more than 5 cm apart, between which the car drives an arc. */
    class TimedReference
    {
    public:
        /** \brief Drives \e path: each leg with fastestDrive(), and before it the car stands as long as the steering
           rate needs to turn the wheels to where the leg begins.

            \param initialSteering radians, of the wheels at the start
            Throws parking::Error for limits that are no positive finite numbers or an angle beyond the car's. */
        TimedReference(const ReferencePath &path, const SpeedLimits &limits, double initialSteering = 0.0);

        /** \brief Drives \e motion, whose legs lie between its instants at rest.

            Throws parking::Error for a motion that is not finite, never drives, does not begin or end at rest,
            changes its direction without coming to rest, runs backwards in time, takes more than LONGEST_MOTION,
            or is more than the car can do. */
        TimedReference(const TimedMotion &motion, const Vehicle &vehicle);

        /** \brief In the order of driving, at least one. */
        const std::vector<TimedLeg> &legs() const
        {
            return legs_;
        }

        /** \brief The state \e time seconds after the begin of the motion on leg \e leg, cut to the leg. */
        TimedState at(std::size_t leg, double time) const;

        /** \brief The steering angle at \e s metres on leg \e leg. */
        double steering(std::size_t leg, double s) const;

        /** \brief The place of leg \e leg nearest to \e pose.

            \param from,to metres driven since the start: only places between are looked at */
        PathProjection project(std::size_t leg, const Pose &pose, double from, double to) const;

        /** \brief Where it ends, yaw wrapped. */
        Pose end() const;

        /** \brief rad/s with which the wheels turn at standstill. */
        double steeringRate() const
        {
            return steeringRate_;
        }

        /** \brief Seconds of standstill at the end, during which the wheels turn to finalSteering(). */
        double finalStandstill() const
        {
            return finalStandstill_;
        }

        /** \brief Radians, of the wheels at the very end. */
        double finalSteering() const
        {
            return finalSteering_;
        }

        /** \brief Metres between what was asked for and what is driven, where the path had sharp corners. */
        double cornerDeviation() const
        {
            return cornerDeviation_;
        }

        /** \brief Metres driven. */
        double length() const
        {
            return legs_.back().endLength;
        }

        /** \brief Seconds from the start to the end, standstills included. */
        double duration() const;

    private:
        Pose poseBetween(const TimedState &a, const TimedState &b, double s) const;
        const TimedState &behind(std::size_t leg, double s) const;

        std::vector<TimedLeg> legs_;
        std::vector<std::vector<TimedState>> moments_;  // per leg, two at least; the speed is linear in between
        double steeringRate_;
        double finalStandstill_{0.0}, finalSteering_{0.0};
        double cornerDeviation_{0.0};
    };
}  // namespace parking
