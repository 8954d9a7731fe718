#pragma once

#include "state_validity/CircleChecker.h"
#include "state_validity/ObstacleSet.h"

#include <memory>
#include <utility>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

namespace parking
{
    /** \anchor CircleValidityChecker
        \brief State validity checker for a circle, the paper's model of the car (section "Introducing Vehicle Volume").

        A state is valid if it lies within the bounds of the space and every obstacle is farther from its position than
        the radius. The position is the centre of the body, not its rear axle, because the circumscribed circle about
        the centre is the smallest. Paths found with this checker are therefore paths of the body's centre.

        A CircleChecker computes the results. Const calls from several threads are safe. */
    class CircleValidityChecker : public ompl::base::StateValidityChecker
    {
    public:
        /** \brief A checker for a circle of this radius among obstacles.

            \param radius metres, positive
            Throws ompl::Exception naming the invalid value, and for spaces other than SE2 spaces and those derived from
            them. */
        CircleValidityChecker(const ompl::base::SpaceInformationPtr &si, ObstacleSet obstacles, double radius);

        using ompl::base::StateValidityChecker::clearance;
        using ompl::base::StateValidityChecker::isValid;

        /** \brief Whether the position lies within the bounds of the space and the circle about it touches no
            obstacle. */
        bool isValid(const ompl::base::State *state) const override;

        /** \brief Distance in metres between the circle and the nearest obstacle; 0 if they touch. The result is exact
            up to a metre and a lower bound beyond. */
        double clearance(const ompl::base::State *state) const override;

        /** \brief The checker that computes the results. */
        const CircleChecker &circle() const
        {
            return circle_;
        }

    private:
        CircleChecker circle_;
    };

    /** \brief Proves straight motions of a circle in a plain SE2 space free along their whole length.

        It uses CircleChecker::freeShare() and never accepts a motion that touches an obstacle. */
    class CircleMotionValidator : public ompl::base::MotionValidator
    {
    public:
        /** \brief A motion validator for the circle of \e checker, which must belong to the same space. */
        CircleMotionValidator(const ompl::base::SpaceInformationPtr &si,
                              std::shared_ptr<const CircleValidityChecker> checker);

        /** \brief Whether \e s2 is valid and the circle is free along the whole line from \e s1, which must be
            valid. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2) const override;

        /** \brief Whether \e s2 is valid and the circle is free along the whole line from \e s1. If not, sets \e
            lastValid to the fraction that is proven free and, unless null, the state there. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2,
                         std::pair<ompl::base::State *, double> &lastValid) const override;

    private:
        std::shared_ptr<const CircleValidityChecker> checker_;
    };
}  // namespace parking
