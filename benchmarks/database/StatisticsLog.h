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
        std::vector<LogColumn> columns;                   ///< names and types
        std::vector<std::vector<std::string_view>> rows;  ///< as many cells in each as there are columns
    };

    /** \brief What a log says of one planner. */
    struct LogPlanner
    {
        std::string name;                        ///< as the log calls it
        std::string settings;                    ///< lines `name = value`, each ended by a semicolon
        LogTable runs;                           ///< a row for each run
        std::vector<LogColumn> progressColumns;  ///< of the rows of progress; empty where the log has none
        /** By run and moment: a row for each. Empty where a log has none. */
        std::vector<std::vector<std::vector<std::string_view>>> progress;
    };

    /** \brief A log of ompl::tools::Benchmark, taken apart. What is a view looks into the text that was parsed. */
    struct StatisticsLog
    {
        /** \brief A property of the experiment, or a value of one. */
        struct Property
        {
            LogColumn column;        ///< name and type
            std::string_view value;  ///< as it is written
        };

        /** \brief The values of an enumeration, from 0. */
        struct Enumeration
        {
            std::string_view name;                 ///< name of the type
            std::vector<std::string_view> values;  ///< their names; the number of each is its index
        };

        std::string version;                    ///< library and version, `OMPL 1.5.2`
        std::string_view experiment,            ///< name of the experiment
            host;                               ///< name of the machine
        std::string date;                       ///< and time at which it began, as it is written
        std::string setup,                      ///< the problem in OMPL's words, several lines
            cpu;                                ///< what is known of the processor, several lines
        std::string_view seed,                  ///< a number, as it is written; so are the following
            timeLimit,                          ///< seconds per run
            memoryLimit,                        ///< MB per run
            runCount,                           ///< runs of each planner
            totalTime;                          ///< seconds spent to collect the data
        std::vector<Property> properties;       ///< of the experiment
        std::vector<Enumeration> enumerations;  ///< types of the columns that are an ENUM
        std::vector<LogPlanner> planners;       ///< in the order of the log
    };

    /** \brief Takes a log apart.

        \param text of the log; it has to outlive what is returned
        \param file names the log in errors
        Throws parking::Error naming file, line and what was expected there. */
    StatisticsLog parseStatisticsLog(std::string_view text, const std::string &file);
}  // namespace parking
