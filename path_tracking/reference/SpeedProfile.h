#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/reference/ReferencePath.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace parking
{
    /** \brief What a timed path may ask of the car. All finite and at least 0.01. */
    struct SpeedLimits
    {
        double speed{2.5};                ///< m/s, either direction
        double acceleration{1.0};         ///< m/s^2 along the path, either sign
        double steeringRate{0.5};         ///< rad/s
        double lateralAcceleration{1.0};  ///< m/s^2, speed^2 * |curvature|

        /** \brief The limits of \e vehicle; its lateral acceleration is a matter of comfort and stays 1 m/s^2. */
        static SpeedLimits of(const Vehicle &vehicle);

        /** \brief Throws parking::Error naming the first field that is not finite or below 0.01. */
        void validate() const;
    };

    /** \brief What the profile asks for at a time of a leg. */
    struct ProfilePoint
    {
        double s{0.0};             ///< metres since the begin of the path
        double speed{0.0};         ///< m/s, never negative
        double acceleration{0.0};  ///< m/s^2, of \e speed
    };

    /** \brief A path in time: standstill to steer, drive a leg, standstill to steer, and so on.

        On every leg the speed is the highest that the limits allow. Between two knots of the steering angle the speed
        cap is constant: that of the steering rate, and that of the larger curvature at the knots, which are no farther
        apart than maxBlendLength where the angle changes. Under a bounded acceleration the pointwise greatest
        admissible speed is found by one pass forwards and one backwards over the squared speed, which is linear in the
        driven length; no drive within these caps is faster. Before each leg the car stands as long as the steering rate
        needs to turn the wheels to where the leg begins. */
    class SpeedProfile
    {
    public:
        /** \brief Times \e reference.

            \param initialSteering radians, of the wheels at the start
            \param finalSteering when given, the wheels are turned there at the end
            Throws parking::Error for limits that are no positive finite numbers or angles beyond the car's. */
        SpeedProfile(ReferencePath reference, const SpeedLimits &limits, double initialSteering = 0.0,
                     std::optional<double> finalSteering = std::nullopt);

        /** \brief Prepares \e path with default parameters and times it within the limits of \e vehicle. */
        SpeedProfile(const Path &path, const Vehicle &vehicle);

        /** \brief The path that is timed, with its steering angles. */
        const ReferencePath &reference() const
        {
            return reference_;
        }

        /** \brief What the profile keeps within. */
        const SpeedLimits &limits() const
        {
            return limits_;
        }

        /** \brief Seconds from the start to the last standstill, steering included. */
        double duration() const;

        /** \brief Seconds of standstill before leg \e leg. */
        double steeringTime(std::size_t leg) const
        {
            return timelines_[leg].steeringTime;
        }

        /** \brief Seconds of motion on leg \e leg. */
        double legDuration(std::size_t leg) const
        {
            return timelines_[leg].duration;
        }

        /** \brief Place and speed \e time seconds after the begin of the motion on leg \e leg (cut to its ends). */
        ProfilePoint at(std::size_t leg, double time) const;

        /** \brief Seconds after the begin of the motion on leg \e leg at which it passes \e s. */
        double timeAt(std::size_t leg, double s) const;

        /** \brief The whole profile, a point every \e step seconds and one at the end.

            Every number obeys the limits, and so do the differences between two points. */
        Trajectory sample(double step) const;

    private:
        /** Constant acceleration from a time on. */
        struct Phase
        {
            double time;
            double s;
            double speed;
            double acceleration;
        };

        struct Timeline
        {
            double steeringTime{0.0};
            double steeringFrom{0.0};
            double duration{0.0};
            std::vector<Phase> phases;
        };

        Timeline makeTimeline(std::size_t leg) const;

        ReferencePath reference_;
        SpeedLimits limits_;
        std::vector<Timeline> timelines_;
        double lastSteering_{0.0};
        double finalSteering_{0.0};
        double finalSteeringTime_{0.0};
    };
}  // namespace parking
