"""Improved A* in OMPL's own Python package, with the wheel that `pip install ompl` brings."""
import gc
import math
import os
import subprocess
import sys
import time
import weakref

import numpy
import pytest

import improved_astar as ia

pytest.importorskip('ompl', reason="OMPL's Python package cannot be imported: pip install 'ompl>=2.0.1'")
from ompl import base as ob, geometric as og, tools as ot, util as ou  # noqa: E402

from improved_astar import ompl as iao  # noqa: E402

ou.setLogLevel(ou.LOG_NONE)
SCENARIOS = os.path.join(os.environ['PARKING_SOURCE_DIR'], 'benchmarks', 'scenarios')
BUNDLED = sorted(name for name in os.listdir(SCENARIOS)
                 if name.endswith('.yaml') and not name.endswith('_map.yaml') and name != 'unreachable.yaml')
WALL = [[[-0.5, -15], [0.5, -15], [0.5, 2], [-0.5, 2]], [[-0.5, 6], [0.5, 6], [0.5, 15], [-0.5, 15]]]
CLOSED = [[[4, -11], [16, -11], [16, -10.5], [4, -10.5]], [[4, 0.5], [16, 0.5], [16, 1], [4, 1]],
          [[4, -11], [4.5, -11], [4.5, 1], [4, 1]], [[15.5, -11], [16, -11], [16, 1], [15.5, 1]]]  # round the goal
Type = ob.PlannerStatus.PlannerStatusType


def scenario(name='parallel.yaml'):
    return ia.Scenario.read(os.path.join(SCENARIOS, name))


def wall(polygons=WALL, **more):
    return ia.Scenario.from_polygons(polygons, more.pop('start', (-10, -5, 0)), more.pop('goal', (10, -5, 0)), **more)


def solve(setup, seconds=30.0):
    return setup.solve(seconds).getStatus()


def rows(path):
    return numpy.array([[s.getX(), s.getY(), s.getYaw()] for s in path.getStates()])


def state(setup, pose):
    result = setup.getStateSpace().allocState()
    result.setX(pose[0])
    result.setY(pose[1])
    result.setYaw(pose[2])
    return result


def test_answers_for_several_poses_are_those_for_each():
    """This NumPy may be another version than that of the build."""
    world = wall()
    poses = numpy.array([[-10.0, -5.0, 0.0], [0.0, -5.0, 0.0], [0.0, 4.0, 0.0], [10.0, -5.0, 0.0], [0.0, 10.0, 0.0]])
    assert list(world.is_free(poses)) == [True, False, True, True, False]
    assert list(world.clearance_at(poses)) == [world.clearance_at(pose[None])[0] for pose in poses]


def objectiveNamed(name, si):
    if name == 'length':
        return ob.PathLengthOptimizationObjective(si)
    return iao.DrivingCostObjective(si, reverse_penalty=0.7, gear_change_penalty=2.5, steering_change_penalty=0.3,
                                    preferred_clearance=0.4, clearance_cost=3.0)


def expectSameCosts(path, objective, wanted):
    step, states = 7, path.getStates()
    costs = [[objective.motionCost(a, b).value(), objective.motionCost(b, a).value()]
             for a, b in zip(states, states[step:])]
    assert numpy.array(costs).ravel() == pytest.approx(wanted['motion'].ravel(), abs=1e-6)
    assert iao.pathCost(path, objective).value() == pytest.approx(wanted['cost'][0, 0], abs=1e-6)


