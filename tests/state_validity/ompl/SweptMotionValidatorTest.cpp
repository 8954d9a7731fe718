#include "state_validity/ompl/SweptMotionValidator.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/util/Exception.h>

#include <gtest/gtest.h>

namespace ob = ompl::base;
using namespace parking;
using namespace parking_test;

namespace
{
    constexpr double TOLERANCE = 1e-3;
    using SpacePtr = std::shared_ptr<ob::SE2StateSpace>;

    struct Planar
    {
        Planar(const SpacePtr &space, const ObstacleSet &obstacles, const Box &box)
        {
            space->setBounds(positionBounds(box));
            si = std::make_shared<ob::SpaceInformation>(space);
            checker = std::make_shared<FclFootprintChecker>(si, obstacles, vehicle);
            si->setStateValidityChecker(checker);
            validator = std::make_shared<SweptMotionValidator>(si);
            si->setMotionValidator(validator);
            si->setup();
        }

        Vehicle vehicle;
        ob::SpaceInformationPtr si;
        std::shared_ptr<FclFootprintChecker> checker;
        std::shared_ptr<SweptMotionValidator> validator;
    };

    SpacePtr reedsShepp()
    {
        return std::make_shared<ob::ReedsSheppStateSpace>(3.0056);
    }
    SpacePtr dubins()
    {
        return std::make_shared<ob::DubinsStateSpace>(3.0056);
    }
    SpacePtr symmetricDubins()
    {
        return std::make_shared<ob::DubinsStateSpace>(3.0056, true);
    }
    SpacePtr plain()
    {
        return std::make_shared<ob::SE2StateSpace>();
    }

    Pose between(const Planar &setup, const ob::State *a, const ob::State *b, double t, ob::State *scratch)
    {
        setup.si->getStateSpace()->interpolate(a, b, t, scratch);
        return poseOf(scratch);
    }

    /** Random motions between valid states, each judged by the oracle at the states that OMPL interpolates. */
    void expectSound(const SpacePtr &space, const World &world, int motions, std::uint64_t seed, double farthest)
    {
        const Planar setup(space, world.obstacles, world.bounds);
        ob::ScopedState<> a(setup.si), b(setup.si), last(setup.si), scratch(setup.si);
        Random random(seed);
        unsigned int accepted = 0, rejected = 0;
        for (int i = 0; i < motions;)
        {
            const Pose from = world.anywhere(random);
            const Pose to = {from.x + random.between(-farthest, farthest), from.y + random.between(-farthest, farthest),
                             from.yaw + random.between(-PI, PI) * random.between(0.0, 1.0) * random.between(0.0, 1.0)};
            setPose(a.get(), from);
            setPose(b.get(), to);
            if (!setup.si->isValid(a.get()))
                continue;
            ++i;
            const bool valid = setup.validator->checkMotion(a.get(), b.get());
            std::pair<ob::State *, double> lastValid{last.get(), -7.0};
            ASSERT_EQ(setup.validator->checkMotion(a.get(), b.get(), lastValid), valid);
            const double proven = valid ? 1.0 : lastValid.second;
            if (valid)
            {
                ++accepted;
                ASSERT_EQ(lastValid.second, -7.0) << "must stay as it was";
                ASSERT_TRUE(setup.si->isValid(b.get()));
            }
            else
            {
                ++rejected;
                ASSERT_GE(proven, 0.0);
                ASSERT_LT(proven, 1.0 + 1e-12);
                ASSERT_TRUE(setup.si->isValid(last.get()));
                const Pose there = between(setup, a.get(), b.get(), proven, scratch.get());
                ASSERT_NEAR(there.x, poseOf(last.get()).x, 1e-6);
                ASSERT_NEAR(there.y, poseOf(last.get()).y, 1e-6);
                ASSERT_NEAR(wrapAngle(there.yaw - poseOf(last.get()).yaw), 0.0, 1e-6);
            }
            // All that is proven is free.
            const double length = setup.si->distance(a.get(), b.get()) * (1.0 + std::abs(to.yaw - from.yaw));
            const int steps = static_cast<int>(length / 0.02) + 1;
            for (int k = 0; k <= steps; ++k)
            {
                const Pose pose = between(setup, a.get(), b.get(), proven * k / steps, scratch.get());
                ASSERT_TRUE(world.oracle.isFree(pose, setup.vehicle))
                    << world.name << std::setprecision(17) << " at " << proven * k / steps << " from " << from.x << " "
                    << from.y << " " << from.yaw << " to " << to.x << " " << to.y << " " << to.yaw;
            }
        }
        EXPECT_EQ(setup.validator->getValidMotionCount(), 2 * accepted);
        EXPECT_EQ(setup.validator->getInvalidMotionCount(), 2 * rejected);
        EXPECT_GT(accepted, static_cast<unsigned int>(motions) / 100);
        EXPECT_GT(rejected, static_cast<unsigned int>(motions) / 100);
    }
}  // namespace

