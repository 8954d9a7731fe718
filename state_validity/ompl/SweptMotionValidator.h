#pragma once

#include "state_validity/FootprintChecker.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/TierCounters.h"
#include "state_validity/sweeps/ClearanceProof.h"

#include <memory>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>

namespace parking
{
    /** \anchor SweptMotionValidator
        \brief Proves motions free along their whole length, not at samples of it.

        For Reeds-Shepp and Dubins spaces the curve is computed once per motion; each of its arcs is swept exactly
        (FootprintChecker::freeLength). In a plain SE2 space, where position and yaw change linearly together, the
        motion is covered by parts that the clearance in their middle proves free: no point of the body moves
        farther than the clearance there (conservative advancement, B. Mirtich, "Impulse-based dynamic simulation of
        rigid body systems", 1996), halving what remains.

        What a sweep cannot prove, since the body passes an obstacle nearer than 1.5 times the tolerance, is swept from
        its end as well, and proven by clearances in the same way.

        Sound, not complete: a motion during which the body touches an obstacle is never accepted. A motion may be
        rejected although it is free when the body, somewhere on the way, is nearer to an obstacle than a tenth of the
        tolerance, or drives along one nearer than the tolerance for metres. Where an end of a motion is nearer than
        that a car can drive away from what it all but touches, and up to it.

        Motions must also stay within the bounds of the state space, and the end state must be valid by the space
        information's own state validity checker; the start is taken to be valid, as everywhere in OMPL. */
    class SweptMotionValidator : public ompl::base::MotionValidator
    {
    public:
        static constexpr double DEFAULT_TOLERANCE = 1e-3;  ///< metres

        /** \brief \param tolerance metres, positive; see above

            Throws ompl::Exception for an empty \e footprint, a space of another kind, and a tolerance that is not
            positive or not below 0.1 m. */
        SweptMotionValidator(const ompl::base::SpaceInformationPtr &si,
                             std::shared_ptr<const FootprintChecker> footprint, double tolerance = DEFAULT_TOLERANCE);

        /** \brief Takes the footprint from the space information's state validity checker, which must be an
            FclFootprintChecker (otherwise ompl::Exception). */
        explicit SweptMotionValidator(const ompl::base::SpaceInformationPtr &si, double tolerance = DEFAULT_TOLERANCE);

        /** \brief Is \e s2 valid and the whole motion to it proven free? \e s1 is taken to be valid. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2) const override;

        /** \brief The same. When the motion is not valid, \e lastValid becomes the fraction of the motion that is
            proven free (less the tolerance) and, unless null, the state there. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2,
                         std::pair<ompl::base::State *, double> &lastValid) const override;

        /** \brief Metres by which the body is enlarged on the way; see above. */
        double tolerance() const
        {
            return tolerance_;
        }

        /** \brief What motions are swept with. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief The curves of the space. */
        const CurveSpace &curveSpace() const
        {
            return space_;
        }

        /** \brief Which tier decided how many of the poses that motions were swept from. */
        CheckCounts counts() const
        {
            return counters_.sum();
        }

        /** \brief Starts counts() from zero. */
        void resetCounts()
        {
            counters_.reset();
        }

    private:
        /** \param exact whether the fraction is wanted when the motion is not free, and not only that it is not */
        MotionProof prove(const ompl::base::State *s1, const ompl::base::State *s2, bool exact) const;
        MotionProof proveCurve(const Pose &from, const ReedsSheppCurve &curve, CheckCounts &counts) const;
        /** Does the arc leave what the body all but touches, and is it free? */
        bool isLeaving(const Pose &from, const Arc &arc, CheckCounts &counts) const;
        /** Is the arc free by clearances, beyond those metres that are known to be? */
        bool isPassing(const Pose &from, const Arc &arc, double free, CheckCounts &counts) const;

        CurveSpace space_;
        std::shared_ptr<const FootprintChecker> footprint_;
        double tolerance_;
        mutable TierCounters counters_;
    };
}  // namespace parking
