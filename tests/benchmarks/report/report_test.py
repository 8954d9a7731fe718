"""Tests of benchmarks/report/make_report: its figures against others computed here, and bad input."""
import base64
import gzip
import html.parser
import json
import math
import os
import re
import shutil
import sqlite3
import statistics
import subprocess
import sys
import unittest

import made_results
from made_results import MAKE_REPORT, REPORT, record

import plotly.graph_objects  # noqa: E402
from charts import best_length_at, colour_of, dash_of, median_curve, success_points  # noqa: E402
from database import read_results  # noqa: E402
from formatting import shown, shown_time  # noqa: E402
from gallery import read_picture  # noqa: E402


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
        # Ranks of the 95 % interval for n = 10: 2 and 9, for n = 7: 1 and 7. Lengths are those of the seven.
        self.assertEqual(row[:5], ['p ▲ 1 invalid 1 approximate', '7/10', '55.0 ms 20.0 ms – ∞', '32.5 ms – ∞',
                                   '23.00 m 20.00 m – 26.00 m'])

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
                shown_middle = row[2].split(' ')
                if math.isinf(middle):
                    self.assertEqual(shown_middle[0], '∞')
                else:
                    self.assertAlmostEqual(float(shown_middle[0]) * {'s': 1.0, 'ms': 1e-3}[shown_middle[1]] / middle, 1.0,
                                           delta=0.006)
        overall = {row[0]: row for row in page.tables[0][1:]}
        for planner in range(4):
            own = [each for each in runs if each['planner'] == f'planner_{planner}']
            bad = sum('first solution time' in each['figures'] and not each['figures']['success'] for each in own)
            row = overall[f'planner_{planner}']
            self.assertEqual((row[1], row[3].lstrip('▲ ')), (f'{sum(each["figures"]["success"] for each in own)}/69', str(bad)))

    def test_curves_count_every_run(self):
        made_results.write(self.folder, [
            record('a', 'p', 0, 'solved', 0.1, 8.0, [[0.1, 12.0], [0.3, 12.0], [0.5, 8.0]]),
            record('a', 'p', 1, 'solved', 0.3, 9.0), record('a', 'p', 2, 'invalid', 0.01, 3.0), record('a', 'p', 3, 'none')])
        runs = read_results(self.folder).runs
        inf = math.inf
        self.assertEqual(success_points(runs), [(0.1, 0.25), (0.3, 0.5)])
        self.assertEqual(best_length_at(runs, [0.05, 0.1, 0.4, 1.0]).T.tolist(), [
            [inf, inf, inf, inf], [12.0, inf, inf, inf], [12.0, 9.0, inf, inf], [8.0, 9.0, inf, inf]])
        self.assertEqual(median_curve(runs, 0.01, 1.0), [])  # half of the runs is not more than half
        self.assertEqual([point[1:] for point in median_curve(runs[:3], 0.01, 1.0)], [(12.0, 9.0, inf), (9.0, 8.0, inf)])

    def test_loading_the_map_is_no_planning(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'solved', 0.1, 8.0, [[1.1, 8.0]],
                                                **{'time': 1.1, 'planning time': 0.1, 'map loading time': 1.2})])
        run = read_results(self.folder).runs[0]
        self.assertEqual(run.time, 0.1)
        self.assertAlmostEqual(run.improvements[0][0], 0.1)

    def test_a_database_without_second_checks(self):
        made_results.write(self.folder, [record('a', 'p', k, 'none', solved=True, **{
            'correct solution': k > 0, 'approximate solution': k > 1, 'solution length': 7.0, 'time': 0.5}) for k in range(3)])
        with sqlite3.connect(self.path('benchmark.db')) as connection:
            connection.execute('ALTER TABLE runs DROP COLUMN success')
        connection.close()
        text, page = self.page()
        self.assertIn('without second checks', text)
        self.assertEqual([(run.solved, run.invalid, run.approximate, run.time, run.length)
                          for run in read_results(self.folder).runs],
                         [(False, True, False, math.inf, math.inf), (True, False, False, 0.5, 7.0),
                          (False, False, True, math.inf, math.inf)])
        self.assertEqual(page.tables[0][1][1], '1/3')

    def test_figures_are_legible(self):
        self.assertEqual([shown(value) for value in (0.0, 1234.5, 12.345, 0.012345, math.nan, math.inf)],
                         ['0', '1234', '12.3', '0.0123', '–', '∞'])
        self.assertEqual([shown_time(value) for value in (1.5e-5, 0.0123, 1.5, math.inf)],
                         ['15.0 µs', '12.3 ms', '1.50 s', '∞'])


