// The heuristic that knows curves but no obstacles, and the cost model.

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/heuristics/CurveHeuristic.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    Path randomDrive(Random &random, double radius, bool forwardOnly)
    {
        Path path{random.poseIn(-5.0, 5.0), {}};
        const std::uint32_t count = 1 + random.index(6);
        for (std::uint32_t i = 0; i < count; ++i)
        {
            const double length = random.between(0.1, 2.5) * radius;
            path.append({random.between(-1.0, 1.0) / radius, !forwardOnly && random.chance(0.5) ? -length : length});
        }
        return path;
    }

    /** The heuristic with targets that are added one by one. */
    class CurvesTo
    {
    public:
        explicit CurvesTo(const ReedsShepp &curves)
        {
            parameters_.turningRadius = curves.turningRadius();
            parameters_.forwardOnly = curves.family() == CurveFamily::Dubins;
        }

        void reset(bool backwards)
        {
            side_ = backwards ? Side::Goal : Side::Start;
            targets_.clear();
        }

        void addTarget(const Pose &target)
        {
            targets_.push_back(target);
            heuristic_.begin({world_, parameters_, side_, roots_, targets_, stop_});
        }

        double estimate(const Pose &pose)
        {
            return heuristic_.estimate(pose);
        }
        double lowerBound(const Pose &pose)
        {
            return heuristic_.lowerBound(pose);
        }

    private:
        parking_test::DiscCarWorld world_{{{-1.0, -1.0}, {1.0, 1.0}}};
        SearchParameters parameters_;
        Side side_{Side::Start};
        std::vector<Pose> roots_, targets_;
        StopFunction stop_;
        CurveHeuristic heuristic_;
    };
}  // namespace

TEST(CurveHeuristic, exactIsTheShortestCurveToTheNearestTarget)
{
    for (const CurveFamily family : {CurveFamily::ReedsShepp, CurveFamily::Dubins})
        for (const bool backwards : {false, true})
        {
            const ReedsShepp curves(2.5, family);
            CurvesTo heuristic(curves);
            heuristic.reset(backwards);
            Random random(5);
            std::vector<Pose> targets;
            for (int i = 0; i < 4; ++i)
            {
                targets.push_back(random.poseIn(-10.0, 10.0));
                heuristic.addTarget(targets.back());
                for (int j = 0; j < 200; ++j)
                {
                    const Pose pose = random.poseIn(-15.0, 15.0);
                    double shortest = std::numeric_limits<double>::infinity();
                    for (const Pose &target : targets)
                        shortest = std::min(shortest,
                                            backwards ? curves.distance(target, pose) : curves.distance(pose, target));
                    ASSERT_DOUBLE_EQ(heuristic.lowerBound(pose), shortest);
                }
            }
        }
}

TEST(CurveHeuristic, exactIsNeverAboveTheLengthOfADrivablePath)
{
    for (const CurveFamily family : {CurveFamily::ReedsShepp, CurveFamily::Dubins})
        for (const double radius : {0.2, 3.7, 10.0})
        {
            const ReedsShepp curves(radius, family);
            Random random(6);
            for (int i = 0; i < 5000; ++i)
            {
                const Path path = randomDrive(random, radius, family == CurveFamily::Dubins);
                CurvesTo forwards(curves);
                if (i % 100 == 0)
                {
                    forwards.reset(false);
                    forwards.addTarget(path.end());
                    ASSERT_LE(forwards.lowerBound(path.start), path.length() + 1e-6 * radius);
                    forwards.reset(true);
                    forwards.addTarget(path.start);
                    ASSERT_LE(forwards.lowerBound(path.end()), path.length() + 1e-6 * radius);
                }
                ASSERT_LE(curves.distance(path.start, path.end()), path.length() + 1e-6 * radius);
            }
        }
}

TEST(CurveHeuristic, approximateIsCloseToExactAtEveryScale)
{
    for (const double radius : {0.2, 4.0, 10.0})
    {
        const ReedsShepp curves(radius);
        CurvesTo heuristic(curves);
        heuristic.reset(false);
        heuristic.addTarget({3.0 * radius, -2.0 * radius, 0.7});
        Random random(7);
        double worst = 0.0, sum = 0.0;
        constexpr int COUNT = 20000;
        for (int i = 0; i < COUNT; ++i)
        {
            Pose pose = random.poseIn(-8.0, 8.0);
            pose.x *= radius;
            pose.y *= radius;
            const double error = std::abs(heuristic.estimate(pose) - heuristic.lowerBound(pose)) / radius;
            worst = std::max(worst, error);
            sum += error;
        }
        EXPECT_LT(worst, 0.8);
        EXPECT_LT(sum / COUNT, 0.06);
        EXPECT_GT(sum / COUNT, 0.0);
    }
}

