// Moving the poses between the pieces of paths: cheaper, ends kept, free and drivable.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/PathRelaxer.h"
#include "ompl_improved_astar/search/planning/PathShortener.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/NoisyWorld.h"
#include "tests/ompl_improved_astar/search/planning/SamePath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::size_t ANY_NUMBER = 1000;
    constexpr double INFINITE = std::numeric_limits<double>::infinity();
    constexpr double STEP = 0.3 * TURNING_RADIUS;
    constexpr std::size_t CUSPS = 2;

    const CostModel &model()
    {
        static const CostModel cost = carParameters().cost;
        return cost;
    }

    /** How often first solutions are relaxed. */
    enum class Relaxing
    {
        Never,
        OnceAtMost,
        Usual
    };

    PathPlannerParameters plannerParameters(const CarProblem &problem, Relaxing relaxing)
    {
        PathPlannerParameters parameters;
        parameters.search = parametersIn(problem);
        if (relaxing != Relaxing::Usual)
            parameters.search.tuning.dearToRelax = INFINITE;
        if (relaxing == Relaxing::Never)
            parameters.search.tuning.dearToRelaxOnce = INFINITE;
        return parameters;
    }

    /** A first solution that is not relaxed; without pieces when there is none. */
    Path plannedPath(CarProblem &problem)
    {
        PathPlanner planner;
        problem.begin(planner, plannerParameters(problem, Relaxing::Never));
        planner.solve(afterAsking(3000), {});
        return planner.bestPath();
    }

    DiscCarWorld postInTheOpen()
    {
        return DiscCarWorld({{-50.0, -50.0}, {50.0, 50.0}}, {{{-0.5, -0.5}, {0.5, 0.5}}});
    }

    /** Two curves that meet far out beside that post. */
    Path roundThePost(const ReedsShepp &curves)
    {
        const Pose from{-15.0, 0.0, 0.0}, through{0.0, 6.0, 0.0}, to{15.0, 0.0, 0.0};
        Path path{from, {}};
        for (const auto &[a, b] : {std::pair{from, through}, std::pair{through, to}})
        {
            const ReedsSheppCurve curve = curves.shortest(a, b);
            for (std::size_t k = 0; k < curve.count; ++k)
                path.append(curve.pieces[k]);
        }
        return path;
    }

    /** Shortens the path with one set of knots after another until none of them helps. */
    void shortenAll(DiscCarWorld &world, const ReedsShepp &curves, Path &path)
    {
        PathShortener shortener(world, curves, model());
        for (bool isShorter = true; isShorter;)
        {
            isShorter = false;
            for (const double spacing : {0.9, 1.5, 2.3})
                isShorter = shortener.pass(path, spacing, 0.4, INFINITE, CurveChoice::All, nullptr) || isShorter;
        }
    }
}  // namespace

