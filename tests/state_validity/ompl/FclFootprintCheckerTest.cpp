#include "state_validity/ompl/FclFootprintChecker.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/ompl/OmplPose.h"

#include <limits>
#include <memory>

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/util/Exception.h>

#include <gtest/gtest.h>

namespace ob = ompl::base;
using namespace parking;
using namespace parking_test;

namespace
{
    ob::SpaceInformationPtr spaceOf(const std::shared_ptr<ob::SE2StateSpace> &space, const Box &box)
    {
        space->setBounds(positionBounds(box));
        return std::make_shared<ob::SpaceInformation>(space);
    }

    std::string messageOf(const std::function<void()> &action)
    {
        try
        {
            action();
        }
        catch (const ompl::Exception &error)
        {
            return error.what();
        }
        return "no exception";
    }

    const Box BOX{{-20.0, -20.0}, {20.0, 20.0}};
}  // namespace

TEST(FclFootprintChecker, AnswersAsTheOracleWithinTheBoundsInEverySpace)
{
    for (const auto &space : {std::make_shared<ob::SE2StateSpace>(),
                              std::static_pointer_cast<ob::SE2StateSpace>(std::make_shared<ob::ReedsSheppStateSpace>()),
                              std::static_pointer_cast<ob::SE2StateSpace>(std::make_shared<ob::DubinsStateSpace>())})
    {
        const World world = randomPolygonWorld(3);
        // Bounds within the world: what lies between is free of obstacles in part, yet not valid.
        const Box half{{-15.0, -15.0}, {4.0, 15.0}};
        const ob::SpaceInformationPtr si = spaceOf(space, half);
        const Vehicle vehicle;
        const auto checker = std::make_shared<FclFootprintChecker>(si, world.obstacles, vehicle);
        si->setStateValidityChecker(checker);
        si->setup();
        ob::ScopedState<> state(si);
        Random random(3);
        std::uint64_t inBounds = 0, valid = 0;
        for (int i = 0; i < 5000; ++i)
        {
            const Pose pose = world.anywhere(random);
            setPose(state.get(), pose);
            const bool within = pose.x <= 4.0;
            const bool expected = within && world.oracle.isFree(pose, vehicle);
            inBounds += within;
            valid += expected;
            ASSERT_EQ(si->isValid(state.get()), expected);
            const double clearance = checker->clearance(state.get());
            ASSERT_LE(clearance, expected ? world.oracle.clearance(pose, vehicle) + 1e-12 : 0.0);
            double distance = -1.0;
            ASSERT_EQ(checker->isValid(state.get(), distance), expected);
            ASSERT_EQ(distance, clearance);
            bool available = true;
            ASSERT_EQ(checker->clearance(state.get(), nullptr, available), clearance);
            ASSERT_FALSE(available);
        }
        EXPECT_GT(valid, 500u);
        const CheckCounts counts = checker->counts();
        EXPECT_EQ(counts.states, 2 * inBounds);
        EXPECT_EQ(counts.states, counts.byField + counts.byCircles + counts.byEdges + counts.byContactTest);
        checker->resetCounts();
        EXPECT_EQ(checker->counts().states, 0u);
    }
}

TEST(FclFootprintChecker, TellsWhatItCanDo)
{
    const FclFootprintChecker checker(spaceOf(std::make_shared<ob::SE2StateSpace>(), BOX),
                                      ObstacleSet::fromPolygons({}, BOX), {});
    EXPECT_EQ(checker.getSpecs().clearanceComputationType, ob::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE);
    EXPECT_FALSE(checker.getSpecs().hasValidDirectionComputation);
}

TEST(FclFootprintChecker, TakesAScenario)
{
    Scenario scenario;
    scenario.bounds = BOX;
    scenario.polygons = {rectangle(2.0, 2.0, {5.0, 0.0, 0.0})};
    const ob::SpaceInformationPtr si = spaceOf(std::make_shared<ob::ReedsSheppStateSpace>(), BOX);
    const FclFootprintChecker polygons(si, scenario);
    ob::ScopedState<> state(si);
    setPose(state.get(), {-3.0, 0.0, 0.0});
    EXPECT_TRUE(polygons.isValid(state.get()));
    EXPECT_FALSE(FclFootprintChecker(si, scenario, 3.3).isValid(state.get()));
    setPose(state.get(), {1.0, 0.0, 0.0});
    EXPECT_FALSE(polygons.isValid(state.get()));

    scenario.grid = OccupancyGrid(400, 400, 0.1, {-20.0, -20.0, 0.0});
    EXPECT_TRUE(FclFootprintChecker(si, scenario).isValid(state.get())) << "the grid takes the polygons' place";
    scenario.grid->set(220, 200, Cell::Unknown);
    EXPECT_FALSE(FclFootprintChecker(si, scenario).isValid(state.get()));
    scenario.unknownIsOccupied = false;
    EXPECT_TRUE(FclFootprintChecker(si, scenario).isValid(state.get()));
}

TEST(FclFootprintChecker, BadValuesAreExceptionsOfOmplThatNameThem)
{
    const ob::SpaceInformationPtr si = spaceOf(std::make_shared<ob::SE2StateSpace>(), BOX);
    const auto expect = [](const std::function<void()> &action, const std::string &part)
    {
        const std::string message = messageOf(action);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    const ObstacleSet empty = ObstacleSet::fromPolygons({}, BOX);
    expect([&] { FclFootprintChecker(si, nullptr); }, "null");
    expect([&] { FclFootprintChecker(si, empty, {}, -0.5); }, "-0.5");
    expect([&] { FclFootprintChecker(si, empty, {}, std::numeric_limits<double>::quiet_NaN()); }, "margin");
    expect([&] { FclFootprintChecker(si, empty, {}, 100.0); }, "does not fit");
    Vehicle vehicle;
    vehicle.wheelbase = -1.0;
    expect([&] { FclFootprintChecker(si, empty, vehicle); }, "wheelbase");
    Scenario scenario;
    expect([&] { FclFootprintChecker(si, scenario); }, "bounds");
    scenario.grid = OccupancyGrid();
    expect([&] { FclFootprintChecker(si, scenario); }, "no cells");
    const auto line = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::RealVectorStateSpace>(3));
    expect([&] { FclFootprintChecker(line, empty, {}); }, "SE2");
}