class PageTest(Folder):
    def test_stands_alone_and_is_well_formed(self):
        made_results.write(self.folder, made_results.random_records(2, 3, 8))
        text, page = self.page()
        self.assertEqual((page.wrong, page.open), ([], []))
        self.assertEqual([each for each in page.loads if not each.startswith(('data:', '#'))], [])
        self.assertNotIn('http', re.sub('<script type="text/plain".*?</script>', '', text, flags=re.DOTALL))
        for link in page.links:
            self.assertTrue(link.startswith('#') or os.path.exists(self.path(link)), link)

    def test_plotly_is_there_once_and_takes_all_charts(self):
        made_results.write(self.folder, made_results.random_records(3, 3, 8) + [record('d', 'planner_0', 0, 'none')])
        text, _ = self.page()
        packed = re.search('<script type="text/plain" id="plotly">(.*?)</script>', text).group(1)
        self.assertIn('Plotly', gzip.decompress(base64.b64decode(packed)).decode())
        charts = json.loads(re.search('<script type="application/json" id="charts">(.*?)</script>', text).group(1))
        self.assertEqual(set(charts), set(re.findall('class="chart" id="([^"]*)"', text)))
        for name, chart in charts.items():
            with self.subTest(name):
                plotly.graph_objects.Figure(chart)  # raises for what Plotly does not know

    def test_names_are_only_names(self):
        evil = '<script>alert(1)</script>"\'&%%{{7*7}}</script>'
        made_results.write(self.folder, [record(evil + part, evil, 0, 'solved', 0.1, 8.0) for part in 'ab'])
        text, page = self.page()
        self.assertEqual((page.wrong, page.open), ([], []))
        self.assertFalse('<script>alert' in text, 'a name became part of the page')
        self.assertTrue('&lt;script&gt;alert' in text)
        self.assertNotIn('49</script>', text)

    def test_machine_versions_and_seeds_are_there(self):
        made_results.write(self.folder, [record('a', 'p', 4, 'solved', 0.1, 8.0)])
        text, _ = self.page()
        for what in ('Some Processor', 'OMPL 1.5.2', 'seed 1004', 'somewhere', '<dt>seed</dt><dd>1</dd>',
                     '<dt>depth</dt><dd>2</dd><dt>range</dt><dd>1</dd>'):
            self.assertTrue(what in text, what)

    def test_names_come_in_the_order_of_the_summary(self):
        made_results.write(self.folder, [record('a', name, 0, 'solved', 0.1, 8.0) for name in ('x', 'y', 'z')])
        with open(self.path('summary.csv'), 'w', encoding='utf-8') as stream:
            stream.write('problem,planner,runs\na,z,1\na,gone,1\na,x,1\n')
        _, page = self.page()
        self.assertEqual([row[0] for row in page.tables[0][1:]], ['z', 'x', 'y'])

    def test_planners_are_compared_with_those_on_the_same_problems_only(self):
        made_results.write(self.folder, [record(problem, name, k, 'solved', time, 8.0) for problem in 'ab' for k in range(3)
                                         for name, time in (('all', 0.5), ('too', 0.7))]
                           + [record('a', 'easy', k, 'solved', 0.1, 8.0) for k in range(3)])
        text, page = self.page()
        overall = text[text.index('<h2>Overall'):text.index('<h2>Problems and planners')]
        self.assertEqual(re.findall('class="best[^"]*" data-sort="([^"]*)"', overall), ['0.5'])
        self.assertEqual([[row[0] for row in table[1:]] for table in page.tables[:2]], [['all', 'too'], ['easy']])
        charts = json.loads(re.search('<script type="application/json" id="charts">(.*?)</script>', text).group(1))
        self.assertEqual([{trace['meta'] for trace in charts[f'success-all-{k}']['data']} for k in range(2)], [{0, 1}, {2}])

    def test_problems_without_a_solution_are_told_apart(self):
        made_results.write(self.folder, [record('a', name, k, 'solved', 0.5, 8.0, solvable=True) for name in 'pq' for k in range(4)]
                           + [record('b', 'p', k, 'approximate', length=3.0, solvable=False, **{'planning time': 0.25 + 0.5 * k})
                              for k in range(4)]
                           + [record('b', 'q', 0, 'none', solvable=False), record('b', 'q', 1, 'invalid', 0.1, 5.0, solvable=False),
                              record('b', 'q', 2, 'none', solvable=False, **{'planning time': 0.1})])
        with sqlite3.connect(self.path('benchmark.db')) as connection:
            connection.execute('ALTER TABLE runs ADD outcome ENUM')
            connection.execute('UPDATE runs SET outcome = 7 WHERE plannerid = 2 AND run = 2 AND experimentid = 2')  # a crash
        connection.close()
        results = read_results(self.folder)
        self.assertEqual((results.solvable, results.unsolvable), (['a'], ['b']))
        text, page = self.page()
        self.assertIn('<b>2</b><span>problems, 1 without a solution</span>', text)
        self.assertIn('<b>100 %</b><span>of the runs with a solution solved</span>', text)
        self.assertEqual(page.tables[0][1][:3], ['p', '4/4', '1/1'])
        rows = {row[0]: row[1:] for row in page.tables[1][1:]}
        # p refuses at 0.25, 0.75, 1.25 and 1.75 s of 2; of q, one searches to the end, one claims a path, one crashes.
        self.assertEqual(rows, {'b: p': ['4/4', '1.00 s', '0', '0'], 'b: q': ['0/3', '–', '2', '▲ 1']})
        self.assertIn('4/4 refused, 1.00 s', page.tables[2][2][1])
        with open(self.path('statistics.json'), encoding='utf-8') as stream:
            found = json.load(stream)
        self.assertEqual([field['problems'] for field in found['fields']], [['a']])
        self.assertEqual(found['fields'][0]['virtual_best']['par10'], 0.5)

    def test_only_problems_without_a_solution(self):
        made_results.write(self.folder, [record('b', 'p', 0, 'none', solvable=False)])
        text, page = self.page()
        self.assertEqual((page.wrong, page.open), ([], []))
        self.assertIn('<b>–</b><span>of the runs with a solution solved</span>', text)

    def test_memory_that_was_not_measured_is_not_shown(self):
        for sizes, wanted in ((('0', '0'), None), (('0', '30'), '15.0 MB'), (('0', '0', '9'), '&lt; 0.1 MB')):
            made_results.write(self.folder, [record('a', 'p', k, 'solved', 0.1, 8.0, **{'peak memory': float(size)})
                                             for k, size in enumerate(sizes)])
            text, _ = self.page()
            self.assertEqual('peak memory' in text, wanted is not None)
            self.assertEqual(wanted is None or wanted in text, True, sizes)

    def test_planners_have_colours_of_their_own(self):
        names = [f'p{k}' for k in range(36)]
        self.assertEqual(len({colour_of(names, k) for k in range(12)}), 12)
        self.assertEqual(len({(colour_of(names, k), dash_of(names, k)) for k in range(36)}), 36)
        # Results of one planner share its colour.
        names = ['p (old)', 'p (new)', 'q']
        self.assertEqual(colour_of(names, 0), colour_of(names, 1))
        self.assertNotEqual(dash_of(names, 0), dash_of(names, 1))
        self.assertNotEqual(colour_of(names, 0), colour_of(names, 2))

    def test_nothing_solved(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        text, page = self.page()
        self.assertEqual(page.wrong, [])
        self.assertTrue('median is infinite throughout' in text)

    def test_two_comparisons_on_one_page(self):
        made_results.write(self.path('old'), [record('a', name, 0, 'solved', 0.2, 9.0) for name in 'pq'])
        made_results.write(self.path('new'), [record('a', name, 0, 'solved', 0.1, 8.0) for name in 'pr'])
        done = make_report(self.path('old'), self.path('new'), '--output', self.path('page.html'))
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        with open(self.path('page.html'), encoding='utf-8') as stream:
            page = Page(stream.read())
        self.assertEqual([(row[0], row[4]) for row in page.tables[0][1:]], [
            ('p (old)', '200 ms 200 ms – 200 ms'), ('p (new)', '100 ms 100 ms – 100 ms'), ('q', '200 ms 200 ms – 200 ms'),
            ('r', '100 ms 100 ms – 100 ms')])
        self.assertEqual(os.listdir(self.path('old')), ['benchmark.db'])

    def test_paths_are_those_of_the_picture(self):
        made_results.write(self.folder, [record('a', 'p', k, 'solved', 0.1, 8.0 + k) for k in range(2)])
        for extra, wanted in (('', True), ('<script>alert(1)</script>', False), ('<path d="" onclick="alert(1)"/>', False),
                              ('<a href="http://far"/>', False), ('<style>@import "far"</style>', False), ('<', False)):
            made_results.write_picture(self.folder, 'a', {'p': 1}, extra)
            self.assertEqual(read_picture(self.folder, 'a') is not None, wanted, extra)
            text, page = self.page()
            self.assertEqual(page.wrong, [])
            self.assertEqual(text.count('<polyline points="60,10 20,40" stroke="#ea580c"'), 2 if wanted else 0)
            self.assertEqual('9.000 m, 1 change of direction, clearance 10.0 cm: p; 1 of 1 planners solve it' in text, wanted)
            self.assertEqual('9.000 m, 1 change of direction, clearance 10.0 cm; 2/2 runs' in text, wanted)
            self.assertNotIn('alert(1)', text)

    def test_pictures_of_two_comparisons_are_side_by_side(self):
        for name, length in (('old', 9.0), ('new', 8.0)):
            made_results.write(self.path(name), [record('a', 'p', 0, 'solved', 0.2, length)])
            made_results.write_picture(self.path(name), 'a', {'p': 0})
        make_report(self.path('old'), self.path('new'), '--output', self.path('page.html'))
        with open(self.path('page.html'), encoding='utf-8') as stream:
            text = stream.read()
        pictures = text[text.index('<h2>Pictures'):text.index('<h2>Overall')]
        self.assertEqual(re.findall('<span>(.*?) m, .*?: (.*?);', pictures), [('9.000', 'p (old)'), ('8.000', 'p (new)')])

    def test_planners_without_a_path_are_one_line(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'solved', 0.1, 8.0), record('a', 'q', 0, 'none'),
                                         record('a', 'r', 0, 'invalid', 0.1, 8.0)])
        made_results.write_picture(self.folder, 'a', {'p': 0, 'r': 0})
        text, _ = self.page()
        self.assertIn('No valid path: q (no path), r (▲ invalid).', text)
        self.assertEqual(text.count('<figure class="card" data-p'), 1)


