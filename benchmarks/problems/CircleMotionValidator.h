#pragma once

#include "state_validity/ompl/CircleValidityChecker.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>

#include <memory>

namespace parking
{
    /** \brief Proves straight motions of a disc free along their whole length, in a plain SE2 space.

        From a point with clearance c the disc may move by c (conservative advancement). Where the clearance falls below
        the tolerance before the motion's end the proof gives up: such motions are rejected, but one that touches an
        obstacle is never accepted. The heading does not matter. */
    class CircleMotionValidator : public ompl::base::MotionValidator
    {
    public:
        static constexpr double TOLERANCE = 1e-3;  ///< metres of clearance below which the proof gives up

        /** \brief \param checker of the disc, for the same space */
        CircleMotionValidator(const ompl::base::SpaceInformationPtr &si,
                              std::shared_ptr<const CircleValidityChecker> checker);

        /** \brief Is the disc free all along the line from \e s1, which is taken to be free, to \e s2? */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2) const override;

        /** \brief The same; when it is not, \e lastValid gets the last state proved free and its share of the way. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2,
                         std::pair<ompl::base::State *, double> &lastValid) const override;

    private:
        double freeShare(const ompl::base::State *s1, const ompl::base::State *s2) const;

        std::shared_ptr<const CircleValidityChecker> checker_;
    };
}  // namespace parking
