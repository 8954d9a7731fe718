"""Tests of benchmarks/report/make_report: its figures against others computed here, and bad input."""
import html.parser
import json
import math
import os
import random
import shutil
import sqlite3
import statistics
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import made_results
from made_results import MAKE_REPORT, REPORT, record

sys.path.insert(0, REPORT)
from charts import Axis, cost_at, shown, shown_time, success_curves, tick_time  # noqa: E402
from gallery import Picture, path_lines  # noqa: E402
from results import ReportError, read_results  # noqa: E402


def make_report(*arguments):
    return subprocess.run([sys.executable, '-B', MAKE_REPORT, *arguments], capture_output=True, text=True, check=False)


class Page(html.parser.HTMLParser):
    """The rows of all tables of a page as texts, what it loads, and whether its elements are closed."""
    VOID = {'meta', 'link', 'br', 'img', 'input', 'hr'}

    def __init__(self, text):
        super().__init__()
        self.tables, self.loads, self.links, self.open, self.wrong = [], [], [], [], []
        self.rows = self.cell = None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        for name in ('src', 'href', 'data', 'action'):
            if name in attributes and tag != 'a':
                self.loads.append(attributes[name])
        if tag == 'a':
            self.links.append(attributes.get('href', ''))
        if tag not in self.VOID:
            self.open.append(tag)
        if tag == 'table':
            self.rows = []
            self.tables.append(self.rows)
        elif tag == 'tr' and self.rows is not None:
            self.rows.append([])
        elif tag in ('td', 'th') and self.rows is not None:
            self.cell = []

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in self.VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append((tag, self.getpos()))
        if tag in ('td', 'th') and self.cell is not None:
            self.rows[-1].append(''.join(self.cell))
            self.cell = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell.append(data)


