#include "automatic_parking/drawing/DriveAnimation.h"

#include "automatic_parking/drawing/DriveFigure.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/drawing/SvgScenario.h"
#include "parking_geometry/drawing/SvgText.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double UNIT = 1e-4;            // resolution of written numbers
        constexpr double DRAWN_STEP = 0.1;       // metres between the states of a drawn path
        constexpr double RIGHT_OF_FRAME = 16.0;  // pixels for half of the last tick's label
        constexpr double PLOT_WIDTH = 944.0;     // pixels
        constexpr double PLAN_OPACITY = 0.55, PLAN_UNDER_TRAJECTORY = 0.25;
        // Colours of perceived cells, which the page uses, too.
        constexpr const char *UNSEEN = "#94a3b8", *SEEN = "#475569", *RECENT = "#eab308";

        // The page with placeholders for the data of a drive.
        const char *const PAGE =
#include "DriveAnimationPage.inc"
            ;

        std::string number(double value)
        {
            const double rounded = std::round(value / UNIT);
            // As whole multiples of the unit: a division by a power of ten rounds to the short decimal.
            return formatNumber(rounded == 0.0 ? 0.0 : rounded / (1.0 / UNIT));
        }

        std::string column(const Trajectory &driven, double TrajectoryPoint::*field)
        {
            std::string text = "[";
            for (const TrajectoryPoint &point : driven)
                text += (text.size() > 1 ? "," : "") + number(point.*field);
            return text + "]";
        }

        void checkDrive(const Trajectory &driven)
        {
            if (driven.size() < 2)
                throw Error("animation: the drive has " + std::to_string(driven.size()) +
                            " points; at least 2 are required");
            for (std::size_t i = 0; i < driven.size(); ++i)
            {
                const TrajectoryPoint &point = driven[i];
                for (const double value :
                     {point.t, point.x, point.y, point.yaw, point.v, point.acceleration, point.steering})
                    if (!std::isfinite(value))
                        throw Error("animation: point " + std::to_string(i) + " holds a number that is not finite");
                if (i > 0 && point.t < driven[i - 1].t)
                    throw Error("animation: point " + std::to_string(i) + " is earlier than the one before");
            }
        }

        /** The planned path as thin lines, one per stretch between changes of direction. */
        void drawPlan(SvgMap &map, const SampledPath &planned, double opacity)
        {
            std::vector<Eigen::Vector2d> line;
            for (std::size_t i = 1; i < planned.size(); ++i)
            {
                if (line.empty())
                    line.emplace_back(planned[i - 1].pose.x, planned[i - 1].pose.y);
                line.emplace_back(planned[i].pose.x, planned[i].pose.y);
                if (i + 1 < planned.size() && planned[i + 1].direction == planned[i].direction)
                    continue;
                SvgStyle style;
                const bool reverse = planned[i].direction < 0;
                style.stroke = reverse ? svg_colour::REVERSE : svg_colour::FORWARD;
                style.strokeWidth = 2.5;
                style.strokeOpacity = opacity;
                if (map.drawLine(SvgLayer::Lines, line, style))
                    map.addLegend({reverse ? "planned, reverse" : "planned, forwards", style, SvgSample::Line});
                line.clear();
            }
        }

        void drawReference(SvgMap &map, const Trajectory &reference)
        {
            std::vector<Eigen::Vector2d> line;
            for (const TrajectoryPoint &point : reference)
                line.emplace_back(point.x, point.y);
            SvgStyle style;
            style.stroke = svg_colour::PLANNED;
            style.strokeWidth = 1.2;
            style.dash = "5 3";
            if (map.drawLine(SvgLayer::Lines, line, style))
                map.addLegend({"planned trajectory", style, SvgSample::Line});
        }

        /** The legend of the map and of the track behind the car. */
        std::string legendOf(SvgMap map)
        {
            SvgStyle driven;
            driven.stroke = svg_colour::DRIVEN;
            driven.strokeWidth = 2.0;
            map.addLegend({"driven", driven, SvgSample::Line});
            std::string text;
            for (const SvgLegendEntry &entry : map.legend())
                text += "<li><svg width=\"" + px(SAMPLE_WIDTH) + "\" height=\"16\" aria-hidden=\"true\">" +
                        legendSample(entry, 0.0, 0.0) + "</svg>" + escaped(entry.label) + "</li>\n";
            return text;
        }

        /** Speed, acceleration and steering angle over time, each with a cursor, which the page moves. */
        std::string plotsOf(const Trajectory &driven, const Vehicle &car, const Trajectory &reference)
        {
            std::string text;
            for (SvgPlot &plot : drivePlots(driven, car, reference))
            {
                plot.xRange = {driven.front().t, driven.back().t};
                text += "<div class=\"panel\"><svg class=\"plot\" viewBox=\"0 0 " + px(PLOT_WIDTH) + ' ' +
                        px(plot.height) + "\">\n" + plot.toSvg(0.0, 0.0, PLOT_WIDTH) + "<path d=\"M0 " +
                        px(SvgPlot::ABOVE) + 'V' + px(plot.height - SvgPlot::BELOW) + "\" stroke=\"" +
                        svg_colour::FORWARD + "\" stroke-width=\"1.5\"/>\n</svg></div>\n";
            }
            return text;
        }

        std::string rowOf(const std::vector<double> &values)
        {
            std::string text;
            for (const double value : values)
                text += (text.empty() ? "[" : ",") + number(value);
            return text.empty() ? "[]" : text + "]";
        }

        /** The changes of a frame as runs of equal cells: first cell, number of cells, occupancy. */
        std::vector<double> runsOf(const GridUpdate &changes, std::size_t width)
        {
            std::vector<double> runs;
            for (const CellChange &change : changes)
            {
                const double cell = static_cast<double>(change.row * width + change.column);
                const auto occupancy = static_cast<double>(change.cell);
                const std::size_t size = runs.size();
                if (size > 0 && runs[size - 1] == occupancy && runs[size - 3] + runs[size - 2] == cell)
                    ++runs[size - 2];
                else
                    runs.insert(runs.end(), {cell, 1.0, occupancy});
            }
            return runs;
        }

        /** The map before the first frame, and the changes of each one; null for a known world. */
        std::string seenJson(const DriveHistory &history)
        {
            const OccupancyGrid &map = history.map;
            if (map.cells().empty())
                return "null";
            GridUpdate known;
            for (std::uint32_t row = 0; row < map.height(); ++row)
                for (std::uint32_t column = 0; column < map.width(); ++column)
                    if (map.at(column, row) != Cell::Unknown)
                        known.push_back({column, row, map.at(column, row)});
            std::string frames = "[[-1," + rowOf(runsOf(known, map.width())) + "]";
            for (const SeenFrame &frame : history.frames)
                frames += ",\n[" + number(frame.time) + "," + rowOf(runsOf(frame.changes, map.width())) + "]";
            const Pose &origin = map.origin();
            return "{\"width\":" + std::to_string(map.width()) + ",\"height\":" + std::to_string(map.height()) +
                   ",\"cell\":" + formatNumber(map.resolution()) +
                   ",\"origin\":" + rowOf({origin.x, origin.y, origin.yaw}) + ",\n\"frames\":" + frames + "]}";
        }

        /** The plans of a drive: time, and x and y of each point. */
        std::string plansJson(const std::vector<TimedPlan> &plans)
        {
            std::string text;
            for (const TimedPlan &plan : plans)
            {
                std::vector<double> points;
                if (!plan.path.pieces.empty())
                    for (const PathState &state : plan.path.sample(DRAWN_STEP))
                        points.insert(points.end(), {state.pose.x, state.pose.y});
                text += (text.empty() ? "[" : ",\n[") + number(plan.time) + "," + rowOf(points) + "]";
            }
            return "[" + text + "]";
        }

        SvgStyle latestPlanStyle()
        {
            SvgStyle style;
            style.stroke = svg_colour::FORWARD;
            style.strokeWidth = 2.5;
            return style;
        }

        void addHistoryLegend(SvgMap &map, const DriveHistory &history)
        {
            if (!history.plans.empty())
                map.addLegend({"latest plan", latestPlanStyle(), SvgSample::Line});
            if (history.map.cells().empty())
                return;
            const auto add = [&map](const char *label, const char *colour)
            {
                SvgStyle style;
                style.fill = colour;
                map.addLegend({label, style, SvgSample::Box});
            };
            add("not seen yet", UNSEEN);
            add("seen obstacle", SEEN);
            add("seen in the last half second", RECENT);
        }

        void replace(std::string &text, const std::string &mark, const std::string &value)
        {
            for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
                text.replace(at, mark.size(), value);
        }
    }  // namespace

    std::string driveAnimation(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                               const std::string &title, const DriveDetails &details)
    {
        const Trajectory &reference = details.reference;
        const DriveHistory &history = details.history;
        checkDrive(driven);
        if (!reference.empty())
            checkDrive(reference);
        const SampledPath states = planned.pieces.empty() ? SampledPath{} : planned.sample(DRAWN_STEP);
        SampledPath seen = states;
        for (const TrajectoryPoint &point : driven)
            seen.push_back({{point.x, point.y, point.yaw}, 0.0, 0.0, 1});
        SvgMap map(viewAround(scenario, seen));
        drawScenario(map, scenario);
        if (history.plans.empty())
            drawPlan(map, states, reference.empty() ? PLAN_OPACITY : PLAN_UNDER_TRAJECTORY);
        if (!reference.empty())
            drawReference(map, reference);
        addHistoryLegend(map, history);

        const Vehicle &car = scenario.vehicle;
        std::string data = "{";
        const auto add = [&data](const std::string &name, const std::string &value)
        {
            data += (data.size() > 1 ? ",\n" : "") + ("\"" + name + "\":") + value;
        };
        add("t", column(driven, &TrajectoryPoint::t));
        add("x", column(driven, &TrajectoryPoint::x));
        add("y", column(driven, &TrajectoryPoint::y));
        add("yaw", column(driven, &TrajectoryPoint::yaw));
        add("v", column(driven, &TrajectoryPoint::v));
        add("a", column(driven, &TrajectoryPoint::acceleration));
        add("steering", column(driven, &TrajectoryPoint::steering));
        add("wheelbase", number(car.wheelbase));
        add("frontOverhang", number(car.frontOverhang));
        add("rearOverhang", number(car.rearOverhang));
        add("width", number(car.width));
        std::string outline;
        for (const Eigen::Vector2d &corner : car.outline)
            outline += (outline.empty() ? "[" : ",[") + formatNumber(corner.x()) + "," + formatNumber(corner.y()) + "]";
        add("outline", "[" + outline + "]");
        add("seen", seenJson(history));
        add("plans", plansJson(history.plans));
        add("colours", std::string("[\"") + UNSEEN + "\",\"" + SEEN + "\",\"" + RECENT + "\"]");
        add("plotLeft", number(SvgPlot::LEFT));
        add("plotRight", number(PLOT_WIDTH - SvgPlot::RIGHT));
        data += "}";

        std::string page = PAGE;
        replace(page, "@VIEW@",
                px(-SvgMap::LEFT_OF_FRAME) + " 0 " + px(SvgMap::LEFT_OF_FRAME + map.width() + RIGHT_OF_FRAME) + ' ' +
                    px(map.height() + SvgMap::BELOW_FRAME));
        // Metres, y up, on the pixels of the map.
        replace(page, "@METRES@",
                "matrix(" + formatNumber(map.scale()) + " 0 0 " + formatNumber(-map.scale()) + " " +
                    formatNumber(-map.scale() * map.view().min.x()) + " " +
                    formatNumber(map.scale() * map.view().max.y()) + ")");
        replace(page, "@FRAME@", "width=\"" + px(map.width()) + "\" height=\"" + px(map.height()) + "\"");
        replace(page, "@LATEST@", svg_colour::FORWARD);
        replace(page, "@DRIVEN@", svg_colour::DRIVEN);
        replace(page, "@DARK@", darkTheme());
        replace(page, "@DATA@", data);
        replace(page, "@MAP@", map.toSvg(0.0, 0.0));
        replace(page, "@LEGEND@", legendOf(map));
        replace(page, "@PLOTS@", plotsOf(driven, car, reference));
        // User text comes last, so that no placeholder in it is replaced.
        replace(page, "@SUBTITLE@", escaped(details.subtitle));
        replace(page, "@TITLE@", escaped(title));
        return page;
    }

    void writeDriveAnimation(const std::string &file, const Scenario &scenario, const Path &planned,
                             const Trajectory &driven, const std::string &title, const DriveDetails &details)
    {
        writeFileAtomically(file, driveAnimation(scenario, planned, driven, title, details));
    }
}  // namespace parking
