// The cheapest free curves between two poses, against every word driven in small steps.

#include "ompl_improved_astar/search/models/FreeCurves.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double SURELY = 2e-3;  // metres: what is nearer to obstacles may count either way
    constexpr double RADIUS = 3.0;

    /** A word, priced and driven in steps of a centimetre. */
    struct Word
    {
        ReedsSheppCurve curve;
        double cost;   ///< without proximity
        double whole;  ///< with it
        double gap;    ///< least on the way
    };

    Path pathOf(const Pose &from, const ReedsSheppCurve &curve)
    {
        Path path{from, {}};
        path.pieces.assign(curve.pieces.begin(), curve.pieces.begin() + static_cast<std::ptrdiff_t>(curve.count));
        return path;
    }

    bool isSame(const ReedsSheppCurve &a, const ReedsSheppCurve &b)
    {
        const auto isSamePiece = [](const Arc &one, const Arc &other)
        {
            return one.curvature == other.curvature && one.length == other.length;
        };
        return a.count == b.count &&
               std::equal(a.pieces.begin(), a.pieces.begin() + static_cast<std::ptrdiff_t>(a.count), b.pieces.begin(),
                          isSamePiece);
    }
}  // namespace

TEST(FreeCurves, offersTheFreeWordsThatCostLessThanTheBoundCheapestFirst)
{
    int offers = 0, tooCostly = 0, notFree = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        DiscCarWorld world = randomField(seed, 6);
        Random random(seed + 20);
        for (int i = 0; i < 12; ++i)
        {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", gap " << i);
            const ReedsShepp curves(RADIUS, i % 4 == 3 ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
            CostModel cost;
            cost.reversePenalty = random.between(0.0, 0.5);
            cost.gearChangePenalty = random.between(0.0, 1.0);
            cost.steeringChangePenalty = random.between(0.0, 0.3);
            cost.fullLockCurvature = 1.0 / RADIUS;
            cost.preferredClearance = i % 3 == 0 ? 0.0 : random.between(0.02, 0.4);
            cost.clearanceCost = 4.0;
            const Pose from = world.freePose(random);
            Pose to = advance(from, random.between(-0.3, 0.3), random.magnitude(1.0, 10.0));
            to = {to.x + random.between(-2.0, 2.0), to.y + random.between(-2.0, 2.0),
                  to.yaw + random.between(-1.0, 1.0)};
            if (world.gap(to) <= 0.02)
                continue;
            const PathPiece before{random.between(-0.3, 0.3), random.magnitude(0.5, 2.0)},
                after{random.between(-0.3, 0.3), random.magnitude(0.5, 2.0)};
            FreeCurves::Gap gap{from, to, i % 2 ? &before : nullptr, i % 5 ? &after : nullptr, HUGE_VAL};
            std::vector<ReedsSheppCurve> candidates;
            curves.candidates(from, to, candidates);
            std::vector<Word> words;
            for (const ReedsSheppCurve &curve : candidates)
            {
                const double own = curveCost(cost, curve, gap.before, gap.after);
                const PricedPath priced = price(cost, pathOf(from, curve), world);
                words.push_back({curve, own, own + priced.totalProximity(), leastGap(world, priced.path)});
            }
            std::sort(words.begin(), words.end(), [](const Word &a, const Word &b) { return a.cost < b.cost; });
            gap.maxCost = i % 3 == 1 ? HUGE_VAL : words.front().cost * random.between(1.0, 3.0);
            gap.end = random.chance(0.5) ? FreeCurves::SweepEnd::Start : FreeCurves::SweepEnd::Goal;
            gap.maxCurves = i % 6 == 5 ? 1 + random.index(6) : FreeCurves::MAX_CURVES;
            std::vector<bool> isOffered(words.size(), false);
            double dearest = 0.0, cheapest = HUGE_VAL;
            FreeCurves freeCurves(world, curves, cost);
            EXPECT_FALSE(freeCurves.connect(gap,
                                            [&](const ReedsSheppCurve &curve, double whole)
                                            {
                                                EXPECT_GE(whole, dearest) << "in the order of cost";
                                                dearest = whole;
                                                cheapest = std::min(cheapest, whole);
                                                std::size_t k = 0;
                                                while (k < words.size() &&
                                                       (isOffered[k] || !isSame(words[k].curve, curve)))
                                                    ++k;
                                                EXPECT_LT(k, words.size()) << "no word, or twice";
                                                if (k == words.size())
                                                    return true;
                                                isOffered[k] = true;
                                                EXPECT_NEAR(whole, words[k].whole, 1e-9);
                                                return false;
                                            }));
            for (std::size_t k = 0; k < words.size(); ++k)
            {
                const Word &word = words[k];
                const bool isCheap = word.whole < gap.maxCost, isTried = k < gap.maxCurves;
                ++(isOffered[k] ? offers : !isCheap ? tooCostly : notFree);
                ASSERT_TRUE(!isOffered[k] || (word.gap > 0.0 && isCheap && isTried));
                ASSERT_TRUE(isOffered[k] || !(word.gap > SURELY && isCheap && isTried));
            }
            // The first that is taken ends it.
            int asked = 0;
            EXPECT_EQ(freeCurves.connect(gap,
                                         [&](const ReedsSheppCurve &, double whole)
                                         {
                                             ++asked;
                                             EXPECT_EQ(whole, cheapest);
                                             return true;
                                         }),
                      cheapest < HUGE_VAL);
            EXPECT_LE(asked, 1);
        }
    }
    EXPECT_GT(offers, 500);
    EXPECT_GT(tooCostly, 500);
    EXPECT_GT(notFree, 500);
}

TEST(FreeCurves, theQuickBoundIsNeverAboveACurve)
{
    Random random(2);
    for (const double radius : {0.3, 3.0})
        for (const CurveFamily family : {CurveFamily::ReedsShepp, CurveFamily::Dubins})
            for (int i = 0; i < 5000; ++i)
            {
                const Pose from = random.poseIn(-5.0, 5.0), to = random.poseIn(-5.0, 5.0);
                ASSERT_LE(minCurveLength(from, to, radius), ReedsShepp(radius, family).distance(from, to) + 1e-6);
            }
}
