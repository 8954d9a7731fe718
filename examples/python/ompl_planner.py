"""Improved A* in OMPL's own Python package: a space, a checker, a planner and a path, by hand.

usage: ompl_planner.py [SCENARIO]
"""
import os
import sys

from ompl import base as ob, geometric as og

from improved_astar import Scenario
from improved_astar.ompl import FootprintChecker, ImprovedAStar, SweptMotionValidator

SCENARIOS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'benchmarks', 'scenarios')


def state(space, pose):
    result = space.allocState()
    result.setX(pose[0])
    result.setY(pose[1])
    result.setYaw(pose[2])
    return result


def main(file=os.path.join(SCENARIOS, 'parallel.yaml')):
    scenario = Scenario.read(file)
    space = ob.ReedsSheppStateSpace(scenario.vehicle.turning_radius)
    bounds = ob.RealVectorBounds(2)
    for axis in (0, 1):
        bounds.setLow(axis, scenario.bounds[axis])
        bounds.setHigh(axis, scenario.bounds[axis + 2])
    space.setBounds(bounds)

    setup = og.SimpleSetup(space)
    si = setup.getSpaceInformation()
    checker = FootprintChecker(si, scenario)
    setup.setStateValidityChecker(checker)
    si.setMotionValidator(SweptMotionValidator(si, checker))
    setup.setStartAndGoalStates(state(space, scenario.start), state(space, scenario.goals[0]))
    setup.setPlanner(ImprovedAStar(si, preferred_clearance=0.2))

    status = setup.solve(1.0)
    print(status.asString())
    if status:
        path = setup.getSolutionPath()
        print(f'{path.length():.2f} m in {path.getStateCount()} states')
    return 0 if status else 1


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
