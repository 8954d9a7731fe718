// The objectives by which the planner searches, and the driving cost as an objective of any planner.

#include "ompl_improved_astar/DrivingCostObjective.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/RandomNumbers.h>

using namespace parking_test;
using parking::DrivingCostObjective;
using parking::pathCost;
using parking::PlannerParameters;

namespace
{
    using Length = ob::PathLengthOptimizationObjective;
    using Objective = ob::OptimizationObjectivePtr;

    const Space CURVE_SPACES[] = {Space::ReedsShepp, Space::Dubins, Space::SymmetricDubins};

    PlannerParameters weights(double reverse, double gearChange, double steering, double clearance,
                              double clearanceCost)
    {
        PlannerParameters result;
        result.reversePenalty = reverse;
        result.gearChangePenalty = gearChange;
        result.steeringChangePenalty = steering;
        result.preferredClearance = clearance;
        result.clearanceCost = clearanceCost;
        return result;
    }

    const PlannerParameters HEAVY = weights(1.5, 3.0, 0.7, 0.4, 6.0);

    og::PathGeometric pathThrough(const PlanningProblem &problem, const std::vector<Pose> &poses)
    {
        og::PathGeometric path(problem.si);
        for (const Pose &pose : poses)
            path.append(problem.state(pose).get());
        return path;
    }

    Pose randomPose(Random &random, double half)
    {
        return {random.between(-half, half), random.between(-half, half), random.between(-3.1, 3.1)};
    }

    /** The curve of a space by this project's own formulas. */
    parking::ReedsSheppCurve curveOf(const PlanningProblem &problem, Space kind, const Pose &from, const Pose &to)
    {
        const double radius = problem.vehicle.minTurningRadius();
        if (kind == Space::ReedsShepp)
            return parking::ReedsShepp(radius).shortest(from, to);
        const parking::ReedsShepp dubins(radius, parking::CurveFamily::Dubins);
        parking::ReedsSheppCurve there = dubins.shortest(from, to);
        parking::ReedsSheppCurve back = dubins.shortest(to, from);
        if (kind == Space::Dubins || there.length <= back.length)
            return there;
        std::reverse(back.pieces.begin(), back.pieces.begin() + static_cast<std::ptrdiff_t>(back.count));
        for (parking::Arc &piece : back.pieces)
            piece.length = -piece.length;
        return back;
    }

    double costOfSearch(const PlanningProblem &problem, const parking::Path &path, const PlannerParameters &parameters)
    {
        const auto &checker =
            *std::static_pointer_cast<parking::FclFootprintChecker>(problem.si->getStateValidityChecker());
        parking::FootprintEnvironment environment(checker.footprint(), {{-15.0, -15.0}, {15.0, 15.0}},
                                                  parking::FootprintEnvironment::TOLERANCE);
        return price(parking::search::costModel(parameters, problem.vehicle.minTurningRadius()), path, environment)
            .cost;
    }

    Objective driving(const PlanningProblem &problem, const PlannerParameters &parameters)
    {
        return std::make_shared<DrivingCostObjective>(problem.si, parameters);
    }

    /** The square of the distance from the origin, along the path: no cost of the search. */
    class FromOrigin : public ob::StateCostIntegralObjective
    {
    public:
        explicit FromOrigin(const ob::SpaceInformationPtr &si) : StateCostIntegralObjective(si, true)
        {
            description_ = "From Origin";
        }
        ob::Cost stateCost(const ob::State *state) const override
        {
            const Pose pose = parking::poseOf(state);
            return ob::Cost(pose.x * pose.x + pose.y * pose.y);
        }
    };

    class OtherLength : public Length
    {
        using Length::Length;
    };

    /** Counts the messages about an objective that the search does not minimise. */
    class Messages : public ompl::msg::OutputHandler
    {
    public:
        void log(const std::string &text, ompl::msg::LogLevel level, const char * /*file*/, int /*line*/) override
        {
            if (text.find("does not minimise the objective") == std::string::npos)
                return;
            texts.push_back(text);
            EXPECT_EQ(level, ompl::msg::LOG_DEBUG);
        }
        std::vector<std::string> texts;
    };
}  // namespace

