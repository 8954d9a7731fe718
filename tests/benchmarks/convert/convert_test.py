"""parking_convert: every format into every other and back, results as CommonParking takes them, HOPE's levels, bad input."""

import contextlib
import io
import json
import math
import os
import subprocess
import sys
import unittest

import numpy as np
import scipy.io

import improved_astar as ia
from convert import hope, program
from convert.mersenne import Random
from convert.scenarios import merged_cells

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'programs'))

from programs import SCENARIOS, SHARED_DATA, ProgramTest, bundled, main  # noqa: E402

CONVERT = os.environ['PARKING_CONVERT']
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
def parkbench_scene(obstacles, target=(1, 4, math.pi / 2), areas=False, origins=((10, -5), (9, -7))):
    """A scene of ParkBench with these polylines."""
    posture = {'m_pose': list(target), 'm_curvature': 0.0}
    request = {'m_startPosture': {'m_pose': [-8.0, -3.0, 0.5], 'm_curvature': 0.0}}
    request.update({'m_targetAreas': {'m_targetPosture': [posture]}} if areas else {'m_targetArea': {'m_targetPosture': posture}})
    frame = {'PlanningRequest': request, 'NfmAggregatedPolygonObjects': [
        {'nfmPolygonObjectNodes': [{'m_x': x, 'm_y': y, 'm_height': 'LOW'} for x, y in each]} for each in obstacles]}
    if origins:
        request['m_origin'], frame['m_nfmOrigin'] = map(list, origins)
    return json.dumps({'CommonParameters': 'default', 'Frames': {'0': frame}})


POSES = ('--start', '0,-1,0', '--goal', '15,-5,1.5')


