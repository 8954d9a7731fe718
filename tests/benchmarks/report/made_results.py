"""Results of comparisons that never took place, for tests of the report.

usage: made_results.py FOLDER [--runs N] [--problems N] [--planners N]   writes runs.jsonl and OMPL logs there
"""
import argparse
import json
import os
import random
import shutil
import sys
import tempfile
import unittest

REPORT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', '..', 'benchmarks', 'report')
MAKE_REPORT = os.path.join(REPORT, 'make_report')

HEADER = {'parking_benchmark': 2, 'fingerprint': '0123', 'config': 'made.cfg', 'host': 'somewhere',
          'cpu': 'Model name:  Some Processor\nCPU(s): 2\n', 'machine': 'ompl_improved_astar 0.1.0, OMPL 1.5.2\nLinux',
          'parameters': {'cores INTEGER': '2'}, 'seed': 1, 'time_limit': 2.0, 'started': 1.7e9, 'setups': {}}


def record(problem, planner, run, outcome, first=None, length=None, progress=None, **more):
    """A run as parking_benchmark writes it. outcome: solved, invalid, approximate or none; first:
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
    made = {'experiment': problem, 'planner': planner, 'figures': figures, 'reported': {}, 'parameters': {'range': '1'},
            'progress': progress}
    if outcome != 'none':
        made['path'] = {'exact': outcome != 'approximate', 'start': [0.0, 0.0, 0.0],
                        'pieces': [[0.0, 2.0], [0.2, -3.0], [0.1], [0.0, -0.5, 0.2]]}
    return made


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, gone afterwards."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)


def write(folder, records, header=None, name='runs.jsonl'):
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name), 'w', encoding='utf-8') as stream:
        for line in [header or HEADER] + records:
            stream.write(json.dumps(line) + '\n')


with open(os.path.join(REPORT, 'columns.json'), encoding='utf-8') as _columns:
    FURTHER = [column['name'] for column in json.load(_columns) if column['folded']]


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


TYPES = {bool: 'BOOLEAN', int: 'INTEGER', float: 'REAL'}


def shown(value):
    return str(int(value) if isinstance(value, bool) else value)


def log_text(problem, records, header):
    """The log that OMPL's benchmark would have written."""
    planners = list(dict.fromkeys(each['planner'] for each in records))
    runs = max(each['figures']['run'] for each in records) + 1
    lines = ['OMPL version 1.5.2', f'Experiment {problem}', 'Running on somewhere',
             'Starting at 2024-01-01 00:00:00.000000', '<<<|', 'made', '|>>>', '<<<|', 'Some Processor', '|>>>',
             '1 is the random seed', f'{header["time_limit"]} seconds per run', '4096 MB per run', f'{runs} runs per planner',
             '1 seconds spent to collect the data', '0 enum types', f'{len(planners)} planners']
    for planner in planners:
        own = [each for each in records if each['planner'] == planner]
        types = {name: TYPES[type(value)] for each in own for name, value in each['figures'].items()}
        lines += [f'geometric_{planner}', '1 common properties', 'range = 1', f'{len(types)} properties for each run']
        lines += [f'{name} {kind}' for name, kind in types.items()] + [f'{len(own)} runs']
        lines += ['; '.join(shown(each['figures'].get(name, '')) for name in types) + '; ' for each in own]
        lines += ['2 progress properties for each run', 'best cost REAL', 'time REAL', f'{len(own)} runs']
        lines += [''.join(f'{cost},{time},;' for time, cost in each['progress']) for each in own]
        lines.append('.')
    return '\n'.join(lines) + '\n'


def main():
    parser = argparse.ArgumentParser(description='Writes runs.jsonl and OMPL logs of made-up results.')
    parser.add_argument('folder')
    parser.add_argument('--problems', type=int, default=20)
    parser.add_argument('--planners', type=int, default=10)
    parser.add_argument('--runs', type=int, default=50)
    options = parser.parse_args()
    records = random_records(options.problems, options.planners, options.runs)
    write(options.folder, records)
    for problem in dict.fromkeys(each['experiment'] for each in records):
        with open(os.path.join(options.folder, problem + '.log'), 'w', encoding='utf-8') as stream:
            stream.write(log_text(problem, [each for each in records if each['experiment'] == problem], HEADER))
    print(f'{len(records)} runs')


if __name__ == '__main__':
    sys.exit(main())
