#include "benchmarks/worlds/Random.h"
#include "parking_geometry/drawing/Svg.h"

#include "parking_geometry/drawing/SvgText.h"
#include "tests/parking_geometry/ExpectError.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    std::size_t countOf(const std::string &text, const std::string &part)
    {
        std::size_t count = 0;
        for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
            ++count;
        return count;
    }

    Scenario slotScenario()
    {
        Scenario scenario;
        scenario.name = "example";
        scenario.vehicle = vehicleByName("vw_golf8");
        scenario.start = {0.0, 0.0, 0.0};
        scenario.slot = ParkingSlot{};
        scenario.slot->pose = {12.0, -5.0, 0.5 * PI};
        scenario.goals = scenario.slot->goals(scenario.vehicle);
        scenario.polygons = {{{8, -8}, {10, -8}, {10, -3}, {8, -3}}, {{900, 900}, {901, 900}, {901, 901}}};
        scenario.bounds = {{-20, -20}, {40, 30}};
        return scenario;
    }

    SampledPath zigzag()
    {
        Path arcs;
        arcs.start = {0.0, 0.0, 0.0};
        arcs.append({0.0, 6.0});
        arcs.append({0.2, 4.0});
        arcs.append({-0.2, -5.0});
        arcs.append({0.0, 1.0});
        return arcs.sample(0.05);
    }
}  // namespace

TEST(SvgText, PixelsAreShortAndPlain)
{
    EXPECT_EQ(px(0.0), "0");
    EXPECT_EQ(px(-0.001), "0");
    EXPECT_EQ(px(100.0), "100");
    EXPECT_EQ(px(12.345), "12.35");
    EXPECT_EQ(px(-1.5), "-1.5");
    EXPECT_EQ(px(std::numeric_limits<double>::quiet_NaN()), "0");
    EXPECT_LT(px(1e300).size(), 64u);
}

