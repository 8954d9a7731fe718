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
        /** \e text without the byte order mark that some Windows programs write. */
        std::string withoutMark(const std::string &file, std::string text)
        {
            if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
                text.erase(0, 3);
            if (trimmed(text).empty())
                throw Error(file + ": contains only blanks");
            return text;
        }

        /** A case begins with a number and a comma. A YAML mapping cannot. A file without such a beginning and without
            any "key:" is a damaged case if its name suggests a case. */
        bool looksLikeTpcap(const std::string &file, const std::string &text)
        {
            double ignored = 0.0;
            const std::string_view first = trimmed(text).substr(0, trimmed(text).find_first_of(",\n"));
            if (parseNumber(trimmed(first), ignored))
                return true;
            return text.find(':') == std::string::npos && std::filesystem::path(file).extension() == ".csv";
        }

        /** Throws for scenario formats of other programs. */
        void refuseFormatsOfOthers(const std::string &file, const std::string &text)
        {
            const auto holds = [&text](const char *part)
            {
                return text.find(part) != std::string::npos;
            };
            const char first = trimmed(text).front();
            const bool isMatlab = text.compare(0, 7, "MATLAB ") == 0;
            const bool isSvg = first == '<' && (holds("<svg") || holds(":svg"));
            const bool isParkBench = first == '{' && holds("\"NfmAggregatedPolygonObjects\"");
            if (isMatlab || isSvg || isParkBench)
            {
                const std::string kind = isMatlab ? "a MATLAB" : isSvg ? "an SVG" : "a ParkBench";
                throw Error(file + ": is " + kind + " file; make a scenario of it first: parking_convert " + file +
                            " " + std::filesystem::path(file).replace_extension(".yaml").string() +
                            (isSvg ? " --start X,Y,YAW --goal X,Y,YAW" : ""));
            }
            if (first == '<')
                throw Error(file + ": is XML; supported are YAML scenarios and TPCAP cases (.csv), and " +
                            "parking_convert converts Bench-MR scenes (.svg) and CommonParking cases (.mat)");
        }

        /** The scenario with the start and the goal of \e options. */
        Scenario withPoses(Scenario scenario, const std::string &file, const ReaderOptions &options)
        {
            const auto local = [&scenario](const Pose &pose) -> Pose
            {
                return {pose.x - scenario.worldOffset.x(), pose.y - scenario.worldOffset.y(), wrapAngle(pose.yaw)};
            };
            if (options.start)
                scenario.start = local(*options.start);
            if (options.goal)
            {
                scenario.goals = {local(*options.goal)};
                scenario.slot.reset();
            }
            if (options.start || options.goal)
                completeScenario(scenario, file);
            return scenario;
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
        refuseFormatsOfOthers(file, text);
        return withPoses(looksLikeTpcap(file, text) ? parseTpcapCase(file, text, options.vehicle)
                                                    : parseYamlScenario(file, text, options.vehicle),
                         file, options);
    }
}  // namespace parking
