"""parking_benchmark given what it cannot use: one line on standard error, exit status 2, and nothing half written."""

import os
import resource
import signal
import subprocess

from programs import BENCHMARK, ProgramTest, bundled, main

CONFIG = '''[problem]
scenario = %s
%%s
[benchmark]
time_limit = 5
run_count = 20
%%s
[planner]
improved_astar=
%%s
''' % bundled('angled45')


class InputTest(ProgramTest):
    def refused(self, problem='', benchmark='', planner='', parts=()):
        """These lines, each in its section, are refused; the message has all of these parts in it."""
        with self.subTest(problem + benchmark + planner):
            self.write('set.cfg', CONFIG % (problem, benchmark, planner))
            self.refused_benchmark('set.cfg', '--output', 'out', parts=('set.cfg',) + tuple(parts))
            self.assertEqual(os.listdir(self.folder), ['set.cfg'])


class Configuration(InputTest):
    def test_sections_and_keys(self):
        self.refused(problem='[plannerr]', parts=['set.cfg:3:', "did you mean '[planner]'", '[benchmark]'])
        self.refused(problem='scenerio = x', parts=['set.cfg:3:', "did you mean 'scenario'"])
        self.refused(benchmark='time_limt = 3', parts=['set.cfg:7:', "did you mean 'time_limit'"])
        self.refused(benchmark='nonsense', parts=['set.cfg:7:', 'key = value'])

    def test_planners_and_parameters(self):
        self.refused(planner='rrtstr=', parts=['set.cfg:10:', "did you mean 'RRTstar'", 'reeds_shepp'])
        self.refused(planner='RRTstar=\nRRTstar.rnge=1', parts=["did you mean 'range'", 'goal_bias'])
        self.refused(planner='RRTstar=\nRRTstar.range=far', parts=['range', 'far'])
        self.refused(planner='PRM=3', parts=['set.cfg:10:', 'PRM='])
        self.refused(planner='RRTstar.range=1', parts=['set.cfg:10:', 'RRTstar='])
        self.refused(planner='PRM=\nPRM.name=improved_astar', parts=['set.cfg:11:', 'already'])
        self.refused(planner='PRM=\nPRM.name=../x', parts=['set.cfg:11:', '../x'])
        self.refused(planner='PRM=\nPRM.only=angled', parts=["did you mean 'angled45'"])
        self.refused(planner='PRM=\nPRM.only=', parts=['set.cfg:11:', 'only'])
        self.refused(planner='PRM=\nPRM.problem.scenario=x', parts=['set.cfg:11:', 'only'])

    def test_values(self):
        for key in ('time_limit', 'mem_limit'):
            for value in ('0', '-1', 'nan', 'inf', 'long', ''):
                self.refused(benchmark='%s = %s' % (key, value), parts=['set.cfg:7:', key, 'positive'])
        self.refused(benchmark='time_limit = 1000001', parts=['set.cfg:7:', 'time_limit', 'at most 1000000'])
        for value in ('0', '-1', '1e3', '2.5', ''):
            self.refused(benchmark='run_count = ' + value, parts=['set.cfg:7:', 'run_count', 'whole number'])
        self.refused(benchmark='save_paths = some', parts=['shortest'])
        self.refused(benchmark='track = perhaps', parts=['true or false'])
        self.refused(problem='vehicle = nan', parts=['set.cfg:3:', "'nan'", 'vw_golf8'])
        self.refused(problem='vehicle = no/such.yaml', parts=['set.cfg:3:', 'no/such.yaml', 'No such file'])
        self.refused(planner='PRM=\nPRM.problem.vehicle=golf', parts=['set.cfg:11:', "'golf'"])
        self.refused(problem='scenario =', parts=['set.cfg:3:', 'name of a scenario is empty'])
        self.refused(problem='scenario = gone.yaml', parts=['set.cfg:3:', 'gone.yaml', 'No such file'])
        self.refused(problem='space = se3', parts=["did you mean 'se2'"])
        self.refused(problem='footprint = circle', parts=['se2'])
        self.refused(problem='circle_radius = -1', parts=['circle_radius'])
        self.refused(problem='start.x = nan', parts=['start.x'])
        self.refused(problem='start.x = 1', parts=['theta'])
        self.refused(problem='volume.min.x = 1e9', parts=['volume'])
        self.refused(problem='objective = clearance', parts=['length'])
        self.refused(problem='sampler = best', parts=['gaussian'])

    def test_files(self):
        for name, content, part in (('missing.cfg', None, 'No such file'), ('empty.cfg', '', 'empty'),
                                    ('bare.cfg', '[problem]\nscenario=%s\n' % bundled('angled45'), 'no planner'),
                                    ('nothing.cfg', '[planner]\nPRM=\n', 'no scenario'),
                                    ('gone.cfg', '[problem]\nscenario=x.yaml\n[planner]\nPRM=\n', 'x.yaml'),
                                    ('hollow.cfg', '[problem]\nscenario=.\n[planner]\nPRM=\n', 'no scenario'),
                                    ('binary.cfg', b'\0\1\2\xff' * 100, 'binary.cfg')):
            with self.subTest(name):
                if content is not None:
                    self.write(name, content)
                self.refused_benchmark(name, '--output', 'out', parts=[part])
                self.assertFalse(os.path.exists(self.path('out')))


