// What the planner tells of its work: data, progress, intermediate solutions, costs; and OMPL's tools round it.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <sstream>
#include <thread>

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/tools/benchmark/Benchmark.h>

namespace
{
    using namespace parking_test;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerReporting : public Silent<testing::Test>
    {
    protected:
        static std::string progress(const og::ImprovedAStar &planner, const std::string &name)
        {
            const auto &properties = planner.getPlannerProgressProperties();
            const auto found = properties.find(name);
            return found == properties.end() ? "missing" : found->second();
        }
    };

    // A way through two gaps that can be shortened for a while.
    Site gapsSite()
    {
        return {{box(-3.0, -10.0, -2.0, 6.0), box(3.0, -6.0, 4.0, 10.0)}, {{-15.0, -15.0}, {15.0, 15.0}}};
    }
    constexpr Pose LEFT{-9.0, -5.0, 0.0}, RIGHT{9.0, 5.0, 0.0};

    TEST_F(PlannerReporting, PlannerDataHoldTheTreesAndTheSolution)
    {
        for (const char *model : {"car", "grid8"})
        {
            PlanningProblem problem(Space::SE2, gapsSite());
            problem.set("motion_model", model);
            problem.from(LEFT).to({RIGHT});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            ob::PlannerData data(problem.si);
            problem.planner->getPlannerData(data);
            ASSERT_EQ(data.numStartVertices(), 1u);
            ASSERT_EQ(data.numGoalVertices(), 1u);
            EXPECT_TRUE(isSamePose(parking::poseOf(data.getStartVertex(0).getState()), LEFT, SAME));
            EXPECT_TRUE(isSamePose(parking::poseOf(data.getGoalVertex(0).getState()), RIGHT, SAME));
            EXPECT_GT(data.numVertices(), 10u);
            EXPECT_GE(data.numEdges() + 2, data.numVertices());

            // Along the edges from the start the goal is reached, and from it nothing leads on.
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
            EXPECT_TRUE(seen.count(data.getGoalIndex(0))) << model;
            data.getEdges(data.getGoalIndex(0), next);
            EXPECT_TRUE(next.empty());
            for (unsigned int i = 0; i < data.numVertices(); ++i)
                ASSERT_TRUE(problem.si->isValid(data.getVertex(i).getState()));

            // What was handed out stays valid while data are asked for again.
            const Pose before = parking::poseOf(data.getVertex(data.numVertices() - 1).getState());
            ob::PlannerData again(problem.si);
            problem.planner->getPlannerData(again);
            EXPECT_EQ(again.numVertices(), data.numVertices());
            EXPECT_TRUE(isSamePose(parking::poseOf(data.getVertex(data.numVertices() - 1).getState()), before, SAME));
            data.decoupleFromPlanner();
            problem.planner->clear();
            EXPECT_TRUE(isSamePose(parking::poseOf(data.getVertex(data.numVertices() - 1).getState()), before, SAME));
        }
    }

    TEST_F(PlannerReporting, PlannerDataOfManyProblems)
    {
        // Nodes that took the place of dearer ones may stand before their parents.
        for (int i = 0; i < 20; ++i)
        {
            PlanningProblem problem(Space::ReedsShepp, gapsSite());
            problem.set("obstacle_heuristic", i % 2 == 0);
            problem.set("reverse_penalty", 0.1 * i);
            problem.from({-9.0, -5.0 + 0.5 * i, 0.3 * i}).to({{9.0, 8.0 - 0.5 * i, 0.2 * i}});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            ob::PlannerData data(problem.si);
            problem.planner->getPlannerData(data);
            EXPECT_GE(data.numEdges() + 2, data.numVertices());
        }
    }

    TEST_F(PlannerReporting, ProgressProperties)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        EXPECT_EQ(progress(*problem.planner, "best cost REAL"), "inf");
        EXPECT_EQ(progress(*problem.planner, "iterations INTEGER"), "0");
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_NEAR(std::stod(progress(*problem.planner, "best cost REAL")), problem.path().length(), 1e-5);
        EXPECT_EQ(progress(*problem.planner, "iterations INTEGER"),
                  std::to_string(problem.planner->statistics().expanded));
        problem.planner->clearQuery();
        EXPECT_EQ(progress(*problem.planner, "best cost REAL"), "inf");

