#pragma once

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
       exact() is. */
    class CurveHeuristic
    {
    public:
        explicit CurveHeuristic(const ReedsShepp &curves);

        /** \brief Forgets the targets; also to be called when the curves have changed.
            \param backwards false: curves from the asked pose to a target; true: from a target to the asked pose */
        void reset(bool backwards);

        void addTarget(const Pose &target);

        /** \brief Length in metres, up to the rounding of the pose. */
        double approximate(const Pose &pose) const;

        /** \brief Length in metres, exactly: never more than the length of any drivable path. */
        double exact(const Pose &pose) const;

        const std::vector<Pose> &targets() const
        {
            return targets_;
        }

    private:
        struct Frame
        {
            double cosine, sine;
        };

        double tabulated(const Pose &relative) const;

        const ReedsShepp &curves_;
        bool backwards_{false};
        std::vector<Pose> targets_;
        std::vector<Frame> frames_;  // of the targets
    };
}  // namespace parking::search
