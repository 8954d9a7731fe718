#include "parking_geometry/drawing/SvgScenario.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace parking
{
    namespace
    {
        Eigen::Vector2d positionOf(const Pose &pose)
        {
            return {pose.x, pose.y};
        }

        SvgStyle filled(const std::string &fill, const std::string &stroke = "none")
        {
            SvgStyle style;
            style.fill = fill;
            style.stroke = stroke;
            return style;
        }

        SvgStyle stroked(const std::string &stroke, double width, const std::string &dash = {})
        {
            SvgStyle style;
            style.stroke = stroke;
            style.strokeWidth = width;
            style.dash = dash;
            return style;
        }

        const char *colourOf(int direction)
        {
            return direction < 0 ? svg_colour::REVERSE : svg_colour::FORWARD;
        }

        Polygon cornersOf(const Box &box)
        {
            return {box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
        }

        void drawOutside(SvgMap &map, const Scenario &scenario)
        {
            Polygon world = scenario.grid ? scenario.grid->outline() : cornersOf(scenario.bounds);
            std::reverse(world.begin(), world.end());  // the world is a hole in the outside
            const SvgStyle style = filled(svg_colour::OUTSIDE);
            if (map.drawOutlines(SvgLayer::Ground, {cornersOf(map.view()), world}, style))
                map.addLegend({"outside of the map", style});
        }

        /** Rectangles that together cover exactly the cells of one kind near the window. Each is a run of cells in a
           row, extended upwards as long as the rows above have the same run. */
        std::vector<Polygon> rectanglesOf(const OccupancyGrid &grid, Cell kind, const Box &window)
        {
            const auto toCells = [&grid](const Eigen::Vector2d &point) -> Eigen::Vector2d
            {
                return positionOf(relativeTo(grid.origin(), {point.x(), point.y(), 0.0})) / grid.resolution();
            };
            Box cells{toCells(window.min), toCells(window.min)};
            for (const Eigen::Vector2d &corner : cornersOf(window))
                cells.include(toCells(corner));
            const auto index = [](double value, std::size_t end)
            {
                return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(end)));
            };
            const std::size_t firstColumn = index(std::floor(cells.min.x()), grid.width());
            const std::size_t endColumn = index(std::ceil(cells.max.x()), grid.width());
            const std::size_t firstRow = index(std::floor(cells.min.y()), grid.height());
            const std::size_t endRow = index(std::ceil(cells.max.y()), grid.height());

            std::vector<Polygon> rectangles;
            using Columns = std::pair<std::size_t, std::size_t>;
            std::map<Columns, std::size_t> open;  // runs of the row below, and the row in which each began
            for (std::size_t row = firstRow; row <= endRow; ++row)
            {
                std::map<Columns, std::size_t> runs;
                for (std::size_t column = firstColumn; row < endRow && column < endColumn; ++column)
                {
                    const std::size_t begin = column;
                    while (column < endColumn && grid.at(column, row) == kind)
                        ++column;
                    if (column == begin)
                        continue;
                    const auto below = open.find({begin, column});
                    runs[{begin, column}] = below != open.end() ? below->second : row;
                    if (below != open.end())
                        open.erase(below);
                }
                for (const auto &[columns, begin] : open)
                {
                    rectangles.emplace_back();
                    for (const auto &[x, y] : {Columns{columns.first, begin}, Columns{columns.second, begin},
                                               Columns{columns.second, row}, Columns{columns.first, row}})
                        rectangles.back().push_back(
                            positionOf(compose(grid.origin(), {static_cast<double>(x) * grid.resolution(),
                                                               static_cast<double>(y) * grid.resolution(), 0.0})));
                }
                open = std::move(runs);
            }
            return rectangles;
        }

        void drawObstacles(SvgMap &map, const Scenario &scenario)
        {
            const SvgStyle style = filled(svg_colour::OBSTACLE, svg_colour::OBSTACLE_EDGE);
            bool seen = false;
            for (const Polygon &polygon : scenario.polygons)
                seen |= map.drawPolygon(SvgLayer::Obstacles, polygon, style);
            SvgStyle cells = style;
            cells.strokeWidth = 2.0;  // only its outer half is visible
            if (scenario.grid)
                seen |= map.drawOutlines(SvgLayer::Obstacles, rectanglesOf(*scenario.grid, Cell::Occupied, map.view()),
                                         cells);
            if (seen)
                map.addLegend({"obstacle", style});
        }

        void drawUnknown(SvgMap &map, const Scenario &scenario)
        {
            const SvgStyle style = filled(svg_colour::UNKNOWN);
            if (scenario.grid &&
                map.drawOutlines(SvgLayer::Ground, rectanglesOf(*scenario.grid, Cell::Unknown, map.view()), style))
                map.addLegend(
                    {scenario.unknownIsOccupied ? "unknown (not to be entered)" : "unknown (taken as free)", style});
        }

        /** Parts of a path with one direction, that of their last state. Each begins with the last state of the
            previous part. */
        std::vector<SampledPath> stretchesOf(const SampledPath &path)
        {
            std::vector<SampledPath> stretches;
            for (std::size_t i = 1; i < path.size(); ++i)
            {
                if (stretches.empty() || path[i].direction != stretches.back().back().direction)
                    stretches.push_back({path[i - 1]});
                stretches.back().push_back(path[i]);
            }
            return stretches;
        }

        SvgStyle sweepStyle(int direction)
        {
            SvgStyle style = filled(colourOf(direction), colourOf(direction));
            style.fillOpacity = 0.035;
            style.strokeOpacity = 0.4;
            style.strokeWidth = 0.8;
            return style;
        }

        /** Draws a body at a pose. \return whether it is visible */
        using DrawBody = std::function<bool(const Pose &, const SvgStyle &)>;

        /** Draws the body along one stretch, \e spacing metres apart and at its end. \return whether any is visible */
        bool drawSweep(const SampledPath &stretch, double spacing, const DrawBody &drawBody)
        {
            const SvgStyle style = sweepStyle(stretch.back().direction);
            bool seen = false;
            double next = stretch.front().arcLength + spacing;
            for (const PathState &state : stretch)
            {
                const bool last = &state == &stretch.back();
                if (state.arcLength < next && !last)
                    continue;
                // Two bodies within half a spacing would look like one with a thick outline.
                if (!last && stretch.back().arcLength - state.arcLength < 0.5 * spacing)
                    continue;
                seen |= drawBody(state.pose, style);
                next = state.arcLength + spacing;
            }
            return seen;
        }

        /** Points of the car's own frame, placed at \e pose. */
        Polygon placed(const Pose &pose, const Polygon &local)
        {
            Polygon result;
            for (const Eigen::Vector2d &point : local)
                result.push_back(positionOf(compose(pose, {point.x(), point.y(), 0.0})));
            return result;
        }

        void drawSweptPath(SvgMap &map, const SampledPath &path, const std::string &what, const std::string &body,
                           const DrawBody &drawBody)
        {
            if (path.size() < 2)
                return;
            const double spacing = std::max({0.6, 22.0 / map.scale(), pathLength(path) / 60.0});
            const std::vector<SampledPath> stretches = stretchesOf(path);
            bool swept = false, turned = false;
            SvgStyle dot = filled("#ffffff", "#0f172a");
            dot.strokeWidth = 1.4;
            for (const SampledPath &stretch : stretches)
            {
                const int direction = stretch.back().direction;
                swept |= drawSweep(stretch, spacing, drawBody);
                std::vector<Eigen::Vector2d> track;
                for (const PathState &state : stretch)
                    track.push_back(positionOf(state.pose));
                const SvgStyle style = stroked(colourOf(direction), 2.4);
                if (map.drawLine(SvgLayer::Lines, track, style))
                    map.addLegend({what + (direction < 0 ? ", reverse" : ", forward"), style, SvgSample::Line});
                if (&stretch != &stretches.back())
                    turned |= map.drawDot(SvgLayer::Marks, track.back(), 3.4, dot);
            }
            if (turned)
                map.addLegend({"change of direction", dot, SvgSample::Dot});
            if (swept)
                map.addLegend({body + " along the " + what, sweepStyle(stretches.front().back().direction)});
        }

        /** The windscreen and the rear window of a rectangular car, with their places along it. */
        void drawWindows(SvgMap &map, const Pose &pose, double half, double wind, double back, double length,
                         const SvgStyle &glass)
        {
            map.drawPolygon(SvgLayer::Cars,
                            placed(pose, {{wind, -0.80 * half},
                                          {wind, 0.80 * half},
                                          {wind - 0.11 * length, 0.66 * half},
                                          {wind - 0.11 * length, -0.66 * half}}),
                            glass);
            map.drawPolygon(SvgLayer::Cars,
                            placed(pose, {{back, -0.70 * half},
                                          {back, 0.70 * half},
                                          {back + 0.07 * length, 0.62 * half},
                                          {back + 0.07 * length, -0.62 * half}}),
                            glass);
        }
    }  // namespace

    Box viewAround(const Scenario &scenario, const SampledPath &path, double margin)
    {
        std::vector<Pose> poses = scenario.goals;
        poses.push_back(scenario.start);
        for (const PathState &state : path)
            poses.push_back(state.pose);
        Box view{positionOf(scenario.start), positionOf(scenario.start)};
        for (const Pose &pose : poses)
            for (const Eigen::Vector2d &corner : scenario.vehicle.footprint(pose))
                view.include(corner);
        if (scenario.slot)
            for (const Eigen::Vector2d &corner : scenario.slot->outline())
                view.include(corner);
        const Eigen::Vector2d border(margin, margin);
        return {view.min - border, view.max + border};
    }

    void drawScenario(SvgMap &map, const Scenario &scenario)
    {
        map.setWorldOffset(scenario.worldOffset);
        drawOutside(map, scenario);
        drawUnknown(map, scenario);  // before the slot, which may cover unknown cells
        bool seen = drawCar(map, scenario.start, scenario.vehicle, svg_colour::START, "start");
        for (std::size_t i = 0; i < scenario.goals.size(); ++i)
        {
            // Other goals are the same place with the opposite heading, and overlapping cars would be illegible.
            const SvgStyle other = filled("#ffffff", svg_colour::GOAL);
            if (i == 0)
                seen |= drawCar(map, scenario.goals[i], scenario.vehicle, svg_colour::GOAL, "goal");
            else if (map.drawDot(SvgLayer::Cars, positionOf(scenario.goals[i]), 3.0, other))
                map.addLegend({"other goal", other, SvgSample::Dot});
        }
        if (seen)
            map.addLegend({"pose (middle of the rear axle)", filled(svg_colour::START), SvgSample::Dot});
        if (scenario.slot)
        {
            SvgStyle style = filled(svg_colour::GOAL, svg_colour::GOAL);
            style.fillOpacity = 0.07;
            style.strokeWidth = 1.4;
            style.dash = "6 4";
            if (map.drawPolygon(SvgLayer::Ground, scenario.slot->outline(), style))
                map.addLegend({"slot", style});
        }
        drawObstacles(map, scenario);
    }

    void drawPath(SvgMap &map, const SampledPath &path, const Vehicle &vehicle, const std::string &what)
    {
        drawSweptPath(map, path, what, "car",
                      [&](const Pose &pose, const SvgStyle &style)
                      { return map.drawPolygon(SvgLayer::Sweep, vehicle.footprint(pose), style); });
    }

    void drawDiscPath(SvgMap &map, const SampledPath &path, double radius)
    {
        drawSweptPath(map, path, "path", "disc",
                      [&](const Pose &pose, const SvgStyle &style)
                      { return map.drawDot(SvgLayer::Sweep, positionOf(pose), radius * map.scale(), style); });
    }

    bool drawCar(SvgMap &map, const Pose &pose, const Vehicle &vehicle, const std::string &colour,
                 const std::string &label)
    {
        SvgStyle body = filled(colour, colour);
        body.fillOpacity = 0.22;
        body.strokeWidth = 1.6;
        const SvgLayer layer = SvgLayer::Cars;
        const bool seen = map.drawPolygon(layer, vehicle.footprint(pose), body);

        // Wheels and windows distinguish front and rear.
        const double half = 0.5 * vehicle.width, rear = -vehicle.rearOverhang;
        const double length = vehicle.length();
        const SvgStyle dark = filled(colour);
        const double wheelHalf = std::min(0.31, 0.4 * std::max(0.1, vehicle.rearOverhang));
        const bool isRectangle = vehicle.outline.empty();
        const double wheelWidth = isRectangle ? 0.2 : std::min(0.2, 0.3 * half);
        const double trackHalf = isRectangle ? half - 0.04 : 0.8 * half;
        for (const double axle : {0.0, vehicle.wheelbase})
            for (const double side : {-1.0, 1.0})
            {
                const double outer = side * trackHalf, inner = side * (trackHalf - wheelWidth);
                map.drawPolygon(layer,
                                placed(pose, {{axle - wheelHalf, outer},
                                              {axle + wheelHalf, outer},
                                              {axle + wheelHalf, inner},
                                              {axle - wheelHalf, inner}}),
                                dark);
            }
        SvgStyle glass = filled(colour);
        glass.fillOpacity = 0.55;
        const double wind = rear + 0.70 * length, back = rear + 0.13 * length;
        if (!isRectangle)
            // An arrow from the fixed to the steered axle: windows need not fit into an outline.
            map.drawPolygon(layer,
                            placed(pose, {{0.5 * vehicle.wheelbase, -0.3 * half},
                                          {0.8 * vehicle.wheelbase, 0.0},
                                          {0.5 * vehicle.wheelbase, 0.3 * half}}),
                            glass);
        else
            drawWindows(map, pose, half, wind, back, length, glass);
        map.drawDot(layer, positionOf(pose), 2.6, filled(colour));
        if (seen)
            map.addLegend({label, body});
        return seen;
    }

    void drawTrack(SvgMap &map, const std::vector<Pose> &poses, const std::string &colour, const std::string &label,
                   const std::string &dash)
    {
        std::vector<Eigen::Vector2d> track;
        for (const Pose &pose : poses)
            track.push_back(positionOf(pose));
        const SvgStyle style = stroked(colour, 1.6, dash);
        if (map.drawLine(SvgLayer::Lines, track, style))
            map.addLegend({label, style, SvgSample::Line});
    }

    SvgPlot curvaturePlot(const SampledPath &path, const Vehicle &vehicle)
    {
        SvgPlot plot;
        plot.title = "Curvature along the path";
        plot.xLabel = "driven length (m)";
        plot.yLabel = "curvature (1/m)";
        const double limit = 1.0 / vehicle.minTurningRadius();
        plot.limits = {-limit, limit};
        plot.limitsLabel = "limit of the car";
        for (const SampledPath &stretch : stretchesOf(path))
        {
            if (stretch.back().direction < 0)
                plot.bands.push_back({stretch.front().arcLength, stretch.back().arcLength, svg_colour::REVERSE, {}});
            // One curve per stretch, because the steering may jump where the car stands.
            SvgSeries series;
            series.label = stretch.back().direction < 0 ? "reverse" : "forward";
            series.colour = colourOf(stretch.back().direction);
            for (std::size_t i = 1; i < stretch.size(); ++i)
            {
                // The curvature is constant between states, as in the path.
                series.x.insert(series.x.end(), {stretch[i - 1].arcLength, stretch[i].arcLength});
                series.y.insert(series.y.end(), {stretch[i].curvature, stretch[i].curvature});
            }
            plot.series.push_back(std::move(series));
        }
        return plot;
    }
}  // namespace parking
