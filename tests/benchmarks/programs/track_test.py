"""parking_plan --track: the drive in the JSON, in the picture and as a page."""

import json
import math
import os

from programs import ProgramTest, bundled, main

CAR_LIMITS = {'v': 'max_speed', 'acceleration': 'max_acceleration', 'steering': 'max_steering_angle'}


class TrackTest(ProgramTest):

    def test_the_drive_obeys_the_limits_and_ends_at_the_goal(self):
        result = self.planned(bundled('parallel'), '--track')
        drive = result['trajectory']
        for before, point in zip(drive, drive[1:]):
            step = point['t'] - before['t']
            self.assertGreater(step, 0.0)
            for field, limit in CAR_LIMITS.items():
                self.assertLessEqual(abs(point[field]), result['vehicle'][limit] + 1e-9, field)
            self.assertLessEqual(abs(point['v'] - before['v']), result['vehicle']['max_acceleration'] * step + 1e-6)
            self.assertLessEqual(abs(point['steering'] - before['steering']),
                                 result['vehicle']['max_steering_rate'] * step + 1e-6)
        goal, end = result['path'][-1], drive[-1]
        self.assertLessEqual(math.hypot(end['x'] - goal['x'], end['y'] - goal['y']), 0.05)
        self.assertEqual(end['v'], 0.0)
        self.assertTrue(result['tracking']['arrived'])

    def test_paths_of_the_grid_models_are_driven(self):
        for name in ('basic_astar', 'improved_astar'):
            result = self.planned(bundled('parallel'), '--track', '--set', 'parameter_set=' + name)
            self.assertTrue(result['tracking']['arrived'], result['tracking']['message'])
            self.assertLessEqual(result['tracking']['final_position_error_m'], 0.05)

    def test_a_comparison_drives_the_same(self):
        # A path of arcs, and a grid path with corners: whatever drives them, the same drive follows.
        for setting, space in (('motion_model=car', ''),
                               ('parameter_set=basic_astar', 'space = se2\nfootprint = circle\n')):
            result = self.planned(bundled('perpendicular'), '--track', '--set', setting)
            self.write('set.cfg', f'[problem]\nscenario = {bundled("perpendicular")}\n{space}[benchmark]\n'
                                  f'time_limit = 20\nrun_count = 1\ntrack = yes\n'
                                  f'[planner]\nimproved_astar=\nimproved_astar.{setting}\n')
            self.benchmark('set.cfg', '--output', setting, '--quiet')
            with open(self.path(setting + '/runs.jsonl')) as stream:
                next(stream)
                figures = json.loads(next(stream))['figures']
            alone = result['tracking']
            self.assertEqual(figures['driven to the end'], alone['arrived'])
            for name, field in (('travel time', 'travel_time_s'), ('driven length', 'driven_length_m'),
                                ('greatest position error', 'max_position_error_m'),
                                ('final position error', 'final_position_error_m'),
                                ('final yaw error', 'final_yaw_error_rad'), ('collisions while driving', 'collisions')):
                self.assertAlmostEqual(figures[name], alone[field], delta=1e-9, msg=f'{setting}: {name}')

    def test_picture_and_page(self):
        self.planned(bundled('perpendicular'), '--track', '--svg', self.path('a.svg'), '--html', self.path('a.html'))
        picture = self.read('a.svg')
        for part in ('Acceleration', 'Steering angle', 'driven', 'car along the drive', 'planned path'):
            self.assertIn(part, picture)
        page = self.read('a.html')
        self.assertIn('<!DOCTYPE html>', page)
        self.assertIn('perpendicular', page)

    def test_without_a_drive_there_is_no_page(self):
        self.refused_plan(bundled('perpendicular'), '--html', 'a.html', parts=['--track'])
        self.refused_plan(bundled('perpendicular'), '--track', '--html', 'no/folder/a.html', parts=['no/folder'])
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == '__main__':
    main()
