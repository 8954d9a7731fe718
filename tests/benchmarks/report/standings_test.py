"""Tests of benchmarks/report/standings: scores worked out by hand, properties of profiles, files, pictures, bad input."""
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest

import made_results
from made_results import MAKE_REPORT, record

from charts import expected_chart, profile_chart, rank_chart  # noqa: E402
from database import read_results  # noqa: E402
from program import ReportError  # noqa: E402
from standings import (Standings, class_by_name, middle_difference, profile, read_classes, score,  # noqa: E402
                       share_within)


def standings_of(records, classes=None):
    with tempfile.TemporaryDirectory() as folder:
        made_results.write(folder, records)
        results = read_results(folder)
        return results, Standings(results, classes)


def solved(problem, planner, times, length=10.0):
    """Runs with these times to the first solution; None: not solved."""
    return [record(problem, planner, k, 'none' if time is None else 'solved', time, length)
            for k, time in enumerate(times)]


# Three problems, three runs each. a: 0.1, 0.4, unsolved; b: 0.2, 0.2, 0.2; c is solved by nobody.
HAND = (solved('x', 'a', [0.1, 0.1, 0.3], 10.0) + solved('y', 'a', [0.4, None, 0.6], 12.0) + solved('z', 'a', [None] * 3)
        + solved('x', 'b', [0.2, 0.2, 0.2], 15.0) + solved('y', 'b', [0.2, 0.2, 0.3], 12.0) + solved('z', 'b', [None] * 3)
        + solved('x', 'c', [None, None, 0.1], 9.0) + solved('y', 'c', [None] * 3) + solved('z', 'c', [None] * 3))


class HandTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results, cls.all = standings_of(HAND)
        cls.field = cls.all.fields[0]
        cls.rows = {cls.results.planners[row.index]: row for row in cls.field.rows}

    def test_everybody_is_there_and_so_are_all_problems(self):
        self.assertEqual(len(self.all.fields), 1)
        self.assertEqual(self.field.problems, ['x', 'y', 'z'])
        self.assertEqual({name: (row.runs, row.solved) for name, row in self.rows.items()},
                         {'a': (9, 5), 'b': (9, 6), 'c': (9, 1)})

    def test_scores_are_medians_over_all_runs(self):
        self.assertEqual(self.field.scores['time'][0], [0.1, 0.6, math.inf])
        self.assertEqual(self.field.scores['time'][1], [0.2, 0.2, math.inf])
        self.assertEqual(self.field.scores['time'][2], [math.inf] * 3)
        self.assertEqual(self.field.scores['length'][0], [10.0, 12.0, math.inf])

    def test_par10(self):
        # a: (0.5 + (1.0 + 20) + 60) / 9; limit 2 s, so a run that is not solved counts as 20 s.
        self.assertAlmostEqual(self.rows['a'].par10, (0.5 + 21.0 + 60.0) / 9.0, 12)
        self.assertAlmostEqual(self.rows['b'].par10, (0.6 + 0.7 + 60.0) / 9.0, 12)
        self.assertAlmostEqual(self.rows['c'].par10, (40.1 + 120.0) / 9.0, 12)
        self.assertAlmostEqual(self.field.best_par10, (0.5 + 0.7 + 60.0) / 9.0, 12)

    def test_problems_of_equal_weight(self):
        _, standing = standings_of(solved('x', 'a', [0.1]) + solved('y', 'a', [None] * 9))
        self.assertAlmostEqual(standing.fields[0].rows[0].par10, 0.5 * (0.1 + 20.0), 12)
        self.assertAlmostEqual(standing.fields[0].rows[0].expected, 1.0, 12)

    def test_profiles(self):
        # Times over the best: a 1 and 3, b 2 and 1, c none. z stays in the denominator.
        third = 1.0 / 3.0
        self.assertEqual(self.field.profiles['time'][0], [(1.0, third), (0.6 / 0.2, 2 * third)])
        self.assertEqual(self.field.profiles['time'][1], [(1.0, third), (2.0, 2 * third)])
        self.assertEqual(self.field.profiles['time'][2], [(1.0, 0.0)])
        self.assertEqual(self.field.profiles['length'][0], [(1.0, 2 * third)])
        self.assertEqual(self.field.profiles['length'][1], [(1.0, third), (1.5, 2 * third)])
        self.assertEqual(self.rows['b'].within['time', 2.0], 2 * third)
        self.assertEqual(self.rows['a'].within['time', 2.0], third)
        self.assertEqual(self.field.best_solved, 2)

    def test_ranks(self):
        # x: 1, 2, 3; y: 2, 1, 3; z: all alike.
        self.assertEqual(self.field.rankings['time'].ranks, {0: 5.0 / 3.0, 1: 5.0 / 3.0, 2: 8.0 / 3.0})

    def test_pairs(self):
        pair = next(pair for pair in self.all.pairs if (pair.measure, pair.first, pair.second) == ('time', 0, 1))
        self.assertEqual((pair.problems, pair.wins, pair.ties, pair.losses), (3, 1, 1, 1))
        self.assertEqual(pair.ratio, 1.0)
        # |log 1/2| < |log 3|; the tie has rank 1 and loses it.
        self.assertEqual((pair.wilcoxon.minus, pair.wilcoxon.plus, pair.wilcoxon.zeros), (2.0, 3.0, 1))
        pair = next(pair for pair in self.all.pairs if (pair.measure, pair.first, pair.second) == ('time', 0, 2))
        self.assertEqual((pair.wins, pair.ties, pair.losses, pair.ratio), (2, 1, 0, 0.0))

    def test_expected_over_time(self):
        points = self.field.expected[0]
        self.assertEqual([point[0] for point in points], [0.1, 0.3, 0.4, 0.6])
        for (_, found, low, high), wanted in zip(points, (2 / 3, 1.0, 4 / 3, 5 / 3)):
            self.assertAlmostEqual(found, wanted, 12)
            self.assertTrue(0.0 <= low < found < high <= 3.0)
        self.assertEqual(self.field.expected[2][-1][0], 0.1)

    def test_noise_of_arithmetic_is_a_tie(self):
        results, _ = standings_of(solved('x', 'a', [0.1], 10.0) + solved('x', 'b', [0.1 + 1e-9], 10.0 + 1e-8))
        for measure in ('time', 'length'):
            self.assertEqual(score(results.of('x', 'a'), measure), score(results.of('x', 'b'), measure))

    def test_median_of_differences_with_infinite_ones(self):
        inf = math.inf
        for differences, wanted in (([1.0, 3.0], 2.0), ([-inf, inf], 0.0), ([-inf, 3.0], -inf), ([1.0, inf], inf),
                                    ([-inf, 1.0, inf], 1.0), ([-inf, -inf], -inf)):
            self.assertEqual(middle_difference(differences), wanted)


