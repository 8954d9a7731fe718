"""The page that sets our figures beside the paper's: its rules, that no sentence contradicts its figures, and bad input."""
import json
import math
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

import made_results
from made_results import REPORT, record

PAPER = os.path.join(REPORT, '..', 'paper')
PAGE = os.path.join(PAPER, 'page', 'paper_page')
sys.path[:0] = [os.path.join(PAPER, 'page')]

import factorial  # noqa: E402
import ratios  # noqa: E402
from design import ALGORITHMS, FACTORS, KEYS, SCENARIOS, VARIANTS, studies  # noqa: E402
from paired import Comparison, chance_of_signs, compare, correct, verdict, way_of  # noqa: E402
from published import ABLATION, HEADLINES, PARALLEL, VERTICAL, ratio_rows  # noqa: E402
from reach import nearest_reachable  # noqa: E402

MAPS = 12


def compared(ratio, spread=0.0, count=MAPS):
    """A comparison whose ratios lie about one, as far as spread says."""
    return compare({k: ratio * (1.0 + spread * (k / (count - 1) - 0.5)) for k in range(count)},
                   {k: 1.0 for k in range(count)})


class Rules(unittest.TestCase):
    def test_signs_and_correction(self):
        self.assertAlmostEqual(chance_of_signs([1.0] * 5), 2.0 / 32.0)
        self.assertAlmostEqual(chance_of_signs([1.0, 1.0, -1.0, 0.0]), 1.0)  # 3 of 3 would be 0.25, 2 of 3 says nothing
        self.assertEqual(chance_of_signs([]), 1.0)
        several = [Comparison([], chance=chance) for chance in (0.01, 0.04, 0.03)]
        correct(several)
        self.assertEqual([round(each.chance, 9) for each in several], [0.03, 0.06, 0.06])

    def test_ways(self):
        self.assertEqual([way_of(ratio) for ratio in (1.2, 1.04, 0.97, 0.8)], ['more', 'same', 'same', 'less'])
        self.assertEqual(compared(2.0, 0.1).way(), 'more')
        self.assertEqual(compared(0.5, 0.1).way(), 'less')
        self.assertEqual(compared(1.0).way(), 'same')
        self.assertIsNone(compared(1.2, 1.5).way())       # as often below 1 as above
        self.assertIsNone(compared(2.0, 0.1, 4).way())    # too few maps
        many = compared(2.0, 0.1)
        many.chance = 0.2                                  # not certain once corrected
        self.assertIsNone(many.way())

    def test_verdicts(self):
        self.assertEqual(verdict('more', 'more'), 'agrees')
        self.assertEqual(verdict('more', 'less'), 'opposite')
        self.assertEqual(verdict('same', 'less'), 'differs')
        self.assertEqual(verdict('more', None), 'unclear')

    def test_headlines(self):
        self.assertEqual(ratios.headline_answer(0.5, compared(0.4, 0.1)), 'holds')
        self.assertEqual(ratios.headline_answer(0.5, compared(0.8, 0.1)), 'less, but not by as much')
        self.assertEqual(ratios.headline_answer(0.5, compared(1.0, 0.5)), 'not seen')
        self.assertEqual(ratios.headline_answer(0.5, compared(1.4, 0.1)), 'the other way round')
        doubtful = compared(1.4, 0.1)
        doubtful.chance = 0.2
        self.assertEqual(ratios.headline_answer(0.5, doubtful), 'not seen')
        self.assertIn('too few', ratios.headline_answer(0.5, compared(0.4, 0.1, 3)))

    def test_no_sentence_contradicts_its_figures(self):
        """Over random figures: what goes "with" a ratio is on the same side of 1 with its whole interval."""
        rng = random.Random(4)
        said = {'with': 0, 'although': 0, '': 0}
        for _ in range(400):
            row = ratios.Row('perpendicular', 'planning', 'Basic_A*', 'Improved_A*', 1.0,
                             compared(math.exp(rng.uniform(-1, 1)), rng.uniform(0, 1.5)))
            row.beside = [('expanded', compared(math.exp(rng.uniform(-1, 1)), rng.uniform(0, 1.5)))]
            text, other = ratios.sentence(row), row.beside[0][1]
            word = text.split(' ')[0] if text else ''
            said[word] += 1
            if word:
                self.assertIn(row.ours.way(), ('more', 'less'))
                self.assertFalse(row.ours.low <= 1.0 <= row.ours.high)
            if word == 'with':
                self.assertGreater((row.ours.low - 1.0) * (other.low - 1.0), 0.0)
                self.assertGreater((row.ours.high - 1.0) * (other.high - 1.0), 0.0)
            if word == 'although':
                self.assertLessEqual((row.ours.middle - 1.0) * (other.middle - 1.0), 0.03)
        self.assertTrue(all(count > 10 for count in said.values()), said)

    def test_all_ratios_of_the_paper(self):
        rows = {row[:4]: row[4] for row in ratio_rows()}
        self.assertEqual(len(rows), 53)
        self.assertAlmostEqual(rows['perpendicular', 'planning', 'Experiment_2', 'Basic_A*'], 6.9 / 21.86)
        self.assertAlmostEqual(rows['perpendicular', 'steering', 'Experiment_6', 'Improved_A*'], 9.20 / 10.79)
        self.assertAlmostEqual(rows['parallel', 'length', 'Basic_A*', 'Improved_A*'], 101.8261 / 101.8145)
        self.assertEqual(ABLATION['Experiment_3']['planning'], 609.01)

    def test_headline_claims_are_those_of_the_tables(self):
        tables = {'perpendicular': {**ABLATION, **VERTICAL}, 'parallel': PARALLEL}
        for text, _, scenario, measure, first, second, claim in HEADLINES:
            reduced = 1.0 - tables[scenario][first][measure] / tables[scenario][second][measure]
            self.assertGreater(reduced, claim - 0.001, text)


