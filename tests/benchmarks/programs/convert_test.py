"""parking_convert: every format into every other and back, results as CommonParking takes them, HOPE's levels, bad input."""

import json
import math
import os
import re
import struct
import unittest
import zlib

from programs import SCENARIOS, SHARED_DATA, ProgramTest, bundled, main

CONVERT = os.environ['PARKING_CONVERT']
QUERIES = os.environ['PARKING_QUERIES']
CASE = '0,0,0.1,8,1,-1.2,2,4,3,2,2,4,2,4,4,2,4,-5,-5,-3,-5,-4,-4\n'
SCENE = '''<?xml version="1.0"?>
<svg
   width="20mm">
  <g
     transform="translate(-100,-50)">
    <path
       id="a"
       d="m 102,54 2,0 0,2 -2,0 z" />
    <path
       d="M 110,60 H 112 V 61 h -2 z"/>
    <path
       d="m 120,60 l 4,0 0,4 -2,-3 -2,3 z"/>
  </g>
</svg>
'''


def numbers_of(yaml, key):
    return [float(each) for each in re.search(rf'^{key}: \[(.*)\]$', yaml, re.MULTILINE).group(1).split(',')]


def polygons_of(yaml):
    return [[[float(each) for each in corner.split(',')] for corner in re.findall(r'\[([^\[\]]*)\]', line)]
            for line in re.findall(r'^  - \[(.*)\]$', yaml, re.MULTILINE)]


class MatFile:
    """A reader of MATLAB 5 files by their published format, for what parking_convert writes."""

    def __init__(self, name):
        with open(name, 'rb') as stream:
            content = stream.read()
        assert content[:10] == b'MATLAB 5.0' and content[126:128] == b'IM'
        self.variables = {}
        place = 128
        while place < len(content):
            kind, size = struct.unpack_from('<II', content, place)
            body = content[place + 8:place + 8 + size]
            if kind == 15:
                body = zlib.decompress(body)[8:]
            name, value = self.matrix(body)
            self.variables[name] = value
            place += 8 + size

    @staticmethod
    def element(content, place):
        kind, size = struct.unpack_from('<II', content, place)
        if kind >> 16:
            return kind & 0xffff, content[place + 4:place + 4 + (kind >> 16)], place + 8
        return kind, content[place + 8:place + 8 + size], place + 8 + (size + 7) // 8 * 8

    def matrix(self, content):
        if not content:
            return '', []
        _, flags, place = self.element(content, 0)
        _, size, place = self.element(content, place)
        _, name, place = self.element(content, place)
        rows, columns = struct.unpack('<ii', size)
        kind = flags[0]
        if kind == 2:  # struct
            _, length, place = self.element(content, place)
            _, names, place = self.element(content, place)
            width = struct.unpack('<i', length)[0]
            fields = [names[k:k + width].split(b'\0')[0].decode() for k in range(0, len(names), width)]
            value = {}
            for field in fields:
                _, body, place = self.element(content, place)
                value[field] = self.matrix(body)[1]
        elif kind == 1:  # cell
            value = []
            for _ in range(rows * columns):
                _, body, place = self.element(content, place)
                value.append(self.matrix(body)[1])
        else:
            kind_of_data, body, place = self.element(content, place)
            code = {1: 'b', 2: 'B', 3: 'h', 4: 'H', 5: 'i', 6: 'I', 7: 'f', 9: 'd', 12: 'q', 16: 'B', 17: 'H'}[kind_of_data]
            data = list(struct.unpack(f'<{len(body) // struct.calcsize(code)}{code}', body))
            if kind == 4:
                value = ''.join(map(chr, data))
            else:
                value = [data[k::rows] for k in range(rows)] if min(rows, columns) > 1 else data
                self.shape = (rows, columns)
        return name.decode(), value