TEST(PathRelaxer, makesCheaperWhatShorteningLeaves)
{
    const ReedsShepp curves(TURNING_RADIUS);
    int relaxed = 0, same = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        Path before = plannedPath(problem);
        if (before.pieces.empty())
            continue;
        shortenAll(problem.world, curves, before);
        const double cost = pathCost(model(), before, problem.world);
        Path path = before, again = before;
        const bool isRelaxed = PathRelaxer(problem.world, curves, model(), SearchTuning())
                                   .pass(path, {0.1 * STEP, CUSPS}, ANY_NUMBER, nullptr);
        ASSERT_EQ(PathRelaxer(problem.world, curves, model(), SearchTuning())
                      .pass(again, {0.1 * STEP, CUSPS}, ANY_NUMBER, nullptr),
                  isRelaxed);
        ASSERT_TRUE(isSamePath(path, again));
        ASSERT_EQ(faultOf(path, problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
        if (isRelaxed)
        {
            ASSERT_LT(pathCost(model(), path, problem.world), cost - 1e-4);
        }
        else
        {
            ASSERT_TRUE(isSamePath(path, before));
        }
        ++(isRelaxed ? relaxed : same);
    }
    EXPECT_GT(relaxed, 20);
    EXPECT_GT(same, 20);
}

/** With steps that fall the way round a post comes as near to it as it lets it. */
TEST(PathRelaxer, drawsABendTightAroundAPost)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = postInTheOpen();
    Path path = roundThePost(curves);
    const Pose from = path.start, to = path.end();
    ASSERT_EQ(faultOf(path, world, {from}, {to}, TURNING_RADIUS), "");
    const double before = path.length();
    PathRelaxer relaxer(world, curves, model(), SearchTuning());
    for (double step = STEP; step > 0.01; step *= 0.6)
        relaxer.pass(path, {step, CUSPS}, ANY_NUMBER, nullptr);
    EXPECT_EQ(faultOf(path, world, {from}, {to}, TURNING_RADIUS), "");
    EXPECT_GT(relaxer.connections(), 0U);
    // The least way past it is about 30.3 m long: the rear axle has to be 1.45 m beside the middle of the post.
    EXPECT_GT(before, 32.0);
    EXPECT_LT(path.length(), 30.6);
    EXPECT_GE(path.length(), 2.0 * std::hypot(15.0, 1.45) - 1e-6);
}

/** Where the car goes to and fro, the part between cusps has to be led through a pose: a longer one has more cusps than
    two curves have. */
TEST(PathRelaxer, movesPosesBetweenCuspsWhereTheCarGoesToAndFro)
{
    const ReedsShepp curves(TURNING_RADIUS);
    int cheaperByOne = 0, dearerByOne = 0, cheaperByTwo = 0, dearerByTwo = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        const Path before = plannedPath(problem);
        if (before.cusps() < 3)
            continue;
        const auto costWith = [&](std::size_t cusps)
        {
            Path path = before;
            PathRelaxer relaxer(problem.world, curves, model(), SearchTuning());
            for (const double part : {1.0, 0.4, 0.16})
                relaxer.pass(path, {part * STEP, cusps}, before.cusps(), nullptr);
            EXPECT_EQ(faultOf(path, problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
            return pathCost(model(), path, problem.world);
        };
        const double none = costWith(0), one = costWith(1), two = costWith(2);
        cheaperByOne += one < none - 1e-2;
        dearerByOne += one > none + 1e-2;
        cheaperByTwo += two < one - 1e-2;
        dearerByTwo += two > one + 1e-2;
    }
    EXPECT_GT(cheaperByOne, 10);
    EXPECT_LT(dearerByOne, cheaperByOne / 2) << cheaperByOne;
    EXPECT_GT(cheaperByTwo, 5);
    EXPECT_LT(dearerByTwo, cheaperByTwo) << cheaperByTwo;
}

TEST(PathRelaxer, keepsToTheCuspsThatAPathMayHave)
{
    // Cusps cost nothing here, so that more of them are often cheaper.
    CostModel cost = model();
    cost.gearChangePenalty = 0.0;
    const ReedsShepp curves(TURNING_RADIUS);
    int more = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        const Path before = plannedPath(problem);
        if (before.pieces.empty())
            continue;
        Path limited = before, free = before;
        PathRelaxer relaxer(problem.world, curves, cost, SearchTuning());
        relaxer.pass(limited, {STEP, CUSPS}, before.cusps(), nullptr);
        ASSERT_LE(limited.cusps(), before.cusps());
        relaxer.pass(free, {STEP, CUSPS}, ANY_NUMBER, nullptr);
        more += free.cusps() > before.cusps();
    }
    EXPECT_GT(more, 3);
}

