// Several starts, several goals, regions of goals.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/util/RandomNumbers.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerGoals : public Silent<testing::Test>
    {
    };

    constexpr Pose HERE{-8.0, -5.0, 0.0};
    constexpr Pose NEAR{0.0, -5.0, 0.0};
    constexpr Pose FAR{9.0, 10.0, 2.0};

    TEST_F(PlannerGoals, TheCheapestOfSeveral)
    {
        for (const char *model : {"car", "grid8", "grid16"})
            for (const std::vector<Pose> &goals : {std::vector<Pose>{NEAR, FAR}, {FAR, NEAR}, {FAR, NEAR, FAR}})
            {
                PlanningProblem problem(Space::SE2, slotSite());
                problem.set("motion_model", model);
                problem.from(HERE).to(goals);
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                EXPECT_TRUE(isSamePose(problem.poses().back(), NEAR, SAME)) << model;
            }
    }

    TEST_F(PlannerGoals, TheNearestOfSeveralStarts)
    {
        for (const char *model : {"car", "grid8"})
            for (const std::vector<Pose> &starts : {std::vector<Pose>{FAR, HERE}, {HERE, FAR}})
            {
                PlanningProblem problem(Space::SE2, slotSite());
                problem.set("motion_model", model);
                for (const Pose &start : starts)
                    problem.from(start);
                problem.to({NEAR});
                ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                EXPECT_TRUE(isSamePose(problem.poses().front(), HERE, SAME)) << model;
            }
    }

    TEST_F(PlannerGoals, BadOnesAreLeftOut)
    {
        const Pose inObstacle{-2.5, 2.0, 0.0};
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(inObstacle).from(HERE).to({inObstacle, SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().front(), HERE, SAME));
        EXPECT_TRUE(isSamePose(problem.poses().back(), SLOT, SAME));
    }

    TEST_F(PlannerGoals, NobodyHasLookedAtAreNotInvalid)
    {
        PlanningProblem some(Space::ReedsShepp, slotSite());
        some.set("approximate", false);
        some.from(HERE).to({{-2.5, 2.0, 0.0}, NEAR});
        EXPECT_EQ(some.solveForQuestions(1), Status::TIMEOUT);
        EXPECT_EQ(some.solve(), Status::EXACT_SOLUTION);

        PlanningProblem none(Space::ReedsShepp, slotSite());
        none.set("approximate", false);
        none.from(HERE).to({{-2.5, 2.0, 0.0}});
        EXPECT_EQ(none.solveForQuestions(1), Status::INVALID_GOAL);
    }

    // Cells of the disc's way lie across the bounds: what is outside of them must not close the part inside.
    TEST_F(PlannerGoals, CloseToTheBoundsAreReached)
    {
        const parking::Polygon wall = box(-0.2, -40.0, 0.2, 8.0);
        const parking::Box bounds{{-15.0, -15.0}, {15.0, 15.0}};
        const auto isFree = [](const Pose &pose)
        {
            return std::abs(pose.x) > 1.2 || pose.y > 9.0;
        };
        for (const bool byFootprint : {false, true})
            for (const double distance : {0.0, 0.01, 0.1, 0.3})
            {
                const double edge = 15.0 - distance;
                for (const auto &[start, goal] : {std::pair<Pose, Pose>{{-9.0, 0.0, 0.0}, {edge, 0.0, 0.0}},
                                                  {{9.0, 0.0, 0.0}, {-edge, 0.0, 0.0}},
                                                  {{-9.0, 0.0, 0.0}, {9.0, edge, 0.0}},
                                                  {{-9.0, 0.0, 0.0}, {9.0, -edge, 0.0}},
                                                  {{-9.0, 0.0, 0.0}, {edge, edge, 0.0}}})
                {
                    SCOPED_TRACE(testing::Message() << byFootprint << ", " << goal.x << ", " << goal.y);
                    PlanningProblem problem(Space::ReedsShepp, bounds, isFree);
                    if (byFootprint)
                    {
                        problem.setObstacles(
                            parking::ObstacleSet::fromPolygons({wall}, {{-40.0, -40.0}, {40.0, 40.0}}));
                        problem.makePlanner();
                    }
                    for (const bool backwards : {false, true})
                    {
                        problem.pdef->clearStartStates();
                        problem.pdef->clearSolutionPaths();
                        problem.planner->clear();
                        problem.from(backwards ? goal : start).to({backwards ? start : goal});
                        EXPECT_EQ(problem.solve(5.0), Status::EXACT_SOLUTION) << problem.planner->reason();
                    }
                }
            }
    }

    TEST_F(PlannerGoals, OneOutOfReachDoesNotHinder)
    {
        PlanningProblem problem(Space::ReedsShepp, closedSite());
        problem.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}, {-8.0, 8.0, 1.0}});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), {-8.0, 8.0, 1.0}, SAME));
    }

    TEST_F(PlannerGoals, AddedBetweenTwoCalls)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(HERE).to({FAR});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), FAR, SAME));
        problem.pdef->getGoal()->as<ob::GoalStates>()->addState(problem.state(NEAR));
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), NEAR, SAME));
        problem.from({-1.0, -5.0, 0.0});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().front(), {-1.0, -5.0, 0.0}, SAME));
    }

    /** Any heading within a metre of a point; every third sample lies in an obstacle. */
    class Disc : public ob::GoalSampleableRegion
    {
    public:
        Disc(const ob::SpaceInformationPtr &si, double x, double y) : GoalSampleableRegion(si), x_(x), y_(y)
        {
            setThreshold(1.0);
        }

        void sampleGoal(ob::State *state) const override
        {
            ++samples;
            if (samples % 3 == 1)
                return parking::setPose(state, {-2.5, 2.0, 0.0});
            const double angle = random_.uniformReal(-parking::PI, parking::PI), radius = random_.uniform01();
            parking::setPose(state, {x_ + radius * std::cos(angle), y_ + radius * std::sin(angle),
                                     random_.uniformReal(-parking::PI, parking::PI)});
        }
        unsigned int maxSampleCount() const override
        {
            return std::numeric_limits<unsigned int>::max();
        }
        double distanceGoal(const ob::State *state) const override
        {
            const Pose pose = parking::poseOf(state);
            return std::hypot(pose.x - x_, pose.y - y_);
        }

        mutable unsigned int samples{0};

    private:
        double x_, y_;
        mutable ompl::RNG random_{7};
    };

    TEST_F(PlannerGoals, RegionsAreSampled)
    {
        for (const char *model : {"car", "grid8"})
        {
            PlanningProblem problem(Space::SE2, slotSite());
            problem.set("motion_model", model);
            problem.from(HERE);
            const auto disc = std::make_shared<Disc>(problem.si, 6.0, -6.0);
            problem.pdef->setGoal(disc);
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            EXPECT_TRUE(disc->isSatisfied(problem.path().getStates().back()));
            EXPECT_FALSE(problem.pdef->hasApproximateSolution());
            EXPECT_TRUE(problem.path().check());
            EXPECT_LT(disc->samples, 100u);  // it could go on for ever
        }
    }

    TEST_F(PlannerGoals, RegionsWithoutAValidStateEndNearThem)
    {
        PlanningProblem problem(Space::ReedsShepp, closedSite());
        problem.from({-8.0, 0.0, 0.0});
        class Nowhere : public Disc
        {
        public:
            using Disc::Disc;
            void sampleGoal(ob::State *state) const override
            {
                parking::setPose(state, {0.0, 0.0, 0.0});
            }
        };
        problem.pdef->setGoal(std::make_shared<Nowhere>(problem.si, 0.0, 0.0));
        EXPECT_EQ(problem.solve(), Status::APPROXIMATE_SOLUTION);
        EXPECT_LT(problem.pdef->getSolutionDifference(), 5.0);
        problem.pdef->clearSolutionPaths();
        problem.set("approximate", false);
        EXPECT_EQ(problem.solve(), Status::INVALID_GOAL);
    }

    TEST_F(PlannerGoals, LazySamplesAreWaitedFor)
    {
        for (const int delay : {0, 30})
        {
            PlanningProblem problem(Space::ReedsShepp, slotSite());
            problem.from(HERE);
            std::atomic<int> made{0};
            const auto sampler = [&](const ob::GoalLazySamples *, ob::State *state)
            {
                std::this_thread::sleep_for(std::chrono::milliseconds(delay));
                const int i = made++;
                parking::setPose(state, {4.0, -6.0 - 0.5 * i, 0.0});
                return i < 4;
            };
            const auto lazy = std::make_shared<ob::GoalLazySamples>(problem.si, sampler);
            problem.pdef->setGoal(lazy);
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION) << delay;
            lazy->stopSampling();
            EXPECT_DOUBLE_EQ(problem.poses().back().x, 4.0);
            EXPECT_TRUE(problem.path().check());
        }
    }

    TEST_F(PlannerGoals, LazySamplesThatCannotBeReachedAreNotTheLast)
    {
        PlanningProblem problem(Space::ReedsShepp, closedSite());
        problem.set("approximate", false);
        problem.from({-8.0, 0.0, 0.0});
        std::atomic<int> made{0};
        const auto sample = [&](const ob::GoalLazySamples * /*goal*/, ob::State *state)
        {
            const int number = made++;
            if (number > 0)
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
            parking::setPose(state, number == 0 ? Pose{8.0, 0.0, 0.0} : Pose{-8.0, 8.0, 1.0});
            return number < 2;
        };
        const auto goal = std::make_shared<ob::GoalLazySamples>(problem.si, sample);
        problem.pdef->setGoal(goal);
        EXPECT_EQ(problem.solve(60.0), Status::EXACT_SOLUTION);
        goal->stopSampling();
    }

    /** Goals on both sides of a wall without a door. */
    class Rooms : public ob::GoalSampleableRegion
    {
    public:
        Rooms(const ob::SpaceInformationPtr &si, unsigned int period) : GoalSampleableRegion(si), period_(period)
        {
            setThreshold(1.0);
        }

        void sampleGoal(ob::State *state) const override
        {
            // One in so many is in the start's room.
            const bool isHere = ++samples % period_ == 0;
            parking::setPose(state, {isHere ? random_.uniformReal(-13.0, -4.0) : random_.uniformReal(4.0, 9.0),
                                     random_.uniformReal(-10.0, 10.0), random_.uniformReal(-3.0, 3.0)});
        }

        unsigned int maxSampleCount() const override
        {
            return std::numeric_limits<unsigned int>::max();
        }

        double distanceGoal(const ob::State * /*state*/) const override
        {
            return 0.0;
        }

        mutable unsigned int samples{0};

    private:
        unsigned int period_;
        mutable ompl::RNG random_{3};
    };

    TEST_F(PlannerGoals, RegionsOfWhichLittleCanBeReached)
    {
        for (const unsigned int period : {1u, 20u, 50u})
        {
            PlanningProblem problem(Space::ReedsShepp, closedSite());
            problem.set("approximate", false);
            problem.from({-8.0, 0.0, 0.0});
            problem.pdef->setGoal(std::make_shared<Rooms>(problem.si, period));
            EXPECT_EQ(problem.solve(60.0), Status::EXACT_SOLUTION) << period;
        }
    }

    TEST_F(PlannerGoals, NoneOfARegionThatCanBeReachedIsNoProof)
    {
        PlanningProblem problem(Space::ReedsShepp, closedSite());
        problem.set("approximate", false);
        problem.from({-8.0, 0.0, 0.0});
        const auto rooms = std::make_shared<Rooms>(problem.si, std::numeric_limits<unsigned int>::max());
        problem.pdef->setGoal(rooms);
        EXPECT_EQ(problem.solve(60.0), Status::TIMEOUT);
        EXPECT_EQ(problem.planner->outcome(), parking::search::PlanOutcome::Timeout);
        EXPECT_NE(problem.planner->reason().find("goals that were sampled can be reached"), std::string::npos);
        EXPECT_GT(rooms->samples, 500u);
        EXPECT_LT(rooms->samples, 5000u);
    }

    TEST_F(PlannerGoals, AllOfAListAreLookedAt)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.set("approximate", false);
        std::vector<Pose> goals(1000, Pose{-2.5, 2.0, 0.0});  // in an obstacle
        goals.push_back({8.0, -6.0, 1.0});
        problem.from(AISLE).to(goals);
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
    }

    TEST_F(PlannerGoals, LazySamplesThatNeverComeEndWithTheTime)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(HERE);
        const auto sampler = [](const ob::GoalLazySamples *, ob::State *)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            return true;  // says that there will be more, and adds none that is valid
        };
        const auto lazy = std::make_shared<ob::GoalLazySamples>(problem.si,
                                                                [&](const ob::GoalLazySamples *goal, ob::State *state)
                                                                {
                                                                    parking::setPose(state, {-2.5, 2.0, 0.0});
                                                                    return sampler(goal, state);
                                                                });
        problem.pdef->setGoal(lazy);
        const Status status = problem.solve(0.2);
        lazy->stopSampling();
        EXPECT_EQ(status, Status::TIMEOUT);
        EXPECT_FALSE(problem.pdef->hasExactSolution());
    }

    TEST_F(PlannerGoals, AGoalStateIsReachedExactlyWhateverItsThreshold)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(HERE);
        const auto goal = std::make_shared<ob::GoalState>(problem.si);
        goal->setState(problem.state(SLOT));
        goal->setThreshold(2.0);
        problem.pdef->setGoal(goal);
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(problem.poses().back(), SLOT, SAME));
    }
}  // namespace