TEST(SweptMotionValidator, IsSoundInReedsSheppSpaces)
{
    for (std::uint64_t seed = 0; seed < 10 && !HasFatalFailure(); ++seed)
        expectSound(reedsShepp(), seed % 2 ? randomGridWorld(seed) : randomPolygonWorld(seed), 300, seed, 3.0);
}

TEST(SweptMotionValidator, IsSoundInDubinsSpaces)
{
    for (std::uint64_t seed = 0; seed < 6 && !HasFatalFailure(); ++seed)
        expectSound(seed % 3 ? dubins() : symmetricDubins(),
                    seed % 2 ? randomGridWorld(seed) : randomPolygonWorld(seed), 120, seed, 3.0);
}

TEST(SweptMotionValidator, IsSoundInPlainSE2)
{
    for (std::uint64_t seed = 0; seed < 10 && !HasFatalFailure(); ++seed)
        expectSound(plain(), seed % 2 ? randomGridWorld(seed) : randomPolygonWorld(seed), 400, seed, 2.0);
}

/** Not only sound: what is free with twice the tolerance to spare is accepted. */
TEST(SweptMotionValidator, AcceptsWhatKeepsItsDistance)
{
    for (const SpacePtr &space : {reedsShepp(), dubins(), symmetricDubins(), plain()})
    {
        const World world = randomPolygonWorld(5);
        const Planar setup(space, world.obstacles, world.bounds);
        ob::ScopedState<> a(setup.si), b(setup.si), scratch(setup.si);
        Random random(5);
        int free = 0;
        for (int i = 0; i < 3000; ++i)
        {
            const Pose from = world.anywhere(random);
            setPose(a.get(), from);
            setPose(b.get(), {from.x + random.between(-2.0, 2.0), from.y + random.between(-2.0, 2.0),
                              from.yaw + random.between(-0.5, 0.5)});
            const int steps = static_cast<int>(setup.si->distance(a.get(), b.get()) / 0.02) + 2;
            // The body enlarged by what it can move between two looks and by twice the tolerance.
            bool spared = setup.si->satisfiesBounds(b.get());
            for (int k = 0; k <= steps && spared; ++k)
                spared =
                    world.oracle.isFree(between(setup, a.get(), b.get(), static_cast<double>(k) / steps, scratch.get()),
                                        setup.vehicle, 0.03 + 2.0 * TOLERANCE);
            if (!spared)
                continue;
            ++free;
            ASSERT_TRUE(setup.validator->checkMotion(a.get(), b.get())) << setup.si->getStateSpace()->getName();
        }
        EXPECT_GT(free, 30);
    }
}

