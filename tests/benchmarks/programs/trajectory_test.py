"""parking_plan --trajectory: the optimised trajectory in the JSON, and what it costs."""

import math
import os

from programs import ProgramTest, bundled, main

FIELDS = {'t', 'x', 'y', 'yaw', 'v', 'steering', 'acceleration', 'steering_rate'}
LIMITS = {'v': 'max_speed', 'acceleration': 'max_acceleration', 'steering': 'max_steering_angle',
          'steering_rate': 'max_steering_rate'}
BUNDLED = ('parallel', 'perpendicular', 'angled45', 'narrow_parallel')


def clearance(vehicle, sample, corners):
    """Metres between the body and the nearest of some points."""
    front, rear = vehicle['wheelbase'] + vehicle['front_overhang'], -vehicle['rear_overhang']
    c, s = math.cos(sample['yaw']), math.sin(sample['yaw'])
    least = math.inf
    for x, y in corners:
        along, across = (c * (x - sample['x']) + s * (y - sample['y']), c * (y - sample['y']) - s * (x - sample['x']))
        least = min(least, math.hypot(max(rear - along, 0.0, along - front),
                                      max(abs(across) - 0.5 * vehicle['width'], 0.0)))
    return least


class TrajectoryTest(ProgramTest):

    def test_a_trajectory_keeps_to_the_limits_from_start_to_goal(self):
        for name in BUNDLED:
            result = self.planned(bundled(name), '--trajectory')
            samples, vehicle = result['planned_trajectory'], result['vehicle']
            x, y, yaw = (samples[0][field] for field in ('x', 'y', 'yaw'))
            for before, after in zip(samples, samples[1:]):
                self.assertEqual(set(before), FIELDS)
                step = after['t'] - before['t']
                self.assertGreater(step, 0.0)
                for field, limit in LIMITS.items():
                    self.assertLessEqual(abs(before[field]), vehicle[limit] * 1.0001, (name, field))
                self.assertAlmostEqual(after['v'], before['v'] + step * before['acceleration'], delta=1e-6)
                self.assertAlmostEqual(after['steering'], before['steering'] + step * before['steering_rate'],
                                       delta=1e-6)
                for part in range(20):  # by the midpoint rule
                    share = (part + 0.5) / 20.0
                    v = before['v'] + share * (after['v'] - before['v'])
                    steering = before['steering'] + share * (after['steering'] - before['steering'])
                    turn = step / 20.0 * v * math.tan(steering) / vehicle['wheelbase']
                    x += step / 20.0 * v * math.cos(yaw + 0.5 * turn)
                    y += step / 20.0 * v * math.sin(yaw + 0.5 * turn)
                    yaw += turn
                self.assertLess(math.hypot(x - after['x'], y - after['y']), 0.002, name)
            goal = result['path'][-1]
            self.assertLess(math.hypot(x - goal['x'], y - goal['y']), 0.005, name)
            self.assertEqual((samples[0]['v'], samples[-1]['v']), (0.0, 0.0))

    def test_it_is_quicker_than_stopping_to_steer_and_says_what_it_costs(self):
        for name in BUNDLED:
            result = self.planned(bundled(name), '--trajectory', '--track')
            figures = result['trajectory_optimization']
            self.assertFalse(figures['fallback'], figures['message'])
            self.assertLess(figures['duration_s'], result['tracking']['travel_time_s'])
            self.assertAlmostEqual(figures['duration_s'], result['planned_trajectory'][-1]['t'], delta=1e-6)
            cost = figures['tpcap_cost']
            self.assertAlmostEqual(cost['time_s'], figures['duration_s'], delta=1e-6)
            self.assertAlmostEqual(cost['J'], 100.0 * cost['time_s'] + 10.0 * cost['control_effort'] +
                                   10.0 * cost['steering_integral'] + 5.0 * cost['gear_changes'], delta=1e-6)
            self.assertGreater(figures['time_ms'], 0.0)

    def test_one_that_is_driven_keeps_what_a_controller_errs_by(self):
        # Two corners that the quickest way between them all but touches, while the path keeps 12 cm.
        blocks = [[(-6.0, 1.2), (4.0, 1.2), (4.0, 12.0), (-6.0, 12.0)],
                  [(9.0, -8.0), (24.0, -8.0), (24.0, 2.6), (9.0, 2.6)]]
        lines = ''.join('  - [%s]\n' % ', '.join('[%g, %g]' % corner for corner in block) for block in blocks)
        scenario = self.write('corners.yaml', 'start: [0, 0, 0]\ngoal: [14, 4, 0]\npolygons:\n' + lines)
        kept = {}
        for options in ((), ('--track',)):
            result = self.planned(scenario, '--trajectory', *options)
            kept[options] = min(clearance(result['vehicle'], sample, block)
                                for sample in result['planned_trajectory'] for block in blocks)
            self.assertGreater(result['min_clearance_m'], 0.1)
        self.assertLess(kept[()], 0.01)
        self.assertGreater(kept[('--track',)], 0.018)
        self.assertEqual(result['tracking']['collisions'], 0)

    def test_the_table_holds_what_the_json_holds_and_equal_runs_give_equal_trajectories(self):
        result = self.planned(bundled('parallel'), '--trajectory', '--csv', self.path('a.csv'))
        again = self.planned(bundled('parallel'), '--trajectory')
        self.assertEqual(result['planned_trajectory'], again['planned_trajectory'])
        lines = self.read('a.csv').splitlines()
        self.assertEqual(lines[0], 't,x,y,yaw,v,a,steering,steering_rate')
        self.assertEqual(len(lines) - 1, len(result['planned_trajectory']))
        for line, sample in zip(lines[1:], result['planned_trajectory']):
            fields = ('t', 'x', 'y', 'yaw', 'v', 'acceleration', 'steering', 'steering_rate')
            self.assertEqual([float(text) for text in line.split(',')], [sample[field] for field in fields])
        self.refused_plan(bundled('parallel'), '--csv', 'a.csv', parts=['--trajectory'])

    def test_a_table_that_cannot_be_written_is_no_success(self):
        grid = [bundled('parallel'), '--trajectory', '--set', 'motion_model=grid8']
        result = self.planned(*grid)
        self.assertEqual(result['planned_trajectory'], [])
        self.assertIn('turns on the spot', result['trajectory_optimization']['message'])
        done = self.plan(*grid, '--csv', 'a.csv', status=4)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for part in ('a.csv is not written', 'turns on the spot'):
            self.assertIn(part, done.stderr)
        self.assertNotIn('trajectory: trajectory', done.stdout + done.stderr)
        self.assertFalse(os.path.exists(self.path('a.csv')))
        self.assertEqual(self.plan(*grid).stderr, '')  # without a table to write there is none missing

    def test_a_straight_way_has_nothing_to_say_about_steering(self):
        self.write('straight.yaml', 'start: [0, 0, 0]\ngoal: [9, 0, 0]\npolygons: []\n')
        self.assertRegex(self.plan('straight.yaml', '--trajectory').stdout, r'trajectory: [0-9.]+ s, found in [0-9.]+ ms\n')


if __name__ == '__main__':
    main()