class ConvertTest(ProgramTest):
    """Runs the program within the test; the program as it is started is left to LaunchedTest."""

    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def convert(self, *arguments, status=0):
        """What is printed; errors too when that is what it ends with."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            found = program.run(list(map(str, arguments)))
        self.assertEqual(found, status, out.getvalue() + err.getvalue())
        if status == 2:
            self.assertEqual((out.getvalue(), err.getvalue().count('\n')), ('', 1), err.getvalue())
        return out.getvalue() + err.getvalue()

    def refused(self, *arguments, parts=()):
        message = self.convert(*arguments, status=2)
        for part in parts:
            self.assertIn(part, message)
        return message


class ProblemsTest(ConvertTest):
    def test_round_trips_lose_nothing(self):
        self.write('case.csv', CASE)
        names = ['case.csv', 'a.yaml', 'b.svg', 'c.yaml', 'd.mat', 'e.yaml', 'f.csv']
        for before, after in zip(names, names[1:]):
            self.convert(before, after, '--check', '--vehicle', 'tpcap')
        numbers = [float(each) for each in self.read('f.csv').split(',')]
        self.assertEqual(numbers[:9], [0, 0, 0.1, 8, 1, -1.2, 2, 4, 3])
        wanted = [float(each) for each in CASE.split(',')]
        self.assertEqual(sorted(zip(numbers[9::2], numbers[10::2])), sorted(zip(wanted[9::2], wanted[10::2])))

    @unittest.skipUnless(os.path.isdir(os.path.join(SHARED_DATA, 'tpcap')), 'no TPCAP cases')
    def test_tpcap_cases(self):
        folder = os.path.join(SHARED_DATA, 'tpcap')
        for name in sorted(os.listdir(folder)):
            self.convert(os.path.join(folder, name), 'out.yaml', '--check')
            self.convert('out.yaml', 'out.mat', '--check')

    def test_maps_become_polygons_and_keep_their_walls(self):
        self.convert(bundled('underground_garage'), 'garage.yaml', '--check')
        garage = self.planned('garage.yaml')
        self.assertEqual(garage['status'], 'exact')
        low = min(polygon[:, 0].min() for polygon in ia.Scenario.read('garage.yaml').polygons)
        self.assertGreater(min(state['x'] for state in garage['path']), low)

    def test_merged_cells_cover_each_occupied_cell_once(self):
        random = np.random.default_rng(1)
        for rows, columns in ((1, 1), (1, 7), (6, 1), (5, 5), (40, 30)):
            for share in (0.0, 0.2, 0.6, 1.0):
                occupied = random.random((rows, columns)) < share
                covered = np.zeros((rows, columns), dtype=int)
                for begin, low, end, high in merged_cells(occupied):
                    covered[low:high, begin:end] += 1
                self.assertTrue(np.array_equal(covered, occupied))

    def test_scenes_are_read_as_bench_mr_reads_them(self):
        self.write('scene.svg', SCENE)
        self.convert('scene.svg', 'scene.yaml', *POSES)
        scenario = ia.Scenario.read('scene.yaml')
        self.assertEqual((scenario.start, scenario.goals), ((0, -1, 0), [(15, -5, 1.5)]))
        square, bar, arrow = (sorted(map(tuple, polygon)) for polygon in scenario.polygons)
        self.assertEqual(square, [(2, -6), (2, -4), (4, -6), (4, -4)])  # translated, y upwards
        self.assertEqual(bar, [(10, -11), (10, -10), (12, -11), (12, -10)])
        self.assertEqual(arrow, [(20, -14), (20, -10), (24, -14), (24, -10)])  # the hull
        car = scenario.vehicle
        self.assertEqual(car.name, 'bench_mr')
        self.assertAlmostEqual(car.turning_radius, 4.0)
        self.assertAlmostEqual(car.rear_overhang, car.wheelbase + car.front_overhang)

    def test_scenes_without_start_or_goal_are_refused_with_what_helps(self):
        self.write('scene.svg', SCENE)
        for options, part in (((), 'neither start nor goal; give --start X,Y,YAW and --goal X,Y,YAW (of the middle of the body)'),
                              (POSES[:2], 'no goal; give --goal X'), (POSES[2:], 'no start; give --start X'),
                              (('--vehicle', 'vw_golf8'), 'of the middle of the rear axle')):
            self.refused('scene.svg', 'other.yaml', *options, parts=['scene.svg: ', part])
        self.convert('scene.svg', 'whole.svg', *POSES)  # has both
        self.convert('whole.svg', 'other.yaml', '--check')

    def test_scenes_that_are_none(self):
        for text, part in ((SCENE.replace('h -2', 'c -2,1 0,0 1,1'), "'c'"), (SCENE.replace('112', 'x'), "no number at 'x'"),
                           (SCENE.replace('translate(', 'rotate('), 'rotate'), ('<svg></svg>', 'no path'),
                           (SCENE.replace('H 112 V 61 h -2', 'H 112'), 'obstacle 2 has no area'), ('<svg\n d="m 1', 'not a complete SVG'),
                           (SCENE.replace('M 110,60', '110,60'), 'm or M'), (SCENE.replace('h -2', 'h'), "no number at 'z'"),
                           (SCENE.replace('<svg', '<svg data-goal="1 2"'), 'data-goal must be x, y and yaw')):
            self.write('scene.svg', text)
            with self.subTest(part=part):
                self.refused('scene.svg', 'out.yaml', *POSES[:2], parts=['scene.svg: ', part])
        whole = SCENE.index('</svg>') + len('</svg>')
        for length in [*range(SCENE.index('<svg') + 4, whole, 7), whole - 1]:
            self.write('scene.svg', SCENE[:length])
            self.refused('scene.svg', 'out.yaml', *POSES, parts=['scene.svg: '])

    def test_cases_of_commonparking(self):
        self.write('case.csv', CASE)
        self.convert('case.csv', 'Case07.mat')
        case = scipy.io.loadmat('Case07.mat', simplify_cells=True)['caseData']
        self.assertEqual((case['id'], case['task']), (7, {'x0': 0, 'y0': 0, 'theta0': 0.1, 'xf': 8, 'yf': 1, 'thetaf': -1.2}))
        self.assertEqual(case['obstacle']['num_obs'], 2)
        first = case['obstacle']['obs'][0]
        self.assertEqual((first['x'].tolist(), first['y'].tolist()), ([2, 4, 4, 2, 2], [2, 2, 4, 4, 2]))  # closed
        self.assertEqual((first['num_grids'], first['area']), (4, 4))
        self.convert('Case07.mat', 'back.yaml', '--check')
        self.assertIn('max_steering_angle: 0.7,', self.read('back.yaml'))
        for compressed in (True, False):
            for change, part in ((lambda case: case.pop('task'), 'caseData has no field task'),
                                 (lambda case: case['task'].pop('yf'), 'caseData.task has no field yf'),
                                 (lambda case: case['task'].update(x0='one'), 'caseData.task.x0 must be a vector of numbers'),
                                 (lambda case: case['task'].update(x0=np.nan), 'caseData.task.x0 contains nan'),
                                 (lambda case: case['task'].update(x0=[1.0, 2.0]), 'task.x0 must be one number, not 2'),
                                 (lambda case: case['obstacle'].update(num_obs=3), 'cell array of num_obs = 3 obstacles'),
                                 (lambda case: case['obstacle']['obs'][1].update(x=[1.0, 2.0]), 'obs{2} has 2 x and 4 y')):
                case = scipy.io.loadmat('Case07.mat', simplify_cells=True)['caseData']
                change(case)
                case['obstacle']['obs'] = np.array(case['obstacle']['obs'], dtype=object)
                scipy.io.savemat('wrong.mat', {'caseData': case}, do_compression=compressed)
                self.refused('wrong.mat', '--check', parts=['wrong.mat: ', part])

    def test_scenes_of_parkbench(self):
        car = ia.Vehicle('tpcap')
        side, front, back = 0.5 * car.width, car.wheelbase + car.front_overhang, car.rear_overhang
        # Relative to the goal. Under the car: a stop on both sides, one within it, and ones that enter it behind and ahead.
        given = [[(-9, 7), (-9, 9), (-7, 9)], [(0, -2), (0, 2)], [(0, -0.5), (0, 0.5)], [(0, 0), (-3, 0)], [(3, 0), (6, 0)],
                 [(-1, side + 0.05), (1, side + 0.05)]]
        wanted = [[(-9, 7), (-9, 9)], [(-9, 9), (-7, 9)], [(0, -2), (0, -side - 0.1)], [(0, side + 0.1), (0, 2)],
                  [(-back - 0.1, 0), (-3, 0)], [(front + 0.1, 0), (6, 0)], given[-1]]
        for areas, origins, goal in ((False, ((10, -5), (9, -7)), (2, 6, 0.5)), (True, None, (1, 4, -2.0))):
            def placed(points):
                turn = np.exp(1j * goal[2])
                return [(z.real, z.imag) for z in (complex(*goal[:2]) + turn * complex(*point) for point in points)]
            target = np.subtract(goal, (1, 2, 0) if origins else 0).tolist()
            self.write('scene.json', parkbench_scene(map(placed, given), target, areas, origins))
            self.assertNotIn('collision', self.convert('scene.json', 'scene.yaml', '--check'))
            scenario = ia.Scenario.read('scene.yaml')
            np.testing.assert_allclose(scenario.start, (-7, -1, 0.5) if origins else (-8, -3, 0.5))
            np.testing.assert_allclose(scenario.goals[0], goal)
            self.assertEqual(len(scenario.polygons), len(wanted))
            for polygon, segment in zip(scenario.polygons, wanted):
                np.testing.assert_allclose(polygon, placed(segment), atol=1e-9)
        self.write('scene.json', parkbench_scene([[(-1, 4), (3, 4)]], origins=None))  # a wheel stop
        self.convert('scene.json', 'scene.yaml')
        self.assertEqual(self.planned('scene.yaml')['status'], 'exact')

    def test_a_larger_car_stands_over_more_obstacles_of_parkbench(self):
        self.write('scene.json', parkbench_scene([[(0.05, 4), (0.05, 6)]], origins=None))  # 0.95 m from the axle's middle
        for car, count in (('vw_golf8', 1), ('lincoln_mkz', 0)):
            self.convert('scene.json', 'scene.yaml', '--vehicle', car)
            self.assertEqual(len(ia.Scenario.read('scene.yaml').polygons), count, car)

    def test_outliers_of_parkbench_are_left_out(self):
        start = (-8, -3)
        for direction, across in (((1, 0), (0, 1)), ((-1, 0), (0, 1)), ((0, 1), (1, 0)), ((0, -1), (1, 0))):
            for away, ends, count in ((99.9, 1, 1), (100.1, 1, 0), (1000, 1, 0), (99.9, 150, 1)):
                segment = [tuple(at + away * along + end * side for at, along, side in zip(start, direction, across))
                           for end in (-ends, ends)]
                self.write('scene.json', parkbench_scene([segment], origins=None))
                self.convert('scene.json', 'scene.yaml')
                self.assertEqual(len(ia.Scenario.read('scene.yaml').polygons), count, segment)

    def test_scenes_of_parkbench_that_are_none(self):
        whole = parkbench_scene([[(6, 0), (8, 1)]])
        for old, new, part in (('"m_startPosture"', '"m_start"', 'Frames.0.PlanningRequest.m_startPosture is missing'),
                               ('"m_targetArea"', '"m_target"', 'PlanningRequest.m_targetArea is missing'),
                               ('[-8.0, -3.0, 0.5]', '[-8.0, -3.0]', 'm_pose is a list; it must be a list of 3 numbers'),
                               ('[-8.0, ', '["x", ', "m_pose[0] is 'x'; it must be a finite number"),
                               ('"m_x": 8', '"m_x": true', 'nfmPolygonObjectNodes[1].m_x is true'),
                               ('"m_x": 8', '"m_x": NaN', 'not a scene of ParkBench: NaN is not a number'),
                               (', {"m_x": 8, "m_y": 1, "m_height": "LOW"}', '', 'must be a list of two or more nodes'),
                               ('"0"', '"1"', 'Frames.0 is missing'), ('[9, -7]', '[9]', 'm_nfmOrigin is a list'),
                               ('[1, 4, ', '[1e7, 4, ', 'm from the start')):
            self.assertIn(old, whole)
            self.write('scene.json', whole.replace(old, new))
            with self.subTest(part=part):
                self.refused('scene.json', 'out.yaml', parts=['scene.json: ', part])
        for length in range(whole.index('Objects"') + 9, len(whole), 11):
            self.write('scene.json', whole[:length])
            self.refused('scene.json', 'out.yaml', parts=['scene.json: not a scene of ParkBench: '])
        self.write('scene.json', parkbench_scene([], areas=True).replace('[{"m_pose"', '[], "x": [{"m_pose"'))
        self.refused('scene.json', 'out.yaml', parts=['m_targetPosture is an empty list; it must be a list of targets'])
        self.write('case.csv', CASE)
        self.refused('case.csv', 'out.json', parts=['.json'])  # read only
        self.refused('case.csv', 'out', '--to', 'parkbench', parts=['parkbench'])

    @unittest.skipUnless(os.path.isdir(os.path.join(SHARED_DATA, 'parkbench')), 'no scenes of ParkBench')
    def test_every_scene_of_parkbench(self):
        folder = os.path.join(SHARED_DATA, 'parkbench')
        for name in sorted(os.listdir(folder)):
            if name.endswith('.json'):
                self.convert(os.path.join(folder, name), 'out.yaml', '--check')

    def test_other_programs_name_the_command_that_helps(self):
        self.write('case.csv', CASE)
        self.convert('case.csv', 'Case07.mat')
        self.write('scene.svg', SCENE)
        self.write('scene.json', parkbench_scene([]))
        for name, command in (('scene.json', 'parking_convert scene.json scene.yaml'), ('Case07.mat', 'parking_convert Case07.mat Case07.yaml'),
                              ('scene.svg', 'parking_convert scene.svg scene.yaml --start X,Y,YAW --goal X,Y,YAW')):
            self.refused_plan(name, parts=[f'{name}: is a', command])
            self.write('a.cfg', f'[problem]\nscenario = {name}\n[benchmark]\nrun_count = 1\n[planner]\nimproved_astar=\n')
            self.refused_benchmark('a.cfg', '--output', 'out', parts=[command])
            self.convert(*command.replace('X,Y,YAW', '1,-9,0').split()[1:])
            self.assertEqual(ia.Scenario.read(f'{name.split(".")[0]}.yaml').name, name.split('.')[0])

    def test_the_check_finds_what_is_wrong(self):
        self.write('case.csv', CASE.replace('8,1,-1.2', '3,3,0'))  # into the first obstacle
        self.assertIn('the goal is in collision', self.convert('case.csv', '--check', status=1))
        # An obstacle that is not convex loses a corner in Bench-MR's format.
        self.write('case.csv', '0,0,0,9,0,0,1,5,3,3,6,3,4,4,6,6,3,6\n')
        self.assertIn('convex', self.convert('case.csv', 'out.svg', '--check', status=1))

    def test_what_no_planner_takes_is_refused(self):
        self.write('case.csv', CASE)
        for option, limit in (('--start', 'at most 10000000000 m'), ('--goal', 'at most 100000 m')):
            self.refused('case.csv', 'out.yaml', option, '1e300,0,0', parts=['case.csv: ', limit])
        self.refused('case.csv', 'out.yaml', '--start', '0,100020,0', parts=['at most 100000 m'])
        self.convert('case.csv', 'ok.yaml', '--check', '--start', '0,99990,0')
        self.write('knot.csv', '0,0,0,9,0,0,1,4,20,20,22,22,22,20,20,22\n')
        self.refused('knot.csv', '--check', parts=['knot.csv: ', 'polygon 1 crosses itself'])
        self.write('knot.svg', SCENE.replace('m 102,54', 'm 1e12,54'))
        self.refused('knot.svg', '--check', *POSES, parts=['knot.svg: ', 'm from the start'])
        self.write('long.csv', CASE + ' ' * (17 << 20))
        self.refused('long.csv', 'c.yaml', parts=['long.csv: ', '16 MiB'])
        for name in ('/dev/zero', '/'):
            self.refused(name, 'c.yaml', parts=[name + ': is a'])
        self.assertEqual(sorted(os.listdir()), ['case.csv', 'knot.csv', 'knot.svg', 'long.csv', 'ok.yaml'])

    def test_the_map_of_a_scenario_is_not_written_over(self):
        self.write('map.yaml', 'image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
        self.write('map.pgm', b'P5\n100 100\n255\n' + b'\xfe' * 10000)
        self.write('on_map.yaml', 'map: map.yaml\nstart: [2, 2, 0]\ngoal: [5, 2, 0]\n')
        for name in ('on_map.yaml', 'map.yaml', 'map.pgm'):
            self.refused('on_map.yaml', name, '--to', 'yaml', parts=[name + "' is the input"])
        self.convert('on_map.yaml', 'other.yaml', '--check')

    def test_one_is_one(self):
        self.write('case.csv', '0,0,0,9,0,0,1,3,20,20,22,20,22,22\n')
        self.assertRegex(self.convert('case.csv', '--check'), ', 1 obstacle\n$')
        self.write('result.json', json.dumps(self.planned('case.csv', '--trajectory')))
        self.assertIn(' in 1 stretch, trajectory', self.convert('result.json', '--check'))
        self.assertEqual(self.convert('--hope', 'normal', 'hope', '--count', 1), '1 problem: hope\n')

    def test_bad_usage_is_one_line(self):
        self.write('case.csv', CASE)
        for arguments, part in ((['case.csv'], 'OUTPUT'), ([], 'INPUT'), (['case.csv', 'x.doc'], '.yaml'),
                                (['case.csv', 'x.yaml', '--to', 'yml'], "did you mean 'yaml'"), (['none.csv', 'x.yaml'], 'none.csv'),
                                (['case.csv', 'x.yaml', 'y.yaml'], 'y.yaml'), (['case.csv', 'case.csv'], 'input'),
                                (['case.csv', '-', '--to', 'yaml'], "'-'"), (['case.csv', '--chek'], '--check'),
                                (['case.csv', 'x.yaml', '--goal', '1,2'], 'X,Y,YAW'), (['case.csv', 'x.yaml', '--goal'], '--goal'),
                                (['case.csv', 'x.yaml', '--goal', '1,2,3', '--goal=1,2,3'], 'more than once'),
                                (['case.csv', 'no/such/x.yaml'], 'no/such'), (['--hope', 'hard', 'x'], 'extreme'),
                                (['case.csv', 'x.yaml', '--vehicle', ''], '--vehicle'),
                                (['case.csv', 'x.yaml', '--vehicle', 'golf'], 'golf'),
                                (['case.csv', 'x.yaml', '--count', '3'], 'requires --hope'),
                                (['case.csv', 'x.yaml', '--seed', '3'], '--seed requires'),
                                (['case.csv', '--check', '--to', 'yaml'], '--to is'),
                                (['--hope', 'normal', 'x', '--start', '0,0,0'], '--start changes'),
                                (['--hope', 'normal', 'x', '--vehicle', 'tpcap'], '--vehicle changes'),
                                (['--hope', 'normal'], 'folder'), (['--hope', 'normal', 'x', '--count', '-1'], '--count must')):
            with self.subTest(arguments=arguments):
                self.refused(*arguments, parts=[part])
        self.assertEqual(os.listdir(), ['case.csv'])
        self.convert('case.csv', '--check', '--start', '-1,-1,0', 'x.yaml')  # options anywhere, values with a sign

    def test_help_has_examples_of_every_format(self):
        text = self.convert('--help')
        for each in program.PROBLEM_FORMATS + program.RESULT_FORMATS:
            self.assertIn(f'\n  {each.name} ', text)
        for word in ('extreme', '\nExamples', '.mat', '.svg', '.csv', '.yaml'):
            self.assertIn(word, text)


def mesh(boxes, up='Z_UP', matrix='2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1'):
    """A document in COLLADA with the faces of boxes (low x, low y, high x, high y), 1 high, in a node within a node."""
    points, corners = [], []
    for low_x, low_y, high_x, high_y in boxes:
        first = len(points)
        for height in (0, 1):
            for x, y in ((low_x, low_y), (high_x, low_y), (high_x, high_y), (low_x, high_y)):
                points.append((x, -height, y) if up == 'Z_UP' else (x, y, height))
        quads = [(0, 1, 2, 3), (4, 5, 6, 7)] + [(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4) for k in range(4)]
        for a, b, c, d in quads:
            corners += [first + each for each in (a, b, c, a, c, d)]
    numbers = ' '.join(str(value) for point in points for value in point)
    indices = ' '.join(f'{each} 0' for each in corners)  # a second input with an offset of its own
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><asset><up_axis>{up}</up_axis></asset>
<library_visual_scenes><visual_scene id="s"><node><matrix>{matrix}</matrix><instance_node url="#n"/></node></visual_scene>
</library_visual_scenes><library_nodes><node id="n"><instance_geometry url="#g"/></node></library_nodes>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array>{numbers}</float_array></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="{len(corners) // 3}">
<input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#p" offset="1"/><p>{indices}</p>
</triangles></mesh></geometry></library_geometries></COLLADA>"""


