#include "state_validity/sweeps/SweptBox.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/sweeps/SweepFront.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    /** A car whose rectangle is the box and whose rear axle is its guided point. */
    Vehicle vehicleOf(const BoxSweep &sweep)
    {
        Vehicle vehicle;
        vehicle.rearOverhang = sweep.halfLength + sweep.axle;
        vehicle.frontOverhang = 0.3 * (sweep.halfLength - sweep.axle);
        vehicle.wheelbase = sweep.halfLength - sweep.axle - vehicle.frontOverhang;
        vehicle.width = 2.0 * sweep.halfWidth;
        return vehicle;
    }

    /** The oracle for one segment, told in the frame of the box at the beginning. */
    PolygonOracle oracleOf(const Edge &edge)
    {
        return {{{edge.from, edge.to}}, {{-1e4, -1e4}, {1e4, 1e4}}};
    }

    Pose axleAt(const BoxSweep &sweep, double driven)
    {
        return advance({sweep.axle, 0.0, 0.0}, sweep.curvature, sweep.direction * driven);
    }

    /** Curvatures of all kinds: straight, all but straight, a car's, a circle whose centre lies within the box. */
    double anyCurvature(Random &random)
    {
        switch (random.index(5))
        {
            case 0:
                return 0.0;
            case 1:
                return random.magnitude(1e-13, 1e-3);
            case 2:
                return random.magnitude(1e-3, 0.1);
            case 3:
                return random.magnitude(0.1, 0.6);
            default:
                return random.magnitude(0.6, 5.0);
        }
    }

    BoxSweep anySweep(Random &random)
    {
        BoxSweep sweep{};
        sweep.halfLength = random.between(0.5, 3.0);
        sweep.halfWidth = random.between(0.3, 1.2);
        sweep.axle = -random.between(0.0, 0.95) * sweep.halfLength;
        sweep.curvature = anyCurvature(random);
        sweep.direction = random.chance(0.5) ? 1.0 : -1.0;
        sweep.length = std::min(random.between(0.01, 2.0), 2.9 / (std::abs(sweep.curvature) + 1e-9));
        return sweep;
    }

    double contactOf(const EdgeIndex &index, const OrientedBox &box, const BoxSweep &sweep)
    {
        const double half = 0.5 * std::abs(sweep.curvature) * sweep.length;
        return index.firstContact(box, sweep, std::cos(half), std::sin(half));
    }

    Edge anyEdge(Random &random)
    {
        const Eigen::Vector2d from(random.between(-6.0, 6.0), random.between(-5.0, 5.0));
        const double length = std::abs(random.magnitude(1e-3, 20.0)), angle = random.between(-PI, PI);
        return {from, from + length * Eigen::Vector2d(std::cos(angle), std::sin(angle))};
    }
}  // namespace

TEST(SweptBox, FirstContactIsWhereTheOracleSeesIt)
{
    Random random(11);
    int contacts = 0, misses = 0;
    while (contacts < 4000)
    {
        const BoxSweep sweep = anySweep(random);
        const Edge edge = anyEdge(random);
        const Vehicle vehicle = vehicleOf(sweep);
        const PolygonOracle oracle = oracleOf(edge);
        if (!oracle.isFree(axleAt(sweep, 0.0), vehicle))
            continue;
        const double contact = firstContact(sweep, edge.from.x(), edge.from.y(), edge.to.x(), edge.to.y());
        const bool met = contact <= sweep.length;
        contacts += met;
        misses += !met;
        const double clear = met ? contact : sweep.length;
        const double step = sweep.length / 200.0;
        for (double driven = 0.0; driven < clear; driven += step)
            ASSERT_TRUE(oracle.isFree(axleAt(sweep, std::min(driven, clear)), vehicle, -1e-9))
                << "at " << driven << " of " << clear << ", curvature " << sweep.curvature;
        // A hair before the contact the box is free, and there it touches.
        ASSERT_TRUE(oracle.isFree(axleAt(sweep, clear), vehicle, -1e-10)) << sweep.curvature;
        ASSERT_FALSE(met && oracle.isFree(axleAt(sweep, contact), vehicle, 1e-10))
            << sweep.curvature << " " << oracle.clearance(axleAt(sweep, contact), vehicle);
    }
    EXPECT_GT(misses, 1000);
}

