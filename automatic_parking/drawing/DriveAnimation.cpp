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

        void replace(std::string &text, const std::string &mark, const std::string &value)
        {
            for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
                text.replace(at, mark.size(), value);
        }
    }  // namespace

    std::string driveAnimation(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                               const std::string &title, const std::string &subtitle, const Trajectory &reference)
    {
        checkDrive(driven);
        if (!reference.empty())
            checkDrive(reference);
        const SampledPath states = planned.pieces.empty() ? SampledPath{} : planned.sample(DRAWN_STEP);
        SampledPath seen = states;
        for (const TrajectoryPoint &point : driven)
            seen.push_back({{point.x, point.y, point.yaw}, 0.0, 0.0, 1});
        SvgMap map(viewAround(scenario, seen));
        drawScenario(map, scenario);
        drawPlan(map, states, reference.empty() ? PLAN_OPACITY : PLAN_UNDER_TRAJECTORY);
        if (!reference.empty())
            drawReference(map, reference);

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
        replace(page, "@DRIVEN@", svg_colour::DRIVEN);
        replace(page, "@DARK@", darkTheme());
        replace(page, "@DATA@", data);
        replace(page, "@MAP@", map.toSvg(0.0, 0.0));
        replace(page, "@LEGEND@", legendOf(map));
        replace(page, "@PLOTS@", plotsOf(driven, car, reference));
        // User text comes last, so that no placeholder in it is replaced.
        replace(page, "@SUBTITLE@", escaped(subtitle));
        replace(page, "@TITLE@", escaped(title));
        return page;
    }

    void writeDriveAnimation(const std::string &file, const Scenario &scenario, const Path &planned,
                             const Trajectory &driven, const std::string &title, const std::string &subtitle)
    {
        writeFileAtomically(file, driveAnimation(scenario, planned, driven, title, subtitle));
    }
}  // namespace parking
