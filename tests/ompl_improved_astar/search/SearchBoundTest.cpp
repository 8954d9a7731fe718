// The bound on what a search misses, against plain Dijkstra over the same motions.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/models/CarModel.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::size_t MOST_NODES = 60000;

    SearchParameters unweighted(SearchParameters parameters)
    {
        parameters.weights = {1.0, 1.0, 0.0, 0.0};
        return parameters;
    }

    /** The cheapest of all paths made of the car's motions from one end and a curve to the other end, by plain
        Dijkstra: no heuristic, no cells; only nodes that are the same in all that matters are one. Nothing that costs
        as much as \e known is looked at. Negative when there are too many nodes to tell. */
    double cheapestOfAll(CarProblem &problem, SearchParameters parameters, Side side, double known)
    {
        parameters.cost.fullLockCurvature = 1.0 / parameters.turningRadius;
        CarModel model;
        model.begin(problem.world, parameters);
        const bool fromStart = side == Side::Start;
        std::vector<Node> nodes, targets;
        for (const Pose &pose : fromStart ? problem.starts : problem.goals)
            nodes.emplace_back().pose = pose, nodes.back().farthest = true;
        for (const Pose &pose : fromStart ? problem.goals : problem.starts)
            targets.emplace_back().pose = pose;
        using Item = std::pair<double, NodeIndex>;
        std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
        for (NodeIndex i = 0; i < nodes.size(); ++i)
            open.push({0.0, i});
        std::set<std::tuple<long, long, long, long, bool, bool>> settled;
        double best = known;
        while (!open.empty() && open.top().first < best)
        {
            const NodeIndex index = open.top().second;
            open.pop();
            const Node node = nodes[index];
            const auto rounded = [](double value)
            {
                return std::lround(value * 1e6);
            };
            if (!settled
                     .insert({rounded(node.pose.x), rounded(node.pose.y), rounded(wrapAngle(node.pose.yaw)),
                              rounded(node.motion.curvature), node.motion.length < 0.0, node.farthest})
                     .second)
                continue;
            for (const Node &target : targets)
                model.join(fromStart ? node : target, fromStart ? target : node, side, best,
                           [&best](const PathPiece *, std::size_t, double cost)
                           {
                               best = cost;
                               return true;
                           });
            Expansion expansion;
            model.expand(side, index, node, 0, true, expansion);
            for (const Successor &successor : expansion.successors)
            {
                const PathPiece drive = successor.motion.drive();
                Node next;
                next.g = node.g + parameters.cost.drive(fromStart ? drive : drive.reversed());
                if (node.parent != NO_NODE)
                    next.g += parameters.cost.join(node.motion.drive(), drive);
                if (next.g >= best)
                    continue;
                next.pose = successor.pose;
                next.motion = successor.motion;
                next.parent = index;
                next.farthest = successor.farthest;
                open.push({next.g, static_cast<NodeIndex>(nodes.size())});
                nodes.push_back(next);
            }
            if (nodes.size() > MOST_NODES)
                return -1.0;
        }
        return best;
    }

    /** A heuristic that sends the search the wrong way: in half of the world it promises far too long ways. What it
        gives as a bound is one. */
    class Alarmist : public Heuristic
    {
    public:
        void begin(const HeuristicQuery &query) override
        {
            curves_->begin(query);
        }
        double estimate(const Pose &pose) override
        {
            return (pose.y > 0.0 ? 20.0 : 1.0) * curves_->lowerBound(pose);
        }
        double lowerBound(const Pose &pose) override
        {
            return curves_->lowerBound(pose);
        }

    private:
        std::unique_ptr<Heuristic> curves_{heuristics().make("curves")};
    };

    /** How many bounds were compared, and how many of them come near the optimum. */
    struct Comparison
    {
        int bounds{0}, tight{0};
    };

    /** Bounds while searching, up to \e most expansions, against the cheapest of all paths. */
    Comparison compareWithAllPaths(const std::string &heuristic, bool both, std::uint64_t most)
    {
        Comparison result;
        for (std::uint64_t seed = 0; seed < 60; ++seed)
        {
            SCOPED_TRACE(seed);
            CarProblem problem = randomProblem(seed);
            SearchParameters parameters = unweighted(carParameters());
            parameters.heuristic = heuristic;
            parameters.adaptiveResolution = false;
            parameters.bidirectional = both;
            parameters.searchFromGoal = seed % 2 == 0;
            Search search;
            problem.begin(search, parameters);
            double largest = 0.0;
            for (std::uint64_t end = 4; end < most; end *= 2)
            {
                while (search.run([&] { return search.statistics().expanded >= end; }) == SearchOutcome::Improved)
                {
                }
                largest = std::max(largest, search.lowerBound());
            }
            if (!search.hasSolution())
                continue;
            double cheapest = search.bestCost();
            bool known = true;
            for (const Side side : {Side::Start, Side::Goal})
                if (both || side == (parameters.searchFromGoal ? Side::Goal : Side::Start))
                {
                    const double found = cheapestOfAll(problem, parameters, side, cheapest);
                    known = known && found >= 0.0;
                    cheapest = found >= 0.0 ? found : cheapest;
                }
            if (!known)
                continue;
            ++result.bounds;
            result.tight += largest > 0.9 * cheapest;
            EXPECT_LE(largest, cheapest + 1e-6);
        }
        return result;
    }
}  // namespace

