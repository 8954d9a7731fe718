"""parking_plan given what it cannot use: one line on standard error, exit status 2, and no file half written."""

import json
import os
import subprocess

from programs import PLAN, ProgramTest, bundled, main

CASE = '0,0,0,5,5,0,1,4,2,2,3,2,3,3,2,3\n'
MAP = 'image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n'
GRID_OF_A_CAR = ['--set', 'motion_model=grid8', '--space', 'reeds_shepp', '--footprint', 'rectangle']
ON_MAP = 'map: map.yaml\nstart: [2, 2, 0]\ngoal: [8, 2, 0]\n'


def pgm(width, height, cells=None):
    return b'P5\n%d %d\n255\n' % (width, height) + (b'\xfe' * (width * height) if cells is None else cells)


class Files(ProgramTest):
    def test_cases(self):
        for name, content, part in (('missing.csv', None, 'No such file'), ('empty.csv', '', 'empty'),
                                    ('few.csv', CASE[:20], 'too few numbers'),
                                    ('short.csv', CASE[:-8], 'too few numbers'),
                                    ('two.csv', '0,0,0,5,5,0,1,2,2,2,3,3\n', '2 corners'),
                                    ('nan.csv', CASE.replace('5,5', 'nan,5'), 'nan'),
                                    ('word.csv', CASE.replace('5,5', 'five,5'), 'five')):
            with self.subTest(name):
                if content is not None:
                    self.write(name, content)
                self.refused_plan(name, '--json', 'out.json', parts=[name, part])
                self.assertFalse(os.path.exists(self.path('out.json')))

    def test_scenarios(self):
        polygons = 'polygons:\n  - [[2, 2], [3, 2], [3, 3]]\n'
        poses = 'start: [0, 0, 0]\ngoal: [9, 0, 0]\n'
        for name, content, part in (
                ('empty.yaml', '', 'empty'), ('torn.yaml', poses + 'polygons:\n  - [[2, 2], [3', 'torn.yaml:'),
                ('two.yaml', poses + 'polygons:\n  - []\n', 'no corners'),
                ('nan.yaml', poses.replace('9', '.nan') + polygons, 'finite'),
                ('short.yaml', poses.replace('9, ', '') + polygons, '3 numbers'),
                ('key.yaml', poses.replace('goal', 'gaol') + polygons, "did you mean 'goal'"),
                ('goalless.yaml', 'start: [0, 0, 0]\n' + polygons, 'goal'),
                ('car.yaml', poses + polygons + 'vehicle: golf\n', "vehicle"),
                ('mapless.yaml', ON_MAP.replace('map.yaml', 'nowhere.yaml'), 'No such file')):
            with self.subTest(name):
                self.write(name, content)
                self.refused_plan(name, parts=[part])
        self.refused_plan('/', parts=['folder'])

    def test_maps(self):
        self.write('on_map.yaml', ON_MAP)
        for title, yaml, image, part in (
                ('truncated', MAP, pgm(100, 100, b'\xfe' * 9999), 'truncated'),
                ('other size', MAP, pgm(100, 100, b'\xfe' * 12000), '100 x 100'), ('none', MAP, None, 'No such file'),
                ('no pixels', MAP, pgm(0, 0), '0 x 0'), ('no image', MAP, b'GIF89a', 'map.pgm'),
                ('resolution 0', MAP.replace(': 0.1\n', ': 0\n'), pgm(100, 100), 'resolution'),
                ('negative resolution', MAP.replace(': 0.1\n', ': -0.1\n'), pgm(100, 100), 'resolution'),
                ('resolution of planets', MAP.replace(': 0.1\n', ': 1e300\n'), pgm(100, 100), '100000 m'),
                ('resolution of atoms', MAP.replace(': 0.1\n', ': 1e-300\n'), pgm(100, 100), 'outside the map'),
                ('gigantic', MAP, pgm(100000000, 100000000, b''), 'map.pgm')):
            with self.subTest(title):
                self.write('map.yaml', yaml)
                if image is None:
                    if os.path.exists(self.path('map.pgm')):
                        os.remove(self.path('map.pgm'))
                else:
                    self.write('map.pgm', image)
                self.refused_plan('on_map.yaml', parts=[part])

    def test_pipes_and_devices(self):
        with open(bundled('parallel'), encoding='utf-8') as stream:
            text = stream.read()
        want = self.planned(bundled('parallel'))['path']
        for content in (text, text + '#' * 200000 + '\n'):  # more than a pipe holds at once
            done = self.plan('/dev/stdin', '--json', '-', input=content)
            self.assertEqual(json.loads(done.stdout)['path'], want)
        self.plan('/dev/stdin', input=CASE)
        self.refused_plan('/dev/stdin', input='', parts=['/dev/stdin: is empty'])
        self.refused_plan('/dev/stdin', input='x' * (17 << 20), parts=['/dev/stdin: is larger than the 16 MiB'])
        done = self.run_program('bash', '-c', f'yes | {PLAN} /dev/stdin')  # which ends when nobody reads any more
        self.assert_refused(done, '/dev/stdin', 'MiB')
        done = self.run_program('bash', '-c', f'{PLAN} <(cat {bundled("parallel")}) --svg >(cat >out.svg; touch written)')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        for name in ('/dev/zero', '/dev/null', '/'):
            for arguments in ([name], [bundled('parallel'), '--vehicle', name]):
                self.refused_plan(*arguments, parts=[name, 'a file is needed'])
            self.refused_plan(bundled('parallel'), '--plugin', name, parts=[name, 'is not a file'])
        os.mkfifo(self.path('pipe'))
        self.refused_plan(bundled('parallel'), '--plugin', 'pipe', parts=['pipe', 'is not a file'])  # without waiting

    def test_start_or_goal_far_from_the_map(self):
        self.write('map.yaml', MAP)
        self.write('map.pgm', pgm(100, 100))
        for old, new, parts in (('[2,', '[20,', ['start outside the map']),
                                ('[8,', '[1e7,', ['on_map.yaml', 'the goal lies 9999998 m', 'at most 100000 m'])):
            self.write('on_map.yaml', ON_MAP.replace(old, new))
            self.refused_plan('on_map.yaml', parts=parts)
        self.write('on_map.yaml', ON_MAP.replace('[8,', '[100002,'))  # outside of the map, but not too far away
        self.assertEqual(self.planned('on_map.yaml', '--set', 'approximate=0', status=4)['status'], 'invalid_goal')