OMPLAPP = """[problem]
name = lot  # with a comment
world = lot.dae
robot = car.dae
start.x = 1
start.y = 2
start.theta = 0.5
goal.x = 11
goal.y = 2
goal.theta = 0
[planner]
rrt=
aps=
aps.name=one
aps=
aps.name=two
"""


class OmplAppTest(ConvertTest):
    def setUp(self):
        super().setUp()
        self.write('car.dae', mesh([(0, 0, 2, 1)]))
        self.write('lot.dae', mesh([(10, 10, 12, 11), (-10, -9, -8, -8)]))
        self.write('lot.cfg', OMPLAPP)

    def test_a_problem_with_its_meshes(self):
        self.convert('lot.cfg', 'lot.yaml', '--check')
        scenario = ia.Scenario.read('lot.yaml')
        self.assertEqual((scenario.start, scenario.goals), ((1, 2, 0.5), [(11, 2, 0)]))
        # A box is two triangles: its bottom projects on its top, and its sides on edges or one diagonal.
        corners = np.array([polygon for polygon in scenario.polygons if len(polygon) == 3])
        self.assertEqual(len(corners), 4)
        self.assertEqual((corners.min(axis=(0, 1)).tolist(), corners.max(axis=(0, 1)).tolist()), ([-20, -18], [24, 22]))
        x, y = np.moveaxis(corners, 2, 0)
        double_areas = np.abs((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0]))
        self.assertAlmostEqual(double_areas.sum(), 2 * 2 * 8.0)
        self.assertEqual(len(scenario.polygons), 4)
        # The car turns round its middle.
        car = scenario.vehicle
        self.assertEqual((car.rear_overhang, car.wheelbase + car.front_overhang, car.width), (2, 2, 2))
        self.assertAlmostEqual(car.turning_radius, 1.0)

    def test_the_turning_radius_and_the_volume(self):
        self.write('lot.cfg', OMPLAPP.replace('[planner]', 'turningradius = 3\nvolume.min.x = -30\nvolume.min.y = -31\n'
                                              'volume.max.x = 40\nvolume.max.y = 41\n[planner]'))
        self.convert('lot.cfg', 'lot.yaml')
        scenario = ia.Scenario.read('lot.yaml')
        self.assertAlmostEqual(scenario.vehicle.turning_radius, 3.0)
        within = [(-30, -31, 0), (40, -31, 2), (40, 41, 1), (-30, 41, -1), (-25, 0, 0), (35, 0, 0), (0, -26, 0), (0, 36, 0)]
        self.assertTrue(scenario.is_free(within).all())
        self.assertFalse(scenario.is_free([(-36, 0, 0), (46, 0, 0), (0, -37, 0), (0, 47, 0)]).any())
        self.write('lot.cfg', OMPLAPP.replace('[planner]', 'control = kinematic_car\n[planner]'))
        self.convert('lot.cfg', 'lot.yaml')
        self.assertAlmostEqual(ia.Scenario.read('lot.yaml').vehicle.turning_radius, math.sqrt(3.0))

    def test_meshes_among_the_resources(self):
        self.convert('lot.cfg', 'lot.yaml')
        os.makedirs('resources/2D')
        os.makedirs('benchmark')
        for name in ('car.dae', 'lot.dae'):
            os.rename(name, 'resources/2D/' + name)
        self.write('benchmark/lot.cfg', OMPLAPP.replace('lot.dae', '2D/lot.dae').replace('car.dae', '2D/car.dae'))
        self.convert('benchmark/lot.cfg', 'again.yaml')
        self.assertEqual(self.read('again.yaml').replace('again', 'lot'), self.read('lot.yaml'))

    def test_the_comparison_runs_with_the_converted_problem(self):
        self.write('lot.cfg', OMPLAPP.replace('[planner]', '[benchmark]\ntime_limit = 5\nrun_count = 1\n[planner]'))
        command = [os.environ['PARKING_BENCHMARK'], 'lot.cfg', '--no-report', '--quiet', '--output', 'out']
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ''))
        self.assertIn('parking_convert lot.cfg lot.yaml', done.stderr)
        self.convert('lot.cfg', 'lot.yaml')
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r'RRT +1/1')

    def test_meshes_that_stand_upright(self):
        self.convert('lot.cfg', 'lot.yaml')
        before = self.read('lot.yaml')
        self.write('car.dae', mesh([(0, 0, 2, 1)], 'Y_UP'))
        self.write('lot.dae', mesh([(10, 10, 12, 11), (-10, -9, -8, -8)], 'Y_UP'))
        self.convert('lot.cfg', 'lot.yaml')
        self.assertEqual(self.read('lot.yaml'), before)

    def test_walls_without_a_top_are_segments(self):
        text = self.read('lot.dae')
        start = text.index('<p>') + 3
        indices = text[start:text.index('</p>')].split()
        sides = indices[2 * 12:2 * 36]  # of the first box
        self.write('lot.dae', text[:start] + ' '.join(sides) + text[text.index('</p>'):])
        self.convert('lot.cfg', 'lot.yaml')
        segments = {tuple(map(tuple, polygon)) for polygon in ia.Scenario.read('lot.yaml').polygons}
        self.assertEqual(segments, {((20, 20), (24, 20)), ((24, 20), (24, 22)), ((20, 22), (24, 22)), ((20, 20), (20, 22))})

    def test_bad_files(self):
        lot, endless = self.read('lot.dae'), self.read('lot.dae').replace('url="#g"', 'url="#g"/><instance_node url="#n"')
        for old, new, part in (('start.x = 1', 'start.x = one', "start.x must be a number, not 'one'"),
                               ('goal.theta = 0\n', '', 'no goal.theta'), ('start.theta = 0.5', 'start.z = 1', 'three dimensions'),
                               ('robot = car.dae', '', 'no robot'), ('lot.dae', 'missing.dae', 'missing.dae'),
                               ('[planner]', 'turningradius = -1\n[planner]', 'turningradius'),
                               ('[planner]', 'volume.min.x = 1\n[planner]', 'no volume.min.y')):
            with self.subTest(new):
                self.write('lot.cfg', OMPLAPP.replace(old, new))
                self.refused('lot.cfg', 'lot.yaml', parts=[part])
        self.write('lot.cfg', OMPLAPP)
        self.refused('lot.cfg', 'other.cfg', parts=['.cfg'])  # is not written
        for text, part in ((lot[:-10], 'COLLADA'), (lot.replace('url="#g"', 'url="#x"'), 'COLLADA'), (endless, 'contain themselves'),
                           (lot.replace('matrix', 'rotate'), 'by a matrix'), (lot.replace('triangles', 'lines'), 'no triangles'),
                           ('<COLLADA/>', 'COLLADA'), (lot.replace('offset="0"', ''), 'COLLADA'), (lot.replace('<p>0', '<p>999'), 'COLLADA')):
            with self.subTest(part):
                self.write('lot.dae', text)
                self.refused('lot.cfg', 'lot.yaml', parts=['lot.dae: ', part])
        self.assertFalse(os.path.exists('lot.yaml'))


