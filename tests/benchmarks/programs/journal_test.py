"""Nothing is lost: parking_benchmark killed at random instants, on a disk that fills up, with two at a time, with planners
that come and go, and with garbage in its file of runs."""

import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import time
from contextlib import closing

from programs import BENCHMARK, ProgramTest, bundled, main

FULL_DISK = os.environ['PARKING_FULL_DISK']
KILLS = int(os.environ.get('PARKING_KILLS', '80'))
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


def depends_on_the_clock(name):
    return 'time' in name or 'memory' in name


class JournalTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write('set.cfg', CONFIG)

    def content(self, name='out/runs.jsonl'):
        with open(self.path(name), 'rb') as stream:
            return stream.read()

    def whole_lines(self):
        """What is kept for good: all up to the end of the last line. Nothing before there is a run."""
        if not os.path.exists(self.path('out/runs.jsonl')):
            return b''
        text = self.content()
        text = text[:text.rfind(b'\n') + 1]
        return text if text.count(b'\n') > 1 else b''

    def records(self, name):
        """The runs of a file in a fixed order, without what depends on the machine's speed."""
        runs = []
        for line in self.content(name).splitlines():
            run = json.loads(line)
            if 'parking_benchmark' in run:
                continue
            run['figures'] = {key: value for key, value in run['figures'].items() if not depends_on_the_clock(key)}
            run['progress'] = [cost for _, cost in run['progress']]
            runs.append(run)
        return sorted(runs, key=lambda run: (run['experiment'], run['planner'], run['figures']['run']))

    def set_aside(self):
        return sorted(name for name in os.listdir(self.path('out')) if name.startswith('previous'))

    def results(self):
        """Everything but the file of runs."""
        return sorted(name for name in os.listdir(self.path('out')) if name != 'runs.jsonl')