class PropertiesTest(unittest.TestCase):
    def random(self, seed, problems=6, planners=4, runs=7):
        return standings_of(made_results.random_records(problems, planners, runs, seed))

    def test_profiles_rise_to_the_share_that_is_solved(self):
        for seed in range(8):
            _, standing = self.random(seed)
            field = standing.fields[0]
            for measure in ('time', 'length'):
                for index, points in field.profiles[measure].items():
                    self.assertEqual(points[0][0], 1.0)
                    self.assertEqual(sorted(points), points)
                    heights = [height for _, height in points]
                    self.assertEqual(sorted(heights), heights)
                    finite = sum(map(math.isfinite, field.scores[measure][index]))
                    self.assertAlmostEqual(heights[-1], finite / len(field.problems), 12)
                    for ratio in (1.0, 1.3, 2.0, 50.0):
                        by_points = max(height for at, height in points if at <= ratio)
                        self.assertEqual(by_points, share_within(field.ratios[measure][index], ratio))
                best = sum(points[0][1] for points in field.profiles[measure].values())
                self.assertGreaterEqual(best * len(field.problems) + 1e-9,
                                        sum(map(math.isfinite, field.virtual_best[measure])))

    def test_profile_reaches_one_where_all_is_solved(self):
        self.assertEqual(profile([1.0, 2.0, 1.0, 7.0]), [(1.0, 0.5), (2.0, 0.75), (7.0, 1.0)])
        self.assertEqual(profile([math.inf, math.inf]), [(1.0, 0.0)])

    def test_nobody_beats_the_virtual_best(self):
        for seed in range(5):
            _, standing = self.random(seed)
            self.assertTrue(all(row.par10 >= standing.fields[0].best_par10 for row in standing.fields[0].rows))
            self.assertTrue(all(value >= 1.0 for values in standing.fields[0].ratios['time'].values() for value in values))

    def test_faster_clocks_change_no_rank_and_no_test(self):
        slow = made_results.random_records(6, 3, 5, 3)
        fast = json.loads(json.dumps(slow))
        for each in fast:
            if 'first solution time' in each['figures']:
                each['figures']['first solution time'] /= 4.0
            each['progress'] = [[time / 4.0, cost] for time, cost in each['progress']]
        first, second = standings_of(slow)[1], standings_of(fast)[1]
        self.assertEqual(first.fields[0].rankings['time'].ranks, second.fields[0].rankings['time'].ranks)
        for one, other in zip(first.pairs, second.pairs):
            self.assertEqual((one.wins, one.ties, one.losses), (other.wins, other.ties, other.losses))
            self.assertAlmostEqual(one.wilcoxon.p, other.wilcoxon.p, 9)

    def test_intervals_hold_for_problems_drawn_alike(self):
        # Half of the problems are solved in nine runs of ten, the others in one of ten, runs within a problem the same: how
        # often is the true share, one half, within the interval of twelve problems?
        rng, inside, rounds = random.Random(12), 0, 300
        for _ in range(rounds):
            records = []
            for problem in range(12):
                share = rng.choice((0.9, 0.1))
                records += solved(f'p{problem}', 'a', [0.1 if rng.random() < share else None for _ in range(6)])
            _, low, high = (standings_of(records)[1].fields[0].expected[0] or [(0, 0, 0, 0)])[-1][1:]
            inside += low <= 6.0 <= high
        self.assertGreater(inside / rounds, 0.95 - 4 * math.sqrt(0.95 * 0.05 / rounds))

    def test_planners_on_other_problems_are_other_fields(self):
        records = HAND + solved('disc', 'd', [0.1]) + solved('disc', 'e', [0.2])
        results, standing = standings_of(records)
        self.assertEqual([[results.planners[index] for index in each.planners] for each in standing.fields],
                         [['a', 'b', 'c'], ['d', 'e']])
        self.assertEqual(len(standing.pairs), 6)

    def test_other_experiments_do_not_weaken_the_correction(self):
        many = [each for k in range(8) for each in solved(f'p{k}', 'a', [0.1]) + solved(f'p{k}', 'b', [0.2])]
        others = [each for k in range(8) for planner in 'cdef' for each in solved(f'q{k}', planner, [0.1 + k])]
        alone = standings_of(many)[1].pairs[0]
        together = next(pair for pair in standings_of(many + others)[1].pairs if (pair.first, pair.second) == (0, 1))
        self.assertEqual(alone.wilcoxon_holm, 2 / 2 ** 8)
        self.assertEqual(together.wilcoxon_holm, alone.wilcoxon_holm)


