#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/SearchTuning.h"
#include "ompl_improved_astar/search/planning/CloseParts.h"
#include "ompl_improved_astar/search/planning/GapBridge.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief Leads a drivable path past obstacles that it comes nearer to than preferred.

        Shortening replaces parts of a path by curves between poses of the path, so that it never gets farther from an
        obstacle than these. Here the pose that is nearest to an obstacle, of each part that is too near, is put aside
        and turned until it keeps the preferred clearance, or put back where the car turns round there, and the path is
        led through it by two curves of bounded curvature where that is cheaper. The path stays free and drivable, keeps
        its ends, and gets one more cusp at most. Parts at these stay as they are: a car that stands too near to
        something cannot be led past it. Deterministic. */
    class PathWidener
    {
    public:
        /** \brief What is referred to must outlive it.

            \param cost by which paths become cheaper; it prefers a clearance */
        PathWidener(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost,
                    const SearchTuning &tuning)
          : environment_(environment),
            curves_(curves),
            cost_(cost),
            strict_(withRoomToSpare(cost, tuning)),
            tuning_(tuning),
            bridge_(environment, curves, strict_)
        {
        }

        /** \brief By what paths become cheaper: the cost with a little more room than preferred, since what keeps that
           at the samples keeps what is preferred between them. */
        const CostModel &strictCost() const
        {
            return strict_;
        }

        /** \brief One pass along the path.

            \return whether any part of it was replaced, each by what costs less by strictCost() */
        bool pass(Path &path, const StopFunction &stop);

        /** \brief What the last pass has made of the path, if it replaced a part, and what that costs by strictCost().
         */
        const PricedPath &priced() const
        {
            return priced_;
        }

        /** \brief Did the last pass leave a part that is nearer to an obstacle than preferred, by more than a fiftieth?
         */
        bool isTooNear() const
        {
            return isTooNear_;
        }

        /** \brief Pairs of poses between which curves were tried in all passes so far. */
        std::uint64_t connections() const
        {
            return bridge_.connections();
        }

    private:
        static CostModel withRoomToSpare(CostModel cost, const SearchTuning &tuning)
        {
            cost.preferredClearance *= tuning.roomToSpare;
            return cost;
        }

        std::vector<ClosePart> close(const Path &path, double from, const StopFunction &stop)
        {
            return closeParts(environment_, path, from, cost_.preferredClearance, curves_.turningRadius(), stop);
        }

        /** Poses with the preferred clearance near the one at which the path is nearest to an obstacle: short of it
            where the car turns round there, then beside it. None if it is time to stop. */
        std::vector<Pose> posesNear(const ClosePart &part, const StopFunction &stop);
        bool leadAside(const ClosePart &part, std::size_t mostCusps, double &reach, const StopFunction &stop);

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        CostModel strict_;
        SearchTuning tuning_;
        GapBridge bridge_;
        PricedPath priced_;
        bool isTooNear_{false};
    };
}  // namespace parking::search
