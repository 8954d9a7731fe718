"""Where make_report writes, and that it looks before it does."""
import os
import subprocess
import sys
import unittest

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


if __name__ == '__main__':
    unittest.main()
