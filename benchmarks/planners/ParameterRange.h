#pragma once

#include "parking_geometry/text/Text.h"

#include <ompl/util/Exception.h>

#include <string>

namespace parking
{
    /** \brief The numbers that a parameter of a planner may be. */
    struct ParameterRange
    {
        double least,  ///< the smallest of them
            most;      ///< the largest of them

        /** \brief Throws ompl::Exception naming planner and parameter when \e value is none of them: when it is set,
            so that nobody first plans with it. */
        void require(const std::string &planner, const std::string &parameter, double value) const
        {
            if (!(value >= least && value <= most))
                throw ompl::Exception(planner, parameter + " must be between " + formatNumber(least) + " and " +
                                                   formatNumber(most) + ", not " + formatNumber(value));
        }
    };
}  // namespace parking
