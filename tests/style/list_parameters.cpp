// Prints the planner's parameters, one a line: name, default, suggested range. The README's table is checked against
// it.
#include "ompl_improved_astar/ImprovedAStar.h"

#include <iostream>

#include <ompl/base/spaces/SE2StateSpace.h>

int main()
{
    const auto space = std::make_shared<ompl::base::SE2StateSpace>();
    ompl::geometric::ImprovedAStar planner(std::make_shared<ompl::base::SpaceInformation>(space));
    for (const auto &[name, parameter] : planner.params().getParams())
        std::cout << name << '\t' << parameter->getValue() << '\t' << parameter->getRangeSuggestion() << '\n';
}