class Killed(JournalTest):
    def test_killed_at_random_instants(self):
        runs = 8
        command = [BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--runs', str(runs)]
        begin = time.monotonic()
        self.benchmark(*command[1:3], 'whole', *command[4:])
        total = time.monotonic() - begin
        begin = time.monotonic()
        self.benchmark(*command[1:3], 'whole', *command[4:])
        rewriting = time.monotonic() - begin
        wanted = self.records('whole/runs.jsonl')
        self.assertEqual(len(wanted), 2 * runs)
        rng = random.Random(1)
        killed = {'planning': 0, 'writing': 0}
        rounds = 0
        while sum(killed.values()) < KILLS:
            shutil.rmtree(self.path('out'), ignore_errors=True)
            kept, done, planned, rounds = b'', False, False, rounds + 1
            # The report is made last and takes longest: most rounds do without, so that there can be many kills.
            reported = rounds % 6 == 1
            arguments = command if reported else command + ['--no-report']
            # At least one process of a round finds all runs finished, and is hit while it writes the results again.
            while not (done and planned):
                planned = kept.count(b'\n') == 1 + 2 * runs
                process = subprocess.Popen(arguments, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                try:
                    process.wait(rng.uniform(0.0, 1.2 * rewriting if planned and not reported else 0.7 * total))
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGKILL)
                _, errors = process.communicate()
                done = process.returncode == 0
                now = self.whole_lines()
                self.assertTrue(now.startswith(kept), 'lines that were there are gone')
                kept = now
                if not done:
                    self.assertEqual(process.returncode, -signal.SIGKILL, errors)
                    killed['writing' if kept.count(b'\n') == 1 + 2 * runs else 'planning'] += 1
            self.assertEqual(self.records('out/runs.jsonl'), wanted)
            self.assertEqual(self.content().count(b'parking_benchmark'), 1)
            self.assertEqual(self.results(),
                             sorted(['angled45.log', 'benchmark.db', 'pictures', 'summary.csv', 'summary.md'] +
                                    reported * ['pairs.csv', 'report.html', 'standings.csv', 'statistics.json']))
            self.assertEqual(os.listdir(self.path('out/pictures')), ['angled45.svg'])
        print('killed %s in %d rounds' % (killed, rounds))
        self.assertGreater(min(killed.values()), KILLS // 20)

    def test_remains_go_away_and_nothing_else(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1)
        before = self.results()
        for name in ('benchmark.db.new', 'benchmark.db.new.4711', 'benchmark.db.new-journal', 'summary.md.new.aB3xYz',
                     '.report-abc', 'pictures/angled45.svg.new.aB3xYz', 'runs.jsonl.new'):
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
                kept = self.whole_lines()
                self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 2)
                self.assertTrue(self.content().startswith(kept))
                self.assertEqual(self.set_aside(), [])
                wanted = wanted or self.records('out/runs.jsonl')
                self.assertEqual(self.records('out/runs.jsonl'), wanted)
            failures += 1
            room += 1 if room < EACH else STRIDE
        print('%d of %d writes failed' % (failures, room))
        self.assertGreater(failures, 10)

    def test_full_while_something_is_set_aside_or_replaced(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 1)
        old = {name: self.content('out/' + name) for name in self.results() + ['runs.jsonl'] if '.' in name}
        for room in range(12):
            with self.subTest(room):
                done, _ = self.start(room, '--runs', 1, '--seed', 4)
                self.assertIn(done.returncode, (1, 2), done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                texts = [self.content('out/' + name) for name in os.listdir(self.path('out')) if 'runs' in name]
                self.assertIn(old['runs.jsonl'], texts)
                for name in self.set_aside() + ['runs.jsonl']:
                    self.assertIn(b'fingerprints', self.content('out/' + name))
                # Old or new, but whole.
                self.assertEqual(self.content('out/summary.md').count(b'\n'), old['summary.md'].count(b'\n'))
                with closing(sqlite3.connect(self.path('out/benchmark.db'))) as database:
                    self.assertEqual(database.execute('PRAGMA integrity_check').fetchall(), [('ok',)])
                    self.assertEqual(database.execute('SELECT COUNT(*) FROM runs').fetchall(), [(2,)])
                if room < 5:  # a run each of two planners, and what precedes them
                    for name in ('summary.md', 'benchmark.db'):
                        self.assertEqual(self.content('out/' + name), old[name])
                if self.set_aside():
                    self.assertEqual(self.set_aside(), ['previous-runs.jsonl'])


class TwoAtATime(JournalTest):
    def test_another_process_touches_nothing(self):
        self.benchmark('set.cfg', '--output', 'whole', '--quiet', '--runs', 60)
        process = subprocess.Popen([BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--no-report', '--runs', '60'],
                                   cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        refused = 0
        while process.poll() is None:
            if not self.whole_lines():
                time.sleep(0.002)
                continue
            for arguments in (['--fresh'], ['--time', '3'], []):
                other = self.run_program(BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--runs', 60, *arguments)
                if process.poll() is None:
                    self.assert_refused(other, 'out/runs.jsonl', 'another parking_benchmark')
                    self.assertEqual(self.set_aside(), [])
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
        kept = 'out/previous-runs.jsonl' if self.set_aside() else 'out/runs.jsonl'
        self.assertEqual(self.records(kept), self.records('whole/runs.jsonl'))


class Changes(JournalTest):
    def finished(self, config, *arguments):
        self.write('set.cfg', config)
        done = self.benchmark('set.cfg', '--output', 'out', '--runs', 3, *arguments)
        found = [line for line in done.stderr.splitlines() if 'already finished' in line]
        self.assertEqual(self.set_aside(), [])
        return int(found[0].split(' of ')[0].split()[-1]) if found and ' of ' in found[0] else None

    def test_planners_come_and_go(self):
        self.assertIsNone(self.finished(CONFIG))
        first = self.records('out/runs.jsonl')
        self.assertEqual(self.finished(CONFIG + 'RRTConnect=\n'), 6)
        # One with another parameter is run again, the others are not.
        self.assertEqual(self.finished(CONFIG + 'RRTConnect=\nRRTConnect.range=2\n'), 6)
        self.assertIn('range', self.read('out/runs.jsonl'))
        self.assertNotIn('RRTConnect', self.read('out/summary.md').replace('RRTConnect', '', 3))
        # And the first one's runs are there yet; nor is a planner that is gone in the results.
        self.finished(CONFIG + 'RRTConnect=\n')
        self.finished(CONFIG)
        self.assertNotIn('RRTConnect', self.read('out/summary.md'))
        self.assertNotIn('RRTConnect', self.read('out/angled45.log'))
        self.benchmark('set.cfg', '--output', 'out', '--runs', 3, '--merge')
        self.assertNotIn('RRTConnect', self.read('out/summary.md'))
        self.assertEqual([run for run in self.records('out/runs.jsonl') if run['planner'] != 'RRTConnect'], first)

    def test_garbage_is_named_and_good_runs_are_kept(self):
        self.benchmark('set.cfg', '--output', 'out', '--quiet', '--runs', 3)
        lines = self.content().split(b'\n')
        lines[3] = lines[3][:50] + b'\0\xff' + lines[3][52:]
        self.write('out/runs.jsonl', b'\n'.join(lines[:5] + [b'[' * 100000] + lines[5:]))
        for arguments in ([], ['--merge']):
            done = self.run_program(BENCHMARK, 'set.cfg', '--output', 'out', '--quiet', '--runs', 3, *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertIn('out/runs.jsonl:4: is not a line of benchmark results', done.stderr)
            self.assertIn('it and 1 more are left out', done.stderr)
            self.assertEqual(self.set_aside(), [])
        self.assertIn('3/3', self.read('out/summary.md'))
        self.assertIn(b'\n'.join(lines[:3]), self.content())


if __name__ == '__main__':
    main()