class Folder(made_results.FolderTest):
    def page(self, *arguments):
        done = make_report(self.folder, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        with open(self.path('report.html'), encoding='utf-8') as stream:
            text = stream.read()
        return text, Page(text)


class FiguresTest(Folder):
    def test_table_of_a_problem(self):
        times = [0.010, 0.020, 0.030, 0.040, 0.050, 0.060, 0.070]
        runs = [record('a', 'p', k, 'solved', time, 20.0 + k) for k, time in enumerate(times)]
        runs += [record('a', 'p', 7, 'invalid', 0.001, 5.0), record('a', 'p', 8, 'approximate', length=3.0),
                 record('a', 'p', 9, 'none')]
        made_results.write(self.folder, runs)
        _, page = self.page()
        row = next(row for row in page.tables[-1] if row[0].startswith('p '))
        # Seven of ten runs count; the three others are infinite: times sorted, the median lies between the 5th and 6th.
        self.assertEqual(row[0], 'p ▲ 1 invalid 1 approximate')
        self.assertEqual(row[1], '7/10')
        # Ranks of the 95 % interval for n = 10: 2 and 9.
        self.assertEqual(row[2], '55.0 ms 20.0 ms – ∞')
        self.assertEqual(row[3], '32.5 ms – ∞')
        self.assertEqual(row[4], '24.50 m 21.00 – ∞')

    def test_tables_and_curve_for_documents(self):
        runs = made_results.random_records(3, 4, 5, seed=3)
        made_results.write(self.folder, runs)
        done = subprocess.run([sys.executable, '-B', os.path.join(made_results.REPORT, 'results_page'), self.folder, '--svg',
                               self.path('curve.svg'), '--planner', 'planner_1'], capture_output=True, text=True, check=True)
        rows = {cells[1]: cells for cells in ([cell.strip() for cell in line.split('|')] for line in done.stdout.splitlines())
                if len(cells) > 2}
        for planner in range(4):
            own = [each for each in runs if each['planner'] == f'planner_{planner}']
            good = sum(each['figures']['success'] for each in own)
            self.assertEqual(rows[f'planner_{planner}'][2], f'{good} of {len(own)}')
        self.assertEqual(sum(name.startswith('problem_') for name in rows), 3)
        with open(self.path('curve.svg'), encoding='utf-8') as stream:
            curve = stream.read()
        self.assertEqual(len(xml.etree.ElementTree.fromstring(curve).findall('.//{*}polyline')), 4)

    def test_what_more_time_brings(self):
        def folder(name, lengths):
            made_results.write(self.path(name), [
                record(problem, planner, k, 'solved' if math.isfinite(length) else 'none', 0.01, length)
                for (problem, planner), runs in lengths.items() for k, length in enumerate(runs)])
            return self.path(name)
        inf = math.inf
        short = folder('short', {('a', 'p'): [12.0, 12.0, 11.0], ('a', 'q'): [20.0], ('b', 'p'): [inf, 30.0, inf],
                                 ('b', 'q'): [inf], ('c', 'p'): [inf], ('c', 'q'): [inf]})
        long = folder('long', {('a', 'p'): [10.0], ('a', 'q'): [11.0], ('b', 'p'): [24.0], ('b', 'q'): [20.0],
                               ('c', 'p'): [inf], ('c', 'q'): [inf]})
        program = [sys.executable, '-B', os.path.join(made_results.REPORT, 'results_page')]
        done = subprocess.run(program + ['--limits', short, long], capture_output=True, text=True, check=True)
        rows = [[cell.strip() for cell in line.split('|')[1:-1]] for line in done.stdout.splitlines()]
        # Shortest known: 10 and 20; nobody solves c. Medians over a and b: of 1.2 and infinity, 1 and 1.2, ...
        self.assertEqual(rows[2:], [['p', '4 of 7, –', '2 of 3, 1.1'], ['q', '1 of 3, –', '2 of 3, 1.05']])
        done = subprocess.run(program + [self.path('nowhere')], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count('\n')), (2, '', 1))

    def test_random_results_against_an_independent_computation(self):
        runs = made_results.random_records(3, 4, 23, seed=7)
        made_results.write(self.folder, runs)
        _, page = self.page()
        for number in range(3):
            further = {row[0]: row for row in page.tables[2 * number - 5][1:]}
            for row in page.tables[2 * number - 6][1:]:
                planner = row[0].split(' ')[0]
                own = [each for each in runs if each['experiment'] == f'problem_{number}' and each['planner'] == planner]
                good = [each for each in own if each['figures']['success']]
                self.assertEqual(row[1], f'{len(good)}/23')
                self.assertEqual(len(further[planner]), 1 + len(made_results.FURTHER))
                curvature = statistics.median(each['figures']['normalized curvature'] for each in good)
                self.assertAlmostEqual(float(further[planner][1 + made_results.FURTHER.index('normalized curvature')]
                                             .split(' ')[0]), curvature, delta=0.006 * curvature)
                # What is yes or no is shown as a share, not as a median.
                attained = 100.0 * statistics.mean(each['figures']['attains goal'] for each in good)
                self.assertAlmostEqual(float(further[planner][1 + made_results.FURTHER.index('attains goal')].split(' ')[0]),
                                       attained, delta=0.006 * attained)
                times = [each['figures']['first solution time'] for each in good]
                middle = statistics.median(times + [math.inf] * (23 - len(times)))
                shown = row[2].split(' ')[0]
                if math.isinf(middle):
                    self.assertEqual(shown, '∞')
                else:
                    unit = row[2].split(' ')[1]
                    self.assertAlmostEqual(float(shown) * {'s': 1.0, 'ms': 1e-3}[unit] / middle, 1.0, delta=0.006)
        overall = {row[0]: row for row in page.tables[0][1:]}
        for planner in range(4):
            own = [each for each in runs if each['planner'] == f'planner_{planner}']
            good = sum(each['figures']['success'] for each in own)
            bad = sum('first solution time' in each['figures'] and not each['figures']['success']
                      for each in own)
            self.assertEqual(overall[f'planner_{planner}'][1], f'{good}/69')
            self.assertEqual(overall[f'planner_{planner}'][3].lstrip('▲ '), str(bad))

    def test_success_curve_counts_every_run(self):
        runs = [record('a', 'p', 0, 'solved', 0.1, 9.0), record('a', 'p', 1, 'solved', 0.3, 9.0),
                record('a', 'p', 2, 'none'), record('a', 'p', 3, 'invalid', 0.01, 4.0)]
        made_results.write(self.folder, runs)
        found = read_results(self.folder)
        self.assertEqual(success_curves({0: found.runs}, 1.0)[0], [(0.1, 0.25), (0.3, 0.5)])

    def test_length_over_time_leaves_nothing_out(self):
        runs = [record('a', 'p', 0, 'solved', 0.1, 8.0, [[0.1, 12.0], [0.5, 8.0]]),
                record('a', 'p', 1, 'invalid', 0.1, 3.0), record('a', 'p', 2, 'none')]
        made_results.write(self.folder, runs)
        found = read_results(self.folder).runs
        self.assertEqual(cost_at(found, 0.05), [math.inf, math.inf, math.inf])
        self.assertEqual(cost_at(found, 0.2), [12.0, math.inf, math.inf])
        self.assertEqual(cost_at(found, 1.0), [8.0, math.inf, math.inf])

    def test_loading_the_map_is_no_planning(self):
        runs = [record('a', 'p', 0, 'solved', 0.1, 8.0, [[1.1, 8.0]],
                       **{'time': 1.1, 'planning time': 0.1, 'map loading time': 1.2})]
        made_results.write(self.folder, runs)
        run = read_results(self.folder).runs[0]
        self.assertEqual(run.time, 0.1)
        self.assertAlmostEqual(run.improvements[0][0], 0.1)

    def test_same_figures_from_the_database(self):
        if shutil.which('ompl_benchmark_statistics') is None:
            self.skipTest('ompl_benchmark_statistics (Debian package ompl-demos) is not installed')
        subprocess.run([sys.executable, os.path.join(os.path.dirname(MAKE_REPORT), '..', '..', 'tests',
                                                     'benchmarks', 'report', 'made_results.py'),
                        self.folder, '--problems', '2', '--planners', '3', '--runs', '7'],
                       check=True, capture_output=True)
        _, lines = self.page()
        logs = [self.path(name) for name in sorted(os.listdir(self.folder)) if name.endswith('.log')]
        subprocess.run(['ompl_benchmark_statistics', '-d', self.path('benchmark.db'), *logs], check=True,
                       capture_output=True)
        os.remove(self.path('runs.jsonl'))
        _, database = self.page()
        self.assertEqual(lines.tables, database.tables)


