"""The page of the paper at its word: what counts as parked, how effects grow, and bad input."""
import json
import math
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import made_results
from made_results import REPORT, record

PAPER = os.path.join(REPORT, '..', 'paper')
PAGE = os.path.join(PAPER, 'page', 'word_page')
sys.path[:0] = [os.path.join(PAPER, 'page')]

import word_study  # noqa: E402
from paired import Comparison, compare  # noqa: E402
from word_design import (ALGORITHMS, CLUTTER, GROWTH_FACTORS, GROWTH_KEYS, LEFT_OUT, PLANNERS, SCENARIOS,  # noqa: E402
                         VARIANTS, growth_name, growth_variants, own_file, runs_file)

MAPS = 12
SIZES = (50, 100, 200)
EFFECTS = {'w': 0.5, 'l': 0.1, 'b': 1.5, 'h': 0.8}  # of the made runs, whatever the rest


def drive(parked=True):
    return {'stands': True, 'travel_time_s': 30.0, 'mean_abs_acceleration': 0.4, 'mean_abs_steering_deg': 12.0,
            'final_position_error_m': 0.1 if parked else 0.9, 'final_yaw_error_deg': 1.0, 'max_deviation_m': 0.2,
            'colliding_share': 0.0 if parked else 0.25, 'solver_failures': 0,
            'states': [[0.1 * k, 0.1 * k, 0.0, 0.0, 1.0, 0.5, 0.1] for k in range(30)]}


def run_of(scenario, algorithm, k, driven=True):
    eager = algorithm in ('basic_astar', 'experiment_2')
    made = {'scenario': f'{scenario}_voxels_{k:02}.yaml', 'algorithm': algorithm, 'status': 'exact', 'reason': '', 'manoeuvres': 1,
            'map_loading_time_ms': 10.0 if eager else 0.1, 'planning_time_ms': 1.0 + 0.01 * k, 'expanded': 50 + k,
            'open_list_operations': 100, 'open_list_comparisons': 400, 'positions_checked': 40000 if eager else 400,
            'cells_looked_at': 150000 if eager else 9000, 'length_m': 30.0, 'turning_deg': 200.0,
            'approach_colliding_share': 0.25, 'corners': [[0, 0], [3, 0]], 'curve': [[0, 0], [1, 0], [3, 0]]}
    if driven:
        made['drive'] = drive(parked=k > 0)
    return made


def growth_records():
    for size in SIZES:
        for clutter in CLUTTER:
            for number in range(MAPS):
                for name in growth_variants():
                    work = size * size * (1.0 + 0.01 * number)
                    work *= math.prod(EFFECTS[key] for key in name.replace('none', ''))
                    yield record(growth_name(size, clutter, number), name, 0, 'solved', 0.01, 25.0, None,
                                 **{'cpu time': 1e-6 * work, 'open list comparisons': round(work), 'nodes expanded': 90,
                                    'states checked': round(work)})


def written(folder):
    """Results of both scenarios as scripts/reproduce-paper leaves them."""
    for scenario in SCENARIOS:
        for variant, (_, _, driven) in VARIANTS.items():
            runs = [run_of(scenario, algorithm, k, driven) for k in range(MAPS) for algorithm in ALGORITHMS.values()]
            if variant == 'printed':
                for each in runs[-8:]:
                    each.update(status='no_manoeuvre')
                    del each['drive'], each['length_m']
            with open(os.path.join(folder, runs_file(scenario, variant)), 'w', encoding='utf-8') as stream:
                json.dump({'format': 1, 'runs': runs}, stream)
        for k in range(MAPS):
            with open(os.path.join(folder, own_file(scenario, k)), 'w', encoding='utf-8') as stream:
                json.dump({'status': 'exact', 'planning_time_ms': [2.0], 'map_loading_time_ms': 1.0, 'length_m': 25.0,
                           'tracking': {'final_position_error_m': 0.001, 'final_yaw_error_rad': 0.0, 'travel_time_s': 20.0,
                                        'mean_abs_acceleration': 0.5, 'mean_abs_steering_deg': 9.0, 'collisions': 0}}, stream)
        with open(os.path.join(folder, f'lines_{scenario}.json'), 'w', encoding='utf-8') as stream:
            json.dump({'format': 1, 'runs': [run_of(scenario, algorithm, 0) for algorithm in ALGORITHMS.values()]}, stream)
        os.makedirs(os.path.join(folder, 'voxels'), exist_ok=True)
        name = os.path.join(folder, 'voxels', f'{scenario}_voxels_00')
        with open(name + '.npy', 'wb') as stream:
            stream.write(b'\x93NUMPY\x01\x00' + struct.pack('<H', 6) + b'header' + struct.pack('<8q', 102, 101, 4, 11, 103, 101, 5, 4))
        with open(name + '.yaml', 'w', encoding='utf-8') as stream:
            stream.write('start: [1, 1, 0]\n')
    made_results.write(os.path.join(folder, 'growth'), list(growth_records()))
    made_results.write(os.path.join(folder, 'rectangle'),
                       [record(f'parallel_{k:02}', name, 0, 'solved', 0.01, 25.0, None, **{
                           'cpu time': 0.001 if name == 'Improved_A*' else 0.004, 'states checked': 100, 'nodes expanded': 90})
                        for k in range(MAPS) for name in ('Improved_A*', *LEFT_OUT.values())])
    made_results.write(os.path.join(folder, 'planners'),
                       [record(f'parallel_voxels_{k:02}', name.replace(' ', '_'), 0, 'none' if name == 'PRM' else 'solved', 0.01,
                               30.0 if name == 'RRT*' else 25.0) for k in range(MAPS) for name in PLANNERS])


