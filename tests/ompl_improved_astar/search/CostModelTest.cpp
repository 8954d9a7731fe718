// What motions cost, against sums by hand and lengths measured in small steps.

#include "ompl_improved_astar/search/CostModel.h"
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
    CostModel randomModel(Random &random)
    {
        CostModel model;
        model.reversePenalty = random.chance(0.3) ? 0.0 : random.between(0.0, 1.0);
        model.gearChangePenalty = random.between(0.0, 2.0);
        model.steeringChangePenalty = random.between(0.0, 1.0);
        model.fullLockCurvature = 0.25;
        model.preferredClearance = random.chance(0.2) ? 0.0 : random.between(0.05, 0.5);
        model.clearanceCost = random.between(0.0, 5.0);
        return model;
    }

    /** A motion in steps of 5 mm. */
    struct Stepped
    {
        double least{1e9};    ///< gap in metres
        double nearer{0.0};   ///< metres on which the gap is below the clearance
        double clear{0.0};    ///< metres at the beginning on which it is not
        double changes{0.0};  ///< how often that changes
    };

    Stepped inSteps(const DiscCarWorld &world, const Pose &from, const PathPiece &piece, double clearance)
    {
        Stepped result;
        const double length = piece.driven(), steps = std::ceil(length / 0.005);
        bool before = true;
        for (double i = 0.0; i <= steps; i += 1.0)
        {
            const double gap = world.gap(advance(from, piece, length * i / steps));
            const bool isClear = gap >= clearance;
            result.least = std::min(result.least, gap);
            result.nearer += isClear ? 0.0 : length / (steps + 1.0);
            result.changes += isClear != before ? 1.0 : 0.0;
            if (result.changes == 0.0)
                result.clear = length * i / steps;
            before = isClear;
        }
        return result;
    }

    /** The same world to a search that cannot tell beforehand how far a clearance is kept. */
    class Unforeseeing : public DiscCarWorld
    {
    public:
        using DiscCarWorld::DiscCarWorld;
        explicit Unforeseeing(const DiscCarWorld &world) : DiscCarWorld(world)
        {
        }
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override
        {
            DiscCarWorld::freeLengths(from, arcs, count, clearance, lengths);
            if (clearance > 0.0)
                std::fill(lengths, lengths + count, 0.0);
        }
    };
}  // namespace

TEST(CostModel, proximityIsTheLengthDrivenNearerThanPreferred)
{
    int clear = 0, near = 0, partly = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        DiscCarWorld world = randomField(seed);
        Unforeseeing unforeseeing(world);
        Random random(seed);
        for (int i = 0; i < 50; ++i)
        {
            CostModel model;
            model.preferredClearance = random.between(0.05, 0.5);
            model.clearanceCost = random.between(0.5, 5.0);
            const Pose from = world.freePose(random);
            const PathPiece piece{random.between(-0.25, 0.25), random.magnitude(0.02, 6.0)};
            if (i % 2 == 0)  // hardly nearer anywhere
                model.preferredClearance =
                    std::max(0.02, inSteps(world, from, piece, 0.0).least + random.between(1.2e-3, 3e-3));
            const Stepped stepped = inSteps(world, from, piece, model.preferredClearance);
            const double length = piece.driven(), perMetre = model.clearanceCost;
            // A sample at each place where it becomes nearer or farther, and what the least stretch counts as.
            const double tolerance = perMetre * (model.sampleSpacing * stepped.changes + 0.3);
            const Pose to = advance(from, piece);
            for (DiscCarWorld *each : {&world, static_cast<DiscCarWorld *>(&unforeseeing)})
            {
                const double cost = model.proximity(from, piece, *each);
                ASSERT_NEAR(cost, perMetre * stepped.nearer, tolerance);
                ASSERT_LE(cost, perMetre * length + 1e-9);
                // Both directions, two parts.
                ASSERT_NEAR(model.proximity(to, piece.reversed(), *each), perMetre * stepped.nearer, tolerance);
                const PathPiece first{piece.curvature, 0.4 * piece.length}, rest{piece.curvature, 0.6 * piece.length};
                ASSERT_NEAR(model.proximity(from, first, *each) + model.proximity(advance(from, first), rest, *each),
                            perMetre * stepped.nearer, 2.0 * tolerance);
                ASSERT_TRUE(cost == 0.0 || stepped.least <= model.preferredClearance + 1e-3);
                ASSERT_TRUE(cost > perMetre * length - 1e-9 || stepped.nearer < length * (1.0 - 1e-9));
                // What costs nothing is clear everywhere, whatever lies between two samples.
                ASSERT_TRUE(cost > 0.0 || each != &world || stepped.least > model.preferredClearance - 1e-3);
                // What is known beforehand changes nothing, and a limit nothing below it.
                const double known = each->freeLength(from, {piece.curvature, piece.length}, model.preferredClearance);
                ASSERT_EQ(model.proximity(from, piece, *each, known), cost);
                for (const double max : {0.0, 0.5 * cost, cost, 2.0 * cost})
                {
                    const double limited = model.proximity(from, piece, *each, known, max);
                    ASSERT_EQ(limited > max, cost > max);
                    ASSERT_LE(limited, cost);
                }
                ++(cost == 0.0 ? clear : cost > perMetre * length - 1e-9 ? near : partly);
            }
            model.clearanceCost = 0.0;
            ASSERT_EQ(model.proximity(from, piece, world), 0.0);
        }
    }
    EXPECT_GT(clear, 500);
    EXPECT_GT(near, 300);
    EXPECT_GT(partly, 300);
}

