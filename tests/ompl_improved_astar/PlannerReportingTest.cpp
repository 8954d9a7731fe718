// What the planner reports: data, progress, intermediate solutions, costs, bounds; and OMPL's tools around it.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <future>
#include <set>
#include <string>
#include <tuple>

#include <ompl/base/PlannerData.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/tools/benchmark/Benchmark.h>

namespace
{
    using namespace parking_test;

    TEST(PlannerReporting, PlannerDataHoldBothTreesAndTheSolution)
    {
        const std::tuple<const char *, bool, bool> CASES[] = {{"bidirectional=1", true, true},
                                                              {"bidirectional=1 reverse_penalty=1", true, true},
                                                              {"bidirectional=0 search_from=goal", false, true},
                                                              {"bidirectional=0 search_from=start", true, false}};
        for (const auto &[direction, growsFromStart, growsFromGoal] : CASES)
            for (const char *model : {"motion_model=car", "motion_model=grid8"})
            {
                SCOPED_TRACE(testing::Message() << direction << ' ' << model);
                PlanningProblem problem(Space::SE2, GAPS, direction);
                problem.set(model);
                ASSERT_EQ(problem.from({LEFT}).to({RIGHT}).solve(), Status::EXACT_SOLUTION);
                ob::PlannerData data(problem.si), again(problem.si);
                problem.planner->getPlannerData(data);
                ASSERT_EQ(data.numStartVertices(), 1u);
                ASSERT_EQ(data.numGoalVertices(), 1u);
                EXPECT_TRUE(isSamePose(parking::poseOf(data.getStartVertex(0).getState()), LEFT, SAME));
                EXPECT_TRUE(isSamePose(parking::poseOf(data.getGoalVertex(0).getState()), RIGHT, SAME));
                EXPECT_GE(data.numEdges() + 2, data.numVertices());  // two trees and what joins them
                int sizes[3] = {0, 0, 0};
                for (unsigned int i = 0; i < data.numVertices(); ++i)
                {
                    ++sizes[data.getVertex(i).getTag()];
                    EXPECT_TRUE(problem.si->isValid(data.getVertex(i).getState()));
                }
                EXPECT_EQ(sizes[1] > 1, growsFromStart);
                EXPECT_EQ(sizes[2] > 1, growsFromGoal);
                // Edges lead from the start to the goal, and nowhere from there.
                std::set<unsigned int> seen{data.getStartIndex(0)};
                std::vector<unsigned int> open(seen.begin(), seen.end()), next;
                while (!open.empty())
                {
                    data.getEdges(open.back(), next);
                    open.pop_back();
                    for (const unsigned int vertex : next)
                        if (seen.insert(vertex).second)
                            open.push_back(vertex);
                }
                EXPECT_EQ(seen.count(data.getGoalIndex(0)), 1u);
                EXPECT_EQ(data.getEdges(data.getGoalIndex(0), next), 0u);
                // States stay valid while data are requested again, and when decoupled also afterwards.
                const auto last = [&data]
                {
                    return parking::poseOf(data.getVertex(data.numVertices() - 1).getState());
                };
                const Pose before = last();
                problem.planner->getPlannerData(again);
                EXPECT_EQ(again.numVertices(), data.numVertices());
                EXPECT_TRUE(isSamePose(last(), before, 0.0));
                data.decoupleFromPlanner();
                problem.planner->clear();
                EXPECT_TRUE(isSamePose(last(), before, 0.0));
            }
    }

