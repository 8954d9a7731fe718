// The bound on what a search misses, against plain Dijkstra over the same motions.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/models/CarModel.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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
    // Asked after each improvement and between motions, too, with weights below one, from either side or both.
    int compared = 0, betweenMotions = 0;
    for (const auto &[model, heuristic] : {std::pair("grid8", "straight"),
                                           {"grid8", "octile"},
                                           {"grid8", "manhattan"},
                                           {"grid16", "straight"},
                                           {"grid16", "octile"},
                                           {"grid16", "manhattan"}})
        for (std::uint64_t seed = 0; seed < 300; ++seed)
        {
            SCOPED_TRACE(std::string(model) + ", " + heuristic + ", " + std::to_string(seed));
            Random random(seed);
            GridWorld world = randomGrid(seed, random.between(0.05, 0.35));
            const Pose start = world.freePose(random), goal = world.freePose(random);
            SearchParameters parameters = world.parameters();
            parameters.weights = {0.25 * random.index(5), 0.25 * random.index(5), random.between(0.0, 8.0), 0.0};
            parameters.motionModel = model;
            parameters.heuristic = heuristic;
            parameters.bidirectional = random.chance(0.6);
            parameters.searchFromGoal = random.chance(0.5);
            const double best = shortestByDijkstra(world, start, goal, std::string(model) == "grid16");
            Search search;
            search.begin(world, parameters);
            search.addStart(start);
            search.addGoal(goal);
            const int questions = 1 + 3 * static_cast<int>(random.index(5));
            SearchOutcome outcome = SearchOutcome::Stopped;
            for (int i = 0; i < 20000 && outcome != SearchOutcome::Exhausted; ++i)
            {
                outcome = search.run(afterAsking(questions));
                ASSERT_LE(search.lowerBound(), best + 1e-6);
                ASSERT_GE(search.bestCost(), best - 1e-6);
                betweenMotions += outcome == SearchOutcome::Stopped;
            }
            ASSERT_EQ(outcome, SearchOutcome::Exhausted);
            compared += search.hasSolution();
        }
    EXPECT_GT(compared, 1000);
    EXPECT_GT(betweenMotions, 10000);
}

TEST(SearchBound, holdsWhereTwoCarsComeToOnePlace)
{
    // The known way backs from the second start through where a motion from the first one ends, at no more cost, but
    // heading on: whoever arrives so has to change gear, and who backs through is not to be forgotten.
    constexpr double STEP = 2.0, FREE = 2.5;  // metres; steps are made where more than they is free
    int compared = 0, tight = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Pose first{0.0, 0.0, 0.0}, second{4.0, 0.0, 0.0};
        CarProblem problem{DiscCarWorld({{-14.0, -14.0}, {14.0, 14.0}}), {first, second}, {}};
        std::vector<double> curvatures{0.0};
        for (std::uint32_t i = 0, pieces = 2 + random.index(3); i < pieces; ++i)
        {
            const double last = curvatures.back(), other = last == 0.0 ? 1.0 / TURNING_RADIUS : -last;
            const double curvature = (static_cast<int>(random.index(3)) - 1) / TURNING_RADIUS;
            curvatures.push_back(curvature != last ? curvature : other);
        }
        std::vector<Pose> swept{first};
        Pose end = second;
        for (const double curvature : curvatures)
        {
            for (double driven = 0.0; driven <= FREE; driven += 0.25)
                swept.push_back(advance(end, curvature, -driven));
            end = advance(end, curvature, -STEP);
        }
        problem.goals = {{end.x, end.y, wrapAngle(end.yaw)}};
        for (std::uint32_t i = 0, tries = 60 + random.index(100); i < tries; ++i)
        {
            const Pose &near = swept[random.index(static_cast<std::uint32_t>(swept.size()))];
            const double x = near.x + random.between(-4.0, 6.0), y = near.y + random.between(-4.0, 4.0);
            const double w = random.between(0.1, 2.0), h = random.between(0.1, 2.0);
            problem.world.boxes.push_back({{x - w, y - h}, {x + w, y + h}});
            if (std::any_of(swept.begin(), swept.end(),
                            [&](const Pose &pose) { return problem.world.gap(pose) < 0.01; }))
                problem.world.boxes.pop_back();
        }
        Pose pose = second;
        bool isWayFree = true;
        for (const double curvature : curvatures)
        {
            isWayFree = isWayFree && problem.world.freeLength(pose, curvature, -FREE) >= FREE;
            pose = advance(pose, curvature, -STEP);
        }
        if (!isWayFree)
            continue;
        const double known = STEP * static_cast<double>(curvatures.size());
        SearchParameters parameters = unweighted(carParameters());
        parameters.adaptiveResolution = parameters.bidirectional = parameters.searchFromGoal = false;
        parameters.cost.gearChangePenalty = 20.0;
        parameters.cost.steeringChangePenalty = 0.0;
        parameters.bounds = problem.world.inside;
        parameters.inscribedRadius = problem.world.radius;
        Search search;
        problem.begin(search, parameters);
        double largest = 0.0;
        for (std::uint64_t most = 2; most < 3000; most = most * 3 / 2 + 1)
        {
            while (search.run([&] { return search.statistics().expanded >= most; }) == SearchOutcome::Improved)
                largest = std::max(largest, search.lowerBound());
            largest = std::max(largest, search.lowerBound());
        }
        ++compared;
        tight += largest > 0.9 * known;
        EXPECT_LE(largest, known + 1e-6);
    }
    EXPECT_GT(compared, 100);
    EXPECT_GT(tight, 50) << "a bound that says little is easily right";
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