TEST(DrivingCost, countsChangesWithinMotionsAndBetweenThem)
{
    const PlanningProblem problem(Space::ReedsShepp, square());
    const auto shared = std::make_shared<DrivingCostObjective>(problem.si, HEAVY);
    const DrivingCostObjective &objective = *shared;
    const double radius = problem.vehicle.minTurningRadius();
    const Pose quarter{3.0 + radius, radius, 0.5 * parking::PI};
    const auto path = pathThrough(problem, {{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, quarter});
    const double turn = 0.5 * parking::PI * radius, between = 3.0 + 3.0 + 0.7;
    EXPECT_NEAR(path.cost(shared).value(), 5.0 + 2.0 * 2.5 + turn, 1e-9);
    EXPECT_NEAR(objective.cost(path).value(), 5.0 + 2.0 * 2.5 + turn + between, 1e-9);
    // A line and a quarter circle as one motion.
    EXPECT_NEAR(objective.motionCost(problem.state({}).get(), problem.state(quarter).get()).value(), 3.0 + 0.7 + turn,
                1e-9);
    EXPECT_EQ(objective.cost(pathThrough(problem, {quarter})).value(), 0.0);
    EXPECT_EQ(objective.cost(og::PathGeometric(problem.si)).value(), 0.0);
}

TEST(DrivingCost, ofRandomPathsIsThatOfTheSearch)
{
    Random random(3);
    int differing = 0;
    for (const Space kind : CURVE_SPACES)
    {
        const PlanningProblem problem(kind, SLOT_SCENE);
        for (int i = 0; i < 60; ++i)
        {
            const PlannerParameters parameters =
                weights(random.between(0.0, 2.0), random.between(0.0, 4.0), random.between(0.0, 1.0),
                        random.between(0.05, 0.8), random.chance(0.2) ? 0.0 : random.between(1.0, 20.0));
            std::vector<Pose> poses{randomPose(random, 8.0)};
            parking::Path path{poses.front(), {}};
            for (int motion = 0; motion < 3; ++motion)
            {
                poses.push_back(randomPose(random, 8.0));
                const auto curve = curveOf(problem, kind, *(poses.end() - 2), poses.back());
                for (std::size_t k = 0; k < curve.count; ++k)
                    path.append(curve.pieces[k]);
            }
            const double difference =
                DrivingCostObjective(problem.si, parameters).cost(pathThrough(problem, poses)).value() -
                costOfSearch(problem, path, parameters);
            // Rounding may decide about the clearance of a single sample.
            EXPECT_NEAR(difference, 0.0, 0.2 * parameters.clearanceCost + 1e-5);
            differing += std::abs(difference) > 1e-5 ? 1 : 0;
        }
    }
    EXPECT_LE(differing, 2);
}

TEST(DrivingCost, ofLinesCountsLengthDirectionTurnAndClearance)
{
    const PlanningProblem problem(Space::SE2, SLOT_SCENE);
    PlannerParameters parameters = HEAVY;
    parameters.turningRadius = 4.0;
    const DrivingCostObjective objective(problem.si, parameters);
    const auto cost = [&](const std::vector<Pose> &poses)
    {
        return objective.cost(pathThrough(problem, poses)).value();
    };
    EXPECT_NEAR(cost({{-5.0, -5.0, 0.0}, {-1.0, -5.0, 0.0}}), 4.0, 1e-9);
    EXPECT_NEAR(cost({{-1.0, -5.0, 0.0}, {-5.0, -5.0, 0.0}}), 4.0 * 2.5, 1e-9);
    EXPECT_NEAR(cost({{-1.0, -5.0, 3.0}, {-5.0, -5.0, -3.0}}), 4.0, 1e-9);  // across half a turn
    // To half lock, and to more than full lock.
    EXPECT_NEAR(cost({{-5.0, -5.0, 0.0}, {-3.0, -5.0, 0.0}, {-1.0, -5.0, 0.25}}), 4.0 + 0.5 * 0.7, 1e-9);
    EXPECT_NEAR(cost({{-5.0, -5.0, 0.0}, {-3.0, -5.0, 0.0}, {-1.0, -5.0, 1.5}}), 4.0 + 0.7, 1e-9);
    // Sideways along the parked cars: all of it closer than preferred.
    const double x = 0.0, y = -0.5 * problem.vehicle.width - 0.2;
    EXPECT_NEAR(cost({{x, y, 0.0}, {x + 1.0, y, 0.0}}), 1.0 + 6.0, 1e-9);
}

TEST(DrivingCost, needsAPlanarSpaceWeightsInRangeAndAChecker)
{
    const auto space = std::make_shared<ob::RealVectorStateSpace>(2);
    EXPECT_THROW(DrivingCostObjective(std::make_shared<ob::SpaceInformation>(space)), ompl::Exception);
    const PlanningProblem problem(Space::ReedsShepp, square());
    EXPECT_THROW(DrivingCostObjective(problem.si, weights(-1.0, 0.0, 0.0, 0.0, 0.0)), ompl::Exception);
    const auto bare = std::make_shared<ob::SpaceInformation>(problem.space);
    const auto state = problem.state({});
    EXPECT_THROW(DrivingCostObjective(bare).motionCost(state.get(), state.get()), ompl::Exception);
    ob::ScopedState<> nowhere(problem.space);
    nowhere->as<ob::SE2StateSpace::StateType>()->setX(NAN);
    EXPECT_EQ(DrivingCostObjective(problem.si).motionCost(state.get(), nowhere.get()).value(), HUGE_VAL);
}

TEST(DrivingCost, noSequenceOfMotionsIsCheaperThanTheHeuristic)
{
    Random random(5);
    for (const Space kind : {Space::SE2, Space::ReedsShepp, Space::Dubins, Space::SymmetricDubins})
    {
        const PlanningProblem problem(kind, SLOT_SCENE);
        for (const PlannerParameters &parameters : {HEAVY, weights(0.0, 0.0, 0.0, 0.0, 0.0)})
        {
            const DrivingCostObjective objective(problem.si, parameters);
            for (int i = 0; i < 300; ++i)
            {
                const auto a = problem.state(randomPose(random, 9.0)), b = problem.state(randomPose(random, 9.0)),
                           c = problem.state(randomPose(random, 9.0));
                const double heuristic = objective.motionCostHeuristic(a.get(), c.get()).value();
                EXPECT_GT(heuristic, 0.0);
                EXPECT_LE(heuristic, objective.motionCost(a.get(), c.get()).value() + 1e-6);
                EXPECT_LE(heuristic, objective.motionCost(a.get(), b.get()).value() +
                                         objective.motionCost(b.get(), c.get()).value() + 1e-6);
                if (objective.isSymmetric())
                {
                    EXPECT_NEAR(objective.motionCost(a.get(), b.get()).value(),
                                objective.motionCost(b.get(), a.get()).value(), 1e-6);
                }
            }
            EXPECT_EQ(objective.isSymmetric(), kind != Space::Dubins && parameters.reversePenalty == 0.0);
        }
    }
}

TEST(DrivingCost, otherCheckersLimitItByTheirClearance)
{
    for (const bool knowsClearance : {true, false})
    {
        PlanningProblem problem(Space::ReedsShepp, square());
        problem.si->setStateValidityChecker(std::make_shared<CountingChecker>(
            problem.si, [](const Pose &pose) { return pose.x < 0.0 ? 0.3 : 1.0; }, knowsClearance));
        problem.si->setup();
        const auto path = pathThrough(problem, {{-2.0, 0.0, 0.0}, {6.0, 0.0, 0.0}});
        EXPECT_NEAR(DrivingCostObjective(problem.si, HEAVY).cost(path).value(), knowsClearance ? 8.0 + 2.0 * 6.0 : 8.0,
                    0.1 * 6.0);
    }
}

TEST(DrivingCost, isWhatOptimisingPlannersMinimise)
{
    // Reversing is the shortest path, but costs more than to drive round forwards.
    const PlannerParameters parameters = weights(20.0, 0.0, 0.0, 0.0, 0.0);
    const Pose start{4.0, 0.0, 0.0}, goal{-4.0, 0.0, 0.0};
    for (const bool isRrt : {true, false})
    {
        std::vector<double> costs;
        for (const bool isDriving : {true, false})
        {
            PlanningProblem problem(Space::ReedsShepp, square());
            problem.from({start}).to({goal});
            const Objective cost = driving(problem, parameters);
            problem.pdef->setOptimizationObjective(isDriving ? cost : std::make_shared<Length>(problem.si));
            ob::PlannerPtr planner = std::make_shared<og::RRTstar>(problem.si);
            if (!isRrt)
                planner = std::make_shared<og::BITstar>(problem.si);
            planner->setProblemDefinition(problem.pdef);
            planner->setup();
            ASSERT_EQ(planner->solve(ob::PlannerTerminationCondition([polls = isRrt ? 600 : 3000]() mutable
                                                                     { return polls-- == 0; })),
                      Status::EXACT_SOLUTION);
            const og::PathGeometric path = problem.path();
            costs.push_back(path.cost(cost).value());
            EXPECT_LE(costs.back(), pathCost(path, cost).value() + 1e-9);
            if (isDriving)
            {
                EXPECT_NEAR(problem.pdef->getSolutions().front().cost_.value(), costs.back(), 1e-6);
            }
        }
        EXPECT_LT(costs[0], 0.5 * costs[1]) << (isRrt ? "RRT*" : "BIT*");
    }
}

TEST(PlannerObjectives, lengthAndDrivingCostAndTheirSumsAreMapped)
{
    const PlanningProblem problem(Space::ReedsShepp, square());
    PlannerParameters base = HEAVY;
    base.headingBins = 36;
    const auto expect = [&](const Objective &objective, const PlannerParameters &wanted)
    {
        const auto mapped = parking::parametersFor(objective, base);
        ASSERT_TRUE(mapped);
        EXPECT_EQ(mapped->headingBins, 36u);
        EXPECT_DOUBLE_EQ(mapped->reversePenalty, wanted.reversePenalty);
        EXPECT_DOUBLE_EQ(mapped->gearChangePenalty, wanted.gearChangePenalty);
        EXPECT_DOUBLE_EQ(mapped->steeringChangePenalty, wanted.steeringChangePenalty);
        EXPECT_DOUBLE_EQ(mapped->preferredClearance, wanted.preferredClearance);
        EXPECT_DOUBLE_EQ(mapped->clearanceCost, wanted.clearanceCost);
    };
    const Objective length = std::make_shared<Length>(problem.si);
    const Objective cost = driving(problem, weights(1.0, 2.0, 0.5, 0.3, 8.0));
    const PlannerParameters shortest = weights(0.0, 0.0, 0.0, 0.0, 0.0);
    expect(length, shortest);
    expect(7.0 * length, shortest);
    expect(cost, weights(1.0, 2.0, 0.5, 0.3, 8.0));
    expect(3.0 * length + 1.0 * cost, weights(0.25, 0.5, 0.125, 0.3, 2.0));
    expect(2.0 * (length + cost) + 0.0 * length, weights(0.5, 1.0, 0.25, 0.3, 4.0));
    expect(driving(problem, weights(1.0, 0.0, 0.0, 0.6, 0.0)) + cost, weights(1.0, 1.0, 0.25, 0.3, 4.0));
}

TEST(PlannerObjectives, othersAreNotMapped)
{
    const PlanningProblem problem(Space::ReedsShepp, square());
    const Objective length = std::make_shared<Length>(problem.si), cost = driving(problem, HEAVY),
                    other = std::make_shared<FromOrigin>(problem.si),
                    clear = std::make_shared<ob::MaximizeMinClearanceObjective>(problem.si);
    for (const Objective &objective :
         {other, clear, length + other, length + clear, 2.0 * clear, -1.0 * length, 0.0 * length,
          3.0 * length + -1.0 * cost, HUGE_VAL * length, cost + driving(problem, weights(0.0, 0.0, 0.0, 0.3, 1.0)),
          Objective(std::make_shared<OtherLength>(problem.si)),
          Objective(std::make_shared<ob::MultiOptimizationObjective>(problem.si))})
        EXPECT_FALSE(parking::parametersFor(objective, HEAVY)) << objective->getDescription();
}

TEST(PlannerObjectives, theSearchUsesTheWeightsOfTheObjective)
{
    const auto set = [](const PlannerParameters &parameters)
    {
        std::string text;
        for (const char *name : {"reverse_penalty", "gear_change_penalty", "steering_change_penalty",
                                 "preferred_clearance", "clearance_cost"})
            text += std::string(name) + "=" +
                    parking::formatNumber(parameters.*
                                          std::get<double PlannerParameters::*>(parking::parameterNamed(name).member)) +
                    " ";
        return text;
    };
    for (const auto &[kind, model] : VARIANTS)
        for (const bool isLength : {true, false})
        {
            const std::string anytime = std::string(model) + " anytime=1";
            PlanningProblem problem(kind, SLOT_SCENE, anytime), other(kind, SLOT_SCENE, anytime);
            const PlannerParameters parameters = isLength ? weights(0.0, 0.0, 0.0, 0.0, 0.0) : HEAVY;
            Objective objective = driving(problem, parameters);
            if (isLength)
                objective = std::make_shared<Length>(problem.si);
            other.set(set(parameters));
            // Set after a first query, which has found another path.
            const Pose goal{8.0, -3.0, 0.5 * parking::PI};
            ASSERT_EQ(problem.from({AISLE}).to({goal}).solveWithPolls(2000), Status::EXACT_SOLUTION);
            problem.pdef->setOptimizationObjective(objective);
            problem.pdef->clearSolutionPaths();
            ASSERT_EQ(problem.solveWithPolls(2000), Status::EXACT_SOLUTION);
            ASSERT_EQ(other.from({AISLE}).to({goal}).solveWithPolls(2000), Status::EXACT_SOLUTION);
            EXPECT_TRUE(areEqual(problem.poses(), other.poses()));
            problem.expectSound();
            EXPECT_NEAR(problem.bestCost(), pathCost(problem.path(), objective).value(), 1e-5);
            EXPECT_NEAR(problem.pdef->getSolutions().front().cost_.value(), problem.bestCost(), 1e-5);
        }
}

TEST(PlannerObjectives, pathsCostAtMostAsMuchAsWithoutThem)
{
    int cheaper = 0;
    for (const Space kind : {Space::SE2, Space::ReedsShepp, Space::Dubins})
        for (const Pose &goal : {SLOT, Pose{0.0, 3.5, 0.5 * parking::PI}, RIGHT, Pose{6.0, -3.0, 3.0}})
            for (const bool isLength : {true, false})
            {
                if (kind == Space::Dubins && goal.y == SLOT.y)
                    continue;  // entered in reverse
                PlanningProblem problem(kind, SLOT_SCENE), unset(kind, SLOT_SCENE);
                Objective objective = driving(problem, HEAVY);
                if (isLength)
                    objective = std::make_shared<Length>(problem.si);
                problem.pdef->setOptimizationObjective(objective);
                ASSERT_EQ(problem.from({AISLE}).to({goal}).solve(), Status::EXACT_SOLUTION);
                ASSERT_EQ(unset.from({AISLE}).to({goal}).solve(), Status::EXACT_SOLUTION);
                const double cost = pathCost(problem.path(), objective).value(),
                             before = pathCost(unset.path(), objective).value();
                EXPECT_LE(cost, before + 1e-5);
                cheaper += cost < before - 1e-3 ? 1 : 0;
                problem.expectSound();
                EXPECT_GE(problem.planner->suboptimalityBound(), 1.0);
            }
    EXPECT_GT(cheaper, 5);
}

TEST(PlannerObjectives, theCostOfAPathIsThatOfTheSearch)
{
    for (const Space kind : {Space::SE2, Space::ReedsShepp})
    {
        PlanningProblem problem(kind, SLOT_SCENE);
        PlannerParameters parameters = HEAVY;
        parameters.turningRadius = problem.vehicle.minTurningRadius();
        problem.pdef->setOptimizationObjective(driving(problem, parameters));
        ASSERT_EQ(problem.from({AISLE}).to({SLOT}).solve(), Status::EXACT_SOLUTION);
        const double cost = costOfSearch(problem, *problem.planner->solutionPath(), HEAVY);
        // On a plain space the chords of the arcs, and the clearance in the middle of each.
        EXPECT_NEAR(problem.bestCost(), cost, kind == Space::SE2 ? 0.02 * cost : 1e-5);
    }
}

TEST(PlannerObjectives, othersAreEvaluatedAndLoggedOnce)
{
    Messages messages;
    for (const double threshold : {0.0, 1e9})
    {
        PlanningProblem problem(Space::ReedsShepp, GAPS, "anytime=1"), unset(Space::ReedsShepp, GAPS);
        const Objective objective = std::make_shared<FromOrigin>(problem.si);
        objective->setCostThreshold(ob::Cost(threshold));
        problem.pdef->setOptimizationObjective(objective);
        ompl::msg::setLogLevel(ompl::msg::LOG_DEBUG);
        ompl::msg::useOutputHandler(&messages);
        messages.texts.clear();
        problem.from({LEFT}).to({RIGHT});
        std::vector<Pose> first;
        for (int i = 0; i < 2; ++i)
        {
            EXPECT_EQ(problem.solveWithPolls(3000), Status::EXACT_SOLUTION);
            first = i == 0 ? problem.poses() : first;
        }
        ompl::msg::restorePreviousOutputHandler();
        ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        ASSERT_EQ(messages.texts.size(), 1u);
        EXPECT_NE(messages.texts.front().find("'From Origin'"), std::string::npos);
        EXPECT_NEAR(problem.bestCost(), problem.path().cost(objective).value(), 1e-5);
        EXPECT_EQ(problem.pdef->hasOptimizedSolution(), threshold > 0.0);
        // The first path meets a high threshold. It is that without an objective.
        ASSERT_EQ(unset.from({LEFT}).to({RIGHT}).solve(), Status::EXACT_SOLUTION);
        EXPECT_EQ(areEqual(first, unset.poses()), threshold > 0.0);
    }
}

TEST(PlannerObjectives, nothingIsSetByOthersThanOptimisingPlanners)
{
    const PlanningProblem problem(Space::ReedsShepp, GAPS);
    og::SimpleSetup setup(problem.si);
    setup.setStartAndGoalStates(problem.state(LEFT), problem.state(RIGHT));
    setup.setPlanner(std::make_shared<og::ImprovedAStar>(problem.si));
    ASSERT_EQ(setup.solve(60.0), Status::EXACT_SOLUTION);
    EXPECT_FALSE(setup.getProblemDefinition()->hasOptimizationObjective());
    // RRT* stores a path length, by which the planner then searches, too.
    og::RRTstar star(problem.si);
    star.setProblemDefinition(setup.getProblemDefinition());
    star.setup();
    const Objective stored = setup.getProblemDefinition()->getOptimizationObjective();
    ASSERT_NE(stored, nullptr);
    EXPECT_TRUE(parking::parametersFor(stored, HEAVY));
}