    TEST(PlannerReporting, LengthCostAndBoundAreThoseOfThePath)
    {
        for (const auto &[space, parameters] : VARIANTS)
            for (const bool isExact : {true, false})
            {
                SCOPED_TRACE(testing::Message() << static_cast<int>(space) << parameters);
                PlanningProblem problem(space, isExact ? GAPS : CLOSED, parameters);
                problem.set("clearance_cost=0");
                const auto iterations = problem.planner->getPlannerProgressProperties().at("iterations INTEGER");
                EXPECT_EQ(problem.bestCost(), HUGE_VAL);
                EXPECT_EQ(problem.planner->suboptimalityBound(), HUGE_VAL);
                EXPECT_EQ(iterations(), "0");
                problem.from({LEFT}).to({RIGHT}).solve();
                ASSERT_EQ(problem.pdef->getSolutionCount(), 1u);
                EXPECT_NEAR(problem.pdef->getSolutions().front().length_, problem.path().length(), 1e-9);
                EXPECT_EQ(std::abs(problem.bestCost() - problem.path().length()) < 1e-5, isExact);
                EXPECT_EQ(iterations(), std::to_string(problem.planner->statistics().expanded));
                EXPECT_EQ(problem.planner->suboptimalityBound() < 5.0, isExact);
                problem.planner->clearQuery();
                EXPECT_EQ(problem.bestCost(), HUGE_VAL);
                EXPECT_EQ(problem.planner->suboptimalityBound(), HUGE_VAL);
            }
    }

    TEST(PlannerReporting, IntermediateSolutionsGetCheaper)
    {
        for (const char *clearance : {"preferred_clearance=0", "preferred_clearance=0.2"})
        {
            PlanningProblem problem(Space::ReedsShepp, GAPS, "anytime=1");
            problem.set(clearance);
            std::vector<double> costs{HUGE_VAL};
            problem.pdef->setIntermediateSolutionCallback(
                [&](const ob::Planner *planner, const std::vector<const ob::State *> &states, const ob::Cost cost)
                {
                    EXPECT_EQ(planner, problem.planner.get());
                    ASSERT_GE(states.size(), 2u);
                    // The goal first, as OMPL's planners have it.
                    EXPECT_TRUE(isSamePose(parking::poseOf(states.front()), RIGHT, 1e-6));
                    EXPECT_TRUE(isSamePose(parking::poseOf(states.back()), LEFT, SAME));
                    EXPECT_LT(cost.value(), costs.back());
                    costs.push_back(cost.value());
                });
            ASSERT_EQ(problem.from({LEFT}).to({RIGHT}).solveWithPolls(15000), Status::EXACT_SOLUTION);
            EXPECT_GE(costs.size(), 3u);
            EXPECT_NEAR(costs.back(), problem.bestCost(), 1e-5);
            EXPECT_GE(costs.back(), problem.path().length() - 1e-6);
        }
    }

    /** Length times a factor. */
    ob::OptimizationObjectivePtr scaled(const PlanningProblem &problem, double factor, double threshold)
    {
        const auto objective =
            factor * ob::OptimizationObjectivePtr(std::make_shared<ob::PathLengthOptimizationObjective>(problem.si));
        objective->setCostThreshold(ob::Cost(threshold));
        return objective;
    }

    TEST(PlannerReporting, CostsAreThoseOfTheObjectiveWhoseThresholdEndsAnytime)
    {
        PlanningProblem problem(Space::ReedsShepp, GAPS, "clearance_cost=0");
        ASSERT_EQ(problem.from({LEFT}).to({RIGHT}).solve(), Status::EXACT_SOLUTION);
        EXPECT_EQ(problem.pdef->getOptimizationObjective(), nullptr);  // none is imposed
        for (const double factor : {2.0, 1000.0, 0.5, 1.0})
        {
            problem.pdef->setOptimizationObjective(scaled(problem, factor, 0.0));
            problem.pdef->clearSolutionPaths();
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            EXPECT_NEAR(problem.bestCost(), factor * problem.path().length(), 1e-5 * factor);
        }
        for (const double threshold : {1000.0, 1.0})
        {
            PlanningProblem anytime(Space::ReedsShepp, GAPS, "anytime=1");
            anytime.pdef->setOptimizationObjective(scaled(anytime, 1.0, threshold));
            anytime.from({LEFT}).to({RIGHT});
            unsigned int polls = 0;
            const ob::PlannerTerminationCondition condition([&polls] { return ++polls > 20000; });
            EXPECT_EQ(anytime.planner->solve(condition), Status::EXACT_SOLUTION);
            const bool isMet = threshold > anytime.path().length();
            EXPECT_EQ(polls < 20000, isMet);
            EXPECT_EQ(anytime.pdef->hasOptimizedSolution(), isMet);
        }
    }

