// The status of solve() with its reason, for every kind of input, approximate solutions, and spaces that are refused.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <string>

#include <ompl/base/PlannerData.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Exception.h>

namespace
{
    using namespace parking_test;
    using Outcome = parking::search::PlanOutcome;

    constexpr unsigned int NO_LIMIT = 10000000;  // polls
    constexpr Pose OUTSIDE{40.0, 0.0, 0.0};

    struct Case
    {
        const char *name;
        std::vector<Pose> starts, goals;
        unsigned int polls;
        const char *settings;
        Status::StatusType status;
        Outcome outcome;
        const char *reason;  // a part of it; empty if there is none
    };

    void expectStatus(const Case &each, const Scene &scene, const std::string &model)
    {
        SCOPED_TRACE(testing::Message() << each.name << ", " << model);
        PlanningProblem problem(Space::SE2, scene, std::string(each.settings) + " motion_model=" + model);
        const Status status = problem.from(each.starts).to(each.goals).solveWithPolls(each.polls);
        EXPECT_EQ(status, each.status) << status.asString();
        EXPECT_EQ(problem.planner->outcome(), each.outcome);
        const std::string reason = problem.planner->reason();
        EXPECT_EQ(reason.empty(), std::string(each.reason).empty()) << reason;
        EXPECT_NE(reason.find(each.reason), std::string::npos) << reason;
        EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
        EXPECT_EQ(problem.pdef->hasExactSolution(), each.status == Status::EXACT_SOLUTION);
        EXPECT_EQ(problem.pdef->hasApproximateSolution(), each.status == Status::APPROXIMATE_SOLUTION);
        EXPECT_EQ(problem.planner->solutionPath() != nullptr, each.status == Status::EXACT_SOLUTION);
        if (problem.pdef->hasSolution())
            problem.expectSound(each.status == Status::EXACT_SOLUTION);
        ob::PlannerData data(problem.si);
        problem.planner->getPlannerData(data);
        EXPECT_EQ(each.polls > 0 ? 0 : problem.planner->checkedStates() + data.numVertices(), 0u) << "no time, no work";
    }

    TEST(PlannerStatus, NamesWhatHappened)
    {
        constexpr auto EXACT = Status::EXACT_SOLUTION, APPROXIMATE = Status::APPROXIMATE_SOLUTION;
        constexpr auto TIMEOUT = Status::TIMEOUT, BAD_START = Status::INVALID_START, BAD_GOAL = Status::INVALID_GOAL;
        const char *exactly = "approximate=0", *noGoal = "no goal is valid";
        const Pose valid{8.0, -6.0, 1.0};
        const std::vector<Pose> start{AISLE}, goal{valid}, bad{IN_OBSTACLE}, outside{OUTSIDE}, some{IN_OBSTACLE, valid};
        const Case CASES[] = {
            {"solved", start, goal, NO_LIMIT, "", EXACT, Outcome::Solved, ""},
            {"at the goal already", start, start, NO_LIMIT, "", EXACT, Outcome::Solved, ""},
            {"no time", start, goal, 0, "", TIMEOUT, Outcome::Timeout, ""},
            {"too little time", start, goal, 3, exactly, TIMEOUT, Outcome::Timeout, ""},
            {"near in too little time", start, goal, 20, "", APPROXIMATE, Outcome::Approximate, ""},
            {"start in an obstacle", bad, goal, NO_LIMIT, "", BAD_START, Outcome::InvalidStart, ""},
            {"start outside", outside, goal, NO_LIMIT, "", BAD_START, Outcome::InvalidStart, ""},
            {"no goal", start, {}, NO_LIMIT, "", BAD_GOAL, Outcome::InvalidGoal, noGoal},
            {"goal in an obstacle", start, bad, NO_LIMIT, exactly, BAD_GOAL, Outcome::InvalidGoal, noGoal},
            {"goal outside", start, outside, NO_LIMIT, exactly, BAD_GOAL, Outcome::InvalidGoal, noGoal},
            {"near a goal in an obstacle", start, bad, NO_LIMIT, "", APPROXIMATE, Outcome::InvalidGoal, noGoal},
            {"no time to look at all goals", start, some, 1, exactly, TIMEOUT, Outcome::Timeout, ""},
            {"the only goal in no time", start, bad, 1, exactly, BAD_GOAL, Outcome::InvalidGoal, noGoal},
        };
        for (const Case &each : CASES)
            for (const char *model : {"car", "grid8"})
                expectStatus(each, SLOT_SCENE, model);
    }

