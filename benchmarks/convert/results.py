"""Runs in files of parking_plan --json. The fields are checked, and path and trajectory must be continuous."""
import json
import math
import re
import sys
from dataclasses import dataclass

import numpy as np

from improved_astar import Error, Vehicle

from .text import number, numbers, quoted

FORMAT = 1        # format of parking_plan --json
NO_LENGTH = 1e-9  # metres
LONGEST = 1e6     # metres
# Maximum distance between a state and the end of the arc to it: more than the rounding to millimetres, less than the
# error of a missing or moved state.
JUMP, YAW_JUMP = 0.01, 0.01  # metres, radians
LEAP = 0.05                  # metres of motion beyond that of the speeds


@dataclass
class ArcPath:
    """A sequence of arcs in the coordinates of the scenario's file. Lengths are negative in reverse."""
    start: tuple
    curvatures: np.ndarray
    lengths: np.ndarray

    def runs(self):
        """The path between its changes of gear, one ArcPath each."""
        direction = np.sign(self.lengths)
        runs, start = [], self.start
        for pieces in np.split(np.arange(len(direction)), np.flatnonzero(np.diff(direction)) + 1):
            runs.append(ArcPath(start, self.curvatures[pieces], self.lengths[pieces]))
            start = tuple(runs[-1].begins()[-1])
        return runs

    @property
    def direction(self):
        """1 forwards, -1 in reverse: for a path without a change of gear."""
        return np.sign(self.lengths[0])

    def begins(self):
        """The poses between the pieces, with start and end. Yaw is not wrapped."""
        poses = [self.start]
        for curvature, length in zip(self.curvatures, self.lengths):
            poses.append(advance(poses[-1], curvature, length))
        return np.array(poses)

    def advanced(self, piece, driven):
        """The poses at these distances from the beginning of these pieces."""
        begin = self.begins()[piece]
        return np.column_stack(advance(begin.T, self.curvatures[piece], np.sign(self.lengths[piece]) * driven))


def advance(pose, curvature, length):
    """The pose at the end of an arc, or one per element of arrays."""
    x, y, yaw = pose
    half = 0.5 * curvature * length
    chord = length * np.sinc(half / np.pi)
    return x + chord * np.cos(yaw + half), y + chord * np.sin(yaw + half), yaw + 2.0 * half


@dataclass
class StoredResult:
    planner: str
    status: str
    planning_time: float  # planning time of the first run in seconds
    case_id: int          # number of the problem, for formats that have one
    wheelbase: float
    path: ArcPath
    trajectory: np.ndarray  # rows t, x, y, yaw, v, acceleration, steering, steering rate; empty without one


class JsonField:
    """A value in the file and its position for messages, such as path[3].x."""

    def __init__(self, value, name=''):
        self.value, self.name = value, name

    def fail(self, right):
        value = self.value
        if isinstance(value, (list, dict)):
            kind = 'an object' if isinstance(value, dict) else 'a list' if value else 'an empty list'
        else:
            kind = quoted(value) if isinstance(value, str) else json.dumps(value)
        raise Error(f'{self.name} is {kind}; it must be {right}')

    def has(self, name):
        return isinstance(self.value, dict) and name in self.value

    def member(self, name):
        if not isinstance(self.value, dict):
            self.fail(f'an object with {name}')
        place = f'{self.name}.{name}' if self.name else name
        if name not in self.value:
            raise Error(f'{place} is missing')
        return JsonField(self.value[name], place)

    def entries(self):
        if not isinstance(self.value, list):
            self.fail('a list')
        return [JsonField(each, f'{self.name}[{k}]') for k, each in enumerate(self.value)]

    def number(self):
        value = self.value
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= sys.float_info.max:
            self.fail('a finite number')
        return float(value)

    def numbers(self, *names):
        return tuple(self.member(name).number() for name in names)

    def text(self):
        if not isinstance(self.value, str) or not self.value:
            self.fail('a word')
        return self.value


def json_field(content, what):
    """The whole of a JSON file. Raises Error for content that is not this."""

    def refuse(constant):
        raise ValueError(f'{constant} is not a number')

    try:
        return JsonField(json.loads(content, parse_constant=refuse))
    except (ValueError, RecursionError) as error:
        raise Error(f'not {what}: {error}') from None


def is_result(content):
    return content.lstrip().startswith(b'{')


def parse(file, content):
    """The result in a file. Raises Error with one line naming the file and the field."""
    try:
        whole = json_field(content, 'a result of parking_plan --json')
    except Error as error:
        raise Error(f'{file}: {error}') from None
    try:
        version = whole.member('format')
        if version.value != FORMAT or isinstance(version.value, bool):
            version.fail(str(FORMAT))
    except Error as error:
        raise Error(f'{file}: not a result of parking_plan --json: {error}') from None
    try:
        with np.errstate(all='ignore'):  # an overflow is discontinuous and thus rejected
            return result_of(whole)
    except Error as error:
        raise Error(f'{file}: {error}') from None


