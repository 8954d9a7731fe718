#pragma once

#include "parking_geometry/Pose.h"
#include "state_validity/FootprintChecker.h"

#include <functional>

namespace parking
{
    /** \brief How much of a motion is proven free. */
    struct MotionProof
    {
        bool whole{false};     ///< all of it is
        double fraction{0.0};  ///< of the motion, from its start
        Pose pose;             ///< at that fraction
    };

    /** \brief Proves motions free of obstacles along their whole length by clearances.

        No point of the body moves farther than the clearance in the middle of a part of the motion, or the part is
        halved (conservative advancement, B. Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996).
        Sound, not complete: nearer than a tenth of the tolerance nothing is proven on the way. */
    class ClearanceProof
    {
    public:
        /** \brief \param footprint must outlive this object
            \param tolerance metres, positive */
        ClearanceProof(const FootprintChecker &footprint, double tolerance)
          : footprint_(footprint),
            tolerance_(tolerance)
        {
        }

        /** \brief Any motion.

            \param at the pose at a fraction of the motion
            \param moved metres that no point of the body exceeds on it
            \param exact whether the fraction is wanted when the motion is not free, and not only that it is not */
        MotionProof prove(const std::function<Pose(double)> &at, double moved, bool exact, CheckCounts &counts) const;

        /** \brief The motion along which position and heading change evenly. */
        MotionProof proveLine(const Pose &from, const Pose &to, bool exact, CheckCounts &counts) const;

    private:
        double toleranceBetween(const Pose &from, const Pose &to, CheckCounts &counts) const;

        const FootprintChecker &footprint_;
        double tolerance_;
    };
}  // namespace parking
