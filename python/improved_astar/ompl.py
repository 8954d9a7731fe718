"""Improved A* for OMPL's own Python package: a planner, its cost as an objective, and checks of a car among obstacles.

    from improved_astar import Scenario
    from improved_astar.ompl import simpleSetup

    setup = simpleSetup(Scenario.read('narrow_parallel.yaml'))
    if setup.solve(1.0):
        print(setup.getSolutionPath().printAsMatrix())

Names are OMPL's. States are poses (x, y, yaw) of the rear axle's midpoint.
"""
import collections.abc
import functools
import math
import weakref
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple, Union

import numpy
from numpy.typing import ArrayLike

from . import _core
from ._core import Error, Scenario, Vehicle

try:
    from ompl import base as ob, geometric as og
    if not hasattr(ob, 'SE2StateType'):
        raise ImportError('this is another OMPL')
except ImportError as error:
    raise ImportError("improved_astar.ompl needs OMPL 2.0.1 or later: pip install 'ompl>=2.0.1'") from error

__all__ = ['DrivingCostObjective', 'FootprintChecker', 'ImprovedAStar', 'Parameters', 'SweptMotionValidator',
           'pathCost', 'simpleSetup']

MAX_SAMPLED_GOALS = 16   # read at first from a region or a longer list
MAX_LISTED_GOALS = 1000  # all are read from a list of this length
GOAL_ATTEMPTS = 1000     # samples of a region for a first valid or reachable goal
SUMMED_WEIGHTS = ('reverse_penalty', 'gear_change_penalty', 'steering_change_penalty', 'clearance_cost')
WEIGHTS = (*SUMMED_WEIGHTS, 'preferred_clearance', 'turning_radius')
FARTHEST_DUBINS = 1e7    # turning radii from the origin, beyond which rounding may change OMPL's curves

Status = ob.PlannerStatus
Pose = Tuple[float, float, float]


class _Space:
    """A planar space as OMPL uses it: OMPL does not call what a class derived in Python overrides."""

    def __init__(self, si: ob.SpaceInformation) -> None:
        space = si.getStateSpace()
        if isinstance(space, ob.ReedsSheppStateSpace):
            self.kind, base = 'reeds_shepp', ob.ReedsSheppStateSpace
        elif isinstance(space, ob.DubinsStateSpace):
            self.kind, base = 'dubins', ob.DubinsStateSpace
        elif isinstance(space, ob.SE2StateSpace):
            self.kind, base = 'se2', ob.SE2StateSpace
        else:
            raise Error('space must be an SE2, a Reeds-Shepp or a Dubins state space, not '
                        f'{type(space).__name__}')
        self.allocState = functools.partial(base.allocState, space)
        self.distance = functools.partial(base.distance, space)
        self.interpolate = functools.partial(base.interpolate, space)
        self.satisfiesBounds = functools.partial(base.satisfiesBounds, space)
        self.isSymmetric = base.hasSymmetricInterpolate(space)
        self._getBounds = functools.partial(base.getBounds, space)

    @functools.cached_property
    def states(self) -> Tuple[ob.State, ob.State, ob.State]:
        """Three states for all queries, because OMPL does not free all memory of a state that Python deletes."""
        return self.allocState(), self.allocState(), self.allocState()

    @functools.cached_property
    def radius(self) -> float:
        """Turning radius of the curves in metres, 0 on a plain space."""
        if self.kind == 'se2':
            return 0.0
        unit = ob.ReedsSheppStateSpace(1.0) if self.kind == 'reeds_shepp' else \
            ob.DubinsStateSpace(1.0, self.isSymmetric)
        # OMPL has no getter for the radius. A distance is proportional to it.
        ends = _put(self.states[0], (0.0, 0.0, 0.0)), _put(self.states[1], (0.0, 0.0, 0.5 * math.pi))
        return self.distance(*ends) / unit.distance(*ends)

    def bounds(self) -> Tuple[float, float, float, float]:
        """Returns the smallest and the largest x, y."""
        bounds = self._getBounds()
        return (*bounds.low, *bounds.high)

    def distanceBetween(self, first: Pose, last: Pose) -> float:
        return self.distance(_put(self.states[0], first), _put(self.states[1], last))

    def poseBetween(self, first: Pose, last: Pose, fraction: float) -> Pose:
        self.interpolate(_put(self.states[0], first), _put(self.states[1], last), fraction, self.states[2])
        return _poseOf(self.states[2])