TEST(SweptBox, FindsTheContactAtTheVeryEndAndNoneBeyond)
{
    // Straight on to a wall 1 m ahead of the bumper, and to one that a corner reaches on an arc.
    const BoxSweep straight{2.0, 1.0, -1.0, 0.0, 1.0, 1.0};
    EXPECT_NEAR(firstContact(straight, 3.0, -5.0, 3.0, 5.0), 1.0, 1e-12);
    EXPECT_TRUE(std::isinf(firstContact(straight, 3.0 + 1e-9, -5.0, 3.0 + 1e-9, 5.0)));

    BoxSweep arc{2.0, 1.0, -1.0, 0.2, 1.0, 1.0};
    const Vehicle vehicle = vehicleOf(arc);
    const double top = vehicle.footprint(axleAt(arc, 1.0))[2].y();  // of the front left corner, which rises
    EXPECT_NEAR(firstContact(arc, -9.0, top - 1e-9, 9.0, top - 1e-9), 1.0, 1e-7);
    EXPECT_TRUE(std::isinf(firstContact(arc, -9.0, top + 1e-9, 9.0, top + 1e-9)));
}

TEST(SweptBox, ReverseIsTheMirrorImage)
{
    Random random(12);
    for (int i = 0; i < 20000; ++i)
    {
        BoxSweep sweep = anySweep(random);
        const Edge edge = anyEdge(random);
        if (!oracleOf(edge).isFree(axleAt(sweep, 0.0), vehicleOf(sweep)))
            continue;
        const double contact = firstContact(sweep, edge.from.x(), edge.from.y(), edge.to.x(), edge.to.y());
        BoxSweep mirrored = sweep;
        mirrored.direction = -sweep.direction;
        mirrored.axle = -sweep.axle;
        ASSERT_EQ(contact, firstContact(mirrored, -edge.from.x(), edge.from.y(), -edge.to.x(), edge.to.y()));
    }
}

/** The fast way over many edges gives what the plain way gives, one edge after the other. */
TEST(EdgeIndex, FirstContactIsThatOfTheNearestEdge)
{
    Random random(13);
    int contacts = 0, fast = 0;
    for (int world = 0; world < 60; ++world)
    {
        const double slack = 1.0;
        const Box bounds{{-8.0, -8.0}, {8.0, 8.0}};
        std::vector<Edge> edges;
        for (int i = 0; i < 3 + world; ++i)
        {
            Edge edge = anyEdge(random);
            if (random.chance(0.3))
                edge.to.y() = edge.from.y();
            edges.push_back(edge);
        }
        for (int i = 0; i < 400; ++i)
        {
            BoxSweep sweep = anySweep(random);
            sweep.length = std::min({sweep.length, 1.0 / (std::abs(sweep.curvature) + 1e-9),
                                     0.99 * slack / std::hypot(1.0, sweep.curvature * sweep.axle)});
            const EdgeIndex index(edges, bounds, std::hypot(sweep.halfLength, sweep.halfWidth) + slack);
            for (int k = 0; k < 5; ++k)
            {
                const Pose centre{random.between(-8.0, 8.0), random.between(-8.0, 8.0), random.between(-PI, PI)};
                const OrientedBox box{centre.x,         centre.y,       std::cos(centre.yaw), std::sin(centre.yaw),
                                      sweep.halfLength, sweep.halfWidth};
                if (index.separation(box) < 1e-6)
                    continue;
                fast += SweepFront::applies(sweep);
                BoxSweep longer = sweep;
                longer.length += OVERRUN;
                double expected = std::numeric_limits<double>::infinity();
                for (const Edge &edge : edges)
                {
                    const Pose a = relativeTo(centre, {edge.from.x(), edge.from.y(), 0.0});
                    const Pose b = relativeTo(centre, {edge.to.x(), edge.to.y(), 0.0});
                    expected = std::min(expected, firstContact(longer, a.x, a.y, b.x, b.y));
                }
                const double contact = contactOf(index, box, sweep);
                contacts += contact <= sweep.length;
                if (expected > sweep.length && contact > sweep.length)
                    continue;  // in the overrun: some of it may be reported, none must be
                ASSERT_NEAR(contact, expected, 1e-9) << "curvature " << sweep.curvature << " length " << sweep.length
                                                     << " direction " << sweep.direction;
            }
        }
    }
    EXPECT_GT(contacts, 5000);
    EXPECT_GT(fast, 10000);
}

