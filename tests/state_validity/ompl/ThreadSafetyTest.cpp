// Const calls from several threads at once give what one thread gets; with the thread sanitizer this shows that they do
// not race. The lists of edges are gathered and FCL's world is built while others ask for them.
#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/fcl/FclContactTest.h"
#include "state_validity/ompl/CircleValidityChecker.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <atomic>
#include <memory>
#include <thread>

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <gtest/gtest.h>

namespace ob = ompl::base;
using namespace parking;
using namespace parking_test;

namespace
{
    constexpr std::size_t THREADS = 4;
    constexpr std::size_t POSES = 3000;

    struct Answer
    {
        bool free, freeByFcl, valid, motion, circle;
        double clearance, length;

        bool operator==(const Answer &other) const
        {
            return free == other.free && freeByFcl == other.freeByFcl && valid == other.valid &&
                   motion == other.motion && circle == other.circle && clearance == other.clearance &&
                   length == other.length;
        }
    };

    struct Checkers
    {
        explicit Checkers(const World &world)
        {
            const auto space = std::make_shared<ob::ReedsSheppStateSpace>(3.0);
            space->setBounds(positionBounds(world.bounds));
            si = std::make_shared<ob::SpaceInformation>(space);
            footprint = std::make_shared<FclFootprintChecker>(si, world.obstacles, Vehicle());
            fcl = std::make_shared<PlainFclChecker>(world.obstacles, Vehicle());
            si->setStateValidityChecker(footprint);
            motion = std::make_shared<SweptMotionValidator>(si);
            si->setMotionValidator(motion);
            si->setup();
            circle = std::make_shared<CircleValidityChecker>(si, world.obstacles, 1.0);
        }

        Answer ask(const Pose &pose, const Pose &next, ob::State *a, ob::State *b) const
        {
            setPose(a, pose);
            setPose(b, next);
            const FootprintChecker &checker = footprint->footprint();
            return {checker.isFree(pose),
                    fcl->isFree(pose),
                    footprint->isValid(a),
                    motion->checkMotion(a, b),
                    circle->circle().isFree(pose.x, pose.y),
                    checker.clearance(pose),
                    checker.freeLength(pose, 0.3, 2.0)};
        }

        ob::SpaceInformationPtr si;
        std::shared_ptr<FclFootprintChecker> footprint;
        std::shared_ptr<PlainFclChecker> fcl;
        std::shared_ptr<SweptMotionValidator> motion;
        std::shared_ptr<CircleValidityChecker> circle;
    };

    void expectSameFromAllThreads(const World &world)
    {
        Random random(1);
        std::vector<Pose> poses;
        for (std::size_t i = 0; i <= POSES; ++i)
            poses.push_back(i % 4 == 0 ? world.touching(random, Vehicle(), 0.0) : world.anywhere(random));

        const Checkers alone(world), shared(world);
        std::vector<Answer> expected;
        {
            ob::ScopedState<> a(alone.si), b(alone.si);
            for (std::size_t i = 0; i < POSES; ++i)
                expected.push_back(alone.ask(poses[i], poses[i + 1], a.get(), b.get()));
        }
        std::vector<std::size_t> wrong(THREADS, 0);
        std::atomic<std::size_t> ready{0};
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < THREADS; ++t)
            threads.emplace_back(
                [&, t]
                {
                    ob::ScopedState<> a(shared.si), b(shared.si);
                    ++ready;
                    while (ready < THREADS)
                        std::this_thread::yield();
                    for (std::size_t i = 0; i < POSES; ++i)
                    {
                        // Two threads go the one way, two the other.
                        const std::size_t k = t % 2 ? i : POSES - 1 - i;
                        wrong[t] += !(shared.ask(poses[k], poses[k + 1], a.get(), b.get()) == expected[k]);
                    }
                });
        for (std::thread &thread : threads)
            thread.join();
        for (std::size_t t = 0; t < THREADS; ++t)
            EXPECT_EQ(wrong[t], 0u) << "thread " << t;
        // Nothing counted is lost.
        EXPECT_EQ(shared.motion->getCheckedMotionCount(), THREADS * POSES);
        EXPECT_EQ(shared.footprint->counts().states, THREADS * alone.footprint->counts().states);
        EXPECT_EQ(shared.motion->counts().states, THREADS * alone.motion->counts().states);
    }
}  // namespace

TEST(ThreadSafety, AmongPolygons)
{
    expectSameFromAllThreads(randomPolygonWorld(21));
}

TEST(ThreadSafety, OnGrids)
{
    expectSameFromAllThreads(randomGridWorld(22));
}