class Factorial(unittest.TestCase):
    def test_effects_are_found(self):
        """Figures made of known factors."""
        main = {'w': 0.5, 'l': 0.1, 'b': 1.0, 'n': 1.3, 's': 2.0}

        def figure(variant, scale):
            present = variant.replace('none', '')
            value = scale * math.prod(main[key] for key in present)
            return value * (3.0 if 'w' in present and 's' in present else 1.0)

        class Made:
            @staticmethod
            def figures(_, variant):
                return {k: figure(variant, 1.0 + k) for k in range(MAPS)}
        found = factorial.effects(Made, 'total')
        root = math.sqrt(3.0)  # each of the two has the other in half of the combinations
        for key, factor in main.items():
            self.assertAlmostEqual(found[(key,)].middle, factor * (root if key in 'ws' else 1.0))
        self.assertAlmostEqual(found['w', 's'].middle, 3.0)
        self.assertAlmostEqual(found['w', 'l'].middle, 1.0)
        self.assertTrue(factorial.is_certain(found['w', 's']))
        self.assertFalse(factorial.is_certain(found['w', 'l']))

    def test_variants(self):
        self.assertEqual(len(set(VARIANTS)), 2 ** len(FACTORS))
        self.assertLessEqual(set(ALGORITHMS.values()), set(VARIANTS))
        self.assertEqual(KEYS, 'wlbns')


class Maps(unittest.TestCase):
    def test_nearest_reachable(self):
        """A car at the destination, barriers, a gap: none is reached, and the free ones are not nearer than the barrier."""
        for name, least in (('unreachable', 2.0), ('walled_in', 4.5), ('too_tight', 4.5)):
            away = nearest_reachable(os.path.join(PAPER, 'maps', name + '.yaml'), 1.25)
            self.assertTrue(least < away < 9.0, (name, away))
        self.assertLess(nearest_reachable(os.path.join(PAPER, 'maps', 'too_tight.yaml'), 0.7), 0.5)

    def test_generated_maps_repeat_and_differ(self):
        with tempfile.TemporaryDirectory() as folder:
            texts = {}
            for run, seed in (('a', '1'), ('b', '1'), ('c', '2')):
                where = os.path.join(folder, run)
                subprocess.run([sys.executable, '-B', os.path.join(PAPER, 'make_random_maps'), '--output', where, '--count',
                                '1', '--seed', seed], check=True, capture_output=True)
                texts[run] = {}
                for name in os.listdir(where):
                    with open(os.path.join(where, name), 'rb') as stream:
                        texts[run][name] = stream.read()
            self.assertEqual(texts['a'], texts['b'])
            self.assertNotEqual(texts['a']['parallel_00.pgm'], texts['c']['parallel_00.pgm'])
            self.assertEqual(len(texts['a']), 3 * len(SCENARIOS))


