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
        \brief Proves motions free along their whole length instead of at samples.

        In Reeds-Shepp and Dubins spaces the validator computes the curve once per motion and sweeps each arc exactly
        (FootprintChecker::freeLength()). In a plain SE2 space position and yaw change linearly. There the validator
        halves the motion until no point of the body moves farther on a part than the clearance in its middle
        (conservative advancement, B. Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996).

        A sweep may fail if the body passes an obstacle nearer than 1.5 times the tolerance. The validator then sweeps
        the arc from its end too and attempts a proof by clearances.

        The validator is sound, not complete. It never accepts a motion during which the body touches an obstacle. It
        may reject a free motion with a clearance below a tenth of the tolerance, or below the tolerance for metres. The
        ends of a motion may be nearer: a car can drive up to an obstacle and away from it.

        Motions must also stay within the bounds of the state space. The end state must be valid by the state validity
        checker of the space information. The start must be valid, as in all of OMPL. */
    class SweptMotionValidator : public ompl::base::MotionValidator
    {
    public:
        static constexpr double DEFAULT_TOLERANCE = 1e-3;  ///< default tolerance in metres

        /** \brief A validator that sweeps \e footprint.

            \param tolerance metres by which sweeps enlarge the body, above 0 and below 0.1
            Throws ompl::Exception for an empty \e footprint, an unsupported space and an invalid tolerance. */
        SweptMotionValidator(const ompl::base::SpaceInformationPtr &si,
                             std::shared_ptr<const FootprintChecker> footprint, double tolerance = DEFAULT_TOLERANCE);

        /** \brief A validator that sweeps the footprint of the space information's state validity checker.

            \param tolerance metres by which sweeps enlarge the body, above 0 and below 0.1
            Throws ompl::Exception for an invalid tolerance and unless the checker is an FclFootprintChecker. */
        explicit SweptMotionValidator(const ompl::base::SpaceInformationPtr &si, double tolerance = DEFAULT_TOLERANCE);

        /** \brief Whether \e s2 is valid and the whole motion from \e s1, which must be valid, is proven free. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2) const override;

        /** \brief Whether \e s2 is valid and the whole motion from \e s1 is proven free. If not, sets \e lastValid to
            the fraction that is proven free (less the tolerance) and, unless null, the state there. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2,
                         std::pair<ompl::base::State *, double> &lastValid) const override;

        /** \brief Metres by which sweeps enlarge the body. */
        double tolerance() const
        {
            return tolerance_;
        }

        /** \brief The footprint that the validator sweeps. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief The motions of the space. */
        const CurveSpace &curveSpace() const
        {
            return space_;
        }

        /** \brief Number of start poses of sweeps that each tier has decided since construction or resetCounts(). */
        CheckCounts counts() const
        {
            return counters_.sum();
        }

        /** \brief Resets counts() to zero. */
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
        /** Whether clearances prove the arc free beyond the first \e free metres, which are known to be free. */
        bool isPassing(const Pose &from, const Arc &arc, double free, CheckCounts &counts) const;

        CurveSpace space_;
        std::shared_ptr<const FootprintChecker> footprint_;
        double tolerance_;
        mutable TierCounters counters_;
    };
}  // namespace parking
