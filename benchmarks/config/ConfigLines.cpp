#include "benchmarks/config/ConfigLines.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace parking
{
    namespace
    {
        constexpr std::size_t CONFIG_LIMIT = std::size_t(1) << 20;  // bytes
    }

    void ConfigLine::noteOnce(std::map<std::string, std::string> &known, const std::string &name) const
    {
        const auto [first, isNew] = known.emplace(name, where);
        if (!isNew)
            throw Error(inQuotes(key) + " is given twice, first at " +
                        first->second.substr(0, first->second.rfind(": ")) + "; leave one of them out");
    }

    std::vector<ConfigLine> readConfigLines(const std::string &file)
    {
        const std::vector<std::string> known{"[problem]", "[benchmark]", "[planner]"};
        std::vector<ConfigLine> lines;
        std::istringstream stream(readFile(file, CONFIG_LIMIT));
        std::string line, section;
        for (std::size_t number = 1; std::getline(stream, line); ++number)
        {
            const std::string where = file + ":" + std::to_string(number) + ": ";
            const std::string_view content = trimmed(std::string_view(line).substr(0, line.find('#')));
            const std::size_t sign = content.find('=');
            if (content.empty())
                continue;
            if (content.front() == '[')
            {
                section = std::string(content);
                if (std::find(known.begin(), known.end(), section) == known.end())
                    throw Error(where + unknownName("section", section, known));
            }
            else if (sign == std::string_view::npos)
                throw Error(where + "expected 'key = value' or '[section]', not " + inQuotes(content));
            else if (section.empty())
                throw Error(where + "the key " + inQuotes(content) +
                            " is in no section; expected [problem], [benchmark] or [planner] before it");
            else
                lines.push_back({section.substr(1, section.size() - 2), std::string(trimmed(content.substr(0, sign))),
                                 std::string(trimmed(content.substr(sign + 1))), where});
        }
        return lines;
    }
}  // namespace parking