    TEST(PlannerReporting, NothingIsPrinted)
    {
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        for (const Scene &scene : {GAPS, CLOSED, square()})
            for (const Pose &start : {LEFT, Pose{40.0, 0.0, 0.0}})
                for (const char *model : {"motion_model=car", "motion_model=grid8"})
                    PlanningProblem(Space::SE2, scene, model).from({start}).to({RIGHT}).solve();
        EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }

    TEST(PlannerReporting, ProgressIsReadWhilePlanning)
    {
        PlanningProblem problem(Space::ReedsShepp, GAPS, "anytime=1");
        problem.from({LEFT}).to({RIGHT});
        const auto planned = std::async(std::launch::async, [&problem] { problem.solveWithPolls(3000); });
        while (planned.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            EXPECT_GE(problem.bestCost(), 18.0);
    }

    TEST(PlannerReporting, PlannersInSeveralThreadsShareASpaceInformation)
    {
        const PlanningProblem shared(Space::ReedsShepp, GAPS);
        const auto plan = [&shared](const Pose &goal)
        {
            PlanningProblem problem = shared;
            problem.pdef = std::make_shared<ob::ProblemDefinition>(shared.si);
            problem.planner = std::make_shared<og::ImprovedAStar>(shared.si);
            problem.planner->setProblemDefinition(problem.pdef);
            EXPECT_EQ(problem.from({LEFT}).to({goal}).solve(), Status::EXACT_SOLUTION);
            return problem.poses();
        };
        const std::vector<Pose> goals{RIGHT, {9.0, -8.0, 1.0}, {9.0, 0.0, -1.0}, {9.0, 8.0, 2.0}};
        std::vector<std::future<std::vector<Pose>>> together;
        for (const Pose &goal : goals)
            together.push_back(std::async(std::launch::async, plan, goal));
        for (std::size_t i = 0; i < goals.size(); ++i)
            EXPECT_TRUE(areEqual(together[i].get(), plan(goals[i])));
    }

    TEST(PlannerReporting, SimpleSetupAndBenchmarkRunIt)
    {
        const PlanningProblem problem(Space::ReedsShepp, GAPS);
        og::SimpleSetup setup(problem.si);
        setup.setPlanner(std::make_shared<og::ImprovedAStar>(problem.si));
        for (const Pose &goal : {RIGHT, Pose{8.0, -6.0, 1.0}})
        {
            setup.clear();
            setup.setStartAndGoalStates(problem.state(LEFT), problem.state(goal));
            ASSERT_EQ(setup.solve(60.0), Status::EXACT_SOLUTION);
            EXPECT_TRUE(isSamePose(parking::poseOf(setup.getSolutionPath().getStates().back()), goal, SAME));
            EXPECT_EQ(setup.getSolutionPlannerName(), "ImprovedAStar");
        }
        ompl::tools::Benchmark benchmark(setup, "gaps");
        benchmark.addPlanner(setup.getPlanner());
        ompl::tools::Benchmark::Request request(0.3, 1000.0, 3);
        request.displayProgress = request.saveConsoleOutput = request.simplify = false;
        benchmark.benchmark(request);
        const auto &runs = benchmark.getRecordedExperimentData().planners.at(0).runs;
        EXPECT_EQ(runs.size(), 3u);
        for (const auto &run : runs)
            EXPECT_EQ(run.at("correct solution BOOLEAN"), "1");
    }
}  // namespace
