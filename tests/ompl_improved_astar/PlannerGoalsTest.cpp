// Several starts and goals, regions that sample goals, and goals sampled while the planner runs.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalState.h>

namespace
{
    using namespace parking_test;
    using Outcome = parking::search::PlanOutcome;

    constexpr Pose HERE{-8.0, -5.0, 0.0}, NEAR{0.0, -5.0, 0.0}, FAR{9.0, 10.0, 2.0};
    constexpr Pose ON_THIS_SIDE{-8.0, 8.0, 1.0};

    TEST(PlannerGoals, TheCheapestPairOfStartAndGoalIsJoined)
    {
        std::vector<Pose> oneOfMany(1000, IN_OBSTACLE);
        oneOfMany.push_back(NEAR);
        const struct
        {
            const char *name;
            Scene scene;
            std::vector<Pose> starts, goals;
            Pose start, goal;
        } CASES[] = {
            {"two goals", SLOT_SCENE, {HERE}, {NEAR, FAR}, HERE, NEAR},
            {"one of them twice", SLOT_SCENE, {HERE}, {FAR, NEAR, FAR}, HERE, NEAR},
            {"two starts", SLOT_SCENE, {FAR, HERE}, {NEAR}, HERE, NEAR},
            {"the other start first", SLOT_SCENE, {HERE, FAR}, {NEAR}, HERE, NEAR},
            {"invalid ones among them", SLOT_SCENE, {IN_OBSTACLE, HERE}, {IN_OBSTACLE, NEAR}, HERE, NEAR},
            {"one of a long list", SLOT_SCENE, {HERE}, oneOfMany, HERE, NEAR},
            {"one out of reach", CLOSED, {BEFORE_WALL}, {BEHIND_WALL, ON_THIS_SIDE}, BEFORE_WALL, ON_THIS_SIDE},
        };
        for (const auto &each : CASES)
            for (const char *model : {"motion_model=car", "motion_model=grid8", "motion_model=grid16"})
            {
                SCOPED_TRACE(testing::Message() << each.name << ", " << model);
                PlanningProblem problem(Space::SE2, each.scene, model);
                EXPECT_EQ(problem.from(each.starts).to(each.goals).solve(), Status::EXACT_SOLUTION);
                problem.expectSound();
                EXPECT_TRUE(isSamePose(problem.poses().front(), each.start, SAME));
                EXPECT_TRUE(isSamePose(problem.poses().back(), each.goal, SAME));
            }
    }