def result_of(whole):
    planner = whole.member('planner').text()
    times = whole.member('planning_time_ms')
    if not times.entries():
        times.fail('a list of milliseconds, one for each run')
    for each in times.entries():
        if each.number() < 0.0:
            each.fail('a number of milliseconds that is not negative')
    scenario = whole.member('scenario').text() if whole.has('scenario') else ''
    digits = int(re.search(r'\d*$', scenario).group()[-9:] or 0)  # 7 of Case07
    wheelbase = vehicle_of(whole.member('vehicle')).wheelbase
    status = whole.member('status')
    states = whole.member('path').entries()
    if len(states) < 2:
        raise Error(f'it has no path, since its status is {quoted(status.text())}')
    if status.text() not in ('exact', 'approximate', 'invalid_path'):
        status.fail('exact, approximate or invalid_path, as there is a path')
    path = path_of(states)
    trajectory = np.empty((0, 8))
    for name in ('trajectory', 'planned_trajectory'):
        if whole.has(name) and whole.member(name).entries():
            trajectory = trajectory_of(whole.member(name).entries())
    return StoredResult(planner, status.text(), 1e-3 * times.entries()[0].number(), digits if 0 < digits < 1000 else 1,
                  wheelbase, path, trajectory)


def vehicle_of(field):
    names = ('wheelbase', 'front_overhang', 'rear_overhang', 'width', 'max_steering_angle')
    if field.has('name'):
        field.member('name').text()
    return Vehicle('tpcap', **dict(zip(names, field.numbers(*names))))


def path_of(states):
    """Adds the arc between two states, with the curvature of the second one."""
    start = before = states[0].numbers('x', 'y', 'yaw')
    curvatures, lengths = [], []
    for state in states[1:]:
        pose = state.numbers('x', 'y', 'yaw')
        curvature, length = arc_between(before, pose, state)
        before = pose
        if abs(length) <= NO_LENGTH:
            continue
        if curvatures and curvatures[-1] == curvature and lengths[-1] * length > 0.0:
            lengths[-1] += length
        else:
            curvatures.append(curvature)
            lengths.append(length)
    whole = sum(map(abs, lengths))
    if not lengths:
        raise Error('its path has no length')
    if not whole <= LONGEST:
        raise Error(f'its path is {number(whole)} m long; the limit is {number(LONGEST)} m')
    return ArcPath(start, np.array(curvatures), np.array(lengths))


def arc_between(before, pose, state):
    """Curvature and signed length of the arc to a state. Raises Error if it ends elsewhere."""
    curvature, direction = state.numbers('curvature', 'direction')
    if abs(direction) != 1.0:
        state.member('direction').fail('1 or -1')
    chord = math.hypot(pose[0] - before[0], pose[1] - before[1])
    bend = 0.5 * abs(curvature) * chord
    length = direction * (chord * math.asin(min(1.0, bend)) / bend if bend > 1e-9 else chord)
    x, y, yaw = advance(before, curvature, length)
    off = math.hypot(x - pose[0], y - pose[1])
    turned = abs((yaw - pose[2] + math.pi) % math.tau - math.pi)
    if abs(length) <= NO_LENGTH and turned > 1e-6:
        raise Error(f'{state.name} turns on the spot, which a car cannot do')
    if not (off <= JUMP and turned <= YAW_JUMP):
        raise Error(f'{state.name} does not follow from the state before: an arc of its curvature, '
                    f'{number(curvature)} 1/m, ends {off:.3f} m and {turned:.3f} rad away')
    return curvature, length


def trajectory_of(samples):
    rows = []
    for sample in samples:
        row = [*sample.numbers('t', 'x', 'y', 'yaw', 'v', 'acceleration', 'steering'), 0.0]
        if sample.has('steering_rate'):
            row[7] = sample.member('steering_rate').number()
        if rows:
            (last_t, last_x, last_y, _, last_v), (t, x, y, _, v) = rows[-1][:5], row[:5]
            if not t > last_t:
                sample.member('t').fail(f'more than the {number(last_t)} before')
            way = math.hypot(x - last_x, y - last_y)
            if not way <= LEAP + 1.1 * (t - last_t) * max(abs(v), abs(last_v)):
                raise Error(f"{sample.name} lies {way:.3f} m from the one before, in {t - last_t:.3f} s at {v:.3f} m/s; "
                            "the car cannot reach it")
        rows.append(row)
    return np.array(rows)


def csv_text(result):
    """The trajectory as a table, in the quantities of TPCAP."""
    lines = [numbers(row, ',') for row in result.trajectory]
    return 't,x,y,yaw,v,a,steering,steering_rate\n' + '\n'.join(lines) + '\n'


def csv_fault(result, _file, content):
    """The fault of a written table; None without one."""
    rows = [line.split(b',') for line in content.splitlines()[1:]]
    if not np.array_equal(np.array(rows, dtype=float), result.trajectory):
        return 'the file differs from the written content'
    return None