/** Also right between two cells, and where the next number would belong to the other one. */
TEST(CurveHeuristic, approximateIsThatOfTheNearestCell)
{
    const ReedsShepp curves(1.0);
    CurvesTo heuristic(curves);
    heuristic.reset(false);
    heuristic.addTarget({0.0, 0.0, 0.0});
    Random random(9);
    const auto about = [&random](double value, double cell)
    {
        if (random.chance(0.5))
            return value;
        const double border = (std::floor(value / cell) + 0.5) * cell;
        return random.chance(0.3) ? border : std::nextafter(border, random.chance(0.5) ? 0.0 : 2.0 * border);
    };
    for (int i = 0; i < 50000; ++i)
    {
        const bool near = i % 2 == 0;
        const double side = near ? CurveTableCells::NEAR_SIDE : CurveTableCells::FAR_SIDE;
        const int headings = near ? CurveTableCells::NEAR_HEADINGS : CurveTableCells::FAR_HEADINGS;
        const double extent = near ? 1.4 : 9.0;
        Pose pose = random.poseIn(-extent, extent);
        if (!near && std::max(std::abs(pose.x), std::abs(pose.y)) < 1.7)
            continue;
        pose = {about(pose.x, side), about(pose.y, side), wrapAngle(about(pose.yaw, 2.0 * PI / headings))};
        const long heading = std::lround(pose.yaw / (2.0 * PI) * headings);
        const Pose centre{std::round(pose.x / side) * side, std::round(pose.y / side) * side,
                          static_cast<double>((heading + headings) % headings) * 2.0 * PI / headings};
        ASSERT_EQ(heuristic.estimate(pose), static_cast<float>(curves.distance(centre, {})))
            << pose.x << " " << pose.y << " " << pose.yaw;
    }
}

TEST(CurveHeuristic, approximateGivesTheSameAnswerHoweverOftenAndInWhateverOrder)
{
    const ReedsShepp curves(3.0);
    CurvesTo a(curves), b(curves);
    for (CurvesTo *each : {&a, &b})
    {
        each->reset(false);
        each->addTarget({1.0, 2.0, 3.0});
    }
    Random random(8);
    std::vector<Pose> poses;
    for (int i = 0; i < 40000; ++i)
        poses.push_back(random.poseIn(-100.0, 100.0));
    std::vector<double> first, second(poses.size());
    for (const Pose &pose : poses)
        first.push_back(a.estimate(pose));
    for (std::size_t i = poses.size(); i-- > 0;)
        second[i] = b.estimate(poses[i]);
    EXPECT_EQ(first, second);
}

TEST(CurveHeuristic, threadsThatFillTheTableTogetherGetTheSameValues)
{
    // More cells than the table holds, so that threads overwrite each other's.
    constexpr int COUNT = 60000, THREADS = 4;
    const ReedsShepp curves(2.0);
    std::vector<std::vector<double>> values(THREADS);
    std::vector<std::thread> threads;
    for (std::vector<double> &mine : values)
        threads.emplace_back(
            [&curves, &mine]
            {
                CurvesTo heuristic(curves);
                heuristic.reset(true);
                heuristic.addTarget({1.0, 2.0, 3.0});
                Random random(10);
                for (int i = 0; i < COUNT; ++i)
                    mine.push_back(heuristic.estimate(random.poseIn(-40.0, 40.0)));
            });
    for (std::thread &thread : threads)
        thread.join();
    for (const std::vector<double> &each : values)
        ASSERT_EQ(each, values.front());
    // And cells are told apart: what a slot held for another does not come out.
    CurvesTo heuristic(curves);
    heuristic.reset(true);
    heuristic.addTarget({1.0, 2.0, 3.0});
    Random random(10);
    for (int i = 0; i < COUNT; ++i)
    {
        const Pose pose = random.poseIn(-40.0, 40.0);
        ASSERT_LT(std::abs(values.front()[static_cast<std::size_t>(i)] - heuristic.lowerBound(pose)),
                  0.8 * curves.turningRadius());
    }
}

