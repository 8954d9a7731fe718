#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace parking
{
    /** \brief A column as a log names it: `time REAL`. */
    struct LogColumn
    {
        std::string name;       ///< words joined by underscores, as in the database
        std::string_view type;  ///< BOOLEAN, INTEGER, REAL or ENUM
    };

    /** \brief Columns, and a row of cells for each run or moment. A cell is text; blank, `nan` and `inf` say nothing.
     */
    struct LogTable
    {
        std::vector<LogColumn> columns;
        std::vector<std::vector<std::string_view>> rows;
    };

    /** \brief What a log says of one planner. */
    struct LogPlanner
    {
        std::string name;
        std::string settings;  ///< lines `name = value`, each ended by a semicolon
        LogTable runs;
        std::vector<LogColumn> progressColumns;
        /** By run and moment: a row for each. Empty where a log has none. */
        std::vector<std::vector<std::vector<std::string_view>>> progress;
    };

    /** \brief A log of ompl::tools::Benchmark, taken apart. What is a view looks into the text that was parsed. */
    struct StatisticsLog
    {
        /** \brief A property of the experiment, or a value of one. */
        struct Property
        {
            LogColumn column;
            std::string_view value;
        };

        /** \brief The values of an enumeration, from 0. */
        struct Enumeration
        {
            std::string_view name;
            std::vector<std::string_view> values;
        };

        std::string version;  ///< library and version, `OMPL 1.5.2`
        std::string_view experiment, host;
        std::string date;
        std::string setup, cpu;
        std::string_view seed, timeLimit, memoryLimit, runCount, totalTime;  ///< numbers as they are written
        std::vector<Property> properties;
        std::vector<Enumeration> enumerations;
        std::vector<LogPlanner> planners;
    };

    /** \brief Takes a log apart.

        \param text of the log; it has to outlive what is returned
        \param file names the log in errors
        Throws parking::Error naming file, line and what was expected there. */
    StatisticsLog parseStatisticsLog(std::string_view text, const std::string &file);
}  // namespace parking
