"""One command repeats the paper's experiments: its quick form leaves a whole page, and resumes.

usage: reproduce_paper_test.py FOLDER_OF_PROGRAMS REPRODUCE_PAPER
"""
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAMS, SCRIPT = sys.argv.pop(1), sys.argv.pop(1)


class ReproducePaperTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_script(self, *arguments, programs=PROGRAMS):
        return subprocess.run([sys.executable, '-B', SCRIPT, '--quick', '--programs', programs, '--results', self.folder,
                               *arguments], capture_output=True, text=True, check=False)

    def test_quick_form_writes_the_page_and_resumes(self):
        results = os.path.join(self.folder, 'quick_2')
        measured = [os.path.join(results, name) for name in ('perpendicular_printed.json', 'maps/parallel_01.npy',
                                                             'pipeline/parallel_01.json')]
        pages, times = [], []
        for _ in range(2):
            done = self.run_script()
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(os.path.join(results, 'paper.md'), encoding='utf-8') as stream:
                pages.append(stream.read())
            times.append([os.path.getmtime(file) for file in measured])
        self.assertEqual(pages[0], pages[1])
        self.assertEqual(times[0], times[1])
        for part in ('2 maps of each scenario', '| Experiment 6 / Experiment 3 |', '| in 2 of 2 maps |', '| 2 of 2 | 2 | 0 |',
                     '| Manhattan distance |'):
            self.assertIn(part, pages[0].replace('perpendicular: ', ''))
        with open(os.path.join(results, 'images', 'paper.svg'), encoding='utf-8') as stream:
            self.assertIn('perpendicular, improved', stream.read())

    def test_says_what_is_wrong(self):
        for arguments, programs, part in ((['--maps', '0'], PROGRAMS, 'at least 1'), ([], '/nowhere', 'is not a program')):
            done = self.run_script(*arguments, programs=programs)
            self.assertEqual(done.returncode, 2)
            self.assertIn(part, done.stderr)


if __name__ == '__main__':
    unittest.main()