def _put(state: ob.State, pose: Pose) -> ob.State:
    state.setX(pose[0])
    state.setY(pose[1])
    state.setYaw(pose[2])
    return state


def _poseOf(state: ob.State) -> Pose:
    try:
        return state.getX(), state.getY(), state.getYaw()
    except AttributeError:
        raise Error(f'state must be one of an SE2 space, not {type(state).__name__}') from None


def _never() -> bool:
    return False


def _isSampling(goal: ob.Goal) -> bool:
    """Whether another thread may still add goals."""
    return isinstance(goal, ob.GoalLazySamples) and goal.isSampling()


def _isShort(goal: ob.GoalSampleableRegion) -> bool:
    """Whether the goals are so few that all are read at first."""
    return goal.maxSampleCount() <= MAX_LISTED_GOALS


def _isList(goal: ob.GoalSampleableRegion) -> bool:
    """Whether the goals are a list. Large finite numbers of samples stand for a continuous region."""
    return isinstance(goal, ob.GoalStates) or _isShort(goal)


def _storedGoals(goal: ob.Goal, count: int) -> List[Pose]:
    """Returns up to count goals that OMPL has stored so far: those of a goal state or a list."""
    if isinstance(goal, ob.GoalState):
        return [_poseOf(goal.getState())]
    if isinstance(goal, ob.GoalStates):
        return [_poseOf(goal.getState(index)) for index in range(min(count, goal.getStateCount()))]
    return []


def _scenarioOf(si: ob.SpaceInformation, world: Any, vehicle: Any, resolution: Any, origin: Any) -> Scenario:
    if isinstance(world, Scenario):
        return world if vehicle is None else world.replace(vehicle=vehicle)
    if vehicle is None:
        raise Error('vehicle must be given with polygons or a grid: a Vehicle, or the name or file of one')
    # Start and goal at its corners extend a world of polygons over the whole space.
    bounds = si.getStateSpace().getBounds()
    low, high = (*bounds.low, 0.0), (*bounds.high, 0.0)
    if isinstance(world, (list, tuple)) and numpy.ndim(world[0] if world else [[]]) == 2:
        return Scenario.from_polygons(world, low, high, vehicle=vehicle)
    if origin is None and not isinstance(world, (str, bytes)) and not hasattr(world, '__fspath__'):
        origin = (0.0, 0.0, 0.0)
    middle = tuple(0.5 * (a + b) for a, b in zip(low, high))
    return Scenario.from_grid(world, middle, middle, resolution=resolution, origin=origin, vehicle=vehicle)


class FootprintChecker(ob.StateValidityChecker):
    """Validity checker for any OMPL planner: the body of the car must be free of obstacles.

    world: a Scenario; or, with a vehicle, a list of polygons (each n rows x, y) or a map (an array or a file as for
    Scenario.from_grid).
    """

    def __init__(self, si: ob.SpaceInformation, world: Any, vehicle: Union[None, str, Vehicle] = None, *,
                 resolution: Optional[float] = None, origin: Optional[ArrayLike] = None) -> None:
        super().__init__(si)
        self._space = _Space(si)
        self.scenario = _scenarioOf(si, world, vehicle, resolution, origin)
        self.footprint = _core._Footprint(self.scenario)

    def isValid(self, state: ob.State) -> bool:
        x, y, yaw = _poseOf(state)
        return self._space.satisfiesBounds(state) and self.footprint.is_free(x, y, yaw)

    def clearance(self, state: ob.State) -> float:
        x, y, yaw = _poseOf(state)
        return self.footprint.clearance(x, y, yaw) if self._space.satisfiesBounds(state) else 0.0


