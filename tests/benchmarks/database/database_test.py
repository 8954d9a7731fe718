"""The database of a comparison has the tables that OMPL's own ompl_benchmark_statistics makes of the same logs.

usage: database_test.py WRITE_DATABASE FOLDER_OF_MADE_RESULTS
"""
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

WRITE_DATABASE, MADE_RESULTS = sys.argv[1:]
ORACLE = 'ompl_benchmark_statistics'

HEAD = '''OMPL version 1.5.2
Experiment {name}
2 experiment properties
cores INTEGER = 2
two-words REAL = 0.50
Running on some-host
Starting at 2026-11-22 08:00:00.000001
<<<|
Settings:
  of 'the' space; "quoted"
|>>>
<<<|
|>>>
1234 is the random seed
0.40 seconds per run
4096 MB per run
{runs} runs per planner
12.50 seconds spent to collect the data
2 enum types
status|Unknown status|Exact solution
outcome|solved|none
'''


def log(name, planners, runs=2):
    return f'{HEAD.format(name=name, runs=runs)}{len(planners)} planners\n{"".join(planners)}'


def planner(name, columns, rows, progress=None, settings=('range = 0.5', 'goal_bias = 0.05')):
    lines = [name, f'{len(settings)} common properties', *settings, f'{len(columns)} properties for each run', *columns,
             f'{len(rows)} runs', *(''.join(f'{cell}; ' for cell in row) for row in rows)]
    if progress is not None:
        lines += ['2 progress properties for each run', 'best cost REAL', 'time REAL', f'{len(progress)} runs']
        lines += [''.join(f'{cost},{time},;' for time, cost in moments) for moments in progress]
    return '\n'.join(lines + ['.']) + '\n'


ODD = [
    log('first', [
        planner('geometric_A', ['time REAL', 'solved BOOLEAN', 'outcome ENUM', 'graph states INTEGER'],
                [['0.1', '1', '0', '12'], ['nan', '0', '1', ''], ['inf', '1e3', '', '-7'], ['1e-300', '', '1', '1.5']],
                [[('0.05', 'inf'), ('0.1', '12.5'), ('0.1', '11')], [], [('nan', '3'), ('nan', '4')],
                 [('0.2', 'nan')]]),
        planner('geometric_B', ['time REAL'], [['0.25']]),
        planner('geometric_C', ['time REAL'], []),
        planner('geometric_D', ['time REAL', 'best cost REAL'], [['2', '3']], [], settings=())]),
    log('second', [
        planner('geometric_A', ['path length REAL', 'time REAL'], [['7', '0.5']], [[('0.5', '7')]]),
        planner('geometric_B', ['time REAL'], [['0.25']], settings=['range = 0.75'])]),
]


class DatabaseTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), 'w', encoding='utf-8') as stream:
            stream.write(text)
        return self.path(name)

    def ours(self, logs):
        database = self.path('ours.db')
        subprocess.run([WRITE_DATABASE, database, *logs], check=True)
        self.assertEqual([name for name in os.listdir(self.folder) if 'db' in name], ['ours.db'])
        return self.tables(database)

    def theirs(self, logs):
        if shutil.which(ORACLE) is None:
            self.skipTest(f'{ORACLE} is not installed (Debian package ompl-demos; from OMPL 2.0 on it needs Python bindings)')
        database = self.path('theirs.sqlite')
        subprocess.run([ORACLE, '-d', database, *logs], check=True, capture_output=True)
        return self.tables(database)

    @staticmethod
    def tables(database):
        """Of each table its columns with their types and keys, and its rows with their types."""
        connection = sqlite3.connect(database)
        names = [row[0] for row in connection.execute('SELECT name FROM sqlite_master WHERE type = "table"')]
        result = {}
        for name in names:
            columns = connection.execute(f'PRAGMA table_info({name})').fetchall()
            keys = connection.execute(f'PRAGMA foreign_key_list({name})').fetchall()
            rows = connection.execute(f'SELECT * FROM {name} ORDER BY rowid').fetchall()
            result[name] = (columns, keys, [[(type(cell).__name__, cell) for cell in row] for row in rows])
        connection.close()
        return result

    def assert_equal_tables(self, logs):
        ours, theirs = self.ours(logs), self.theirs(logs)
        self.assertEqual(set(ours), set(theirs))
        for name, table in theirs.items():
            self.assertEqual(ours[name], table, name)

    def test_equal_tables_of_odd_logs(self):
        logs = [self.write(f'{number}.log', text) for number, text in enumerate(ODD)]
        self.assert_equal_tables(logs)
        self.assert_equal_tables(logs[:1])
        self.assert_equal_tables([logs[1], logs[0], logs[1]])

    def test_equal_tables_of_a_comparison(self):
        subprocess.run([sys.executable, '-B', os.path.join(MADE_RESULTS, 'made_results.py'), self.folder, '--problems',
                        '3', '--planners', '4', '--runs', '9'], check=True, capture_output=True)
        logs = [self.path(name) for name in sorted(os.listdir(self.folder)) if name.endswith('.log')]
        self.assertEqual(len(logs), 3)
        self.assert_equal_tables(logs)

    def test_ten_thousand_runs(self):
        moments = [(f'{0.05 * k:.2f}', f'{20 - k}') for k in range(1, 9)]
        rows = [[f'{0.001 * k}', '1', str(k)] for k in range(10000)]
        text = log('large', [planner('geometric_A', ['time REAL', 'solved BOOLEAN', 'run INTEGER'], rows,
                                     [moments] * len(rows))], len(rows))
        tables = self.ours([self.write('large.log', text)])
        self.assertEqual(len(tables['runs'][2]), 10000)
        self.assertEqual(len(tables['progress'][2]), 80000)
        self.assertEqual([row[-1][1] for row in tables['runs'][2]], list(range(10000)))

    def refused(self, text, *parts):
        name = self.write('bad.log', text)
        done = subprocess.run([WRITE_DATABASE, self.path('ours.db'), name], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertEqual(os.listdir(self.folder), ['bad.log'])

    def test_what_is_no_log_is_refused(self):
        lines = ODD[0].splitlines(keepends=True)
        for number in range(1, len(lines)):
            with self.subTest(f'{number} lines'):
                self.refused(''.join(lines[:number]), f'bad.log:{number + 1}:')
        self.refused('junk\n', 'bad.log:1:', 'version')
        self.refused(ODD[0].replace('0.1; 1; 0; 12; ', '0.1; 1; 0; '), 'bad.log:33:', '4 figures, not 3')
        self.refused(ODD[0].replace('12.5,0.1,', '12.5,'), '2 figures, not 1')
        self.refused(ODD[0].replace('solved BOOLEAN', 'solved BOOLEAN);'), 'the type of a column')

    def test_an_earlier_database_stays_when_a_log_is_bad(self):
        before = self.ours([self.write('0.log', ODD[0])])
        bad = self.write('bad.log', ODD[1][:400])
        done = subprocess.run([WRITE_DATABASE, self.path('ours.db'), self.path('0.log'), bad], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.tables(self.path('ours.db')), before)
        self.assertEqual(sorted(os.listdir(self.folder)), ['0.log', 'bad.log', 'ours.db'])

    def test_names_are_only_names(self):
        text = log('odd', [planner("geometric_'; DROP TABLE runs; --", ['a"b select REAL', 'order REAL'], [['1', '2']])], 1)
        columns, _, rows = self.ours([self.write('odd.log', text)])['runs']
        self.assertEqual([column[1] for column in columns][3:], ['a"b_select', 'order'])
        self.assertEqual([cell[1] for cell in rows[0]], [1, 1, 1, 1.0, 2.0])


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
