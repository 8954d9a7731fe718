// Prints the table of the planner's parameters for docs/parameters.md, in Markdown.
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/text/Text.h"

#include <iostream>
#include <type_traits>

namespace
{
    using namespace parking;

    std::string inCode(const std::string &name)
    {
        return "`" + name + "`";
    }

    std::string defaultOf(const Parameter &row)
    {
        const PlannerParameters defaults;
        return std::visit(
            [&](const auto member) -> std::string
            {
                using Value = std::decay_t<decltype(defaults.*member)>;
                if constexpr (std::is_same_v<Value, std::string>)
                    return inCode(defaults.*member);
                else if constexpr (std::is_same_v<Value, bool>)
                    return defaults.*member ? "`true`" : "`false`";
                else
                    return formatNumber(defaults.*member);
            },
            row.member);
    }

    std::string valuesOf(const Parameter &row)
    {
        if (std::holds_alternative<bool PlannerParameters::*>(row.member))
            return "`true`, `false`";
        if (row.values.names == nullptr)
            return row.allowed();
        std::string text;
        for (const std::string &name : row.values.names())
            text += (text.empty() ? "" : ", ") + inCode(name);
        return text;
    }
}  // namespace

int main()
{
    std::cout << "| parameter | default | values | meaning |\n| --- | --- | --- | --- |\n";
    for (const Parameter &row : parameterTable())
        std::cout << "| " << inCode(row.name) << " | " << defaultOf(row) << " | " << valuesOf(row) << " | "
                  << row.meaning << " |\n";
}
