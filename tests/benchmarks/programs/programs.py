"""What the tests of the programs share: where the programs are, how they are run, where test files go."""

import json
import os
import shutil
import sqlite3
import subprocess
import tempfile
import unittest
from contextlib import closing

SOURCE = os.environ['PARKING_SOURCE_DIR']
PLAN = os.environ['PARKING_PLAN']
BENCHMARK = os.environ['PARKING_BENCHMARK']
SHARED_DATA = os.environ['PARKING_SHARED_DATA']
SANITIZER = os.environ.get('PARKING_SANITIZER', '')
TIMEOUT_FACTOR = int(os.environ.get('PARKING_TIMEOUT_FACTOR', '1'))  # times the seconds that a program may take
SCENARIOS = os.path.join(SOURCE, 'benchmarks', 'scenarios')
VERIFY = os.path.join(os.path.dirname(SHARED_DATA.rstrip('/')), 'tools', 'verify_path.py')


def bundled_scenarios():
    """Names of the problems that come with the project."""
    names = []
    for name in sorted(os.listdir(SCENARIOS)):
        if name.endswith('.yaml') and not name.endswith('_map.yaml'):
            names.append(name[:-len('.yaml')])
    return names


def bundled(name):
    return os.path.join(SCENARIOS, name + '.yaml')


IDS = ('id', 'runid', 'experimentid', 'plannerid')  # of rows, in the order in which they were finished


def depends_on_the_clock(name):
    return 'time' in name or 'memory' in name


class ProgramTest(unittest.TestCase):
    """A test in a folder of its own, which is the programs' working folder and gone afterwards."""

    maxDiff = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix='parking_test_')
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        mode = 'wb' if isinstance(content, bytes) else 'w'
        with open(self.path(name), mode) as stream:
            stream.write(content)
        return self.path(name)

    def read(self, name):
        with open(self.path(name)) as stream:
            return stream.read()

    def query(self, database, statement):
        with closing(sqlite3.connect(self.path(database))) as connection:
            return connection.execute(statement).fetchall()

    def records(self, *databases, clock=False):
        """The runs in databases of comparisons, in a fixed order; without what depends on the machine's speed unless clock."""
        runs = []
        for database in databases:
            with closing(sqlite3.connect(self.path(database))) as connection:
                connection.row_factory = sqlite3.Row
                costs = {}
                for run, improvements in connection.execute('SELECT runid, improvements FROM details'):
                    costs[run] = [cost for _, cost in json.loads(improvements)]
                for row in connection.execute('''
                        SELECT experiments.name AS experiment, plannerConfigs.name AS planner, settings, details.*, runs.*
                        FROM runs JOIN experiments ON experimentid = experiments.id
                        JOIN plannerConfigs ON plannerid = plannerConfigs.id JOIN details ON runid = runs.id'''):
                    run = {name: row[name] for name in ('experiment', 'planner', 'settings', 'fingerprint', 'reason')}
                    run['planner'] = run['planner'][len('geometric_'):]
                    run['path'] = json.loads(row['path'] or 'null')
                    run['progress'] = costs.get(row['id'], [])
                    run['figures'] = {name.replace('_', ' '): row[name] for name in row.keys()[9:] if row[name] is not None
                                      and name not in IDS and (clock or not depends_on_the_clock(name))}
                    runs.append(run)
        return sorted(runs, key=lambda run: (run['experiment'], run['planner'], run['figures']['run']))

    def run_program(self, *command, timeout=120, **options):
        return subprocess.run([str(part) for part in command], cwd=self.folder, capture_output=True, text=True,
                              timeout=timeout * TIMEOUT_FACTOR, check=False, **options)

    def plan(self, *arguments, status=0, **options):
        """Runs parking_plan; its exit status must be this one."""
        done = self.run_program(PLAN, *arguments, **options)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def planned(self, *arguments, status=0, **options):
        """The JSON that parking_plan prints."""
        return json.loads(self.plan(*arguments, '--json', '-', status=status, **options).stdout)

    def benchmark(self, *arguments, status=0, **options):
        """Runs parking_benchmark, without a report; its exit status must be this one."""
        done = self.run_program(BENCHMARK, '--no-report', *arguments, **options)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def assert_refused(self, done, *parts):
        """Exit status 2 and one line on standard error that has all of these parts in it; nothing else is said."""
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stdout, '')
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def refused_plan(self, *arguments, parts=(), **options):
        self.assert_refused(self.run_program(PLAN, *arguments, **options), *parts)

    def refused_benchmark(self, *arguments, parts=(), **options):
        self.assert_refused(self.run_program(BENCHMARK, *arguments, **options), *parts)


def main():
    unittest.main(verbosity=2)
