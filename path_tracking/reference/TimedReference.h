#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/reference/ReferencePath.h"

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
        double s{0.0};         ///< metres driven since the start
        double speed{0.0};     ///< m/s along the leg, not negative
        double steering{0.0};  ///< radians
        Pose pose;             ///< yaw wrapped
    };

    /** \brief What a TrackingController follows: legs between standstills, in time. */
    class TimedReference
    {
    public:
        virtual ~TimedReference() = default;

        /** \brief In the order of driving, at least one. */
        const std::vector<TimedLeg> &legs() const
        {
            return legs_;
        }

        /** \brief The state \e time seconds after the begin of the motion on leg \e leg, cut to the leg. */
        virtual TimedState at(std::size_t leg, double time) const = 0;

        /** \brief The steering angle at \e s metres on leg \e leg. */
        virtual double steering(std::size_t leg, double s) const = 0;

        /** \brief The place of leg \e leg nearest to \e pose.

            \param from,to metres driven since the start: only places between are looked at */
        virtual PathProjection project(std::size_t leg, const Pose &pose, double from, double to) const = 0;

        /** \brief Where it ends, yaw wrapped. */
        virtual Pose end() const = 0;

        /** \brief rad/s with which the wheels turn at standstill. */
        virtual double steeringRate() const = 0;

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
        virtual double cornerDeviation() const
        {
            return 0.0;
        }

        /** \brief Metres driven. */
        double length() const
        {
            return legs_.back().endLength;
        }

        /** \brief Seconds from the start to the end, standstills included. */
        double duration() const
        {
            double sum = finalStandstill_;
            for (const TimedLeg &leg : legs_)
                sum += leg.standstill + leg.duration;
            return sum;
        }

    protected:
        std::vector<TimedLeg> legs_;   ///< see legs(); to be filled by the constructor of a derived class
        double finalStandstill_{0.0};  ///< seconds, see finalStandstill()
        double finalSteering_{0.0};    ///< radians, see finalSteering()
    };
}  // namespace parking