class SweptMotionValidator(ob.MotionValidator):
    """Motion validator for any OMPL planner that proves motions free along their whole length.

    It is sound but not complete: it may reject a motion that passes an obstacle closer than a millimetre.
    """

    def __init__(self, si: ob.SpaceInformation, checker: FootprintChecker) -> None:
        super().__init__(si)
        self.checker = checker
        self._space = _Space(si)
        self._curvature = 1.0 / self._space.radius if self._space.radius else 0.0

    def checkMotion(self, first: ob.State, last: ob.State) -> bool:
        if not self.checker.isValid(last):
            return False
        if self._space.kind == 'se2':
            return self.checker.footprint.is_line_free(*_poseOf(first), *_poseOf(last))

        between = self._space.states[2]

        def at(fraction: float) -> Optional[Pose]:
            self._space.interpolate(first, last, fraction, between)
            return _poseOf(between) if self._space.satisfiesBounds(between) else None

        return self.checker.footprint.is_curve_free(at, self._space.distance(first, last), self._curvature)


class DrivingCostObjective(ob.OptimizationObjective):
    """The cost that ImprovedAStar minimises, as an objective for any planner: length, driving in reverse, changes of
    direction, steering, and passing obstacles closely. The unit is a metre driven forwards with sufficient clearance.

    weights: reverse_penalty, gear_change_penalty, steering_change_penalty, preferred_clearance, clearance_cost; on a
    plain SE2 space also turning_radius. improved_astar.parameters() documents them. The distance to obstacles is that
    of the validity checker; without one that has a method clearance(), proximity costs nothing.

    OMPL adds up the costs of motions. Changes of direction and steering between two motions are free in this sum;
    pathCost() includes them.
    """

    def __init__(self, si: ob.SpaceInformation, **weights: float) -> None:
        super().__init__(si)
        self._si, self._space = si, _Space(si)
        for name in weights:
            if name not in WEIGHTS:
                raise Error(f"'{name}' is not a weight of the driving cost; these are {', '.join(WEIGHTS)}")
        self._parameters = _core._with_parameters(weights)
        self._checker: Any = None
        self._known: Any = None

    @property
    def weights(self) -> Dict[str, float]:
        """All weights."""
        return {name: self._parameters[name] for name in WEIGHTS}

    def _costs(self) -> Any:
        """Returns the costs with the clearances of the current checker."""
        checker = self._si.getStateValidityChecker()
        if checker is None:
            raise Error('the driving cost requires a validity checker: set that of the SpaceInformation first')
        if self._known is None or checker is not self._checker:
            clearance: Any = None
            if type(checker) is FootprintChecker:
                clearance = checker.footprint
            elif type(checker).clearance is not ob.StateValidityChecker.clearance:
                state = self._space.states[2]  # the core must not hold this object, which holds the core's

                def clearance(*pose: float) -> float:
                    return checker.clearance(_put(state, pose))
            self._checker, self._known = checker, _core._DrivingCosts(self._space, clearance, self._parameters)
        return self._known

    def stateCost(self, state: ob.State) -> ob.Cost:
        """Returns zero: only motions cost."""
        return ob.Cost(0.0)

    def motionCost(self, first: ob.State, last: ob.State) -> ob.Cost:
        """Returns the cost of the motion between two states; infinite if one is not finite."""
        return ob.Cost(self._costs().along((_poseOf(first), _poseOf(last))))

    def motionCostHeuristic(self, first: ob.State, last: ob.State) -> ob.Cost:
        """Returns a lower bound: the length of the shortest curve between two states."""
        return ob.Cost(self._costs().lower_bound(_poseOf(first), _poseOf(last)))

    def isSymmetric(self) -> bool:
        """Returns whether motions cost the same in both directions."""
        return self._costs().is_symmetric

    def cost(self, path: og.PathGeometric) -> ob.Cost:
        """Returns the cost of a whole path, with the changes of direction and steering between its motions."""
        return ob.Cost(self._costs().along([_poseOf(state) for state in path.getStates()]))