@pytest.mark.parametrize('name', BUNDLED)
@pytest.mark.parametrize('objective', ['', 'length', 'driving'])
def test_the_path_is_that_of_the_planner_in_cpp(name, objective):
    setup = iao.simpleSetup(scenario(name))
    if objective:
        setup.setOptimizationObjective(objectiveNamed(objective, setup.getSpaceInformation()))
    assert solve(setup) == Type.EXACT_SOLUTION
    path, pieces = setup.getSolutionPath(), setup.getPlanner().pieces()
    program = os.environ.get('OMPL_PATH', '')
    if os.path.exists(program):
        command = [program, os.path.join(SCENARIOS, name), *filter(None, [objective])]
        lines = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout.splitlines()
        wanted = {kind: numpy.array([[float.fromhex(word) for word in line.split()[1:]] for line in lines
                                     if line.startswith(kind)]) for kind in ('state', 'piece', 'cost', 'motion')}
        assert numpy.array_equal(pieces, wanted['piece'])
        assert numpy.array_equal(rows(path)[1:-1], wanted['state'][1:-1])
        assert rows(path) == pytest.approx(wanted['state'], abs=1e-12)  # the ends are those that were given
        if objective:
            expectSameCosts(path, setup.getOptimizationObjective(), wanted)
    elif not objective:
        assert pieces == pytest.approx(ia.plan(scenario(name), time_limit=30).pieces, abs=1e-9)
    assert tuple(rows(path)[0]) == scenario(name).start and tuple(rows(path)[-1]) in scenario(name).goals
    assert setup.getProblemDefinition().getSolutionDifference() == 0.0 and path.check()


@pytest.mark.parametrize('space', [ob.SE2StateSpace(), ob.DubinsStateSpace(5.0), ob.ReedsSheppStateSpace(5.0)])
def test_spaces(space):
    setup = iao.simpleSetup(wall(), space)
    assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().check()
    path = rows(setup.getSolutionPath())
    if type(space) is ob.SE2StateSpace:
        assert ia.check(wall(), path)
    if isinstance(space, ob.DubinsStateSpace):
        assert (numpy.diff(path[:, 0]) * numpy.cos(path[:-1, 2]) + numpy.diff(path[:, 1]) * numpy.sin(path[:-1, 2])
                > 0).all()


def test_a_grid_model_on_a_plain_space():
    world = wall()
    setup = iao.simpleSetup(world, ob.SE2StateSpace(), motion_model='grid8')
    assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().check()
    with pytest.raises(ia.Error, match='motion_model grid8 needs a plain SE2StateSpace'):
        iao.simpleSetup(world, motion_model='grid8').solve(1.0)


def test_goals_and_starts():
    setup = iao.simpleSetup(wall())
    setup.addStartState(state(setup, (5, -5, 0)))
    setup.setGoalState(state(setup, (10, -5, 0)))
    assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().length() == pytest.approx(5.0)

    class Region(ob.GoalSampleableRegion):
        """Anywhere behind the wall, at two headings."""
        def sampleGoal(self, goal):
            self.count = getattr(self, 'count', 0) + 1
            goal.setX(8.0 + self.count % 5)
            goal.setY(-5.0)
            goal.setYaw(math.pi / 2 * (self.count % 2))

        def maxSampleCount(self):
            return 2 ** 32 - 1

        def couldSample(self):
            return True

        def distanceGoal(self, other):
            return max(0.0, 8.0 - other.getX())

    setup = iao.simpleSetup(wall())
    setup.setGoal(Region(setup.getSpaceInformation()))
    assert solve(setup) == Type.EXACT_SOLUTION and rows(setup.getSolutionPath())[-1, 0] >= 8.0


def test_statuses():
    assert solve(iao.simpleSetup(wall(CLOSED), approximate=False)) == Type.INFEASIBLE
    setup = iao.simpleSetup(wall(CLOSED))
    assert solve(setup) == Type.APPROXIMATE_SOLUTION
    assert 0.0 < setup.getProblemDefinition().getSolutionDifference() < 30.0
    assert 'obstacles are in the way' in setup.getPlanner().reason()
    assert setup.getSolutionPath().check()
    assert solve(iao.simpleSetup(wall(start=(0, 0, 0)))) == Type.INVALID_START
    assert solve(iao.simpleSetup(wall(goal=(0, 0, 0)), approximate=False)) == Type.INVALID_GOAL
    assert solve(iao.simpleSetup(wall(goal=(0, 0, 0)))) == Type.APPROXIMATE_SOLUTION
    assert iao.simpleSetup(wall()).solve(0.0).getStatus() == Type.TIMEOUT


