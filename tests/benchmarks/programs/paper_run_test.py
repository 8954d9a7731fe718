"""paper_run as a whole: what it writes, that it repeats itself, and bad input."""
import filecmp
import json
import os
import subprocess
import sys

import programs
from programs import ProgramTest, SOURCE

PAPER_RUN = os.environ['PARKING_PAPER_RUN']
PAPER = os.path.join(SOURCE, 'benchmarks', 'paper')
TASK = os.path.join(PAPER, 'maps', 'perpendicular.yaml')
TIMES = ('map_loading_time_ms', 'planning_time_ms')


class PaperRunTest(ProgramTest):
    def runs(self, *arguments):
        done = self.run_program(PAPER_RUN, *arguments, '--json', 'runs.json')
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, '', ''))
        result = json.loads(self.read('runs.json'))
        self.assertEqual(result['format'], 1)
        return result['runs']

    def test_all_algorithms_and_equal_runs(self):
        first, second = (self.runs(TASK, '--no-drive') for _ in range(2))
        self.assertEqual(len(first), 8)
        for one, other in zip(first, second):
            self.assertEqual({key: value for key, value in one.items() if key not in TIMES},
                             {key: value for key, value in other.items() if key not in TIMES})
            self.assertEqual(one['status'], 'exact')
            self.assertGreaterEqual(one['length_m'], 20.0)
            for key in TIMES:
                self.assertGreaterEqual(one[key], 0.0)
        by_name = {run['algorithm']: run for run in first}
        self.assertEqual(by_name['experiment_2']['length_m'], by_name['paper_improved_astar']['length_m'])
        self.assertGreater(by_name['experiment_3']['open_list_comparisons'], by_name['paper_improved_astar']['open_list_comparisons'])

    def test_a_drive_and_its_lines(self):
        run, = self.runs(TASK, '--algorithm', 'paper_improved_astar', '--lines')
        drive = run['drive']
        self.assertGreater(len(drive['states']), 100)
        self.assertEqual(len(run['curve'][0]), 2)
        self.assertGreater(drive['mean_abs_acceleration'], 0.0)

    def test_the_paper_s_planner_has_an_alias(self):
        run, = self.runs(TASK, '--algorithm', 'improved_astar', '--no-drive')
        self.assertEqual(run['algorithm'], 'paper_improved_astar')

    def test_the_map_is_not_written_over(self):
        self.write('map.yaml', 'image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
        self.write('map.pgm', b'P5\n100 100\n255\n' + b'\xfe' * 10000)
        self.write('task.yaml', 'map: map.yaml\nstart: [2, 2, 0]\ngoal: [5, 2, 0]\n')
        for name in ('task.yaml', 'map.yaml', 'map.pgm'):
            self.assert_refused(self.run_program(PAPER_RUN, 'task.yaml', '--json', name), name, 'is the input')

    def test_voxels_become_a_map(self):
        for folder in ('maps', 'again'):
            done = subprocess.run([sys.executable, '-B', os.path.join(PAPER, 'make_maps'), '--count', '1', '--output',
                                   self.path(folder)], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name, status in (('perpendicular', 'exact'), ('parallel', 'exact'), ('unreachable', 'approximate')):
            self.assertTrue(filecmp.cmp(self.path(f'maps/{name}_00.npy'), self.path(f'again/{name}_00.npy'), shallow=False))
            run, = self.runs(self.path(f'maps/{name}_00.yaml'), '--algorithm', 'paper_improved_astar', '--no-drive')
            self.assertEqual(run['status'], status, name)

    def test_bad_input_is_one_line_and_status_2(self):
        no_frame = self.path('frame.npy')
        with open(no_frame, 'wb') as stream:
            stream.write(b'no frame')
        with open(self.path('frame.yaml'), 'w', encoding='utf-8') as stream:
            stream.write('vehicle: vw_golf8\nstart: [0, 0, 0]\nmap: frame.npy\n'
                         'slot:\n  kind: perpendicular\n  pose: [5, 5, 0]\n  length: 5\n  width: 2.5\n')
        for arguments, part in (
                ([], 'no scenario'), (['/nowhere.yaml'], '/nowhere.yaml'),
                ([self.path('frame.yaml')], 'is not a .npy file'), ([TASK, '--algorithm', 'improved'], 'improved'),
                ([TASK, '--disc', 'front'], 'front'), ([TASK, '--radius', '-1'], 'radius'),
                ([TASK, '--lookup', 'no'], 'lookup'), ([TASK, '--spline', 'nurbs'], 'spline'),
                ([TASK, '--set', 'heuristic=manhatan'], 'manhattan'), ([TASK, '--set', 'motion_model=car'], 'car'),
                ([TASK, '--sampling', '0'], 'sampling'), ([TASK, '--json', '/nowhere/x.json'], '/nowhere'),
                ([TASK, '--colour'], 'colour')):
            done = self.run_program(PAPER_RUN, *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertTrue(done.stderr.startswith('paper_run: '), done.stderr)
            self.assertIn(part, done.stderr)

    def test_help(self):
        done = self.run_program(PAPER_RUN, '--help')
        self.assertEqual(done.returncode, 0)
        self.assertIn('usage: paper_run', done.stdout)


if __name__ == '__main__':
    programs.main()
