#pragma once

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <memory>

namespace ompl::base
{
    class ReedsSheppMotionValidator;  // where OMPL has one; from 2.0 on it stays a name
}

namespace parking
{
    /** \brief What differs between the releases 1.5 to 2.0 of OMPL, as far as the comparison meets it. What the
        libraries meet is in state_validity/ompl/OmplCompatibility.h. */
    namespace ompl_compatibility
    {
        /** \brief \e Validator itself, where this OMPL defines it: only a type that is complete has a size. */
        template <class Validator>
        auto validatorOfCurves(const ompl::base::SpaceInformationPtr &si, int /*preferred*/)
            -> decltype(sizeof(Validator), ompl::base::MotionValidatorPtr())
        {
            return std::make_shared<Validator>(si);
        }

        /** \brief The stand-in where this OMPL only has the name. */
        template <class Validator>
        ompl::base::MotionValidatorPtr validatorOfCurves(const ompl::base::SpaceInformationPtr &si, long /*otherwise*/)
        {
            return std::make_shared<ompl::base::DiscreteMotionValidator>(si);
        }

        /** \brief The validator that a Reeds-Shepp space brings: ReedsSheppMotionValidator, and from 2.0 on
            DiscreteMotionValidator. */
        inline ompl::base::MotionValidatorPtr reedsSheppValidator(const ompl::base::SpaceInformationPtr &si)
        {
            return validatorOfCurves<ompl::base::ReedsSheppMotionValidator>(si, 0);
        }
    }  // namespace ompl_compatibility
}  // namespace parking
