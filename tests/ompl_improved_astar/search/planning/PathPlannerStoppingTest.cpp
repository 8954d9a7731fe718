// What paths cost takes time to find out. Once that is up nothing is taken for what it costs that is not known.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/PathRelaxer.h"
#include "ompl_improved_astar/search/planning/PathReplanner.h"
#include "ompl_improved_astar/search/planning/PathTurner.h"
#include "ompl_improved_astar/search/planning/PathWidener.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();
    constexpr double PREFERRED = 0.3;
    constexpr std::uint64_t IMPROVED[] = {19, 20, 47};  // problems whose first paths are made better several times

    /** A world that is asked through a checker that takes long: when the time is up it says no to everything. */
    class HurriedWorld : public DiscCarWorld
    {
    public:
        explicit HurriedWorld(const DiscCarWorld &world) : DiscCarWorld(world)
        {
        }

        std::uint64_t looks{0};  ///< at clearances and states, so far
        std::uint64_t most{0};   ///< when there have been so many the time is up

        bool wasInterrupted() const override
        {
            return isUp_;
        }

        void goOn(std::uint64_t longer)
        {
            isUp_ = false;
            most = looks + longer;
        }

        double clearance(const Pose &pose) override
        {
            return isUp() ? 0.0 : DiscCarWorld::clearance(pose);
        }

        double freeLength(const Pose &from, double curvature, double length) override
        {
            return isUp() ? 0.0 : DiscCarWorld::freeLength(from, curvature, length);
        }

        bool isPassable(const Pose &pose) override
        {
            return !isUp() && DiscCarWorld::isPassable(pose);
        }

        bool acceptPath(const Path &path) override
        {
            return !isUp() && DiscCarWorld::acceptPath(path);
        }

    private:
        bool isUp()
        {
            isUp_ = isUp_ || ++looks > most;
            return isUp_;
        }

        bool isUp_{false};
    };

    PathPlannerParameters preferringParameters(const CarProblem &problem)
    {
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.search.cost.preferredClearance = PREFERRED;
        parameters.search.cost.clearanceCost = 10.0;
        parameters.anytime = true;
        return parameters;
    }

    void beginIn(MotionEnvironment &world, const CarProblem &problem, PathPlanner &planner)
    {
        planner.begin(world, preferringParameters(problem));
        for (const Pose &start : problem.starts)
            planner.addStart(start);
        for (const Pose &goal : problem.goals)
            planner.addGoal(goal);
    }

    /** By how much two prices of a path may differ that was looked at in different places. */
    double differenceOfLooks(const CostModel &model, const Path &path)
    {
        return model.clearanceCost * model.samplesApart * static_cast<double>(path.pieces.size() + 3);
    }
}  // namespace

TEST(PathPlannerStopping, whatIsSaidInAHurryIsNotTakenForWhatPathsCost)
{
    std::size_t solved = 0, improved = 0, unpolished = 0;
    for (const std::uint64_t seed : IMPROVED)
    {
        SCOPED_TRACE(seed);
        const CarProblem problem = randomProblem(seed, 14);
        for (std::uint64_t longer = 50; longer < 30000; longer += 1 + longer / 4)
        {
            SCOPED_TRACE(longer);
            HurriedWorld world(problem.world);
            PathPlanner planner;
            beginIn(world, problem, planner);
            const CostModel &model = planner.search().cost();
            DiscCarWorld calm = problem.world;
            double last = INFINITE;
            const auto check = [&](const Path &path, double cost)
            {
                EXPECT_EQ(faultOf(path, calm, problem.starts, problem.goals, TURNING_RADIUS), "");
                EXPECT_NEAR(cost, pathCost(model, path, calm), differenceOfLooks(model, path));
                EXPECT_NEAR(planner.closenessOfBest(), pathCloseness(model, path, calm),
                            differenceOfLooks(model, path));
                EXPECT_LT(cost, last);
                improved += last < INFINITE ? 1 : 0;
                last = cost;
                return false;
            };
            for (int calls = 0; calls < 3; ++calls)
            {
                world.goOn(longer);
                bool isSolving = true;
                planner.solve(
                    [&]
                    {
                        EXPECT_TRUE(isSolving) << "whoever is asked may be gone";
                        return world.wasInterrupted() || world.looks >= world.most;
                    },
                    check);
                isSolving = false;
                EXPECT_EQ(planner.hasSolution(), planner.search().hasSolution()) << "what is found is returned";
                EXPECT_EQ(planner.bestCost(), last);
                world.goOn(longer);
                if (planner.hasSolution())
                {
                    EXPECT_GE(planner.closenessOfBest(), 0.0);
                }
                if (calls == 0 && planner.hasSolution() && planner.bestCost() == planner.search().bestCost())
                    ++unpolished;
            }
            solved += planner.hasSolution() ? 1 : 0;
        }
    }
    EXPECT_GT(solved, 40u);
    EXPECT_GT(improved, 40u);
    EXPECT_GT(unpolished, 5u) << "there was no time to make the first path better";
}

namespace
{
    /** Counts the looks that are closer than usual. */
    class CountingWorld : public DiscCarWorld
    {
    public:
        explicit CountingWorld(const DiscCarWorld &world) : DiscCarWorld(world)
        {
        }

        std::size_t countNearer(const Pose &from, const Arc &arc, double first, double apart, std::size_t samples,
                                double clearance, std::size_t most) override
        {
            looks += samples;
            // Of a tiny piece there is one look in any case.
            closer += samples > 1 && apart < 0.021 ? samples : 0;
            return DiscCarWorld::countNearer(from, arc, first, apart, samples, clearance, most);
        }

