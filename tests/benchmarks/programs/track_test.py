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
        self.assertEqual(set(end), {'t', 'x', 'y', 'yaw', *CAR_LIMITS})
        tracking = result['tracking']
        self.assertEqual((tracking['arrived'], tracking['collisions'], tracking['corner_deviation_m']), (True, 0, 0.0))
        for field, most in (('travel_time_s', 120.0), ('mean_abs_acceleration', 1.0), ('mean_abs_steering_deg', 45.0),
                            ('max_position_error_m', 0.05), ('final_position_error_m', 0.05),
                            ('final_yaw_error_rad', 0.02)):
            self.assertGreater(tracking[field], 0.0, field)
            self.assertLess(tracking[field], most, field)
        for field in ('median', 'p99', 'max'):
            self.assertGreater(tracking['mpc_solve_ms'][field], 0.0)
        self.assertAlmostEqual(end['t'], tracking['travel_time_s'], delta=0.5)

    def test_a_comparison_drives_the_same(self):
        # A path of arcs, and a grid path with corners: whatever drives them, the same drive follows.
        for setting, space in (('motion_model=car', ''),
                               ('parameter_set=basic_astar', 'space = se2\nfootprint = circle\n')):
            result = self.planned(bundled('perpendicular'), '--track', '--set', setting)
            self.write('set.cfg', f'[problem]\nscenario = {bundled("perpendicular")}\n{space}[benchmark]\n'
                                  f'time_limit = 20\nrun_count = 1\ntrack = yes\n'
                                  f'[planner]\nimproved_astar=\nimproved_astar.{setting}\n')
            self.benchmark('set.cfg', '--output', setting, '--quiet')
            figures = self.records(setting + '/benchmark.db', clock=True)[0]['figures']
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
        for part in ('Acceleration', 'Steering angle', 'driven'):
            self.assertIn(part, picture)
        page = self.read('a.html')
        self.assertIn('<!DOCTYPE html>', page)
        self.assertIn('perpendicular', page)

    def test_without_the_trajectory_that_was_asked_for_nothing_is_driven(self):
        # Not its path, either: that was not asked for, and here no car can drive it.
        on_the_spot = [bundled('parallel'), '--space', 'se2', '--planner', 'RRTConnect', '--time-limit', '5']
        both = on_the_spot + ['--trajectory', '--track', '--svg', 'a.svg']
        result = self.planned(*both)
        why = result['tracking']['message']
        self.assertRegex(why, r'^there is no trajectory to drive: piece \d+ of the path turns on the spot, which no car can do$')
        self.assertEqual(result['tracking'], {'arrived': False, 'message': why})
        self.assertEqual((result['trajectory'], result['planned_trajectory']), ([], []))
        self.assertIn('turns on the spot', result['trajectory_optimization']['message'])
        self.assertIn('car along the path', self.read('a.svg'))
        self.assertNotIn('driven in', self.read('a.svg'))
        done = self.plan(*both, '--html', 'a.html', status=4)
        self.assertIn(f'  not driven: {why}\n', done.stdout)
        self.assertEqual(done.stderr, f'parking_plan: a.html is not written: not driven: {why}\n')
        self.assertFalse(os.path.exists(self.path('a.html')))

    def test_who_cuts_corners_says_so(self):
        for name in ('basic_astar', 'improved_astar'):  # both with a grid
            done = self.plan(bundled('parallel'), '--track', '--set', 'parameter_set=' + name, '--json', 'result.json')
            tracking = json.loads(self.read('result.json'))['tracking']
            self.assertTrue(tracking['arrived'], tracking['message'])
            self.assertLessEqual(tracking['final_position_error_m'], 0.05)
            deviation = tracking['corner_deviation_m']
            self.assertGreater(deviation, 0.0)
            self.assertIn(f"(no car can drive the path's corners; it leaves the path there by up to {deviation:.2f} m)",
                          done.stdout)
        self.assertNotIn('corners', self.plan(bundled('parallel'), '--track').stdout)

    def test_without_a_drive_there_is_no_page(self):
        self.refused_plan(bundled('perpendicular'), '--html', 'a.html', parts=['--track'])
        self.refused_plan(bundled('perpendicular'), '--track', '--html', 'no/folder/a.html', parts=['no/folder'])
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_sensor_sees_while_the_car_drives(self):
        result = self.planned(bundled('perpendicular'), '--track', '--perceive', '12,10')
        seen = result['perception']
        self.assertEqual((seen['range_m'], seen['rate_hz']), (12.0, 10.0))
        self.assertTrue(result['tracking']['arrived'], result['tracking']['message'])
        self.assertEqual(result['tracking']['collisions'], 0)
        self.assertGreater(seen['check_ms']['median'], 0.0)
        self.assertGreaterEqual(seen['new_motion_ms']['max'], seen['new_motion_ms']['median'])
        self.assertIn('first plan', seen['events'][0])
        self.write('set.cfg', f'[problem]\nscenario = {bundled("perpendicular")}\n[benchmark]\ntime_limit = 20\n'
                              'run_count = 1\nperceive = 12,10\n[planner]\nimproved_astar=\nreeds_shepp=\n')
        self.benchmark('set.cfg', '--output', 'perceived', '--quiet')
        ours, other = (each['figures'] for each in self.records('perceived/benchmark.db', clock=True))
        self.assertEqual(ours['perceived parked'], True)
        self.assertEqual(ours['perceived stops'], seen['stops'])
        self.assertEqual(ours['perceived new motions'], seen['new_motions'])
        self.assertAlmostEqual(ours['perceived drive time'], result['trajectory'][-1]['t'], delta=1e-9)
        self.assertGreater(ours['known drive time'], 0.0)
        self.assertGreaterEqual(ours['stopping drive time'], ours['known drive time'])
        self.assertEqual([name for name in other if 'perceived' in name], [])

    def test_bad_sensors_are_refused(self):
        drive = [bundled('perpendicular'), '--track', '--perceive']
        for text in ('', 'far', '-3', '0', 'nan', '20,', '20,0', '20,10,5', '1e9'):
            self.refused_plan(*drive, text, parts=['--perceive'])
        self.refused_plan(bundled('perpendicular'), '--perceive', '20', parts=['--perceive', 'requires --track'])
        self.refused_plan(*drive, '20', '--planner', 'RRTConnect', parts=['improved_astar', 'RRTConnect'])


if __name__ == '__main__':
    main()