        PlanningProblem grid(Space::SE2, gapsSite());
        grid.set("motion_model", "grid8");
        grid.from(LEFT).to({RIGHT});
        ASSERT_EQ(grid.solve(), Status::EXACT_SOLUTION);
        EXPECT_NEAR(std::stod(progress(*grid.planner, "best cost REAL")), grid.path().length(), 1e-5);
    }

    TEST_F(PlannerReporting, ProgressIsReadWhilePlanning)
    {
        PlanningProblem problem(Space::ReedsShepp, gapsSite());
        problem.set("anytime", true);
        problem.from(LEFT).to({RIGHT});
        std::atomic<bool> done{false};
        std::thread reader(
            [&]
            {
                while (!done)
                    for (const auto &[name, value] : problem.planner->getPlannerProgressProperties())
                        EXPECT_FALSE(value().empty());
            });
        problem.solveForQuestions(3000);
        done = true;
        reader.join();
    }

    TEST_F(PlannerReporting, AnytimeImprovesAndNeverGetsWorse)
    {
        PlanningProblem first(Space::ReedsShepp, gapsSite());
        first.set("preferred_clearance", 0.0);
        first.from(LEFT).to({RIGHT});
        ASSERT_EQ(first.solve(), Status::EXACT_SOLUTION);

        PlanningProblem problem(Space::ReedsShepp, gapsSite());
        problem.set("preferred_clearance", 0.0);
        problem.set("anytime", true);
        problem.from(LEFT).to({RIGHT});
        std::vector<double> costs;
        problem.pdef->setIntermediateSolutionCallback(
            [&](const ob::Planner *planner, const std::vector<const ob::State *> &states, const ob::Cost cost)
            {
                EXPECT_EQ(planner, problem.planner.get());
                ASSERT_GE(states.size(), 2u);
                // The goal first, as OMPL's planners have it.
                EXPECT_TRUE(isSamePose(parking::poseOf(states.front()), RIGHT, 1e-6));
                EXPECT_TRUE(isSamePose(parking::poseOf(states.back()), LEFT, SAME));
                costs.push_back(cost.value());
            });
        double best = std::numeric_limits<double>::infinity();
        for (int call = 0; call < 10; ++call)
        {
            ASSERT_EQ(problem.solveForQuestions(1500), Status::EXACT_SOLUTION);
            const double length = problem.path().length();
            EXPECT_LE(length, best + 1e-9);
            best = length;
            EXPECT_TRUE(problem.path().check());
        }
        ASSERT_GE(costs.size(), 2u);
        for (std::size_t i = 1; i < costs.size(); ++i)
            EXPECT_LT(costs[i], costs[i - 1]);
        EXPECT_NEAR(costs.back(), best, 1e-6);
        EXPECT_LE(best, first.path().length() + 1e-9);
    }

    // A path that keeps away from obstacles is better for it, and what is told of its cost says so, too.
    TEST_F(PlannerReporting, CostsFallAlsoWhereRoomCountsForMoreThanLength)
    {
        PlanningProblem problem(Space::ReedsShepp, gapsSite());
        problem.set("preferred_clearance", 0.2);
        problem.set("anytime", true);
        problem.from(LEFT).to({RIGHT});
        std::vector<double> costs;
        problem.pdef->setIntermediateSolutionCallback([&](const ob::Planner *, const std::vector<const ob::State *> &,
                                                          const ob::Cost cost) { costs.push_back(cost.value()); });
        ASSERT_EQ(problem.solveForQuestions(15000), Status::EXACT_SOLUTION);
        ASSERT_GE(costs.size(), 2u);
        for (std::size_t i = 1; i < costs.size(); ++i)
            EXPECT_LT(costs[i], costs[i - 1]);
        EXPECT_GE(costs.back(), problem.path().length() - 1e-6);
    }

    TEST_F(PlannerReporting, AThresholdEndsAnytime)
    {
        PlanningProblem problem(Space::ReedsShepp, gapsSite());
        problem.set("anytime", true);
        problem.from(LEFT).to({RIGHT});
        const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(problem.si);
        objective->setCostThreshold(ob::Cost(1000.0));
        problem.pdef->setOptimizationObjective(objective);
        unsigned int asked = 0;
        const Status status =
            problem.planner->solve(ob::PlannerTerminationCondition([&asked] { return ++asked > 1000000; }));
        EXPECT_EQ(status, Status::EXACT_SOLUTION);
        EXPECT_LT(asked, 1000000u);
        EXPECT_TRUE(problem.pdef->hasOptimizedSolution());

        // One that cannot be met does not end it, and is not said to be.
        PlanningProblem other(Space::ReedsShepp, gapsSite());
        other.set("anytime", true);
        other.from(LEFT).to({RIGHT});
        objective->setCostThreshold(ob::Cost(1.0));
        other.pdef->setOptimizationObjective(objective);
        ASSERT_EQ(other.solveForQuestions(2000), Status::EXACT_SOLUTION);
        EXPECT_FALSE(other.pdef->hasOptimizedSolution());
    }

    TEST_F(PlannerReporting, TheObjectiveOfTheProblemIsLeftAloneAndReported)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_EQ(problem.pdef->getOptimizationObjective(), nullptr);

        PlanningProblem other(Space::ReedsShepp, slotSite());
        class TimesTwo : public ob::PathLengthOptimizationObjective
        {
        public:
            using PathLengthOptimizationObjective::PathLengthOptimizationObjective;
            ob::Cost motionCost(const ob::State *a, const ob::State *b) const override
            {
                return ob::Cost(2.0 * si_->distance(a, b));
            }
        };
        other.pdef->setOptimizationObjective(std::make_shared<TimesTwo>(other.si));
        other.from(AISLE).to({SLOT});
        ASSERT_EQ(other.solve(), Status::EXACT_SOLUTION);
        EXPECT_NEAR(std::stod(progress(*other.planner, "best cost REAL")), 2.0 * other.path().length(), 1e-5);
    }

    // Costs of two objectives are not compared.
    TEST_F(PlannerReporting, AnotherObjectiveBetweenTwoCallsPricesTheSolutionAnew)
    {
        class Thousandfold : public ob::PathLengthOptimizationObjective
        {
        public:
            using PathLengthOptimizationObjective::PathLengthOptimizationObjective;
            ob::Cost motionCost(const ob::State *a, const ob::State *b) const override
            {
                return ob::Cost(1000.0 * si_->distance(a, b));
            }
        };
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        problem.from(AISLE).to({SLOT});
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        const double before = std::stod(progress(*problem.planner, "best cost REAL"));
        problem.pdef->setOptimizationObjective(std::make_shared<Thousandfold>(problem.si));
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_NEAR(std::stod(progress(*problem.planner, "best cost REAL")), 1000.0 * problem.path().length(), 0.1);
        problem.pdef->setOptimizationObjective(nullptr);
        ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
        EXPECT_NEAR(std::stod(progress(*problem.planner, "best cost REAL")), before, 1e-5);
    }

    TEST_F(PlannerReporting, TheLengthReportedIsThatOfThePath)
    {
        for (const Space kind : {Space::SE2, Space::ReedsShepp, Space::Dubins})
        {
            PlanningProblem problem(kind, gapsSite());
            problem.from(LEFT).to({RIGHT});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            ASSERT_EQ(problem.pdef->getSolutionCount(), 1u);
            EXPECT_NEAR(problem.pdef->getSolutions().front().length_, problem.path().length(), 1e-9);
        }
        PlanningProblem closed(Space::ReedsShepp, closedSite());
        closed.from(LEFT).to({RIGHT});
        ASSERT_EQ(closed.solve(), Status::APPROXIMATE_SOLUTION);
        EXPECT_NEAR(closed.pdef->getSolutions().front().length_, closed.path().length(), 1e-9);
    }

    TEST_F(PlannerReporting, TheBoundOfSuboptimality)
    {
        PlanningProblem open(Space::ReedsShepp, openSite(15.0));
        open.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
        ASSERT_EQ(open.solve(), Status::EXACT_SOLUTION);
        EXPECT_NEAR(open.planner->suboptimalityBound(), 1.0, 1e-9);

        PlanningProblem problem(Space::ReedsShepp, gapsSite());
        problem.set("anytime", true);
        EXPECT_EQ(problem.planner->suboptimalityBound(), std::numeric_limits<double>::infinity());
        problem.from(LEFT).to({RIGHT});
        ASSERT_EQ(problem.solveForQuestions(500), Status::EXACT_SOLUTION);
        const double first = problem.planner->suboptimalityBound();
        EXPECT_GE(first, 1.0);
        EXPECT_LT(first, 5.0);
        ASSERT_EQ(problem.solveForQuestions(5000), Status::EXACT_SOLUTION);
        EXPECT_LE(problem.planner->suboptimalityBound(), first + 1e-9);
        problem.planner->clearQuery();
        EXPECT_EQ(problem.planner->suboptimalityBound(), std::numeric_limits<double>::infinity());
    }

    TEST_F(PlannerReporting, SimpleSetupPlansTwice)
    {
        PlanningProblem problem(Space::ReedsShepp, slotSite());
        og::SimpleSetup setup(problem.si);
        setup.setPlanner(std::make_shared<og::ImprovedAStar>(problem.si));
        setup.setStartAndGoalStates(problem.state(AISLE), problem.state(SLOT));
        ASSERT_EQ(setup.solve(60.0), Status::EXACT_SOLUTION);
        EXPECT_TRUE(setup.getSolutionPath().check());
        EXPECT_EQ(setup.getSolutionPlannerName(), "ImprovedAStar");
        const double length = setup.getSolutionPath().length();
        setup.clear();
        const Pose goal{8.0, -6.0, 1.0};
        setup.setStartAndGoalStates(problem.state(AISLE), problem.state(goal));
        ASSERT_EQ(setup.solve(60.0), Status::EXACT_SOLUTION);
        EXPECT_TRUE(isSamePose(parking::poseOf(setup.getSolutionPath().getStates().back()), goal, SAME));
        EXPECT_NE(setup.getSolutionPath().length(), length);
        ob::PlannerData data(problem.si);
        setup.getPlannerData(data);
        EXPECT_GE(data.numVertices(), 2u);
    }

    TEST_F(PlannerReporting, BenchmarkRunsIt)
    {
        PlanningProblem problem(Space::ReedsShepp, gapsSite());
        og::SimpleSetup setup(problem.si);
        setup.setStartAndGoalStates(problem.state(LEFT), problem.state(RIGHT));
        ompl::tools::Benchmark benchmark(setup, "gaps");
        const auto once = std::make_shared<og::ImprovedAStar>(problem.si);
        const auto anytime = std::make_shared<og::ImprovedAStar>(problem.si);
        anytime->setName("anytime");
        anytime->params().setParam("anytime", "1");
        benchmark.addPlanner(once);
        benchmark.addPlanner(anytime);
        ompl::tools::Benchmark::Request request(0.3, 1000.0, 3);
        request.displayProgress = false;
        request.saveConsoleOutput = false;
        request.simplify = false;
        request.timeBetweenUpdates = 0.02;
        benchmark.benchmark(request);
        const auto &data = benchmark.getRecordedExperimentData();
        ASSERT_EQ(data.planners.size(), 2u);
        for (const auto &planner : data.planners)
        {
            ASSERT_EQ(planner.runs.size(), 3u);
            for (const auto &run : planner.runs)
            {
                EXPECT_EQ(run.at("status ENUM"), std::to_string(static_cast<int>(Status::EXACT_SOLUTION)));
                EXPECT_EQ(run.at("correct solution BOOLEAN"), "1");
            }
        }
        std::ostringstream log;
        EXPECT_TRUE(benchmark.saveResultsToStream(log));
        EXPECT_NE(log.str().find("best cost REAL"), std::string::npos);
    }

    TEST_F(PlannerReporting, SeveralPlannersAtOnceOnOneSpaceInformation)
    {
        const PlanningProblem shared(Space::ReedsShepp, gapsSite());
        const std::vector<Pose> goals{RIGHT, {9.0, -8.0, 1.0}, {9.0, 0.0, -1.0}, {9.0, 8.0, 2.0}};
        std::vector<std::vector<Pose>> alone(goals.size()), together(goals.size());
        const auto plan = [&shared](const Pose &goal, std::vector<Pose> &poses)
        {
            const auto pdef = std::make_shared<ob::ProblemDefinition>(shared.si);
            pdef->setStartAndGoalStates(shared.state(LEFT), shared.state(goal));
            og::ImprovedAStar planner(shared.si);
            planner.setProblemDefinition(pdef);
            if (planner.solve(ob::timedPlannerTerminationCondition(60.0)) == Status::EXACT_SOLUTION)
                poses = PlanningProblem::posesOf(*pdef->getSolutionPath()->as<og::PathGeometric>());
        };
        for (std::size_t i = 0; i < goals.size(); ++i)
            plan(goals[i], alone[i]);
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < goals.size(); ++i)
            threads.emplace_back(plan, goals[i], std::ref(together[i]));
        for (std::thread &thread : threads)
            thread.join();
        for (std::size_t i = 0; i < goals.size(); ++i)
        {
            EXPECT_GE(alone[i].size(), 2u);
            EXPECT_TRUE(areSame(alone[i], together[i]));
        }
    }
}  // namespace
