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
    /** \brief A timed drive from one standstill to the next. */
    struct TimedLeg
    {
        int direction{1};         ///< 1 forwards, -1 in reverse
        double beginLength{0.0};  ///< metres driven before the leg
        double endLength{0.0};    ///< metres driven at the end of the leg
        double standstill{0.0};   ///< seconds before the leg, in which the car steers
        double duration{0.0};     ///< seconds of motion
        double steering{0.0};     ///< radians, of the wheels at the start of the leg
    };

    /** \brief Reference state of the car at an instant. */
    struct TimedState
    {
        double t{0.0};         ///< seconds since the motion on the leg began
        double s{0.0};         ///< metres driven since the start
        double speed{0.0};     ///< m/s along the leg, not negative
        double steering{0.0};  ///< radians
        Pose pose;             ///< yaw wrapped
    };

    /** \brief Projection of a pose onto a leg. */
    struct PathProjection
    {
        double s{0.0};         ///< metres since the start of the path, of the nearest place
        double lateral{0.0};   ///< metres of the pose to the left of that place, across the car
        double yaw{0.0};       ///< radians, heading of the pose minus that of the path
        double beyond{0.0};    ///< metres of the pose past that place along the leg; nonzero only at its ends
        double distance{0.0};  ///< metres between pose and place; exceeds |lateral| beyond an end of the leg
    };

    /** \brief Reference of a TrackingController: legs between standstills, in time.

        It is created from a path, driven as fast as the limits allow, or from a motion with its own timing. It consists
        of states at most 5 cm apart, joined by arcs. */
    class TimedReference
    {
    public:
        /** \brief Drives each leg of \e path with fastestDrive(). Before each leg the car stands while it steers to the
            start of the leg.

            \param initialSteering radians, of the wheels at the start
            Throws parking::Error for limits that are not positive finite numbers, or an angle beyond the car's. */
        TimedReference(const ReferencePath &path, const SpeedLimits &limits, double initialSteering = 0.0);

        /** \brief Drives \e motion; its legs lie between its instants at rest.

            Throws parking::Error for a motion that is not finite, never drives, does not begin or end at rest, or takes
            more than LONGEST_MOTION. Throws also if its times decrease, its direction changes without rest, or it
            exceeds the car's limits. */
        TimedReference(const TimedMotion &motion, const Vehicle &vehicle);

        /** \brief The legs in driving order, at least one. */
        const std::vector<TimedLeg> &legs() const
        {
            return legs_;
        }

        /** \brief The state \e time seconds after the motion on leg \e leg started, clamped to the leg. */
        TimedState at(std::size_t leg, double time) const;

        /** \brief The steering angle in radians at \e s metres on leg \e leg. */
        double steering(std::size_t leg, double s) const;

        /** \brief Projects \e pose onto the nearest place of leg \e leg.

            \param from,to metres driven since the start, bounds of the search */
        PathProjection project(std::size_t leg, const Pose &pose, double from, double to) const;

        /** \brief The last pose; yaw wrapped. */
        Pose end() const;

        /** \brief Steering rate at standstill in rad/s. */
        double steeringRate() const
        {
            return steeringRate_;
        }

        /** \brief Seconds of standstill at the end, in which the car steers to finalSteering(). */
        double finalStandstill() const
        {
            return finalStandstill_;
        }

        /** \brief Final steering angle in radians. */
        double finalSteering() const
        {
            return finalSteering_;
        }

        /** \brief Maximum distance in metres between the given and the driven path at sharp corners. */
        double cornerDeviation() const
        {
            return cornerDeviation_;
        }

        /** \brief Metres driven in total. */
        double length() const
        {
            return legs_.back().endLength;
        }

        /** \brief Seconds from the start of the reference to the start of the motion on leg \e leg. */
        double beginOf(std::size_t leg) const;

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
