// The parameters of ImprovedAStar for OMPL: the rows of the table, as entries of a ParamSet.

#include "ompl_improved_astar/ImprovedAStar.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <ompl/util/Exception.h>

#include <type_traits>

namespace ompl::geometric
{
    namespace
    {
        /** In the form that OMPL.app reads: "0,1" for a switch, "min:step:max", or names with commas. */
        std::string rangeSuggestion(const parking::Parameter &row)
        {
            if (std::holds_alternative<bool parking::PlannerParameters::*>(row.member))
                return "0,1";
            const parking::ParameterValues &values = row.values;
            if (values.names == nullptr)
                return parking::formatNumber(values.allowsZero ? 0.0 : values.min) + ":" +
                       parking::formatNumber(values.step) + ":" + parking::formatNumber(values.max);
            std::string names;
            for (const std::string &name : values.names())
                names += (names.empty() ? "" : ",") + name;
            return names;
        }
    }  // namespace

    void ImprovedAStar::setParameters(const parking::PlannerParameters &parameters)
    {
        try
        {
            parking::checkParameters(parameters);
        }
        catch (const parking::Error &error)
        {
            throw Exception(getName(), error.what());
        }
        parameters_ = parameters;
    }

    void ImprovedAStar::declareParameters()
    {
        const auto declare = [this](const parking::Parameter &row, const auto member)
        {
            using Value = std::decay_t<decltype(parameters_.*member)>;
            const auto set = [this, member, isSet = row.name == "parameter_set"](Value value)
            {
                parking::PlannerParameters changed = parameters_;
                changed.*member = std::move(value);
                setParameters(changed);
                if (isSet)
                    parameters_ = parking::parameterSet(parameters_.parameterSet, parameters_);
            };
            params_.declareParam<Value>(row.name, set, [this, member] { return parameters_.*member; });
            params_[row.name].setRangeSuggestion(rangeSuggestion(row));
        };
        for (const parking::Parameter &row : parking::parameterTable())
            std::visit([&](const auto member) { declare(row, member); }, row.member);
    }
}  // namespace ompl::geometric
