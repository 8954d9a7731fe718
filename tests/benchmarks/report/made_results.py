"""Results of comparisons that never took place, for tests of the report."""
import json
import os
import random
import shutil
import sqlite3
import sys
import tempfile
import unittest

REPORT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', '..', 'benchmarks', 'report')
MAKE_REPORT = os.path.join(REPORT, 'make_report')
sys.path.insert(0, REPORT)
import program  # noqa: E402

program.require_packages('tests of the report')

TIME_LIMIT = 2.0
TYPES = {bool: 'BOOLEAN', int: 'INTEGER', float: 'REAL'}


def record(problem, planner, run, outcome, first=None, length=None, progress=None, **more):
    """A run, by the names of the columns with blanks. outcome: solved, invalid, approximate or none; first:
    seconds until the first solution."""
    figures = {'run': run, 'seed': 1000 + run, 'success': outcome == 'solved', 'time': 2.0, 'planning time': 2.0}
    if outcome in ('solved', 'invalid'):
        figures['first solution time'] = first
    if outcome != 'none':
        figures.update({'path length': length, 'cusps': 1, 'least clearance': 0.1,
                        'densely valid': outcome != 'invalid', 'distance to goal': 0.0})
    figures.update(more)
    if progress is None:
        progress = [[first, length]] if outcome in ('solved', 'invalid') else []
    return {'experiment': problem, 'planner': planner, 'figures': figures, 'progress': progress}


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, gone afterwards."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)


SCHEMA = '''
CREATE TABLE experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512), totaltime REAL, timelimit REAL,
    memorylimit REAL, runcount INTEGER, version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT, date DATETIME,
    seed VARCHAR(24), setup TEXT);
CREATE TABLE plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512) NOT NULL, settings TEXT);
CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER);
CREATE TABLE progress (runid INTEGER, time REAL, best_cost REAL, PRIMARY KEY (runid, time));
'''


def columns_of(records):
    """name in the database -> type"""
    return {name.replace(' ', '_'): TYPES[type(value)] for each in records for name, value in each['figures'].items()}


def write(folder, records, time_limit=TIME_LIMIT):
    """benchmark.db, as parking_benchmark writes it."""
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, 'benchmark.db')
    if os.path.exists(file):
        os.remove(file)
    connection = sqlite3.connect(file)
    connection.executescript('PRAGMA synchronous = OFF;' + SCHEMA)
    columns = columns_of(records)
    for name, kind in columns.items():
        connection.execute(f'ALTER TABLE runs ADD "{name}" {kind}')
    problems = {name: k for k, name in enumerate(dict.fromkeys(each['experiment'] for each in records), 1)}
    planners = {name: k for k, name in enumerate(dict.fromkeys(each['planner'] for each in records), 1)}
    connection.executemany('INSERT INTO experiments VALUES (?, ?, 1.0, ?, 4096, 10, ?, ?, ?, ?, ?, ?)', (
        (k, name, time_limit, 'OMPL 1.5.2', 'somewhere', 'Model name:  Some Processor\nCPU(s): 2\n', '2024-01-01 00:00:00', '1',
         'ompl_improved_astar 0.1.0, OMPL 1.5.2\nLinux\n') for name, k in problems.items()))
    connection.executemany('INSERT INTO plannerConfigs VALUES (?, ?, ?)',
                           ((k, f'geometric_{name}', 'range = 1\n;depth = 2\n;') for name, k in planners.items()))
    connection.executemany(
        f'INSERT INTO runs VALUES (?, ?, ?{", ?" * len(columns)})',
        ([k, problems[each['experiment']], planners[each['planner']],
          *(each['figures'].get(name.replace('_', ' ')) for name in columns)] for k, each in enumerate(records, 1)))
    connection.executemany('INSERT INTO progress VALUES (?, ?, ?)', (
        (k, time, cost) for k, each in enumerate(records, 1) for time, cost in each['progress']))
    connection.commit()
    connection.close()


with open(os.path.join(REPORT, 'columns.json'), encoding='utf-8') as _columns:
    FURTHER = [column['name'] for column in json.load(_columns) if column['folded']]


def write_picture(folder, problem, paths, extra=''):
    """The picture of a problem. paths: planner -> number of its run; extra: a shape, or what should be none."""
    os.makedirs(os.path.join(folder, 'pictures'), exist_ok=True)

    def group(planner, run):
        return (f'<g data-planner="{planner}" data-run="{run}" data-body="10 30 8"><g><polyline points="10,10 60,10" '
                f'stroke="#2563eb" fill="none"/><polyline points="60,10 20,40" stroke="#ea580c" fill="none"/></g>'
                '<g><circle cx="60" cy="10" r="3.4"/></g></g>')
    ground = f'<rect width="100%" height="100%" fill="#fbfcfd"/><g><path d="M0 0H9" fill="none"/>{extra}</g>'
    best = ''.join(group(*path) for path in list(paths.items())[:1])
    panels = ''.join(f'<svg class="planner" viewBox="0 0 100 50"><use href="#ground"/>{group(*path)}</svg>'
                     for path in paths.items())
    with open(os.path.join(folder, 'pictures', problem + '.svg'), 'w', encoding='utf-8') as stream:
        stream.write('<svg xmlns="http://www.w3.org/2000/svg"><style>@media (prefers-color-scheme: dark){[fill="#fbfcfd"]'
                     f'{{fill:#191e24}}}}</style><svg class="best" viewBox="0 0 100 50">{ground}{best}</svg>'
                     f'<defs><g id="ground">{ground}</g></defs>{panels}</svg>')


def random_records(problems, planners, runs, seed=1):
    """Runs of all kinds."""
    rng = random.Random(seed)
    made = []
    for run in range(runs):
        for problem in range(problems):
            for planner in range(planners):
                outcome = rng.choices(['solved', 'invalid', 'approximate', 'none'], [12 - planner % 8, 1, 2, 2])[0]
                time = 10.0 ** rng.uniform(-3, 0.2)
                length = rng.uniform(10, 30)
                better = [[time, 1.3 * length], [min(1.9, 1.5 * time), length]]
                more = {} if outcome == 'none' else {name: rng.uniform(0.0, 10.0) for name in FURTHER}
                made.append(record(f'problem_{problem}', f'planner_{planner}', run, outcome, time, length,
                                   better if outcome in ('solved', 'invalid') else [], **more))
    return made
