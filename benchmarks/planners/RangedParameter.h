#pragma once

#include "parking_geometry/text/Text.h"

#include <ompl/base/Planner.h>
#include <ompl/util/Exception.h>

#include <string>

namespace parking
{
    /** \brief The valid range of a planner's parameter. */
    struct ParameterRange
    {
        double min,  ///< smallest valid value
            max;     ///< largest valid value
    };

    /** \brief Declares a parameter of \e planner that is stored in \e value, a member of it.

        A number outside of \e range throws ompl::Exception naming planner and parameter.

        \param usual the usual values, a part of the valid ones, in OMPL's format */
    template <class Value>
    void declareRanged(ompl::base::Planner &planner, const std::string &name, Value &value, const ParameterRange &range,
                       const std::string &usual)
    {
        planner.params().declareParam<Value>(
            name,
            [&planner, &value, name, range](Value wanted)
            {
                const auto number = static_cast<double>(wanted);
                if (!(number >= range.min && number <= range.max))
                    throw ompl::Exception(planner.getName(), name + " must be between " + formatNumber(range.min) +
                                                                 " and " + formatNumber(range.max) + ", not " +
                                                                 formatNumber(number));
                value = wanted;
            },
            [&value] { return value; });
        planner.params().getParam(name)->setRangeSuggestion(usual);
    }
}  // namespace parking
