// Planner, manoeuvre and smoother over every bundled scenario and every TPCAP case: how many stretches between two
// changes of direction end with continuous curvature, and is what comes out drivable and free?
//
// Continuous means: within a stretch the pieces of the path meet with equal curvature (1e-9 1/m), and along each the
// curvature changes no faster than the wheels turn at the speed of the stretch. A stretch with a stop in it, where the
// car stands to steer, does not count as continuous.

#include "automatic_parking/ParkingPlanner.h"

#include "benchmarks/worlds/PolygonOracle.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/smoothing/SmoothPathChecks.h"
#include "tests/support/ProblemFiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::PolygonOracle;
using parking_test::solvableProblems;

namespace
{
    struct Count
    {
        std::size_t cases{0}, solved{0}, stretches{0}, continuous{0};
    };

    void smoothCase(const std::string &file, Count &count)
    {
        SCOPED_TRACE(file);
        const Scenario scenario = readScenario(file);
        const Vehicle &car = scenario.vehicle;
        PlanningParameters parameters;
        parameters.timeLimit = 60.0;  // the searches end by expansions on any machine
        const ParkingPlan plan = ParkingPlanner(parameters).plan(scenario);
        ++count.cases;
        if (!plan.found)
            return;
        ++count.solved;
        const std::size_t stretches = plan.arcs.cusps() + 1;
        count.stretches += stretches;
        ASSERT_FALSE(plan.smooth.path.pieces.empty()) << "the smoother's result was refused";
        ASSERT_EQ(plan.smooth.path.stretches().size(), stretches);
        EXPECT_TRUE(plan.smooth.free);
        parking_test::expectDrivable(plan.smooth, plan.arcs, car, parameters.smoothing);

        // Pieces meet with equal curvature unless the car stands between them.
        std::size_t jumps = 0;
        const std::vector<PathPiece> &pieces = plan.smooth.path.pieces;
        for (std::size_t i = 1; i < pieces.size(); ++i)
            jumps += pieces[i - 1].length * pieces[i].length > 0.0 &&
                     std::abs(pieces[i - 1].endCurvature() - pieces[i].curvature) > 1e-9;
        EXPECT_LE(jumps, plan.smooth.stops.size());
        count.continuous += parking_test::continuousStretches(plan.smooth);

        EXPECT_LT(std::abs(plan.smooth.path.length() / plan.arcs.length() - 1.0), 0.03);
        const PolygonOracle oracle(scenario);
        std::size_t hits = 0;
        for (const PathState &state : plan.smooth.path.sample(0.005))
            hits += !oracle.isFree(state.pose, car, -1e-6);
        EXPECT_EQ(hits, 0u);
    }

    void report(const Count &count)
    {
        const double share = 100.0 * static_cast<double>(count.continuous) / static_cast<double>(count.stretches);
        EXPECT_GE(share, 95.0);
    }
}  // namespace

TEST(SmoothedCases, BundledScenariosEndCurvatureContinuous)
{
    Count count;
    for (const std::string &file : solvableProblems(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios", ".yaml"))
        smoothCase(file, count);
    EXPECT_GE(count.cases, 10u);
    EXPECT_EQ(count.solved, count.cases);
    report(count);
}

TEST(SmoothedCases, TpcapCasesEndCurvatureContinuous)
{
    const std::vector<std::string> files = solvableProblems(std::string(PARKING_SHARED_DATA) + "/tpcap", ".csv");
    if (files.empty())
        GTEST_SKIP() << "no TPCAP cases in " << PARKING_SHARED_DATA << "/tpcap";
    Count count;
    for (const std::string &file : files)
        smoothCase(file, count);
    EXPECT_EQ(count.solved, count.cases);
    report(count);
}
