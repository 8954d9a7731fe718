#include "state_validity/ompl/CircleValidityChecker.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/ompl/OmplPose.h"
#include "tests/state_validity/DistanceByDefinition.h"

#include <cmath>
#include <limits>
#include <memory>

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/util/Exception.h>

#include <gtest/gtest.h>

namespace ob = ompl::base;
using namespace parking;
using namespace parking_test;

namespace
{
    ob::SpaceInformationPtr spaceOf(const Box &box)
    {
        const auto space = std::make_shared<ob::SE2StateSpace>();
        space->setBounds(positionBounds(box));
        return std::make_shared<ob::SpaceInformation>(space);
    }

    /** From a point to the nearest obstacle; 0 inside of one. */
    double distanceByDefinition(const ObstacleSet &obstacles, double x, double y)
    {
        const Pose local = obstacles.toLocal({x, y, 0.0});
        return std::max(0.0, signedDistance(obstacles, {local.x, local.y}));
    }

    const Box BOX{{-20.0, -20.0}, {20.0, 20.0}};
}  // namespace

TEST(CircleValidityChecker, IsTheDistanceToTheNearestObstacle)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        const World world = seed % 2 ? randomGridWorld(seed) : randomPolygonWorld(seed);
        // A radius as small as a millimetre, too: less than a cell of the field.
        for (const double radius : {0.001, 0.04, 0.8, 2.5})
        {
            const ob::SpaceInformationPtr si = spaceOf(world.bounds);
            const CircleValidityChecker checker(si, world.obstacles, radius);
            ob::ScopedState<> state(si);
            Random random(seed);
            for (int i = 0; i < 600; ++i)
            {
                Pose pose = world.anywhere(random);
                if (i % 3 == 0)  // about a radius away from an outline
                {
                    const Edge &edge = world.edges[random.index(world.edges.size())];
                    const Eigen::Vector2d at = edge.from + random.between(0.0, 1.0) * (edge.to - edge.from);
                    const double angle = random.between(-PI, PI), off = radius * random.between(0.95, 1.05);
                    pose.x = at.x() + off * std::cos(angle);
                    pose.y = at.y() + off * std::sin(angle);
                }
                const double distance = distanceByDefinition(world.obstacles, pose.x, pose.y);
                if (std::abs(distance - radius) < 1e-9)
                    continue;
                setPose(state.get(), pose);
                const bool within = si->satisfiesBounds(state.get());
                ASSERT_EQ(checker.circle().isFree(pose.x, pose.y), distance > radius) << world.name << " " << radius;
                ASSERT_EQ(checker.isValid(state.get()), within && distance > radius);
                const double clearance = checker.clearance(state.get()), expected = std::max(0.0, distance - radius);
                ASSERT_LE(clearance, expected + 1e-9);
                if (within)
                {
                    ASSERT_GE(clearance, std::min(expected, 1.0) - 1e-9) << world.name << " " << radius;
                }
            }
        }
    }
}

TEST(CircleMotionValidator, ProvesMotionsFreeAndNamesTheLastValidState)
{
    const World world = randomPolygonWorld(6);
    const ob::SpaceInformationPtr si = spaceOf(world.bounds);
    const auto checker = std::make_shared<CircleValidityChecker>(si, world.obstacles, 0.8);
    si->setStateValidityChecker(checker);
    const CircleMotionValidator validator(si, checker);
    ob::ScopedState<> from(si), to(si), last(si), between(si);
    Random random(6);
    int accepted = 0, rejected = 0;
    for (int i = 0; i < 3000; ++i)
    {
        setPose(from.get(), world.anywhere(random));
        setPose(to.get(), world.anywhere(random));
        if (!checker->isValid(from.get()))
            continue;
        std::pair<ob::State *, double> lastValid(last.get(), 1.0);
        const bool free = validator.checkMotion(from.get(), to.get(), lastValid);
        ASSERT_EQ(free, validator.checkMotion(from.get(), to.get()));
        ASSERT_TRUE(free || checker->isValid(last.get()));
        (free ? accepted : rejected) += 1;
        const double share = free ? 1.0 : lastValid.second;
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= 200; ++k)
        {
            si->getStateSpace()->interpolate(from.get(), to.get(), k / 200.0, between.get());
            const bool valid = checker->isValid(between.get());
            ASSERT_TRUE(valid || k / 200.0 > share);
            least = std::min(least, checker->clearance(between.get()));
        }
        // Between two samples the clearance falls by no more than half of the way between them.
        const double step = positionDistance(poseOf(from.get()), poseOf(to.get())) / 200.0;
        ASSERT_TRUE(free || least < 0.5 * step + 2e-3);
    }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(rejected, 100);
}

TEST(CircleValidityChecker, RefusesBadInput)
{
    const ObstacleSet empty = ObstacleSet::fromPolygons({}, BOX);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double radius : {0.0, -1.0, nan, infinity})
        EXPECT_THROW(CircleValidityChecker(spaceOf(BOX), empty, radius), ompl::Exception) << radius;
    const auto line = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::RealVectorStateSpace>(2));
    EXPECT_THROW(CircleValidityChecker(line, empty, 1.0), ompl::Exception);

    // Nothing fits: plainly invalid. Positions that are no numbers, too.
    const CircleValidityChecker large(spaceOf(BOX), empty, 25.0);
    EXPECT_FALSE(large.circle().isFree(0.0, 0.0));
    const CircleValidityChecker checker(spaceOf(BOX), empty, 1.0);
    EXPECT_TRUE(checker.circle().isFree(0.0, 0.0));
    EXPECT_TRUE(checker.circle().isFree(18.999, 0.0));
    EXPECT_FALSE(checker.circle().isFree(19.001, 0.0));
    for (const double bad : {nan, infinity, -infinity, 30.0})
    {
        EXPECT_FALSE(checker.circle().isFree(bad, 0.0)) << bad;
        EXPECT_FALSE(checker.circle().isFree(0.0, bad)) << bad;
    }
}
