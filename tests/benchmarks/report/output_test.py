"""Where make_report and results_page write, that they look before they do, and what results_page says and draws."""
import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import made_results
from made_results import REPORT, record

TABLES = {'statistics.json', 'standings.csv', 'pairs.csv'}
LETTER = 6.9  # pixels, on average, of DejaVu Sans at the size of the labels


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

    def test_a_planner_that_was_not_run(self):
        for name, part in (('grid9', "did you mean 'grid8'? Known: grid16, grid8"), ('foo', 'known: grid16, grid8'),
                           ('', 'known: grid16')):
            message = self.refused('results_page', '--planner', name, '--svg', self.path('curve.svg'))
            self.assertIn(f"unknown planner '{name}'", message)
            self.assertIn(part, message)

    def test_the_usual_planner_is_not_missed(self):
        done = self.run_program('results_page')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(len(done.stdout.splitlines()), 4)  # one table
        self.assertIn('| a | 1 of 1', self.run_program('results_page', '--planner', 'grid8').stdout)

    def test_the_longest_label_fits(self):
        for name in ('p', 'improved_astar_anytime', 'improved_astar_with_all_that_can_be_switched_on'):
            made_results.write(self.path('runs'), [record('a', name, 0, 'solved', 0.1, 9.0)])
            self.run_program('results_page', '--svg', self.path('curve.svg'))
            picture = xml.etree.ElementTree.parse(self.path('curve.svg')).getroot()
            width = float(picture.get('viewBox').split()[2])
            label = next(text for text in picture.findall('.//{*}text') if text.text == f'{name} 100 %')
            self.assertLessEqual(float(label.get('x')) + LETTER * len(label.text), width, name)
            self.assertGreaterEqual(width, 720.0)


if __name__ == '__main__':
    unittest.main()
