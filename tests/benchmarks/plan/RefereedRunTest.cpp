// Planners that lie about their paths: what the programs make of them.

#include "benchmarks/plan/PlanReport.h"
#include "benchmarks/plan/PlanRun.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "state_validity/ompl/OmplPose.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{
    using namespace parking;

    /** Calls a list of poses an exact solution, whatever they are. */
    class Liar : public ompl::base::Planner
    {
    public:
        Liar(const ompl::base::SpaceInformationPtr &si, std::vector<Pose> poses)
          : ompl::base::Planner(si, "liar"),
            poses_(std::move(poses))
        {
        }
        using ompl::base::Planner::solve;
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &) override
        {
            const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
            ompl::base::ScopedState<> state(si_);
            for (const Pose &pose : poses_)
            {
                setPose(state.get(), pose);
                path->append(state.get());
            }
            pdef_->addSolutionPath(path);
            return ompl::base::PlannerStatus::EXACT_SOLUTION;
        }

    private:
        std::vector<Pose> poses_;
    };

    PlanReport planned(const Problem &problem, const std::vector<Pose> &poses)
    {
        const PlannerEntry entry{"liar",
                                 "",
                                 false,
                                 [&poses](const ompl::base::SpaceInformationPtr &si)
                                 { return std::make_shared<Liar>(si, poses); },
                                 {}};
        PlanReport result;
        result.planner = entry.name;
        result.runs.push_back(planOnce(problem, entry, {}, 1.0, 1));
        return result;
    }

    PlanReport plannedByImproved(const Problem &problem, const PlannerSettings &settings)
    {
        PlanReport result;
        result.planner = "improved_astar";
        result.runs.push_back(planOnce(problem, PlannerRegistry::builtIn().find(result.planner), settings, 60.0, 1));
        return result;
    }

    TEST(RefereedRun, AStartAtAGoalNeedsNoMotion)
    {
        Scenario scenario = parking_test::openGround(20.0);
        scenario.goals = {compose(scenario.start, {0.0, 5e-6, 0.0})};
        const PlanReport stays = plannedByImproved(Problem(scenario, {}), {});
        EXPECT_TRUE(stays.first().isSolved());
        EXPECT_EQ(stays.first().path->length, 0.0);
        EXPECT_EQ(stays.first().path->cusps, 0u);
        EXPECT_EQ(stays.first().goalDistance, 0.0);
        scenario.goals = {compose(scenario.start, {0.0, 2e-5, 0.0})};
        const PlanReport moves = plannedByImproved(Problem(scenario, {}), {});
        EXPECT_TRUE(moves.first().isSolved());
        EXPECT_GT(moves.first().path->length, 0.01);
    }

    TEST(RefereedRun, AnEscapeIsNamedAndTheRestIsChecked)
    {
        Scenario scenario = parking_test::openGround(20.0);
        const double front = scenario.vehicle.wheelbase + scenario.vehicle.frontOverhang - 0.02;
        scenario.polygons = {parking_test::box(scenario.start.x + front, scenario.start.y - 3.0,
                                               scenario.start.x + front + 1.0, scenario.start.y + 3.0)};
        ASSERT_EQ(scenario.start.yaw, 0.0);
        const Problem problem(scenario, {});
        EXPECT_EQ(plannedByImproved(problem, {}).first().status, PlanStatus::InvalidStart);
        const PlanReport result = plannedByImproved(problem, {{"escape", "true"}});
        const PlanRun &run = result.first();
        EXPECT_FALSE(run.isSolved());
        EXPECT_TRUE(run.escapes);
        ASSERT_TRUE(run.hasValidPath()) << run.reason;
        EXPECT_NE(resultSummary(problem, result).find(": escaped ("), std::string::npos)
            << resultSummary(problem, result);
        EXPECT_NE(run.notice.find("2.0 cm deep"), std::string::npos) << run.notice;
        EXPECT_EQ(exitStatus(run, true), 3);
    }

    TEST(RefereedRun, LiesAreNoSolutions)
    {
        Scenario scenario = parking_test::openGround(20.0);
        scenario.polygons = {parking_test::box(9.0, -8.0, 10.0, 8.0)};
        const Pose start = scenario.start, goal = scenario.goals.front();
        const Pose aside{5.0, 12.0, 0.0}, behind{15.0, 12.0, 0.0};
        const std::vector<std::pair<Fault, std::vector<Pose>>> lies{
            {Fault::MissesGoal, {start}},
            {Fault::Collision, {start, goal}},
            {Fault::MissesGoal, {start, aside, behind}},
            {Fault::WrongStart, {aside, behind, goal}},
        };
        for (const SpaceKind space : {SpaceKind::ReedsShepp, SpaceKind::SE2})
        {
            ProblemSettings settings;
            settings.space = space;
            const Problem problem(scenario, settings);
            for (const auto &[fault, poses] : lies)
            {
                SCOPED_TRACE(toString(space) + " " + toString(fault));
                const PlanReport result = planned(problem, poses);
                const PlanRun &run = result.first();
                ASSERT_TRUE(run.path.has_value());
                EXPECT_EQ(toString(run.path->recheck.fault), toString(fault)) << run.path->recheck.reason;
                EXPECT_FALSE(run.isSolved());
                EXPECT_EQ(exitStatus(run), 4);
                const nlohmann::json text = resultJson(problem, PlanOptions{}, result);
                EXPECT_EQ(text["status"], "invalid_path");
                EXPECT_EQ(text["recheck"]["fault"], toString(fault));
                EXPECT_NE(text["reason"].get<std::string>().find("not valid"), std::string::npos);
                EXPECT_NE(resultSummary(problem, result).find("NOT VALID"), std::string::npos);
                EXPECT_FALSE(resultSvg(problem, result).empty());
            }
            const PlanReport honest = planned(problem, {start, aside, behind, goal});
            EXPECT_TRUE(honest.first().isSolved()) << honest.first().reason;
            EXPECT_EQ(exitStatus(honest.first()), 0);
        }
    }

    TEST(RefereedRun, OfALongWayToNowhereNotEveryMetreIsKept)
    {
        const Problem problem(parking_test::openGround(20.0), {});
        const Scenario &scenario = problem.scenario();
        const PlanReport far = planned(problem, {scenario.start, {3e5, 0.0, 0.0}, scenario.goals.front()});
        ASSERT_TRUE(far.first().path.has_value());
        EXPECT_FALSE(far.first().isSolved());
        EXPECT_GT(far.first().path->length, 5.9e5);
        EXPECT_LT(far.first().path->states().size(), 10100u);
        const PlanReport near = planned(problem, {scenario.start, scenario.goals.front()});
        EXPECT_TRUE(near.first().isSolved());
        EXPECT_GE(near.first().path->states().size(), 201u);
    }

    TEST(RefereedRun, AMissingPathIsAnInvalidAnswer)
    {
        const Problem problem(parking_test::openGround(20.0), {});
        const Pose start = problem.scenario().start, goal = problem.scenario().goals.front();
        const double nan = std::numeric_limits<double>::quiet_NaN();
        for (const auto &[poses, reason] :
             std::vector<std::pair<std::vector<Pose>, std::string>>{{{}, "no states"},
                                                                    {{start, {5.0, nan, 0.0}, goal}, "state 1"},
                                                                    {{start, {2e6, 0.0, 0.0}, goal}, "out of range"}})
        {
            const PlanReport result = planned(problem, poses);
            EXPECT_FALSE(result.first().path.has_value());
            EXPECT_EQ(toString(result.first().status), "invalid_answer");
            EXPECT_NE(result.first().reason.find(reason), std::string::npos) << result.first().reason;
            EXPECT_EQ(exitStatus(result.first()), 4);
        }
    }
}  // namespace
