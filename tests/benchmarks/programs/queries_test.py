"""parking_queries as a whole, and benchmarks/general.cfg on what it writes."""
import json
import os

import programs
from programs import PLAN, ProgramTest, SCENARIOS, SOURCE

QUERIES = os.environ['PARKING_QUERIES']
GENERAL = os.path.join(SOURCE, 'benchmarks', 'general.cfg')


class QueriesTest(ProgramTest):
    def queries(self, output, *arguments):
        done = self.run_program(QUERIES, '--output', output, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        return done.stdout

    def files(self, folder):
        return {name: self.read(f'{folder}/{name}') for name in os.listdir(self.path(folder))
                if os.path.isfile(self.path(f'{folder}/{name}'))}

    def test_equal_seeds_write_equal_files(self):
        options = ('--worlds', 1, '--queries', 2)
        for folder, seed in (('a', 'general'), ('b', 'general'), ('c', 'another')):
            self.queries(folder, '--seed', seed, *options)
        first, same, other = (self.files(folder) for folder in 'abc')
        self.assertEqual(first, same)
        self.assertEqual(set(first), set(other))
        for name in first:
            self.assertNotEqual(first[name], other[name], name)
        index = json.loads(first['index.json'])
        self.assertEqual((index['format'], index['seed'], index['margin']), (1, 'general', 0))
        self.assertEqual({query['name'] + '.yaml' for query in index['queries']} | {'index.json'}, set(first))
        self.assertEqual([query['goal_at_obstacle'] for query in index['queries']], [False, True] * 9)

    def test_one_is_one(self):
        self.assertIn('1 query in 1 world: one', self.queries('one', '--kind', 'clutter', '--worlds', 1, '--queries', 1))

    def test_a_world_does_not_depend_on_the_others(self):
        self.queries('all', '--worlds', 1, '--queries', 1)
        self.queries('one', '--kind', 'clutter', '--worlds', 2, '--queries', 3)
        self.assertEqual(self.read('all/clutter_1_1.yaml'), self.read('one/clutter_1_1.yaml'))

    def test_general_cfg_on_two_queries(self):
        self.queries('queries', '--kind', 'shapes', '--worlds', 1, '--queries', 2, '--margin', 0.2)
        self.benchmark(GENERAL, '--scenarios', 'queries', '--output', 'results', '--time', 0.2)
        table = self.read('results/summary.csv')
        for planner in ('improved_astar', 'hybrid_astar', 'RRTConnect', 'PRM', 'BITstar'):
            self.assertIn(planner, table)
        self.assertEqual(self.query('results/benchmark.db', 'SELECT COUNT(*) FROM runs'), [(10,)])

    def test_general_cfg_alone_says_what_is_missing(self):
        self.refused_benchmark(GENERAL, parts=('scenario',))

    def test_worlds_of_a_folder(self):
        said = self.queries('q', '--from', SCENARIOS, '--queries', 1, '--vehicle', 'smart_fortwo')
        self.assertIn('11 queries in 11 worlds', said)
        done = self.run_program(PLAN, 'q/underground_garage_map_1.yaml', '--time-limit', 2, '--json', '-')
        self.assertIn(done.returncode, (0, 3, 4), done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual(result['vehicle']['name'], 'smart_fortwo')
        self.assertNotIn(result['status'], ('invalid_start', 'invalid_goal'))

    def test_nothing_stays_of_what_fails(self):
        self.write('worlds/a.yaml', 'image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
        self.write('worlds/a.pgm', b'P5\n400 400\n255\n' + b'\xfe' * 160000)
        self.write('worlds/b.yaml', 'image: b.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
        self.write('worlds/b.pgm', b'P5\n9 9\n255\n' + b'\xfe' * 81)  # no car has room there
        self.write('old/maps/mine.txt', 'mine')
        for output in ('new/folder', 'old'):
            self.assert_refused(self.run_program(QUERIES, '--from', 'worlds', '--output', output), "'b'", 'no free pose')
        self.assertEqual(sorted(os.listdir(self.folder)), ['old', 'worlds'])
        self.assertEqual((os.listdir(self.path('old')), os.listdir(self.path('old/maps'))), (['maps'], ['mine.txt']))
        self.queries('new/folder', '--from', 'worlds/a.yaml', '--queries', 1)
        self.assertEqual(sorted(os.listdir(self.path('new/folder'))), ['a_1.yaml', 'index.json', 'maps'])

    def test_nothing_is_written_over(self):
        self.write('q/maps/a.yaml', 'image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
        self.write('q/maps/a.pgm', b'P5\n400 400\n255\n' + b'\xfe' * 160000)
        before = self.read('q/maps/a.yaml')
        done = self.run_program(QUERIES, '--from', 'q/maps', '--output', 'q', '--queries', '1')
        self.assert_refused(done, 'maps/a.pgm', 'exists already')
        self.assertEqual((self.read('q/maps/a.yaml'), os.listdir(self.path('q'))), (before, ['maps']))

    def test_a_world_may_come_through_a_pipe(self):
        os.mkfifo(self.path('w.yaml'))
        done = self.run_program('bash', '-c', 'echo 0,0,0,5,5,0,1,3,2,2,3,2,3,3 >w.yaml & '
                                f'{QUERIES} --output q --queries 1 --from w.yaml')
        self.assertEqual((done.returncode, done.stderr), (0, ''))

    def test_bad_input_is_one_line(self):
        self.write('old/index.json', '{}')
        for arguments, parts in ((('--seed', 1), ('--output',)),
                                 (('--output', 'old'), ('old', 'queries already')),
                                 (('--output', 'x', '--kind', 'street'), ('street', "did you mean 'streets', ")),
                                 (('--output', 'x', '--margin', '-1'), ('--margin', '-1')),
                                 (('--output', 'x', '--margin', 'nan'), ('--margin', 'nan')),
                                 (('--output', 'x', '--margin', '6'), ('--margin', '6')),
                                 (('--output', 'x', '--queries', '0'), ('queries', '0')),
                                 (('--output', 'x', '--worlds', 'many'), ('worlds', 'many')),
                                 (('--output', 'x', '--vehicle', 'vw_golf9'), ('vw_golf9', 'vw_golf8')),
                                 (('--output', 'x', '--vehicle', ''), ('--vehicle',)),
                                 (('--output', 'x', '--from', 'nowhere'), ('nowhere',)),
                                 (('--output', 'x', '--from', SCENARIOS, '--from', SCENARIOS), ('two worlds',)),
                                 (('--output', '/dev/null/x'), ('/dev/null/x',)),
                                 (('--output', 'x', 'extra'), ('belongs to no option',)),
                                 (('--outputs', 'x'), ('outputs', 'output'))):
            with self.subTest(arguments):
                self.assert_refused(self.run_program(QUERIES, *arguments), *parts)
        self.assertFalse(os.path.exists(self.path('x')))


if __name__ == '__main__':
    programs.main()
