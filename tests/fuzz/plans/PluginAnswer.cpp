// What planners from elsewhere may answer: any states, any status. Nothing that is wrong is taken for a solution.

#include "benchmarks/plan/PlanReport.h"
#include "benchmarks/plan/PlanRun.h"
#include "state_validity/ompl/OmplPose.h"
#include "tests/fuzz/plans/SmallWorld.h"

#include <array>
#include <cmath>

namespace parking_test::fuzz
{
    namespace
    {
        struct Answer
        {
            std::vector<parking::Pose> poses;
            bool hasPath{true}, approximate{false};
            ompl::base::PlannerStatus::StatusType status{ompl::base::PlannerStatus::EXACT_SOLUTION};
        };

        /** Answers what it was told to, whatever it is asked. */
        class Liar : public ompl::base::Planner
        {
        public:
            Liar(const ompl::base::SpaceInformationPtr &si, const Answer &answer)
              : ompl::base::Planner(si, "liar"),
                answer_(answer)
            {
            }
            using ompl::base::Planner::solve;
            ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &) override
            {
                if (answer_.hasPath)
                {
                    const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
                    ompl::base::ScopedState<> state(si_);
                    for (const parking::Pose &pose : answer_.poses)
                    {
                        parking::setPose(state.get(), pose);
                        path->append(state.get());
                    }
                    pdef_->addSolutionPath(path, answer_.approximate, answer_.approximate ? 1.0 : 0.0);
                }
                return answer_.status;
            }

        private:
            Answer answer_;
        };

        const parking::Problem &problemOf(bool se2)
        {
            const auto make = [](parking::SpaceKind space)
            {
                parking::Scenario scenario;
                scenario.name = "fuzzed";
                scenario.goals = {{10.0, 2.0, 0.3}};
                scenario.polygons = {rectangle(1.0, 6.0, {5.0, -5.0, 0.0})};
                scenario.bounds = {{-20.0, -20.0}, {30.0, 20.0}};
                parking::ProblemSettings settings;
                settings.space = space;
                return parking::Problem(scenario, settings);
            };
            static const parking::Problem curves = make(parking::SpaceKind::ReedsShepp);
            static const parking::Problem lines = make(parking::SpaceKind::SE2);
            return se2 ? lines : curves;
        }

        Answer anyAnswer(Numbers &numbers, const parking::Problem &problem)
        {
            Answer answer;
            answer.hasPath = numbers.below(8) != 0;
            answer.approximate = numbers.flag();
            answer.status = static_cast<ompl::base::PlannerStatus::StatusType>(
                numbers.below(ompl::base::PlannerStatus::TYPE_COUNT));
            if (numbers.flag())
                answer.poses.push_back(problem.scenario().start);
            for (std::size_t left = numbers.below(5); left > 0; --left)
            {
                parking::Pose pose{numbers.between(-5.0, 15.0), numbers.between(-8.0, 8.0), numbers.between(-3.2, 3.2)};
                if (numbers.below(4) == 0)
                    pose = {numbers.anything(), numbers.anything(), numbers.anything()};
                // OMPL asserts that it can measure what it is given, which ends the process (and is what isolation is
                // for): of headings setPose() makes such that it can.
                for (double *number : {&pose.x, &pose.y, &pose.yaw})
                    if (std::abs(*number) > 1e6)
                        *number = std::copysign(1e6, *number);
                if (!std::isfinite(pose.yaw))
                    pose.yaw = -parking::PI;
                answer.poses.push_back(pose);
            }
            if (numbers.flag())
                answer.poses.push_back(problem.scenario().goals.front());
            return answer;
        }
    }  // namespace

    void tryInput(const std::string &input)
    {
        Numbers numbers(input);
        const parking::Problem &problem = problemOf(numbers.flag());
        const Answer answer = anyAnswer(numbers, problem);
        parking::PlannerEntry entry;
        entry.name = "liar";
        entry.allocate = [&answer](const ompl::base::SpaceInformationPtr &si)
        {
            return std::make_shared<Liar>(si, answer);
        };
        parking::PlanReport result;
        result.planner = entry.name;
        accepts("", [&] { result.runs.push_back(planOnce(problem, entry, {}, 1.0, 1)); });
        if (result.runs.empty())
            return;
        const parking::PlanRun &run = result.first();
        reached(toString(run.status));
        if (run.path)
            reached("fault " + toString(run.path->recheck.fault));
        // Whatever it is can be written and drawn.
        resultJson(problem, parking::PlanOptions{}, result).dump();
        resultSummary(problem, result);
        resultSvg(problem, result);
        if (!run.isSolved())
        {
            if (exitStatus(run) == 0)
                fail("not solved, and status 0");
            return;
        }
        if (answer.poses.empty() || !answer.hasPath)
            fail("solved without a path");
        const parking::Pose start = problem.scenario().start, goal = problem.scenario().goals.front();
        const parking::Pose first = answer.poses.front(), last = answer.poses.back();
        const auto apart = [](const parking::Pose &a, const parking::Pose &b)
        {
            return std::hypot(a.x - b.x, a.y - b.y) + std::abs(parking::wrapAngle(a.yaw - b.yaw));
        };
        if (!(apart(first, start) < 1e-3) || !(apart(last, goal) < 1e-3))
            fail("solved elsewhere");
        const PolygonOracle oracle(problem.scenario());
        for (const parking::Pose &pose : answer.poses)
            if (!oracle.isFree(pose, problem.scenario().vehicle, -1e-6))
                fail("solved through an obstacle");
    }
}  // namespace parking_test::fuzz