/** A car may park a tenth of a millimetre from a wall: it drives up to it and away from it, on what is proven free. */
TEST(SweptMotionValidator, MotionsMayBeginAndEndWhereTheBodyAllButTouches)
{
    constexpr double RADIUS = 3.0056;
    for (const SpacePtr &space : {reedsShepp(), plain()})
    {
        const bool curved = dynamic_cast<ob::ReedsSheppStateSpace *>(space.get()) != nullptr;
        int upTo = 0, along = 0, accepted = 0;
        for (std::uint64_t seed = 0; seed < 24; ++seed)
        {
            const World world = randomPolygonWorld(seed);
            const Planar setup(space, world.obstacles, world.bounds);
            const FootprintChecker &footprint = setup.validator->footprint();
            ob::ScopedState<> a(setup.si), b(setup.si), scratch(setup.si);
            Random random(seed);
            CheckCounts counts;
            for (int i = 0; i < 300; ++i)
            {
                const Pose from = world.anywhere(random);
                const double curvature = curved ? (static_cast<int>(random.index(3)) - 1) / RADIUS : 0.0;
                const double length = random.chance(0.5) ? 3.0 : -3.0;
                const double free = footprint.freeLength(from, curvature, length, 1e-6, counts);
                const double back = std::pow(10.0, random.between(-6.0, -3.0));
                if (free == 3.0 || free < 0.1 || !(footprint.exactClearance(from) > 1.5 * TOLERANCE))
                    continue;
                const Pose near = advance(from, curvature, std::copysign(free - back, length));
                const double clearance = footprint.exactClearance(near);
                setPose(a.get(), from);
                setPose(b.get(), near);
                if (clearance > TOLERANCE || !setup.si->satisfiesBounds(b.get()))
                    continue;
                // Nowhere nearer than where it ends, and along that arc also by the space, which swerves along some
                // short straight lines.
                bool leaves = clearance > 2e-7 &&
                              std::max(setup.si->distance(a.get(), b.get()), setup.si->distance(b.get(), a.get())) <
                                  1.001 * (free - back);
                for (double driven = 0.0; driven < free - back && leaves; driven += 0.001)
                    leaves =
                        footprint.keeps(advance(from, curvature, std::copysign(driven, length)), clearance, counts);
                if (leaves)
                {
                    ++upTo;
                    ASSERT_TRUE(setup.validator->checkMotion(a.get(), b.get())) << clearance;
                    ASSERT_TRUE(setup.validator->checkMotion(b.get(), a.get())) << clearance;
                }
                // To the side as well: what is accepted is free.
                setPose(a.get(), compose(near, {random.between(-0.4, 0.4), random.between(-0.02, 0.02),
                                                random.between(-0.02, 0.02)}));
                for (const bool forth : {true, false})
                {
                    const ob::State *first = forth ? a.get() : b.get(), *second = forth ? b.get() : a.get();
                    ++along;
                    if (!setup.si->isValid(a.get()) || !setup.validator->checkMotion(first, second))
                        continue;
                    ++accepted;
                    const int steps = static_cast<int>(setup.si->distance(first, second) / 0.002) + 1;
                    for (int k = 0; k <= steps; ++k)
                        ASSERT_TRUE(world.oracle.isFree(
                            between(setup, first, second, static_cast<double>(k) / steps, scratch.get()),
                            setup.vehicle));
                }
            }
        }
        EXPECT_GT(upTo, 50);
        EXPECT_GT(accepted, 20);
        EXPECT_GT(along - accepted, 50);
    }
}

/** Too many questions for clearances, but from its end the arc is one that leaves. */
TEST(SweptMotionValidator, ABodyMayGlideUpToAWallThatHardlyConverges)
{
    constexpr double LENGTH = 3.0, SLOPE = 1e-4, GAP = 1e-6;
    const Vehicle car;
    const double front = car.wheelbase + car.frontOverhang, side = 0.5 * car.width + GAP;
    const Polygon wall = {
        {front - 8.0, side + 8.0 * SLOPE}, {front, side}, {front, side + 1.0}, {front - 8.0, side + 1.0}};
    const Box bounds{{-15.0, -15.0}, {15.0, 15.0}};
    const Planar setup(reedsShepp(), ObstacleSet::fromPolygons({wall}, bounds), bounds);
    ob::ScopedState<> far(setup.si), near(setup.si), beyond(setup.si);
    setPose(far.get(), {-LENGTH, 0.0, 0.0});
    setPose(near.get(), {0.0, 0.0, 0.0});
    setPose(beyond.get(), {0.0, 2.0 * GAP, 0.0});
    EXPECT_TRUE(setup.validator->checkMotion(far.get(), near.get()));
    EXPECT_TRUE(setup.validator->checkMotion(near.get(), far.get()));
    EXPECT_FALSE(setup.si->isValid(beyond.get()));
    EXPECT_FALSE(setup.validator->checkMotion(far.get(), beyond.get()));
}

