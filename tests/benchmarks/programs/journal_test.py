"""Nothing is lost: parking_benchmark killed at random instants, on a disk that fills up, with two at a time, with planners
that come and go, and with garbage in the place of its database."""

import os
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import time
from contextlib import closing, suppress

from programs import BENCHMARK, ProgramTest, bundled, main

FULL_DISK = os.environ['PARKING_FULL_DISK']
KILLS = int(os.environ.get('PARKING_KILLS', '200'))
EACH, STRIDE = 30, 14  # of the writes to a full disk: those that are tried one by one, and the step for the many after them
CONFIG = '''
[problem]
scenario = {angled}
[benchmark]
time_limit = 20
seed = 3
[planner]
improved_astar=
reeds_shepp=
'''.format(angled=bundled('angled45'))


class JournalTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write('set.cfg', CONFIG)

    def content(self, name='out/benchmark.db'):
        with open(self.path(name), 'rb') as stream:
            return stream.read()

    def kept(self, name='out/benchmark.db'):
        """All that is in a database, read from a copy: what a killed process left half done stays for the next one."""
        shutil.rmtree(self.path('copy'), ignore_errors=True)
        os.mkdir(self.path('copy'))
        for suffix in ('', '-journal'):
            with suppress(FileNotFoundError):
                shutil.copy(self.path(name + suffix), self.path('copy/runs.db' + suffix))
        try:
            return self.records('copy/runs.db', clock=True)
        except sqlite3.OperationalError:  # no file, or no tables yet
            return []

    def assert_all_there(self, kept, now):
        for run in kept:
            self.assertIn(run, now, 'a run that was there is gone')

    def results(self):
        """Everything but the database."""
        return sorted(name for name in os.listdir(self.path('out')) if name != 'benchmark.db')


