"""Where make_report and results_page write, that they look before they do, and what results_page says and draws."""
import math
import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import made_results
from made_results import REPORT, record

TABLES = {'statistics.json', 'standings.csv', 'pairs.csv'}


class OutputTest(made_results.FolderTest):
    def run_program(self, program, *arguments):
        return subprocess.run([sys.executable, '-B', os.path.join(REPORT, program), self.path('runs'), *arguments],
                              capture_output=True, text=True, check=False)

    def refused(self, program, *arguments):
        """The one line; nothing is written then."""
        before = self.names()
        done = self.run_program(program, *arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count('\n')), (2, '', 1), done.stderr)
        self.assertEqual(self.names(), before)
        return done.stderr

    def names(self):
        return sorted(os.path.join(folder, name) for folder, folders, names in os.walk(self.folder)
                      for name in folders + names)


class MakeReport(OutputTest):
    def setUp(self):
        super().setUp()
        made_results.write(self.path('runs'), [record('a', 'p', 0, 'none')])
        os.mkdir(self.path('other'))

    def test_nothing_is_written_beside_a_page_that_cannot_be(self):
        for name, part in ((self.path('other'), 'is a folder'), (self.path('other') + '/', 'is a folder'),
                           (self.path('nowhere/page.html'), 'there is no folder'), ('/proc/page.html', 'cannot be written'),
                           ('/dev/full', 'a device'), ('', 'empty')):
            with self.subTest(name):
                self.assertIn(f'make_report: {name}' if name else 'the name', self.refused('make_report', '--output', name))
                self.assertIn(part, self.refused('make_report', '--output', name))

    def test_nothing_is_written_when_a_table_cannot_be(self):
        os.mkdir(self.path('other/pairs.csv'))
        self.assertIn('other/pairs.csv: cannot be written: is a folder',
                      self.refused('make_report', '--output', self.path('other/page.html')))

    def test_a_page_takes_the_name_of_no_table(self):
        for name in TABLES:
            self.assertIn(name, self.refused('make_report', '--output', self.path('other/' + name)))

    def test_what_is_written(self):
        done = self.run_program('make_report', '--output', self.path('other/page.html'))
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(set(os.listdir(self.path('other'))), TABLES | {'page.html'})


class ResultsPage(OutputTest):
    def setUp(self):
        super().setUp()
        made_results.write(self.path('runs'), [record('a', name, 0, 'solved', 0.1, 9.0) for name in ('grid8', 'grid16')])

    def rows(self, *arguments):
        """The cells of all lines of the tables."""
        done = self.run_program('results_page', *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        return [[cell.strip() for cell in line.split('|')[1:-1]] for line in done.stdout.splitlines()]

    def test_a_planner_that_was_not_run(self):
        for name, part in (('grid9', "did you mean 'grid8'? Known: grid8, grid16"), ('foo', 'known: grid8, grid16'),
                           ('', 'known: grid8')):
            message = self.refused('results_page', '--planner', name, '--svg', self.path('curve.svg'))
            self.assertIn(f"unknown planner '{name}'", message)
            self.assertIn(part, message)

    def test_the_usual_planner_is_not_missed(self):
        self.assertEqual(len(self.rows()), 4)  # one table
        self.assertIn(['a', '1 of 1', '100 ms', '1.00'], [row[:4] for row in self.rows('--planner', 'grid8')])

    def test_tables_and_curve_for_documents(self):
        runs = made_results.random_records(3, 4, 5, seed=3)
        made_results.write(self.path('runs'), runs)
        with open(self.path('runs/classes.csv'), 'w', encoding='utf-8') as stream:
            stream.write('problem,class\nproblem_0,odd\nproblem_1,even\nproblem_2,even\n')
        rows = {row[0]: row for row in self.rows('--svg', self.path('curve.svg'), '--planner', 'planner_1') if row}
        for planner in range(4):
            own = [each for each in runs if each['planner'] == f'planner_{planner}']
            good = sum(each['figures']['success'] for each in own)
            self.assertEqual(rows[f'planner_{planner}'][1], f'{good} of {len(own)}')
            odd = [each['figures']['success'] for each in own if each['experiment'] == 'problem_0']
            self.assertTrue(rows['odd'][1 + planner].startswith(f'{sum(odd)} of {len(odd)}, '))
        self.assertEqual(sum(name.startswith('problem_') for name in rows), 3)
        with open(self.path('curve.svg'), encoding='utf-8') as stream:
            curve = stream.read()
        self.assertEqual(xml.etree.ElementTree.fromstring(curve).tag, '{http://www.w3.org/2000/svg}svg')
        for planner in range(4):
            self.assertIn(f'planner_{planner} ', curve)

    def test_what_more_time_brings(self):
        def folder(name, lengths):
            made_results.write(self.path(name), [
                record(problem, planner, k, 'solved' if math.isfinite(length) else 'none', 0.01, length)
                for (problem, planner), runs in lengths.items() for k, length in enumerate(runs)])
            return self.path(name)
        inf = math.inf
        folder('runs', {('a', 'p'): [12.0, 12.0, 11.0], ('a', 'q'): [20.0], ('b', 'p'): [inf, 30.0, inf], ('b', 'q'): [inf],
                        ('c', 'p'): [inf], ('c', 'q'): [inf]})
        long = folder('long', {('a', 'p'): [10.0], ('a', 'q'): [11.0], ('b', 'p'): [24.0], ('b', 'q'): [20.0],
                               ('c', 'p'): [inf], ('c', 'q'): [inf]})
        # Shortest known: 10 and 20; nobody solves c. Medians over a and b: of 1.2 and infinity, 1 and 1.2, ...
        self.assertEqual(self.rows(long, '--limits')[2:], [['p', '4 of 7, ∞', '2 of 3, 1.100'], ['q', '1 of 3, ∞', '2 of 3, 1.050']])

    def test_bad_usage_and_input(self):
        os.link(self.path('runs/benchmark.db'), self.path('link'))
        os.mkdir(self.path('empty'))
        for arguments, part in (([self.path('runs')], '--limits'), (['--limits', '--planner', 'grid8'], '--limits'),
                                (['--svg', self.path('link')], 'is the input'), (['--svg', ''], 'empty'),
                                ([self.path('empty'), '--limits'], 'holds no results'), (['--colour'], '--colour')):
            self.assertIn(part, self.refused('results_page', *arguments))


if __name__ == '__main__':
    unittest.main()
