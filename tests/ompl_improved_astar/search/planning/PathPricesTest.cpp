// What whole paths cost: found out once, and not at all when there is no time for it.

#include "ompl_improved_astar/search/planning/PathPrices.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    /** Counts looks at clearances, and is interrupted by the so-many-th, if any. */
    class CountingWorld : public DiscCarWorld
    {
    public:
        CountingWorld() : DiscCarWorld({{-100.0, -2.0}, {300.0, 2.0}})
        {
        }

        double clearance(const Pose &pose) override
        {
            return ++looks == interruptedBy ? 0.0 : DiscCarWorld::clearance(pose);
        }

        bool wasInterrupted() const override
        {
            return interruptedBy > 0 && looks >= interruptedBy;
        }

        std::uint64_t looks{0}, interruptedBy{0};
    };

    CostModel model(double clearanceWeight, double preferredClearance)
    {
        return {0.2, 1.0, 0.1, clearanceWeight, 1.5, 1.0 / 3.0, preferredClearance, 10.0};
    }

    /** Ever farther to one side of the corridor. */
    Path bent(double length)
    {
        return {{0.0, 0.0, 0.0}, {{0.0, length}, {0.01, 12.0}, {-0.01, 12.0}, {0.0, -3.0}}};
    }

    /** The same path by another model, or with another piece, is another. */
    std::vector<Path> likePaths()
    {
        std::vector<Path> paths(4, bent(20.0));
        paths[1].start.yaw = 0.01;
        paths[2].pieces.pop_back();
        paths[3].pieces.back().length = -2.0;
        return paths;
    }
}  // namespace

TEST(PathPrices, areWhatPathsCost)
{
    CountingWorld world;
    for (const CostModel &each : {model(0.0, 0.0), model(2.0, 0.0), model(0.0, 1.0), model(2.0, 1.0)})
        for (const double length : {0.5, 20.0, 180.0})
        {
            PathPrices prices;
            prices.begin(world, each);
            const Path path = bent(length);
            EXPECT_NEAR(prices.cost(path, {}).value(), pathCost(each, path, world), 1e-9);
            EXPECT_NEAR(prices.closeness(path, {}).value(), pathCloseness(each, path, world), 1e-9);
            const PricedPath priced = pricePath(each, path, world, {}).value();
            EXPECT_NEAR(priced.cost, pathCost(each, path, world), 1e-9);
            EXPECT_EQ(priced.closeness.size(), path.pieces.size());
        }
}

TEST(PathPrices, areFoundOutOnce)
{
    CountingWorld world;
    PathPrices prices;
    prices.begin(world, model(2.0, 1.0));
    std::vector<double> costs;
    for (const Path &path : likePaths())
        costs.push_back(prices.cost(path, {}).value());
    std::uint64_t looks = world.looks;
    for (std::size_t i = 0; i < costs.size(); ++i)
    {
        EXPECT_EQ(prices.cost(likePaths()[i], [] { return true; }), costs[i]) << "it takes no time";
        EXPECT_EQ(std::count(costs.begin(), costs.end(), costs[i]), 1);
    }
    EXPECT_EQ(world.looks, looks);
    // What was asked about last is remembered: the best path, which each is compared with, whatever came in between.
    for (const double length : {5.0, 6.0, 7.0, 8.0, 9.0, 10.0})
    {
        EXPECT_EQ(prices.cost(likePaths()[1], {}), costs[1]);
        EXPECT_EQ(world.looks, looks);
        prices.cost(bent(length), {});
        EXPECT_GT(world.looks, looks);
        looks = world.looks;
    }
    const PricedPath priced = pricePath(prices.model(), bent(40.0), world, {}).value();
    prices.remember(priced);
    looks = world.looks;
    EXPECT_NEAR(prices.cost(priced.path, {}).value(), priced.cost, 1e-9);
    EXPECT_EQ(world.looks, looks);
    prices.begin(world, model(2.0, 0.5));
    EXPECT_LT(prices.cost(priced.path, {}).value(), priced.cost) << "by the new model";
    EXPECT_GT(world.looks, looks);
}

TEST(PathPrices, areNotKnownWhenThereIsNoTimeToFindOut)
{
    const Path path = bent(180.0);
    for (const CostModel &each : {model(2.0, 0.0), model(0.0, 1.0), model(2.0, 1.0)})
    {
        CountingWorld world;
        PathPrices prices;
        prices.begin(world, each);
        std::uint64_t last = 0, longest = 0, questions = 0;
        const auto ask = [&](std::uint64_t most)
        {
            return [&, most]
            {
                longest = std::max(longest, world.looks - std::exchange(last, world.looks));
                return ++questions > most;
            };
        };
        const double cost = pathCost(each, path, world);
        const std::uint64_t looks = std::exchange(world.looks, 0);
        EXPECT_EQ(prices.cost(path, ask(1)), std::nullopt);
        EXPECT_LE(world.looks, 2 * LOOKS_BETWEEN_STOPS);
        EXPECT_EQ(questions, 2u) << "once it is told to stop it does not ask again";
        EXPECT_EQ(pricePath(each, path, world, ask(1)).has_value(), false);
        // Nothing of that is taken for what it costs.
        world.looks = last = 0;
        EXPECT_NEAR(prices.cost(path, ask(1000)).value(), cost, 1e-9);
        EXPECT_EQ(world.looks, looks);
        EXPECT_LE(longest, LOOKS_BETWEEN_STOPS);
        EXPECT_GE(questions, looks / LOOKS_BETWEEN_STOPS);
        // Nor what an environment says that was interrupted.
        prices.begin(world, each);
        for (const std::uint64_t by : {std::uint64_t{1}, looks / 2, looks})
        {
            world.looks = 0;
            world.interruptedBy = by;
            EXPECT_EQ(prices.cost(path, {}), std::nullopt);
            world.looks = 0;
            world.interruptedBy = 0;
        }
        EXPECT_NEAR(prices.cost(path, {}).value(), cost, 1e-9);
    }
    // Where obstacles nearby cost nothing there is nothing to be found out.
    CountingWorld world;
    PathPrices prices;
    prices.begin(world, model(0.0, 0.0));
    EXPECT_TRUE(prices.cost(path, [] { return true; }));
    EXPECT_EQ(world.looks, 0u);
}
