"""Planners written in Python: paths, questions to the checkers, and planners that fail or hang without loss of other runs."""

import json
import os
import time

from programs import SOURCE, ProgramTest, bundled, main

VIA = os.path.join(SOURCE, 'examples', 'plugin', 'via_planner.py')
OPEN = 'start: [0, 0, 0]\ngoal: [9, 2, 0.3]\npolygons:\n  - [[-8, -8], [-6, -8], [-6, -7]]\n'
STRAIGHT = 'def plan(problem):\n    return [problem.start, problem.goals[0]]\n'


class PythonPlanner(ProgramTest):
    def outcome(self, content, *options, scenario='open.yaml', status=0, limit=20, planner='mine'):
        self.write('open.yaml', OPEN)
        self.write('mine.py', content)
        return self.planned(scenario, '--plugin', 'mine.py', '--planner', planner, '--time-limit', limit, *options,
                            status=status)

    def test_a_path(self):
        result = self.outcome(STRAIGHT)
        self.assertEqual((result['status'], result['recheck']['valid']), ('exact', True))
        self.assertEqual((result['path'][-1]['x'], result['path'][-1]['y']), (9.0, 2.0))
        # A path through walls is not believed, and one that ends elsewhere is no solution.
        result = self.outcome(STRAIGHT, scenario=bundled('underground_garage'), status=4)
        self.assertEqual((result['status'], result['recheck']['fault']), ('invalid_path', 'collision'))
        result = self.outcome('def plan(problem):\n    return [problem.start, (7, 2, 0)]\n', status=3)
        self.assertEqual(result['status'], 'approximate')
        self.assertEqual(self.outcome('def plan(problem):\n    pass\n', status=4)['status'], 'infeasible')

    def test_name_summary_and_parameters(self):
        text = '"""Drives straight.\n\nMore."""\nNAME = "straight"\n' \
               'PARAMETERS = {"bold": True, "tries": 3, "sign": -1, "step": 0.5, "mode": "a"}\n\n\n' \
               'def plan(problem):\n    raise ValueError(sorted(problem.parameters.items()))\n'
        result = self.outcome(text, '--set', 'step=2', '--set', 'bold=no', '--set', 'mode=b', planner='straight', status=4)
        self.assertIn("[('bold', False), ('mode', 'b'), ('sign', -1), ('step', 2.0), ('tries', 3)]", result['reason'])
        self.assertIn('Drives straight.', self.plan('--help', '--plugin', 'mine.py').stdout)
        for setting, part in (('stop=1', "did you mean 'step'"), ('tries=-1', "cannot be '-1'"),
                              ('step=wide', "cannot be 'wide'")):
            self.refused_plan('open.yaml', '--plugin', 'mine.py', '--planner', 'straight', '--set', setting, parts=[part])

    def test_the_problem(self):
        text = 'import json\n\n\ndef plan(problem):\n    members = dict(vars(problem))\n    del members["_channel"]\n' \
               '    with open("problem.json", "w") as stream:\n        json.dump(members, stream)\n'
        self.outcome(text, '--seed', 5, status=4, limit=7)
        problem = json.loads(self.read('problem.json'))
        self.assertEqual((problem['start'], problem['goals']), ([0, 0, 0], [[9, 2, 0.3]]))
        self.assertEqual(problem['obstacles'], [[[-8, -8], [-6, -8], [-6, -7]]])
        self.assertEqual((problem['time_limit'], problem['parameters']), (7, {}))
        car = problem['vehicle']
        self.assertEqual(max(x for x, _ in car['outline']), car['wheelbase'] + car['front_overhang'])
        for k in range(2):
            self.assertLess(problem['bounds'][0][k], problem['bounds'][1][k])
        self.outcome(text, '--seed', 6, status=4)
        self.assertNotEqual(json.loads(self.read('problem.json'))['seed'], problem['seed'])
        # A map arrives as rectangles.
        self.outcome(text, scenario=bundled('underground_garage'), status=4)
        self.assertGreater(len(json.loads(self.read('problem.json'))['obstacles']), 10)

    def test_questions(self):
        text = '''def plan(problem):
    poses = [(0, 0, 0), (-7, -7.5, 0), (1e5, 0, 0)]
    motions = [(problem.start, problem.goals[0]), (problem.start, (-14, -15.5, 0)), ((-7, -7.5, 0), problem.start)]
    raise ValueError([problem.is_free(poses), problem.is_motion_free(motions),
                      problem.distance([((0, 0, 0), (3, 0, 0))])])
'''
        self.assertIn('[[True, False, False], [True, False, False], [3.0]]', self.outcome(text, status=4)['reason'])
        for call in ('is_free([(1, 2)])', 'is_motion_free([(0, 1)])', 'distance([((0, 0, 0), (float("nan"), 0, 0))])'):
            self.assertIn('pose', self.outcome(f'def plan(problem):\n    problem.{call}\n', status=4)['reason'])

    def test_the_example(self):
        results = [self.planned(bundled('perpendicular'), '--plugin', VIA, '--planner', 'via_python', '--time-limit', 60)
                   for _ in range(2)]
        self.assertEqual((results[0]['status'], results[0]['recheck']['valid']), ('exact', True))
        self.assertEqual(results[0]['path'], results[1]['path'])  # by the seed

    def test_paths_that_improve(self):
        text = '''import time


def plan(problem):
    for side in (4.0, 1.0):
        yield [problem.start, (4.5, side, 0.0), problem.goals[0]]
    time.sleep(1000)
'''
        begin = time.monotonic()
        result = self.outcome(text, limit=1)
        self.assertLess(time.monotonic() - begin, 30.0)
        self.assertEqual(result['status'], 'exact')
        self.assertLess(result['length_m'], 10.0)
        self.write('set.cfg', '[problem]\nscenario = open.yaml\n[benchmark]\ntime_limit = 1\nrun_count = 1\n[planner]\nmine=\n')
        self.benchmark('set.cfg', '--output', 'out', '--plugin', 'mine.py', '--quiet')
        run = self.records('out/benchmark.db', clock=True)[0]
        self.assertEqual(len(run['progress']), 2)
        self.assertLess(run['figures']['first solution time'], 0.9)

    def test_floods_end_in_time(self):
        for body, found in (('while True:\n        yield [problem.start, problem.goals[0]]', 'exact'),
                            ('while True:\n        problem.is_free([problem.start] * 1000000)', 'timeout')):
            with self.subTest(body):
                begin = time.monotonic()
                result = self.outcome('def plan(problem):\n    ' + body + '\n', limit=2,
                                      status={'exact': 0, 'timeout': 4}[found])
                self.assertEqual(result['status'], found)
                self.assertLess(time.monotonic() - begin, 60.0)

    def test_hanging_planners_are_killed_with_their_children(self):
        text = '''import subprocess
import sys


def plan(problem):
    child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(1000)'])
    with open('child', 'w') as stream:
        stream.write(str(child.pid))
    while True:
        pass
'''
        begin = time.monotonic()
        self.assertEqual(self.outcome(text, status=4, limit=1)['status'], 'timeout')
        self.assertLess(time.monotonic() - begin, 30.0)
        process = self.read('child')
        for _ in range(100):  # the system takes a moment
            try:
                with open(f'/proc/{process}/stat') as stream:
                    if stream.read().rsplit(')', 1)[1].split()[0] == 'Z':
                        return
            except FileNotFoundError:
                return
            time.sleep(0.1)
        self.fail('the child of the planner still runs')

    def test_in_a_comparison_each_is_an_outcome_of_its_runs(self):
        self.write('open.yaml', OPEN)
        begin, failing = 'def plan(problem):\n    ', {
            'raises': ('raise KeyError("a\\nb")', "KeyError: 'a\\nb' (line 3 of raises.py)"),
            'exits': ('import os; os._exit(3)', 'status 3'),
            'leaves': ('import sys; sys.exit(5)', 'status 5'),
            'dies': ('import os; os.kill(os.getpid(), 11)', 'signal 11'),
            'numbers': ('return 1', 'TypeError'),
            'words': ('return ["far away"]', "pose 0 is not x, y, yaw: 'far away'"),
            'elsewhere': ('return [(1e300, 0, 0)]', 'out of range'),
            'writes': ('import os; os.write(3, b"hello\\n")', 'channel of its answer')}
        good = {'good': STRAIGHT, 'prints': f'print("loaded")\n{begin}print("ready")\n    input = open(0).read()\n'
                                            f'    return [problem.start, problem.goals[0]] + list(input)\n'}
        hanging = {'hangs': begin + 'import time; time.sleep(1000)\n'}
        contents = {**good, **hanging, **{name: f'"""Fails."""\n{begin}{body}\n' for name, (body, _) in failing.items()}}
        plugins = []
        for name, content in contents.items():
            plugins += ['--plugin', self.write(name + '.py', content)]
        self.write('set.cfg', '[problem]\nscenario = open.yaml\n[benchmark]\ntime_limit = 2\nrun_count = 1\n[planner]\n'
                   'reeds_shepp=\n' + ''.join(f'{name}=\n' for name in contents))
        done = self.benchmark('set.cfg', '--output', 'out', *plugins, '--quiet')
        found = {run['planner']: run for run in self.records('out/benchmark.db')}
        self.assertEqual(len(found), 1 + len(contents))
        for name, run in found.items():
            self.assertEqual(run['figures']['success'], name in ('reeds_shepp', 'good', 'prints'), run)
        for name, (_, words) in failing.items():
            self.assertEqual(found[name]['figures']['outcome'], 6)  # an exception
            self.assertIn(words, found[name]['reason'])
            self.assertIn(words, done.stdout)
        self.assertEqual(found['hangs']['figures']['outcome'], 2)  # the time was up

    def test_memory(self):
        if os.environ.get('PARKING_SANITIZER'):
            self.skipTest('sanitizers need more memory than the limit')
        self.write('open.yaml', OPEN)
        self.write('eats.py', 'def plan(problem):\n    return [0] * 10 ** 10\n')
        self.write('set.cfg', '[problem]\nscenario = open.yaml\n[benchmark]\nmem_limit = 500\nrun_count = 1\n[planner]\neats=\n')
        self.benchmark('set.cfg', '--output', 'out', '--plugin', 'eats.py', '--quiet')
        self.assertEqual(self.records('out/benchmark.db')[0]['figures']['outcome'], 9)

    def test_files_that_are_no_planners(self):
        self.write('open.yaml', OPEN)
        for content, part in (('x = 1\n', 'defines no function plan'), ('def plan(:\n', 'SyntaxError: invalid syntax (line 1 of'),
                              ('import no_such_module\n', "No module named 'no_such_module' (line 1 of"),
                              ('PARAMETERS = {"a": []}\n' + STRAIGHT, "'a' must be"),
                              ('NAME = "a b"\n' + STRAIGHT, 'must consist of'), ('NAME = "RRT"\n' + STRAIGHT, 'already'),
                              ('import sys\nsys.exit(4)\n', 'status 4')):
            self.write('mine.py', content)
            self.refused_plan('open.yaml', '--plugin', 'mine.py', parts=['plug-in mine.py: ', part])
        self.refused_plan('open.yaml', '--plugin', 'missing.py', parts=['missing.py', 'no such file'])
        self.write('mine.py', STRAIGHT)
        head, planners = '[problem]\nscenario = open.yaml\n', '[planner]\nmine=\n'
        for lines, part in (('footprint = circle\nspace = se2\n', 'requires footprint = rectangle'),
                            ('[benchmark]\nclock = processor\n', 'use clock = wall')):
            self.write('set.cfg', head + lines + planners)
            self.refused_benchmark('set.cfg', '--output', 'out', '--plugin', 'mine.py', parts=['set.cfg:', part])

    def test_without_python(self):
        self.write('open.yaml', OPEN)
        self.write('mine.py', STRAIGHT)
        self.refused_plan('open.yaml', '--plugin', 'mine.py', env={**os.environ, 'PATH': self.folder},
                          parts=['plug-in mine.py: ', 'python3'])


if __name__ == '__main__':
    main()