class Options(InputTest):
    def test_options(self):
        self.write('set.cfg', CONFIG % ('', '', ''))
        for arguments, part in ((['--shard', '3/2'], '2/8'), (['--shard', '0/2'], '2/8'), (['--shard', 'a/b'], '2/8'),
                                (['--time', '0'], '--time'), (['--time', 'nan'], '--time'),
                                (['--time', '1000001'], '--time must'), (['--time', '1e10'], 'at most 1000000'),
                                (['--runs', '0'], '--runs'),
                                (['--planner', 'PRM'], 'improved_astar'), (['--from', 'x'], '--merge'),
                                (['--merge', '--shard', '1/2'], '--merge'), (['--merge', '--output', 'none'], 'no runs'),
                                (['--scenarios', 'nowhere.yaml'], 'parking_benchmark: nowhere.yaml'),
                                (['--scenarios', ''], 'name of a scenario'), (['--output', ''], '--output'),
                                (['--plugins', 'x.so'], "did you mean '--plugin'"), (['other.cfg'], 'too many')):
            with self.subTest(arguments):
                self.refused_benchmark('set.cfg', *arguments, parts=[part])


class Output(InputTest):
    def setUp(self):
        super().setUp()
        self.write('set.cfg', CONFIG % ('', '', ''))

    def test_folders_that_cannot_be_written(self):
        for folder in ('set.cfg', 'set.cfg/out', '/proc/nowhere', '/dev/full'):
            with self.subTest(folder):
                self.refused_benchmark('set.cfg', '--output', folder, parts=[folder])
        self.assertEqual(os.listdir(self.folder), ['set.cfg'])

    def test_the_disk_is_full(self):
        def limit(size=16384):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        arguments = ['set.cfg', '--output', 'out', '--quiet', '--no-report']
        self.refused_benchmark(*arguments, preexec_fn=limit, parts=['out/runs.jsonl', 'File too large'])
        lines = self.read('out/runs.jsonl').splitlines()
        self.assertGreater(len(lines), 2)
        self.assertLess(len(lines), 21)
        self.assertTrue(self.read('out/runs.jsonl').endswith('}\n'))  # no line was cut short
        # With room again it goes on.
        done = self.benchmark('set.cfg', '--output', 'out')
        self.assertIn('Going on: %d of 20' % (len(lines) - 1), done.stderr)
        # No room for results: the runs stay, and no file is half written.
        log, database = (os.path.getsize(self.path('out/' + name)) for name in ('angled45.log', 'benchmark.db'))
        self.assertLess(log + 1024, database)  # there is room for the log, and not for the database
        os.remove(self.path('out/benchmark.db'))
        self.refused_benchmark('set.cfg', '--output', 'out', '--merge', preexec_fn=lambda: limit(log + 1024),
                               parts=['out/benchmark.db'])
        self.assertEqual(sorted(os.listdir(self.path('out'))),
                         ['angled45.log', 'pictures', 'runs.jsonl', 'summary.csv', 'summary.md'])
        self.assertEqual(len(self.read('out/runs.jsonl').splitlines()), 21)

    def test_runs_that_are_none(self):
        os.mkdir(self.path('out'))
        for content in ('junk\n', '{}\n', '{"parking_benchmark": 99}\n', '', '[' * 100000 + '\n'):
            with self.subTest(content[:30]):
                self.write('out/runs.jsonl', content)
                self.refused_benchmark('set.cfg', '--output', 'out', '--merge', parts=['out/runs.jsonl'])

    def test_the_database_needs_no_other_program(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1, env={'PATH': self.folder})
        with open(self.path('out/benchmark.db'), 'rb') as stream:
            self.assertEqual(stream.read(16), b'SQLite format 3\0')

    def test_standard_output_that_is_full(self):
        with open('/dev/full', 'w') as full:
            done = subprocess.run([BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--no-report', '--runs', '1'],
                                  cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60,
                                  check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn('standard output', done.stderr)


if __name__ == '__main__':
    main()
