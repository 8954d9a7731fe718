#include "automatic_parking/drawing/DriveAnimation.h"

#include "automatic_parking/drawing/DriveFigure.h"
#include "parking_geometry/Error.h"
#include "tests/automatic_parking/ParkingProblems.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;

    Trajectory someDrive()
    {
        Trajectory drive;
        for (int i = 0; i < 50; ++i)
            drive.push_back({0.1 * i, 0.2 * i, 0.0, 0.0, 2.0, 0.0, 0.01 * i, 0.1});
        drive.back().v = -0.5;
        return drive;
    }

    Path somePath()
    {
        return {{0.0, 0.0, 0.0}, {{0.0, 10.0}, {0.1, -3.0}}};
    }

    std::size_t count(const std::string &text, const std::string &what)
    {
        std::size_t found = 0;
        for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
            ++found;
        return found;
    }

    TEST(DriveAnimationTest, holdsAllThatItNeeds)
    {
        const std::string page = driveAnimation(openGround(), somePath(), someDrive(), "A drive", {"in words", {}, {}});
        EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0u);
        EXPECT_EQ(count(page, "A drive"), 2u);
        EXPECT_EQ(count(page, "in words"), 1u);
        for (const char *part : {"id=\"play\"", "type=\"range\"", "id=\"car\"", "planned, forwards", "planned, reverse",
                                 "\"wheelbase\":2.8", "x (m)", "</html>"})
            EXPECT_NE(page.find(part), std::string::npos) << part;
        // Every mark was replaced.
        for (const char *mark : {"@TITLE@", "@SUBTITLE@", "@DATA@", "@MAP@", "@METRES@", "@VIEW@", "@LEGEND@",
                                 "@DRIVEN@", "@PLOTS@", "@DARK@", "@FRAME@", "@LATEST@"})
            EXPECT_EQ(page.find(mark), std::string::npos) << mark;
        // Nothing is fetched: the only address is the name of SVG's namespace.
        EXPECT_EQ(count(page, "://"), count(page, "http://www.w3.org/2000/svg"));
        for (const char *reference : {"src=", "href=", "@import", "url(", "fetch("})
            EXPECT_EQ(page.find(reference), std::string::npos) << reference;
    }

    TEST(DriveAnimationTest, showsWhatWasPlannedBesideWhatWasDriven)
    {
        const std::string alone = driveAnimation(openGround(), somePath(), someDrive(), "t");
        EXPECT_EQ(count(alone, ">planned trajectory<"), 0u);
        EXPECT_EQ(count(alone, ">driven<"), 4u) << "on the map and in three plots";
        EXPECT_EQ(count(alone, ">reverse<"), 3u);
        const std::string page = driveAnimation(openGround(), somePath(), someDrive(), "t", {{}, someDrive(), {}});
        EXPECT_EQ(count(page, ">planned trajectory<"), 1u);
        EXPECT_EQ(count(page, ">planned<"), 3u);
        // The plan is faded below the trajectory: on the map per stretch, and in the legend per direction.
        EXPECT_EQ(count(page, "stroke-opacity=\"0.25\""), 4u);
        EXPECT_EQ(count(alone, "stroke-opacity=\"0.25\""), 0u);
        expectError(
            [&] {
                driveAnimation(openGround(), {}, someDrive(), "t", {{}, {someDrive().front()}, {}});
            },
            {"1 points"});
    }

    TEST(DriveAnimationTest, holdsWhatWasSeenAndPlannedOnTheWay)
    {
        DriveHistory history;
        history.map = OccupancyGrid(10, 5, 0.5, {-1.0, -2.0, 0.0}, Cell::Unknown);
        history.map.set(3, 0, Cell::Free);
        history.frames = {{0.0, {{1, 1, Cell::Free}, {2, 1, Cell::Free}, {3, 1, Cell::Occupied}}},
                          {0.5, {{9, 4, Cell::Occupied}}}};
        history.plans = {{0.0, somePath()}, {0.5, {{1.0, 0.0, 0.0}, {{0.0, 0.2}}}}};
        const std::string page = driveAnimation(openGround(), somePath(), someDrive(), "t", {"", {}, history});
        for (const char *part : {"[-1,[3,1,0]]", "[0,[11,2,0,13,1,1]]", "[0.5,[49,1,1]]", "[0.5,[1,0,1.1,0,1.2,0]]",
                                 "not seen yet", "seen obstacle", "latest plan"})
            EXPECT_NE(page.find(part), std::string::npos) << part;
        EXPECT_EQ(page.find("planned, reverse"), std::string::npos) << "only the latest plan is shown";
        const std::string known = driveAnimation(openGround(), somePath(), someDrive(), "t");
        EXPECT_NE(known.find("\"seen\":null"), std::string::npos);
        EXPECT_EQ(known.find("not seen yet"), std::string::npos);
    }

    TEST(DriveAnimationTest, writesEveryPointShortly)
    {
        Trajectory drive = someDrive();
        drive[1].x = 0.123456789;
        drive[2].yaw = -1e-9;
        const std::string page = driveAnimation(openGround(), {}, drive, "t");
        const std::size_t begin = page.find("\"x\":[") + 5;
        const std::string x = page.substr(begin, page.find(']', begin) - begin);
        EXPECT_EQ(std::count(x.begin(), x.end(), ','), 49);
        EXPECT_EQ(x.rfind("0,0.1235,0.4,0.6,", 0), 0u) << x;
        EXPECT_EQ(page.find("-0,"), std::string::npos);
        const std::size_t data = page.find("id=\"data\"");
        EXPECT_EQ(page.substr(data, page.find("</script>", data) - data).find("e-"), std::string::npos);
    }

    TEST(DriveAnimationTest, textsCannotBecomeMarkup)
    {
        const std::string page = driveAnimation(openGround(), {}, someDrive(), "</title><script>alert(1)</script>",
                                                {"@DATA@ & <b>", {}, {}});
        EXPECT_EQ(count(page, "<script"), 2u);
        EXPECT_EQ(page.find("<b></p>"), std::string::npos);
        EXPECT_NE(page.find("@DATA@ &amp; &lt;b&gt;"), std::string::npos);
    }

    TEST(DriveAnimationTest, refusesNonsense)
    {
        const Scenario scenario = openGround();
        expectError([&] { driveAnimation(scenario, {}, {}, "t"); }, {"0 points"});
        expectError([&] { driveAnimation(scenario, {}, {someDrive().front()}, "t"); }, {"1 points"});
        Trajectory drive = someDrive();
        drive[7].yaw = std::nan("");
        expectError([&] { driveAnimation(scenario, {}, drive, "t"); }, {"point 7", "finite"});
        drive = someDrive();
        drive[9].t = 0.0;
        expectError([&] { driveAnimation(scenario, {}, drive, "t"); }, {"point 9", "earlier"});
    }

    TEST(DriveFigureTest, showsPathDriveAndPlots)
    {
        const std::string figure = driveFigure(openGround(), somePath(), someDrive(), "A drive", "below").toString();
        for (const char *part : {"A drive", "below", "driven", "Speed", "Acceleration", "Steering angle", "degrees"})
            EXPECT_NE(figure.find(part), std::string::npos) << part;
        const std::string plain = driveFigure(openGround(), somePath(), {}, "A plan").toString();
        EXPECT_EQ(plain.find("Steering angle"), std::string::npos);
    }

    /** Along y from x 0 to 10, standing first. */
    Trajectory driveAlong(double y, double direction = 1.0)
    {
        Trajectory drive(2, {-1.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, 0.0});
        for (int i = 0; i <= 50; ++i)
            drive.push_back({0.1 * i, direction * 0.2 * i, y, 0.0, direction * 2.0, 0.0, 0.0, 0.0});
        drive.push_back({5.1, direction * 10.0, y, 0.0, 0.0, 0.0, 0.0, 0.0});
        return drive;
    }

    std::set<std::string> waysInLegend(const SvgMap &map)
    {
        std::set<std::string> labels;
        for (const SvgLegendEntry &entry : map.legend())
            if (entry.sample == SvgSample::Line || entry.label.find("along") != std::string::npos ||
                entry.label == "change of direction")
                labels.insert(entry.label);
        return labels;
    }

    /** The y of all middles of the cars drawn along a way. */
    std::set<double> sweptAlong(const SvgMap &map)
    {
        const std::string svg = map.toSvg(0.0, 0.0);
        std::set<double> found;
        const std::regex car("points=\"([^\"]*)\"[^>]*stroke-opacity=\"0.4\"");
        for (std::sregex_iterator each(svg.begin(), svg.end(), car), end; each != end; ++each)
        {
            std::istringstream corners((*each)[1]);
            double sum = 0.0;
            for (std::string corner; corners >> corner;)
                sum += std::stod(corner.substr(corner.find(',') + 1));
            found.insert(std::round(10.0 * (map.view().max.y() - 0.25 * sum / map.scale())) / 10.0);
        }
        return found;
    }

    TEST(DriveFigureTest, drawsTheCarAlongWhatIsKnownBestOfItsWay)
    {
        using Labels = std::set<std::string>;
        const Scenario scenario = openGround();
        const SampledPath path = Path{{}, {{0.0, 10.0}}}.sample(0.1);
        const Trajectory planned = driveAlong(2.0), driven = driveAlong(-12.0);

        SvgMap map = driveMap(scenario, path, {}, {});
        EXPECT_EQ(sweptAlong(map), (std::set<double>{0.0}));
        EXPECT_EQ(waysInLegend(map), (Labels{"path, forward", "car along the path"}));

        map = driveMap(scenario, path, planned, {});
        EXPECT_EQ(sweptAlong(map), (std::set<double>{2.0}));
        EXPECT_EQ(waysInLegend(map), (Labels{"planned path", "trajectory, forward", "car along the trajectory"}));

        map = driveMap(scenario, path, planned, driven);
        EXPECT_EQ(sweptAlong(map), (std::set<double>{-12.0}));
        EXPECT_EQ(waysInLegend(map),
                  (Labels{"planned path", "planned trajectory", "drive, forward", "car along the drive"}));
        for (const double y : {0.0, 2.0, -12.0})
            EXPECT_TRUE(map.view().contains(5.0, y));

        // Standing is no direction of its own.
        map = driveMap(scenario, {}, {}, driveAlong(0.0, -1.0));
        EXPECT_EQ(waysInLegend(map), (Labels{"drive, reverse", "car along the drive"}));
        Trajectory both = driveAlong(1.0);
        for (const TrajectoryPoint &point : driveAlong(1.0, -1.0))
            both.push_back({point.t + 10.0, point.x + 10.0, 1.0, 0.0, point.v, 0.0, 0.0, 0.0});
        EXPECT_EQ(waysInLegend(driveMap(scenario, path, both, {})),
                  (Labels{"planned path", "trajectory, forward", "trajectory, reverse", "change of direction",
                          "car along the trajectory"}));

        EXPECT_EQ(waysInLegend(driveMap(scenario, {}, {planned.front()}, {})), Labels());
        EXPECT_EQ(sweptAlong(driveMap(scenario, {}, {}, {})), std::set<double>());
    }

    TEST(DriveFigureTest, plotsWhatTheCarDid)
    {
        const std::vector<SvgPlot> plots = drivePlots(someDrive(), Vehicle());
        ASSERT_EQ(plots.size(), 3u);
        EXPECT_DOUBLE_EQ(plots[2].series[0].y[10], 0.1 * 180.0 / PI);
        EXPECT_DOUBLE_EQ(plots[0].series[0].x[10], 1.0);
        EXPECT_DOUBLE_EQ(plots[1].limits[1], Vehicle().maxAcceleration);
        ASSERT_EQ(plots[0].bands.size(), 1u);
        EXPECT_DOUBLE_EQ(plots[0].bands[0].begin, 4.9);
    }
}  // namespace