class Rules(unittest.TestCase):
    def test_parked(self):
        self.assertTrue(word_study.is_parked({'drive': drive()}))
        self.assertFalse(word_study.is_parked({'drive': drive(parked=False)}))
        self.assertFalse(word_study.is_parked({'drive': {**drive(), 'stands': False}}))
        self.assertFalse(word_study.is_parked({'drive': {**drive(), 'final_yaw_error_deg': 6.0}}))
        self.assertFalse(word_study.is_parked({}))

    def test_pays_from(self):
        def made(ratio):
            return compare({k: ratio * (1.0 + 0.01 * k) for k in range(MAPS)}, dict.fromkeys(range(MAPS), 1.0))
        for ratios, least in (((1.2, 0.5, 0.4), 100), ((0.5, 0.5, 0.4), 50), ((0.5, 1.2, 0.4), 200), ((0.5, 0.5, 1.3), None)):
            effects = {(size, 10): made(ratio) for size, ratio in zip(SIZES, ratios)}
            self.assertEqual(word_study.pays_from(effects, SIZES, 10), least, ratios)
        few = compare({k: 0.5 for k in range(3)}, dict.fromkeys(range(3), 1.0))
        self.assertIsNone(word_study.pays_from({(50, 10): few}, (50,), 10))
        self.assertIsNone(word_study.pays_from({}, (50,), 10))

    def test_what_is_said_to_pay_does(self):
        """Over random effects: at the size named, and at all larger ones, the whole interval is below 1."""
        rng = random.Random(7)
        said = 0
        for _ in range(300):
            effects = {(size, 0): compare({k: math.exp(rng.uniform(-1.5, 0.7)) for k in range(MAPS)},
                                          dict.fromkeys(range(MAPS), 1.0)) for size in SIZES}
            least = word_study.pays_from(effects, SIZES, 0)
            for size in SIZES:
                if least is not None and size >= least:
                    said += 1
                    self.assertLess(effects[size, 0].high, 1.0)
                    self.assertLess(effects[size, 0].middle, 1.0)
        self.assertGreater(said, 20)

    def test_variants(self):
        self.assertEqual(len(growth_variants()), 2 ** len(GROWTH_FACTORS))
        self.assertEqual(growth_variants()[GROWTH_KEYS], {'parameter_set': 'improved_astar', 'smoothing': 'none'})
        self.assertEqual(growth_variants()['wlb']['open_list'], 'linear')
        self.assertNotIn('bidirectional', growth_variants()['wlb'])


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.mkdtemp()
        written(cls.made)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.made)

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.results = os.path.join(self.folder, 'results')
        shutil.copytree(self.made, self.results)
        self.output = os.path.join(self.folder, 'page.md')

    def run_page(self):
        return subprocess.run([sys.executable, '-B', PAGE, self.results, '--output', self.output], capture_output=True,
                              text=True, check=False)

    def test_page(self):
        done = self.run_page()
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        with open(self.output, encoding='utf-8') as stream:
            rows = [[cell.strip() for cell in line.strip('|\n').split(' | ')] for line in stream if line.startswith('|')]
        # Of 12 tasks one has no manoeuvre (the last) and one is not parked, and touches something (the first).
        printed = next(row for row in rows if row[0] == 'Improved A\\*, as printed')
        self.assertEqual(printed[1:5], ['11', '11', '10', '1'])
        own = next(row for row in rows if row[0] == 'this project\'s pipeline')
        self.assertEqual(own[1:5], ['–', '12', '12', '0'])
        loading = next(row for row in rows if row[0].startswith('map loading: Basic A\\* / Improved'))
        self.assertEqual((loading[2].split()[0], loading[4]), ('**100**', 'agrees'))
        # The first table of growth is that of processor time; effects are those that the runs were made with.
        for name, key in (('weighted heuristic', 'w'), ('dynamic loading', 'l'), ('two directions', 'b'), ('heap', 'h')):
            empty, row = [row for row in rows if row[0] == name and len(row) == 2 + len(SIZES) + 1][:2]
            self.assertAlmostEqual(float(row[2].strip('*').split()[0]), EFFECTS[key], places=2)
            self.assertEqual(row[-1], '50' if EFFECTS[key] < 1.0 else '–')
            self.assertEqual((empty[1], empty[-1], '**' in empty[2]), ('0 %', '–', False))  # one ground, however often
        survives = next(row for row in rows if row[0] == 'dynamic loading' and len(row) == 5)
        self.assertEqual(survives[1:3], ['**0.250 (0.250 to 0.250)**', '1.00 (1.00 to 1.00)'])
        planners = {row[0]: row[1:] for row in rows if len(row) == 5 and row[1].endswith(f'of {MAPS}')}
        self.assertEqual(planners['RRT\\*'][:3], ['12 of 12', '10.0', '1.20'])
        self.assertEqual(planners['PRM'][:2], ['0 of 12', '–'])
        for figure in ('paper-run.svg', 'paper-run-drives.svg'):
            with open(os.path.join(self.folder, 'images', figure), encoding='utf-8') as stream:
                self.assertIn('polyline', stream.read())

    def test_real_frames_get_a_table(self):
        for name in ('printed', 'corrected'):
            runs = [run_of('frames', algorithm, k) for k in range(2) for algorithm in ALGORITHMS.values()]
            with open(os.path.join(self.results, runs_file('frames', name)), 'w', encoding='utf-8') as stream:
                json.dump({'format': 1, 'runs': runs}, stream)
        for k in range(2):
            shutil.copy(os.path.join(self.results, own_file('parallel', k)), os.path.join(self.results, own_file('frames', k)))
        self.assertEqual(self.run_page().returncode, 0)
        with open(self.output, encoding='utf-8') as stream:
            self.assertIn('### Perceived frames (2 tasks)', stream.read())

    def test_bad_input_is_one_line(self):
        def broken(name, content):
            def change():
                with open(os.path.join(self.results, name), 'w', encoding='utf-8') as stream:
                    stream.write(content)
            return change
        some = json.dumps({'format': 1, 'runs': [run_of('parallel', 'basic_astar', 0)]})
        for change, part in (
                (lambda: os.remove(os.path.join(self.results, 'word_parallel_field.json')), 'word_parallel_field.json'),
                (broken('word_parallel_field.json', '{"format": 2, "runs": []}'), 'is not of format 1'),
                (broken('word_parallel_field.json', 'x'), 'cannot be read'),
                (broken('word_parallel_field.json', some), 'has no runs of Experiment_1'),
                (broken('own_parallel_03.json', '{"status": "exact"}'), 'holds no drive'),
                (broken('voxels/parallel_voxels_00.npy', 'x'), 'is no .npy'),
                (lambda: shutil.rmtree(os.path.join(self.results, 'growth')), 'growth')):
            shutil.rmtree(self.results)
            shutil.copytree(self.made, self.results)
            change()
            done = self.run_page()
            self.assertEqual(done.returncode, 2, part)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertTrue(done.stderr.startswith('word_page: '), done.stderr)
            self.assertIn(part, done.stderr)
            self.assertFalse(os.path.exists(self.output))


class Empty(unittest.TestCase):
    def test_no_maps_are_no_effect(self):
        self.assertFalse(word_study.is_less(Comparison([])))


if __name__ == '__main__':
    unittest.main()
