"""parking_plan on the problems that come with the project: exit status, and what its results say."""

import json
import math
import os
import re
import subprocess
import xml.etree.ElementTree

from programs import PLAN, SOURCE, ProgramTest, bundled, bundled_scenarios, main

UNSOLVABLE = {'unreachable'}
MAX_GAP = 0.1 + 1e-9  # metres between states of a path


def wrapped(angle):
    return math.remainder(angle, 2.0 * math.pi)


def without_times(result):
    """A result without what depends on the machine's speed."""
    kept = {key: value for key, value in result.items() if not key.endswith('_time_ms')}
    kept['runs'] = [{key: value for key, value in run.items() if not key.endswith('_ms')} for run in result['runs']]
    return kept


class Bundled(ProgramTest):
    def check_path(self, result):
        """First = start, states near each other and joined by the arcs that they tell of, length and cusps as stated."""
        path = result['path']
        for key in ('x', 'y', 'yaw'):
            self.assertEqual(path[0][key], result['start'][key])
        radius = result['vehicle']['min_turning_radius']
        length, cusps = 0.0, 0
        for before, state in zip(path, path[1:]):
            chord = math.hypot(state['x'] - before['x'], state['y'] - before['y'])
            turn = wrapped(state['yaw'] - before['yaw'])
            curvature = state['curvature']
            self.assertIn(state['direction'], (1, -1))
            self.assertLessEqual(abs(curvature), (1.0 + 1e-3) / radius)
            arc = chord if abs(turn) < 1e-9 else chord * (0.5 * turn) / math.sin(0.5 * turn)
            self.assertLessEqual(arc, MAX_GAP)
            self.assertAlmostEqual(turn, curvature * arc * state['direction'], delta=1e-5)
            # The chord lies in the direction half way between both headings.
            heading = before['yaw'] + 0.5 * turn + (0.0 if state['direction'] > 0 else math.pi)
            self.assertAlmostEqual(before['x'] + chord * math.cos(heading), state['x'], delta=1e-5)
            self.assertAlmostEqual(before['y'] + chord * math.sin(heading), state['y'], delta=1e-5)
            length += arc
        for before, state in zip(path[1:], path[2:]):
            cusps += before['direction'] != state['direction']
        self.assertAlmostEqual(length, result['length_m'], delta=1e-3)
        self.assertEqual(cusps, result['cusps'])
        self.assertTrue(result['recheck']['valid'], result['recheck'])
        # A path in touch with an obstacle would have none.
        self.assertGreater(result['min_clearance_m'], 0.0)

    def test_every_problem_is_solved_exactly_but_the_unreachable_one(self):
        names = bundled_scenarios()
        self.assertGreaterEqual(len(names), 11)
        for name in names:
            with self.subTest(name):
                solvable = name not in UNSOLVABLE
                result = self.planned(bundled(name), status=0 if solvable else 3)
                self.assertEqual(result['format'], 1)
                self.assertEqual(result['scenario'], name)
                self.assertEqual(result['planner'], 'improved_astar')
                self.assertEqual(result['status'], 'exact' if solvable else 'approximate')
                self.assertEqual(result['parameters']['motion_model'], 'car')
                for field in ('wheelbase', 'front_overhang', 'rear_overhang', 'width', 'max_steering_angle'):
                    self.assertGreater(result['vehicle'][field], 0.0)
                self.assertEqual(len(result['planning_time_ms']), 1)
                self.assertGreater(result['map_loading_time_ms'], 0.0)
                search = result['search']
                for count in ('expanded', 'generated', 'state_checks'):
                    self.assertGreater(search[count], 0, count)
                self.assertLessEqual(search['exact_checks'], search['state_checks'])
                self.check_path(result)
                last = result['path'][-1]
                ends = [{key: last[key] for key in ('x', 'y', 'yaw')}]
                self.assertEqual(ends[0] in result['goals'], solvable)

    def test_a_forklift_drives_its_forks_into_a_pallet(self):
        forklift = os.path.join(SOURCE, 'examples', 'forklift.yaml')
        result = self.planned(forklift, '--trajectory')
        self.assertEqual((result['status'], len(result['vehicle']['outline'])), ('exact', 14))
        self.check_path(result)
        # A body without gaps between its forks does not fit.
        with open(forklift) as stream:
            text = stream.read()
        start = text.index('  outline:')
        rectangle = '  front_overhang: 0.4\n  rear_overhang: 1.6\n  width: 1.1\n'
        self.write('rectangle.yaml', text[:start] + rectangle + text[text.index('  max_steering_angle'):])
        refused = self.planned('rectangle.yaml', status=3)
        self.assertIn('in collision at the goal', refused['reason'])

    def test_at_weight_one_the_bound_on_suboptimality_is_reported(self):
        self.assertIsNone(self.planned(bundled('perpendicular'))['search']['suboptimality_bound'])
        weights = ('--set', 'heuristic_weight_far=1', '--set', 'heuristic_weight_near=1')
        first = self.planned(bundled('perpendicular'), *weights)
        bound = first['search']['suboptimality_bound']
        self.assertGreater(bound, 1.0)
        # The bound holds for whatever is found later.
        longer = self.planned(bundled('perpendicular'), *weights, '--set', 'anytime=1', '--time-limit', 1)
        self.assertLessEqual(longer['search']['suboptimality_bound'], bound)
        self.assertGreaterEqual(longer['length_m'] * bound, 0.99 * first['length_m'])

    def test_the_same_seed_and_input_give_the_same_result(self):
        for planner, name in (('improved_astar', 'narrow_parallel'), ('improved_astar', 'underground_garage'),
                              ('RRTConnect', 'perpendicular')):
            with self.subTest(planner=planner, name=name):
                first, second = (self.planned(bundled(name), '--planner', planner, '--seed', 7) for _ in range(2))
                self.assertGreater(len(first['path']), 2)
                self.assertEqual(without_times(first), without_times(second))
        other = self.planned(bundled('perpendicular'), '--planner', 'RRTConnect', '--seed', 8)
        self.assertNotEqual(other['path'], first['path'])

    def test_an_approximate_path_ends_near_the_goal(self):
        result = self.planned(bundled('unreachable'), status=3)
        last, goal = result['path'][-1], result['goals'][0]
        distance = math.hypot(last['x'] - goal['x'], last['y'] - goal['y'])
        self.assertAlmostEqual(result['goal_distance_m'], distance, delta=1e-6)
        start = result['start']
        self.assertLess(distance, 0.5 * math.hypot(start['x'] - goal['x'], start['y'] - goal['y']))
        self.assertEqual(result['reason'],
                         'no goal is valid: the car is in collision at the goal 0, -3.8883, 1.570796327')

    def test_grid_models_plan_for_a_disc_in_the_plane(self):
        for model in ('grid8', 'grid16'):
            with self.subTest(model):
                result = self.planned(bundled('underground_garage'), '--set', 'motion_model=' + model)
                self.assertEqual((result['status'], result['space'], result['footprint']), ('exact', 'se2', 'circle'))
                self.assertTrue(result['recheck']['valid'])
                self.assertGreater(result['circle_radius_m'], 0.5)

    def test_several_runs(self):
        result = self.planned(bundled('angled45'), '--runs', 3, '--planner', 'RRTConnect')
        self.assertEqual(len(result['planning_time_ms']), 3)
        self.assertEqual(len(result['runs']), 3)
        self.assertEqual(result['runs'][0]['length_m'], result['length_m'])
        self.assertGreater(len({run['length_m'] for run in result['runs']}), 1)  # each with a seed of its own

    def test_a_planner_that_finds_nothing(self):
        result = self.planned(bundled('tight_parallel'), '--planner', 'reeds_shepp', status=4)
        self.assertEqual((result['status'], result['reason']), ('infeasible', ''))
        self.assertEqual(result['path'], [])
        self.assertIsNone(result['length_m'])

    def test_no_way_is_not_a_lack_of_time(self):
        # Walls all round the start.
        self.write('walled.yaml', 'start: [0, 0, 0]\ngoal: [20, 0, 0]\npolygons: ['
                   '[[-2, -2], [5, -2], [5, -1.9], [-2, -1.9]], [[-2, 1.9], [5, 1.9], [5, 2], [-2, 2]], '
                   '[[-2, -2], [-1.9, -2], [-1.9, 2], [-2, 2]], [[4.9, -2], [5, -2], [5, 2], [4.9, 2]]]\n')
        result = self.planned('walled.yaml', '--set', 'approximate=0', '--time-limit', 60, status=4)
        self.assertEqual(result['status'], 'infeasible')
        self.assertIn('obstacles are in the way', result['reason'])
        stopped = self.planned('walled.yaml', '--set', 'approximate=0', '--time-limit', 1e-6, status=4)
        self.assertEqual((stopped['status'], stopped['reason']), ('timeout', ''))

    def test_time_limit_of_planners_that_go_on_improving(self):
        result = self.planned(bundled('angled45'), '--planner', 'RRTstar', '--time-limit', 0.3, '--seed', 3)
        self.assertGreater(result['planning_time_ms'][0], 290.0)
        self.assertLess(result['planning_time_ms'][0], 3000.0)  # the machine may be busy

    def test_files_and_the_car_in_the_picture(self):
        for options, shown, beside in (([], 'path', []), (['--trajectory'], 'trajectory', ['planned path']),
                                       (['--trajectory', '--track'], 'drive', ['planned path', 'planned trajectory'])):
            self.plan(bundled('parallel'), '--json', 'result.json', '--svg', 'result.svg', *options)
            self.assertEqual(sorted(os.listdir(self.folder)), ['result.json', 'result.svg'])
            self.assertEqual(json.loads(self.read('result.json'))['status'], 'exact')
            self.assertTrue(xml.etree.ElementTree.fromstring(self.read('result.svg')).tag.endswith('svg'))
            legend = re.findall('>([^<>]+)</text>', self.read('result.svg'))
            self.assertEqual([label for label in legend if label.startswith('car along')], [f'car along the {shown}'])
            self.assertIn(f'{shown}, reverse', legend)
            self.assertEqual([label for label in legend if label.startswith('planned ')], beside)

    def test_on_a_terminal_long_steps_tell_of_themselves(self):
        leader, terminal = os.openpty()
        try:
            # It uses all of its time.
            arguments = [PLAN, bundled('perpendicular'), '--planner', 'BITstar', '--time-limit', '1.2']
            with subprocess.Popen(arguments, cwd=self.folder, stderr=terminal, stdout=subprocess.DEVNULL) as process:
                process.wait(timeout=60)
            said = os.read(leader, 4096).decode()
        finally:
            os.close(leader)
            os.close(terminal)
        self.assertIn('\rplanning, run 1 of 1, at most 1.2 s...', said)
        self.assertRegex(said, r'\r +\r$')  # and the line is gone
        self.assertEqual(self.run_program(*arguments).stderr, '')

    def test_help_names_all_planners(self):
        text = self.plan('--help').stdout
        for name in ('improved_astar', 'hybrid_astar', 'RRTstar', 'BITstar', 'reeds_shepp', 'tpcap', '--time-limit'):
            self.assertIn(name, text)


if __name__ == '__main__':
    main()