class Unsolvable(ProgramTest):
    """Not bad input, but a status of planning: exit status 4, one line that says why, and a whole result."""

    def test_start_or_goal_in_collision(self):
        for start, goal, status in (([0, 0, 0], [30, 0, 0], 'invalid_start'), ([-30, 0, 0], [0, 0, 0], 'invalid_goal')):
            with self.subTest(status):
                self.write('block.yaml', 'start: %s\ngoal: %s\npolygons: [[[-1, -1], [1, -1], [1, 1], [-1, 1]]]\n' %
                           (start, goal))
                arguments = ['block.yaml', '--set', 'approximate=0', '--time-limit', 1]
                result = self.planned(*arguments, status=4)
                self.assertEqual(result['status'], status)
                done = self.plan(*arguments, status=4)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn('collision', done.stderr)


class Options(ProgramTest):
    def refused(self, *arguments, parts):
        with self.subTest(arguments):
            self.refused_plan(bundled('parallel'), *arguments, parts=parts)

    def test_names(self):
        for arguments, parts in ((['--planner', 'rrtstr'], ["did you mean 'RRTstar', 'PRMstar' or 'RRT'? (see --help)"]),
                                 (['--set', 'xy_resolutoin=1'], ["did you mean 'xy_resolution', "]),
                                 (['--planner', 'RRTstar', '--set', 'rnge=1'], ["did you mean 'range'"]),
                                 (['--vehicle', 'vw_golf'], ["did you mean 'vw_golf8'"]),
                                 (['--space', 'se3'], ["did you mean 'se2'"]),
                                 (['--footprint', 'square'], ['rectangle']),
                                 (['--vehicle', ''], ['--vehicle']),
                                 (['--circle-radius', 1], ['--circle-radius', '--footprint circle']),
                                 (['--circle-radius', 1, *GRID_OF_A_CAR], ['--circle-radius']),
                                 (['--run', 3], ["did you mean '--runs'"]),
                                 ([bundled('perpendicular')], ['too many'])):
            self.refused(*arguments, parts=parts)
        self.refused_plan(parts=['no scenario'])

    def test_numbers(self):
        for option in ('--time-limit', '--circle-radius'):
            for value in ('0', '-1', 'nan', 'inf', '1s', ''):
                self.refused(option, value, parts=[option, 'positive'])
        self.refused('--time-limit', '1000001', parts=['--time-limit', 'at most 1000000', '1000001'])
        self.plan(bundled('parallel'), '--time-limit', 1000000)
        for value in ('0', '-1', '1.5', '99999999999', 'many'):
            self.refused('--runs', value, parts=['--runs', 'whole number'])
        self.refused('--seed', '0', parts=['--seed'])

    def test_parameters(self):
        for value in ('nan', '', '-1', 'coarse', '0.3m'):
            self.refused('--set', 'xy_resolution=' + value, parts=['xy_resolution'])
        # Not 8 after being cut to 32 bits.
        for value in ('4294967304', '-4294967288', '1000000000000', '7.5'):
            self.refused('--set', 'heading_bins=' + value, parts=['heading_bins', value])
        for setting, part in (('open_list=heap', 'binary_heap'), ('open_list', 'KEY=VALUE'), ('=3', 'KEY=VALUE')):
            self.refused('--set', setting, parts=[part])
        self.refused(*GRID_OF_A_CAR, parts=['SE2'])