TEST(CostModel, aPathCostsTheSumOfItsPiecesAndNeverLessThanItsLength)
{
    Random random(9);
    for (int i = 0; i < 400; ++i)
    {
        DiscCarWorld world = randomField(static_cast<std::uint64_t>(i) % 10);
        const CostModel model = randomModel(random);
        Path path{random.poseIn(-8.0, 8.0), {}};
        for (std::size_t count = random.index(7); count > 0; --count)
            path.pieces.push_back({random.between(-0.25, 0.25), random.magnitude(0.1, 4.0)});
        const PricedPath priced = price(model, path, world);
        ASSERT_EQ(priced.proximity.size(), path.pieces.size());
        double proximity = 0.0, cost = 0.0;
        Pose pose = path.start;
        EXPECT_EQ(model.join({0.0, 2.0, 0.05}, {0.1, 1.0}), 0.0) << "the wheels are turned on the way";
        for (std::size_t k = 0; k < path.pieces.size(); ++k)
        {
            const PathPiece &piece = path.pieces[k];
            ASSERT_NEAR(priced.proximity[k], model.proximity(pose, piece, world), 1e-9);
            proximity += priced.proximity[k];
            cost += piece.driven() * (piece.length < 0.0 ? 1.0 + model.reversePenalty : 1.0);
            if (k > 0)
            {
                const PathPiece &before = path.pieces[k - 1];
                cost += (before.length < 0.0) != (piece.length < 0.0) ? model.gearChangePenalty : 0.0;
                cost += model.steeringChangePenalty * std::abs(piece.curvature - before.curvature) / 0.25;
            }
            pose = advance(pose, piece);
        }
        ASSERT_NEAR(priced.totalProximity(), proximity, 1e-9);
        ASSERT_NEAR(priced.cost, cost + proximity, 1e-9);
        ASSERT_GE(priced.cost, path.length() - 1e-9);
    }
}

TEST(CostModel, aCurveCostsWhatItAddsToThePathItIsPutInto)
{
    DiscCarWorld world({{-90.0, -90.0}, {90.0, 90.0}});
    const ReedsShepp curves(4.0);
    Random random(3);
    std::vector<ReedsSheppCurve> words;
    for (int i = 0; i < 400; ++i)
    {
        const CostModel model = randomModel(random);
        const PathPiece before{random.between(-0.25, 0.25), random.magnitude(0.1, 4.0)},
            after{random.between(-0.25, 0.25), random.magnitude(0.1, 4.0)};
        const bool hasBefore = i % 2 == 0, hasAfter = i / 2 % 2 == 0;
        curves.candidates(random.poseIn(-8.0, 8.0), random.poseIn(-8.0, 8.0), words);
        for (const ReedsSheppCurve &curve : words)
        {
            Path path;
            path.pieces.assign(curve.pieces.begin(), curve.pieces.begin() + static_cast<std::ptrdiff_t>(curve.count));
            if (hasBefore)
                path.pieces.insert(path.pieces.begin(), before);
            if (hasAfter)
                path.pieces.push_back(after);
            const double outside = (hasBefore ? model.drive(before) : 0.0) + (hasAfter ? model.drive(after) : 0.0);
            ASSERT_NEAR(curveCost(model, curve, hasBefore ? &before : nullptr, hasAfter ? &after : nullptr),
                        price(model, path, world).cost - outside, 1e-9);
        }
    }
    EXPECT_EQ(curveCost({}, curves.shortest({}, {})), 0.0) << "there is nothing to drive";
}
