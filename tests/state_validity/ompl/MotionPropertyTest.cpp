// The promise of SweptMotionValidator, put to the oracle a hundred thousand times: no motion that it accepts touches an
// obstacle, looked at every millimetre.
#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <iomanip>
#include <memory>

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <gtest/gtest.h>

namespace ob = ompl::base;
using namespace parking;
using namespace parking_test;

namespace
{
    constexpr int ACCEPTED = 2000;  // in each world; fifty worlds

    struct Tally
    {
        int accepted{0};
        int rejected{0};
        int close{0};  ///< accepted motions that pass within five centimetres of an obstacle
    };

    /** \param rounding of poses in the world's coordinates, metres */
    void tryMotions(const World &world, std::uint64_t seed, Tally &tally, double rounding = 0.0)
    {
        const Vehicle vehicle;
        std::shared_ptr<ob::SE2StateSpace> space;
        if (seed % 5 == 0)
            space = std::make_shared<ob::DubinsStateSpace>(vehicle.minTurningRadius(), seed % 2 == 0);
        else
            space = std::make_shared<ob::ReedsSheppStateSpace>(vehicle.minTurningRadius());
        space->setBounds(positionBounds(world.bounds));
        const auto si = std::make_shared<ob::SpaceInformation>(space);
        si->setStateValidityChecker(std::make_shared<FclFootprintChecker>(si, world.obstacles, vehicle));
        const auto validator = std::make_shared<SweptMotionValidator>(si);
        si->setMotionValidator(validator);
        si->setup();

        ob::ScopedState<> from(si), to(si);
        Random random(seed);
        for (int accepted = 0; accepted < ACCEPTED;)
        {
            // Short motions, one in three from beside an obstacle: long ones rarely are free.
            const Pose start =
                random.chance(0.3) ? world.touching(random, vehicle, random.between(0.0, 0.3)) : world.anywhere(random);
            const double reach = random.between(0.2, 5.0);
            setPose(from.get(), start);
            setPose(to.get(), compose(start, {random.between(-reach, reach), 0.3 * random.between(-reach, reach),
                                              0.2 * random.between(-reach, reach)}));
            if (!si->isValid(from.get()))
                continue;
            if (!validator->checkMotion(from.get(), to.get()))
            {
                ++tally.rejected;
                continue;
            }
            ++accepted;
            ++tally.accepted;
            ReedsSheppCurve curve;
            validator->curveSpace().curve(from.get(), to.get(), curve);
            Pose pose = poseOf(from.get());
            bool close = false;
            for (std::size_t i = 0; i < curve.count; ++i)
            {
                const auto &[curvature, length] = curve.pieces[i];
                ASSERT_TRUE(world.oracle.isArcFree(pose, curvature, length, vehicle, 1e-3, -rounding))
                    << world.name << std::setprecision(17) << " piece " << i << " from " << pose.x << " " << pose.y
                    << " " << pose.yaw << " curvature " << curvature << " length " << length;
                close = close || !world.oracle.isFree(pose, vehicle, 0.05);
                pose = advance(pose, curvature, length);
            }
            tally.close += close;
        }
    }

    /** Worlds of one kind, where they lie, and how poses round there. */
    struct Place
    {
        const char *name;
        World (*make)(std::uint64_t seed, const Eigen::Vector2d &offset);
        Eigen::Vector2d offset;
        double rounding;  ///< metres
    };

    World polygonsOrCells(std::uint64_t seed, const Eigen::Vector2d &offset)
    {
        return seed % 2 ? randomGridWorld(seed, offset) : randomPolygonWorld(seed, offset);
    }

    const Place PLACES[] = {{"AmongPolygons", randomPolygonWorld, {0.0, 0.0}, 0.0},
                            {"OnGrids", randomGridWorld, {0.0, 0.0}, 0.0},
                            {"OnNoisyMaps", noisyGridWorld, {0.0, 0.0}, 0.0},
                            {"AThousandKilometresAway", polygonsOrCells, {1e6, -1e6}, 2e-9},
                            {"AtFourBillionMetres", polygonsOrCells, {4.1e9, -5.3e9}, 5e-6}};

    using MotionProperty = testing::TestWithParam<Place>;
}  // namespace

TEST_P(MotionProperty, AcceptedMotionsAreFree)
{
    const Place &place = GetParam();
    Tally tally;
    for (std::uint64_t seed = 10; seed < 20 && !HasFatalFailure(); ++seed)
        tryMotions(place.make(seed, place.offset), seed, tally, place.rounding);
    EXPECT_EQ(tally.accepted, 10 * ACCEPTED);
    EXPECT_GT(tally.rejected, tally.accepted / 10);
    EXPECT_GT(tally.close, tally.accepted / 50);
}

INSTANTIATE_TEST_SUITE_P(Places, MotionProperty, testing::ValuesIn(PLACES),
                         [](const auto &each) { return each.param.name; });