class HopeTest(ConvertTest):
    def test_the_random_numbers_are_those_of_the_standard_library_of_cpp(self):
        random = Random(5489)
        for _ in range(9999):
            random.bits()
        self.assertEqual(random.bits(), 9981545732273789042)  # [rand.predef] in the C++ standard

    def test_a_seed_gives_the_same_problem_for_ever(self):
        for level, start in (('normal', (1.358775113, 11.18127198, -0.228337745)),
                             ('complex', (2.768228848, 9.259714578, -2.086883928)),
                             ('extreme', (-7.896571649, 4.677943037, 0.712857758)),
                             ('dlp', (38.758247615, 23.4412063, -3.064849095))):
            np.testing.assert_allclose(hope.scene(level, 1).start, start, atol=2e-9)

    def test_levels_have_the_room_that_is_published(self):
        length = 4.69
        along = {'normal': (0.25 * length, 0.25 * length + 0.5), 'complex': (0.9, 0.25 * length), 'extreme': (0.6, 0.9)}
        across = {'normal': (0.85, 1.2), 'complex': (0.4, 0.85)}
        parallel = 0
        for level in along:
            for seed in range(1, 31):
                scenario = hope.scene(level, seed)
                self.assertTrue(scenario.is_free([scenario.start, *scenario.goals]).all())
                is_parallel = abs(math.cos(scenario.goals[0][2])) > 0.7
                parallel += is_parallel
                least, most = along[level] if is_parallel else across[level]
                room = self.room(scenario, -1.0) + self.room(scenario, 1.0)
                self.assertTrue(least - 1e-6 <= room <= most + 1e-6, (level, seed, room))
        self.assertTrue(45 < parallel < 75)

    def room(self, scenario, side):
        """Least clearance of the car at its goal from obstacles beside it whose middle is on one side of the body's."""
        goal = scenario.goals[0]
        middle = scenario.vehicle.footprint(goal).mean(axis=0)
        # Neither the kerb nor what is across the aisle.
        beside = [polygon for polygon in scenario.polygons if side * (polygon.mean(axis=0)[0] - middle[0]) > 0.5
                  and 0.0 < polygon.mean(axis=0)[1] < 5.5 and polygon[0, 1] <= 7.0]
        one = ia.Scenario.from_polygons(beside, goal, (40.0, 40.0, 0.0), vehicle=scenario.vehicle)
        return one.clearance_at([goal])[0]

    def test_files_are_free_and_the_same_in_every_format(self):
        for level in hope.LEVELS:
            self.convert('--hope', level, 'a', '--count', '3', '--seed', '5', '--check')
            self.convert('--hope', level, 'b', '--count', '3', '--seed', '5', '--to', 'tpcap')
            for seed in range(5, 8):
                yaml, csv = (ia.Scenario.read(f'{folder}/hope_{level}_{seed}.{end}') for folder, end in
                             (('a', 'yaml'), ('b', 'csv')))
                self.assertEqual((yaml.start, yaml.goals, len(yaml.polygons)), (csv.start, csv.goals, len(csv.polygons)))
                self.assertTrue(level != 'dlp' or len(yaml.polygons) > 200)


