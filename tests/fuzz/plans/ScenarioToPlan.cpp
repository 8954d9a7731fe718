// Small problems, planned with parameters of all kinds. Whatever is called solved, the referee and the oracle call
// valid.

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/referee/Referee.h"
#include "tests/fuzz/plans/SmallWorld.h"

namespace parking_test::fuzz
{
    namespace
    {
        parking::PlannerParameters anyParameters(Numbers &numbers)
        {
            parking::PlannerParameters parameters;
            const std::uint8_t mask = numbers.byte();
            if ((mask & 1U) != 0)
            {
                parameters.steeringAngles = 3 + 2 * static_cast<unsigned int>(numbers.below(4));
                parameters.headingBins = 8 + 8 * static_cast<unsigned int>(numbers.below(30));
                parameters.xyResolution = numbers.flag() ? 0.0 : numbers.between(0.05, 1.0);
            }
            if ((mask & 2U) != 0)
            {
                parameters.heuristicWeightFar = numbers.between(0.0, 5.0);
                parameters.heuristicWeightNear = numbers.between(0.0, 5.0);
                parameters.clearanceCost = numbers.between(0.0, 20.0);
                parameters.gearChangePenalty = numbers.between(0.0, 5.0);
            }
            if ((mask & 4U) != 0)
            {
                parameters.bidirectional = numbers.flag();
                parameters.searchFrom = numbers.flag() ? "goal" : "start";
                parameters.openList = numbers.flag() ? "binary_heap" : "linear";
                parameters.heuristic =
                    std::vector<std::string>{"default", "curves", "straight", "octile"}[numbers.below(4)];
            }
            if ((mask & 8U) != 0)
            {
                parameters.obstacleHeuristic = numbers.flag();
                parameters.detours = numbers.flag();
                parameters.adaptiveResolution = numbers.flag();
                parameters.analyticExpansion = numbers.flag();
                parameters.shortening = numbers.flag();
                parameters.approximate = numbers.flag();
                parameters.anytime = numbers.flag();
            }
            if ((mask & 16U) != 0)
                parameters.preferredClearance = numbers.between(0.0, 1.0);
            return parameters;
        }
    }  // namespace

    void tryInput(const std::string &input)
    {
        Numbers numbers(input);
        const parking::Scenario scenario = smallWorld(numbers);
        accepts("",
                [&]
                {
                    const parking::FootprintChecker checker(parking::ObstacleSet::fromScenario(scenario),
                                                            scenario.vehicle, 0.0, {}, fieldResolution(numbers));
                    parking::FootprintEnvironment environment(checker, scenario.bounds, 1e-3);
                    parking::search::PlanRequest request;
                    request.starts = {scenario.start};
                    request.goals = scenario.goals;
                    request.car.turningRadius = scenario.vehicle.minTurningRadius();
                    request.car.inscribedRadius = scenario.vehicle.inscribedRadius();
                    request.car.bounds = scenario.bounds;
                    request.parameters = anyParameters(numbers);
                    request.maxExpansions = 150;
                    const parking::search::PlanResult result = parking::search::plan(environment, request);
                    reached("outcome " + std::to_string(static_cast<int>(result.outcome)));
                    const bool solved = result.outcome == parking::search::PlanOutcome::Solved;
                    if (!solved && result.outcome != parking::search::PlanOutcome::Approximate)
                        return;
                    const parking::Verdict verdict = parking::Referee(scenario).check(result.path, solved);
                    if (!verdict.valid)
                        fail("the referee says " + toString(verdict.fault) + ": " + verdict.reason);
                    const PolygonOracle oracle(scenario);
                    parking::Pose pose = result.path.start;
                    for (const parking::PathPiece &piece : result.path.pieces)
                    {
                        if (piece.sharpness != 0.0 || piece.turn != 0.0)
                            fail("a piece that is no arc");
                        if (!oracle.isArcFree(pose, piece.curvature, piece.length, scenario.vehicle, 0.005, -1e-7))
                            fail("the oracle says collision");
                        pose = parking::advance(pose, piece);
                    }
                    reached("cusps " + std::to_string(result.path.cusps()));
                });
    }
}  // namespace parking_test::fuzz