class ClassesTest(unittest.TestCase):
    def test_by_name(self):
        for name, kind in (('Case17', 'Case'), ('Case3', 'Case'), ('narrow_parallel', 'parallel'), ('angled45', 'angled'),
                           ('random_perpendicular_007', 'perpendicular'), ('dead_end_aisle', 'dead_end_aisle'),
                           ('garage_se2_circle', 'garage_se2_circle'), ('large_lot_2_13', 'large_lot'), ('lot_12_se2_circle', 'lot_se2_circle'), ('42', '42'),
                           ('0007_lot', 'lot')):
            self.assertEqual(class_by_name(name), kind, name)

    def test_table_counts_every_run(self):
        results, standing = standings_of(solved('Case1', 'a', [0.1, None]) + solved('Case2', 'a', [0.3])
                                        + solved('parallel', 'a', [0.2]))
        self.assertEqual(standing.classes, {'Case': ['Case1', 'Case2'], 'parallel': ['parallel']})
        count, runs, good, share, penalised = standing.of_class['Case', 0]
        self.assertEqual((count, runs, good, share), (2, 3, 2, 0.75))
        self.assertAlmostEqual(penalised, 0.5 * (0.5 * 20.1 + 0.3), 12)
        self.assertEqual(results.planners, ['a'])