def test_it_ends_when_told():
    setup = iao.simpleSetup(scenario('narrow_parallel.yaml'), anytime=True)
    planner = setup.getPlanner()
    setup.setup()
    planner.setProblemDefinition(setup.getProblemDefinition())
    for seconds in (0.05, 0.2):
        begin = time.monotonic()
        assert planner.solve(lambda: time.monotonic() - begin > seconds).getStatus() == Type.EXACT_SOLUTION
        assert time.monotonic() - begin < seconds + 0.1  # 10 ms, but for a machine that does other things, too


def test_a_query_goes_on():
    setup = iao.simpleSetup(wall(), anytime=True)
    lengths = [(solve(setup, 0.2), setup.getSolutionPath().length())[1] for _ in range(3)]
    assert lengths == sorted(lengths, reverse=True)
    setup.getPlanner().params()['reverse_penalty'] = 5.0  # another question
    assert solve(setup, 0.2) == Type.EXACT_SOLUTION
    setup.setOptimizationObjective(ob.PathLengthOptimizationObjective(setup.getSpaceInformation()))
    setup.clear()
    assert solve(setup, 0.2) == Type.EXACT_SOLUTION


def test_the_search_minimises_path_length_if_that_is_the_objective():
    class Evaluated(ob.PathLengthOptimizationObjective):
        """Of another class, so that the search keeps its own cost."""

    found = {}
    for name in ('length', 'penalties', 'evaluated', 'none'):
        zero = dict.fromkeys(('reverse_penalty', 'gear_change_penalty', 'steering_change_penalty', 'clearance_cost'), 0)
        setup = iao.simpleSetup(scenario('narrow_parallel.yaml'), **(zero if name == 'penalties' else {}))
        if name in ('length', 'evaluated'):
            kind = ob.PathLengthOptimizationObjective if name == 'length' else Evaluated
            setup.setOptimizationObjective(kind(setup.getSpaceInformation()))
        assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().check()
        found[name] = setup.getPlanner().pieces()
    assert numpy.array_equal(found['length'], found['penalties'])
    assert numpy.array_equal(found['evaluated'], found['none'])
    assert numpy.abs(found['length'][:, 1]).sum() < numpy.abs(found['none'][:, 1]).sum()


DRIVING = {'reverse_penalty': 1.5, 'gear_change_penalty': 3.0, 'steering_change_penalty': 0.7,
           'preferred_clearance': 0.4, 'clearance_cost': 6.0}


def pathThrough(setup, poses):
    path = og.PathGeometric(setup.getSpaceInformation())
    for pose in poses:
        path.append(state(setup, pose))
    return path


def test_the_driving_cost_counts_changes_within_motions_and_between_them():
    setup = iao.simpleSetup(wall([], start=(-10, -10, 0), goal=(10, 10, 0)))
    objective = iao.DrivingCostObjective(setup.getSpaceInformation(), **DRIVING)
    radius = setup.getPlanner()._space.radius
    quarter = (3.0 + radius, radius, 0.5 * math.pi)
    path = pathThrough(setup, [(0, 0, 0), (5, 0, 0), (3, 0, 0), quarter])
    turn = 0.5 * math.pi * radius
    assert path.cost(objective).value() == pytest.approx(5.0 + 2.0 * 2.5 + turn)
    assert iao.pathCost(path, objective).value() == pytest.approx(5.0 + 2.0 * 2.5 + turn + 3.0 + 3.0 + 0.7)
    both = ob.MultiOptimizationObjective(setup.getSpaceInformation())
    both.addObjective(objective, 0.5)
    both.addObjective(ob.PathLengthOptimizationObjective(setup.getSpaceInformation()), 2.0)
    assert iao.pathCost(path, both).value() == pytest.approx(0.5 * objective.cost(path).value() + 2.0 * path.length())
    ends = state(setup, (0, 0, 0)), state(setup, quarter)
    assert objective.motionCost(*ends).value() == pytest.approx(3.0 + 0.7 + turn)
    assert objective.motionCostHeuristic(*ends).value() == pytest.approx(3.0 + turn)
    assert objective.stateCost(ends[0]).value() == 0.0 and not objective.isSymmetric()
    assert iao.DrivingCostObjective(setup.getSpaceInformation(), reverse_penalty=0, clearance_cost=0).isSymmetric()
    assert iao.pathCost(pathThrough(setup, [quarter]), objective).value() == 0.0
    assert objective.motionCost(ends[0], state(setup, (math.nan, 0, 0))).value() == math.inf