TEST(PathRelaxer, endsWhenItIsStoppedOrThePathIsNotAccepted)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = postInTheOpen();
    const Path before = roundThePost(curves);
    const double cost = pathCost(model(), before, world);
    std::uint64_t asked = 0;
    Path relaxed = before;
    ASSERT_TRUE(PathRelaxer(world, curves, model(), SearchTuning())
                    .pass(relaxed, {0.1 * STEP, CUSPS}, ANY_NUMBER, [&asked] { return ++asked == 0; }));
    ASSERT_GT(asked, 50U);
    for (std::uint64_t calls = 0; calls < asked; calls += 1 + asked / 50)
    {
        SCOPED_TRACE(calls);
        std::uint64_t left = calls, after = 0;
        Path path = before;
        PathRelaxer relaxer(world, curves, model(), SearchTuning());
        const bool isRelaxed = relaxer.pass(path, {0.1 * STEP, CUSPS}, ANY_NUMBER,
                                            [&]
                                            {
                                                after += left == 0 ? 1 : 0;
                                                return left == 0 || left-- == 0;
                                            });
        EXPECT_LE(after, 4U);
        EXPECT_LE(relaxer.connections(), 2 * (calls + 1));
        EXPECT_EQ(isSamePath(path, before), !isRelaxed);
        EXPECT_EQ(faultOf(path, world, {before.start}, {before.end()}, TURNING_RADIUS), "");
        EXPECT_LE(pathCost(model(), path, world), cost);
    }
    world.acceptsPaths = false;
    Path refused = before;
    EXPECT_FALSE(
        PathRelaxer(world, curves, model(), SearchTuning()).pass(refused, {0.1 * STEP, CUSPS}, ANY_NUMBER, nullptr));
    EXPECT_TRUE(isSamePath(refused, before));
}

TEST(PathRelaxer, leavesASingleMotionAlone)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world({{-50.0, -50.0}, {50.0, 50.0}});
    Path path{{0.0, 0.0, 0.0}, {{1.0 / TURNING_RADIUS, 12.0}}};
    const Path before = path;
    PathRelaxer relaxer(world, curves, model(), SearchTuning());
    EXPECT_FALSE(relaxer.pass(path, {STEP, CUSPS}, ANY_NUMBER, nullptr));
    EXPECT_EQ(relaxer.connections(), 0U);
    EXPECT_TRUE(isSamePath(path, before));
}

/** Each path is compared with the one before as a whole: otherwise two could replace each other for ever. */
TEST(PathRelaxer, endsWhereClosenessIsNothingButNoise)
{
    constexpr std::uint64_t FAR_TOO_MANY = 400000;
    const ReedsShepp curves(TURNING_RADIUS);
    CostModel cost = model();
    cost.preferredClearance = 0.3;
    cost.clearanceCost = 10.0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
        SCOPED_TRACE(seed);
        NoisyWorld world({{-100.0, -100.0}, {100.0, 100.0}});
        Random random(seed);
        Path path{{0.0, 0.0, random.between(-PI, PI)}, {}};
        for (int i = 0; i < 8; ++i)
            path.append(Arc{(static_cast<double>(random.index(3)) - 1.0) / TURNING_RADIUS,
                            random.between(0.5, 3.0) * (random.chance(0.5) ? -1.0 : 1.0)});
        const double before = pathCost(cost, path, world);
        PathRelaxer relaxer(world, curves, cost, SearchTuning());
        const bool isRelaxed =
            relaxer.pass(path, {0.3 * STEP, CUSPS}, ANY_NUMBER, [&] { return relaxer.connections() > FAR_TOO_MANY; });
        ASSERT_LT(relaxer.connections(), FAR_TOO_MANY);
        ASSERT_LE(pathCost(cost, path, world), isRelaxed ? before - 1e-4 : before);
    }
}

/** Where the shortest curve is what the path is there is nothing to gain, so that poses are not even tried. */
TEST(PathRelaxer, looksAtEachPartOnceWhereNothingCanBeGained)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world({{-50.0, -50.0}, {50.0, 50.0}});
    Path path{{0.0, 0.0, 0.0}, {{1.0 / TURNING_RADIUS, 2.0}, {0.0, 12.0}, {-1.0 / TURNING_RADIUS, 3.0}}};
    const Path before = path;
    PathRelaxer relaxer(world, curves, model(), SearchTuning());
    EXPECT_FALSE(relaxer.pass(path, {STEP, 0}, ANY_NUMBER, nullptr));
    EXPECT_EQ(relaxer.connections(), 2U);  // between its three pieces
    EXPECT_TRUE(isSamePath(path, before));
}

