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
    /** \brief Quick lower bound of the length of any curve between two poses in metres, from the distance and from the
        turn at full lock. */
    inline double minCurveLength(const Pose &from, const Pose &to, double turningRadius)
    {
        return std::max(positionDistance(from, to), std::abs(wrapAngle(from.yaw - to.yaw)) * turningRadius);
    }

    /** \brief Receives a free curve and its cost, including proximity and joins. Returns whether it is accepted. */
    using CurveOffer = std::function<bool(const ReedsSheppCurve &curve, double cost)>;

    /** \brief Finds the cheapest free curves of bounded curvature between two poses.

        Most curves collide, usually where a piece ends, above all at cusps. The footprint is therefore checked there
        and in the middle of long pieces before any sweep. */
    class FreeCurves
    {
    public:
        /** \brief End of a gap near which a collision is more likely; pieces are swept from there. */
        enum class SweepEnd
        {
            Start,  ///< the pose at which the curve begins
            Goal    ///< the pose at which the curve ends
        };

        static constexpr std::size_t MAX_CURVES = 64;  ///< exceeds the number of curves between two poses

        /** \brief Two free poses to be connected by a curve. */
        struct Gap
        {
            Pose from;                          ///< where the curve begins
            Pose to;                            ///< where it ends
            const PathPiece *before;            ///< piece before it, or nullptr
            const PathPiece *after;             ///< piece after it, or nullptr
            double maxCost;                     ///< upper limit of the cost of the curve with its joins
            SweepEnd end{SweepEnd::Start};      ///< end from which pieces are swept
            std::size_t maxCurves{MAX_CURVES};  ///< number of cheapest curves tried
        };

        /** \brief Creates the object. \e environment and \e curves must outlive it. */
        FreeCurves(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost)
          : environment_(environment),
            curves_(curves),
            cost_(cost)
        {
        }

        /** \brief Offers free curves across a gap, the cheapest first, until one is accepted. \return whether one was
accepted */
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
