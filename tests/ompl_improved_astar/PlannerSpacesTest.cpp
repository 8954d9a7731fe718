// Spaces that the planner refuses, with a reason.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <string>

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Exception.h>

namespace
{
    using namespace parking_test;

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

    TEST(PlannerSpaces, OthersThanThoseOfCarsAreRefused)
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

    TEST(PlannerSpaces, OfCurvesAreRefusedByTheGridModels)
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

    TEST(PlannerSpaces, TooLargeForAGridAreRefused)
    {
        PlanningProblem problem(Space::SE2, square({}, 1500.0), "motion_model=grid8 xy_resolution=0.5");
        problem.from({{1490.0, 0.0, 0.0}}).to({{1480.0, 0.0, 0.0}});
        expectRefusal([&] { problem.solve(); }, "xy_resolution must be at least 0.73");
        problem.set("xy_resolution=0.75");
        EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
    }

}  // namespace