/** The planner asks for it once where a path costs more than promised, more than once where it costs far more, and
   never pays for it. */
TEST(PathRelaxer, makesDearFirstSolutionsOfThePlannerCheaper)
{
    int solved = 0, cheap = 0, cheaperByOne = 0, cheaperBySeveral = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        const auto solve = [&](PathPlanner &planner, Relaxing relaxing, double longest)
        {
            PathPlannerParameters parameters = plannerParameters(problem, relaxing);
            SearchTuning &tuning = parameters.search.tuning;
            tuning.longestToRelax = longest;
            // Else the search would promise something else in the end.
            tuning.afterthought = tuning.afterthoughtPerExcess = 0.0;
            tuning.leastAfterthought = tuning.secondAfterthought = 0;
            problem.begin(planner, parameters);
            return planner.solve(afterAsking(5000), {});
        };
        const double longest = SearchTuning().longestToRelax;
        PathPlanner with, without;
        if (solve(without, Relaxing::Never, longest) != PathPlanner::Outcome::Solved)
            continue;
        ++solved;
        ASSERT_EQ(solve(with, Relaxing::Usual, longest), PathPlanner::Outcome::Solved);
        ASSERT_EQ(faultOf(with.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
        ASSERT_LE(with.bestCost(), without.bestCost() + 1e-9);
        const double promised = std::max(without.search().shortestMotion(), without.search().estimate());
        const double dearness = without.bestCost() / promised;
        const bool isTooLong = without.bestPath().length() >= longest * TURNING_RADIUS;
        const bool isRelaxed = with.statistics().connections != without.statistics().connections;
        const bool isDue = dearness > SearchTuning().dearToRelaxOnce && !isTooLong;
        ASSERT_TRUE(isDue || !isRelaxed) << dearness;
        if (without.search().expanded() > 0 && without.bestPath().pieces.size() > 1)
        {
            ASSERT_TRUE(isRelaxed || !isDue) << dearness;
        }
        ASSERT_TRUE(isRelaxed || isSamePath(with.bestPath(), without.bestPath()));
        cheap += !isRelaxed;
        PathPlanner once;
        ASSERT_EQ(solve(once, Relaxing::OnceAtMost, longest), PathPlanner::Outcome::Solved);
        if (dearness <= SearchTuning().dearToRelax)
        {
            ASSERT_EQ(with.statistics().connections, once.statistics().connections);
        }
        if (!(with.bestCost() < without.bestCost() - 1e-6))
            continue;
        ++(dearness <= SearchTuning().dearToRelax ? cheaperByOne : cheaperBySeveral);
        // Not so if it were too long for that.
        ASSERT_EQ(solve(with, Relaxing::Usual, 0.0), PathPlanner::Outcome::Solved);
        ASSERT_TRUE(isSamePath(with.bestPath(), without.bestPath()));
    }
    EXPECT_GT(solved, 100);
    EXPECT_GT(cheap, 50);
    EXPECT_GT(cheaperByOne, 5);
    EXPECT_GT(cheaperBySeveral, 5);
}

/** The first pass over a path that was found keeps to what is near, and each one after it reaches one cusp farther. */
TEST(PathRelaxer, reachesACuspFartherWithEachPassOverAFirstSolution)
{
    int differentByOne = 0, differentByTwo = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        const auto pathWith = [&](std::size_t passes, std::size_t cusps)
        {
            PathPlannerParameters parameters = plannerParameters(problem, Relaxing::Usual);
            parameters.search.tuning.relaxations = passes;
            parameters.search.tuning.relaxCusps = cusps;
            PathPlanner planner;
            problem.begin(planner, parameters);
            planner.solve(afterAsking(5000), {});
            return planner.bestPath();
        };
        const Path near = pathWith(1, 0);
        if (near.cusps() < 2)
            continue;
        ASSERT_TRUE(isSamePath(near, pathWith(1, 2)));
        ASSERT_TRUE(isSamePath(pathWith(2, 1), pathWith(2, 2)));
        differentByOne += !isSamePath(pathWith(2, 0), pathWith(2, 1));
        differentByTwo += !isSamePath(pathWith(3, 1), pathWith(3, 2));
    }
    EXPECT_GT(differentByOne, 2);
    EXPECT_GT(differentByTwo, 2);
}

