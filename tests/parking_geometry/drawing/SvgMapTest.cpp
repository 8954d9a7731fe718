#include "parking_geometry/drawing/SvgMap.h"

#include "parking_geometry/drawing/SvgText.h"

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    /** The ticks of one axis of a map: where they are drawn, what they say, and what the axis says is to be added. */
    struct Ticks
    {
        std::vector<double> at;
        std::vector<std::string> labels;
        double base{0.0};
    };

    Ticks ticksOf(const std::string &svg, bool isX)
    {
        Ticks ticks;
        const std::string beside = svg.substr(svg.find("</svg>"));
        const std::regex label("<text x=\"([^\"]*)\" y=\"([^\"]*)\" [^>]*text-anchor=\"" +
                               std::string(isX ? "middle" : "end") + "\">(-?[0-9.]+)</text>");
        for (std::sregex_iterator each(beside.begin(), beside.end(), label), end; each != end; ++each)
        {
            ticks.at.push_back(std::stod((*each)[isX ? 1 : 2]) - (isX ? 0.0 : 4.0));
            ticks.labels.push_back((*each)[3]);
        }
        std::smatch title;
        const std::regex base(isX ? ">x ([-+]) ([0-9]+) .m.<" : ">y ([-+]) ([0-9]+) .m.<");
        if (std::regex_search(beside, title, base))
            ticks.base = (title[1] == "-" ? 1.0 : -1.0) * std::stod(title[2]);
        return ticks;
    }
}  // namespace

TEST(SvgMap, TicksSayTheCoordinatesOfTheWorld)
{
    for (const double side : {0.5, 5.0, 43.0, 1000.0, 20000.0})
        for (const Eigen::Vector2d &offset :
             {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(691234.56, -5334567.8),
              Eigen::Vector2d(4508927528.64075, -5511483895.30342), Eigen::Vector2d(-0.37 * side, 99990.0)})
        {
            SvgMap map({{-0.3 * side, -0.1 * side}, {0.7 * side, 0.6 * side}});
            map.setWorldOffset(offset);
            const std::string svg = map.toSvg(100.0, 30.0);
            for (const bool isX : {true, false})
            {
                const Ticks ticks = ticksOf(svg, isX);
                ASSERT_GE(ticks.labels.size(), 2u) << side << ' ' << isX;
                // Six digits fit, ten do not.
                const double far = std::abs(offset[isX ? 0 : 1]);
                if (far == 0.0 || far > 1e6)
                {
                    EXPECT_EQ(ticks.base != 0.0, far > 1e6) << side << ' ' << isX;
                }
                for (std::size_t i = 0; i < ticks.labels.size(); ++i)
                {
                    const double place = isX ? ticks.at[i] - 100.0 : 30.0 + map.height() - ticks.at[i];
                    const double local = map.view().min[isX ? 0 : 1] + place / map.scale();
                    EXPECT_NEAR(ticks.base + std::stod(ticks.labels[i]), local + offset[isX ? 0 : 1],
                                0.02 / map.scale() + 1e-6)
                        << side << ' ' << ticks.labels[i];
                    EXPECT_LE(ticks.labels[i].size(), 6u);
                    const double room = i > 0 ? std::abs(ticks.at[i] - ticks.at[i - 1]) : map.width();
                    EXPECT_GT(room, textWidth(ticks.labels[i], 12.0) + 10.0);
                }
            }
        }
}

TEST(SvgMap, TellsWhatCanBeSeen)
{
    SvgMap map({{0, 0}, {10, 10}});
    SvgStyle style;
    style.fill = "#123456";
    const auto polygon = [&](const Polygon &corners)
    {
        return map.drawPolygon(SvgLayer::Ground, corners, style);
    };
    EXPECT_TRUE(polygon({{2, 2}, {3, 2}, {3, 3}}));
    EXPECT_TRUE(polygon({{3, 3}, {3, 2}, {2, 2}}));
    EXPECT_TRUE(polygon({{-90, -90}, {90, -90}, {90, 90}, {-90, 90}}));
    EXPECT_FALSE(polygon({{12, 2}, {13, 2}, {13, 3}}));
    // Boxes round them have all of the view in them; one lies beyond a corner of it, one goes round it.
    EXPECT_FALSE(polygon({{-1, 22}, {22, -1}, {22, 22}}));
    EXPECT_FALSE(polygon({{-2, -2}, {12, -2}, {12, 12}, {11, 12}, {11, -1}, {-1, -1}, {-1, 12}, {-2, 12}}));
    const Polygon view{{-1, -1}, {11, -1}, {11, 11}, {-1, 11}}, hole(view.rbegin(), view.rend());
    EXPECT_TRUE(map.drawOutlines(SvgLayer::Ground, {view}, style));
    EXPECT_FALSE(map.drawOutlines(SvgLayer::Ground, {view, hole}, style));
    EXPECT_FALSE(map.drawOutlines(SvgLayer::Ground, {}, style));
    EXPECT_TRUE(map.drawLine(SvgLayer::Lines, {{5, 5}, {50, 5}}, style));
    EXPECT_FALSE(map.drawLine(SvgLayer::Lines, {{40, 5}, {50, 5}}, style));
    EXPECT_TRUE(map.drawDot(SvgLayer::Marks, {5, 5}, 3.0, style));
    EXPECT_FALSE(map.drawDot(SvgLayer::Marks, {15, 5}, 3.0, style));
}