class Killed(JournalTest):
    def test_killed_at_random_instants(self):
        runs = 8
        command = [BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--runs', str(runs)]
        quick = command + ['--no-report']

        def seconds(arguments):
            begin = time.monotonic()
            self.assertEqual(self.run_program(*arguments[:3], 'whole', *arguments[4:]).returncode, 0)
            return time.monotonic() - begin

        planning, rewriting, reporting = seconds(quick), seconds(quick), seconds(command)
        wanted = self.records('whole/benchmark.db')
        self.assertEqual(len(wanted), 2 * runs)
        rng = random.Random(1)
        killed = {'planning': 0, 'writing': 0}
        rounds = 0
        while sum(killed.values()) < KILLS:
            shutil.rmtree(self.path('out'), ignore_errors=True)
            kept, done, planned, rounds = [], False, False, rounds + 1
            # The report is made last and takes longest: most rounds do without, so that there can be many kills.
            reported = rounds % 12 == 1
            arguments = command if reported else quick
            # At least one process of a round finds all runs finished, and is hit while it writes the results again.
            while not (done and planned):
                planned = len(kept) == 2 * runs
                process = subprocess.Popen(arguments, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                try:
                    whole = reporting if planned and reported else rewriting if planned else planning
                    process.wait(rng.uniform(0.0, 1.2 * whole))
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGKILL)
                _, errors = process.communicate()
                done = process.returncode == 0
                now = self.kept()
                self.assert_all_there(kept, now)
                kept = now
                if not done:
                    self.assertEqual(process.returncode, -signal.SIGKILL, errors)
                    killed['writing' if len(kept) == 2 * runs else 'planning'] += 1
            self.assertEqual(self.records('out/benchmark.db'), wanted)
            self.assertEqual(self.query('out/benchmark.db', 'SELECT COUNT(*) FROM all_runs'), [(2 * runs,)])
            self.assertEqual(self.results(),
                             sorted(['angled45.log', 'pictures', 'summary.csv', 'summary.md'] +
                                    reported * ['pairs.csv', 'report.html', 'standings.csv', 'statistics.json']))
            self.assertEqual(os.listdir(self.path('out/pictures')), ['angled45.svg'])
        print('killed %s in %d rounds' % (killed, rounds))
        self.assertGreater(min(killed.values()), KILLS // 20)

    def test_remains_go_away_and_nothing_else(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1)
        before = self.results()
        for name in ('summary.md.new.aB3xYz', '.report-abc', 'pictures/angled45.svg.new.aB3xYz'):
            self.write('out/' + name, 'half')
        self.write('out/summary.md.backup', 'mine')
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1)
        self.assertEqual(self.results(), sorted(before + ['summary.md.backup']))
        self.assertEqual(os.listdir(self.path('out/pictures')), ['angled45.svg'])


class FullDisk(JournalTest):
    def start(self, room, *arguments):
        """Starts it with room for so many writes; returns it and the number of those it wanted."""
        with open(self.path('counter'), 'wb') as stream:
            stream.write(bytes(8))
        environment = dict(os.environ, LD_PRELOAD=FULL_DISK, FULL_DISK_COUNTER=self.path('counter'),
                           FULL_DISK_AFTER=str(room), ASAN_OPTIONS='verify_asan_link_order=0')
        done = self.run_program(BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', *arguments, env=environment)
        with open(self.path('counter'), 'rb') as stream:
            return done, int.from_bytes(stream.read(), 'little')

    def test_full_at_every_write(self):
        wanted = None
        room, failures = 0, 0
        while True:
            shutil.rmtree(self.path('out'), ignore_errors=True)
            done, _ = self.start(room, '--runs', 2)
            if done.returncode == 0:
                break
            with self.subTest(room):
                # Of the report it is said beside the results that there are.
                self.assertIn(done.returncode, (1, 2))
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertRegex(done.stderr, r'^parking_benchmark: (standard output|out\b).*')
                kept = self.kept()
                self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 2)
                self.assert_all_there(kept, self.kept())
                wanted = wanted or self.records('out/benchmark.db')
                self.assertEqual(self.records('out/benchmark.db'), wanted)
            failures += 1
            room += 1 if room < EACH else STRIDE
        print('%d of %d writes failed' % (failures, room))
        self.assertGreater(failures, 10)

    def test_full_while_something_is_replaced(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1)
        old, lines = self.kept(), self.content('out/summary.md').count(b'\n')
        for room in range(0, 60, 5):
            with self.subTest(room):
                done, _ = self.start(room, '--runs', 1, '--seed', 4)
                self.assertIn(done.returncode, (1, 2), done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                # Old or new, but whole.
                self.assertEqual(self.content('out/summary.md').count(b'\n'), lines)
                self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1)
                self.assertEqual(self.kept(), old)
                self.assertEqual(self.query('out/benchmark.db', 'PRAGMA integrity_check'), [('ok',)])


class TwoAtATime(JournalTest):
    def test_another_process_touches_nothing(self):
        self.benchmark('set.cfg', '--output', 'whole', '--quiet', '--runs', 60)
        process = subprocess.Popen([BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--no-report', '--runs', '60'],
                                   cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        refused = 0
        while process.poll() is None:
            if not self.kept():
                time.sleep(0.002)
                continue
            for arguments in (['--fresh'], ['--time', '3'], []):
                other = self.run_program(BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--runs', 60, *arguments)
                if process.poll() is None:
                    self.assert_refused(other, 'out/benchmark.db', 'another parking_benchmark')
                    refused += 1
                else:
                    break
            else:
                continue
            break
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 0, errors)
        self.assertGreater(refused, 0)
        # Whoever came when it was over may have begun anew.
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 60)
        self.assertEqual(self.records('out/benchmark.db'), self.records('whole/benchmark.db'))


class Changes(JournalTest):
    def finished(self, config, *arguments):
        """Runs a comparison of 3 runs each; how many of them were finished already."""
        self.write('set.cfg', config)
        done = self.benchmark('set.cfg', '--output', 'out', '--runs', 3, *arguments)
        found = re.search(r'(\d+)( of \d+)? runs are already finished', done.stderr)
        return int(found.group(1)) if found else 0

    def test_planners_come_and_go(self):
        self.assertEqual(self.finished(CONFIG), 0)
        first = self.records('out/benchmark.db', clock=True)
        self.assertEqual(self.finished(CONFIG + 'RRTConnect=\n'), 6)
        # One with another parameter is run again, the others are not.
        self.assertEqual(self.finished(CONFIG + 'RRTConnect=\nRRTConnect.range=2\n'), 6)
        self.assertIn('range = 2\n', [run['settings'] for run in self.records('out/benchmark.db')][0])
        # And the first one's runs are there yet; nor is a planner that is gone in the results.
        self.assertEqual(self.finished(CONFIG + 'RRTConnect=\n'), 9)
        self.assertEqual(self.finished(CONFIG), 6)
        self.benchmark('set.cfg', '--output', 'out', '--runs', 3, '--merge')
        self.assertNotIn('RRTConnect', self.read('out/summary.md') + self.read('out/angled45.log'))
        self.assertEqual(self.records('out/benchmark.db', clock=True), first)
        self.assertEqual(len(self.query('out/benchmark.db', 'SELECT * FROM plannerConfigs')), 2)

    def test_what_cannot_be_read_is_named(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 3)
        good = self.content()
        with closing(sqlite3.connect(self.write('out/other.db', ''))) as database:
            database.execute('CREATE TABLE runs (id INTEGER)')
            database.commit()
        for content, part in ((b'junk' * 1000, 'not a database'), (self.content('out/other.db'), 'not a database of runs'),
                              (good[:4096] + b'\xff' * (len(good) - 4096), 'malformed')):
            self.write('out/benchmark.db', content)
            for arguments in ([], ['--merge'], ['--fresh']):
                with self.subTest(part, arguments=arguments):
                    self.refused_benchmark('set.cfg', '--output', 'out', *arguments,
                                           parts=['out/benchmark.db: ', part, 'move it, or choose another'])
                    self.assertEqual(self.content(), content)


if __name__ == '__main__':
    main()
