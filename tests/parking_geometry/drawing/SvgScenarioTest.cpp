#include "parking_geometry/drawing/SvgScenario.h"

#include "parking_geometry/drawing/SvgText.h"

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    using Labels = std::set<std::string>;

    Labels labelsOf(const SvgMap &map)
    {
        Labels labels;
        for (const SvgLegendEntry &entry : map.legend())
            labels.insert(entry.label);
        return labels;
    }

    Labels with(Labels labels, const std::string &another)
    {
        labels.insert(another);
        return labels;
    }

    /** A goal ahead on open ground that reaches beyond the view. */
    Scenario openGround()
    {
        Scenario scenario;
        scenario.goals = {{12.0, 0.0, 0.0}};
        scenario.bounds = {{-50, -50}, {50, 50}};
        return scenario;
    }

    Labels legendOf(const Scenario &scenario)
    {
        SvgMap map(viewAround(scenario));
        drawScenario(map, scenario);
        return labelsOf(map);
    }

    Labels legendAlong(const Path &path)
    {
        const SampledPath states = path.sample(0.1);
        SvgMap map(viewAround(openGround(), states));
        drawPath(map, states, Vehicle(), "way");
        return labelsOf(map);
    }

    const Labels CARS{"start", "goal", "pose (middle of the rear axle)"};
}  // namespace

TEST(SvgScenario, LegendsNameWhatIsSeenOfAScenario)
{
    EXPECT_EQ(legendOf(openGround()), CARS);

    Scenario scenario = openGround();
    scenario.goals.push_back({11.0, 0.0, PI});
    EXPECT_EQ(legendOf(scenario), with(CARS, "other goal"));

    scenario = openGround();
    scenario.slot = ParkingSlot{};
    scenario.slot->pose = scenario.goals.front();
    EXPECT_EQ(legendOf(scenario), with(CARS, "slot"));

    scenario = openGround();
    scenario.polygons = {{{40, 40}, {41, 40}, {41, 41}}};
    EXPECT_EQ(legendOf(scenario), CARS);
    // A wall past the corner of the view; only the box round it reaches into the view.
    scenario.polygons = {{{-10, 40}, {50, -20}, {50, -19}, {-9, 40}}};
    EXPECT_EQ(legendOf(scenario), CARS);
    scenario.polygons.push_back({{5, 3}, {6, 3}, {6, 4}});
    EXPECT_EQ(legendOf(scenario), with(CARS, "obstacle"));

    // The world ends within the view on one side only.
    scenario = openGround();
    scenario.bounds.min.y() = -2.0;
    EXPECT_EQ(legendOf(scenario), with(CARS, "outside of the map"));
}

TEST(SvgScenario, LegendsNameWhatIsSeenOfAMap)
{
    Scenario scenario = openGround();
    scenario.grid = OccupancyGrid(200, 200, 0.5, {-50.0, -50.0, 0.0}, Cell::Free);
    EXPECT_EQ(legendOf(scenario), CARS);
    scenario.grid->set(0, 0, Cell::Occupied);
    scenario.grid->set(1, 0, Cell::Unknown);
    EXPECT_EQ(legendOf(scenario), CARS);
    scenario.grid->set(105, 107, Cell::Occupied);
    EXPECT_EQ(legendOf(scenario), with(CARS, "obstacle"));
    scenario.grid->set(110, 107, Cell::Unknown);
    EXPECT_EQ(legendOf(scenario), with(with(CARS, "obstacle"), "unknown (not to be entered)"));
    scenario.unknownIsOccupied = false;
    EXPECT_EQ(legendOf(scenario), with(with(CARS, "obstacle"), "unknown (taken as free)"));
    // A map that lies askew and ends within the view.
    scenario.grid = OccupancyGrid(200, 200, 0.5, {10.0, -60.0, 0.2}, Cell::Free);
    EXPECT_EQ(legendOf(scenario), with(CARS, "outside of the map"));
}

TEST(SvgScenario, GroundsDifferInLightnessAlone)
{
    // CIE L*: white is 100, and what differs by 7 is told apart side by side, whatever colours the eye sees.
    const auto lightness = [](const std::string &colour)
    {
        double luminance = 0.0;
        for (const auto &[place, share] : {std::pair{1, 0.2126}, {3, 0.7152}, {5, 0.0722}})
        {
            const double value = std::stoi(colour.substr(static_cast<std::size_t>(place), 2), nullptr, 16) / 255.0;
            luminance += share * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
        }
        return 116.0 * std::cbrt(luminance) - 16.0;
    };
    const std::vector<std::string> grounds{"#fbfcfd", svg_colour::OUTSIDE, svg_colour::UNKNOWN, svg_colour::OBSTACLE};
    EXPECT_NE(SvgMap({{0, 0}, {1, 1}}).toSvg(0, 0).find("fill=\"" + grounds.front() + '"'), std::string::npos)
        << "free";
    for (std::size_t i = 0; i < grounds.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GT(std::abs(lightness(grounds[i]) - lightness(grounds[k])), 7.0) << grounds[i] << ' ' << grounds[k];
}

TEST(SvgScenario, ADiscMovesAlongAPathLikeACar)
{
    const SampledPath states = Path{{0.0, 0.0, 0.0}, {{0.0, 10.0}, {0.1, -3.0}}}.sample(0.1);
    SvgMap map(viewAround(openGround(), states)), shapes(map.view());
    drawDiscPath(map, states, 0.9);
    EXPECT_EQ(labelsOf(map), (Labels{"path, forward", "path, reverse", "change of direction", "disc along the path"}));
    const std::string text = map.shapes(), radius = " r=\"" + px(0.9 * map.scale()) + "\"";
    EXPECT_NE(text.find(radius), std::string::npos);
    EXPECT_EQ(text.find("<polygon"), std::string::npos);
    EXPECT_EQ(shapes.shapes(), "");
}

TEST(SvgText, TheDarkThemeReplacesEveryColour)
{
    const std::string rules = darkTheme();
    for (const std::string colour :
         {svg_colour::FORWARD, svg_colour::REVERSE, svg_colour::START, svg_colour::GOAL, svg_colour::OBSTACLE,
          svg_colour::OBSTACLE_EDGE, svg_colour::OUTSIDE, svg_colour::UNKNOWN, svg_colour::DRIVEN, svg_colour::PLANNED})
        for (const char *attribute : {"fill", "stroke"})
        {
            const std::string selector = std::string("[") + attribute + "=\"" + colour + "\"]{";
            EXPECT_NE(rules.find(selector), std::string::npos) << selector;
            EXPECT_EQ(rules.find(selector + attribute + ":" + colour), std::string::npos) << selector;
        }
}

TEST(SvgScenario, LegendsNameWhatIsSeenOfAPath)
{
    const Path forward{{}, {{0.0, 10.0}}}, reverse{{}, {{0.0, -10.0}}}, both{{}, {{0.0, 5.0}, {0.1, -5.0}}};
    EXPECT_EQ(legendAlong(forward), (Labels{"way, forward", "car along the way"}));
    EXPECT_EQ(legendAlong(reverse), (Labels{"way, reverse", "car along the way"}));
    EXPECT_EQ(legendAlong(both), (Labels{"way, forward", "way, reverse", "change of direction", "car along the way"}));
}
