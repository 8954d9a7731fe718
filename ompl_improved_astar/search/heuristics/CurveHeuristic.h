#pragma once

#include "ompl_improved_astar/search/Heuristic.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <vector>

namespace parking::search
{
    /** \brief Length of the shortest curve of bounded curvature between a pose and the nearest of some targets, without
        regard to obstacles.

        Poses are rounded to cells in the frame of the target, finer near it, and the length of each cell is computed
        once, when first asked for: what a table made in advance for the vehicle would hold, without its seconds of
        preparation. In units of the turning radius the table is the same for all vehicles: there is one for all objects
        in all threads, which takes no locks. The values are those of the cells' centres and therefore not a bound;
        lowerBound() is. */
    class CurveHeuristic final : public Heuristic
    {
    public:
        void begin(const HeuristicQuery &query) override;

        /** \brief Length in metres, up to the rounding of the pose. */
        double estimate(const Pose &pose) override;

        /** \brief Length in metres, exactly: never more than the length of any drivable path. */
        double lowerBound(const Pose &pose) override;

    private:
        struct Frame
        {
            double cosine, sine;
        };

        double tabulated(const Pose &relative) const;

        ReedsShepp curves_{1.0};
        bool backwards_{false};  // curves from a target to the asked pose, not the other way
        std::vector<Pose> targets_;
        std::vector<Frame> frames_;  // of the targets
    };
}  // namespace parking::search
