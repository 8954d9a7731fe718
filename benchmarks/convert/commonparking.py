"""Cases and results of CommonParking (github.com/libai1943/CommonParking).

Cases (LoadCase.m and CheckCase.m): a MATLAB struct caseData with task {x0, y0, theta0, xf, yf, thetaf} and obstacle
{num_obs, obs{j}: x, y (closed), num_grids, kind, area}. Poses are of the rear axle's middle; the car is TPCAP's with a
steering angle of up to 0.7 rad (BenchmarkConfig.m).

Results (docs/RESULT_FORMAT.md and evaluation/+cpe/ValidateResult.m): a MATLAB struct result with either a path or a
trajectory. Samples of a path are equally spaced within each run of a gear, at most 5 cm apart."""
import re
from pathlib import Path

import numpy as np

from improved_astar import Error, Vehicle

from . import matlab
from .scenarios import obstacle_polygons, scenario_of_polygons
from .text import number

SAME_CORNER = 1e-10   # maximum distance in metres of first and last corner of a closed outline
SPACING = 0.05        # maximum distance in metres between the samples of a path
LONGEST = 1000.0      # metres of a path
LONGEST_TIME = 600.0  # seconds of a trajectory
MOST_SAMPLES = 2000000
AT_REST = 1e-6        # m/s
TRAJECTORY_COLUMNS = ('t', 'x', 'y', 'theta', 'v', 'phi', 'a', 'omega')


def read_case(file, content, vehicle, start, goal):
    case = MatlabField(file, 'caseData', matlab.read(file, content, 'caseData'))
    task, obstacle = case.member('task'), case.member('obstacle')
    start = start or [task.member(name).number() for name in ('x0', 'y0', 'theta0')]
    goal = goal or [task.member(name).number() for name in ('xf', 'yf', 'thetaf')]
    count = obstacle.member('num_obs').number()
    polygons = []
    for each in obstacle.member('obs').cells(count):
        x, y = each.member('x').vector(), each.member('y').vector()
        if x.size != y.size:
            raise Error(f'{file}: {each.name} has {x.size} x and {y.size} y')
        corners = np.column_stack([x, y])
        if len(corners) > 1 and np.hypot(*(corners[0] - corners[-1])) < SAME_CORNER:
            corners = corners[:-1]
        polygons.append(corners)
    car = vehicle or Vehicle('tpcap', name='commonparking', max_steering_angle=0.7)
    return scenario_of_polygons(file, polygons, start, goal, car)


class MatlabField:
    """A value of a MATLAB file and its name in messages."""

    def __init__(self, file, name, value):
        self.file, self.name, self.value = file, name, value

    def member(self, name):
        if not isinstance(self.value, dict) or name not in self.value:
            raise Error(f'{self.file}: {self.name} has no field {name}')
        return MatlabField(self.file, f'{self.name}.{name}', self.value[name])

    def cells(self, count):
        if not isinstance(self.value, list) or len(self.value) != count:
            raise Error(f'{self.file}: {self.name} must be a cell array of num_obs = {number(count)} obstacles')
        return [MatlabField(self.file, f'{self.name}{{{k}}}', each) for k, each in enumerate(self.value, 1)]

    def vector(self):
        if not isinstance(self.value, np.ndarray) or self.value.size == 0 or min(self.value.shape) != 1:
            raise Error(f'{self.file}: {self.name} must be a vector of numbers')
        vector = self.value.ravel()
        if not np.isfinite(vector).all():
            raise Error(f'{self.file}: {self.name} contains {number(vector[~np.isfinite(vector)][0])}')
        return vector

    def number(self):
        vector = self.vector()
        if vector.size != 1:
            raise Error(f'{self.file}: {self.name} must be one number, not {vector.size}')
        return float(vector[0])


def case_content(scenario, file):
    obstacles = []
    for polygon in obstacle_polygons(scenario):
        corners = polygon.tolist()  # for few corners Python's own numbers are faster than NumPy
        area = 0.5 * sum(x * next_y - next_x * y
                         for (x, y), (next_x, next_y) in zip(corners, corners[1:] + corners[:1]))
        counter_clockwise = polygon if area >= 0.0 else polygon[::-1]
        ring = np.append(counter_clockwise, counter_clockwise[:1], axis=0)
        obstacles.append({'x': ring[:, 0], 'y': ring[:, 1], 'num_grids': float(len(polygon)), 'kind': 'obstacle',
                          'area': abs(area)})
    task = dict(zip(('x0', 'y0', 'theta0', 'xf', 'yf', 'thetaf'), (*scenario.start, *scenario.goals[0])))
    identifier = re.search(r'\d*$', Path(file).stem).group()  # 7 of Case07
    return matlab.content_of('caseData', {
        'id': float(identifier or 1), 'task': task,
        'obstacle': {'num_obs': float(len(obstacles)), 'obs': obstacles}})