class ConvertTest(ProgramTest):
    def convert(self, *arguments, status=0):
        done = self.run_program(CONVERT, *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def refused(self, *arguments):
        done = self.convert(*arguments, status=2)
        self.assertEqual((done.stdout, done.stderr.count('\n')), ('', 1), done.stderr)
        return done.stderr

    def text(self, name):
        with open(self.path(name), encoding='utf-8') as stream:
            return stream.read()

    def has_mat_files(self):
        return 'no MATLAB files' not in self.convert('--help').stdout

    def needs_mat_files(self):
        if not self.has_mat_files():
            self.skipTest('built without libmatio')


class ScenariosTest(ConvertTest):
    def test_round_trips_lose_nothing(self):
        self.write('case.csv', CASE)
        names = ['case.csv', 'a.yaml', 'b.svg', 'c.yaml'] + (['d.mat', 'e.yaml'] if self.has_mat_files() else []) + ['f.csv']
        for before, after in zip(names, names[1:]):
            self.convert(before, after, '--check', '--vehicle', 'tpcap')
        numbers = [float(each) for each in self.text('f.csv').split(',')]
        self.assertEqual(numbers[:9], [0, 0, 0.1, 8, 1, -1.2, 2, 4, 3])
        wanted = [float(each) for each in CASE.split(',')]
        self.assertEqual(sorted(zip(numbers[9::2], numbers[10::2])), sorted(zip(wanted[9::2], wanted[10::2])))

    def test_maps_become_polygons_and_keep_their_walls(self):
        self.convert(bundled('underground_garage'), 'garage.yaml', '--check')
        garage = self.planned('garage.yaml')
        self.assertEqual(garage['status'], 'exact')
        low = min(corner[0] for polygon in polygons_of(self.text('garage.yaml')) for corner in polygon)
        self.assertGreater(min(state['x'] for state in garage['path']), low)

    def test_scenes_of_bench_mr_are_read_as_bench_mr_reads_them(self):
        self.write('scene.svg', SCENE)
        self.convert('scene.svg', 'scene.yaml', '--start', '0,-1,0', '--goal', '15,-5,1.5')
        yaml = self.text('scene.yaml')
        self.assertEqual((numbers_of(yaml, 'start'), numbers_of(yaml, 'goal')), ([0, -1, 0], [15, -5, 1.5]))
        square, bar, arrow = (sorted(map(tuple, polygon)) for polygon in polygons_of(yaml))
        self.assertEqual(square, [(2, -6), (2, -4), (4, -6), (4, -4)])  # translated, y upwards
        self.assertEqual(bar, [(10, -11), (10, -10), (12, -11), (12, -10)])
        self.assertEqual(arrow, [(20, -14), (20, -10), (24, -14), (24, -10)])  # the hull
        self.assertIn('name: \'bench_mr\'', yaml)
        car = json.loads(re.sub(r'(\w+):', r'"\1":', re.search(r'vehicle: (.*)', yaml).group(1)).replace("'", '"'))
        self.assertAlmostEqual(car['wheelbase'] / math.tan(car['max_steering_angle']), 4.0)
        self.assertAlmostEqual(car['rear_overhang'], car['wheelbase'] + car['front_overhang'])

    def test_scenes_without_start_or_goal_are_refused_with_what_helps(self):
        self.write('scene.svg', SCENE)
        start, goal = ('--start', '0,-1,0'), ('--goal', '15,-5,1.5')
        both = 'neither start nor goal; parking_convert takes --start X,Y,YAW and --goal X,Y,YAW (of the middle of the body)'
        self.assertIn(both, self.refused('scene.svg', 'other.yaml'))
        self.assertIn('no goal; parking_convert takes --goal X', self.refused('scene.svg', 'other.yaml', *start))
        self.assertIn('no start; parking_convert takes --start X', self.refused('scene.svg', 'other.yaml', *goal))
        self.assertIn('of the middle of the rear axle', self.refused('scene.svg', 'other.yaml', '--vehicle', 'vw_golf8'))
        # Programs without such options say who has them, and it does help.
        self.refused_plan('scene.svg', parts=[both])
        self.assert_refused(self.run_program(QUERIES, '--output', 'q', '--from', 'scene.svg'), both)
        self.convert('scene.svg', 'whole.svg', *start, *goal)
        self.assertEqual(self.planned('whole.svg')['status'], 'exact')

    def test_every_program_reads_every_format(self):
        self.write('case.csv', CASE)
        for name in ['case.csv', 'a.yaml', 'b.svg'] + (['d.mat'] if self.has_mat_files() else []):
            if name != 'case.csv':
                self.convert('case.csv', name, '--vehicle', 'tpcap')
            self.assertEqual(self.planned(name, '--vehicle', 'tpcap')['status'], 'exact')
            done = self.run_program(QUERIES, '--output', 'from ' + name, '--from', name, '--queries', 1)
            self.assertEqual((done.returncode, done.stderr), (0, ''))

    def test_scenes_that_are_none(self):
        for text, word in ((SCENE.replace('h -2', 'c -2,1 0,0 1,1'), "'c'"), (SCENE.replace('112', 'x'), 'x'),
                           (SCENE.replace('translate(', 'rotate('), 'rotate'), ('<svg></svg>', 'no path'),
                           (SCENE.replace('H 112 V 61 h -2', 'H 112'), 'no area'), ('<svg\n d="m 1', 'not closed'),
                           (SCENE.replace('M 110,60', '110,60'), 'm or M')):
            self.write('scene.svg', text)
            self.assertIn(word, self.refused('scene.svg', 'out.yaml', '--start', '0,-1,0', '--goal', '15,-5,1.5'))

    def test_scenes_that_were_cut_off(self):
        whole = SCENE.index('</svg>') + len('</svg>')
        poses = ['--start', '0,-1,0', '--goal', '15,-5,1.5']
        for length in [*range(SCENE.index('<svg') + 4, whole, 7), whole - 1]:
            self.write('scene.svg', SCENE[:length])
            self.assertIn('scene.svg', self.refused('scene.svg', 'out.yaml', *poses))
        self.write('scene.svg', SCENE[:whole])
        self.convert('scene.svg', 'out.yaml', *poses)

    def test_cases_of_commonparking(self):
        self.needs_mat_files()
        self.write('case.csv', CASE)
        self.convert('case.csv', 'Case07.mat')
        case = MatFile(self.path('Case07.mat')).variables['caseData']
        self.assertEqual(case['id'], [7])
        self.assertEqual({name: value[0] for name, value in case['task'].items()},
                         {'x0': 0, 'y0': 0, 'theta0': 0.1, 'xf': 8, 'yf': 1, 'thetaf': -1.2})
        self.assertEqual(case['obstacle']['num_obs'], [2])
        first = case['obstacle']['obs'][0]
        self.assertEqual((first['x'], first['y']), ([2, 4, 4, 2, 2], [2, 2, 4, 4, 2]))  # closed, counter-clockwise
        self.assertEqual((first['num_grids'], first['area']), ([4], [4]))
        self.convert('Case07.mat', 'back.yaml', '--check')
        self.assertIn('max_steering_angle: 0.7,', self.text('back.yaml'))

    def test_the_other_programs_read_them_too(self):
        self.write('scene.svg', SCENE.replace('<svg\n', '<svg\n data-start="0 -1 0"\n data-goal="8 -1 0"\n'))
        self.assertEqual(self.planned('scene.svg')['status'], 'exact')
        self.needs_mat_files()
        self.write('case.csv', CASE)
        os.mkdir(self.path('cases'))
        self.convert('case.csv', 'cases/Case07.mat')
        result = self.planned('cases/Case07.mat')
        self.assertEqual((result['status'], result['vehicle']['max_steering_angle']), ('exact', 0.7))
        self.write('a.cfg', '[problem]\nscenario = cases\n[benchmark]\nrun_count = 1\n[planner]\nimproved_astar=\n')
        self.assertIn('Case07', self.benchmark('a.cfg', '--output', 'out').stdout)

    def test_files_of_matlab_that_are_none(self):
        self.needs_mat_files()
        self.write('case.csv', CASE)
        self.convert('case.csv', 'good.mat')
        with open(self.path('good.mat'), 'rb') as stream:
            good = stream.read()
        for content, word in ((b'MATLAB 7.3 MAT-file' + good[19:], '7.3'), (good[:200], 'caseData'),
                              (b'MATLAB 4.2' + good[10:], 'MATLAB 5'), (good[:128], 'caseData'),
                              (good[:124] + b'\x00\x02' + good[126:], '7.3'), (good[:124] + b'ab' + good[126:], 'MATLAB 5')):
            self.write('bad.mat', content)
            self.assertIn(word, self.refused('bad.mat', 'out.yaml'))
        self.assertFalse(os.path.exists(self.path('out.yaml')))

    def test_the_check_finds_what_is_wrong(self):
        self.write('case.csv', CASE.replace('8,1,-1.2', '3,3,0'))  # into the first obstacle
        done = self.convert('case.csv', '--check', status=1)
        self.assertIn('the goal is in collision', done.stdout)
        # An obstacle that is not convex loses a corner in Bench-MR's format.
        self.write('case.csv', '0,0,0,9,0,0,1,5,3,3,6,3,4,4,6,6,3,6\n')
        self.assertIn('convex', self.convert('case.csv', 'out.svg', '--check', status=1).stdout)

    def test_what_no_planner_takes_is_refused_by_all(self):
        self.write('case.csv', CASE)
        far = '1e300,0,0'
        for option, limit in (('--start', 'at most 10000000000 m'), ('--goal', 'at most 100000 m')):
            self.assertIn('case.csv', self.refused('case.csv', '--check', option, far))
            self.assertIn(limit, self.refused('case.csv', 'out.yaml', option, far))
        self.assertIn('at most 100000 m', self.refused('case.csv', 'out.yaml', '--start', '0,100020,0'))
        self.convert('case.csv', 'ok.yaml', '--check', '--start', '0,99990,0')
        self.write('knot.csv', '0,0,0,9,0,0,1,4,20,20,22,22,22,20,20,22\n')
        self.write('knot.yaml', 'start: [0, 0, 0]\ngoal: [9, 0, 0]\npolygons: [[[20, 20], [22, 22], [22, 20], [20, 22]]]\n')
        for name in ('knot.csv', 'knot.yaml'):
            parts = [name, 'polygon 1 crosses itself']
            for part in parts:
                self.assertIn(part, self.refused(name, '--check'))
            self.refused_plan(name, parts=parts)
            self.assert_refused(self.run_program(QUERIES, '--output', 'q', '--from', name), *parts)
        self.assertEqual(sorted(os.listdir(self.folder)), ['case.csv', 'knot.csv', 'knot.yaml', 'ok.yaml'])

    def test_pipes_and_devices(self):
        self.write('case.csv', CASE)
        for command in ('cat case.csv | %s /dev/stdin a.yaml --check', '%s <(cat case.csv) b.yaml --check'):
            done = self.run_program('bash', '-c', command % CONVERT)
            self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(self.text('a.yaml'), self.text('b.yaml'))
        result = json.dumps(self.planned('case.csv', '--trajectory'))
        done = self.run_program(CONVERT, '/dev/stdin', 'out.csv', '--check', input=result)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        for name in ('/dev/zero', '/'):
            self.assertIn(name + ': is a', self.refused(name, 'c.yaml'))
        self.write('long.csv', CASE + ' ' * (17 << 20))
        self.assertIn('16 MiB', self.refused('long.csv', 'c.yaml'))
        self.assertFalse(os.path.exists(self.path('c.yaml')))

    def test_the_map_of_a_scenario_is_not_written_over(self):
        self.write('map.yaml', 'image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n')
        self.write('map.pgm', b'P5\n100 100\n255\n' + b'\xfe' * 10000)
        self.write('on_map.yaml', 'map: map.yaml\nstart: [2, 2, 0]\ngoal: [5, 2, 0]\n')
        for name in ('on_map.yaml', 'map.yaml', 'map.pgm'):
            self.assertIn(name + "' is the input", self.refused('on_map.yaml', name, '--to', 'yaml'))
        self.convert('on_map.yaml', 'other.yaml', '--check')

    def test_one_is_one(self):
        self.write('case.csv', '0,0,0,9,0,0,1,3,20,20,22,20,22,22\n')
        self.assertRegex(self.convert('case.csv', '--check').stdout, ', 1 obstacle$')
        self.write('result.json', json.dumps(self.planned('case.csv', '--trajectory')))
        self.assertIn(' in 1 stretch, trajectory', self.convert('result.json', '--check').stdout)
        self.assertEqual(self.convert('--hope', 'normal', 'hope', '--count', 1).stdout, '1 problem: hope\n')

    def test_bad_usage_is_one_line(self):
        self.write('case.csv', CASE)
        for arguments, word in ((['case.csv'], 'OUTPUT'), ([], 'INPUT'), (['case.csv', 'x.doc'], '.yaml'),
                                (['case.csv', 'x.yaml', '--to', 'yml'], 'yaml'), (['none.csv', 'x.yaml'], 'none.csv'),
                                (['case.csv', 'x.yaml', 'y.yaml'], 'y.yaml'), (['case.csv', 'case.csv'], 'input'),
                                (['case.csv', '-', '--to', 'yaml'], "'-'"),
                                (['case.csv', 'x.yaml', '--goal', '1,2'], 'X,Y,YAW'),
                                (['case.csv', 'no/such/x.yaml'], 'no/such'), (['--hope', 'hard', 'x'], 'extreme'),
                                (['case.csv', 'x.yaml', '--vehicle', ''], '--vehicle'),
                                (['case.csv', 'x.yaml', '--count', '3'], '--hope only'),
                                (['case.csv', 'x.yaml', '--seed', '3'], '--seed goes'),
                                (['case.csv', '--check', '--to', 'yaml'], '--to is'),
                                (['--hope', 'normal', 'x', '--start', '0,0,0'], '--start changes'),
                                (['--hope', 'normal', 'x', '--goal', '0,0,0'], '--goal changes'),
                                (['--hope', 'normal', 'x', '--vehicle', 'tpcap'], '--vehicle changes'),
                                (['--hope', 'normal'], 'folder'), (['--hope', 'normal', 'x', '--count', '-1'], 'count')):
            self.assertIn(word, self.refused(*arguments))

    def test_help_has_examples_of_every_format(self):
        done = self.convert('--help')
        for word in ('benchmr', 'commonparking', 'tpcap', 'yaml', 'extreme', 'Examples:', 'commonparking-trajectory'):
            self.assertIn(word, done.stdout)
        for extension in ('.mat', '.svg', '.csv', '.yaml'):
            self.assertIn(extension, self.plan('--help').stdout)

    @unittest.skipUnless(os.path.isdir(os.path.join(SHARED_DATA, 'tpcap')), 'no TPCAP cases')
    def test_tpcap_cases(self):
        folder = os.path.join(SHARED_DATA, 'tpcap')
        for name in sorted(os.listdir(folder)):
            self.convert(os.path.join(folder, name), 'out.yaml', '--check')


class HopeTest(ConvertTest):
    def test_levels_are_free_repeatable_and_as_tight_as_published(self):
        length, width = 4.69, 1.94
        for level in ('normal', 'complex', 'extreme', 'dlp'):
            self.convert('--hope', level, 'a', '--count', '6', '--seed', '5', '--check')
            self.convert('--hope', level, 'b', '--count', '6', '--seed', '5', '--to', 'tpcap')
            for seed in range(5, 11):
                name = f'hope_{level}_{seed}'
                yaml = self.text(f'a/{name}.yaml')
                goal, case = numbers_of(yaml, 'goal'), [float(each) for each in self.text(f'b/{name}.csv').split(',')]
                self.assertEqual([round(each, 9) for each in case[:6]],
                                 [round(each, 9) for each in numbers_of(yaml, 'start') + goal])
                if level == 'dlp':
                    self.assertGreater(len(polygons_of(yaml)), 200)
                    continue
                # The goal lies along the kerb or across it; its room on both sides together is the level's.
                self.assertLess(min(abs(math.remainder(goal[2], math.pi)),
                                    abs(math.remainder(goal[2] - 0.5 * math.pi, math.pi))), math.pi / 12 + 1e-9)
                parallel = abs(math.cos(goal[2])) > 0.7
                self.assertTrue(parallel or level != 'extreme')
                self.assertEqual(parallel, length * abs(math.cos(goal[2])) > width)

    def test_seeds_differ(self):
        self.convert('--hope', 'complex', 'a', '--count', '2')
        self.assertNotEqual(self.text('a/hope_complex_1.yaml'), self.text('a/hope_complex_2.yaml'))


class ResultsTest(ConvertTest):
    def result(self):
        self.planned(os.path.join(SCENARIOS, 'parallel.yaml'), '--trajectory', '--vehicle', 'tpcap')
        result = self.planned(os.path.join(SCENARIOS, 'parallel.yaml'), '--trajectory')
        result['scenario'] = 'Case07'
        self.write('result.json', json.dumps(result))
        return result

    def test_paths_for_commonparking(self):
        self.needs_mat_files()
        result = self.result()
        self.convert('result.json', 'out.mat', '--check')
        found = MatFile(self.path('out.mat')).variables['result']
        self.assertEqual((found['schema_version'], found['kind'], found['case_id'], found['reference_point']),
                         ('CommonParking-result-1', 'path', [7], 'rear_axle_midpoint'))
        self.assertEqual((found['status']['success'], found['trajectory']), ([1], []))
        path = found['path']
        self.assertAlmostEqual(path['s'][-1], result['length_m'], delta=1e-6)
        self.assertEqual(len(path['cusp_indices']), result['cusps'] + 2)
        for name, member in (('x', 'x'), ('y', 'y')):
            self.assertAlmostEqual(path[name][0], result['path'][0][member], delta=1e-9)
            self.assertAlmostEqual(path[name][-1], result['path'][-1][member], delta=1e-6)
        # The arcs, integrated here, pass through every sample with its heading and steering.
        x, y, yaw = path['geometry']['start']
        lengths, curvatures = zip(*path['geometry']['primitives'])
        k, begin = 0, 0.0
        wheelbase = result['vehicle']['wheelbase']
        for index, place in enumerate(path['s']):
            while k + 1 < len(lengths) and place >= begin + abs(lengths[k]) - 1e-12:
                begin, way = begin + abs(lengths[k]), lengths[k]
                turn = way * curvatures[k]
                chord = way * (math.sin(0.5 * turn) / (0.5 * turn) if turn else 1.0)
                x, y, yaw = x + chord * math.cos(yaw + 0.5 * turn), y + chord * math.sin(yaw + 0.5 * turn), yaw + turn
                k += 1
            way = math.copysign(place - begin, lengths[k])
            turn = way * curvatures[k]
            chord = way * (math.sin(0.5 * turn) / (0.5 * turn) if turn else 1.0)
            self.assertLess(abs(x + chord * math.cos(yaw + 0.5 * turn) - path['x'][index]), 1e-6)
            self.assertLess(abs(y + chord * math.sin(yaw + 0.5 * turn) - path['y'][index]), 1e-6)
            self.assertLess(abs(math.remainder(yaw + turn - path['theta'][index], 2.0 * math.pi)), 1e-6)
            self.assertLess(abs(math.atan(wheelbase * curvatures[k]) - path['phi'][index]), 1e-6)

    def test_trajectories(self):
        result = self.result()
        samples = result['planned_trajectory']
        self.convert('result.json', 'out.csv', '--check')
        lines = self.text('out.csv').splitlines()
        self.assertEqual(len(lines), 1 + len(samples))
        self.assertEqual([float(each) for each in lines[-1].split(',')][:5],
                         [samples[-1][name] for name in ('t', 'x', 'y', 'yaw', 'v')])
        self.needs_mat_files()
        self.convert('result.json', 'out.mat', '--to', 'commonparking-trajectory', '--check')
        found = MatFile(self.path('out.mat')).variables['result']
        self.assertEqual(found['kind'], 'trajectory')
        for name, member in (('t', 't'), ('x', 'x'), ('v', 'v'), ('phi', 'steering'), ('a', 'acceleration')):
            self.assertEqual(found['trajectory'][name], [sample[member] for sample in samples])

    def test_results_that_are_none(self):
        result = self.result()
        for option, value in (('--vehicle', 'tpcap'), ('--start', '0,0,0'), ('--goal', '0,0,0')):
            self.assertIn(option + ' changes a problem', self.refused('result.json', 'out.csv', option, value))
        del result['planned_trajectory']
        self.write('plain.json', json.dumps(result))
        for name, extra in (('out.csv', []), ('out.csv', ['--to', 'tpcap-trajectory']),
                            ('out.mat', ['--to', 'commonparking-trajectory'])):
            self.assertIn('plain.json: the result has no trajectory', self.refused('plain.json', name, *extra))
            self.assertIn('plan with --trajectory or --track', self.refused('plain.json', name, *extra))
        self.assertIn('--to: commonparking-path (.mat), commonparking-trajectory (.mat), tpcap-trajectory (.csv)',
                      self.refused('plain.json', 'out.txt'))
        result['path'] = []
        self.write('plain.json', json.dumps(result))
        self.assertIn('no path', self.refused('plain.json', 'out.mat'))
        self.write('plain.json', '{"planner": 3}')
        self.assertIn('format is missing', self.refused('plain.json', 'out.mat'))
        self.assertIn('no result', self.refused('plain.json', 'out.mat'))
        self.write('plain.json', '{')
        self.assertIn('no result', self.refused('plain.json', 'out.mat'))

    def test_fields_that_are_wrong_are_named(self):
        result = self.result()
        gone = object()

        def refused(place, value, *parts):
            """Of the result with one value changed or gone, the message has all of these parts in it."""
            changed = json.loads(json.dumps(result))
            *folders, last = place
            at = changed
            for each in folders:
                at = at[each]
            if value is gone:
                del at[last]
            else:
                at[last] = value
            with self.subTest(place=place, value=value):
                self.write('wrong.json', json.dumps(changed))
                message = self.refused('wrong.json', 'out.csv')
                for part in ('wrong.json: ', *parts):
                    self.assertIn(part, message)
                self.assertFalse(os.path.exists(self.path('out.csv')))

        for name in ('planner', 'status', 'planning_time_ms', 'vehicle', 'path'):
            refused([name], gone, f': {name} is missing')
        for place, name in ((['vehicle', 'wheelbase'], 'vehicle.wheelbase'), (['path', 7, 'x'], 'path[7].x'),
                            (['path', 7, 'curvature'], 'path[7].curvature'), (['path', 7, 'direction'], 'path[7].direction'),
                            (['planned_trajectory', 9, 'v'], 'planned_trajectory[9].v')):
            refused(place, gone, f'{name} is missing')
            refused(place, None, f'{name} is null; it must be a finite number')
            refused(place, 'wide', f"{name} is 'wide'; it must be a finite number")
            refused(place, [1], f'{name} is a list; it must be a finite number')
        for place, value, *parts in (
                (['format'], 2, 'format is 2; it must be 1'), (['format'], '1', "format is '1'"),
                (['planner'], 3, 'planner is 3', 'word'),
                (['status'], 'solved', "status is 'solved'", 'exact'), (['status'], 'timeout', "'timeout'", 'exact'),
                (['scenario'], 7, 'scenario is 7'), (['planning_time_ms'], 3.0, 'planning_time_ms is 3.0', 'a list'),
                (['planning_time_ms'], [], 'planning_time_ms is an empty list'),
                (['planning_time_ms'], [-1], 'planning_time_ms[0] is -1'),
                (['vehicle'], 'golf', "vehicle is 'golf'", 'object'), (['vehicle', 'width'], 0, 'width is 0'),
                (['vehicle', 'max_steering_angle'], 2, 'max_steering_angle is 2'),
                (['path'], {'x': 1}, 'path is an object', 'a list'),
                (['path', 3], 5, 'path[3] is 5'), (['path', 3, 'direction'], 0, 'path[3].direction is 0', '1 or -1'),
                (['path', 3, 'x'], float('nan'), 'no result', 'line 1, ', '"x": N'),
                (['path', 3, 'y'], 1e300, 'path[3] does not follow'),
                (['path', 3, 'y'], result['path'][3]['y'] + 0.1, 'path[3] does not follow', 'm and'),
                (['path', 3, 'yaw'], result['path'][3]['yaw'] + 0.1, 'path[3] does not follow'),
                (['path', 3, 'direction'], -result['path'][3]['direction'], 'path[3] does not follow'),
                (['planned_trajectory', 8, 't'], 0.0, 'planned_trajectory[8].t is 0.0', 'more than'),
                (['planned_trajectory', 8, 'x'], 1e4, 'planned_trajectory[8] lies', 'in 0.0'),
                (['planned_trajectory'], 'none', "planned_trajectory is 'none'")):
            refused(place, value, *parts)


if __name__ == '__main__':
    main()