class PageTest(Folder):
    def test_stands_alone_and_is_well_formed(self):
        made_results.write(self.folder, made_results.random_records(2, 3, 8))
        text, page = self.page()
        self.assertEqual(page.wrong, [])
        self.assertEqual(page.open, [])
        self.assertEqual([each for each in page.loads if not each.startswith(('data:', '#'))], [])
        known = text.replace('http://www.w3.org/', '').replace('https://personal.sron.nl', '')
        self.assertFalse('http' in known, 'the page names something in the network')
        for link in page.links:
            if not link.startswith('#'):
                self.assertTrue(os.path.exists(self.path(link)), link)

    def test_names_are_only_names(self):
        evil = '<script>alert(1)</script>"\'&%%'
        made_results.write(self.folder, [record(evil, evil, 0, 'solved', 0.1, 8.0)])
        text, page = self.page()
        self.assertEqual(page.wrong, [])
        self.assertFalse('<script>alert' in text, 'a name became part of the page')
        self.assertTrue('&lt;script&gt;alert' in text)

    def test_machine_versions_and_seeds_are_there(self):
        made_results.write(self.folder, [record('a', 'p', 4, 'solved', 0.1, 8.0)])
        text, _ = self.page()
        for what in ('Some Processor', 'OMPL 1.5.2', 'seed 1004', 'somewhere', 'made.cfg', '>seed</dt><dd>1</dd>'):
            self.assertTrue(what in text, what)

    def test_names_come_in_the_order_of_the_summary(self):
        made_results.write(self.folder, [record('a', name, 0, 'solved', 0.1, 8.0) for name in ('x', 'y', 'z')])
        with open(self.path('summary.csv'), 'w', encoding='utf-8') as stream:
            stream.write('problem,planner,runs\na,z,1\na,gone,1\na,x,1\n')
        _, page = self.page()
        self.assertEqual([row[0] for row in page.tables[0][1:]], ['z', 'x', 'y'])

    def test_who_was_run_on_fewer_problems_is_not_the_best_of_all(self):
        made_results.write(self.folder, [record(problem, 'all', k, 'solved', 0.5, 8.0) for problem in 'ab' for k in range(3)]
                           + [record('a', 'easy', k, 'solved', 0.1, 8.0) for k in range(3)])
        text, _ = self.page()
        overall = text[text.index('<h2>Overall'):text.index('<h2>Problems and planners')]
        self.assertEqual(overall.count('class=best'), 1)
        self.assertTrue('class=best data-sort="0.5"' in overall)
        self.assertTrue('compare only those that share them' in overall)

    def test_nothing_solved(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        text, page = self.page()
        self.assertEqual(page.wrong, [])
        self.assertTrue('median is infinite throughout' in text)

    def test_parts_of_a_comparison_are_put_together(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'solved', 0.1, 8.0)], name='runs-1-of-2.jsonl')
        made_results.write(self.folder, [record('a', 'p', 1, 'none')], name='runs-2-of-2.jsonl')
        _, page = self.page()
        self.assertEqual(page.tables[0][1][1], '1/2')


