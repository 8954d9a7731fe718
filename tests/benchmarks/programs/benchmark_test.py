"""parking_benchmark from a .cfg file to its results: files, database, interrupting and going on, shards."""

import contextlib
import csv
import glob
import math
import os
import pty
import shutil
import signal
import sqlite3
import subprocess
import time
import unittest
import xml.etree.ElementTree
from contextlib import closing

from programs import BENCHMARK, IDS, SOURCE, ProgramTest, bundled, main

# Planners that come to an end by themselves: with a generous limit their results do not depend on the machine's speed.
CONFIG = '''
[problem]
scenario = {angled}
scenario = {perpendicular}
[benchmark]
time_limit = 20
run_count = 2
seed = 3
[planner]
improved_astar=
improved_astar.xy_resolution=0.3
reeds_shepp=
RRTConnect=
RRTConnect=
RRTConnect.name=short_steps
RRTConnect.range=2
'''.format(angled=bundled('angled45'), perpendicular=bundled('perpendicular'))
PLANNERS = {'improved_astar', 'reeds_shepp', 'RRTConnect', 'short_steps'}
RUNS = 2 * 2 * len(PLANNERS)


class BenchmarkTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write('set.cfg', CONFIG)


class OnATerminal(BenchmarkTest):
    def shown(self, **environment):
        """What parking_benchmark prints on a terminal."""
        ours, theirs = pty.openpty()
        child = subprocess.Popen([BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--no-report', '--planner', 'reeds_shepp'],
                                 cwd=self.folder, stdout=theirs, env={**os.environ, 'TERM': 'xterm', 'NO_COLOR': '', **environment})
        os.close(theirs)
        text = b''
        with contextlib.suppress(OSError):  # the end, on Linux
            while part := os.read(ours, 4096):
                text += part
        os.close(ours)
        self.assertEqual(child.wait(), 0)
        return text.decode()

    def test_colours_unless_the_user_or_the_terminal_has_none(self):
        self.assertIn('\033[1mangled45\033[0m', self.shown())
        self.assertNotIn('\033', self.shown(NO_COLOR='1'))
        self.assertNotIn('\033', self.shown(TERM='dumb'))
        done = self.benchmark('set.cfg', '--output', 'out', '--quiet', '--planner', 'reeds_shepp')
        self.assertNotIn('\033', done.stdout)

    def test_the_report_is_the_last_line_and_tables_have_80_columns(self):
        done = self.run_program(BENCHMARK, 'set.cfg', '--output', 'out', '--quiet')
        lines = done.stdout.splitlines()
        self.assertEqual(lines[-2:], ['', 'Report: out/report.html'])
        self.assertLessEqual(max(map(len, lines[:lines.index('Results:')])), 80)


class Results(BenchmarkTest):
    def test_a_comparison_leaves_log_database_tables_and_pictures(self):
        self.write('set.cfg', CONFIG.replace('[planner]', 'save_paths = shortest\n[planner]'))
        done = self.benchmark('set.cfg', '--output', 'out', '--quiet')
        self.assertEqual(done.stderr, '')
        self.assertEqual(len(self.records('out/benchmark.db')), RUNS)
        for name in ('angled45', 'perpendicular'):
            log = self.read('out/%s.log' % name)
            self.assertRegex(log, r'\AOMPL version [1-9][0-9.]+\nExperiment ' + name + '\n')
            picture = xml.etree.ElementTree.fromstring(self.read('out/pictures/%s.svg' % name))
            self.assertTrue(picture.tag.endswith('svg'))
            self.assertIn(name, done.stdout)
        for file in ('out/benchmark.db', 'out/summary.md', 'out/summary.csv'):
            self.assertIn(file, done.stdout)
        self.assertIn('improved_astar', self.read('out/summary.md'))
        self.assertEqual(self.leftovers('out'), [])
        with open(self.path('out/paths/angled45-improved_astar-0.csv')) as stream:
            path = list(csv.DictReader(stream))
        self.assertEqual(set(path[0]), {'x', 'y', 'yaw', 'direction', 'curvature'})
        self.assertAlmostEqual(float(path[0]['x']), -11.5, delta=1e-4)

    def leftovers(self, folder):
        return [name for name in os.listdir(self.path(folder)) if '.new' in name or 'tmp' in name]

    def test_nothing_is_left_in_the_working_folder_even_while_it_runs(self):
        self.write('set.cfg', CONFIG + 'RRTstar=\n')
        process = subprocess.Popen([BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--no-report', '--runs', '1',
                                    '--time', '1.5', '--planner', 'RRTstar'], cwd=self.folder,
                                   stdout=subprocess.DEVNULL)
        seen = set()
        while process.poll() is None:
            seen.update(os.listdir(self.folder))
            time.sleep(0.02)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(seen, {'set.cfg', 'out'})

    def columns(self, table):
        return [name for name, in self.query('out/benchmark.db', f"SELECT name FROM pragma_table_info('{table}')")]

    def test_the_database_has_the_schema_of_ompl(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet')
        names = self.columns('experiments')
        for name in ('id', 'name', 'totaltime', 'timelimit', 'memorylimit', 'runcount', 'version', 'hostname', 'cpuinfo',
                     'date', 'seed', 'setup'):
            self.assertIn(name, names)
        self.assertEqual(len(names), 12)  # Planner Arena takes others for parameters of the problem
        for name in ('ompl_version', 'fcl_version', 'project_version', 'cores'):
            self.assertIn(name, self.columns('all_experiments'))
        names = self.columns('runs')
        for name in ('experimentid', 'plannerid', 'solved', 'time', 'memory', 'status', 'solution_length', 'success',
                     'first_solution_time', 'path_length', 'cusps', 'densely_valid', 'least_clearance', 'seed', 'run'):
            self.assertIn(name, names)
        rows = self.query('out/benchmark.db', 'SELECT name FROM plannerConfigs')
        self.assertEqual({name for name, in rows}, {'geometric_' + name for name in PLANNERS})
        for table in ('enums', 'progress'):
            self.query('out/benchmark.db', 'SELECT * FROM ' + table)
        rows = self.query('out/benchmark.db', '''
            SELECT settings FROM plannerConfigs WHERE name = 'geometric_short_steps' ''')
        self.assertIn('range = 2', rows[0][0])
        rows = self.query('out/benchmark.db', '''
            SELECT COUNT(*) FROM runs JOIN plannerConfigs ON plannerid = plannerConfigs.id
            WHERE name = 'geometric_improved_astar' AND success AND densely_valid AND path_length > 5''')
        self.assertEqual(rows, [(4,)])

    @unittest.skipUnless(shutil.which('ompl_benchmark_statistics'), 'Debian has it in ompl-demos')
    def test_the_database_is_what_ompl_makes_of_the_logs(self):
        self.write('set.cfg', CONFIG.replace('[planner]', 'simplify = yes\n[planner]') + 'RRTstar=\n')
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--time', 0.3)
        done = self.run_program('ompl_benchmark_statistics', '-d', 'out/theirs.db',
                                *sorted(glob.glob(self.path('out/*.log'))))
        self.assertEqual(done.returncode, 0, done.stderr)

        def cell(value):
            if isinstance(value, float):
                return None if value == math.inf else float(f'{value:.12g}')  # SQLite reads numbers to a bit or two
            return value

        def tables(database):
            with closing(sqlite3.connect(self.path(database))) as connection:
                connection.row_factory = sqlite3.Row
                experiments = {row['name']: {name: cell(row[name]) for name in row.keys() if name != 'id'}
                               for row in connection.execute('SELECT * FROM experiments')}
                runs = {}
                for row in connection.execute('''
                        SELECT experiments.name AS experiment, plannerConfigs.name AS planner, settings, runs.* FROM runs
                        JOIN experiments ON experimentid = experiments.id
                        JOIN plannerConfigs ON plannerid = plannerConfigs.id'''):
                    steps = connection.execute('SELECT time, best_cost FROM progress WHERE runid = ? ORDER BY time',
                                               (row['id'],)).fetchall()
                    runs[row['experiment'], row['planner'], row['run']] = (
                        {name: cell(row[name]) for name in row.keys() if name not in IDS},
                        [tuple(map(cell, step)) for step in steps])
                types = {table: {name: kind for _, name, kind, *_ in connection.execute(f'PRAGMA table_info({table})')}
                         for table in ('experiments', 'plannerConfigs', 'enums', 'runs', 'progress')}
                return experiments, runs, types, sorted(map(tuple, connection.execute('SELECT * FROM enums')))

        for ours, theirs in zip(tables('out/benchmark.db'), tables('out/theirs.db')):
            self.assertEqual(ours, theirs)

    def test_time_outs_count_as_infinite_and_cost_falls_over_time(self):
        self.write('set.cfg', CONFIG.replace('improved_astar.xy_resolution=0.3', 'RRTstar='))
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--planner', 'RRTstar', '--planner', 'reeds_shepp', '--time', 0.5)
        with open(self.path('out/summary.csv')) as stream:
            for row in csv.DictReader(stream):
                if row['planner'] == 'reeds_shepp':
                    self.assertEqual((row['runs'], row['solved'], row['first_solution_median_s']), ('2', '0', ''))
        costs = {}
        for run, cost in self.query('out/benchmark.db', '''SELECT runid, best_cost FROM progress WHERE best_cost IS NOT NULL
                                    ORDER BY runid, time'''):
            costs.setdefault(run, []).append(cost)
        self.assertTrue(costs)
        for each in costs.values():
            self.assertEqual(each, sorted(each, reverse=True))

    def test_the_same_seed_gives_the_same_results(self):
        for folder, seed in (('a', 3), ('b', 3), ('c', 4)):
            self.benchmark('set.cfg', '--output', folder, '--quiet', '--seed', seed)
        self.assertEqual(self.records('a/benchmark.db'), self.records('b/benchmark.db'))
        self.assertNotEqual(self.records('a/benchmark.db'), self.records('c/benchmark.db'))

    def test_each_problem_in_its_setting(self):
        self.write('set.cfg', CONFIG.replace('scenario = %s\n' % bundled('angled45'),
                                             'scenario = %s\n' % bundled('underground_garage')) + '''
improved_astar=
improved_astar.name=grid16
improved_astar.motion_model=grid16
improved_astar.only=underground*
improved_astar.problem.space=se2
improved_astar.problem.footprint=circle
''')
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1, '--planner', 'grid16', '--planner',
                       'improved_astar')
        runs = self.records('out/benchmark.db')
        self.assertEqual([(run['experiment'], run['planner']) for run in runs],
                         [('perpendicular', 'improved_astar'), ('underground_garage', 'improved_astar'),
                          ('underground_garage_se2_circle', 'grid16')])
        self.assertEqual([run['figures']['success'] for run in runs], [True, True, True])

    def test_the_cost_of_all_paths_is_that_of_the_objective(self):
        for objective in ('length', 'driving', None):
            self.write('set.cfg', CONFIG.replace('[benchmark]', 'objective = %s\n[benchmark]' % objective
                                                 if objective else '[benchmark]'))
            self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1, '--planner', 'RRTConnect',
                           '--planner', 'improved_astar')
            runs = [run['figures'] for run in self.records('out/benchmark.db')]
            self.assertEqual(len(runs), 4)
            for run in runs:
                self.assertEqual('path cost' in run, objective is not None)
                if objective == 'length':
                    self.assertAlmostEqual(run['path cost'], run['path length'], delta=1e-4)
                elif objective:
                    # The penalties of the planner's defaults.
                    self.assertGreater(run['path cost'], run['path length'] + 0.5 * run['cusps'] - 1e-4)

    def test_paths_are_not_longer_if_the_length_is_the_objective(self):
        names = ('angled45', 'dead_end_aisle', 'multi_storey', 'narrow_parallel', 'narrow_perpendicular', 'parallel',
                 'perceived_street', 'perpendicular', 'tight_parallel', 'underground_garage')
        self.write('set.cfg', '[problem]\n%s[benchmark]\ntime_limit = 60\nrun_count = 1\n[planner]\nimproved_astar=\n'
                   'improved_astar=\nimproved_astar.name=shortest\nimproved_astar.problem.objective=length\n' %
                   ''.join('scenario = %s\n' % bundled(name) for name in names))
        self.benchmark('set.cfg', '--output', 'out', '--quiet')
        lengths = {(run['experiment'], run['planner']): run['figures']['path length']
                   for run in self.records('out/benchmark.db')}
        for name in names:
            with self.subTest(name):
                self.assertLessEqual(lengths[name + '_length', 'shortest'], lengths[name, 'improved_astar'] + 1e-6)

    def test_simplified_driven_and_timed_paths_are_reported_beside(self):
        self.write('set.cfg', CONFIG.replace('[planner]', 'simplify = yes\ntrack = yes\ntrajectory = yes\n[planner]'))
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1, '--planner', 'RRTConnect', '--planner',
                       'improved_astar')
        runs = [run['figures'] for run in self.records('out/benchmark.db')]
        self.assertEqual(len(runs), 4)
        for run in runs:
            for name in ('simplified densely valid', 'driven to the end', 'mean acceleration', 'mean steering angle'):
                self.assertIn(name, run)
            self.assertLessEqual(run['simplified path length'], run['path length'] + 1e-6)
            time = run['trajectory duration']
            # TPCAP's cost; the trajectory stays near the path, and no car drives it faster than 2.5 m/s.
            cost = (100 * time + 10 * (run['trajectory control effort'] + run['trajectory steering integral']) +
                    5 * run['trajectory gear changes'])
            self.assertAlmostEqual(run['trajectory cost'], cost, delta=1e-6 * cost)
            self.assertLess(0.5 * run['path length'] / 2.5, time)