def _costBetweenMotions(path: og.PathGeometric, objective: ob.OptimizationObjective) -> float:
    """Returns the part of a driving cost, also within a sum, that OMPL's cost of a path lacks."""
    if type(objective) is DrivingCostObjective:
        return objective.cost(path).value() - path.cost(objective).value()
    if type(objective) is ob.MultiOptimizationObjective:
        return sum(objective.getObjectiveWeight(index) * _costBetweenMotions(path, objective.getObjective(index))
                   for index in range(objective.getObjectiveCount()))
    return 0.0


def pathCost(path: og.PathGeometric, objective: ob.OptimizationObjective) -> ob.Cost:
    """Returns the cost of a whole path: that of OMPL, with the changes between motions for a DrivingCostObjective, also
    within a sum."""
    if type(objective) is DrivingCostObjective:
        return objective.cost(path)
    return ob.Cost(path.cost(objective).value() + _costBetweenMotions(path, objective))


def _summands(objective: Optional[ob.OptimizationObjective], factor: float = 1.0) -> Iterator[Tuple[float, Any]]:
    if type(objective) is not ob.MultiOptimizationObjective:
        yield factor, objective
        return
    for index in range(objective.getObjectiveCount()):
        yield from _summands(objective.getObjective(index), factor * objective.getObjectiveWeight(index))


def _searchParameters(objective: Optional[ob.OptimizationObjective], own: Dict[str, Any]) -> Dict[str, Any]:
    """Returns the parameters of a search by the objective: those of the planner with the weights of lengths, driving
    costs and their sums; for any other objective and for sums that are not a cost of the search, the planner's own."""
    length, weights = 0.0, dict.fromkeys((*SUMMED_WEIGHTS, 'preferred_clearance'), 0.0)
    for factor, part in _summands(objective):
        isDriving = type(part) is DrivingCostObjective
        if not (isDriving or type(part) is ob.PathLengthOptimizationObjective) or not factor >= 0.0:
            return own
        length += factor
        if not isDriving or factor == 0.0:
            continue
        known = weights['preferred_clearance'] if weights['clearance_cost'] > 0.0 else None
        for name in SUMMED_WEIGHTS:
            weights[name] += factor * part.weights[name]
        if part.weights['clearance_cost'] > 0.0:
            weights['preferred_clearance'] = part.weights['preferred_clearance']
            if known not in (None, weights['preferred_clearance']):
                return own
    if not 0.0 < length < math.inf:
        return own
    return {**own, **weights, **{name: weights[name] / length for name in SUMMED_WEIGHTS}}


class Parameters(collections.abc.Mapping):
    """Parameters of the planner, with the methods of OMPL's ParamSet. improved_astar.parameters() documents them."""

    def __init__(self, values: Dict[str, Any]) -> None:
        self.current = _core._with_parameters(values)  # another dict after each change

    def setParam(self, name: str, value: Any) -> None:
        """Sets a parameter. For an invalid value it raises Error with the valid ones and changes nothing."""
        text = str(value).lower() if isinstance(value, bool) else str(value)
        self.current = _core._with_parameter(self.current, name, text)

    def getParam(self, name: str) -> str:
        value = self[name]
        return str(int(value)) if isinstance(value, bool) else str(value)

    def hasParam(self, name: str) -> bool:
        return name in self.current

    def getParamNames(self) -> List[str]:
        return list(self.current)

    def __getitem__(self, name: str) -> Any:
        return self.current[name]

    def __setitem__(self, name: str, value: Any) -> None:
        self.setParam(name, value)

    def __iter__(self) -> Iterator[str]:
        return iter(self.current)

    def __len__(self) -> int:
        return len(self.current)