class BadInputTest(Folder):
    def refused(self, *arguments):
        done = make_report(*arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count('\n')), (2, '', 1), done)
        self.assertTrue(done.stderr.startswith('make_report: '), done.stderr)
        self.assertFalse(os.path.exists(self.path('report.html')))
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith('.report-')], [])
        return done.stderr

    def write_runs(self, rows, columns='time REAL, solved INTEGER'):
        """A database of somebody's, with one planner and one problem."""
        with sqlite3.connect(self.path('benchmark.db')) as connection:
            connection.executescript(made_results.SCHEMA + f'''
                DROP TABLE runs; CREATE TABLE runs (id INTEGER, experimentid INTEGER, plannerid INTEGER, {columns});
                INSERT INTO experiments (name, timelimit) VALUES ('a', 2.0);
                INSERT INTO plannerConfigs (name) VALUES ('p');''')
            connection.executemany(f'INSERT INTO runs VALUES (7, 1, 1{", ?" * len(rows[0])})', rows)
        connection.close()

    def test_usage(self):
        self.assertIn('RESULTS', self.refused())
        self.assertIn('--colour', self.refused(self.folder, '--colour', 'red'))
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        self.assertIn('requires --output', self.refused(self.folder, self.folder))

    def test_what_is_no_database(self):
        self.assertIn('is not a file', self.refused(self.path('missing')))
        self.assertIn('contains no results', self.refused(self.folder))
        self.assertIn('is not a file', self.refused('/dev/zero'))
        os.mkfifo(self.path('pipe.db'))
        self.assertIn('is not a file', self.refused(self.path('pipe.db')))
        for content in (b'', b'no database', b'SQLite format 3\0' + b'x' * 5000):
            with open(self.path('benchmark.db'), 'wb') as stream:
                stream.write(content)
            self.assertIn('benchmark.db: is not a benchmark database', self.refused(self.folder))
        os.remove(self.path('benchmark.db'))
        with sqlite3.connect(self.path('benchmark.db')) as connection:
            connection.execute('CREATE TABLE runs (id INTEGER)')
        connection.close()
        self.assertIn('is not a benchmark database', self.refused(self.folder))
        made_results.write(self.folder, [])
        self.assertIn('contains no runs', self.refused(self.folder))

    def test_values_that_mean_nothing(self):
        for columns, row, part in (
                ('time REAL, solved INTEGER', (-0.5, 1), 'run 7: time is -0.5'),
                ('map_loading_time REAL', (-1.0,), 'run 7: map_loading_time is -1'),
                ('path_length REAL', (-8.0,), 'run 7: path_length is -8'),
                ('time REAL', ('fast',), 'is not a benchmark database'),
                ('success BOOLEAN, path_length REAL', (1, None), 'run 7: is solved and lacks'),
                ('solved INTEGER, time REAL, solution_length REAL', (1, 9e999, 1.0), 'run 7: is solved and lacks')):
            with self.subTest(part):
                self.write_runs([row], columns)
                self.assertIn(part, self.refused(self.folder))
                os.remove(self.path('benchmark.db'))
        # In a folder whose name would mean something else in an address.
        folder = self.path('run#1?50%41')
        os.mkdir(folder)
        self.write_runs([(-0.5, 1)])
        os.rename(self.path('benchmark.db'), os.path.join(folder, 'benchmark.db'))
        self.assertIn('run 7: ', self.refused(folder))

    def test_inputs_are_not_written_over(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        shutil.copy(self.path('benchmark.db'), self.path('pairs.csv'))
        with open(self.path('classes'), 'w', encoding='utf-8') as stream:
            stream.write('problem,class\na,b\n')
        os.link(self.path('benchmark.db'), self.path('link'))
        database = self.path('benchmark.db')
        before = {name: os.stat(self.path(name)) for name in os.listdir(self.folder)}
        for arguments in ([database, '--output', database], [database, '--output', self.path('link')],
                          [database, '--classes', self.path('classes'), '--output', self.path('classes')],
                          [self.path('pairs.csv')]):
            self.assertIn('is the input', self.refused(*arguments))
        self.assertEqual({name: found.st_ino for name, found in before.items()},
                         {name: os.stat(self.path(name)).st_ino for name in os.listdir(self.folder)})

    def test_packages_are_missing(self):
        made_results.write(self.folder, [record('a', 'p', 0, 'none')])
        # A python3 that finds nothing but its standard library, and is not Debian's with its packages.
        source = ("import sys, runpy; sys.path.insert(0, sys.argv[1]); import program; program.SYSTEM_PYTHON = '/nowhere'; "
                  "program.require_packages('make_report')")
        done = subprocess.run([sys.executable, '-B', '-I', '-S', '-c', source, REPORT], capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stdout), (3, ''))
        self.assertEqual(done.stderr, 'make_report: Python packages are missing; sudo apt-get install python3-numpy python3-scipy '
                         'python3-jinja2 python3-plotly installs them\n')


if __name__ == '__main__':
    unittest.main()
