#pragma once

#include "parking_geometry/Pose.h"
#include "state_validity/FootprintChecker.h"

#include <functional>

namespace parking
{
    /** \brief The part of a motion that is proven free. */
    struct MotionProof
    {
        bool whole{false};     ///< whether the whole motion is proven free
        double fraction{0.0};  ///< proven fraction of the motion, from its start
        Pose pose;             ///< pose at the end of the proven part
    };

    /** \brief Proves motions free of obstacles along their whole length by clearances.

        A part of the motion is free if no point of the body moves farther than the clearance in its middle; otherwise
        it is divided (conservative advancement, B. Mirtich, "Impulse-based dynamic simulation of rigid body systems",
        1996). The proof is sound but not complete: it fails for motions closer to an obstacle than a tenth of the
        tolerance. */
    class ClearanceProof
    {
    public:
        /** \brief Creates a proof. \param footprint must outlive this object
            \param tolerance metres, positive */
        ClearanceProof(const FootprintChecker &footprint, double tolerance)
          : footprint_(footprint),
            tolerance_(tolerance)
        {
        }

        /** \brief Proves an arbitrary motion.

            \param at returns the pose at a fraction of the motion
            \param moved upper limit of the metres that a point of the body moves
            \param exact whether the fraction is required for a motion that is not free */
        MotionProof prove(const std::function<Pose(double)> &at, double moved, bool exact, CheckCounts &counts) const;

        /** \brief Proves the motion with linear position and heading. */
        MotionProof proveLine(const Pose &from, const Pose &to, bool exact, CheckCounts &counts) const;

    private:
        double toleranceBetween(const Pose &from, const Pose &to, CheckCounts &counts) const;

        const FootprintChecker &footprint_;
        double tolerance_;
    };
}  // namespace parking
