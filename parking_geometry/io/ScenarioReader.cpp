#include "parking_geometry/io/ScenarioReader.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <filesystem>
#include <utility>

namespace parking
{
    namespace
    {
        /** \e text without the mark that some Windows programs put in front of UTF-8. */
        std::string withoutMark(const std::string &file, std::string text)
        {
            if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
                text.erase(0, 3);
            if (trimmed(text).empty())
                throw Error(file + ": holds nothing but blanks");
            return text;
        }

        /** A case begins with a number and a comma; YAML cannot, for its top is a mapping. A file that begins with
            neither and has no "key:" at all is a damaged case when it is called one. */
        bool looksLikeTpcap(const std::string &file, const std::string &text)
        {
            double ignored = 0.0;
            const std::string_view first = trimmed(text).substr(0, trimmed(text).find_first_of(",\n"));
            if (parseNumber(trimmed(first), ignored))
                return true;
            return text.find(':') == std::string::npos && std::filesystem::path(file).extension() == ".csv";
        }
    }  // namespace

    std::string scenarioName(const std::string &file)
    {
        return std::filesystem::path(file).stem().string();
    }

    Scenario readScenario(const std::string &file, const ReaderOptions &options)
    {
        return parseScenario(file, readFile(file, TEXT_FILE_LIMIT), options);
    }

    Scenario parseScenario(const std::string &file, std::string text, const ReaderOptions &options)
    {
        text = withoutMark(file, std::move(text));
        return looksLikeTpcap(file, text) ? parseTpcapCase(file, text, options.vehicle)
                                          : parseYamlScenario(file, text, options.vehicle);
    }
}  // namespace parking