class AxisTest(unittest.TestCase):
    def test_every_axis_has_a_few_ticks(self):
        rng = random.Random(3)
        for _ in range(5000):
            low = 10.0 ** rng.uniform(-6, 4)
            high = low * (1.0 + 10.0 ** rng.uniform(-2, 4))
            for logarithmic in (False, True):
                ticks = Axis(low, high, 0.0, 100.0, logarithmic).ticks()
                self.assertTrue(1 <= len(ticks) <= 12, (low, high, logarithmic, ticks))
                self.assertEqual(len({f'{value:.6g}' for value in ticks}), len(ticks))

    def test_ends_are_where_they_should_be(self):
        for logarithmic in (False, True):
            axis = Axis(0.1, 10.0, 20.0, 120.0, logarithmic)
            self.assertAlmostEqual(axis(0.1), 20.0)
            self.assertAlmostEqual(axis(10.0), 120.0)
            self.assertAlmostEqual(axis(math.inf), 120.0)
            self.assertAlmostEqual(axis(1.0), 70.0 if logarithmic else 20.0 + 100.0 * 0.9 / 9.9)

    def test_figures_are_legible(self):
        self.assertEqual([shown(value) for value in (0.0, 1234.5, 12.345, 0.012345, math.nan, math.inf)],
                         ['0', '1234', '12.3', '0.0123', '–', '∞'])
        self.assertEqual([shown_time(value) for value in (1.5e-5, 0.0123, 1.5, math.inf)],
                         ['15.0 µs', '12.3 ms', '1.50 s', '∞'])
        self.assertEqual([tick_time(value) for value in (1e-4, 0.002, 0.5, 2.0)], ['100 µs', '2 ms', '500 ms', '2 s'])