class ResultsTest(ConvertTest):
    def result(self):
        result = self.planned(os.path.join(SCENARIOS, 'parallel.yaml'), '--trajectory')
        result['scenario'] = 'Case07'
        self.write('result.json', json.dumps(result))
        return result

    def test_paths_for_commonparking(self):
        result = self.result()
        self.convert('result.json', 'out.mat', '--check')
        found = scipy.io.loadmat('out.mat', simplify_cells=True)['result']
        self.assertEqual((found['schema_version'], found['kind'], found['case_id'], found['reference_point']),
                         ('CommonParking-result-1', 'path', 7, 'rear_axle_midpoint'))
        self.assertEqual((found['status']['success'], found['trajectory'].size), (1, 0))
        path = found['path']
        self.assertAlmostEqual(path['s'][-1], result['length_m'], delta=1e-6)
        self.assertEqual(len(path['cusp_indices']), result['cusps'] + 2)
        for name in ('x', 'y'):
            self.assertAlmostEqual(path[name][0], result['path'][0][name], delta=1e-9)
            self.assertAlmostEqual(path[name][-1], result['path'][-1][name], delta=1e-6)
        # The arcs, integrated here, pass through every sample with its heading and steering.
        x, y, yaw = path['geometry']['start']
        lengths, curvatures = path['geometry']['primitives'].T
        k, begin = 0, 0.0

        def moved(way):
            turn = way * curvatures[k]
            chord = way * (math.sin(0.5 * turn) / (0.5 * turn) if turn else 1.0)
            return x + chord * math.cos(yaw + 0.5 * turn), y + chord * math.sin(yaw + 0.5 * turn), yaw + turn

        for index, place in enumerate(path['s']):
            while k + 1 < len(lengths) and place >= begin + abs(lengths[k]) - 1e-12:
                begin += abs(lengths[k])
                x, y, yaw = moved(lengths[k])
                k += 1
            at_x, at_y, at_yaw = moved(math.copysign(place - begin, lengths[k]))
            self.assertLess(math.hypot(at_x - path['x'][index], at_y - path['y'][index]), 1e-6)
            self.assertLess(abs(math.remainder(at_yaw - path['theta'][index], math.tau)), 1e-6)
            self.assertLess(abs(math.atan(result['vehicle']['wheelbase'] * curvatures[k]) - path['phi'][index]), 1e-6)

    def test_trajectories(self):
        samples = self.result()['planned_trajectory']
        self.convert('result.json', 'out.csv', '--check')
        lines = self.read('out.csv').splitlines()
        self.assertEqual(len(lines), 1 + len(samples))
        self.assertEqual([float(each) for each in lines[-1].split(',')][:5],
                         [samples[-1][name] for name in ('t', 'x', 'y', 'yaw', 'v')])
        self.convert('result.json', 'out.mat', '--to', 'commonparking-trajectory', '--check')
        found = scipy.io.loadmat('out.mat', simplify_cells=True)['result']
        self.assertEqual(found['kind'], 'trajectory')
        for name, member in (('t', 't'), ('x', 'x'), ('v', 'v'), ('phi', 'steering'), ('a', 'acceleration')):
            self.assertEqual(found['trajectory'][name].tolist(), [sample[member] for sample in samples])

    def test_the_check_applies_the_rules_of_commonparking(self):
        self.result()
        self.convert('result.json', 'path.mat')
        self.convert('result.json', 'trajectory.mat', '--to', 'commonparking-trajectory')
        for kind, name, place, value, fault in (
                ('path', 's', 5, 0.0, 'the mileage does not fit the positions at sample 6'),
                ('path', 's', -1, 2000.0, 'end by 1000 m'), ('path', 'x', 3, np.inf, 'x is not finite'),
                ('path', 'gear', 0, 0.0, 'cusp_indices'), ('trajectory', 't', 4, 0.0, 'time does not increase at sample 5'),
                ('trajectory', 'v', -1, 1.0, 'end at rest'), ('trajectory', 't', 0, 1.0, 'time must begin with 0')):
            written = scipy.io.loadmat(f'{kind}.mat')['result']
            written[kind][0, 0][name][0, 0][place] = value
            content = io.BytesIO()
            scipy.io.savemat(content, {'result': written})
            self.assertIn(fault, program.commonparking.result_fault(None, 'out.mat', content.getvalue()))

    def test_results_that_are_none(self):
        result = self.result()
        for option, value in (('--vehicle', 'tpcap'), ('--start', '0,0,0'), ('--goal', '0,0,0')):
            self.refused('result.json', 'out.csv', option, value, parts=[option + ' changes a problem'])
        del result['planned_trajectory']
        self.write('plain.json', json.dumps(result))
        for name, extra in (('out.csv', []), ('out.mat', ['--to', 'commonparking-trajectory'])):
            self.refused('plain.json', name, *extra, parts=['plain.json: the result has no trajectory',
                                                            'plan with --trajectory or --track'])
        self.refused('plain.json', 'out.txt', parts=[
            '--to: commonparking-path (.mat), commonparking-trajectory (.mat), tpcap-trajectory (.csv)'])
        self.write('plain.json', json.dumps({**result, 'path': []}))
        self.refused('plain.json', 'out.mat', parts=['no path'])
        for text in ('{"planner": 3}', '{', '{"a": ' * 100000):
            self.write('plain.json', text)
            self.refused('plain.json', 'out.mat', parts=['plain.json: not a result of parking_plan --json: '])

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
                self.refused('wrong.json', 'out.csv', parts=['wrong.json: ', *parts])
                self.assertFalse(os.path.exists('out.csv'))

        for name in ('planner', 'status', 'planning_time_ms', 'vehicle', 'path', 'format'):
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
                (['planner'], 3, 'planner is 3', 'word'), (['path', 7, 'x'], 10 ** 400, 'path[7].x', 'a finite number'),
                (['status'], 'solved', "status is 'solved'", 'exact'), (['status'], 'timeout', "'timeout'", 'exact'),
                (['scenario'], 7, 'scenario is 7'), (['planning_time_ms'], 3.0, 'planning_time_ms is 3.0', 'a list'),
                (['planning_time_ms'], [], 'planning_time_ms is an empty list'),
                (['planning_time_ms'], [-1], 'planning_time_ms[0] is -1'),
                (['vehicle'], 'golf', "vehicle is 'golf'", 'object'), (['vehicle', 'width'], 0, 'width is 0'),
                (['vehicle', 'max_steering_angle'], 2, 'max_steering_angle is 2'),
                (['path'], {'x': 1}, 'path is an object', 'a list'),
                (['path', 3], 5, 'path[3] is 5'), (['path', 3, 'direction'], 0, 'path[3].direction is 0', '1 or -1'),
                (['path', 3, 'x'], float('nan'), 'not a result', 'NaN'), (['path', 3, 'y'], 1e300, 'path[3] does not follow'),
                (['path', 3, 'y'], result['path'][3]['y'] + 0.1, 'path[3] does not follow', 'm and'),
                (['path', 3, 'yaw'], result['path'][3]['yaw'] + 0.1, 'path[3] does not follow'),
                (['path', 3, 'direction'], -result['path'][3]['direction'], 'path[3] does not follow'),
                (['planned_trajectory', 8, 't'], 0.0, 'planned_trajectory[8].t is 0.0', 'more than'),
                (['planned_trajectory', 8, 'x'], 1e4, 'planned_trajectory[8] lies', 'in 0.0'),
                (['planned_trajectory'], 'none', "planned_trajectory is 'none'")):
            refused(place, value, *parts)