class FilesTest(made_results.FolderTest):
    def write(self, name, content):
        with open(self.path(name), 'wb') as stream:
            stream.write(content)

    def make(self, *arguments):
        return subprocess.run([sys.executable, '-B', MAKE_REPORT, self.folder, *arguments], capture_output=True, text=True,
                              check=False)

    def made(self, *arguments):
        done = self.make(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        with open(self.path('statistics.json'), encoding='utf-8') as stream:
            found = json.load(stream)
        tables = {}
        for name in ('standings.csv', 'pairs.csv'):
            with open(self.path(name), encoding='utf-8', newline='') as stream:
                tables[name] = list(csv.DictReader(stream))
        with open(self.path('report.html'), encoding='utf-8') as stream:
            return found, tables, stream.read()

    def test_files_say_the_same(self):
        made_results.write(self.folder, HAND)
        found, tables, page = self.made()
        rows = {row['planner']: row for row in tables['standings.csv'] if row['field'] == '0'}
        self.assertEqual(list(rows), ['a', 'b', 'c', 'virtual best'])
        for planner in found['fields'][0]['planners']:
            self.assertAlmostEqual(float(rows[planner['planner']]['par10_s']), planner['par10'], 8)
            self.assertAlmostEqual(float(rows[planner['planner']]['rank_time']), planner['time']['mean_rank'], 8)
        self.assertEqual(found['fields'][0]['planners'][2]['time']['scores'], [None] * 3)
        self.assertEqual(len(tables['pairs.csv']), 6)
        self.assertEqual([row['wilcoxon_p'] for row in tables['pairs.csv']],
                         [f"{pair['wilcoxon']['p']:.10g}" for pair in found['pairs']])
        standings = page[page.index('<section id="standings">'):page.index('<details class="problem"')]
        self.assertIn('>9.06 s</td>', standings)
        self.assertIn('>1–1</td>', standings)

    def test_charts_show_all(self):
        names = [f'p{k}' for k in range(28)]
        ranks = {k: 1.0 + 27.0 * (k / 27.0) ** 2 for k in range(28)}
        traces = rank_chart(names, ranks, [[0, 1, 2], [5, 6]])['data']
        self.assertEqual([trace['x'] for trace in traces[:28]], [[float(f'{rank:.4g}')] for rank in ranks.values()])
        self.assertEqual([trace['y'] for trace in traces[28:]], [[-0.2, 2.2], [4.8, 6.2]])
        field = standings_of(HAND)[1].fields[0]
        for chart in (profile_chart(names, field.profiles['time'], 'best'),
                      expected_chart(names, field.expected, 3, made_results.TIME_LIMIT)):
            curves = [trace for trace in chart['data'] if trace['line']['width']]
            self.assertEqual([curve['meta'] for curve in curves], [0, 1, 2])
            for curve in curves:
                self.assertEqual(curve['y'], sorted(curve['y']))

    def test_one_problem_cannot_be_tested(self):
        made_results.write(self.folder, solved('x', 'a', [0.1]) + solved('x', 'b', [0.2]))
        found, _, page = self.made()
        self.assertEqual(found['pairs'], [])
        self.assertIn('require two problems', page)

    def test_no_time_limit_is_known(self):
        made_results.write(self.folder, HAND, None)
        found, _, _ = self.made()
        self.assertIsNone(found['fields'][0]['planners'][0]['par10'])

    def test_classes_of_the_user(self):
        made_results.write(self.folder, HAND)
        self.write('classes.csv', b'problem,class\nx,easy\ny,easy\nz,hard & <odd>\ngone,easy\n')
        found, tables, page = self.made()
        self.assertEqual(found['classes'], {'easy': ['x', 'y'], 'hard & <odd>': ['z']})
        self.assertEqual(sum(row['class'] == 'easy' for row in tables['standings.csv']), 3)
        self.assertIn('hard &amp; &lt;odd&gt;', page)

    def test_bad_classes(self):
        made_results.write(self.folder, HAND)
        for content, what in ((b'', 'columns problem and class'), (b'a,b\n1,2\n', 'columns problem and class'),
                              (b'problem,class\nx,\n', ':2: lacks'), (b'problem,class\nx\n', ':2: lacks'),
                              (b'problem,class\nx,a\nx,b\n', ':3: x already belongs to class a'),
                              (b'\xff\xfe', 'is not a CSV file'), (b'problem,class\nnone,a\n', 'no such problem')):
            self.write('mine.csv', content)
            done = self.make('--classes', self.path('mine.csv'))
            self.assertEqual((done.returncode, done.stdout, done.stderr.count('\n')), (2, '', 1), done)
            self.assertIn(what, done.stderr)
            self.assertIn('mine.csv', done.stderr)
            self.assertEqual(os.listdir(self.folder).count('report.html'), 0)
        self.assertIn('cannot be read', self.make('--classes', self.path('missing.csv')).stderr)
        self.assertRaises(ReportError, read_classes, self.folder)

    def test_a_hundred_thousand_runs_make_a_page_below_ten_megabytes(self):
        # A quarter of the runs on more problems and planners than fit.
        records = [record(f'problem_{problem}', f'planner_{planner}', run, 'solved' if (problem + run) % 3 else 'none',
                          0.001 * (1 + planner + (7 * problem + 3 * run) % 101), 20.0 + run)
                   for problem in range(600) for planner in range(20) for run in range(2)]
        made_results.write(self.folder, records)
        _, _, page = self.made()
        self.assertLess(len(page.encode()), 10_000_000)
        kept = page.count('<details class="problem"')
        self.assertEqual(kept, 50)
        self.assertIn(f'sections of {600 - kept} of the 600 problems are left out', page)
        self.assertNotIn(f'href="#problem-{kept}"', page)
        self.assertIn('<b>24 000</b><span>runs</span>', page)


if __name__ == '__main__':
    unittest.main()