/** A contact just beyond the end is reported, so that none is lost where a motion is cut in two. */
TEST(EdgeIndex, FirstContactLooksAHairBeyondTheEnd)
{
    const Box bounds{{-8.0, -8.0}, {8.0, 8.0}};
    for (const double curvature : {0.0, 1e-6, 0.2, -0.2, 0.45})
        for (const double direction : {1.0, -1.0})
        {
            const BoxSweep sweep{2.0, 1.0, -1.0, curvature, direction, 0.25};
            const Vehicle vehicle = vehicleOf(sweep);
            // A point that the middle of the leading side reaches at the length plus half the overrun.
            const Pose at = axleAt(sweep, sweep.length + 0.5 * OVERRUN);
            const double ahead = direction > 0.0 ? sweep.halfLength - sweep.axle : -sweep.halfLength - sweep.axle;
            const Pose place = compose(at, {ahead, 0.0, 0.0});
            const Pose beyond = compose(place, {direction * 1e-3, 0.0, 0.0});
            const EdgeIndex index({{{place.x, place.y}, {beyond.x, beyond.y}}}, bounds, 5.0);
            const double contact = contactOf(index, {0.0, 0.0, 1.0, 0.0, 2.0, 1.0}, sweep);
            EXPECT_GT(contact, sweep.length - 1e-9) << curvature;
            EXPECT_LT(contact, sweep.length + OVERRUN) << curvature;
        }
}

TEST(EdgeIndex, SeparationAndDistanceAreTheOracles)
{
    Random random(14);
    int apart = 0, crossing = 0;
    for (int world = 0; world < 40; ++world)
    {
        const Box bounds{{-8.0, -8.0}, {8.0, 8.0}};
        std::vector<Edge> edges;
        std::vector<Polygon> lines;
        for (int i = 0; i < 2 + world; ++i)
        {
            edges.push_back(anyEdge(random));
            lines.push_back({edges.back().from, edges.back().to});
        }
        const PolygonOracle oracle(lines, {{-1e3, -1e3}, {1e3, 1e3}});
        const Vehicle vehicle;
        const double middle = vehicle.centreOffset();
        const double halfLength = 0.5 * vehicle.length(), halfWidth = 0.5 * vehicle.width;
        const double reach = 1.0;
        const EdgeIndex index(edges, bounds, std::hypot(halfLength, halfWidth) + reach);
        for (int i = 0; i < 1500; ++i)
        {
            const Pose centre{random.between(-8.0, 8.0), random.between(-8.0, 8.0), random.between(-PI, PI)};
            const Pose pose = compose(centre, {-middle, 0.0, 0.0});
            const OrientedBox box{centre.x, centre.y, std::cos(pose.yaw), std::sin(pose.yaw), halfLength, halfWidth};
            const double separation = index.separation(box), expected = oracle.clearance(pose, vehicle);
            if (expected > reach)
            {
                ASSERT_GT(separation, 0.7 * reach);
                continue;
            }
            ASSERT_NEAR(index.distance(box), expected, 1e-12);
            ASSERT_LE(separation, expected + 1e-12);
            if (expected > 0.0)
            {
                ++apart;
                ASSERT_GE(separation, std::sqrt(0.5) * expected - 1e-12);
                ASSERT_EQ(index.side(box, 0.9 * separation), 1);
                ASSERT_EQ(index.side(box, 1.1 * separation), 0);
            }
            else
            {
                ++crossing;
                ASSERT_LE(separation, 0.0);
                ASSERT_EQ(index.side(box, 0.9 * -separation), separation < 0.0 ? -1 : 0);
            }
            // Told apart only as far as asked.
            const double ignored = random.between(0.0, 1.0);
            const double asked = index.separation(box, ignored);
            ASSERT_TRUE(separation < ignored ? asked == separation : asked >= ignored);
        }
    }
    EXPECT_GT(apart, 3000);
    EXPECT_GT(crossing, 3000);
}