def test_the_driving_cost_of_lines_and_of_symmetric_dubins_curves():
    setup = iao.simpleSetup(wall([], start=(-10, -10, 0), goal=(10, 10, 0)), ob.SE2StateSpace())
    objective = iao.DrivingCostObjective(setup.getSpaceInformation(), turning_radius=4, **DRIVING)
    for poses, cost in (([(-5, -5, 0), (-1, -5, 0)], 4), ([(-1, -5, 0), (-5, -5, 0)], 4 * 2.5),
                        ([(-5, -5, 0), (-3, -5, 0), (-1, -5, 0.25)], 4 + 0.5 * 0.7)):
        assert iao.pathCost(pathThrough(setup, poses), objective).value() == pytest.approx(cost)
    setup = iao.simpleSetup(wall([], start=(-10, -10, 0), goal=(10, 10, 0)), ob.DubinsStateSpace(4.0, True))
    objective = iao.DrivingCostObjective(setup.getSpaceInformation(), **DRIVING)
    assert objective.motionCost(state(setup, (0, 0, 0)), state(setup, (-2, 0, 0))).value() == pytest.approx(2 * 2.5)


def test_the_driving_cost_uses_the_clearance_of_a_checker():
    class Checker(ob.StateValidityChecker):
        def isValid(self, asked):
            return True

    class Clear(Checker):
        def clearance(self, asked):
            return 0.3 if asked.getX() < 0.0 else 1.0

    setup = iao.simpleSetup(wall([], start=(-10, -10, 0), goal=(10, 10, 0)))
    si = setup.getSpaceInformation()
    objective = iao.DrivingCostObjective(si, **DRIVING)
    path = pathThrough(setup, [(-2, 0, 0), (6, 0, 0)])
    assert objective.cost(path).value() == pytest.approx(8.0)
    for checker, cost in ((Checker, 8.0), (Clear, 8.0 + 2.0 * 6.0)):
        si.setStateValidityChecker(checker(si))
        assert objective.cost(path).value() == pytest.approx(cost, abs=0.6)
    remains = weakref.ref(objective)
    del objective
    gc.collect()
    assert remains() is None


@pytest.mark.parametrize('planner', [og.RRTstar, og.BITstar])
def test_other_planners_minimise_the_driving_cost(planner):
    costs = []
    for isDriving in (True, False):
        setup = iao.simpleSetup(wall([], start=(4, 0, 0), goal=(-4, 0, 0)))
        si = setup.getSpaceInformation()
        driving = iao.DrivingCostObjective(si, reverse_penalty=20, gear_change_penalty=0, steering_change_penalty=0)
        setup.setOptimizationObjective(driving if isDriving else ob.PathLengthOptimizationObjective(si))
        setup.setPlanner(planner(si))
        assert solve(setup, 1.0) == Type.EXACT_SOLUTION
        costs.append(iao.pathCost(setup.getSolutionPath(), driving).value())
    assert costs[0] < 0.5 * costs[1]  # it is shorter to drive in reverse, and costs more


def test_the_search_minimises_driving_costs_and_sums():
    def found(objective=None, **parameters):
        setup = iao.simpleSetup(scenario('parallel.yaml'), **parameters)
        if objective is not None:
            setup.setOptimizationObjective(objective(setup.getSpaceInformation()))
        assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().check()
        return setup.getPlanner().pieces(), setup

    def total(*parts):
        def make(si):
            result = ob.MultiOptimizationObjective(si)
            for part, weight in parts:
                result.addObjective(part(si), weight)
            return result
        return make

    def driving(si, **weights):
        return iao.DrivingCostObjective(si, **{**DRIVING, **weights})

    class Derived(iao.DrivingCostObjective):
        pass

    length, half = ob.PathLengthOptimizationObjective, {name: value / 2 for name, value in DRIVING.items()}
    half['preferred_clearance'] = DRIVING['preferred_clearance']
    assert numpy.array_equal(found(driving)[0], found(**DRIVING)[0])
    assert numpy.array_equal(found(total((length, 1.0), (driving, 1.0)))[0], found(**half)[0])
    own = found()[0]
    for other in (Derived, total((driving, 1.0), (lambda si: driving(si, preferred_clearance=0.2), 1.0)),
                  total((length, 1.0), (driving, -0.1)), total()):
        assert numpy.array_equal(found(other)[0], own)
    # Among the same weights no path costs more than that without the objective.
    path, setup = found(driving)[1].getSolutionPath(), found()[1]
    objective = driving(setup.getSpaceInformation())
    assert objective.cost(path).value() <= objective.cost(setup.getSolutionPath()).value() + 1e-9