class _World:
    """OMPL's objects as the core uses them. Poses are rows x, y, yaw."""

    def __init__(self, si: ob.SpaceInformation, space: _Space) -> None:
        self._si, self._space = si, space
        self._first, self._last, _ = space.states
        self.areValid: Optional[Callable[[numpy.ndarray], ArrayLike]] = None
        self.isTimeUp: Callable[[], bool] = _never

    def freeCounts(self, rows: numpy.ndarray, parts: List[int]) -> Optional[List[int]]:
        """Returns the number of valid rows at the beginning of each part, or None once the time limit is met."""
        if self.areValid is not None:
            bounds = self._space.bounds()
            valid = numpy.asarray(self.areValid(rows), dtype=bool)
            if valid.shape != (len(rows),):
                raise Error(f'areValid() must return one bool for each of {len(rows)} poses, not an array of shape '
                            f'{valid.shape}')
            valid &= ((rows[:, :2] >= bounds[:2]) & (rows[:, :2] <= bounds[2:])).all(axis=1)
            pieces = numpy.split(valid, numpy.cumsum(parts)[:-1])
            return [len(piece) if piece.all() else int(piece.argmin()) for piece in pieces]
        poses, counts, begin = rows.tolist(), [], 0
        for part in parts:
            count = 0
            while count < part:
                if self.isTimeUp():
                    return None
                state = _put(self._first, poses[begin + count])
                if not (self._si.satisfiesBounds(state) and self._si.isValid(state)):
                    break
                count += 1
            counts.append(count)
            begin += part
        return counts

    def freeMotions(self, rows: numpy.ndarray, always: bool) -> Optional[int]:
        """Returns the number of valid motions from the first row on, or None once the time limit is met."""
        poses = rows.tolist()
        for count in range(len(poses) - 1):
            if not always and self.isTimeUp():
                return None
            if not self._si.checkMotion(_put(self._first, poses[count]), _put(self._last, poses[count + 1])):
                return count
        return len(poses) - 1

    def distance(self, *poses: float) -> float:
        return self._space.distanceBetween(poses[:3], poses[3:])


