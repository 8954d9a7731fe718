"""No planner can end a comparison: whatever it does is an outcome of its own runs, and the others finish."""

import os
import signal
import subprocess
import time

from programs import BENCHMARK, SANITIZER, ProgramTest, bundled, main

PLUGIN = os.environ['PARKING_BAD_PLANNERS']
CONFIG = '''
[problem]
scenario = {angled}
[benchmark]
time_limit = {{time}}
mem_limit = 300
run_count = 2
[planner]
improved_astar=
reeds_shepp=
{{planners}}
'''.format(angled=bundled('angled45'))
EXCEPTIONS = {'throws': 'solve() threw: bad in?solve ?', 'throws_3': 'solve() threw an exception that is not',
              'throws_in_constructor': 'bad in constructor', 'throws_in_setup': 'bad in setup',
              'throws_in_clear': 'clear() threw: bad in clear', 'throws_in_data': 'getPlannerData() threw: bad in data'}
INVALID_ANSWERS = {'exact_without_path': 'there is no path', 'nan': 'state 1 of its path is out of range: nan',
            'empty': 'its path has no states', 'null': 'no path'}
# Path lengths of coordinates of 1e300 are an assertion in OMPL.
DEADLY = {'far': ('crash', 'Assertion'),
          'segfaults': ('crash', 'killed by signal 11'), 'aborts': ('crash', "signal 6 (Aborted): Assertion `room' failed"),
          'exits': ('crash', 'ended its process with status 0'), 'hangs': ('hang', 'exceeded the time limit'),
          'eats': ('memory', 'the limit is 300 MB')}
if SANITIZER:
    # Its own allocator ends the process instead of asking for less, and it has a word of its own on signals.
    del DEADLY['eats']
    for name in ('ASAN_OPTIONS', 'TSAN_OPTIONS'):
        os.environ[name] = os.environ.get(name, '') + ':handle_segv=0'


class IsolationTest(ProgramTest):
    def compare(self, planners, *arguments, limit=20, **options):
        self.write('set.cfg', CONFIG.format(time=limit, planners=''.join(each + '=\n' for each in planners)))
        return self.benchmark('set.cfg', '--output', 'out', '--plugin', PLUGIN, *arguments, **options)

    def outcomes(self):
        """What the database says: planner -> set of names of outcomes."""
        found = {}
        for planner, outcome in self.query('out/benchmark.db', '''
                SELECT plannerConfigs.name, outcomes.name FROM runs
                JOIN plannerConfigs ON plannerid = plannerConfigs.id
                JOIN outcomes ON outcomes.value = outcome'''):
            found.setdefault(planner.replace('geometric_', ''), []).append(outcome)
        return found

    def assert_others_finished(self, outcomes):
        self.assertEqual(outcomes['improved_astar'], ['exact'] * 2)
        self.assertEqual(outcomes['reeds_shepp'], ['infeasible'] * 2)

    def assert_reasons(self, done, expected):
        """Outcome and reason of each planner, in all places where they should be."""
        outcomes = self.outcomes()
        self.assert_others_finished(outcomes)
        reasons = {run['planner']: run['reason'] for run in self.records('out/benchmark.db')}
        for planner, (outcome, reason) in expected.items():
            self.assertEqual(outcomes[planner], [outcome] * 2, planner)
            self.assertIn(reason, reasons[planner])
            self.assertIn('%s on angled45, run 0: %s: ' % (planner, outcome), done.stderr)
            self.assertIn('- 2 times %s on angled45, run 0: %s: ' % (planner, outcome), done.stdout)
            self.assertIn(reason, self.read('out/summary.md'))


class Outcomes(IsolationTest):
    def test_whatever_a_planner_does_the_others_finish(self):
        expected = {name: ('exception', text) for name, text in EXCEPTIONS.items()}
        expected.update({name: ('invalid_answer', text) for name, text in INVALID_ANSWERS.items()})
        expected.update({name: each for name, each in DEADLY.items() if name != 'hangs'})
        done = self.compare(list(expected) + ['fine'])
        self.assert_reasons(done, expected)
        self.assertEqual(self.outcomes()['fine'], ['infeasible'] * 2)
        # It is over: nothing is run again.
        done = self.compare(list(expected) + ['fine'])
        self.assertIn('already finished', done.stderr)

    def test_one_that_never_returns_is_killed(self):
        begin = time.monotonic()
        done = self.compare(['hangs'], limit=0.3)
        self.assert_reasons(done, {'hangs': DEADLY['hangs']})
        self.assertGreater(time.monotonic() - begin, 2 * (2 + 3 * 0.3))
        self.assertLess(time.monotonic() - begin, 60)

    def test_without_isolation_exceptions_and_invalid_answers_do_no_harm(self):
        expected = {name: ('exception', text) for name, text in EXCEPTIONS.items()}
        expected.update({name: ('invalid_answer', text) for name, text in INVALID_ANSWERS.items()})
        self.assert_reasons(self.compare(list(expected), '--no-isolate'), expected)

    def test_settings_are_refused_as_ever(self):
        self.write('set.cfg', CONFIG.format(time=5, planners='fine=\nfine.speed=3\n'))
        for option in ('--isolate', '--no-isolate'):
            self.refused_benchmark('set.cfg', '--output', 'out', '--plugin', PLUGIN, option, parts=['fine', 'speed'])
        self.refused_benchmark('set.cfg', '--isolate', '--no-isolate', parts=['--no-isolate'])


class Stopping(IsolationTest):
    def test_one_signal_stops_all(self):
        self.write('set.cfg', CONFIG.format(time=100, planners='hangs=\n'))
        for isolation in ('--isolate', '--no-isolate'):
            for number in (signal.SIGTERM, signal.SIGINT):
                with self.subTest(isolation, number=number):
                    process = subprocess.Popen([BENCHMARK, 'set.cfg', '--output', 'out', '--plugin', PLUGIN, '--quiet',
                                                '--planner', 'hangs', isolation], cwd=self.folder,
                                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                    time.sleep(1.5)
                    process.send_signal(number)
                    _, errors = process.communicate(timeout=20)
                    self.assertEqual(process.returncode, 130, errors)
                    self.assertIn('rerun the command to resume', errors)


if __name__ == '__main__':
    main()