TEST(CurveHeuristic, lengthsFarBeyondTheTableAreStillLengths)
{
    const ReedsShepp curves(1.0);
    CurvesTo heuristic(curves);
    heuristic.reset(false);
    heuristic.addTarget({0.0, 0.0, 0.0});
    for (const double x : {300.0, 327.0, 328.0, 5000.0, 1e6, -1e6})
        EXPECT_NEAR(heuristic.estimate({x, 0.5 * x, 1.0}), heuristic.lowerBound({x, 0.5 * x, 1.0}), 1.0);
}

TEST(CurveHeuristic, forgetsValuesWithTheTargets)
{
    const ReedsShepp curves(3.0);
    CurvesTo heuristic(curves);
    heuristic.reset(false);
    heuristic.addTarget({0.0, 0.0, 0.0});
    EXPECT_NEAR(heuristic.estimate({10.0, 0.0, 0.0}), 10.0, 0.5);
    heuristic.addTarget({20.0, 0.0, 0.0});
    EXPECT_NEAR(heuristic.estimate({18.0, 0.0, 0.0}), 2.0, 0.5);
    heuristic.reset(false);
    heuristic.addTarget({10.0, 0.0, 0.0});
    EXPECT_NEAR(heuristic.estimate({10.0, 0.0, 0.0}), 0.0, 0.5);
    EXPECT_NEAR(heuristic.estimate({18.0, 0.0, 0.0}), 8.0, 0.5) << "the other target is forgotten";
}

/** All objects share one table: at the centres of its cells it has to give what the curves give, whatever other
    curves, radii, directions and targets have been asked for before. */
TEST(CurveHeuristic, tabulatedLengthsAreThoseOfTheirOwnCurves)
{
    Random random(9);
    int wrong = 0, count = 0;
    for (int round = 0; round < 60; ++round)
    {
        const CurveFamily family = random.chance(0.5) ? CurveFamily::Dubins : CurveFamily::ReedsShepp;
        const double radius = random.chance(0.5) ? 3.0 : 4.5;
        const ReedsShepp curves(radius, family);
        CurvesTo heuristic(curves);
        heuristic.reset(random.chance(0.5));
        const Pose target{random.between(-20.0, 20.0), random.between(-20.0, 20.0), 0.0};
        heuristic.addTarget(target);
        for (int i = 0; i < 500; ++i)
        {
            const bool near = random.chance(0.5);
            const double cell = near ? 0.04 : 0.16;
            const int headings = near ? 180 : 60;
            // Few cells, so that different curves come to ask for the same ones.
            const double column = static_cast<double>(random.index(8)) - 4.0 + (near ? 0.0 : 12.0);
            const double row = static_cast<double>(random.index(8)) - 4.0;
            const double heading = static_cast<double>(random.index(12)) * (headings / 12);
            const Pose pose{target.x + column * cell * radius, target.y + row * cell * radius,
                            parking::wrapAngle(heading * 2.0 * PI / headings)};
            ++count;
            // A turn of a whole circle and none are the same place: rounding decides, seldom.
            wrong += std::abs(heuristic.estimate(pose) - heuristic.lowerBound(pose)) > 1e-4 * radius;
        }
    }
    EXPECT_LE(wrong, count / 20) << "of " << count;
}

TEST(CostModel, pricesLengthGearSteeringAndCloseness)
{
    DiscCarWorld world({{-10.0, -10.0}, {10.0, 10.0}});
    CostModel model;
    model.fullLockCurvature = 0.25;
    EXPECT_DOUBLE_EQ(model.drive({0.1, 3.0}), 3.0);
    EXPECT_DOUBLE_EQ(model.drive({0.1, -3.0}), 3.0);
    EXPECT_DOUBLE_EQ(model.join({0.25, 1.0}, {-0.25, -1.0}), 0.0);
    model.reversePenalty = 0.5;
    EXPECT_DOUBLE_EQ(model.drive({0.1, 3.0}), 3.0);
    EXPECT_DOUBLE_EQ(model.drive({0.1, -3.0}), 4.5);
    model.gearChangePenalty = 2.0;
    EXPECT_DOUBLE_EQ(model.join({0.25, 1.0}, {-0.25, -1.0}), 2.0);
    EXPECT_DOUBLE_EQ(model.join({0.25, -1.0}, {-0.25, -1.0}), 0.0);
    model.steeringChangePenalty = 0.1;
    EXPECT_DOUBLE_EQ(model.join({0.25, -1.0}, {-0.25, -1.0}), 0.2);
    EXPECT_DOUBLE_EQ(model.join({0.0, 1.0}, {0.25, -1.0}), 2.1);
    const Path path{{}, {{0.25, 1.0}, {0.0, -2.0}, {0.0, 1.0}}};
    EXPECT_DOUBLE_EQ(pathCost(model, path, world), 1.0 + 2.1 + 3.0 + 2.0 + 1.0);

    model = {};
    model.clearanceWeight = 3.0;
    model.clearanceRange = 1.0;
    EXPECT_EQ(model.closeness({0.0, 0.0, 0.0}, {0.0, 2.0}, world), 0.0) << "more than the range away";
    // Along the wall, 0.25 m from it: three quarters of the weight on every metre.
    EXPECT_NEAR(model.closeness({0.0, 10.0 - 0.95 - 0.25, 0.0}, {0.0, 2.0}, world), 0.75 * 3.0 * 2.0, 1e-9);
}