namespace
{
    /** How many of some problems have a cheaper path, after so many expansions of anytime, with one tuning than with
        another; at most a third as many have a dearer one. First paths are not relaxed. */
    int cheaperProblems(SearchTuning tuning, SearchTuning other, std::uint64_t expansions)
    {
        const auto costAfter = [expansions](CarProblem &problem, const SearchTuning &tuned)
        {
            PathPlannerParameters parameters = plannerParameters(problem, Relaxing::Never);
            parameters.anytime = true;
            parameters.search.tuning = tuned;
            parameters.search.tuning.dearToRelax = parameters.search.tuning.dearToRelaxOnce = INFINITE;
            PathPlanner planner;
            problem.begin(planner, parameters);
            planner.solve(afterExpanding(planner, expansions), {});
            return planner.bestCost();
        };
        int cheaper = 0, dearer = 0;
        for (std::uint64_t seed = 0; seed < 80; ++seed)
        {
            CarProblem problem = randomProblem(seed, seed % 2 == 0 ? 10 : 16);
            const double cost = costAfter(problem, tuning), costOfOther = costAfter(problem, other);
            cheaper += cost < costOfOther - 1e-3 ? 1 : 0;
            dearer += cost > costOfOther + 1e-3 ? 1 : 0;
        }
        EXPECT_LE(dearer, cheaper / 3);
        return cheaper;
    }
}  // namespace

TEST(PathRelaxer, makesThePathsOfAnytimeCheaper)
{
    SearchTuning none, best, found;
    none.relaxations = none.relaxationsOfBest = 0;
    best.relaxations = 0;
    found.relaxationsOfBest = 0;
    EXPECT_GT(cheaperProblems(best, none, 100), 4) << "the best path";
    EXPECT_GT(cheaperProblems(found, none, 600), 2) << "what is found by beginning anew";
}

/** When a turn of all steps has helped another one is tried, and else none. */
TEST(PathRelaxer, goesOnWithTheBestPathAsLongAsItHelps)
{
    int again = 0, ended = 0;
    for (std::uint64_t seed = 0; seed < 240; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        PathPlannerParameters parameters = plannerParameters(problem, Relaxing::Never);
        parameters.anytime = true;
        parameters.search.tuning.relaxations = 0;
        parameters.search.tuning.relaxationsOfBest = 1;
        const auto plan = [&](PathPlanner &planner, std::size_t relaxationsPerRound)
        {
            parameters.search.tuning.relaxationsPerRound = relaxationsPerRound;
            problem.begin(planner, parameters);
            planner.solve(afterExpanding(planner, 100), {});
        };
        PathPlanner never, once, twice;
        plan(never, 0);
        plan(once, 1);
        plan(twice, 2);
        if (once.statistics().connections == never.statistics().connections)
            continue;
        const bool helped = once.bestCost() < never.bestCost() - 1e-4;
        const bool triedAgain = twice.statistics().connections > once.statistics().connections;
        ASSERT_LE(twice.bestCost(), once.bestCost() + 1e-9);
        again += helped && triedAgain ? 1 : 0;
        ended += !helped && !triedAgain ? 1 : 0;
    }
    EXPECT_GT(again, 3);
    EXPECT_GT(ended, 20);
}
