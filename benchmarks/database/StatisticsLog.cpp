#include "benchmarks/database/StatisticsLog.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cctype>

namespace parking
{
    namespace
    {
        /** The parts between separators; what follows the last one is no part. */
        std::vector<std::string_view> endedBy(std::string_view separator, std::string_view line)
        {
            std::vector<std::string_view> parts;
            for (std::size_t end = 0; (end = line.find(separator)) != std::string_view::npos;)
            {
                parts.push_back(line.substr(0, end));
                line.remove_prefix(end + separator.size());
            }
            return parts;
        }

        std::vector<std::string_view> wordsOf(std::string_view line)
        {
            std::vector<std::string_view> words;
            while (!(line = trimmed(line)).empty())
            {
                const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
                words.push_back(line.substr(0, end));
                line.remove_prefix(end);
            }
            return words;
        }

        class LogParser
        {
        public:
            LogParser(std::string_view text, const std::string &file) : rest_(text), file_(file)
            {
            }

            StatisticsLog parse()
            {
                StatisticsLog log;
                const std::vector<std::string_view> version = wordsOf(line());
                require(version.size() == 3 && version[1] == "version", "the version: 'OMPL version 1.5.2'");
                log.version = std::string(version[0]) + " " + std::string(version[2]);
                log.experiment = after("Experiment ");
                // Logs of older versions do without.
                const std::string_view next = rest_.substr(0, rest_.find('\n'));
                if (next.find(" experiment properties") != std::string_view::npos)
                    for (std::size_t left = count(" experiment properties"); left > 0; --left)
                        log.properties.push_back(property());
                log.host = after("Running on ");
                log.date = after("Starting at ");
                log.setup = block();
                log.cpu = block();
                log.seed = before(" is the random seed");
                log.timeLimit = before(" seconds per run");
                log.memoryLimit = before(" MB per run");
                log.runCount = before(" runs per planner");
                log.totalTime = before(" seconds spent to collect the data");
                for (std::size_t left = count(" enum type"); left > 0; --left)
                    log.enumerations.push_back(enumeration());
                for (std::size_t left = count(" planners"); left > 0; --left)
                    log.planners.push_back(planner());
                return log;
            }

        private:
            std::string_view line()
            {
                const std::size_t end = rest_.find('\n');
                ++number_;
                require(end != std::string_view::npos, "more: it ends too early");
                const std::string_view result = rest_.substr(0, end);
                rest_.remove_prefix(end + 1);
                return result;
            }

            [[noreturn]] void fail(const std::string &expected) const
            {
                throw Error(file_ + ":" + std::to_string(number_) + ": is no log of OMPL's benchmarks, expected " +
                            expected);
            }

            void require(bool holds, const char *expected) const
            {
                if (!holds)
                    fail(expected);
            }

            std::string_view after(std::string_view words)
            {
                const std::string_view content = line();
                if (content.substr(0, words.size()) != words)
                    fail(inQuotes(words));
                return content.substr(words.size());
            }

            /** What precedes the words, after which there may be more ("enum types"). */
            std::string_view before(std::string_view words)
            {
                const std::string_view content = line();
                const std::size_t at = content.find(words);
                if (at == std::string_view::npos)
                    fail(inQuotes(words));
                return content.substr(0, at);
            }

            std::size_t count(std::string_view words)
            {
                std::size_t number = 0;
                require(parseCount(before(words), number), "a number");
                return number;
            }

            /** The text between the lines `<<<|` and `|>>>`. */
            std::string block()
            {
                require(line() == "<<<|", "'<<<|'");
                std::string text;
                for (std::string_view each = line(); each.substr(0, 4) != "|>>>"; each = line())
                    text.append(each).append("\n");
                return text;
            }

            LogColumn column(std::string_view text, const std::string &glue) const
            {
                const std::vector<std::string_view> words = wordsOf(text);
                require(words.size() > 1, "the name and the type of a column");
                LogColumn result;
                for (std::size_t i = 0; i + 1 < words.size(); ++i)
                    result.name.append(i > 0 ? glue : "").append(words[i]);
                result.type = words.back();
                if (!std::all_of(result.type.begin(), result.type.end(),
                                 [](unsigned char letter) { return std::isalpha(letter) != 0; }))
                    fail("the type of a column, not " + inQuotes(result.type));
                return result;
            }

            StatisticsLog::Property property()
            {
                const std::string_view content = line();
                const std::size_t sign = content.find(" = ");
                require(sign != std::string_view::npos, "'name TYPE = value'");
                StatisticsLog::Property result{column(content.substr(0, sign), ""), content.substr(sign + 3)};
                std::replace(result.column.name.begin(), result.column.name.end(), '-', '_');
                return result;
            }

            StatisticsLog::Enumeration enumeration()
            {
                std::string_view content = line();
                StatisticsLog::Enumeration result;
                std::size_t end = content.find('|');
                result.name = content.substr(0, end);
                while (end != std::string_view::npos)
                {
                    content.remove_prefix(end + 1);
                    end = content.find('|');
                    result.values.push_back(content.substr(0, end));
                }
                return result;
            }

            std::vector<LogColumn> columns(std::size_t number)
            {
                std::vector<LogColumn> result;
                for (; number > 0; --number)
                    result.push_back(column(line(), "_"));
                return result;
            }

            void requireCells(const std::vector<std::string_view> &cells, const std::vector<LogColumn> &names) const
            {
                if (cells.size() != names.size())
                    fail(std::to_string(names.size()) + " figures, not " + std::to_string(cells.size()));
            }

            LogPlanner planner()
            {
                LogPlanner result;
                result.name = line();
                for (std::size_t left = count(" common properties"); left > 0; --left)
                    result.settings.append(line()).append("\n;");
                result.runs.columns = columns(count(" properties for each run"));
                for (std::size_t left = count(" runs"); left > 0; --left)
                {
                    result.runs.rows.push_back(endedBy("; ", line()));
                    requireCells(result.runs.rows.back(), result.runs.columns);
                }
                const std::string_view next = line();
                if (next == ".")
                    return result;
                std::size_t number = 0;
                require(parseCount(next.substr(0, next.find(' ')), number), "the progress properties, or '.'");
                result.progressColumns = columns(number);
                for (std::size_t left = count(" runs"); left > 0; --left)
                {
                    result.progress.emplace_back();
                    for (const std::string_view moment : endedBy(";", line()))
                    {
                        result.progress.back().push_back(endedBy(",", moment));
                        requireCells(result.progress.back().back(), result.progressColumns);
                    }
                }
                require(result.progress.size() <= result.runs.rows.size(), "no more progress than runs");
                require(line() == ".", "'.'");
                return result;
            }

            std::string_view rest_;
            const std::string &file_;
            std::size_t number_{0};
        };
    }  // namespace

    StatisticsLog parseStatisticsLog(std::string_view text, const std::string &file)
    {
        return LogParser(text, file).parse();
    }
}  // namespace parking