TEST(CostModel, pricesWhatIsNearerThanPreferred)
{
    DiscCarWorld world({{-10.0, -10.0}, {10.0, 10.0}});
    CostModel model;
    model.preferredClearance = 0.3;
    EXPECT_FALSE(model.pricesCloseness());
    model.clearanceCost = 4.0;
    ASSERT_TRUE(model.pricesCloseness());
    const auto besideTheWall = [&](double clearance)
    {
        return model.closeness({0.0, 10.0 - 0.95 - clearance, 0.0}, {0.0, -2.0}, world);
    };
    EXPECT_EQ(besideTheWall(0.301), 0.0);
    EXPECT_NEAR(besideTheWall(0.299), 2.0 * 4.0, 1e-9);
    EXPECT_NEAR(besideTheWall(0.01), 2.0 * 4.0, 1e-9) << "near is near";
    // Towards the wall: the last 0.3 m of 1 m, up to a sample; the same backwards, and for what is known beforehand.
    const Pose from{10.0 - 0.95 - 2.6 - 1.0, 0.0, 0.0}, to = advance(from, 0.0, 1.0);
    EXPECT_NEAR(model.closeness(from, {0.0, 1.0}, world), 0.3 * 4.0, 0.25 * 4.0);
    EXPECT_NEAR(model.closeness(to, {0.0, -1.0}, world), model.closeness(from, {0.0, 1.0}, world), 1e-9);
    EXPECT_NEAR(model.closeness(from, {0.0, 1.0}, world, 0.69), 0.31 * 4.0, 0.25 * 4.0);
    EXPECT_EQ(model.closeness(from, {0.0, 0.69}, world, 0.69), 0.0);
    // What is known to come too near beyond a point does, whether a sample meets it or not.
    EXPECT_NEAR(model.closeness({0.0, 0.0, 0.0}, {0.0, 1.0}, world, 0.6), 0.2 * 4.0, 1e-9);
    // A metre of it is worth so many of detour, in whole paths as in their pieces.
    const Path path{from, {{0.0, 1.0}, {0.0, -1.0}}};
    EXPECT_NEAR(pathCost(model, path, world), 2.0 + pathCloseness(model, path, world), 1e-9);
    EXPECT_NEAR(pathCloseness(model, path, world), 2.0 * model.closeness(from, {0.0, 1.0}, world), 1e-9);
}

TEST(CostModel, curvesAndPathsCostTheSameAndNeverLessThanTheirLength)
{
    DiscCarWorld world = randomField(1);
    const ReedsShepp curves(4.0);
    Random random(9);
    std::vector<ReedsSheppCurve> candidates;
    for (int i = 0; i < 200; ++i)
    {
        CostModel model{random.between(0.0, 1.0),
                        random.between(0.0, 2.0),
                        random.between(0.0, 1.0),
                        i % 2 ? random.between(0.0, 2.0) : 0.0,
                        1.0,
                        0.25,
                        i % 3 ? random.between(0.0, 0.5) : 0.0,
                        random.between(0.0, 5.0)};
        const Pose from = random.poseIn(-8.0, 8.0), to = random.poseIn(-8.0, 8.0);
        curves.candidates(from, to, candidates);
        for (const ReedsSheppCurve &curve : candidates)
        {
            Path path{from, {}};
            path.pieces.assign(curve.pieces.begin(), curve.pieces.begin() + static_cast<long>(curve.count));
            const double closeness = curveCloseness(model, from, curve, world);
            ASSERT_GE(closeness, 0.0);
            ASSERT_NEAR(curveCost(model, curve) + closeness, pathCost(model, path, world), 1e-9);
            ASSERT_GE(curveCost(model, curve), curve.length - 1e-9);
        }
    }
}
