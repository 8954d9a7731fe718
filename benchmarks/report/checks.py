"""What a line of runs.jsonl must hold, whoever wrote it: figures that mean something, in words that parking_benchmark writes."""
import json
import math

OUTCOMES = 11  # of parking_benchmark, see docs/comparison.md
FLAGS = ('success', 'late', 'densely valid', 'solved', 'approximate solution')
WHOLE = {'run': None, 'seed': None, 'outcome': OUTCOMES - 1, 'status': None, 'cusps': None}  # and the greatest, if there is one
WORDS = ('inf', '-inf', 'nan')  # JSON has no such numbers


class BadValue(Exception):
    """Its text names the field and says what would be right."""


def _is_number(value):
    """A finite one; Python's reader takes NaN and Infinity, too, which are no JSON."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _require(right, field, value, wanted):
    if not right:
        shown = json.dumps(value)
        raise BadValue(f'{field} is {shown if len(shown) <= 60 else shown[:60] + "..."}; it must be {wanted}')


def is_time(name):
    """Is the column of this name one of seconds?"""
    return name in ('time', 'trajectory duration') or name.endswith(' time')


def check_figure(name, value):
    """Raises BadValue for what the column of this name cannot hold."""
    field = f'figures: "{name}"'
    if name in FLAGS:
        _require(isinstance(value, bool), field, value, 'true or false')
    elif name in WHOLE:
        most = WHOLE[name]
        right = isinstance(value, int) and not isinstance(value, bool) and 0 <= value and (most is None or value <= most)
        _require(right, field, value, 'a whole number, ' + (f'0 to {most}' if most else '0 or more'))
    elif is_time(name):
        _require(_is_number(value) and value >= 0.0, field, value, 'a number of seconds, 0 or more')
    elif name == 'path length':
        _require(_is_number(value) and value >= 0.0, field, value, 'a number of metres, 0 or more')
    else:
        _require(isinstance(value, bool) or _is_number(value) or value in WORDS, field, value,
                 'a number, true, false, "inf", "-inf" or "nan"')


def _check_path(path):
    _require(isinstance(path, dict), 'path', path, 'an object with exact, start and pieces')
    _require(isinstance(path.get('exact'), bool), 'path: exact', path.get('exact'), 'true or false')
    start, pieces = path.get('start'), path.get('pieces')
    _require(isinstance(start, list) and len(start) == 3 and all(map(_is_number, start)), 'path: start', start,
             'a list of three numbers')
    _require(isinstance(pieces, list), 'path: pieces', pieces, 'a list')
    for count, piece in enumerate(pieces):
        _require(isinstance(piece, list) and 1 <= len(piece) <= 3 and all(map(_is_number, piece)), f'path: pieces[{count}]',
                 piece, 'a list of one to three numbers')


def check_run(record):
    """Of a line that has all its members. Raises BadValue."""
    for member in ('experiment', 'planner'):
        _require(isinstance(record[member], str) and record[member], member, record[member], 'a name')
    for name, value in record['figures'].items():
        check_figure(name, value)
    if record['figures'].get('success'):
        for name in ('first solution time', 'path length'):
            if name not in record['figures']:
                raise BadValue(f'figures: "{name}" is missing; a run with success has one')
    for name, value in record['reported'].items():
        _require(isinstance(value, bool) or _is_number(value) or value in WORDS, f'reported: "{name}"', value,
                 'a number, true, false, "inf", "-inf" or "nan"')
    for count, step in enumerate(record['progress']):
        _require(isinstance(step, list) and len(step) == 2 and all(map(_is_number, step)) and step[0] >= 0.0,
                 f'progress[{count}]', step, 'a list of seconds, 0 or more, and metres')
    if 'path' in record:
        _check_path(record['path'])


def check_header(record):
    """Of a line about a comparison. Raises BadValue."""
    limit = record.get('time_limit', 'unknown')
    _require(limit == 'unknown' or (_is_number(limit) and limit > 0.0), 'time_limit', limit,
             'a number of seconds above 0, or "unknown"')
    started = record.get('started', 0.0)
    _require(_is_number(started) and started >= 0.0, 'started', started, 'a number of seconds, 0 or more')
    for member in ('setups', 'fingerprints'):
        if member in record:
            _require(isinstance(record[member], dict), member, record[member], 'an object')
    for experiment, planners in record.get('fingerprints', {}).items():
        _require(isinstance(planners, dict), f'fingerprints: "{experiment}"', planners, 'an object')