def test_changed_objectives_and_cleared_planners_plan_again():
    setup = iao.simpleSetup(scenario('parallel.yaml'))
    si, planner = setup.getSpaceInformation(), setup.getPlanner()
    assert solve(setup) == Type.EXACT_SOLUTION
    found = {'none': planner.pieces()}
    for name in ('driving', 'length', 'driving', 'length'):
        if name in found:
            setup.clear()
        setup.getProblemDefinition().clearSolutionPaths()
        setup.setOptimizationObjective(objectiveNamed(name, si))
        for _ in range(2):
            planner.setup()
        assert solve(setup) == Type.EXACT_SOLUTION
        assert numpy.array_equal(found.setdefault(name, planner.pieces()), planner.pieces())
    assert len({pieces.tobytes() for pieces in found.values()}) == 3


def test_what_an_objective_raises_arrives():
    class Failing(iao.DrivingCostObjective):
        fails = True

        def motionCost(self, first, last):
            if self.fails:
                raise RuntimeError('no cost')
            return super().motionCost(first, last)

    for planner in (iao.ImprovedAStar, og.RRTstar):
        setup = iao.simpleSetup(wall())
        objective = Failing(setup.getSpaceInformation())
        setup.setOptimizationObjective(objective)
        setup.setPlanner(planner(setup.getSpaceInformation()))
        with pytest.raises(RuntimeError, match='no cost'):
            setup.solve(5.0)
        objective.fails = False
        if planner is og.RRTstar:
            setup.clear()
        assert setup.solve(1.0)


def test_weights_that_are_wrong_are_refused():
    setup = iao.simpleSetup(wall())
    si = setup.getSpaceInformation()
    for weights, message in (({'reverse_penalty': -1}, 'reverse_penalty'), ({'reverse': 1}, "'reverse' is not a weight"),
                             ({'heading_bins': 36}, "'heading_bins' is not a weight of the driving cost; these are")):
        with pytest.raises(ia.Error, match=message):
            iao.DrivingCostObjective(si, **weights)
    with pytest.raises(ia.Error, match='not RealVectorStateSpace'):
        iao.DrivingCostObjective(ob.SpaceInformation(ob.RealVectorStateSpace(2)))
    bare = iao.DrivingCostObjective(ob.SpaceInformation(setup.getStateSpace()))
    with pytest.raises(ia.Error, match='the driving cost requires a validity checker'):
        bare.motionCost(state(setup, (0, 0, 0)), state(setup, (1, 0, 0)))


@pytest.mark.parametrize('base', [ob.ReedsSheppStateSpace, ob.DubinsStateSpace])
def test_a_derived_space_is_what_ompl_uses_of_it(base):
    """OMPL does not call what a space derived in Python overrides."""
    class Derived(base):
        def distance(self, first, second):
            return 3.0 * super().distance(first, second)

        def interpolate(self, first, second, fraction, between):
            raise AssertionError('not called by OMPL')

        def satisfiesBounds(self, asked):
            return False

        def getBounds(self):
            return ob.RealVectorBounds(2)

    found = []
    for space in (base(5.0), Derived(5.0)):
        setup = iao.simpleSetup(wall(), space)
        setup.setOptimizationObjective(objectiveNamed('driving', setup.getSpaceInformation()))
        assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().check()
        found.append((setup.getPlanner().pieces(), setup.getPlanner()._space.radius))
    assert numpy.array_equal(found[0][0], found[1][0]) and found[0][1] == found[1][1] == pytest.approx(5.0)