class Output(ProgramTest):
    def test_files_that_cannot_be_written(self):
        self.write('file', 'x')
        for option in ('--json', '--svg'):
            for name in ('nowhere/out', 'file/out', '/', ''):
                with self.subTest(option=option, name=name):
                    self.refused_plan(bundled('angled45'), option, name)
            self.refused_plan(bundled('angled45'), option, '', parts=[f'{option} requires the name of a file'])
            self.refused_plan(bundled('angled45'), option, '/dev/full', parts=['No space left'])
        self.assertEqual(os.listdir(self.folder), ['file'])

    def test_files_that_something_else_would_be_lost_of(self):
        drive = ['--trajectory', '--track']
        self.write('case.csv', CASE)
        self.write('car.yaml', 'name: mine\n')
        os.link(self.path('case.csv'), self.path('other.csv'))
        os.symlink('case.csv', self.path('link.csv'))
        before = sorted(os.listdir(self.folder))
        for option in ('--json', '--svg', '--csv', '--html'):
            for name in ('case.csv', './case.csv', 'other.csv', 'link.csv', 'car.yaml'):
                with self.subTest(option=option, name=name):
                    self.refused_plan('case.csv', '--vehicle', 'car.yaml', *drive, option, name, parts=[name, 'is the input'])
            if option != '--json':
                self.refused_plan('case.csv', *drive, option, '-', parts=["'-'", 'standard output', "'./-'"])
                self.refused_plan('case.csv', *drive, '--json', 'out', option, 'out', parts=['out', 'twice'])
                self.refused_plan('case.csv', *drive, '--json', 'out', option, './out', parts=['out', 'twice'])
        self.assertEqual((self.read('case.csv'), sorted(os.listdir(self.folder))), (CASE, before))
        # What is no file holds both, and a name can be - all the same.
        self.plan('case.csv', '--json', '/dev/null', '--svg', '/dev/null')
        self.plan('case.csv', '--svg', './-')
        self.assertIn('<svg', self.read('-'))

    def test_what_a_scenario_names_is_an_input_too(self):
        self.write('maps/map.yaml', MAP)
        self.write('maps/map.pgm', pgm(100, 100))
        self.write('maps/car.yaml', 'wheelbase: 2.4\nfront_overhang: 0.8\nrear_overhang: 0.7\nwidth: 1.7\n'
                   'max_steering_angle: 0.6\n')
        self.write('on_map.yaml', ON_MAP.replace('map.yaml', 'maps/map.yaml').replace('[8,', '[5,') + 'vehicle: maps/car.yaml\n')
        os.symlink('maps/map.pgm', self.path('link'))
        before = self.contents()
        for option in ('--json', '--svg', '--csv', '--html'):
            for name in ('maps/map.yaml', './maps/map.pgm', 'link', 'maps/car.yaml', self.path('maps/map.pgm')):
                with self.subTest(option=option, name=name):
                    self.refused_plan('on_map.yaml', '--trajectory', '--track', option, name, parts=[name[:60], 'is the input'])
        self.assertEqual(self.contents(), before)
        self.plan('on_map.yaml', '--json', 'maps/map.json')

    def contents(self):
        found = {}
        for folder, _, names in os.walk(self.folder):
            for name in names:
                with open(os.path.join(folder, name), 'rb') as stream:
                    found[os.path.join(folder, name)] = stream.read()
        return found

    def test_standard_output_that_is_full(self):
        with open('/dev/full', 'w') as full:
            for arguments in ([bundled('angled45')], [bundled('angled45'), '--json', '-'], ['--help']):
                done = subprocess.run([PLAN] + arguments, stdout=full, stderr=subprocess.PIPE,
                                      text=True, timeout=60, check=False)
                self.assertEqual(done.returncode, 2)
                self.assertIn('standard output', done.stderr)

    def test_a_read_only_folder(self):
        if os.geteuid() == 0:
            self.skipTest('root may write everywhere')
        os.mkdir(self.path('locked'), 0o555)
        self.refused_plan(bundled('angled45'), '--json', 'locked/out.json', parts=['locked/out.json'])

    def test_an_old_result_stays_when_there_is_no_new_one(self):
        self.write('out.json', 'old')
        self.refused_plan(bundled('angled45'), '--json', 'out.json', '--set', 'heading_bins=0')
        self.refused_plan('missing.yaml', '--json', 'out.json')
        self.assertEqual(self.read('out.json'), 'old')


if __name__ == '__main__':
    main()
