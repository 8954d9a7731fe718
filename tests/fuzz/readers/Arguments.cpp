// The command line of parking_plan, an argument per line, and what its --set does to the planner.

#include "benchmarks/plan/PlanOptions.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "state_validity/ompl/OmplPose.h"
#include "tests/fuzz/Fuzz.h"

#include <ompl/base/spaces/ReedsSheppStateSpace.h>

namespace parking_test::fuzz
{
    namespace
    {
        ompl::base::SpaceInformationPtr anySpace()
        {
            const auto space = std::make_shared<ompl::base::ReedsSheppStateSpace>(4.0);
            ompl::base::RealVectorBounds bounds(2);
            bounds.setLow(-10.0);
            bounds.setHigh(10.0);
            space->setBounds(bounds);
            const auto si = std::make_shared<ompl::base::SpaceInformation>(space);
            si->setStateValidityChecker([](const ompl::base::State *) { return true; });
            return si;
        }
    }  // namespace

    void tryInput(const std::string &input)
    {
        static const ompl::base::SpaceInformationPtr si = anySpace();
        std::vector<std::string> arguments;
        for (std::size_t begin = 0, end = 0; begin < input.size() && arguments.size() < 50; begin = end + 1)
        {
            end = std::min(input.find('\n', begin), input.size());
            arguments.push_back(input.substr(begin, end - begin));
        }
        parking::PlanOptions options;
        if (!accepts("", [&] { options = parking::readPlanOptions(arguments); }) || options.settings.empty())
            return;
        ompl::geometric::ImprovedAStar planner(si);
        if (!accepts("", [&] { parking::applySettings(planner, options.settings); }))
            return;
        // What the planner says of its parameters is what makes another planner like it.
        const parking::PlannerParameters parameters = planner.parameters();
        ompl::geometric::ImprovedAStar other(si);
        parking::PlannerSettings said;
        for (const auto &[name, value] : planner.params().getParams())
            said.emplace_back(name, value->getValue());
        parking::applySettings(other, said);
        if (other.parameters() != parameters)
            fail("the planner's parameters are not what it says that they are");
    }
}  // namespace parking_test::fuzz
