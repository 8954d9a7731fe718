#include "parking_geometry/io/ScenarioReader.h"

#include "parking_geometry/Polygon.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    // An oracle of its own: slow and plain, sharing nothing with the code that it judges.
    double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
        return a.x() * b.y() - a.y() * b.x();
    }

    double distanceToSegment(const Eigen::Vector2d &p, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
        const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        return (p - a - along * (b - a)).norm();
    }

    bool segmentsCross(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c,
                       const Eigen::Vector2d &d)
    {
        return (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) &&
               (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
    }

    /** Distance between two simple polygons, 0 when they overlap. */
    double distanceBetween(const Polygon &a, const Polygon &b)
    {
        if (contains(a, b[0]) || contains(b, a[0]))
            return 0.0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t j = 0; j < b.size(); ++j)
            {
                const Eigen::Vector2d &p = a[i], &q = a[(i + 1) % a.size()], &r = b[j], &s = b[(j + 1) % b.size()];
                if (segmentsCross(p, q, r, s))
                    return 0.0;
                least = std::min({least, distanceToSegment(p, r, s), distanceToSegment(q, r, s),
                                  distanceToSegment(r, p, q), distanceToSegment(s, p, q)});
            }
        return least;
    }

    std::vector<Polygon> obstaclesOf(const Scenario &scenario)
    {
        std::vector<Polygon> obstacles = scenario.polygons;
        if (scenario.grid)
        {
            const OccupancyGrid &grid = *scenario.grid;
            for (std::size_t row = 0; row < grid.height(); ++row)
                for (std::size_t column = 0; column < grid.width(); ++column)
                    if (grid.at(column, row) != Cell::Free)
                    {
                        Polygon cell;
                        for (const auto &[i, j] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
                        {
                            const Pose corner =
                                compose(grid.origin(), {(static_cast<double>(column) + i) * grid.resolution(),
                                                        (static_cast<double>(row) + j) * grid.resolution(), 0.0});
                            cell.emplace_back(corner.x, corner.y);
                        }
                        obstacles.push_back(cell);
                    }
        }
        return obstacles;
    }

    double clearance(const Scenario &scenario, const Pose &pose)
    {
        const std::array<Eigen::Vector2d, 4> corners = scenario.vehicle.footprint(pose);
        const Polygon body(corners.begin(), corners.end());
        double least = std::numeric_limits<double>::infinity();
        for (const Polygon &obstacle : obstaclesOf(scenario))
            least = std::min(least, distanceBetween(body, obstacle));
        for (const Eigen::Vector2d &corner : body)
            least =
                std::min({least, (corner - scenario.bounds.min).minCoeff(), (scenario.bounds.max - corner).minCoeff()});
        return least;
    }

    struct Bundled
    {
        const char *name;
        double goalClearance;  ///< metres, as the file's comment promises where it does
    };

    // What narrow means is exact; the others depend on how their neighbours and walls happen to stand.
    const Bundled BUNDLED[] = {
        {"angled45", 0.85},
        {"dead_end_aisle", 0.3},
        {"multi_storey", 0.145},
        {"narrow_parallel", 0.25},
        {"narrow_perpendicular", 0.15},
        {"parallel", 0.22},
        {"perceived_street", 0.2},
        {"perpendicular", 0.35},
        {"tight_parallel", 0.17},
        {"underground_garage", 0.145},
    };

    Scenario read(const std::string &name)
    {
        return readScenario(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios/" + name + ".yaml");
    }

    class BundledScenario : public testing::TestWithParam<Bundled>
    {
    };
}  // namespace

TEST_P(BundledScenario, StartAndGoalsAreFree)
{
    const Scenario scenario = read(GetParam().name);
    const double start = clearance(scenario, scenario.start);
    EXPECT_GT(start, 0.3);
    RecordProperty("start_clearance_mm", static_cast<int>(1000.0 * start));
    for (const Pose &goal : scenario.goals)
    {
        const double free = clearance(scenario, goal);
        RecordProperty("goal_clearance_mm", static_cast<int>(1000.0 * free));
        EXPECT_GT(free, GetParam().goalClearance - 0.002);
    }
}

TEST_P(BundledScenario, UsesARealCarAndIsOfSensibleSize)
{
    const Scenario scenario = read(GetParam().name);
    EXPECT_EQ(scenario.name, GetParam().name);
    EXPECT_NE(scenario.vehicle.name, "tpcap");
    const Eigen::Vector2d size = scenario.bounds.size();
    EXPECT_LE(size.maxCoeff(), 100.0);
    EXPECT_GE(size.minCoeff(), 15.0);
    EXPECT_GT(obstaclesOf(scenario).size(), 5u);
}

INSTANTIATE_TEST_SUITE_P(All, BundledScenario, testing::ValuesIn(BUNDLED),
                         [](const testing::TestParamInfo<Bundled> &test) { return std::string(test.param.name); });

TEST(BundledScenarios, NarrowOnesAreAsNarrowAsTheySay)
{
    for (const auto &[name, ends] : {std::pair{"narrow_parallel", 0.25}, {"tight_parallel", 0.17}})
    {
        const Scenario scenario = read(name);
        EXPECT_NEAR(scenario.slot->length, scenario.vehicle.length() + 2.0 * ends, 1e-4);
        EXPECT_NEAR(clearance(scenario, scenario.goals[0]), ends, 0.002);
        // One step further forwards or backwards and the bumpers touch.
        for (const double shift : {ends + 0.002, -ends - 0.002})
            EXPECT_EQ(clearance(scenario, compose(scenario.goals[0], {shift, 0.0, 0.0})), 0.0);
    }
    const Scenario scenario = read("narrow_perpendicular");
    EXPECT_NEAR(scenario.slot->width, scenario.vehicle.width + 0.3, 1e-4);
    EXPECT_NEAR(clearance(scenario, scenario.goals[0]), 0.15, 0.002);
    for (const double shift : {0.152, -0.152})
        EXPECT_EQ(clearance(scenario, compose(scenario.goals[0], {0.0, shift, 0.0})), 0.0);
}

TEST(BundledScenarios, TheUnreachableGoalIsInsideAnObstacle)
{
    const Scenario scenario = read("unreachable");
    EXPECT_GT(clearance(scenario, scenario.start), 0.3);
    EXPECT_EQ(clearance(scenario, scenario.goals[0]), 0.0);
}

TEST(BundledScenarios, GridsAreOfTheSizesOfThePaper)
{
    const Scenario garage = read("underground_garage"), street = read("perceived_street");
    ASSERT_TRUE(garage.grid && street.grid);
    EXPECT_EQ(garage.grid->width(), 200u);
    EXPECT_EQ(garage.grid->height(), 200u);
    EXPECT_DOUBLE_EQ(garage.grid->resolution(), 0.2);
    EXPECT_DOUBLE_EQ(street.grid->resolution(), 0.5);
    const std::vector<Cell> &cells = street.grid->cells();
    EXPECT_GT(std::count(cells.begin(), cells.end(), Cell::Unknown), 10000);
    EXPECT_GT(std::count(cells.begin(), cells.end(), Cell::Occupied), 300);
    EXPECT_GT(std::count(cells.begin(), cells.end(), Cell::Free), 1000);
}

TEST(BundledScenarios, AllOfThemAreListedHere)
{
    std::set<std::string> listed = {"unreachable"}, present;
    for (const Bundled &bundled : BUNDLED)
        listed.insert(bundled.name);
    for (const auto &entry :
         std::filesystem::directory_iterator(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios"))
    {
        const std::string stem = entry.path().stem().string();
        if (entry.path().extension() == ".yaml" && stem.find("_map") == std::string::npos)
            present.insert(stem);
    }
    EXPECT_EQ(present, listed);
}