    TEST(PlannerStatus, ComesAsNearToABadGoalAtAnyWeights)
    {
        for (const char *model : {"car", "grid8"})
        {
            const auto distanceAt = [&](const char *weight)
            {
                PlanningProblem problem(Space::SE2, SLOT_SCENE,
                                        std::string("tie_break=0 heuristic_weight_far=") + weight +
                                            " heuristic_weight_near=" + weight + " motion_model=" + model);
                problem.from({AISLE}).to({IN_OBSTACLE}).solveWithPolls(NO_LIMIT);
                return problem.pdef->getSolutionDifference();
            };
            EXPECT_NEAR(distanceAt("1"), distanceAt("1.5"), 0.5) << model;
        }
    }

    TEST(PlannerStatus, NamesWhyThereIsNoPath)
    {
        const std::vector<Pose> before{BEFORE_WALL}, behind{BEHIND_WALL};
        const char *exactly = "approximate=0";
        const char *blind = "approximate=0 obstacle_heuristic=0 detours=0 adaptive_resolution=0";
        const char *endless = "approximate=0 analytic_expansion=0 max_memory_mb=16";
        constexpr auto APPROXIMATE = Status::APPROXIMATE_SOLUTION, TIMEOUT = Status::TIMEOUT;
        const Status::StatusType none = infeasible();
        expectStatus({"wall", before, behind, NO_LIMIT, exactly, none, Outcome::Infeasible, "disc"}, CLOSED, "car");
        expectStatus({"near", before, behind, NO_LIMIT, "", APPROXIMATE, Outcome::Infeasible, "disc"}, CLOSED, "car");
        expectStatus({"grid", before, behind, NO_LIMIT, exactly, none, Outcome::Infeasible, "left"}, CLOSED, "grid8");
        expectStatus({"pen", {{}}, before, NO_LIMIT, blind, none, Outcome::Infeasible, "finest resolution"}, PEN,
                     "car");
        expectStatus({"full", before, behind, NO_LIMIT, endless, TIMEOUT, Outcome::Timeout, "max_mem"}, square(),
                     "car");
    }

    TEST(PlannerStatus, GoalsOfAnUnrecognisedTypeAndMissingProblemsAreRefused)
    {
        class AnyPlace : public ob::Goal
        {
        public:
            using ob::Goal::Goal;
            bool isSatisfied(const ob::State * /*state*/) const override
            {
                return true;
            }
        };
        PlanningProblem problem(Space::ReedsShepp, SLOT_SCENE);
        problem.from({AISLE}).pdef->setGoal(std::make_shared<AnyPlace>(problem.si));
        EXPECT_EQ(problem.solve(), Status::UNRECOGNIZED_GOAL_TYPE);
        EXPECT_FALSE(problem.pdef->hasSolution());
        problem.pdef->clearGoal();
        EXPECT_THROW(problem.solve(), ompl::Exception);
        EXPECT_THROW(problem.from({}).to({SLOT}).solve(), ompl::Exception);
        EXPECT_THROW(og::ImprovedAStar(problem.si).solve(1.0), ompl::Exception);  // no problem definition
    }

    // OMPL ends the program when it measures the distance to a state out of bounds, as a yaw of pi is.
    TEST(PlannerStatus, AYawOfPiIsOutOfBoundsOnly)
    {
        for (const Space space : {Space::SE2, Space::ReedsShepp})
            for (const bool hasOther : {false, true})
            {
                PlanningProblem problem(space, square());
                problem.from({LEFT}).to(hasOther ? std::vector<Pose>{{8.0, 3.0, 0.0}} : std::vector<Pose>{});
                ob::ScopedState<ob::SE2StateSpace> goal(problem.space);
                goal->setXY(8.0, 0.0);
                goal->setYaw(parking::PI);
                problem.pdef->getGoal()->as<ob::GoalStates>()->addState(goal);
                EXPECT_EQ(problem.solve(), hasOther ? Status::EXACT_SOLUTION : Status::APPROXIMATE_SOLUTION);
            }
    }

