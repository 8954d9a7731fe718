"""parking_benchmark given what it cannot use: one line on standard error, exit status 2, and nothing half written."""

import os
import resource
import signal

from programs import ProgramTest, bundled, main

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
        self.refused(benchmark='no key', parts=['set.cfg:7:', 'key = value'])

    def test_planners_and_parameters(self):
        self.refused(planner='rrtstr=', parts=['set.cfg:10:', "did you mean 'RRTstar', 'PRMstar' or 'RRT'? (see --help)"])
        self.refused(planner='RRTstar=\nRRTstar.rnge=1', parts=['set.cfg:11:', "did you mean 'range'", 'goal_bias'])
        self.refused(planner='improved_astar.foo=1', parts=['set.cfg:10: planner improved_astar on angled45: ', "'foo'"])
        self.refused(planner='improved_astar.anytime=maybe', parts=['set.cfg:10:', 'anytime', "'maybe'"])
        self.refused(planner='# none\nimproved_astar.heading_bins=7', parts=['set.cfg:11:', 'heading_bins must be between'])
        self.refused(planner='textbook_hybrid_astar=\ntextbook_hybrid_astar.heading_bins=0',
                     parts=['set.cfg:11:', 'textbook_hybrid_astar', 'heading_bins must be between 1 and 4000, not 0'])
        self.refused_benchmark('set.cfg', '--isolate', parts=['set.cfg:11:', 'heading_bins must be between'])
        self.refused(planner='control_RRT=\ncontrol_RRT.step=0', parts=['set.cfg:11:', 'step must be between 0.01 and 10, not 0'])
        self.refused(planner='improved_astar.motion_model=grid8', parts=['set.cfg:9: planner', 'SE2'])  # where it is added
        self.refused(planner='RRTstar=\nRRTstar.range=far', parts=['set.cfg:11:', 'range', 'far'])
        self.refused(planner='PRM=3', parts=['set.cfg:10:', 'PRM='])
        self.refused(planner='PRM=\nPRM.=3', parts=['set.cfg:11:', 'has no parameter name'])
        self.refused(planner='PRM=\nPRM.name=improved_astar', parts=['set.cfg:11:', 'already'])
        self.refused(planner='PRM=\nPRM.name=../x', parts=['set.cfg:11:', '../x'])
        self.refused(planner='PRM=\nPRM.only=angled', parts=['set.cfg:11:', "did you mean 'angled45'"])
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
        self.refused(benchmark='perceive = far', parts=['perceive', 'far'])
        self.refused(problem='vehicle = nan', parts=['set.cfg:3:', "'nan'", 'vw_golf8'])
        self.refused(problem='vehicle = no/such.yaml', parts=['set.cfg:3:', 'no/such.yaml', 'No such file'])
        self.refused(planner='PRM=\nPRM.problem.vehicle=golf', parts=['set.cfg:11:', "'golf'"])
        self.refused(problem='scenario = gone.yaml', parts=['set.cfg:3:', 'gone.yaml', 'No such file'])
        self.refused(problem='space = se3', parts=["did you mean 'se2'"])
        self.refused(problem='circle_radius = -1', parts=['circle_radius'])
        self.refused(problem='start.x = nan', parts=['start.x'])
        self.refused(problem='volume.min.x = 1e9', parts=['set.cfg:3:', 'angled45.yaml: the volume', 'whose x ranges between'])
        self.refused(problem='objective = clearance', parts=['length', 'driving'])
        self.refused(problem='sampler = best', parts=['gaussian'])

    def test_files(self):
        for name, content, part in (('missing.cfg', None, 'No such file'), ('empty.cfg', '', 'empty'),
                                    ('bare.cfg', '[problem]\nscenario=%s\n' % bundled('angled45'), 'no planner'),
                                    ('nothing.cfg', '[planner]\nPRM=\n', 'no scenario'),
                                    ('unnamed.cfg', '[problem]\nscenario =\n[planner]\nPRM=\n', 'unnamed.cfg:2: the name of a scenario'),
                                    ('loose.cfg', 'scenario = a\n', 'loose.cfg:1: the key'),
                                    ('gone.cfg', '[problem]\nscenario=x.yaml\n[planner]\nPRM=\n', 'x.yaml'),
                                    ('hollow.cfg', '[problem]\nscenario=.\n[planner]\nPRM=\n', 'no scenario'),
                                    ('binary.cfg', b'\0\1\2\xff' * 100, 'binary.cfg')):
            with self.subTest(name):
                if content is not None:
                    self.write(name, content)
                self.refused_benchmark(name, '--output', 'out', parts=[part])
                self.assertFalse(os.path.exists(self.path('out')))

    def test_pipes_and_devices(self):
        os.mkfifo(self.path('pipe'))
        os.mkfifo(self.path('car.yaml'))
        self.write('set.cfg', CONFIG % ('', '', ''))
        for arguments in (['--scenarios', 'pipe'], ['--scenarios', '/dev/zero'], ['--plugin', 'pipe']):
            self.refused_benchmark('set.cfg', '--output', 'out', *arguments, parts=[arguments[1]])
        self.write('piped.cfg', CONFIG % ('scenario = pipe', '', ''))
        self.refused_benchmark('piped.cfg', parts=['piped.cfg:3: ', 'pipe: is a pipe', 'read only once'])
        self.write('piped.cfg', CONFIG % ('vehicle = car.yaml', '', ''))
        self.refused_benchmark('piped.cfg', parts=['piped.cfg:3: ', 'car.yaml: is a pipe'])
        self.refused_benchmark('/dev/zero', parts=['/dev/zero', 'device'])
        self.assertFalse(os.path.exists(self.path('out')))
        os.mkdir(self.path('out'))
        os.rename(self.path('pipe'), self.path('out/benchmark.db'))
        for arguments in ([], ['--merge']):
            self.refused_benchmark('set.cfg', '--output', 'out', *arguments, parts=['out'])
        # A configuration is read once.
        self.benchmark('/dev/stdin', '--runs', 1, '--output', 'piped', input=CONFIG % ('', '', ''))


