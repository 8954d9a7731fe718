// A plug-in of planners that fail in every way there is, each at every second run or always, for isolation_test.py.

#include "ompl_improved_astar/PlannerPlugin.h"

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace
{
    using Termination = ob::PlannerTerminationCondition;
    using Solve = std::function<ob::PlannerStatus(ob::Planner &, const Termination &)>;

    /** Fails where it is told to. */
    class Bad final : public ob::Planner
    {
    public:
        Bad(const ob::SpaceInformationPtr &si, const std::string &name, Solve solve, std::string where = "")
          : ob::Planner(si, name),
            solve_(std::move(solve)),
            where_(std::move(where))
        {
            fail("constructor");
        }

        ob::PlannerStatus solve(const Termination &ptc) override
        {
            return solve_(*this, ptc);
        }

        void setup() override
        {
            ob::Planner::setup();
            fail("setup");
        }

        void clear() override
        {
            fail("clear");
            ob::Planner::clear();
        }

        void getPlannerData(ob::PlannerData & /*data*/) const override
        {
            fail("data");
        }

    private:
        void fail(const std::string &where) const
        {
            if (where == where_)
                throw std::logic_error("bad in " + where);
        }

        Solve solve_;
        std::string where_;
    };

    std::vector<double *> hoard;

    ob::PlannerStatus nothing(ob::Planner & /*planner*/, const Termination & /*ptc*/)
    {
        return ob::PlannerStatus::TIMEOUT;
    }

    /** Says that it is exact, with a path by way of a pose that is nowhere. */
    ob::PlannerStatus byWayOf(ob::Planner &planner, double x)
    {
        const ob::SpaceInformationPtr &si = planner.getSpaceInformation();
        const auto path = std::make_shared<og::PathGeometric>(si);
        const ob::ProblemDefinitionPtr &problem = planner.getProblemDefinition();
        ob::ScopedState<ob::SE2StateSpace> via(si);
        via->setXY(x, 0.0);
        via->setYaw(0.0);
        path->append(problem->getStartState(0));
        path->append(via.get());
        path->append(problem->getStartState(0));
        problem->addSolutionPath(path);
        return ob::PlannerStatus::EXACT_SOLUTION;
    }

    void addPlanners(parking::PluginPlanners &planners)
    {
        const auto add = [&planners](const std::string &name, const Solve &solve, const std::string &where = "")
        {
            planners.add({name, "fails",
                          [=](const ob::SpaceInformationPtr &si)
                          {
                              return std::make_shared<Bad>(si, name, solve, where);
                          }});
        };
        add("throws",
            [](ob::Planner &, const Termination &) -> ob::PlannerStatus
            { throw std::runtime_error("bad in\nsolve \xff"); });
        add("throws_3", [](ob::Planner &, const Termination &) -> ob::PlannerStatus { throw 3; });
        for (const char *where : {"constructor", "setup", "clear", "data"})
            add(std::string("throws_in_") + where, nothing, where);
        add("segfaults",
            [](ob::Planner &, const Termination &)
            {
                std::raise(SIGSEGV);
                return ob::PlannerStatus(ob::PlannerStatus::CRASH);
            });
        add("aborts",
            [](ob::Planner &, const Termination &) -> ob::PlannerStatus
            {
                std::fputs("Assertion `room' failed.\n", stderr);
                std::abort();
            });
        add("exits", [](ob::Planner &, const Termination &) -> ob::PlannerStatus { std::exit(0); });
        add("hangs",
            [](ob::Planner &, const Termination &) -> ob::PlannerStatus
            {
                for (;;)
                    pause();
            });
        add("eats",
            [](ob::Planner &, const Termination &ptc)
            {
                constexpr std::size_t COUNT = 1 << 20;
                while (!ptc)
                {
                    hoard.push_back(new double[COUNT]);
                    std::memset(hoard.back(), 1, COUNT * sizeof(double));
                }
                return ob::PlannerStatus(ob::PlannerStatus::TIMEOUT);
            });
        add("exact_without_path",
            [](ob::Planner &, const Termination &) { return ob::PlannerStatus(ob::PlannerStatus::EXACT_SOLUTION); });
        add("nan", [](ob::Planner &planner, const Termination &)
            { return byWayOf(planner, std::numeric_limits<double>::quiet_NaN()); });
        add("far", [](ob::Planner &planner, const Termination &) { return byWayOf(planner, 1e300); });
        add("empty",
            [](ob::Planner &planner, const Termination &)
            {
                planner.getProblemDefinition()->addSolutionPath(
                    std::make_shared<og::PathGeometric>(planner.getSpaceInformation()));
                return ob::PlannerStatus(ob::PlannerStatus::EXACT_SOLUTION);
            });
        add("null",
            [](ob::Planner &planner, const Termination &)
            {
                planner.getProblemDefinition()->addSolutionPath(ob::PathPtr());
                return ob::PlannerStatus(ob::PlannerStatus::EXACT_SOLUTION);
            });
        add("fine", nothing);
    }
}  // namespace

PARKING_PLANNER_PLUGIN(addPlanners);