/** A corner of the body swings past a post: what the enlarged body cannot do, clearances prove. */
TEST(SweptMotionValidator, ABodyMaySwingPastAPostWithinTheTolerance)
{
    constexpr double RADIUS = 3.0056;
    const Vehicle car;
    // The front corner's way round the centre of the turn, and the post's corner outside of it.
    const double swing = std::hypot(RADIUS + 0.5 * car.width, car.wheelbase + car.frontOverhang);
    for (const auto &[gap, free] : {std::pair(2e-3, true), {1.2e-3, true}, {2e-4, true}, {5e-5, false}, {-1e-6, false}})
        for (const SpacePtr &space : {reedsShepp(), dubins()})
        {
            const double x = (swing + gap) * std::sqrt(0.5), y = RADIUS - x;
            const Planar setup(space,
                               ObstacleSet::fromPolygons({{{x, y - 1.0}, {x + 1.0, y - 1.0}, {x + 1.0, y}, {x, y}}},
                                                         {{-15.0, -15.0}, {15.0, 15.0}}),
                               {{-15.0, -15.0}, {15.0, 15.0}});
            ob::ScopedState<> a(setup.si), b(setup.si);
            setPose(a.get(), advance({}, 1.0 / RADIUS, -0.9));
            setPose(b.get(), advance({}, 1.0 / RADIUS, 0.9));
            ASSERT_TRUE(setup.si->isValid(a.get()) && setup.si->isValid(b.get()));
            EXPECT_EQ(setup.validator->checkMotion(a.get(), b.get()), free) << gap;
            std::pair<ob::State *, double> last{nullptr, 1.0};
            EXPECT_EQ(setup.validator->checkMotion(a.get(), b.get(), last), free);
        }
}

/** In a parallel slot OMPL's own validators let curves through that cut a corner of a neighbour. */
TEST(SweptMotionValidator, LongCurvesAreCheckedBetweenTheirEnds)
{
    // A post that stands beside the middle of a straight motion of 12 m, and is cut by nothing but that.
    const Box box{{-20.0, -20.0}, {20.0, 20.0}};
    for (const double gap : {-0.01, 0.01})
    {
        const Vehicle vehicle;
        const Polygon post = rectangle(0.02, 0.02, {2.0, 0.5 * vehicle.width + 0.01 + gap, 0.0});
        for (const SpacePtr &space : {reedsShepp(), dubins(), plain()})
        {
            const Planar setup(space, ObstacleSet::fromPolygons({post}, box), box);
            ob::ScopedState<> a(setup.si), b(setup.si);
            setPose(a.get(), {-8.0, 0.0, 0.0});
            setPose(b.get(), {8.0, 0.0, 0.0});
            EXPECT_EQ(setup.validator->checkMotion(a.get(), b.get()), gap > 0.0);
            std::pair<ob::State *, double> lastValid{nullptr, 0.0};
            EXPECT_EQ(setup.validator->checkMotion(a.get(), b.get(), lastValid), gap > 0.0);
            if (gap > 0.0)
                continue;
            const double contact = (2.0 - 0.01 - vehicle.wheelbase - vehicle.frontOverhang + 8.0) / 16.0;
            EXPECT_LT(lastValid.second, contact);
            EXPECT_GT(lastValid.second, contact - 3.0 * TOLERANCE);
        }
    }
}

TEST(SweptMotionValidator, MotionsStayWithinTheBoundsOfTheSpace)
{
    // From one heading to the other with a turn in between that leads out of the bounds of the space, not of the world.
    const Box world{{-50.0, -50.0}, {50.0, 50.0}}, box{{-20.0, -20.0}, {20.0, 4.0}};
    for (const SpacePtr &space : {dubins(), symmetricDubins()})
    {
        const Planar setup(space, ObstacleSet::fromPolygons({}, world), box);
        ob::ScopedState<> a(setup.si), b(setup.si), last(setup.si);
        // A half circle to the left: the rear axle gets to y = 6.
        setPose(a.get(), {0.0, 0.0, 0.0});
        setPose(b.get(), {0.5, 3.9, PI});
        ASSERT_TRUE(setup.si->isValid(b.get()));
        std::pair<ob::State *, double> lastValid{last.get(), 0.0};
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get()));
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get(), lastValid));
        EXPECT_GT(lastValid.second, 0.05);
        EXPECT_TRUE(setup.si->satisfiesBounds(last.get()));
        const Pose pose = poseOf(last.get());
        EXPECT_NEAR(std::min({20.0 - std::abs(pose.x), 4.0 - pose.y}), 0.0, 1e-6) << "stops right at the bounds";
    }
}