def test_states_out_of_bounds_are_invalid():
    for start, goal, status, approximate in (((99, 0, 0), (10, -5, 0), Type.INVALID_START, True),
                                             ((-10, -5, 0), (99, 0, 0), Type.INVALID_GOAL, False),
                                             ((-10, -5, 0), (99, 0, 0), Type.APPROXIMATE_SOLUTION, True)):
        setup = iao.simpleSetup(wall(), approximate=approximate)
        setup.setStartAndGoalStates(state(setup, start), state(setup, goal))
        for _ in range(2):
            assert solve(setup) == status


def test_replaced_starts_and_goals_begin_a_new_query():
    setup = iao.simpleSetup(wall())
    goal = ob.GoalState(setup.getSpaceInformation())
    goal.setState(state(setup, (10, -5, 0)))
    setup.setGoal(goal)
    assert solve(setup) == Type.EXACT_SOLUTION
    setup.getProblemDefinition().clearStartStates()
    setup.getProblemDefinition().addStartState(state(setup, (-10, 5, 0)))
    setup.getProblemDefinition().clearSolutionPaths()
    assert solve(setup) == Type.EXACT_SOLUTION
    assert rows(setup.getSolutionPath())[0] == pytest.approx((-10, 5, 0))
    goal.setState(state(setup, (10, 5, 0)))
    setup.getProblemDefinition().clearSolutionPaths()
    assert solve(setup) == Type.EXACT_SOLUTION
    assert rows(setup.getSolutionPath())[-1] == pytest.approx((10, 5, 0))


def test_of_many_goals_only_some_are_read():
    class Counted(ob.GoalSampleableRegion):
        """A large finite number of samples, as regions of users have."""
        count = 0

        def sampleGoal(self, goal):
            self.count += 1
            goal.setX(8.0 + 0.37 * self.count % 5)
            goal.setY(-5.0)
            goal.setYaw(0.0)

        def maxSampleCount(self):
            return 2 ** 31 - 1

        def couldSample(self):
            return True

        def distanceGoal(self, other):
            return max(0.0, 8.0 - other.getX())

    setup = iao.simpleSetup(wall())
    region = Counted(setup.getSpaceInformation())
    setup.setGoal(region)
    assert solve(setup) == Type.EXACT_SOLUTION and region.count <= 100


def test_of_a_long_list_few_goals_are_read_at_first_and_more_as_needed():
    def listed(polygons, poses):
        setup = iao.simpleSetup(wall(polygons))
        goals = ob.GoalStates(setup.getSpaceInformation())
        for pose in poses:
            goals.addState(state(setup, pose))
        setup.setGoal(goals)
        setup.setup()
        setup.getPlanner().setProblemDefinition(setup.getProblemDefinition())
        return setup, setup.getPlanner()

    def polls(count):
        left = iter(range(count))
        return lambda: next(left, None) is None

    setup, planner = listed(WALL, [(9.0 + 1e-4 * i, -5.0, 0.0) for i in range(20000)])
    assert planner.solve(polls(2000)).getStatus() == Type.EXACT_SOLUTION and len(planner._goals) == 16
    setup, planner = listed(CLOSED, [*((9.0 + 1e-3 * i, -5.0, 0.0) for i in range(2000)), (-8.0, 0.0, 0.0)])
    assert planner.solve(polls(500)).getStatus() != Type.EXACT_SOLUTION and 16 < len(planner._goals) < 1000
    assert planner.solve(polls(3000)).getStatus() == Type.EXACT_SOLUTION and len(planner._goals) == 2001


def test_goals_that_are_not_finite_are_invalid():
    for value in (math.inf, math.nan):
        for place in range(3):
            setup = iao.simpleSetup(wall())
            pose = [10.0, -5.0, 0.0]
            pose[place] = value
            setup.setGoalState(state(setup, pose))
            assert solve(setup) == Type.INVALID_GOAL