def path_content(result):
    """The path in equally spaced samples within each run of a gear, and its arcs."""
    x, y, yaw = result.path.start
    s, poses, curvatures, gears, cusps = [np.zeros(1)], [np.array([[x, y, yaw]])], [], [], [1.0]
    for run in result.path.runs():
        driven = np.abs(run.lengths)
        ends = np.cumsum(driven)
        count = max(1, int(np.ceil(ends[-1] / SPACING - 1e-9)))
        places = ends[-1] * np.arange(1, count + 1) / count
        piece = np.minimum(np.searchsorted(ends, places), len(ends) - 1)
        within = np.minimum(places - (ends - driven)[piece], driven[piece])
        poses.append(run.advanced(piece, within))
        # A sample has the curvature of the following piece; the run's first one was the last of the previous run.
        curvatures.append(run.curvatures[np.concatenate([[0], piece[:-1]])])
        s.append(s[-1][-1] + places)
        gears.append(np.full(count, run.direction))
        cusps.append(cusps[-1] + count)
    curvatures.append(result.path.curvatures[-1:])
    s, poses, curvatures = np.concatenate(s), np.vstack(poses), np.concatenate(curvatures)
    return result_content(result, 'path', {
        's': column(s), 'x': column(poses[:, 0]), 'y': column(poses[:, 1]), 'theta': column(poses[:, 2]),
        'phi': column(np.arctan(result.wheelbase * curvatures)), 'gear': column(np.concatenate(gears)),
        'cusp_indices': column(cusps),
        'geometry': {'type': 'piecewise_circular', 'start': np.array([[x, y, yaw]]),
                     'primitives': np.column_stack([result.path.lengths, result.path.curvatures])}})


def trajectory_content(result):
    t, x, y, yaw, v, acceleration, steering, rate = result.trajectory.T
    values = (t - t[0], x, y, np.unwrap(yaw), v, steering, acceleration, rate)
    return result_content(result, 'trajectory', dict(zip(TRAJECTORY_COLUMNS, map(column, values))))


def column(values):
    return np.asarray(values, dtype=float).reshape(-1, 1)


def result_content(result, kind, solution):
    is_solved = result.status == 'exact'
    none = np.empty((0, 0))
    return matlab.content_of('result', {
        'schema_version': 'CommonParking-result-1', 'planner': result.planner, 'case_id': float(result.case_id),
        'kind': kind, 'reference_point': 'rear_axle_midpoint', 'units': {'length': 'm', 'angle': 'rad', 'time': 's'},
        'status': {'success': is_solved, 'code': 'solved' if is_solved else 'not_solved',
                   'message': result.status},
        'computation_time_s': result.planning_time, 'path': solution if kind == 'path' else none,
        'trajectory': solution if kind == 'trajectory' else none})


def result_fault(_result, file, content):
    """The violated rule of CommonParking's ValidateResult for a written file; None if it is valid."""
    written = matlab.read(file, content, 'result')
    if written['kind'] == 'path':
        return path_fault(written['path'])
    return trajectory_fault(written['trajectory'])


def columns_fault(solution, names):
    count = solution['x'].size
    if not 2 <= count <= MOST_SAMPLES:
        return f'it has {count} samples'
    for name in names:
        if solution[name].shape != (count - 1 if name == 'gear' else count, 1):
            return f'{name} is not a column of the right length'
        if not np.isfinite(solution[name]).all():
            return f'{name} is not finite'
    return None


def path_fault(path):
    fault = columns_fault(path, ('s', 'x', 'y', 'theta', 'phi', 'gear'))
    if fault:
        return fault
    s, x, y, gear = (path[name].ravel() for name in ('s', 'x', 'y', 'gear'))
    if s[0] != 0.0 or s[-1] > LONGEST:
        return 'the mileage must begin with 0 and end by 1000 m'
    cuts = [0, *np.flatnonzero(np.diff(gear)) + 1, len(gear)]
    if path['cusp_indices'].ravel().tolist() != [cut + 1 for cut in cuts]:
        return 'cusp_indices are not both ends and every gear change'
    steps = np.diff(s)
    wrong = (steps <= 0.0) | (np.hypot(np.diff(x), np.diff(y)) > steps + 1e-6)
    if wrong.any():
        return f'the mileage does not fit the positions at sample {np.argmax(wrong) + 2}'
    for first, last in zip(cuts, cuts[1:]):
        even = (s[last] - s[first]) / (last - first)
        if even > SPACING + 1e-8 or np.abs(steps[first:last] - even).max() > 1e-8:
            return 'samples are not evenly spaced within a gear, or more than 5 cm apart'
    return None


def trajectory_fault(trajectory):
    fault = columns_fault(trajectory, TRAJECTORY_COLUMNS)
    if fault:
        return fault
    t, v = trajectory['t'].ravel(), trajectory['v'].ravel()
    if t[0] != 0.0 or t[-1] > LONGEST_TIME:
        return 'time must begin with 0 and end by 600 s'
    if (np.diff(t) <= 0.0).any():
        return f'time does not increase at sample {np.argmax(np.diff(t) <= 0.0) + 2}'
    if max(abs(v[0]), abs(v[-1])) > AT_REST:
        return 'it must begin and end at rest'
    return None
