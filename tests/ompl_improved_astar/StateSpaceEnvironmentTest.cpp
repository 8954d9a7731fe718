// The world as any checker knows it: asked no longer than there is time.

#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "ompl_improved_astar/search/CostModel.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

using namespace parking;
using namespace parking::search;

namespace
{
    /** Ten metres to every side. */
    ompl::base::StateSpacePtr reedsSheppSpace()
    {
        auto space = std::make_shared<ompl::base::ReedsSheppStateSpace>(3.0);
        ompl::base::RealVectorBounds bounds(2);
        bounds.setLow(-10.0);
        bounds.setHigh(10.0);
        space->setBounds(bounds);
        return space;
    }

    /** Everything is free and half a metre from the next obstacle; counts how often that is asked. */
    class HalfAMetre : public ompl::base::StateValidityChecker
    {
    public:
        explicit HalfAMetre(const ompl::base::SpaceInformationPtr &si) : StateValidityChecker(si)
        {
            specs_.clearanceComputationType = ompl::base::StateValidityCheckerSpecs::EXACT;
        }
        bool isValid(const ompl::base::State *) const override
        {
            return true;
        }
        double clearance(const ompl::base::State *) const override
        {
            ++asked;
            return 0.5;
        }
        mutable int asked{0};
    };
}  // namespace

/** A checker that takes its time must not be asked on and on when the time is up. */
TEST(StateSpaceEnvironment, posesOfMotionsAreAskedForUntilTheTimeIsUpAndHardlyLonger)
{
    const auto si = std::make_shared<ompl::base::SpaceInformation>(reedsSheppSpace());
    int asked = 0;
    si->setStateValidityChecker([&asked](const ompl::base::State *) { return ++asked > 0; });
    si->setup();
    StateSpaceEnvironment environment(si, 0.1, {}, false);
    for (int i = 0; i < 100; ++i)
        ASSERT_TRUE(environment.isPassable({0.0, 0.0, 0.0}));
    EXPECT_EQ(asked, 100);
    EXPECT_FALSE(environment.wasInterrupted());
    environment.setStop([] { return true; });
    asked = 0;
    int free = 0;
    for (int i = 0; i < 100; ++i)
        free += environment.isPassable({0.0, 0.0, 0.0});
    EXPECT_LE(asked, 8);
    EXPECT_EQ(free, asked);
    EXPECT_TRUE(environment.wasInterrupted());
    // Whether a pose as such is free is another question.
    EXPECT_TRUE(environment.isFree({0.0, 0.0, 0.0}));
    environment.setStop(nullptr);
    EXPECT_TRUE(environment.isPassable({0.0, 0.0, 0.0}));
    EXPECT_FALSE(environment.isPassable({11.0, 0.0, 0.0}));
}

TEST(StateSpaceEnvironment, nothingIsKnownOfClearancesOnceTheTimeIsUp)
{
    const auto si = std::make_shared<ompl::base::SpaceInformation>(reedsSheppSpace());
    const auto checker = std::make_shared<HalfAMetre>(si);
    si->setStateValidityChecker(checker);
    si->setup();
    StateSpaceEnvironment environment(si, 0.1, {}, false);
    const CostModel model{0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.7, 10.0};
    const Path path{{-9.0, 0.0, 0.0}, {{0.0, 18.0}}};
    EXPECT_EQ(environment.clearance(path.start), 0.5);
    EXPECT_EQ(pathCloseness(model, path, environment, {}), pathCloseness(model, path, environment));
    EXPECT_NEAR(pathCloseness(model, path, environment), 18.0 * 10.5, 1e-9);
    environment.setStop([] { return true; });
    checker->asked = 0;
    EXPECT_EQ(pathCloseness(model, path, environment, {}), std::nullopt);
    EXPECT_LE(checker->asked, 8);
    EXPECT_TRUE(environment.wasInterrupted());
    checker->asked = 0;
    EXPECT_EQ(environment.clearance(path.start), 0.0);
    EXPECT_EQ(checker->asked, 0);
    environment.setStop(nullptr);
    EXPECT_EQ(environment.clearance(path.start), 0.5);
}