def test_planner_data():
    setup = iao.simpleSetup(wall())
    data = ob.PlannerData(setup.getSpaceInformation())
    assert solve(setup) == Type.EXACT_SOLUTION
    setup.getPlanner().getPlannerData(data)
    assert data.numStartVertices() == 1 and data.numGoalVertices() == 1
    assert data.numVertices() > 10 and data.numEdges() == data.numVertices() - 1  # two trees and what joins them
    assert data.getStartVertex(0).getState().getX() == -10.0 and data.getGoalVertex(0).getState().getX() == 10.0
    assert data.getEdges(data.getStartIndex(0)) and data.getIncomingEdges(data.getGoalIndex(0))
    seen, reached = set(), {data.getStartIndex(0)}
    while reached - seen:
        at = (reached - seen).pop()
        seen.add(at)
        reached |= set(data.getEdges(at))
    assert data.getGoalIndex(0) in reached
    setup.getPlannerData(ob.PlannerData(setup.getSpaceInformation()))  # which must not end the program


def test_benchmark():
    setup = iao.simpleSetup(wall())
    benchmark = ot.Benchmark(setup, 'wall')
    benchmark.addPlanner(setup.getPlanner())
    benchmark.addPlanner(og.RRTConnect(setup.getSpaceInformation()))
    request = ot.Request()
    request.runCount, request.maxTime, request.displayProgress, request.saveConsoleOutput = 2, 2.0, False, False
    benchmark.benchmark(request)
    planners = benchmark.getRecordedExperimentData().planners
    assert [planner.name for planner in planners] == ['geometric_ImprovedAStar', 'geometric_RRTConnect']
    for run in planners[0].runs:
        assert run.to_dict()['correct solution BOOLEAN'] == '1'


def test_other_planners_use_the_checker():
    world = wall()
    setup = iao.simpleSetup(world)
    setup.setPlanner(og.RRTConnect(setup.getSpaceInformation()))
    assert solve(setup, 20.0) == Type.EXACT_SOLUTION
    path = setup.getSolutionPath()
    path.interpolate(300)
    assert world.is_free(rows(path)).all()


def pythonSetup(checker):
    setup = iao.simpleSetup(wall())
    plain = og.SimpleSetup(setup.getStateSpace())
    plain.setStateValidityChecker(checker(plain.getSpaceInformation()))
    plain.setStartAndGoalStates(state(setup, (-10, -5, 0)), state(setup, (10, -5, 0)))
    planner = iao.ImprovedAStar(plain.getSpaceInformation())
    plain.setPlanner(planner)
    return plain, planner


def isOpen(x, y):
    return abs(x) > 2.0 or 3.0 < y < 5.0


class OneByOne(ob.StateValidityChecker):
    def __init__(self, si):
        super().__init__(si)
        self.asked, self.fails = 0, False

    def isValid(self, asked):
        self.asked += 1
        if self.fails and self.asked > 50:
            raise RuntimeError('the map is gone')
        return isOpen(asked.getX(), asked.getY())


class Batched(OneByOne):
    def areValid(self, poses):
        self.batches = getattr(self, 'batches', 0) + 1
        return (numpy.abs(poses[:, 0]) > 2.0) | ((poses[:, 1] > 3.0) & (poses[:, 1] < 5.0))


def test_checkers_in_python():
    paths = []
    for checker in (lambda si: lambda asked: isOpen(asked.getX(), asked.getY()), OneByOne, Batched):
        setup, planner = pythonSetup(checker)
        assert solve(setup) == Type.EXACT_SOLUTION and setup.getSolutionPath().check()
        paths.append(planner.pieces())
    assert numpy.array_equal(paths[0], paths[1]) and numpy.array_equal(paths[0], paths[2])


def test_batches_are_used():
    made = []
    setup, _ = pythonSetup(lambda si: made.append(Batched(si)) or made[0])
    assert solve(setup) == Type.EXACT_SOLUTION
    assert made[0].batches > 10


def test_what_a_checker_raises_arrives():
    made = []
    setup, planner = pythonSetup(lambda si: made.append(OneByOne(si)) or made[0])
    made[0].fails = True
    with pytest.raises(RuntimeError, match='the map is gone'):
        setup.solve(10.0)
    made[0].fails = False
    assert solve(setup) == Type.EXACT_SOLUTION
    Batched.areValid = lambda self, poses: [True]
    setup, planner = pythonSetup(Batched)
    with pytest.raises(ia.Error, match=r'areValid\(\) must return one bool for each of'):
        setup.solve(10.0)