class Unsolvable(InputTest):
    """Nothing that is refused, but said before the runs: which scenario, which pose, and what is wrong with it."""

    def setUp(self):
        super().setUp()
        self.write('map.yaml', 'image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
        rows = (b'\xfe' * 60 + b'\0' * 5 + b'\xfe' * 35) * 100  # a wall 6 m from the left
        self.write('map.pgm', b'P5\n100 100\n255\n' + rows)
        self.write('on_map.yaml', 'map: map.yaml\nstart: [2, 2, 0]\ngoal: [2, 7, 0]\nvehicle: tpcap\n')

    def told(self, problem, *arguments):
        self.write('set.cfg', '[problem]\nscenario = on_map.yaml\n%s\n[benchmark]\ntime_limit = 0.1\nrun_count = 1\n[planner]\n'
                   'improved_astar=\n' % problem)
        return self.benchmark('set.cfg', '--output', 'out', '--quiet', *arguments).stderr

    @staticmethod
    def pose(which, x, y):
        return f'{which}.x = {x}\n{which}.y = {y}\n{which}.theta = 0'

    def test_the_reason_is_said_before_the_runs(self):
        where = 'parking_benchmark: set.cfg:2: on_map.yaml: '
        for problem, said in (
                (self.pose('start', 6, 2), 'the car is in collision at the start 6, 2, 0 (the start is given in set.cfg)'),
                (self.pose('start', 0.5, 2), 'the car is outside of the map, in whole or in part, at the start 0.5, 2, 0'),
                (self.pose('goal', 5, 3), 'the car is in collision at the goal 5, 3, 0 (the goal is given in set.cfg)'),
                (self.pose('goal', 60, 2), 'the car is outside of the map, in whole or in part, at the goal 60, 2, 0'),
                ('volume.min.x = 2.5', 'the car is outside of the planning volume at the start 2, 2, 0'),
                ('space = se2\nfootprint = circle\n' + self.pose('start', 6.2, 2), 'the circle is in collision at the start')):
            with self.subTest(problem):
                told = self.told(problem)
                self.assertEqual(told.count('\n'), 1, told)
                self.assertTrue(told.startswith(where + said), told)
                self.assertTrue(told.endswith('; no run of on_map can solve it\n'), told)
        self.assertEqual(self.told(''), '')
        # Where nothing at all of the map is left it is no scenario.
        self.write('off.cfg', '[problem]\nscenario = on_map.yaml\n%s\n[planner]\nimproved_astar=\n' % self.pose('start', 60, 2))
        self.refused_benchmark('off.cfg', parts=['off.cfg:2: on_map.yaml: start outside the map', '60, 2 m'])

    def test_goals_of_a_slot(self):
        self.write('on_map.yaml', 'map: map.yaml\nstart: [2, 2, 0]\nvehicle: tpcap\n'
                   'slot: {kind: perpendicular, pose: [5, 5, 0], length: 5, width: 2.5, entry: either}\n')
        self.assertIn('and no other goal is free; no run', self.told(''))


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


class OtherScenarios(InputTest):
    def test_who_is_run_on_the_former_ones_only_is_left_out_and_named(self):
        self.write('set.cfg', CONFIG % ('', '', 'PRM=\nPRM.only=angled45\nRRT=\nRRT.only=angled45, tight*\n'))
        arguments = ['set.cfg', '--runs', 1, '--time', 5, '--quiet', '--output', 'out', '--scenarios', bundled('perpendicular')]
        done = self.benchmark(*arguments, '--planner', 'improved_astar', '--planner', 'PRM')
        self.assertIn("set.cfg: not run: 'only' names none of the scenarios of --scenarios: PRM\n", done.stderr)
        with self.subTest('a name that neither has'):
            self.refused_benchmark(*arguments, '--planner', 'RRT', parts=['set.cfg:13: planner RRT', 'tight*', 'perpendicular'])
        with self.subTest('nobody is left'):
            self.refused_benchmark(*arguments, '--planner', 'PRM', parts=['set.cfg:11: planner PRM', 'angled45', 'perpendicular'])


class Output(InputTest):
    def test_no_folder_is_made_for_runs_that_are_not_there(self):
        os.mkdir(self.path('empty'))
        self.write('set.cfg', CONFIG % ('', '', ''))
        for source, part in (('nosuch', 'nosuch'), ('empty', 'empty: contains no runs')):
            self.refused_benchmark('set.cfg', '--merge', '--from', source, '--output', 'new', parts=[part])
            self.assertFalse(os.path.exists(self.path('new')))

    def test_inputs_are_not_written_over(self):
        case = '0,0,0,5,5,0,1,4,2,2,3,2,3,3,2,3\n'
        for name in ('summary.csv', 'pairs.csv', 'paths/case.csv', 'pictures/drawn.svg'):
            with self.subTest(name):
                self.write('out/' + name, case)
                self.write('own.cfg', '[problem]\nscenario = out/%s\nname = drawn\n[benchmark]\nrun_count = 1\nsave_paths = all\n'
                           '[planner]\nimproved_astar=\n' % name)
                self.refused_benchmark('own.cfg', '--output', 'out', parts=['out/' + name, 'input'])
                self.assertEqual(self.read('out/' + name), case)
        self.assertFalse(os.path.exists(self.path('out/benchmark.db')))

    def setUp(self):
        super().setUp()
        self.write('set.cfg', CONFIG % ('', '', ''))

    def test_folders_that_cannot_be_written(self):
        for folder in ('set.cfg', 'set.cfg/out', '/proc/nowhere', '/dev/full'):
            with self.subTest(folder):
                self.refused_benchmark('set.cfg', '--output', folder, parts=[folder])
        self.assertEqual(os.listdir(self.folder), ['set.cfg'])

    def test_the_disk_is_full(self):
        def limit(size):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        arguments = ['set.cfg', '--output', 'out', '--quiet', '--no-report']
        self.benchmark(*arguments[:-1], '--runs', 3)
        room = os.path.getsize(self.path('out/benchmark.db')) + 4096
        self.refused_benchmark(*arguments, preexec_fn=lambda: limit(room), parts=['out/benchmark.db', 'File too large'])
        kept = self.records('out/benchmark.db', clock=True)
        self.assertGreater(len(kept), 3)
        self.assertLess(len(kept), 20)
        # No room for results: the runs stay, and no file is half written.
        os.remove(self.path('out/angled45.log'))
        self.refused_benchmark('set.cfg', '--output', 'out', '--merge', preexec_fn=lambda: limit(1024), parts=['out/'])
        self.assertNotIn('angled45.log', os.listdir(self.path('out')))
        self.assertEqual(self.records('out/benchmark.db', clock=True), kept)

    def test_the_database_needs_no_other_program(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1, env={'PATH': self.folder})
        self.assertEqual(len(self.records('out/benchmark.db')), 1)


if __name__ == '__main__':
    main()