    TEST(PlannerStatus, ApproximateSolutionsEndNear)
    {
        const Scene boxed = square({box(5.0, -3.0, 9.0, 3.0)});
        const struct
        {
            const char *name;
            Space space;
            const char *settings;
            Scene scene;
            Pose goal;
            double farthest;  // metres between the rear axles
        } CASES[] = {
            {"behind a wall", Space::SE2, "", CLOSED, BEHIND_WALL, 9.5},
            {"behind a wall, by curves", Space::ReedsShepp, "", CLOSED, BEHIND_WALL, 9.5},
            {"behind a wall, on a grid", Space::SE2, "motion_model=grid8", CLOSED, BEHIND_WALL, 12.3},
            {"in a box", Space::ReedsShepp, "", boxed, {7.0, 0.0, 0.0}, 5.5},
            {"in a box, on a grid", Space::SE2, "motion_model=grid8", boxed, {7.0, 0.0, 0.0}, 6.5},
            {"never exactly", Space::ReedsShepp, "analytic_expansion=0", square(), {4.0, 2.0, 0.0}, 0.5},
        };
        for (const auto &each : CASES)
        {
            SCOPED_TRACE(each.name);
            PlanningProblem problem(each.space, each.scene, each.settings);
            problem.from({BEFORE_WALL}).to({each.goal});
            ASSERT_EQ(problem.solveWithPolls(20000), Status::APPROXIMATE_SOLUTION);
            problem.expectSound(false);
            EXPECT_LT(positionDistance(problem.poses().back(), each.goal), each.farthest);
            double difference = 0.0;
            problem.pdef->getGoal()->isSatisfied(problem.path().getStates().back(), &difference);
            EXPECT_GT(difference, 0.0);
            EXPECT_DOUBLE_EQ(problem.pdef->getSolutionDifference(), difference);
        }
    }

    /** Does it throw one line with this part in it? */
    void expectRefusal(const std::function<void()> &action, const std::string &part)
    {
        try
        {
            action();
            ADD_FAILURE() << "not refused";
        }
        catch (const ompl::Exception &error)
        {
            const std::string message = error.what();
            EXPECT_NE(message.find(part), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }

    TEST(PlannerStatus, SpacesOtherThanThoseOfCarsAreRefused)
    {
        for (const unsigned int dimensions : {2, 3})
        {
            const auto space = std::make_shared<ob::RealVectorStateSpace>(dimensions);
            space->setBounds(-1.0, 1.0);
            const auto si = std::make_shared<ob::SpaceInformation>(space);
            si->setStateValidityChecker([](const ob::State * /*state*/) { return true; });
            const auto pdef = std::make_shared<ob::ProblemDefinition>(si);
            ob::ScopedState<> state(space);
            state.random();
            pdef->setStartAndGoalStates(state, state);
            og::ImprovedAStar planner(si);
            planner.setProblemDefinition(pdef);
            expectRefusal([&] { planner.setup(); }, "Reeds-Shepp");
            for (int call = 0; call < 2; ++call)
                expectRefusal([&] { planner.solve(1.0); }, "Reeds-Shepp");
        }
    }

    TEST(PlannerStatus, SpacesOfCurvesAreRefusedByTheGridModels)
    {
        for (const Space space : {Space::ReedsShepp, Space::Dubins, Space::SymmetricDubins})
            for (const std::string model : {"grid8", "grid16", "grid32"})
            {
                PlanningProblem problem(space, square());
                problem.from({LEFT}).to({RIGHT});
                for (int call = 0; call < 2; ++call)  // before the first setup, and after it
                {
                    problem.set("motion_model=" + model);
                    expectRefusal([&] { problem.solve(); }, "motion_model " + model + " needs a plain SE2StateSpace");
                    problem.set("motion_model=car");
                    EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
                }
            }
    }

    TEST(PlannerStatus, SpacesTooLargeForAGridAreRefused)
    {
        PlanningProblem problem(Space::SE2, square({}, 1500.0), "motion_model=grid8 xy_resolution=0.5");
        problem.from({{1490.0, 0.0, 0.0}}).to({{1480.0, 0.0, 0.0}});
        expectRefusal([&] { problem.solve(); }, "xy_resolution must be at least 0.73");
        problem.set("xy_resolution=0.75");
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
    }
}  // namespace
