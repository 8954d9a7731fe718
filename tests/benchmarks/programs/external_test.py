"""The example that wraps a program as a planner: paths, invalid answers, and programs that fail or hang without loss of other runs."""

import os
import time

from programs import SOURCE, ProgramTest, bundled, main

PLUGIN = os.environ['PARKING_EXTERNAL']
STRAIGHT = os.path.join(SOURCE, 'examples', 'plugin', 'straight_planner.py')
OPEN = 'start: [0, 0, 0]\ngoal: [9, 2, 0.3]\npolygons:\n  - [[-8, -8], [-6, -8], [-6, -7]]\n'


class External(ProgramTest):
    def outcome(self, command, scenario='open.yaml', status=0, limit=20):
        self.write('open.yaml', OPEN)
        return self.planned(scenario, '--plugin', PLUGIN, '--planner', 'external', '--set', 'command=' + command,
                            '--time-limit', limit, status=status)

    def test_a_program_in_another_language(self):
        result = self.outcome('python3 ' + STRAIGHT)
        self.assertEqual((result['status'], result['recheck']['valid']), ('exact', True))
        self.assertEqual((result['path'][-1]['x'], result['path'][-1]['y']), (9.0, 2.0))

    def test_what_is_asked_is_a_scenario(self):
        self.outcome(f'tee {self.path("asked.yaml")} | python3 {STRAIGHT}')
        self.assertEqual(self.planned('asked.yaml')['status'], 'exact')
        # A map goes out as rectangles, and a path through walls is not believed.
        result = self.outcome('python3 ' + STRAIGHT, bundled('underground_garage'), status=4)
        self.assertEqual(result['status'], 'invalid_path')
        self.assertEqual(result['recheck']['fault'], 'collision')

    def test_the_page_says_how_its_example_ends(self):
        def page(name):
            with open(os.path.join(SOURCE, 'docs', name), encoding='utf-8') as stream:
                return stream.read()
        guide = page('benchmarking.md')
        example = guide[guide.index('--planner external'):]
        self.assertEqual(self.outcome('python3 ' + STRAIGHT, bundled('parallel'), status=4)['status'], 'invalid_path')
        self.assertIn('`NOT VALID` and exit status 4', example[:1000])
        row = next(line for line in page('benchmark-reference.md').splitlines() if line.startswith('| `status` |'))
        for command in ('true', 'exit 3', 'echo 1 2'):
            self.assertIn('`%s`' % self.outcome(command, status=4)['status'], row)

    def test_programs_that_find_nothing_or_hang(self):
        self.assertEqual(self.outcome('true', status=4)['status'], 'infeasible')
        begin = time.monotonic()
        self.assertEqual(self.outcome('sleep 1000', status=4, limit=0.5)['status'], 'timeout')
        self.assertEqual(self.outcome('yes ""', status=4)['status'], 'exception')  # endless output
        self.assertLess(time.monotonic() - begin, 60.0)

    def test_in_a_comparison_each_is_an_outcome_of_its_runs(self):
        self.write('open.yaml', OPEN)
        commands = {'good': 'python3 ' + STRAIGHT, 'talks': f'echo ready >&2 && python3 {STRAIGHT}',
                    'words': 'echo the way is long', 'numbers': 'echo 1 2',
                    'fails': 'exit 3', 'missing': './no_such_program', 'hangs': 'sleep 1000',
                    'elsewhere': 'echo 1e300 0 0; echo 0 0 0', 'half': 'head -c 10 >/dev/null; python3 -c "print(0,0,0)"'}
        text = '[problem]\nscenario = open.yaml\n[benchmark]\ntime_limit = 2\nrun_count = 1\n[planner]\nreeds_shepp=\n'
        for name, command in commands.items():
            text += f'external=\nexternal.name={name}\nexternal.command={command}\n'
        self.write('set.cfg', text)
        done = self.benchmark('set.cfg', '--output', 'out', '--plugin', PLUGIN, '--quiet')
        found = {}
        for run in self.records('out/benchmark.db'):
            found[run['planner']] = (run['figures']['outcome'], run['figures']['success'], run['reason'])
        self.assertEqual(len(found), 1 + len(commands))
        self.assertTrue(found['reeds_shepp'][1] and found['good'][1] and found['talks'][1], found)
        self.assertFalse(any(found[name][1] for name in commands if name not in ('good', 'talks')))
        for name, words in (('words', 'line 1 of the program is not a pose'), ('numbers', 'not a pose'),
                            ('fails', 'status 3'), ('missing', 'status 127')):
            self.assertEqual(found[name][0], 6)  # an exception
            self.assertIn(words, found[name][2])
            self.assertIn(words, done.stdout)
        self.assertEqual(found['hangs'][0], 2)  # the time was up


if __name__ == '__main__':
    main()
