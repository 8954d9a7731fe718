// Prints the columns of a run as JSON. The table in docs/benchmark-reference.md and the report's columns are checked
// against it.
#include "benchmarks/store/RunColumns.h"

#include <iostream>

int main()
{
    nlohmann::json columns = nlohmann::json::array();
    for (const parking::RunColumn &column : parking::runColumns())
    {
        nlohmann::json each{
            {"name", column.name}, {"type", toString(column.type)}, {"unit", column.unit}, {"text", column.text}};
        if (column.report)
            each["report"] = {{"name", column.name},
                              {"heading", column.report->heading},
                              {"factor", column.report->factor},
                              {"unit", column.report->unit},
                              {"folded", column.report->folded},
                              {"share", column.type == parking::ColumnType::Boolean}};
        columns.push_back(std::move(each));
    }
    std::cout << columns.dump(1) << '\n';
}