TEST(SvgText, EscapesMarkupAndBrokenText)
{
    EXPECT_EQ(escaped("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
    EXPECT_EQ(escaped("gr\xC3\xBC\xC3\x9F"), "gr\xC3\xBC\xC3\x9F");
    EXPECT_EQ(escaped("a\x01\xFF\xC3"), "a???");
}

TEST(SvgText, TicksAreRound)
{
    EXPECT_DOUBLE_EQ(roundStep(7.3), 5.0);
    EXPECT_DOUBLE_EQ(roundStep(5.0), 5.0);
    EXPECT_DOUBLE_EQ(roundStep(0.03), 0.02);
    EXPECT_DOUBLE_EQ(roundStep(1.99), 1.0);
    EXPECT_EQ(tickLabel(0.3, 0.1), "0.3");
    EXPECT_EQ(tickLabel(-0.0000001, 0.1), "0.0");
    EXPECT_EQ(tickLabel(20.0, 5.0), "20");
    EXPECT_EQ(roundTicks(-0.6, 1.0, 0.5), (std::vector<double>{-0.5, 0.0, 0.5, 1.0}));
    EXPECT_LT(roundTicks(1e300, 1e300, 1.0).size(), 3u);  // where adding 1 changes nothing
}

TEST(SvgMap, ShowsAtLeastWhatWasAskedAtEqualScaleWithYUp)
{
    for (const Box &asked : {Box{{0, 0}, {10, 10}}, Box{{0, 0}, {100, 1}}, Box{{0, 0}, {1, 100}}})
    {
        const SvgMap map(asked);
        EXPECT_LE((map.view().min - asked.min).maxCoeff(), 1e-9);
        EXPECT_GE((map.view().max - asked.max).minCoeff(), -1e-9);
        const Eigen::Vector2d size = map.view().size();
        EXPECT_NEAR(map.width() / size.x(), map.height() / size.y(), 1e-9);
        EXPECT_LE(map.height(), map.width() + 1e-9);
        EXPECT_GE(map.height(), 0.35 * map.width());
    }
    SvgMap map({{0, 0}, {10, 10}}, 100.0);
    map.drawDot(SvgLayer::Marks, {2.0, 1.0}, 3.0, SvgStyle());
    EXPECT_NE(map.toSvg(0, 0).find("cx=\"20\" cy=\"90\""), std::string::npos);
    map.drawDot(SvgLayer::Marks, {20.0, 1.0}, 3.0, SvgStyle());
    EXPECT_EQ(countOf(map.toSvg(0, 0), "<circle"), 1u);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expectError([] { SvgMap({{0, 0}, {0, 5}}); }, {"view"});
    expectError([] { SvgMap({{0, 0}, {-1, 5}}); }, {"view"});
    expectError([nan] { SvgMap({{0, 0}, {nan, 5}}); }, {"view"});
}

TEST(SvgFigure, DrawsAScenarioWithItsPath)
{
    const Scenario scenario = slotScenario();
    const SampledPath path = zigzag();
    SvgMap map(viewAround(scenario, path));
    drawScenario(map, scenario);
    drawPath(map, path, scenario.vehicle);
    drawTrack(map, {{0, 0, 0}, {5, 1, 0}}, svg_colour::DRIVEN, "driven");
    SvgFigure figure("A & B", "2 < 3");
    figure.setMap(map);
    figure.addPlot(curvaturePlot(path, scenario.vehicle));
    const std::string svg = figure.toString();
    for (const char *expected : {"A &amp; B", "2 &lt; 3", ">path, forward<", ">path, reverse<", ">start<", ">goal<",
                                 ">slot<", ">driven<", ">obstacle<", ">car along the path<", "curvature (1/m)",
                                 ">limit of the car<", svg_colour::FORWARD, svg_colour::REVERSE})
        EXPECT_NE(svg.find(expected), std::string::npos) << expected;
    EXPECT_EQ(countOf(svg, "<circle"), 2u + 2u + 2u);  // two changes of direction, two rear axles, and their names
    EXPECT_EQ(countOf(svg, ">path, forward<"), 1u);
    EXPECT_LT(svg.size(), 60000u);
    // The far obstacle is left out.
    Scenario without = scenario;
    without.polygons.pop_back();
    SvgMap same(viewAround(without, path)), other(viewAround(scenario, path));
    drawScenario(same, without);
    drawScenario(other, scenario);
    EXPECT_EQ(same.toSvg(0, 0), other.toSvg(0, 0));
}

TEST(SvgScenario, DrawsExactlyTheOccupiedCells)
{
    Random random(8);
    for (const double yaw : {0.0, 0.7, -2.5})
        for (const double share : {0.5, 0.1})
        {
            Scenario scenario;
            scenario.goals = {{5.0, 5.0, 0.0}};
            scenario.grid = OccupancyGrid(23, 17, 0.5, {3.0, -2.0, yaw});
            for (std::size_t row = 0; row < 17; ++row)
                for (std::size_t column = 0; column < 23; ++column)
                    if (random.chance(share))
                        scenario.grid->set(column, row, Cell::Occupied);
            SvgMap map({{-20.0, -20.0}, {20.0, 20.0}});
            drawScenario(map, scenario);
            // The outlines of the one path with the colour of obstacles, back in metres.
            const std::string svg = map.toSvg(0.0, 0.0);
            const std::size_t begin = svg.rfind("<path d=\"", svg.find(svg_colour::OBSTACLE)) + 9;
            const std::size_t end = svg.find('"', begin);
            std::vector<Polygon> outlines;
            Eigen::Vector2d at(0.0, 0.0);
            for (std::size_t i = begin; i < end;)
            {
                const char command = svg[i];
                const char *number = svg.c_str() + i + 1;
                char *next = nullptr;
                if (command == 'Z')
                {
                    ++i;
                    continue;
                }
                if (command == 'M')
                    outlines.emplace_back();
                if (command != 'V')
                    at.x() = std::strtod(number, &next);
                if (command != 'H')
                    at.y() = std::strtod(command == 'V' ? number : next, &next);
                outlines.back().push_back(map.view().min +
                                          Eigen::Vector2d(at.x(), map.height() - at.y()) / map.scale());
                i = static_cast<std::size_t>(next - svg.c_str());
            }
            for (std::size_t row = 0; row < 17; ++row)
                for (std::size_t column = 0; column < 23; ++column)
                {
                    const Pose middle = compose(scenario.grid->origin(), {0.5 * (static_cast<double>(column) + 0.5),
                                                                          0.5 * (static_cast<double>(row) + 0.5), 0.0});
                    const bool isDrawn = std::any_of(outlines.begin(), outlines.end(),
                                                     [&](const Polygon &outline) {
                                                         return contains(outline, {middle.x, middle.y});
                                                     });
                    ASSERT_EQ(isDrawn, scenario.grid->at(column, row) == Cell::Occupied) << column << ' ' << row;
                }
        }
}

TEST(SvgFigure, GridsStaySmall)
{
    Scenario scenario = slotScenario();
    scenario.polygons.clear();
    scenario.grid = OccupancyGrid(2000, 2000, 0.05, {-50.0, -50.0, 0.1}, Cell::Unknown);
    for (std::size_t row = 300; row < 1800; ++row)
        for (std::size_t column = 300; column < 1800; ++column)
            scenario.grid->set(column, row, column % 500 < 60 ? Cell::Occupied : Cell::Free);
    SvgMap map({{-50, -50}, {50, 50}});
    drawScenario(map, scenario);
    SvgFigure figure;
    figure.setMap(map);
    const std::string svg = figure.toString();
    EXPECT_LT(svg.size(), 20000u);
    EXPECT_NE(svg.find("unknown (not to be entered)"), std::string::npos);
}

TEST(SvgPlot, DrawsWhateverTheValues)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    const std::vector<std::vector<double>> values = {{},
                                                     {1.0},
                                                     {2.0, 2.0, 2.0},
                                                     {0.0, 1e-12},
                                                     {1e9, 1e9 + 1},
                                                     {nan, 1.0, nan},
                                                     {infinite, nan},
                                                     {-1e300, 1e300},
                                                     {1e-300, 2e-300}};
    for (const std::vector<double> &x : values)
        for (const std::vector<double> &y : values)
        {
            SvgPlot plot;
            plot.title = "t";
            const std::size_t count = std::min(x.size(), y.size());
            plot.series.push_back({"a",
                                   {x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count)},
                                   {y.begin(), y.begin() + static_cast<std::ptrdiff_t>(count)},
                                   "",
                                   false});
            const std::string svg = plot.toSvg(0, 0, 600);
            EXPECT_LT(svg.size(), 20000u);
            EXPECT_EQ(svg.find("nan"), std::string::npos);
        }
    SvgPlot plot;
    plot.title = "speed";
    plot.series.push_back({"v", {1, 2}, {1}, "", false});
    expectError([&plot] { plot.toSvg(0, 0, 600); }, {"'speed'", "'v'", "2", "1"});
}