    TEST(PlannerGoals, AStartAtAGoalStays)
    {
        const Pose beside = compose(AISLE, {0.0, 5e-6, 1e-6}), farther = compose(AISLE, {0.0, 2e-5, 0.0});
        for (const auto &[space, model] : VARIANTS)
        {
            PlanningProblem problem(space, SLOT_SCENE, model);
            EXPECT_EQ(problem.from({AISLE}).to({FAR, beside}).solve(), Status::EXACT_SOLUTION);
            // A space of curves would connect the two states by a manoeuvre.
            ASSERT_EQ(problem.poses().size(), space == Space::SE2 ? 2u : 1u);
            EXPECT_TRUE(isSamePose(problem.poses().front(), AISLE, SAME));
            EXPECT_TRUE(isSamePose(problem.poses().back(), space == Space::SE2 ? beside : AISLE, SAME));
            EXPECT_LT(problem.path().length(), 2e-5);
            EXPECT_TRUE(problem.path().check());
            EXPECT_EQ(problem.planner->outcome(), Outcome::Solved);
            EXPECT_TRUE(problem.planner->solutionPath()->pieces.empty());
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION) << "again";
        }
        PlanningProblem problem(Space::ReedsShepp, SLOT_SCENE);
        EXPECT_EQ(problem.from({AISLE}).to({farther}).solve(), Status::EXACT_SOLUTION);
        EXPECT_GT(problem.planner->solutionPath()->length(), 0.01);
        problem.expectSound();
        const Pose ahead = compose(AISLE, {5e-6, 0.0, 0.0});
        EXPECT_EQ(problem.to({ahead}).solve(), Status::EXACT_SOLUTION);
        ASSERT_EQ(problem.poses().size(), 2u);
        EXPECT_TRUE(isSamePose(problem.poses().back(), ahead, SAME));
    }

    TEST(PlannerGoals, TheLastMetresAreStraight)
    {
        for (const Space space : {Space::SE2, Space::ReedsShepp, Space::Dubins})
        {
            PlanningProblem problem(space, SLOT_SCENE, "final_straight=2.5");
            EXPECT_EQ(problem.from({HERE}).to({NEAR, FAR}).solve(), Status::EXACT_SOLUTION);
            problem.expectSound();
            const parking::PathPiece last = problem.planner->solutionPath()->pieces.back();
            EXPECT_EQ(last.curvature, 0.0);
            EXPECT_GE(last.driven(), 2.5 - 1e-9);
            EXPECT_EQ(problem.planner->notice(), "");
        }
        // Any checker and motion validator.
        PlanningProblem own(
            Space::ReedsShepp, SLOT_SCENE.bounds, [](const Pose &pose) { return pose.x < 4.0; }, "final_straight=9");
        EXPECT_EQ(own.from({HERE}).to({Pose{0.0, -5.0, 0.0}}).solve(), Status::EXACT_SOLUTION);
        own.expectSound();
        EXPECT_EQ(own.planner->solutionPath()->pieces.back().curvature, 0.0);
        EXPECT_GE(own.planner->solutionPath()->pieces.back().length, 9.0 - 1e-9);
    }

    TEST(PlannerGoals, AStartInContactIsLedOutOnlyIfRequired)
    {
        const Scene scene = square({box(-4.0, 0.0, -1.3, 5.0)});
        const parking::Vehicle car;
        // Its front is 2 cm in the obstacle, turned towards it.
        const Pose start{-2.5, -car.wheelbase - car.frontOverhang + 0.02, 0.5 * parking::PI};
        PlanningProblem problem(Space::ReedsShepp, scene);
        EXPECT_EQ(problem.from({start}).to({NEAR}).solve(), Status::INVALID_START);
        EXPECT_FALSE(problem.planner->escape());
        problem.set("escape=1");
        EXPECT_EQ(problem.solve(), Status::APPROXIMATE_SOLUTION) << "never exact";
        EXPECT_EQ(problem.planner->outcome(), Outcome::Escaped);
        ASSERT_TRUE(problem.planner->escape());
        EXPECT_NEAR(problem.planner->escape()->depth, 0.02, 1e-5);
        EXPECT_LT(problem.planner->escape()->arc.length, 0.0);
        EXPECT_NE(problem.planner->notice().find("2.0 cm deep"), std::string::npos) << problem.planner->notice();
        EXPECT_TRUE(isSamePose(problem.poses().front(), start, SAME));
        EXPECT_TRUE(isSamePose(problem.poses().back(), NEAR, SAME));
        EXPECT_FALSE(problem.pdef->hasExactSolution());
        const parking::Path rest =
            problem.planner->solutionPath()->rest(std::abs(problem.planner->escape()->arc.length) + 1e-9);
        EXPECT_TRUE(PolygonOracle(scene.obstacles, scene.bounds).isPathFree(rest, car, 0.005));
        EXPECT_EQ(problem.solve(), Status::APPROXIMATE_SOLUTION) << "again";
        problem.set("max_escape_depth=0.0199");
        EXPECT_EQ(problem.solve(), Status::INVALID_START);
        EXPECT_NE(problem.planner->reason().find("max_escape_depth"), std::string::npos) << problem.planner->reason();
        EXPECT_FALSE(problem.planner->escape());
        // A valid start is preferred; another checker has no depths.
        problem.set("max_escape_depth=0.05");
        EXPECT_EQ(problem.from({start, HERE}).solve(), Status::EXACT_SOLUTION);
        PlanningProblem own(
            Space::ReedsShepp, scene.bounds, [](const Pose &pose) { return pose.y < -4.0; }, "escape=1");
        EXPECT_EQ(own.from({start}).to({NEAR}).solve(), Status::INVALID_START);
    }

    TEST(PlannerGoals, AGoalStateIsReachedExactlyWhateverItsThreshold)
    {
        PlanningProblem problem(Space::ReedsShepp, SLOT_SCENE);
        const auto goal = std::make_shared<ob::GoalState>(problem.si);
        goal->setState(problem.state(SLOT));
        goal->setThreshold(2.0);
        problem.from({HERE}).to({SLOT}).pdef->setGoal(goal);
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        problem.expectSound();
    }

    /** One of \e count lies in the start's room; every third, or all for a count of 0, lie in the wall. */
    SampledRegion::Sampler oneInReachOf(unsigned int count)
    {
        return [count](unsigned int sample)
        {
            if (count == 0 || sample % 3 == 0)
                return Pose{};
            Random random(sample + 1);
            const double x = sample % count == count - 1 ? random.between(-13.0, -4.0) : random.between(4.0, 9.0);
            return Pose{x, random.between(-10.0, 10.0), random.between(-3.0, 3.0)};
        };
    }

    TEST(PlannerGoals, RegionsAreSampled)
    {
        constexpr auto EXACT = Status::EXACT_SOLUTION, APPROXIMATE = Status::APPROXIMATE_SOLUTION;
        constexpr auto TIMEOUT = Status::TIMEOUT, BAD_GOAL = Status::INVALID_GOAL;
        const struct
        {
            const char *name, *settings;
            unsigned int inReach;  // one of this many, 0: none valid
            Status::StatusType status;
            Outcome outcome;
            unsigned int minSamples, maxSamples;
        } CASES[] = {
            {"all in reach", "", 1, EXACT, Outcome::Solved, 2, 100},
            {"all in reach, on a grid", "motion_model=grid8", 1, EXACT, Outcome::Solved, 2, 100},
            {"one of 20 in reach", "approximate=0", 20, EXACT, Outcome::Solved, 20, 1000},
            {"one of 50 in reach", "approximate=0", 50, EXACT, Outcome::Solved, 50, 1000},
            {"none in reach, which is no proof", "approximate=0", 1000000, TIMEOUT, Outcome::Timeout, 500, 5000},
            {"none valid", "approximate=0", 0, BAD_GOAL, Outcome::InvalidGoal, 500, 5000},
            {"near one that is not valid", "", 0, APPROXIMATE, Outcome::InvalidGoal, 500, 5000},
        };
        for (const auto &each : CASES)
        {
            SCOPED_TRACE(each.name);
            PlanningProblem problem(Space::SE2, CLOSED, each.settings);
            const auto region = std::make_shared<SampledRegion>(problem.si, oneInReachOf(each.inReach));
            problem.from({BEFORE_WALL}).pdef->setGoal(region);
            EXPECT_EQ(problem.solve(), each.status);
            EXPECT_EQ(problem.planner->outcome(), each.outcome);
            EXPECT_GE(region->samples, each.minSamples);
            EXPECT_LE(region->samples, each.maxSamples);
            EXPECT_EQ(problem.planner->reason().find("goals that were sampled can be reached") != std::string::npos,
                      each.status == TIMEOUT);
            for (unsigned int i = 0; i < region->samples; ++i)
                problem.goals.push_back(oneInReachOf(each.inReach)(i));
            if (problem.pdef->hasSolution())
                problem.expectSound(each.status == EXACT);
            EXPECT_LT(problem.pdef->hasApproximateSolution() ? problem.pdef->getSolutionDifference() : 0.0, 5.0);
        }
    }

    /** A region that gives a large number of samples instead of the largest one, as some regions of users do. */
    class CountedRegion : public SampledRegion
    {
    public:
        using SampledRegion::SampledRegion;
        unsigned int maxSampleCount() const override
        {
            return std::numeric_limits<int>::max();
        }
    };

    TEST(PlannerGoals, ManyGoalsAreNotAllRead)
    {
        PlanningProblem problem(Space::SE2, CLOSED);
        const auto region = std::make_shared<CountedRegion>(problem.si, oneInReachOf(1));
        problem.from({BEFORE_WALL}).pdef->setGoal(region);
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_LE(region->samples, 100u);

        PlanningProblem listed(Space::SE2, CLOSED);
        const auto states = std::make_shared<ob::GoalStates>(listed.si);
        for (unsigned int i = 0; i < 20000; ++i)
            states->addState(listed.state(oneInReachOf(20)(i)));
        listed.from({BEFORE_WALL}).pdef->setGoal(states);
        EXPECT_EQ(listed.solve(), Status::EXACT_SOLUTION);
        ob::PlannerData data(listed.si);
        listed.planner->getPlannerData(data);
        EXPECT_LE(data.numGoalVertices(), 50u);
    }

    TEST(PlannerGoals, TheLastOfManyIsFoundAndTheSearchStopsBetweenThem)
    {
        PlanningProblem problem(Space::SE2, CLOSED);
        std::vector<Pose> goals;
        for (unsigned int i = 0; i < 3000; ++i)
            goals.push_back({5.0 + 0.001 * i, -5.0, 0.0});
        goals.push_back(ON_THIS_SIDE);
        problem.from({BEFORE_WALL}).to(goals);
        EXPECT_NE(problem.solveWithPolls(1000), Status::EXACT_SOLUTION);
        ob::PlannerData data(problem.si);
        problem.planner->getPlannerData(data);
        EXPECT_LT(data.numGoalVertices(), 2000u);
        problem.pdef->clearSolutionPaths();
        EXPECT_EQ(problem.solveWithPolls(20000), Status::EXACT_SOLUTION);
        problem.expectSound();
    }

    TEST(PlannerGoals, GoalsThatAreNotFiniteAreInvalid)
    {
        for (const double value : {HUGE_VAL, -HUGE_VAL, std::nan("")})
            for (const Pose &goal : {Pose{value, 0.0, 0.0}, Pose{1.0, value, 0.0}, Pose{1.0, 0.0, value}})
                for (const char *model : {"motion_model=car", "motion_model=grid8"})
                {
                    SCOPED_TRACE(testing::Message() << goal.x << ' ' << goal.y << ' ' << goal.yaw << ' ' << model);
                    PlanningProblem problem(Space::SE2, SLOT_SCENE, model);
                    EXPECT_EQ(problem.from({HERE}).to({goal}).solve(), Status::INVALID_GOAL);
                    EXPECT_EQ(problem.planner->outcome(), Outcome::InvalidGoal);
                }
    }

    TEST(PlannerGoals, LazySamplesAreWaitedFor)
    {
        const struct
        {
            const char *name;
            std::vector<Pose> samples;
            int milliseconds;  // before each but the first
            int reached;       // which one at the earliest; negative: none, sampled for ever
        } CASES[] = {
            {"at once", {{-4.0, -6.0, 0.0}, {-4.0, 6.0, 0.0}}, 0, 0},
            {"slowly", {{-4.0, -6.0, 0.0}, {-4.0, 6.0, 0.0}}, 30, 0},
            {"the first one out of reach", {BEHIND_WALL, ON_THIS_SIDE}, 60, 1},
            {"the first ones invalid", {Pose{}, Pose{}, ON_THIS_SIDE}, 30, 2},
            {"none ever valid", {Pose{}}, 2, -1},
        };
        for (const auto &each : CASES)
        {
            SCOPED_TRACE(each.name);
            PlanningProblem problem(Space::ReedsShepp, CLOSED, "approximate=0");
            std::size_t made = 0;
            const auto sample = [&](const ob::GoalLazySamples * /*goal*/, ob::State *state)
            {
                std::this_thread::sleep_for(std::chrono::milliseconds(made > 0 ? each.milliseconds : 0));
                parking::setPose(state, each.samples[std::min(made, each.samples.size() - 1)]);
                return made++ < each.samples.size() || each.reached < 0;
            };
            const auto goal = std::make_shared<ob::GoalLazySamples>(problem.si, sample);
            problem.from({BEFORE_WALL}).pdef->setGoal(goal);
            EXPECT_EQ(problem.solve(each.reached < 0 ? 0.2 : 60.0),
                      each.reached < 0 ? Status::TIMEOUT : Status::EXACT_SOLUTION);
            goal->stopSampling();
            problem.goals.assign(each.samples.begin() + std::max(each.reached, 0), each.samples.end());
            if (problem.pdef->hasSolution())
                problem.expectSound();
        }
    }
}  // namespace
