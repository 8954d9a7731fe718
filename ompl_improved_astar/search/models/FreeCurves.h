#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace parking::search
{
    /** \brief A lower bound of the length of any curve between two poses, in metres, that costs no time: the car drives
        that far, and turns that much at full lock. */
    inline double minCurveLength(const Pose &from, const Pose &to, double turningRadius)
    {
        return std::max(positionDistance(from, to), std::abs(wrapAngle(from.yaw - to.yaw)) * turningRadius);
    }

    /** \brief Receives a free curve and what it costs, proximity and joins included. Returns whether it is taken. */
    using CurveOffer = std::function<bool(const ReedsSheppCurve &curve, double cost)>;

    /** \brief Finds the cheapest free curves of bounded curvature between two poses.

        Most curves that are tried collide, and most of these where a piece ends, above all at their cusps: the car is
        put there, and in the middle of long pieces, before anything is swept. */
    class FreeCurves
    {
    public:
        /** \brief Which end of a gap is the one near which a collision is more likely: pieces are swept from there. */
        enum class SweepEnd
        {
            Start,  ///< the pose at which the curve begins
            Goal    ///< the pose at which the curve ends
        };

        static constexpr std::size_t MAX_CURVES = 64;  ///< more than there are between two poses

        /** \brief Two poses, both free, between which a curve is wanted. */
        struct Gap
        {
            Pose from;                          ///< where the curve begins
            Pose to;                            ///< where it ends
            const PathPiece *before;            ///< what is driven before it, null for nothing
            const PathPiece *after;             ///< what is driven after it, null for nothing
            double maxCost;                     ///< of the curve with its joins: what costs as much is not wanted
            SweepEnd end{SweepEnd::Start};      ///< from which pieces are swept
            std::size_t maxCurves{MAX_CURVES};  ///< that are tried, the cheapest ones
        };

        /** \brief \e environment and \e curves must outlive it. */
        FreeCurves(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost)
          : environment_(environment),
            curves_(curves),
            cost_(cost)
        {
        }

        /** \brief Offers the free curves that fill a gap, the cheapest first, until one is taken.

            \return whether one was taken */
        bool connect(const Gap &gap, const CurveOffer &offer);

    private:
        struct Candidate
        {
            double cost;
            const ReedsSheppCurve *curve;

            bool operator<(const Candidate &other) const
            {
                return cost < other.cost;
            }
        };

        double proximityOfFree(const Gap &gap, const ReedsSheppCurve &curve, double max);

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        std::vector<ReedsSheppCurve> words_;
        std::vector<Candidate> candidates_, free_;
    };
}  // namespace parking::search
