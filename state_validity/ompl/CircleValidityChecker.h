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
        \brief The paper's model of the car (section "Introducing Vehicle Volume"): a circle round it, whatever its
        heading.

        A state is valid when it lies within the bounds of the space and every obstacle is farther from its position
        than the radius. The position stands for the middle of the body here, not for its rear axle: a circle has no
        heading that could tell the one from the other, and round the middle it is smallest. So paths found with this
        checker are paths of the car's middle.

        A CircleChecker's answers. Const members may be called from several threads at once. */
    class CircleValidityChecker : public ompl::base::StateValidityChecker
    {
    public:
        /** \brief \param radius metres, positive

            Throws ompl::Exception naming the value that is wrong, and for spaces that hold no positions in the plane
            with a heading. */
        CircleValidityChecker(const ompl::base::SpaceInformationPtr &si, ObstacleSet obstacles, double radius);

        using ompl::base::StateValidityChecker::clearance;
        using ompl::base::StateValidityChecker::isValid;

        /** \brief Does the position lie within the bounds of the space, with the circle round it free? */
        bool isValid(const ompl::base::State *state) const override;

        /** \brief The distance between the circle and the nearest obstacle; 0 when they touch. Exact up to a metre, a
            lower bound beyond. */
        double clearance(const ompl::base::State *state) const override;

        /** \brief The checker behind this one. */
        const CircleChecker &circle() const
        {
            return circle_;
        }

    private:
        CircleChecker circle_;
    };

    /** \brief Proves straight motions of a circle free along their whole length (CircleChecker::freeShare()), in a
        plain SE2 space. A motion that touches an obstacle is never accepted. */
    class CircleMotionValidator : public ompl::base::MotionValidator
    {
    public:
        /** \brief \param checker of the circle, for the same space */
        CircleMotionValidator(const ompl::base::SpaceInformationPtr &si,
                              std::shared_ptr<const CircleValidityChecker> checker);

        /** \brief Is \e s2 valid, and the circle free all along the line from \e s1, which is taken to be valid? */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2) const override;

        /** \brief The same; otherwise \e lastValid becomes the fraction of the motion that is proven free and, unless
            null, the state there. */
        bool checkMotion(const ompl::base::State *s1, const ompl::base::State *s2,
                         std::pair<ompl::base::State *, double> &lastValid) const override;

    private:
        std::shared_ptr<const CircleValidityChecker> checker_;
    };
}  // namespace parking
