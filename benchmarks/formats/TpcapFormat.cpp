// Cases of the Trajectory Planning Competition of Automated Parking: one list of numbers.

#include "benchmarks/formats/ScenarioFormat.h"

#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

namespace parking
{
    namespace
    {
        bool recognizes(std::string_view begin)
        {
            double ignored = 0.0;
            const std::string_view text = trimmed(begin);
            return parseNumber(trimmed(text.substr(0, text.find_first_of(",\n"))), ignored);
        }

        Scenario parse(const std::string &file, const std::string &content, const FormatOptions &options)
        {
            return withOptions(parseScenario(file, content, {options.vehicle}), file, options);
        }

        void write(const Scenario &scenario, const std::string &file)
        {
            std::string text;
            const auto add = [&text](double value)
            {
                text += (text.empty() ? "" : ",") + formatNumber(value);
            };
            for (const Pose &pose : {scenario.toWorld(scenario.start), scenario.toWorld(scenario.goals.front())})
                for (const double value : {pose.x, pose.y, pose.yaw})
                    add(value);
            const std::vector<Polygon> polygons = obstaclePolygons(scenario);
            add(static_cast<double>(polygons.size()));
            for (const Polygon &polygon : polygons)
                add(static_cast<double>(polygon.size()));
            for (const Polygon &polygon : polygons)
                for (const Eigen::Vector2d &corner : polygon)
                {
                    add(corner.x());
                    add(corner.y());
                }
            writeFileAtomically(file, text + "\n");
        }
    }  // namespace

    ScenarioFormat tpcapFormat()
    {
        return {"tpcap",
                ".csv",
                "cases of TPCAP; the car is not in them: TPCAP's, unless --vehicle says otherwise",
                recognizes,
                TEXT_FILE_LIMIT,
                parse,
                write};
    }
}  // namespace parking