TEST(SearchBound, isNeverAboveTheCheapestPathOfTheCarsMotions)
{
    Comparison all;
    for (const bool both : {false, true})
    {
        const Comparison each = compareWithAllPaths("default", both, 400);
        all.bounds += each.bounds;
        all.tight += each.tight;
    }
    EXPECT_GT(all.bounds, 30);
    EXPECT_GT(all.tight, all.bounds / 2) << "a bound that says little is easily right";
}

TEST(SearchBound, isNotFooledByEstimatesThatAreTooLarge)
{
    // Pruned by such an estimate, nodes of cheaper paths would be gone, and what is left would promise too much.
    heuristics().add("alarmist", [] { return std::make_unique<Alarmist>(); });
    const Comparison all = compareWithAllPaths("alarmist", true, 3000);
    EXPECT_GT(all.bounds, 25);
    EXPECT_GT(all.tight, all.bounds / 2) << "a bound that says little is easily right";
}

TEST(SearchBound, ofOneSideOnAGridIsTheOptimum)
{
    int compared = 0;
    for (const char *model : {"grid8", "grid16"})
        for (std::uint64_t seed = 0; seed < 100; ++seed)
        {
            SCOPED_TRACE(seed);
            GridWorld world = randomGrid(seed, 0.25);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            SearchParameters parameters = unweighted(world.parameters());
            parameters.motionModel = model;
            parameters.bidirectional = false;
            const double best = shortestByDijkstra(world, start, goal, std::string(model) == "grid16");
            Search search;
            search.begin(world, parameters);
            search.addStart(start);
            search.addGoal(goal);
            if (search.run(afterAsking()) != SearchOutcome::Improved)
                continue;
            ++compared;
            ASSERT_NEAR(search.bestCost(), best, 1e-6);
            ASSERT_NEAR(search.lowerBound(), best, 1e-4);
        }
    EXPECT_GT(compared, 100);
}

TEST(SearchBound, ofBothSidesOnAGridIsNeverAboveTheOptimum)
{
    int compared = 0;
    for (const auto &[model, heuristic] : {std::pair("grid8", "straight"),
                                           {"grid8", "octile"},
                                           {"grid8", "manhattan"},
                                           {"grid16", "straight"},
                                           {"grid16", "octile"},
                                           {"grid16", "manhattan"}})
        for (std::uint64_t seed = 0; seed < 200; ++seed)
        {
            SCOPED_TRACE(std::string(model) + ", " + heuristic + ", " + std::to_string(seed));
            GridWorld world = randomGrid(seed, 0.3);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            SearchParameters parameters = unweighted(world.parameters());
            parameters.motionModel = model;
            parameters.heuristic = heuristic;
            const double best = shortestByDijkstra(world, start, goal, std::string(model) == "grid16");
            Search search;
            search.begin(world, parameters);
            search.addStart(start);
            search.addGoal(goal);
            if (search.run(afterAsking()) != SearchOutcome::Improved)
                continue;
            ++compared;
            ASSERT_LE(search.lowerBound(), best + 1e-6);
            ASSERT_GE(search.bestCost(), best - 1e-6);
        }
    EXPECT_GT(compared, 100);
}

TEST(SearchBound, withWeightsIsWhatTheRootsPromise)
{
    CarProblem problem = randomProblem(3);
    SearchParameters parameters = carParameters();
    Search search;
    problem.begin(search, parameters);
    search.run(afterAsking());
    EXPECT_GE(search.lowerBound(), search.shortestMotion() - 1e-9);
    EXPECT_LE(search.lowerBound(), search.bestCost());
}