class ImprovedAStar(ob.Planner):
    """Improved A* as an OMPL planner for SE2, Reeds-Shepp and Dubins spaces.

    Supports any validity checker. With a FootprintChecker the search stays in C++. A checker with a method
    areValid(poses), which maps n rows x, y, yaw to n bool, is called in batches. Parameters are set by name here, or
    later through params(). The search minimises OMPL's path length, a DrivingCostObjective or a sum of these if that is
    the objective of the problem; any other objective is evaluated for each path found.
    """

    def __init__(self, si: ob.SpaceInformation, name: str = 'ImprovedAStar', **parameters: Any) -> None:
        super().__init__(si, name)
        self._si, self._space = si, _Space(si)
        self._params = Parameters(parameters)
        self._world, self._state = _World(si, self._space), self._space.states[2]
        self._dataStates: List[ob.State] = []
        self._inputs = ob.PlannerInputStates()
        self._clearQuery()
        # OMPL would copy a PlannerData to call a method of this class from C++, which ends the program, since it cannot
        # be copied. This call makes OMPL cache that the class has no such method; Python finds that of the object.
        super().getPlannerData(ob.PlannerData(si))
        self.getPlannerData = functools.partial(type(self)._getPlannerData, weakref.proxy(self))

    def params(self) -> Parameters:
        return self._params

    def reason(self) -> str:
        """Why there is no solution, in one line; empty with a solution, or if only the time limit was met."""
        return self._reason

    def clear(self) -> None:
        super().clear()
        self._clearQuery()

    def clearQuery(self) -> None:
        self._clearQuery()

    def _clearQuery(self) -> None:
        self._query: Any = None
        self._asked: Tuple[Any, ...] = ()
        self._reason = ''
        self._starts: List[Pose] = []
        self._goals: List[Pose] = []
        self._storedGoals: List[Pose] = []
        self._otherGoals = 0
        self._bestCost: Any = None
        self._inputs.clear()

    def solve(self, ptc: Any, checkInterval: float = 0.0) -> ob.PlannerStatus:
        if isinstance(ptc, (int, float)):
            ptc = ob.timedPlannerTerminationCondition(float(ptc))
        elif not isinstance(ptc, ob.PlannerTerminationCondition):
            ptc = ob.PlannerTerminationCondition(ptc, *([checkInterval] if checkInterval > 0.0 else []))
        try:
            return Status(self._solve(ptc))
        except BaseException:
            self._clearQuery()  # the planner can be used again
            raise
        finally:
            self._world.isTimeUp = _never  # nothing is kept of a condition, which may know this planner

    def _solve(self, ptc: ob.PlannerTerminationCondition) -> ob.PlannerStatus.PlannerStatusType:
        self.checkValidity()
        pdef, si = self.getProblemDefinition(), self._si
        goal = pdef.getGoal()
        objective, own = pdef.getOptimizationObjective(), self._params.current
        asked = (pdef, goal, si.getStateValidityChecker(), si.getMotionValidator(), objective, own,
                 _searchParameters(objective, own))
        # Goals beyond those that were read do not matter. To read a long list takes longer than to search.
        starts, storedGoals = self._validStarts(pdef), _storedGoals(goal, max(MAX_LISTED_GOALS, len(self._goals)))
        if self._query is not None and not (all(a is b or a == b for a, b in zip(asked, self._asked))
                                            and starts[:len(self._starts)] == self._starts
                                            and storedGoals[:len(self._storedGoals)] == self._storedGoals):
            self._clearQuery()
        self._storedGoals = storedGoals
        self._reason = ''
        if ptc() and not (self._query is not None and self._query.has_solution):
            return Status.TIMEOUT
        if not isinstance(goal, ob.GoalSampleableRegion):
            return Status.UNRECOGNIZED_GOAL_TYPE
        if self._query is None:
            self._begin(asked)
        self._world.isTimeUp = ptc
        self._inputs.use(pdef)
        for start in starts[len(self._starts):]:
            self._query.add_start(*start)
        self._starts = starts
        if not starts:
            return Status.INVALID_START
        failure = self._readGoals(goal, ptc)
        if failure == Status.TIMEOUT:
            return failure
        fallback = None
        if failure == Status.INVALID_GOAL:
            self._reason = 'no goal is valid'
            fallback = self._anyGoal(goal)
            if fallback is None or not all(map(math.isfinite, fallback)) or not self._params['approximate']:
                return failure
        return self._search(goal, ptc, fallback)

    @staticmethod
    def _validStarts(pdef: ob.ProblemDefinition) -> List[Pose]:
        """Returns the valid starts of a problem. Reading all of them each time detects starts that were replaced."""
        inputs, starts = ob.PlannerInputStates(), []
        inputs.use(pdef)
        while (state := inputs.nextStart()) is not None:
            starts.append(_poseOf(state))
        return starts

    def _begin(self, asked: Tuple[Any, ...]) -> None:
        _, _, checker, validator, _, own, parameters = self._asked = asked
        kind, radius, box = self._space.kind, self._space.radius, self._space.bounds()
        footprint = checker.footprint if type(checker) is FootprintChecker else None
        isOwn = footprint is not None and type(validator) is SweptMotionValidator and \
            validator.checker.footprint is footprint
        mayDeviate = kind == 'dubins' and max(map(abs, box)) > FARTHEST_DUBINS * radius
        isSwept = isOwn and kind != 'se2' and parameters['steering_angles'] == 3 and not mayDeviate
        self._world.areValid = getattr(checker, 'areValid', None)
        self._query = _core._OmplQuery(self._world, footprint, kind, radius, box,
                                       self._si.getStateSpace().getLongestValidSegmentLength(), isSwept,
                                       isOwn and kind == 'se2', parameters, own)

    def _addGoal(self, state: Optional[ob.State]) -> bool:
        if state is None or not self._query.add_goal(*_poseOf(state)):
            return False
        self._goals.append(_poseOf(state))
        return True

    def _readGoals(self, goal: ob.GoalSampleableRegion, ptc: ob.PlannerTerminationCondition) -> Any:
        """Reads the first goals. Returns None, INVALID_GOAL or TIMEOUT."""
        isList = _isList(goal)
        maxGoals = MAX_LISTED_GOALS if _isShort(goal) else MAX_SAMPLED_GOALS
        attempt = 0
        while (isList or attempt < GOAL_ATTEMPTS) and self._inputs.haveMoreGoalStates() and \
                (attempt == 0 or not ptc()):
            if len(self._goals) >= maxGoals:
                break
            state = self._inputs.nextGoal()
            if state is None and not isList and self._goals:
                break
            self._addGoal(state)
            attempt += 1
        # Goals may still be sampled. For a list that is exhausted OMPL would wait until the time limit.
        mayHaveMore = _isSampling(goal) or goal.maxSampleCount() == 0
        if not self._goals and goal.couldSample() and mayHaveMore:
            self._addGoal(self._inputs.nextGoal(ptc))
        if self._goals:
            return None
        hasSeenAll = (not isList and attempt == GOAL_ATTEMPTS) or \
            not (self._inputs.haveMoreGoalStates() or mayHaveMore)
        return Status.INVALID_GOAL if hasSeenAll or not ptc() else Status.TIMEOUT

    def _mayHaveOtherGoals(self, goal: ob.GoalSampleableRegion) -> bool:
        return self._inputs.haveMoreGoalStates() or _isSampling(goal)

    def _readMoreGoals(self, goal: ob.GoalSampleableRegion, ptc: ob.PlannerTerminationCondition) -> bool:
        """Reads up to as many goals again as there are: to search on takes longer the more there are."""
        known = len(self._goals)
        while not ptc() and self._mayHaveOtherGoals(goal) and len(self._goals) < 2 * known and \
                (_isList(goal) or self._otherGoals < GOAL_ATTEMPTS):
            self._otherGoals += 1
            waits = _isSampling(goal)
            if self._addGoal(self._inputs.nextGoal(ptc) if waits else self._inputs.nextGoal()) and waits:
                break
        return len(self._goals) > known

    def _anyGoal(self, goal: ob.GoalSampleableRegion) -> Optional[Pose]:
        if goal.maxSampleCount() == 0:
            return None
        if isinstance(goal, ob.GoalStates):
            return _poseOf(goal.getState(0))
        goal.sampleGoal(self._state)
        return _poseOf(self._state)

    def _search(self, goal: ob.GoalSampleableRegion, ptc: ob.PlannerTerminationCondition,
                fallback: Optional[Pose]) -> ob.PlannerStatus.PlannerStatusType:
        query, pdef = self._query, self.getProblemDefinition()
        objective = pdef.getOptimizationObjective()

        def judge(rows: numpy.ndarray) -> int:
            cost = pathCost(self._path(rows), objective)
            if self._bestCost is not None and not objective.isCostBetterThan(cost, self._bestCost):
                return 0
            self._bestCost = cost
            return 2 if objective.isSatisfied(cost) else 1

        isExhausted = False
        if self._goals:
            judgeOrNone = judge if objective is not None else None
            outcome = query.solve(ptc, judgeOrNone)
            while outcome == 'exhausted' and self._readMoreGoals(goal, ptc):
                outcome = query.solve(ptc, judgeOrNone)
            isExhausted = outcome == 'exhausted'
        isInfeasible = isExhausted and not self._mayHaveOtherGoals(goal)
        if isExhausted and not isInfeasible:
            self._reason = f'none of the {len(self._goals)} goals that were sampled can be reached; others may be'
        elif self._goals:
            self._reason = query.reason(isInfeasible)
        if query.has_solution:
            self._reason = ''
            pdef.addSolutionPath(self._path(query.states(True)), False, 0.0, self.getName())
            return Status.EXACT_SOLUTION
        target = self._goals[0] if self._goals else fallback
        if self._params['approximate'] and query.approximate(*target, ptc):
            path = self._path(query.states(False))
            difference = self._differenceFromGoal(goal, path.getState(path.getStateCount() - 1), target)
            pdef.addSolutionPath(path, True, difference, self.getName())
            return Status.APPROXIMATE_SOLUTION
        return Status.INFEASIBLE if isInfeasible else Status.TIMEOUT

    def _path(self, rows: numpy.ndarray) -> og.PathGeometric:
        path, state = og.PathGeometric(self._si), self._state
        for pose in rows.tolist():
            path.append(_put(state, pose))
        return path

    def _differenceFromGoal(self, goal: ob.GoalSampleableRegion, state: ob.State,
                            target: Pose) -> float:
        if not isinstance(goal, (ob.GoalState, ob.GoalStates)):
            return goal.isSatisfiedWithDistance(state)[1]
        # The goal itself would measure the distance to states out of bounds, which ends the program.
        differences = []
        for pose in self._goals[:MAX_LISTED_GOALS] or [target]:  # thousands would take longer than is left
            _put(self._state, pose)
            self._si.enforceBounds(self._state)
            differences.append(self._si.distance(state, self._state))
        return min(differences)

    def pieces(self) -> numpy.ndarray:
        """Returns the last exact solution as m rows curvature, length, sharpness, turn; no rows without one."""
        return self._query.pieces if self._query is not None else numpy.empty((0, 4))

    def _getPlannerData(self, data: ob.PlannerData) -> None:
        """Adds both frontiers and the last exact solution, with edges in the direction of driving. The data holds
        copies of the states."""
        if self._query is None:
            return
        spare = iter(self._dataStates)

        def vertex(pose: List[float], tag: int) -> ob.PlannerDataVertex:
            state = next(spare, None)
            if state is None:
                state = self._space.allocState()
                added.append(state)
            return ob.PlannerDataVertex(_put(state, pose), tag)

        added: List[ob.State] = []
        roots: Tuple[List[Any], List[Any]] = ([], [])
        for ofGoal in (False, True):
            rows, parents = self._query.frontier(ofGoal)
            indices = []
            for pose, parent in zip(rows.tolist(), parents):
                add = data.addVertex if parent >= 0 else data.addGoalVertex if ofGoal else data.addStartVertex
                indices.append(add(vertex(pose, 1 + ofGoal)))
                if parent < 0:
                    roots[ofGoal].append((indices[-1], pose))
            for index, parent in zip(indices, parents):
                if parent >= 0:
                    data.addEdge(*((index, indices[parent]) if ofGoal else (indices[parent], index)))
        if self._query.has_solution:
            path = self._query.states(True).tolist()
            first, last = (min(found, key=lambda root, end=end: math.dist(root[1], end))[0]
                           for found, end in zip(roots, (path[0], path[-1])))
            between = [data.addVertex(vertex(pose, 0)) for pose in path[1:-1]]
            for index, following in zip([first, *between], [*between, last]):
                data.addEdge(index, following)
        data.decoupleFromPlanner()
        self._dataStates += added


def simpleSetup(scenario: Scenario, space: Optional[ob.SE2StateSpace] = None, **parameters: Any) -> og.SimpleSetup:
    """Creates a SimpleSetup for a scenario: bounds, checker, motion validator, start, goals and planner.

    space: default is a Reeds-Shepp space with the turning radius of the vehicle.
    """
    if space is None:
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
    state, goals = space.allocState(), ob.GoalStates(si)
    setup.setStartState(_put(state, scenario.start))
    for goal in scenario.goals:
        goals.addState(_put(state, goal))
    setup.setGoal(goals)
    if type(space) is ob.SE2StateSpace:
        parameters.setdefault('turning_radius', scenario.vehicle.turning_radius)
    setup.setPlanner(ImprovedAStar(si, **parameters))
    return setup
