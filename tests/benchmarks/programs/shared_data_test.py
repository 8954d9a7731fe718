"""parking_plan on the TPCAP cases and map problems that may stand beside the project, judged by a checker that is not
the project's own. Skipped where there are none."""

import concurrent.futures
import glob
import json
import os
import subprocess
import sys
import unittest

from programs import SHARED_DATA, VERIFY, ProgramTest, main

POSES = os.path.join(SHARED_DATA, 'poses.json')
TIME_LIMIT = 5  # seconds for each problem
VERIFY_TRAJECTORY = os.path.join(os.path.dirname(VERIFY), 'verify_trajectory.py')
ENOUGH_CASES = 0.9  # of the cases must be solved,
ENOUGH_MAP_PROBLEMS = 38.0 / 42.0  # of the problems on maps


def interpreter_with_numpy():
    """The checker reads maps with numpy, which the project itself does not need."""
    for python in (sys.executable, '/usr/bin/python3'):
        if subprocess.run([python, '-c', 'import numpy'], capture_output=True, check=False).returncode == 0:
            return python
    return None


def cases():
    return sorted(glob.glob(os.path.join(SHARED_DATA, 'tpcap', 'Case*.csv')))


@unittest.skipUnless(os.path.exists(VERIFY), 'no checker at ' + VERIFY)
class SharedData(ProgramTest):
    python = sys.executable

    def outcome(self, name, scenario, check):
        """Plans, and has the result checked. Returns the status, and what was found wrong."""
        result = self.path(name + '.json')
        planned = self.run_program(os.environ['PARKING_PLAN'], scenario, '--time-limit', TIME_LIMIT, '--json', result)
        if planned.returncode == 2:
            return 'refused', planned.stderr
        with open(result) as stream:
            status = json.load(stream)['status']
        if planned.returncode != 0:
            return status, ''
        checked = subprocess.run([self.python, '-B', VERIFY, check[0], result] + check[1:], capture_output=True,
                                 text=True, timeout=300, check=False)
        return status, '' if checked.returncode == 0 else checked.stdout + checked.stderr

    def solve_all(self, problems, share):
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            jobs = {name: pool.submit(self.outcome, name, scenario, check) for name, scenario, check in problems}
        outcomes = {name: job.result() for name, job in jobs.items()}
        wrong = '\n'.join('%s: %s' % (name, message) for name, (_, message) in outcomes.items() if message)
        self.assertFalse(wrong, 'every path must hold:\n' + wrong)
        unsolved = {name: status for name, (status, _) in outcomes.items() if status != 'exact'}
        print('solved exactly: %d of %d; not: %s' % (len(problems) - len(unsolved), len(problems), unsolved or 'none'))
        self.assertLessEqual(len(unsolved), (1.0 - share) * len(problems) + 1e-9, unsolved)

    @unittest.skipUnless(cases(), 'no TPCAP cases in ' + SHARED_DATA)
    def test_tpcap(self):
        self.solve_all([(os.path.basename(case)[:-len('.csv')], case, [case]) for case in cases()], ENOUGH_CASES)

    @unittest.skipUnless(cases() and os.path.exists(VERIFY_TRAJECTORY), 'no cases, or no checker of trajectories')
    def test_costs_of_trajectories(self):
        case = cases()[0]
        result = self.planned(case, '--trajectory', '--time-limit', TIME_LIMIT)
        name = self.write('result.json', json.dumps(result))
        checked = subprocess.run([self.python, '-B', VERIFY_TRAJECTORY, case, name], capture_output=True, text=True,
                                 timeout=300, check=False)
        found = json.loads(checked.stdout)
        self.assertEqual((found['errors'], found['colliding']), ([], 0))
        ours = result['trajectory_optimization']['tpcap_cost']
        self.assertEqual(ours['gear_changes'], found['gear_changes'])
        for member, other in (('J', 'J'), ('time_s', 'duration'), ('control_effort', 'control_effort'),
                              ('steering_integral', 'steering_integral')):
            self.assertAlmostEqual(ours[member] / found[other], 1.0, delta=0.005, msg=member)

    @unittest.skipUnless(os.path.exists(POSES), 'no problems on maps: ' + POSES)
    def test_maps(self):
        self.python = interpreter_with_numpy()
        if self.python is None:
            self.skipTest('the checker needs numpy for maps, and no python3 here has it')
        with open(POSES) as stream:
            poses = json.load(stream)
        problems = []
        for each in poses:
            map_file = os.path.join(SHARED_DATA, each['map'])
            scenario = self.write(each['id'] + '.yaml', 'map: %s\nstart: %s\ngoal: %s\n' %
                                  (json.dumps(map_file), each['start'], each['goal']))
            check = [map_file, '--start'] + [str(value) for value in each['start']]
            check += ['--goal'] + [str(value) for value in each['goal']]
            problems.append((each['id'], scenario, check))
        self.solve_all(problems, ENOUGH_MAP_PROBLEMS)


if __name__ == '__main__':
    main()