TEST(SvgPlot, NamesWhatIsDrawnOnce)
{
    SvgPlot plot;
    plot.series = {{"a", {0, 1}, {0, 1}, "", false}, {"a", {1, 2}, {1, 0}, "", false}, {"", {0, 2}, {0, 0}, "", true}};
    plot.bands = {{0.0, 0.5, "#123456", "reverse"}, {1.0, 1.5, "#123456", "reverse"}};
    plot.limits = {-0.5, 0.5};
    plot.limitsLabel = "limit";
    const std::string svg = plot.toSvg(0, 0, 600);
    for (const char *label : {">a<", ">reverse<", ">limit<"})
        EXPECT_EQ(countOf(svg, label), 1u) << label;
    plot.yRange = {-0.4, 0.4};
    EXPECT_EQ(plot.toSvg(0, 0, 600).find(">limit<"), std::string::npos);
}

TEST(SvgPlot, BreaksTheLineWhereValuesAreMissing)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    SvgPlot plot;
    plot.series.push_back({"", {0, 1, 2, 3, 4}, {0, 1, nan, 1, 0}, "#123456", true});
    const std::string svg = plot.toSvg(0, 0, 600);
    const std::size_t at = svg.find("#123456");
    const std::size_t path = svg.rfind("<path d=\"", at);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(countOf(svg.substr(path, at - path), "M"), 2u);
    EXPECT_NE(svg.find("stroke-dasharray=\"6 4\""), std::string::npos);
}