        void clearLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                          double *clear) override
        {
            if (tellsClear)
                ClearanceWorld(*this).clearLengths(from, arcs, count, clearance, clear);
            else
                DiscCarWorld::clearLengths(from, arcs, count, clearance, clear);
        }

        std::uint64_t looks{0}, closer{0};
        bool tellsClear{false};
    };
}  // namespace

TEST(PathPlannerStopping, aPathThatThereIsNoTimeToPriceReplacesNoOther)
{
    std::size_t stoppedWhileComparing = 0, improved = 0;
    for (const std::uint64_t seed : IMPROVED)
        for (std::uint64_t most = 1; most < 100000; most += 250)
        {
            SCOPED_TRACE(testing::Message() << seed << ", " << most);
            const CarProblem problem = randomProblem(seed, 14);
            CountingWorld world(problem.world);
            PathPlanner planner;
            beginIn(world, problem, planner);
            bool isStopped = false;
            std::uint64_t last = 0, longest = 0;
            std::size_t reports = 0;
            planner.solve(
                [&]
                {
                    longest = std::max(longest, world.closer - std::exchange(last, world.closer));
                    isStopped = isStopped || world.closer >= most || planner.expanded() > 200;
                    return isStopped;
                },
                [&](const Path &, double)
                {
                    EXPECT_FALSE(isStopped);
                    ++reports;
                    return false;
                });
            EXPECT_LE(longest, 2 * LOOKS_BETWEEN_STOPS);
            if (world.closer < most)
                break;
            ++stoppedWhileComparing;
            improved += reports - 1;
        }
    EXPECT_GT(stoppedWhileComparing, 20u);
    EXPECT_GT(improved, 20u);
    RecordProperty("stopped", static_cast<int>(stoppedWhileComparing));
}

TEST(PathPlannerStopping, theBestPathIsPricedOnceHoweverManyItIsComparedWith)
{
    std::uint64_t closer = 0;
    for (const std::uint64_t seed : IMPROVED)
    {
        const CarProblem problem = randomProblem(seed, 14);
        CountingWorld world(problem.world);
        PathPlanner planner;
        beginIn(world, problem, planner);
        planner.solve(afterExpanding(planner, 800), {});
        closer += world.closer;
    }
    // Priced anew for each of the others it takes 37,700 looks.
    EXPECT_LT(closer, 25000u);
    EXPECT_GT(closer, 10000u);
}

// Whoever makes paths better prices the whole of them first.
TEST(PathPlannerStopping, nobodyLooksAtAWholePathWithoutAskingInBetween)
{
    DiscCarWorld corridor({{-20.0, -10.0}, {400.0, 10.0}});
    corridor.boxes.push_back({{80.0, corridor.radius + 0.1}, {82.0, 9.0}});
    const Path path{{0.0, 0.0, 0.0}, {{0.0, 180.0}, {0.1, 1.0}, {0.0, -3.0}, {0.1, 1.0}, {0.0, 20.0}}};
    CountingWorld world(corridor);
    const ReedsShepp curves(TURNING_RADIUS);
    const SearchTuning tuning;
    CostModel model = carParameters().cost;
    model.preferredClearance = PREFERRED;
    model.clearanceCost = 10.0;
    const double cost = pathCost(model, path, world);
    struct Part
    {
        const char *name;
        int questions;  // up to where curves are tried, whose length is another matter
        std::function<bool(Path &, const StopFunction &)> pass;
    };
    const Part parts[]{
        {"shortener", 8,
         [&](Path &changed, const StopFunction &stop)
         {
             return PathShortener(world, curves, model).pass(changed, 1.0, 0.0, INFINITE, CurveChoice::All, stop);
         }},
        {"turner", 8,
         [&](Path &changed, const StopFunction &stop)
         {
             return PathTurner(world, curves, model, tuning).pass(changed, cost, stop);
         }},
        {"relaxer", 10000,
         [&](Path &changed, const StopFunction &stop)
         {
             return PathRelaxer(world, curves, model, tuning).pass(changed, {0.3, 1}, ANY_CUSPS, stop);
         }},
        {"widener", 10000,
         [&](Path &changed, const StopFunction &stop)
         {
             return PathWidener(world, curves, model, tuning).pass(changed, stop);
         }},
        {"replanner", 8,
         [&](Path &changed, const StopFunction &stop)
         {
             world.tellsClear = true;
             PathReplanner replanner;
             SearchParameters parameters = carParameters();
             parameters.inscribedRadius = corridor.radius;
             parameters.cost = model;
             replanner.begin(world, parameters);
             const std::optional<Path> other = replanner.replan(changed, {78.0, 82.0, 80.0, 0.1},
                                                                {400, std::numeric_limits<std::size_t>::max()}, stop);
             changed = other ? *other : changed;
             return other.has_value();
         }}};
    for (const Part &part : parts)
    {
        SCOPED_TRACE(part.name);
        std::uint64_t last = world.looks = 0, longest = 0;
        const auto stop = [&, asked = 0]() mutable
        {
            longest = std::max(longest, world.looks - std::exchange(last, world.looks));
            return ++asked > part.questions;
        };
        Path changed = path;
        const bool isChanged = part.pass(changed, stop);
        EXPECT_EQ(changed.length() != path.length(), isChanged);
        EXPECT_EQ(isChanged, part.questions > 8);
        EXPECT_GT(world.looks, 4 * LOOKS_BETWEEN_STOPS);
        EXPECT_LE(longest, 4 * LOOKS_BETWEEN_STOPS) << "a third of the path";
        EXPECT_LE(world.looks - last, 4 * LOOKS_BETWEEN_STOPS);
    }
}