class BadInputTest(Folder):
    def refused(self, *arguments):
        done = make_report(*arguments)
        self.assertEqual(done.returncode, 2, done)
        self.assertEqual(done.stdout, '')
        self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
        self.assertTrue(done.stderr.startswith('make_report: '), done.stderr)
        self.assertFalse(os.path.exists(self.path('report.html')))
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith('.report-')], [])
        return done.stderr

    def test_usage(self):
        self.assertIn('FOLDER', self.refused())
        self.assertIn('--colour', self.refused(self.folder, '--colour', 'red'))

    def test_no_folder(self):
        self.assertIn('is no folder', self.refused(self.path('missing')))

    def test_empty_folder(self):
        self.assertIn('holds no results', self.refused(self.folder))

    def test_damaged_lines_are_named_and_left_out(self):
        for wrong in (b'{"experiment": "a"}', b'[1]', b'3', b'null', b'{', b'\xff\0', b'[' * 100000,
                      b'{"experiment": 1, "planner": 2, "run": "x"}'):
            made_results.write(self.folder, [record('a', 'p', 0, 'none')])
            with open(self.path('runs.jsonl'), 'ab') as stream:
                stream.write(wrong + b'\n' + json.dumps(record('a', 'p', 1, 'none')).encode() + b'\n')
            results = read_results(self.folder)
            self.assertEqual([run.number for run in results.runs], [0, 1])
            self.assertEqual(len(results.damage), 1)
            self.assertIn('runs.jsonl:3: is not a line of benchmark results (', results.damage[0])
        done = make_report(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, f'make_report: {results.damage[0]}\n'))

    def named(self, line, field, *content):
        made_results.write(self.folder, *content)
        with self.assertRaises(ReportError) as raised:
            read_results(self.folder)
        self.assertIn(f'runs.jsonl:{line}: ', str(raised.exception))
        self.assertIn(field, str(raised.exception))

    def test_values_that_mean_nothing_are_named_with_file_line_and_field(self):
        nan, solved = float('nan'), record('a', 'p', 1, 'solved', 0.1, 8.0)
        cases = [({'figures': {**solved['figures'], name: value}}, name) for name, value in (
            ('time', -1.0), ('time', nan), ('time', 'fast'), ('time', None), ('planning time', 'nan'),
            ('first solution time', -0.1), ('first solution time', math.inf), ('trajectory duration', -2), ('path length', -8.0),
            ('path length', 'inf'), ('success', 2), ('success', 'yes'), ('densely valid', 1), ('outcome', 11),
            ('outcome', 'solved'), ('outcome', -1), ('run', 1.5), ('run', -3), ('run', True), ('seed', '7'), ('status', 'exact'), ('cusps', -1),
            ('least clearance', nan), ('least clearance', 'wide'), ('nodes expanded', []))]
        cases += [({'figures': {name: value for name, value in solved['figures'].items() if name != gone}}, gone)
                  for gone in ('first solution time', 'path length')]
        cases += [({'experiment': 1}, 'experiment'), ({'planner': ''}, 'planner'), ({'reported': {'cost': nan}}, 'cost'),
                  ({'progress': [[0.1, 9.0], [-0.1, 8.0]]}, 'progress[1]'), ({'progress': [[0.1]]}, 'progress[0]'),
                  ({'progress': [[0.1, nan]]}, 'progress[0]'), ({'path': 3}, 'path is 3'), ({'path': {}}, 'path: exact'),
                  ({'path': {'exact': True, 'start': [0, 0], 'pieces': []}}, 'path: start'),
                  ({'path': {'exact': True, 'start': [0, 0, 0], 'pieces': [[0.0, nan]]}}, 'path: pieces[0]')]
        for change, field in cases:
            with self.subTest(f'{field}: {change}'):
                self.named(3, field, [record('a', 'p', 0, 'none'), {**solved, **change}])
        self.assertIn(f'runs.jsonl:3: {field}', self.refused(self.folder))
        for change, field in (({'time_limit': -2.0}, 'time_limit'), ({'time_limit': nan}, 'time_limit'),
                              ({'time_limit': 'long'}, 'time_limit'), ({'started': nan}, 'started'), ({'setups': 3}, 'setups'),
                              ({'fingerprints': 3}, 'fingerprints'), ({'fingerprints': {'a': 3}}, 'fingerprints: "a"')):
            with self.subTest(change):
                self.named(1, field, [solved], {**made_results.HEADER, **change})

    def test_values_that_parking_benchmark_writes_are_taken(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'solved', 0.0, 8.0, **{'distance to goal': 'inf', 'memory': -0.5}),
                                         dict(record('a', 'p', 1, 'none'), reported={'best cost': 'inf', 'off': 'nan'})])
        self.page()

    def test_paths_as_long_as_a_bad_planner_likes_are_drawn(self):
        for piece in ([1.0, 1e15], [0.0, 1e15, 1e-3]):
            lines, _ = path_lines({'start': [0, 0, 0], 'pieces': [piece]}, Picture(100.0, 100.0, 0.0, 0.0, 1.0, ''))
            self.assertEqual([direction for direction, _ in lines], [1])

    def test_what_is_no_file(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        for arguments in (['--runs', '/dev/zero'], ['--runs', self.folder], ['--classes', '/dev/zero']):
            self.assertIn(arguments[1], self.refused(self.folder, *arguments))
        os.mkfifo(self.path('pipe'))
        os.mkfifo(self.path('pipe.db'))
        self.assertIn('is a pipe', self.refused(self.folder, '--output', self.path('pipe')))
        self.assertIn('is no file', self.refused(self.folder, '--runs', self.path('pipe.db')))
        # What somebody writes into a pipe is read.
        with open(self.path('runs.jsonl'), 'rb') as stream:
            done = subprocess.run(['bash', '-c', f'cat | {sys.executable} -B {MAKE_REPORT} {self.folder} --runs /dev/stdin'],
                                  stdin=stream, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ''))

    def contents(self):
        found = {}
        for name in sorted(os.listdir(self.folder)):
            with open(self.path(name), 'rb') as stream:
                found[name] = stream.read()
        return found

    def test_inputs_are_not_written_over(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')], name='pairs.csv')
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        with open(self.path('classes'), 'w', encoding='utf-8') as stream:
            stream.write('problem,class\na,b\n')
        os.link(self.path('runs.jsonl'), self.path('link'))
        before = self.contents()
        for arguments in (['--output', self.path('runs.jsonl')], ['--output', self.path('link')],
                          ['--classes', self.path('classes'), '--output', self.path('classes')],
                          ['--runs', self.path('pairs.csv')]):
            self.assertIn('is the input', self.refused(self.folder, *arguments))
        done = subprocess.run([sys.executable, '-B', os.path.join(REPORT, 'results_page'), self.folder, '--svg',
                               self.path('link')], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr.count('\n')), (2, 1), done.stderr)
        self.assertEqual(before, self.contents())

    def test_times_of_a_database(self):
        with sqlite3.connect(self.path('benchmark.db')) as connection:
            connection.executescript('''
                CREATE TABLE experiments (id INTEGER, name TEXT, setup TEXT, hostname TEXT, cpuinfo TEXT, seed INTEGER,
                                          timelimit REAL, version TEXT);
                CREATE TABLE plannerConfigs (id INTEGER, name TEXT, settings TEXT);
                CREATE TABLE runs (id INTEGER, experimentid INTEGER, plannerid INTEGER, time REAL, solved INTEGER);
                INSERT INTO experiments VALUES (1, 'a', '', '', '', 1, 2.0, '');
                INSERT INTO plannerConfigs VALUES (1, 'p', '');
                INSERT INTO runs VALUES (7, 1, 1, -0.5, 1);''')
        connection.close()
        message = self.refused(self.folder)
        for part in ('benchmark.db: run 7: ', 'time is -0.5'):
            self.assertIn(part, message)
        # In a folder whose name would mean something else in an address.
        folder = self.path('run#1?50%41')
        os.mkdir(folder)
        os.rename(self.path('benchmark.db'), os.path.join(folder, 'benchmark.db'))
        self.assertIn('run 7: ', self.refused(folder))

    def test_runs_that_the_last_start_did_not_want_are_left_out(self):
        def marked(planner, run, fingerprint):
            return dict(record('a', planner, run, 'none'), fingerprint=fingerprint)
        made_results.write(self.folder, [marked('p', 0, '1'), marked('q', 0, '2'),
                                         dict(made_results.HEADER, fingerprints={'a': {'p': '1', 'q': '3'}}),
                                         marked('q', 0, '3'), marked('gone', 0, '4')])
        self.assertEqual([(run.planner, run.number) for run in read_results(self.folder).runs], [('p', 0), ('q', 0)])

    def test_other_files(self):
        for content in (b'', b'no newline', b'{}\n', b'\xff\xfe\n', b'{"parking_benchmark": 1}\n'):
            with open(self.path('runs.jsonl'), 'wb') as stream:
                stream.write(content)
            self.assertIn('runs.jsonl', self.refused(self.folder))

    def test_runs_are_missing(self):
        made_results.write(self.folder, [])
        self.assertIn('holds no runs', self.refused(self.folder))

    def test_a_line_that_was_cut_short_is_ignored(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        with open(self.path('runs.jsonl'), 'a', encoding='utf-8') as stream:
            stream.write('{"experiment": "a", "pla')
        self.page()

    def test_runs_of_different_comparisons(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')], name='runs-1-of-2.jsonl')
        made_results.write(self.folder, [record('a', 'p', 1, 'none')], dict(made_results.HEADER, fingerprint='4'),
                           name='runs-2-of-2.jsonl')
        self.assertIn('different comparisons', self.refused(self.folder))

    def test_other_databases(self):
        with open(self.path('benchmark.db'), 'w', encoding='utf-8') as stream:
            stream.write('no database')
        self.assertIn('is not a benchmark database', self.refused(self.folder))
        os.remove(self.path('benchmark.db'))
        with sqlite3.connect(self.path('benchmark.db')) as connection:
            connection.execute('CREATE TABLE runs (id INTEGER)')
        connection.close()
        self.assertIn('is not a benchmark database', self.refused(self.folder))

    def test_page_cannot_be_written(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        self.assertIn('cannot be written', self.refused(self.folder, '--output', self.path('no/such/folder.html')))
        os.mkdir(self.path('taken'))
        self.assertIn('cannot be written', self.refused(self.folder, '--output', self.path('taken')))


if __name__ == '__main__':
    unittest.main()