def test_polygons_and_maps():
    setup = iao.simpleSetup(wall())
    si = setup.getSpaceInformation()
    polygons = iao.FootprintChecker(si, WALL, 'tpcap')
    cells = numpy.zeros((200, 200), dtype=numpy.uint8)
    cells[:, 98:102] = 1
    grid = iao.FootprintChecker(si, cells, 'tpcap', resolution=0.2, origin=(-20, -20, 0))
    for checker in (polygons, grid):
        assert checker.isValid(state(setup, (-8, -5, 0))) and not checker.isValid(state(setup, (0, -5, 0)))
        assert checker.clearance(state(setup, (-8, -5, 0))) > 1.0 and checker.clearance(state(setup, (0, -5, 0))) == 0
    assert not polygons.isValid(state(setup, (1e4, 0, 0)))


def test_parameters():
    planner = iao.simpleSetup(wall(), heading_bins=36).getPlanner()
    params = planner.params()
    assert params.getParam('heading_bins') == '36' and len(params) == len(ia.parameters())
    params.setParam('heading_bins', '48')
    assert params['heading_bins'] == 48 and params.hasParam('anytime')
    params['smoothing'], params['anytime'] = 'none', True
    assert params['smoothing'] == 'none' and params.getParam('anytime') == '1'
    params['parameter_set'] = 'hybrid_astar'
    assert params['smoothing'] != 'none' or params['bidirectional'] is False
    for name, value, message in (('heading_bin', 3, 'heading_bins'), ('heading_bins', 3.5, 'heading_bins'),
                                 ('steering_angles', -1, 'steering_angles'), ('motion_model', 'boat', 'motion_model')):
        before = dict(params)
        with pytest.raises(ia.Error, match=message):
            params.setParam(name, value)
        assert dict(params) == before


def test_bad_input():
    space = ob.SE3StateSpace()
    si = ob.SpaceInformation(space)
    for make in (lambda: iao.ImprovedAStar(si), lambda: iao.FootprintChecker(si, wall())):
        with pytest.raises(ia.Error, match='must be an SE2, a Reeds-Shepp or a Dubins state space, not SE3StateSpace'):
            make()
    setup = iao.simpleSetup(wall())
    checker = iao.FootprintChecker(setup.getSpaceInformation(), wall())
    with pytest.raises(ia.Error, match='state must be one of an SE2 space, not RealVectorStateType'):
        checker.isValid(ob.RealVectorStateSpace(4).allocState())
    with pytest.raises(ia.Error, match='vehicle must be given'):
        iao.FootprintChecker(setup.getSpaceInformation(), WALL)


def test_without_ompl_one_sentence_says_what_to_install():
    code = "import sys; sys.modules['ompl'] = None; import improved_astar.ompl"
    done = subprocess.run([sys.executable, '-B', '-c', code], capture_output=True, text=True, check=False)
    assert done.stderr.splitlines()[-1] == \
        "ImportError: improved_astar.ompl needs OMPL 2.0.1 or later: pip install 'ompl>=2.0.1'"


def test_the_example_and_the_page_run():
    root = os.environ['PARKING_SOURCE_DIR']
    with open(os.path.join(root, 'docs', 'python.md'), encoding='utf-8') as page:
        text = page.read().split("## With OMPL's own Python package")[1]
    for program in ([os.path.join(root, 'examples', 'python', 'ompl_planner.py')],
                    ['-c', text.split('```python\n')[1].split('```')[0]]):
        done = subprocess.run([sys.executable, '-B', *program], cwd=root, capture_output=True, text=True, check=False)
        assert done.returncode == 0 and ' m' in done.stdout, done.stderr


def memory():
    gc.collect()
    with open('/proc/self/statm', encoding='ascii') as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 2 ** 20


def test_memory_does_not_grow():
    setup = iao.simpleSetup(wall())
    for number in range(1000):
        if number == 300:
            before = memory()
        setup.clear()
        assert setup.solve(1.0)
    assert memory() - before < 3.0  # MiB
