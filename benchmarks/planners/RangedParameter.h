#pragma once

#include "parking_geometry/text/Text.h"

#include <ompl/base/Planner.h>
#include <ompl/util/Exception.h>

#include <string>

namespace parking
{
    /** \brief The numbers that a parameter of a planner may be. */
    struct ParameterRange
    {
        double least,  ///< the smallest of them
            most;      ///< the largest of them
    };

    /** \brief Declares a parameter of \e planner that is kept in \e value, a member of it.

        Setting a number outside of \e range throws ompl::Exception naming planner and parameter, so that the planner
        never plans with it.

        \param usual in OMPL's form: the usual values, which are fewer than the possible ones */
    template <class Value>
    void declareRanged(ompl::base::Planner &planner, const std::string &name, Value &value, const ParameterRange &range,
                       const std::string &usual)
    {
        planner.params().declareParam<Value>(
            name,
            [&planner, &value, name, range](Value wanted)
            {
                const auto number = static_cast<double>(wanted);
                if (!(number >= range.least && number <= range.most))
                    throw ompl::Exception(planner.getName(), name + " must be between " + formatNumber(range.least) +
                                                                 " and " + formatNumber(range.most) + ", not " +
                                                                 formatNumber(number));
                value = wanted;
            },
            [&value] { return value; });
        planner.params().getParam(name)->setRangeSuggestion(usual);
    }
}  // namespace parking