class GoingOn(BenchmarkTest):
    def has_runs(self, number):
        try:
            return self.query('out/benchmark.db', 'SELECT COUNT(*) FROM runs') >= [(number,)]
        except sqlite3.OperationalError:  # no tables yet
            return False

    def start_and_interrupt(self, finished, number):
        """Interrupts a comparison once this many runs are finished."""
        process = subprocess.Popen([BENCHMARK, 'set.cfg', '--no-report', '--output', 'out', '--runs', str(number)], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        file = self.path('out/benchmark.db')
        while process.poll() is None and time.monotonic() < deadline:
            if os.path.exists(file) and self.has_runs(finished):
                process.send_signal(signal.SIGINT)
                break
            time.sleep(0.002)
        _, errors = process.communicate(timeout=60)
        return process.returncode, errors

    def test_interrupted_and_started_again(self):
        number = 8
        status, errors = self.start_and_interrupt(5, number)
        self.assertEqual(status, 130, errors)
        self.assertIn('rerun the command to resume', errors)
        kept = self.records('out/benchmark.db')
        self.assertGreaterEqual(len(kept), 5)
        self.assertLess(len(kept), 8 * number)
        done = self.benchmark('set.cfg', '--output', 'out', '--runs', number)
        self.assertIn('Resuming: %d of %d' % (len(kept), 8 * number), done.stderr)
        self.benchmark('set.cfg', '--output', 'whole', '--runs', number, '--quiet')
        self.assertEqual(self.records('out/benchmark.db'), self.records('whole/benchmark.db'))

    def test_more_runs_are_added_to_what_there_is(self):
        self.benchmark('set.cfg', '--output', 'out', '--runs', 1, '--quiet')
        before = self.records('out/benchmark.db', clock=True)
        done = self.benchmark('set.cfg', '--output', 'out', '--runs', 2)
        self.assertIn('Resuming: %d of %d' % (RUNS // 2, RUNS), done.stderr)
        after = self.records('out/benchmark.db', clock=True)
        self.assertEqual([run for run in after if run['figures']['run'] == 0], before)
        # With fewer they are of no use for a while.
        self.benchmark('set.cfg', '--output', 'out', '--runs', 1, '--quiet')
        self.assertEqual(self.records('out/benchmark.db', clock=True), before)
        self.benchmark('set.cfg', '--output', 'out', '--runs', 2, '--quiet')
        self.assertEqual(self.records('out/benchmark.db', clock=True), after)

    def test_what_is_different_is_kept_and_comes_back(self):
        self.benchmark('set.cfg', '--output', 'out', '--runs', 1, '--quiet')
        first = self.records('out/benchmark.db', clock=True)
        os.remove(self.path('out/angled45.log'))
        for arguments, isThere in ((['--seed', 9], False), ([], True), (['--seed', 9], True), (['--fresh'], False)):
            with self.subTest(arguments):
                done = self.benchmark('set.cfg', '--output', 'out', '--runs', 1, *arguments)
                self.assertEqual('All 8 runs are already finished; --fresh' in done.stderr, isThere)
                self.assertTrue(os.path.exists(self.path('out/angled45.log')))
                self.assertEqual(self.records('out/benchmark.db', clock=True) == first, arguments == [])
        self.assertEqual(self.query('out/benchmark.db', 'SELECT COUNT(*) FROM all_runs'), [(3 * RUNS // 2,)])


class Shards(BenchmarkTest):
    def test_shards_merged_are_one_run_with_and_without_isolation(self):
        self.benchmark('set.cfg', '--output', 'whole', '--quiet')
        whole = self.records('whole/benchmark.db')
        for isolation in ([], ['--isolate']):
            folder = 'parts' + ''.join(isolation)
            for i in (1, 2, 3):
                done = self.benchmark('set.cfg', '--output', folder, '--quiet', '--shard', '%d/3' % i, *isolation)
                self.assertIn('--merge', done.stdout)
            parts = [folder + '/benchmark-%d-of-3.db' % i for i in (1, 2, 3)]
            counts = [len(self.records(part)) for part in parts]
            self.assertEqual(sum(counts), RUNS)
            self.assertLessEqual(max(counts) - min(counts), 1)
            self.benchmark('set.cfg', '--output', folder, '--merge')
            self.assertEqual(self.records(*parts), whole)
            self.assertEqual(self.records(folder + '/benchmark.db'), whole)

    def test_a_shard_that_is_missing(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--shard', '1/2')
        done = self.benchmark('set.cfg', '--output', 'out', '--merge', status=1)
        self.assertIn('%d runs are missing' % (RUNS // 2), done.stderr)

    def test_shards_from_elsewhere(self):
        for i in (1, 2):
            self.benchmark('set.cfg', '--output', 'host%d' % i, '--quiet', '--shard', '%d/2' % i)
        self.benchmark('set.cfg', '--output', 'all', '--merge', '--from', 'host1', '--from',
                       'host2/benchmark-2-of-2.db')
        self.assertEqual(len(self.records('all/benchmark.db')), RUNS)
        self.refused_benchmark('set.cfg', '--output', 'all', '--merge', '--from', 'host1', '--seed', 8,
                               parts=['another comparison'])

    def test_shards_at_the_same_time_as_tasks_of_a_slurm_job_array(self):
        self.benchmark('set.cfg', '--output', 'whole', '--quiet')
        script = os.path.join(SOURCE, 'benchmarks', 'slurm_array')
        array = dict(os.environ, PARKING_BENCHMARK=BENCHMARK, SLURM_ARRAY_TASK_MIN='3', SLURM_ARRAY_TASK_STEP='2',
                     SLURM_ARRAY_TASK_COUNT='4')
        tasks = [subprocess.Popen([script, 'set.cfg', 'parts', '--no-report'], cwd=self.folder, stdout=subprocess.DEVNULL,
                                  env=dict(array, SLURM_ARRAY_TASK_ID=task)) for task in ('3', '5', '7', '9')]
        self.assertEqual([task.wait(120) for task in tasks], [0] * 4)
        self.assertEqual(len(glob.glob(self.path('parts/benchmark-*-of-4.db'))), 4)
        self.benchmark('set.cfg', '--output', 'parts', '--merge', '--quiet')
        self.assertEqual(self.records('parts/benchmark.db'), self.records('whole/benchmark.db'))
        # A signal to the job reaches the program.
        job = subprocess.Popen([script, 'set.cfg', 'long', '--runs', '1000'], cwd=self.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, env=dict(array, SLURM_ARRAY_TASK_ID='3'))
        time.sleep(1.0)
        job.send_signal(signal.SIGTERM)
        _, errors = job.communicate(timeout=60)
        self.assertEqual((job.returncode, 'rerun the command to resume' in errors), (130, True), errors)
        done = self.run_program(script, 'set.cfg')
        self.assertEqual((done.returncode, done.stderr.count('usage: sbatch')), (2, 1))


if __name__ == '__main__':
    main()
