#include "benchmarks/comparison/ConfigLines.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace parking
{
    ConfigLines::ConfigLines(const std::string &file, const std::string &text) : file_(file)
    {
        std::istringstream stream(text);
        std::string line;
        std::string section;
        for (std::size_t number = 1; std::getline(stream, line); ++number)
        {
            const std::string_view content = trimmed(std::string_view(line).substr(0, line.find('#')));
            if (content.empty())
                continue;
            if (content.front() == '[')
            {
                section = std::string(content);
                const std::vector<std::string> known{"[problem]", "[benchmark]", "[planner]"};
                if (std::find(known.begin(), known.end(), section) == known.end())
                    throw Error(where(number) + unknownName("section", section, known));
            }
            else if (content.find('=') == std::string_view::npos)
                throw Error(where(number) + "expected 'key = value' or '[section]', not " + inQuotes(content));
            else if (section.empty())
                throw Error(where(number) + "the key " + inQuotes(content) +
                            " is in no section; expected [problem], [benchmark] or [planner] before it");
            else
                numbers_.push_back(number);
        }
    }

    std::string ConfigLines::at(std::size_t index) const
    {
        return index < numbers_.size() ? where(numbers_[index]) : file_ + ": ";
    }

    void ConfigLines::noteOnce(std::map<std::string, std::string> &known, const std::string &key,
                               const std::string &name, std::size_t index) const
    {
        const auto [first, isNew] = known.emplace(key, at(index));
        if (!isNew)
            throw Error(inQuotes(name) + " is given twice, first at " +
                        first->second.substr(0, first->second.rfind(": ")) + "; leave one of them out");
    }

    std::string ConfigLines::where(std::size_t number) const
    {
        return file_ + ":" + std::to_string(number) + ": ";
    }
}  // namespace parking
