"""The page that sets our figures beside the paper's: its numbers, its verdicts, and bad input."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import made_results
from made_results import REPORT, record

sys.path.insert(0, REPORT)
from paper_tables import ABLATION, ALGORITHMS, EFFECTS, PERPENDICULAR  # noqa: E402

PAGE = os.path.join(REPORT, 'paper_page')


def drive(loading, planning, acceleration=0.4, steering=10.0):
    return {'map loading time': loading, 'planning time': planning, 'travel time': 40.0,
            'mean acceleration': acceleration, 'mean steering angle': steering, 'nodes expanded': 52,
            'collisions while driving': 0}


class PaperPageTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.output = os.path.join(self.folder, 'page.md')
        for name, problem in (('perpendicular', 'perpendicular_approach'), ('parallel', 'parallel_approach'),
                              ('unreachable', 'unreachable')):
            runs = []
            for k in range(7):
                for algorithm in ALGORITHMS:
                    # The middle of 0.001 * (7 .. 13) is 0.010.
                    fast = algorithm == 'Basic_A*'
                    runs.append(record(problem, algorithm, k, 'solved', 0.01, 25.0, None,
                                       **drive(0.02 if fast else 0.001, 0.001 * (7 + k) * (0.1 if fast else 1.0))))
                for car in (problem + '_reeds_shepp_rectangle', name + '_reeds_shepp_rectangle'):
                    runs.append(record(car, 'Car', k, 'solved', 0.01, 30.0, None, **drive(0.001, 0.002)))
            made_results.write(os.path.join(self.folder, name), runs)

    def run_page(self, folder=None):
        return subprocess.run([sys.executable, '-B', PAGE, folder or self.folder, '--output', self.output],
                              capture_output=True, text=True, check=False)

    def rows(self):
        with open(self.output, encoding='utf-8') as stream:
            return [[cell.strip() for cell in line.strip('|\n').split('|')] for line in stream if line.startswith('|')]

    def test_figures_stand_beside_the_papers(self):
        done = self.run_page()
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        rows = [row for row in self.rows() if row[0] == 'Improved A&#42;']
        self.assertEqual(rows[0][1:7], ['**1.00** (1.810)', '**10.0** (411.0)', '**25.0** (72.12)', '**40.0** (49.60)',
                                        '**0.400** (0.3060)', '**10.0** (10.79)'])
        self.assertEqual(rows[0][7:], ['52', '0'])
        self.assertEqual(rows[1][2], '**10.0** (1214)')
        whole = [row for row in self.rows() if row[0] == 'Car, into the slot']
        self.assertEqual(len(whole), 2)

    def test_verdicts(self):
        self.run_page()
        verdicts = {row[0]: row[1:4] for row in self.rows() if len(row) == 5 and row[3] in
                    ('agrees', 'differs', 'opposite')}
        self.assertEqual(len(verdicts), len(EFFECTS))
        # Loading 20 ms against 1 ms, planning 1 ms against 10 ms; the same acceleration where the paper's is six times.
        self.assertEqual(verdicts['map loading, Basic A\\* / Improved A\\*'], ['54285', '**20.0**', 'agrees'])
        self.assertEqual(verdicts['planning, Basic A\\* / Improved A\\*'][1:], ['**0.100**', 'agrees'])
        self.assertEqual(verdicts['loading and planning, Basic A\\* / Improved A\\*'][1:], ['**1.91**', 'agrees'])
        self.assertEqual(verdicts['mean acceleration, Basic A\\* / Improved A\\*'][1:], ['**1.00**', 'differs'])

    def test_tables_are_the_papers(self):
        self.assertEqual(ABLATION['Experiment_3'], dict(loading=1.95, planning=609.01, acceleration=0.141, steering=12.89))
        self.assertEqual(PERPENDICULAR['Basic_A*']['travel'], 20.4)

    def test_bad_input(self):
        for broken in ('missing', 'parallel'):
            if broken == 'parallel':
                made_results.write(os.path.join(self.folder, 'parallel'), [record('parallel_approach', 'Car', 0, 'none')])
            done = self.run_page(os.path.join(self.folder, 'missing') if broken == 'missing' else None)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
            self.assertTrue(done.stderr.startswith('paper_page: '))
            self.assertFalse(os.path.exists(self.output))


if __name__ == '__main__':
    unittest.main()
