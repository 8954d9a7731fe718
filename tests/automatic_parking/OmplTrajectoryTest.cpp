#include "automatic_parking/ompl/OmplTrajectory.h"

#include "parking_geometry/Error.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "state_validity/FootprintChecker.h"
#include "tests/path_tracking/TestPaths.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <gtest/gtest.h>

#include <ompl/control/spaces/RealVectorControlSpace.h>
#include <cmath>
#include <limits>

namespace
{
    namespace ob = ompl::base;
    namespace og = ompl::geometric;
    using namespace parking;

    const Box WIDE{{-60.0, -60.0}, {60.0, 60.0}};

    template <class Space>
    std::shared_ptr<ob::SpaceInformation> informationOf(const std::shared_ptr<Space> &space)
    {
        ob::RealVectorBounds bounds(2);
        bounds.setLow(-60.0);
        bounds.setHigh(60.0);
        space->setBounds(bounds);
        auto si = std::make_shared<ob::SpaceInformation>(space);
        si->setStateValidityChecker([](const ob::State *) { return true; });
        si->setup();
        return si;
    }

    og::PathGeometric pathOver(const ob::SpaceInformationPtr &si, const std::vector<Pose> &poses)
    {
        og::PathGeometric path(si);
        for (const Pose &pose : poses)
        {
            ob::ScopedState<ob::SE2StateSpace> state(si);
            state->setXY(pose.x, pose.y);
            state->setYaw(pose.yaw);
            path.append(state.get());
        }
        return path;
    }

    std::vector<Pose> randomPoses(std::uint64_t seed)
    {
        parking::test::Random random(seed);
        std::vector<Pose> poses;
        for (int i = 0; i < 4; ++i)
            poses.push_back({random.between(-10.0, 10.0), random.between(-10.0, 10.0), random.between(-3.0, 3.0)});
        return poses;
    }

    TEST(OmplTrajectory, PathsPassTheStatesAndHaveTheLengthOfTheSpace)
    {
        const double radius = Vehicle().minTurningRadius();
        const auto reedsShepp = informationOf(std::make_shared<ob::ReedsSheppStateSpace>(radius));
        const auto dubins = informationOf(std::make_shared<ob::DubinsStateSpace>(radius));
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            for (const auto &si : {reedsShepp, dubins})
            {
                const std::vector<Pose> poses = randomPoses(seed);
                const og::PathGeometric geometric = pathOver(si, poses);
                const Path path = pathOf(geometric);
                EXPECT_TRUE(isSamePose(path.start, poses.front(), 1e-9));
                EXPECT_TRUE(isSamePose(path.end(), poses.back(), 1e-5)) << seed;
                EXPECT_NEAR(path.length(), geometric.length(), 1e-5) << seed;
            }
    }

    TEST(OmplTrajectory, ControlsLeadFromStateToStateAndTakeTheMotionsTime)
    {
        const Vehicle car;
        const FootprintChecker checker(ObstacleSet::fromPolygons({}, WIDE), car);
        const auto reedsShepp = informationOf(std::make_shared<ob::ReedsSheppStateSpace>(car.minTurningRadius()));
        const auto si = carInformation(car, WIDE);
        for (std::uint64_t seed = 1; seed <= 5; ++seed)
        {
            const std::vector<Pose> poses = randomPoses(seed);
            const TimedMotion motion =
                TrajectoryOptimizer(checker).optimize(pathOf(pathOver(reedsShepp, poses))).motion;
            const auto path = controlPath(motion, car, si);
            ASSERT_EQ(path->getStateCount(), motion.knots.size());
            EXPECT_NEAR(path->length(), motion.duration(), 1e-9);
            ob::State *reached = si->allocState();
            for (std::size_t i = 0; i < path->getControlCount(); ++i)
            {
                si->getStatePropagator()->propagate(path->getState(static_cast<unsigned int>(i)), path->getControl(i),
                                                    path->getControlDuration(i), reached);
                EXPECT_LT(si->distance(reached, path->getState(static_cast<unsigned int>(i) + 1)), 1e-5) << i;
                EXPECT_TRUE(si->satisfiesBounds(path->getState(static_cast<unsigned int>(i))));
                const auto *rates = path->getControl(i)->as<ompl::control::RealVectorControlSpace::ControlType>();
                EXPECT_LE(std::abs(rates->values[0]), car.maxAcceleration + 1e-9);
                EXPECT_LE(std::abs(rates->values[1]), car.maxSteeringRate + 1e-9);
            }
            const auto *last = path->getStates().back()->as<ob::CompoundState>()->as<ob::SE2StateSpace::StateType>(0);
            EXPECT_TRUE(isSamePose({last->getX(), last->getY(), last->getYaw()}, poses.back(), 5e-3)) << seed;
            si->freeState(reached);
        }
    }

    TEST(OmplTrajectory, RefusesWhatNoCarDrives)
    {
        const auto plain = informationOf(std::make_shared<ob::SE2StateSpace>());
        const auto curves = informationOf(std::make_shared<ob::ReedsSheppStateSpace>(4.0));
        EXPECT_THROW(pathOf(pathOver(plain, randomPoses(1))), Error);
        EXPECT_THROW(pathOf(pathOver(curves, {})), Error);
        EXPECT_THROW(pathOf(pathOver(curves, {{1.0, 1.0, 0.0}})), Error);
        EXPECT_THROW(pathOf(pathOver(curves, {{}, {std::nan(""), 1.0, 0.0}})), Error);
        EXPECT_THROW(controlPath({}, Vehicle(), carInformation(Vehicle(), WIDE)), Error);
        Vehicle car;
        car.maxAcceleration = 0.0;
        EXPECT_THROW(carInformation(car, WIDE), Error);
    }
}  // namespace