/** Also for edges whose very corner lies on the border of what a bucket holds, so that no length of them is left. */
TEST(EdgeIndex, PointDistancesAreThoseOfTheNearestEdge)
{
    Random random(15);
    int near = 0;
    for (int world = 0; world < 40; ++world)
    {
        const double reach = 1.5;
        std::vector<Edge> edges;
        for (int i = 0; i < 1 + world; ++i)
            edges.push_back(anyEdge(random));
        for (int i = -6; i <= 6; ++i)  // buckets are a metre wide and keep what is sqrt(2) / 2 m farther than the reach
            edges.push_back({{i - reach + 0.5 - std::sqrt(0.5), 0.5 + i}, {i - 40.0, 0.5 + i}});
        const EdgeIndex index(edges, {{-8.0, -8.0}, {8.0, 8.0}}, reach);
        for (int i = 0; i < 1500; ++i)
        {
            const Eigen::Vector2d point(random.between(-8.0, 8.0), random.between(-8.0, 8.0));
            double expected = std::numeric_limits<double>::infinity();
            for (const Edge &edge : edges)
            {
                const Eigen::Vector2d along = edge.to - edge.from;
                const double share = std::clamp((point - edge.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
                expected = std::min(expected, (edge.from + share * along - point).norm());
            }
            const double distance = index.distance(point.x(), point.y());
            ASSERT_GE(distance, expected - 1e-9);
            if (expected > reach)
                continue;
            ++near;
            ASSERT_NEAR(distance, expected, 1e-9);
        }
    }
    EXPECT_GT(near, 20000);
}

/** Where cells hold many blocks, others hold none, and edges cross the borders between them and that of the world. */
TEST(EdgeIndex, NoneOfManyEdgesIsMissed)
{
    Random random(16);
    const Vehicle vehicle;
    const double halfLength = 0.5 * vehicle.length(), halfWidth = 0.5 * vehicle.width, reach = 1.0;
    int near = 0;
    for (const int count : {8, 9, 100, 2000})
    {
        std::vector<Edge> edges;
        std::vector<Polygon> lines;
        for (int i = 0; i < count; ++i)
        {
            const Eigen::Vector2d from(random.between(-21.0, 21.0), std::round(random.between(-12.0, 6.0)));
            const double length = random.chance(0.1) ? 6.0 : 0.2;
            const Eigen::Vector2d along(random.between(-length, length), random.between(-length, length));
            edges.push_back({from, from + (random.chance(0.5) ? Eigen::Vector2d(along.x(), 0.0) : along)});
            lines.push_back({edges.back().from, edges.back().to});
            if (random.chance(0.1))
                edges.push_back({from, from});  // no edge at all
        }
        const EdgeIndex index(edges, {{-20.0, -11.0}, {20.0, 11.0}}, std::hypot(halfLength, halfWidth) + reach);
        const PolygonOracle oracle(lines, {{-1e3, -1e3}, {1e3, 1e3}});
        for (int i = 0; i < 600; ++i)
        {
            const Pose centre{random.between(-20.0, 20.0), random.between(-11.0, 11.0), random.between(-PI, PI)};
            const Pose pose = compose(centre, {-vehicle.centreOffset(), 0.0, 0.0});
            const OrientedBox box{centre.x, centre.y, std::cos(pose.yaw), std::sin(pose.yaw), halfLength, halfWidth};
            const double expected = oracle.clearance(pose, vehicle);
            const double distance = index.distance(box), separation = index.separation(box);
            ASSERT_NEAR(index.distanceToAll(box), expected, 1e-9) << count;
            ASSERT_GE(distance, expected - 1e-9) << count;
            ASSERT_EQ(index.isSeparate(box, 0.1), separation >= 0.1) << count;
            if (expected > reach)
                continue;
            ++near;
            ASSERT_NEAR(distance, expected, 1e-9) << count;
            ASSERT_LE(separation, expected + 1e-9) << count;
            ASSERT_GE(separation, expected > 0.0 ? std::sqrt(0.5) * expected - 1e-9 : -1e3) << count;
        }
    }
    EXPECT_GT(near, 1000);
}