class LaunchedTest(ProgramTest):
    def test_pipes(self):
        self.write('case.csv', CASE)
        for command in ('cat case.csv | %s /dev/stdin a.yaml --check', '%s <(cat case.csv) b.yaml --check'):
            done = self.run_program('bash', '-c', command % CONVERT)
            self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(self.read('a.yaml'), self.read('b.yaml'))
        done = self.run_program(CONVERT, '/dev/stdin', 'out.csv', '--check',
                                input=json.dumps(self.planned('case.csv', '--trajectory')))
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        done = self.run_program('bash', '-c', f'{CONVERT} case.csv --check >/dev/full')
        self.assert_refused(done, 'parking_convert: standard output cannot be written')

    def test_installed_it_finds_what_it_needs(self):
        self.write('case.csv', CASE)
        for component in ('programs', 'python'):
            self.run_program(os.environ['CMAKE'], '--install', os.environ['PARKING_BUILD_DIR'], '--prefix',
                             self.path('prefix'), '--component', component)
        environment = {name: value for name, value in os.environ.items() if name != 'PYTHONPATH'}
        done = self.run_program('prefix/bin/parking_convert', 'case.csv', 'case.mat', '--check', env=environment)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assert_refused(self.run_program('prefix/bin/parking_convert', env=environment), 'no INPUT given')


if __name__ == '__main__':
    main()