TEST(SweptMotionValidator, TheEndMustBeValidByTheCheckerOfTheSpaceInformation)
{
    const Box box{{-20.0, -20.0}, {20.0, 20.0}};
    for (const SpacePtr &space : {reedsShepp(), plain()})
    {
        const Planar setup(space, ObstacleSet::fromPolygons({}, box), box);
        // Somebody else's checker on top: nothing beyond x = 1 is valid.
        setup.si->setStateValidityChecker([&setup](const ob::State *state)
                                          { return setup.checker->isValid(state) && poseOf(state).x < 1.0; });
        ob::ScopedState<> a(setup.si), b(setup.si), last(setup.si);
        setPose(a.get(), {0.0, 0.0, 0.0});
        setPose(b.get(), {2.0, 0.0, 0.0});
        std::pair<ob::State *, double> lastValid{last.get(), 0.5};
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get()));
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get(), lastValid));
        EXPECT_TRUE(setup.si->isValid(last.get()));
        EXPECT_EQ(lastValid.second, 0.0);
        // Only the end itself is not valid: the last valid state is right before it.
        setPose(b.get(), {1.0, 0.0, 0.0});
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get(), lastValid));
        EXPECT_TRUE(setup.si->isValid(last.get()));
        EXPECT_NEAR(lastValid.second, 1.0, 2.0 * TOLERANCE);
        EXPECT_LT(lastValid.second, 1.0);
    }
}

TEST(SweptMotionValidator, TheLastValidStateMayTakeThePlaceOfEitherEnd)
{
    const Box box{{-20.0, -20.0}, {20.0, 20.0}};
    for (const SpacePtr &space : {reedsShepp(), plain()})
        for (const bool first : {true, false})
            for (const double x : {7.0, 3.76})  // stopped on the way, and at once
            {
                const Planar setup(space, ObstacleSet::fromPolygons({rectangle(0.1, 4.0, {x + 0.051, 0.0, 0.0})}, box),
                                   box);
                ob::ScopedState<> a(setup.si), b(setup.si);
                setPose(a.get(), {0.0, 0.0, 0.0});
                setPose(b.get(), {12.0, 0.0, 0.0});
                std::pair<ob::State *, double> lastValid{first ? a.get() : b.get(), -1.0};
                EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get(), lastValid));
                EXPECT_NEAR(poseOf(lastValid.first).x, std::max(0.0, x - 3.76), 5.0 * TOLERANCE);
                EXPECT_NEAR(lastValid.second, std::max(0.0, x - 3.76) / 12.0, TOLERANCE);
            }
}

TEST(SweptMotionValidator, StatesThatAreTheSameAndStatesThatAreNotFinite)
{
    const Box box{{-20.0, -20.0}, {20.0, 20.0}};
    for (const SpacePtr &space : {reedsShepp(), dubins(), symmetricDubins(), plain()})
    {
        const Planar setup(space, ObstacleSet::fromPolygons({}, box), box);
        ob::ScopedState<> a(setup.si), b(setup.si), last(setup.si);
        setPose(a.get(), {1.0, 2.0, 3.0});
        b = a;
        EXPECT_TRUE(setup.validator->checkMotion(a.get(), b.get()));
        auto *bad = b->as<ob::SE2StateSpace::StateType>();
        bad->setX(std::numeric_limits<double>::quiet_NaN());
        std::pair<ob::State *, double> lastValid{last.get(), 0.5};
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get()));
        EXPECT_FALSE(setup.validator->checkMotion(a.get(), b.get(), lastValid));
        EXPECT_EQ(lastValid.second, 0.0);
        EXPECT_EQ(poseOf(last.get()).x, 1.0);
    }
}

TEST(SweptMotionValidator, RefusesBadInput)
{
    const Box box{{-20.0, -20.0}, {20.0, 20.0}};
    const Planar setup(reedsShepp(), ObstacleSet::fromPolygons({}, box), box);
    for (const double tolerance : {0.0, -1e-3, 0.2, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(SweptMotionValidator(setup.si, tolerance), ompl::Exception) << tolerance;
    EXPECT_EQ(SweptMotionValidator(setup.si, 0.01).tolerance(), 0.01);
    EXPECT_THROW(SweptMotionValidator(setup.si, nullptr), ompl::Exception);
    const auto other = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::SE3StateSpace>());
    EXPECT_THROW(SweptMotionValidator(other, setup.checker->sharedFootprint()), ompl::Exception);
    const auto without = std::make_shared<ob::SpaceInformation>(reedsShepp());
    EXPECT_THROW(SweptMotionValidator{without}, ompl::Exception);
}
