#include "benchmarks/studies/ValidityWorlds.h"

#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/util/Console.h>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        using parking_test::Random;
        using parking_test::World;

        constexpr std::size_t POSES = 4000;
        constexpr std::uint64_t WORLDS = 8;
        constexpr std::size_t KEPT = 20000;
        constexpr double FREE_CLEARANCE = 1.0, TIGHT = 0.5;  // metres

        ValidityWorlds::Place place(const ObstacleSet &obstacles, const Vehicle &vehicle)
        {
            return {std::make_unique<FootprintChecker>(obstacles, vehicle, 0.0, fclContactTest()),
                    std::make_unique<PlainFclChecker>(obstacles, vehicle),
                    {}};
        }

        /** Every pose that a planner asks about while it looks for a first solution. */
        std::vector<Pose> posesOfSearch(const Scenario &scenario, const FootprintChecker &checker, bool fromSlot)
        {
            const auto space = std::make_shared<ob::ReedsSheppStateSpace>(scenario.vehicle.minTurningRadius());
            ob::RealVectorBounds bounds(2);
            for (unsigned int axis = 0; axis < 2; ++axis)
            {
                bounds.setLow(axis, scenario.bounds.min[axis]);
                bounds.setHigh(axis, scenario.bounds.max[axis]);
            }
            space->setBounds(bounds);
            const auto si = std::make_shared<ob::SpaceInformation>(space);
            std::vector<Pose> poses;
            si->setStateValidityChecker(
                [&](const ob::State *state)
                {
                    poses.push_back(poseOf(state));
                    return checker.isFree(poses.back());
                });
            si->setup();
            const auto problem = std::make_shared<ob::ProblemDefinition>(si);
            ob::ScopedState<> state(si);
            setPose(state.get(), scenario.start);
            problem->addStartState(state);
            const auto goals = std::make_shared<ob::GoalStates>(si);
            for (const Pose &goal : scenario.goals)
            {
                setPose(state.get(), goal);
                goals->addState(state);
            }
            problem->setGoal(goals);
            ompl::geometric::ImprovedAStar planner(si);
            planner.params().setParam("bidirectional", fromSlot ? "0" : "1");
            planner.setProblemDefinition(problem);
            planner.setup();
            // Counted in questions, not in seconds: the same poses on every machine.
            planner.solve(ob::PlannerTerminationCondition([&poses] { return poses.size() > 100 * KEPT; }));
            return poses;
        }
    }  // namespace

    std::size_t ValidityWorlds::poseCount() const
    {
        std::size_t count = 0;
        for (const Place &each : places)
            count += each.poses.size();
        return count;
    }

    ValidityWorlds randomWorlds(bool grids, Surroundings surroundings)
    {
        ValidityWorlds result;
        const Vehicle vehicle;
        for (std::uint64_t seed = 1000; seed < 1000 + WORLDS; ++seed)
        {
            const World world = grids ? parking_test::randomGridWorld(seed) : parking_test::randomPolygonWorld(seed);
            ValidityWorlds::Place made = place(world.obstacles, vehicle);
            Random random(seed);
            while (made.poses.size() < POSES)
            {
                const Pose pose = surroundings == Surroundings::Tight
                                      ? world.touching(random, vehicle, random.between(0.0, TIGHT))
                                      : world.anywhere(random);
                if (surroundings != Surroundings::Free || made.tiered->clearance(pose) > FREE_CLEARANCE)
                    made.poses.push_back(pose);
            }
            result.places.push_back(std::move(made));
        }
        return result;
    }

    ValidityWorlds searchedWorlds(const std::string &folder, bool fromSlot)
    {
        ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
        ValidityWorlds result;
        for (const char *name :
             {"angled45", "dead_end_aisle", "multi_storey", "narrow_parallel", "narrow_perpendicular", "parallel",
              "perpendicular", "tight_parallel", "underground_garage", "perceived_street"})
        {
            const Scenario scenario = readScenario(folder + "/" + name + ".yaml");
            ValidityWorlds::Place made = place(ObstacleSet::fromScenario(scenario), scenario.vehicle);
            const std::vector<Pose> poses = posesOfSearch(scenario, *made.tiered, fromSlot);
            const std::size_t step = (poses.size() + KEPT - 1) / KEPT;
            for (std::size_t i = 0; i < poses.size(); i += step)
                made.poses.push_back(poses[i]);
            result.places.push_back(std::move(made));
        }
        return result;
    }
}  // namespace parking
