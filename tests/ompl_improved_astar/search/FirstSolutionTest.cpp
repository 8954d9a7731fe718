// How good first solutions are: against what the same planner makes of them when it may go on.
//
// Effort is counted in expansions, not in time, so that the outcome does not depend on the machine.

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/support/ProblemFiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

using namespace parking;
using namespace parking::search;
using parking_test::solvableProblems;

namespace
{
    constexpr std::uint64_t EFFORT = 3000;  // expansions after which improving ends

    struct Lengths
    {
        double first;
        double improved;
    };

    /** The planner as it is by default, but ranking by length alone while improving, as OMPL's path length does. */
    Lengths plan(const Scenario &scenario)
    {
        const FootprintChecker checker(ObstacleSet::fromScenario(scenario), scenario.vehicle);
        FootprintEnvironment environment(checker, scenario.bounds, 1e-3);
        const PlannerParameters usual;
        const Vehicle &vehicle = scenario.vehicle;
        PathPlannerParameters parameters;
        parameters.search.turningRadius = vehicle.minTurningRadius();
        parameters.search.inscribedRadius = vehicle.inscribedRadius();
        parameters.search.cost.gearChangePenalty = usual.gearChangePenalty;
        parameters.search.cost.steeringChangePenalty = usual.steeringChangePenalty;
        parameters.anytime = true;

        PathPlanner planner;
        planner.begin(environment, parameters);
        planner.addStart(scenario.start);
        for (const Pose &goal : scenario.goals)
            planner.addGoal(goal);
        Lengths lengths{0.0, 0.0};
        planner.solve([&planner] { return planner.statistics().expanded > EFFORT; },
                      [&lengths](const Path &path, double)
                      {
                          const double length = path.length();
                          if (lengths.first == 0.0)
                              lengths = {length, length};
                          lengths.improved = std::min(lengths.improved, length);
                          return false;
                      });
        return lengths;
    }

    void compare(const std::vector<std::string> &files)
    {
        std::vector<double> ratios;
        for (const std::string &file : files)
        {
            const Lengths lengths = plan(readScenario(file));
            ASSERT_GT(lengths.first, 0.0) << file << " is not solved";
            ratios.push_back(lengths.first / lengths.improved);
            std::cout << std::filesystem::path(file).stem().string() << ": " << lengths.first << " m, " << ratios.back()
                      << " times " << lengths.improved << " m\n";
            // 1.27 in the dead end, where spreading out finds a way with fewer changes of direction that is longer.
            EXPECT_LE(ratios.back(), file.find("dead_end_aisle") != std::string::npos ? 1.3 : 1.2) << file;
        }
        std::sort(ratios.begin(), ratios.end());
        EXPECT_LE(ratios[ratios.size() / 2], 1.08);
        EXPECT_GT(ratios.back(), 1.0 + 1e-6) << "improving never improves anything";
    }
}  // namespace

TEST(FirstSolution, isNearlyAsShortAsWhatImprovingMakesOfIt)
{
    compare(solvableProblems(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios", ".yaml"));
}

TEST(FirstSolution, isNearlyAsShortInTheTpcapCases)
{
    const std::vector<std::string> files = solvableProblems(std::string(PARKING_SHARED_DATA) + "/tpcap", ".csv");
    if (files.empty())
        GTEST_SKIP() << "no TPCAP cases in " << PARKING_SHARED_DATA << "/tpcap";
    compare(files);
}