def figures_of(variant, k):
    """Loading takes 10 times as long without l, planning twice with s; the drive is the same."""
    loading = 0.001 if 'l' in variant else 0.010
    planning = 0.001 * (1.0 + 0.01 * k) * (2.0 if 's' in variant.replace('none', '') else 1.0)
    return {'map loading time': loading, 'planning time': planning, 'cpu time': loading - 0.001 + planning,
            'time': loading - 0.001 + planning, 'nodes expanded': 50 + k, 'states checked': 200 if 'l' in variant else 40000,
            'travel time': 40.0, 'mean acceleration': 0.4, 'mean steering angle': 10.0, 'collisions while driving': 0}


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.output = os.path.join(self.folder, 'page.md')
        for name, problems in (('perpendicular', ['perpendicular_approach']), ('parallel', ['parallel_approach']),
                               ('unreachable', ['unreachable', 'walled_in', 'too_tight'])):
            runs = [record(problem, algorithm, 0, 'solved', 0.01, 25.0, None, **figures_of(variant, 0))
                    for problem in problems for algorithm, variant in ALGORITHMS.items()]
            runs += [record(problem + '_reeds_shepp_rectangle', 'Car', 0, 'solved', 0.01, 30.0, None, **figures_of('l', 0))
                     for problem in problems]
            made_results.write_with_paths(os.path.join(self.folder, name), runs)
        for name, _ in studies('maps', MAPS):
            scenario = name.rsplit('_', 1)[1]
            variants = VARIANTS if name.startswith('factorial') else dict.fromkeys(ALGORITHMS.values())
            made_results.write_with_paths(os.path.join(self.folder, name), [
                record(f'{scenario}_{k:02}', variant, 0, 'solved', 0.01, 25.0, None, **figures_of(variant, k))
                for k in range(MAPS) for variant in variants])
        for name in ('basic_astar', 'improved_astar'):
            with open(os.path.join(self.folder, f'drive_{name}.json'), 'w', encoding='utf-8') as stream:
                json.dump({'trajectory': [{'t': 0.1 * k, 'acceleration': 0.5, 'steering': 0.1} for k in range(50)]}, stream)

    def run_page(self):
        return subprocess.run([sys.executable, '-B', PAGE, self.folder, '--output', self.output], capture_output=True,
                              text=True, check=False)

    def rows(self):
        with open(self.output, encoding='utf-8') as stream:
            return [[cell.strip() for cell in line.strip('|\n').split(' | ')] for line in stream if line.startswith('|')]

    def test_page(self):
        done = self.run_page()
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        rows = {row[0]: row for row in reversed(self.rows())}
        loading = rows['map loading: Basic A\\* / Improved A\\*']
        self.assertEqual((loading[2], loading[4]), ('**10.0** (10.0 to 10.0)', 'agrees'))
        self.assertTrue(loading[5].startswith('with cells and poses looked at × 200'), loading)
        planning = rows['planning: Experiment 5 / Improved A\\*']
        self.assertEqual((planning[2], planning[4]), ('**0.500** (0.500 to 0.500)', 'differs'))
        self.assertEqual(rows['mean acceleration: Basic A\\* / Improved A\\*'][4], 'differs')
        self.assertEqual(rows['acceleration 83.1 % less'][4], 'not seen')
        self.assertEqual(rows['smoothing'][2], '1.00 (1.00 to 1.00)')  # of the cells looked at
        for name in ('effects', 'paths', 'drives'):
            with open(os.path.join(self.folder, 'images', f'paper-{name}.svg'), encoding='utf-8') as stream:
                self.assertTrue(stream.read().endswith('</svg>\n'))

    def test_a_run_that_had_to_wait_does_not_count(self):
        folder = os.path.join(self.folder, 'factorial_perpendicular')
        with sqlite3.connect(os.path.join(folder, 'benchmark.db')) as connection:
            connection.execute("UPDATE runs SET time = time + 0.02 WHERE plannerid = (SELECT id FROM plannerConfigs WHERE name = "
                               "'geometric_wlbs') AND experimentid != (SELECT id FROM experiments WHERE name = "
                               "'perpendicular_00')")
        connection.close()
        self.assertEqual(self.run_page().returncode, 0)
        rows = {row[0]: row for row in reversed(self.rows())}
        self.assertEqual(rows['planning: Experiment 5 / Improved A\\*'][4], 'unclear')
        self.assertEqual(rows['loading and planning: Experiment 5 / Improved A\\*'][4], 'differs')

    def test_bad_input(self):
        broken = [('perpendicular', lambda folder: made_results.write_with_paths(folder, [record('x', 'Car', 0, 'none')])),
                  ('factorial_parallel', lambda folder: os.remove(os.path.join(folder, 'benchmark.db'))),
                  ('drives_parallel', lambda folder: os.remove(os.path.join(folder, 'runs.jsonl')))]
        for name, spoil in broken:
            spoil(os.path.join(self.folder, name))
            done = self.run_page()
            self.assertEqual(done.returncode, 2, name)
            self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
            self.assertTrue(done.stderr.startswith('paper_page: '))
            self.assertIn(name, done.stderr)
            self.assertFalse(os.path.exists(self.output))
            self.setUp()


if __name__ == '__main__':
    assert Comparison([]).way() is None
    unittest.main()
