"""docs/results.md from raw output that was never measured: its tables, curves and figures, and the pages that quote them."""
import json
import os
import re
import runpy
import sys
import unittest
import xml.etree.ElementTree

import made_results
from made_results import record

sys.path.insert(0, os.path.join(made_results.REPORT, '..', 'results'))

import pages  # noqa: E402
from curves import round_ticks, step_points, time_label  # noqa: E402
from evidence import Evidence  # noqa: E402
from measure import PARKBENCH_CARS, QUICK, Failure, Job, Step, run_step, steps_of  # noqa: E402


def plan(first, later, duration, travel):
    return {'status': 'exact', 'cusps': 2, 'planning_time_ms': [first, *later],
            'trajectory_optimization': {'duration_s': duration, 'time_ms': 20.0, 'fallback': False,
                                        'tpcap_cost': {'J': 1300.0}},
            'tracking': {'arrived': True, 'collisions': 0, 'travel_time_s': travel, 'final_position_error_m': 0.001,
                         'max_position_error_m': 0.02, 'min_clearance_m': 0.1, 'mpc_solve_ms': {'median': 0.1, 'p99': 0.4}}}


class Pages(made_results.FolderTest):
    def step(self, name, amount='full'):
        folder = self.path(name)
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, 'step.json'), 'w', encoding='utf-8') as stream:
            json.dump({'name': name, 'command': f'command of {name}', 'amount': amount, 'version': '1.2.3', 'commit': 'abcdef',
                       'processor': 'Some Processor', 'cores': 2, 'date': '2024-01-01', 'complete': True}, stream)

    def write(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), 'w', encoding='utf-8') as stream:
            stream.write(content if isinstance(content, str) else json.dumps(content))

    def made(self):
        return pages.pages_of(Evidence(self.folder))

    def compare(self, *records):
        self.step('queries')
        self.step('comparison-bundled')
        made_results.write(self.path('comparison-bundled'), records)

    def rows(self, text):
        """First cell -> the others, of the first row that begins with it."""
        found = {}
        for line in text.splitlines():
            if line.startswith('| '):
                first, *others = (cell.strip() for cell in line.strip('|').split('|'))
                found.setdefault(first, others)
        return found

    def test_tables_and_figures_of_a_comparison(self):
        self.compare(record('a', 'improved_astar', 0, 'solved', 0.01, 10.0), record('a', 'RRTstar', 0, 'solved', 0.04, 15.0),
                     record('b', 'improved_astar', 0, 'solved', 0.02, 20.0), record('b', 'RRTstar', 0, 'none'),
                     record('c', 'improved_astar', 0, 'none'), record('c', 'RRTstar', 0, 'invalid', 0.1, 5.0))
        made, figures, table = self.made()
        page = made['docs/results.md']
        rows = self.rows(page)
        # c is solved by none; the ratios are those of a.
        self.assertEqual(rows['improved_astar'], ['2 of 2', '2', '1.00', '1.00', '1.0', '10', '15.0 ms', '19.9 ms'])
        self.assertEqual(rows['RRTstar'][:5], ['1 of 2', '1', '4.0', '1.50', '1.0'])
        self.assertEqual(rows['RRTstar'][6:], ['∞', '∞'])
        self.assertIn('Left out, since no planner solves it: c.', page)
        for part in ('Version 1.2.3', 'abcdef', 'Some Processor', '2024-01-01', '`command of comparison-bundled`'):
            self.assertIn(part, page)
        self.assertNotIn('quick run', page)
        self.assertEqual(figures['bundled.RRTstar.time_ratio'],
                         {'value': 4.0, 'text': '4.0', 'command': 'command of comparison-bundled'})
        self.assertEqual(figures['bundled.solved']['text'], '2 of 2')
        self.assertEqual(json.loads(made['docs/results/figures.json']), figures)
        self.assertEqual(self.rows(table)['RRTstar'], ['1 of 2', '4.0', '1.50'])
        self.assertIn('abcdef', table)
        self.assertEqual(self.rows(made['docs/results/problems.md'])['b'], ['20.0 ms, 1.00', '–'])

    def test_problems_without_a_solution_are_named_with_those_who_refuse_them(self):
        self.compare(record('a', 'improved_astar', 0, 'solved', 0.01, 10.0, solvable=True),
                     *(record('b', 'improved_astar', k, 'none', solvable=False, **{'planning time': 0.003}) for k in range(3)),
                     record('b', 'RRTstar', 0, 'none', solvable=False), record('c', 'RRTstar', 0, 'none', solvable=True),
                     record('a', 'RRTstar', 0, 'solved', 0.1, 11.0, solvable=True))
        page = self.made()[0]['docs/results.md']
        self.assertIn('Without a solution: b, refused in every run by 1 planner after 3.00 ms. Left out, since '
                      'no planner solves it: c.', page)

    def test_where_others_are_ahead_is_said(self):
        self.compare(record('a', 'improved_astar', 0, 'solved', 0.02, 10.0), record('a', 'PRM', 0, 'solved', 0.01, 9.0),
                     record('b', 'improved_astar', 0, 'none'), record('b', 'PRM', 0, 'solved', 0.01, 9.0))
        self.assertIn('PRM earlier on 1 and shorter on 1 (by 10 % on `a`) of 1. It leaves unsolved: `b`.',
                      self.made()[0]['docs/results.md'])

    def test_a_quick_run_says_so(self):
        self.compare(record('a', 'improved_astar', 0, 'solved', 0.02, 10.0))
        self.step('comparison-bundled', 'quick')
        self.assertIn('This is a quick run', self.made()[0]['docs/results.md'])

    def test_curves_are_pictures_that_follow_the_theme(self):
        self.compare(*(record('a', f'planner<{k}', 0, 'solved', 10.0 ** -k, 10.0 + k, [[10.0 ** -k, 12.0 + k], [1.0, 10.0 + k]])
                       for k in range(1, 10)), record('a', 'improved_astar', 0, 'solved', 0.01, 10.0))
        made = self.made()[0]
        for name in ('solved', 'length'):
            picture = made[f'docs/results/{name}-bundled.svg']
            self.assertEqual(xml.etree.ElementTree.fromstring(picture).tag, '{http://www.w3.org/2000/svg}svg')
            self.assertIn('prefers-color-scheme: dark', picture)
            self.assertIn('planner&lt;1', picture)
            self.assertNotIn('nan', picture)
            self.assertIn(f'results/{name}-bundled.svg', made['docs/results.md'])

    def test_ticks_are_round(self):
        self.assertEqual(round_ticks(1.0, 2.0, 6), [1.0, 1.2, 1.4, 1.6, 1.8, 2.0])
        self.assertEqual(round_ticks(0.0, 1.0, 6), [0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
        self.assertEqual(round_ticks(3.0, 47.0, 6), [10.0, 20.0, 30.0, 40.0])
        self.assertEqual([time_label(10.0 ** k) for k in range(-4, 3)],
                         ['100 µs', '1 ms', '10 ms', '100 ms', '1 s', '10 s', '100 s'])
        self.assertEqual(step_points([(1, 0.0), (2, 0.5)], 3), [(1, 0.0), (2, 0.0), (2, 0.5), (3, 0.5)])

    def test_ablation(self):
        self.step('ablation-bundled')
        made_results.write(self.path('ablation-bundled'), [
            record('a', 'improved_astar', 0, 'solved', 0.01, 10.0),
            record('a', 'no_shortening', 0, 'solved', 0.005, 12.0, cusps=4),
            record('b', 'improved_astar', 0, 'solved', 0.01, 10.0), record('b', 'no_shortening', 0, 'none')])
        self.assertEqual(self.rows(self.made()[0]['docs/results.md'])['without improving the path'],
                         ['1 of 2', '0.50', '1.20', '+3', '1 of 1', '5.00 ms'])

    def test_trajectories_drives_and_calls(self):
        for name in ('trajectories-bundled', 'standstills-bundled'):
            self.step(name)
        self.write('trajectories-bundled/a.json', plan(6.0, [2.0, 3.0, 4.0], 10.0, 10.2))
        self.write('trajectories-bundled/b.json', {'status': 'timeout', 'planning_time_ms': [1.0]})
        self.write('standstills-bundled/a.json', plan(6.0, [], 10.0, 25.0))
        made, figures, _ = self.made()
        lines = [[cell.strip() for cell in line.strip('|').split('|')] for line in made['docs/results.md'].splitlines()
                 if line.startswith('| Bundled')]
        self.assertEqual(lines[0][1:], ['1', '2.0', '6.00 ms', '3.00 ms'])
        self.assertEqual(lines[1][1:], ['1', '0', '0.40', '10.00 s', '20.0 ms', '20.0 ms'])
        self.assertEqual(lines[2][1:], ['1 of 1', '0', '0.10', '2.0', '100 µs', '400 µs'])
        self.assertEqual(figures['bundled.drive.step']['command'], 'command of trajectories-bundled')
        self.assertEqual(self.rows(made['docs/results/trajectories.md'])['a'][1:3], ['10.0', '25.0'])

    def test_checks_troubles_and_termination(self):
        for name in ('checks', 'troubles', 'perceived-queries', 'perceived', 'termination'):
            self.step(name)
        each = [{'name': f'stateCheck/grid/mixed/{tier}', 'cpu_time': time, 'time_unit': unit}
                for tier, time, unit in (('plain_fcl', 0.2, 'us'), ('two_tier', 40.0, 'ns'))]
        self.write('checks/checks.json', {'benchmarks': each})
        self.write('troubles/troubles.md', '| trouble | drives | parked | stopped, touching nothing | could be avoided '
                   '| and was hit | anything else was hit |\n|---|--:|--:|--:|--:|--:|--:|\n| none | 9 | 8 | 1 | 3 | 0 | 0 |\n')
        columns = ('car', 'drives', 'parked', 'avoidable hits', 'other hits', 'stops', 'new motions', 'changes of mind',
                   'time, median', '90 %', 'check, ms', 'with a new motion, ms')
        cells = ('reacts in motion', '9', '8', '0', '1', '2', '3', '4', '1.1', '1.3', '1 / 2 / 3', '4 / 5 / 6')
        self.write('perceived/perceived.md', f'| {" | ".join(columns)} |\n|---|{12 * "--:|"}\n| {" | ".join(cells)} |\n\n'
                   'Without a drive, even in the known world: 0\n')
        made_results.write(self.path('termination'), [record('a', 'RRTstar', k, 'none', time=time)
                                                      for k, time in enumerate((2.004, 2.002, 2.0, 0.1))])
        made, figures, _ = self.made()
        rows = self.rows(made['docs/results.md'])
        self.assertEqual(rows['map, anywhere'], ['5.0', '40 ns', '200 ns'])
        self.assertEqual(rows['none'], ['9', '8', '1', '3', '0', '0'])
        self.assertEqual(rows['RRTstar'], ['3', '2.00 ms', '4.00 ms'])
        self.assertEqual(figures['troubles.parked']['value'], 8)
        self.assertEqual(rows['reacts in motion'], list(cells[1:]))
        self.assertEqual(figures['perceived.stops']['value'], 2)

    def test_parkbench(self):
        for car in ('a', 'b'):
            self.step(f'parkbench-{car}')
        self.step('parkbench-scenes-a')
        self.write('parkbench-a/1.json', {**plan(6.0, [2.0, 3.0], 10.0, 10.2), 'length_m': 12.0})
        self.write('parkbench-a/2.json', {**plan(9.0, [9.0, 9.0], 30.0, 10.2), 'length_m': 18.0})
        self.write('parkbench-a/3.json', {'status': 'timeout', 'planning_time_ms': [90.0]})
        self.write('parkbench-b/1.json', {'status': 'timeout', 'planning_time_ms': [90.0]})
        made, figures, _ = self.made()
        page = made['docs/results.md']
        lines = [[cell.strip() for cell in line.strip('|').split('|')] for line in page.splitlines()
                 if line.startswith(('| a ', '| b '))]
        self.assertEqual(lines, [['a', '2 of 3', '6.00 ms', '9.00 ms', '15.0 m', '18.0 m', '2', '2'], ['b', '0 of 1', *'––––––'],
                                 ['a', '2 of 3', '0', '20.0 s', '30.0 s', '20.0 ms', '20.0 ms'], ['b', '0 of 1', '0', *'––––']])
        self.assertEqual([figures['parkbench.a.slowest'][name] for name in ('text', 'command')],
                         ['9.00 ms', 'command of parkbench-a'])
        self.assertNotIn('parkbench.b.slowest', figures)
        for part in ('`scripts/results --data FOLDER`', '`command of parkbench-scenes-a`', 'not measured here', 'abstract'):
            self.assertIn(part, page)

    def test_pages_are_filled(self):
        figures = {'a.b': {'value': 1.4, 'text': '1.4 ms', 'command': 'run'}}
        documents = {'README.md': 'x\n<!-- results -->\nold\n<!-- /results -->\ny\n',
                     'docs/a.md': 'Takes <!--figure a.b-->9 ms<!--/figure--> or <!--figure c-->9<!--/figure-->.',
                     'docs/b.md': 'none'}
        filled = pages.fill_documents(documents, figures, '| table |\n')
        self.assertEqual(filled, {
            'README.md': 'x\n<!-- results -->\n| table |\n<!-- /results -->\ny\n',
            'docs/a.md': 'Takes <!--figure a.b-->1.4 ms<!--/figure--> or <!--figure c-->9<!--/figure-->.'})
        self.assertEqual(pages.fill_documents({**documents, **filled}, figures, '| table |\n'), {})

    def test_every_link_of_the_page_leads_to_what_is_written(self):
        self.compare(record('a', 'improved_astar', 0, 'solved', 0.01, 10.0))
        self.step('slots')
        self.write('slots/car-slot-table.md', '# Cars\n')
        made = self.made()[0]
        links = re.findall(r'\]\((results/[^)]+)\)', made['docs/results.md'])
        self.assertEqual(len(links), 4)
        for link in links:
            self.assertIn('docs/' + link, made)


class Steps(made_results.FolderTest):
    def test_copies_of_other_benchmarks_are_found(self):
        results = os.path.join(made_results.REPORT, '..', 'results', 'make_results')
        folders_of_cases = runpy.run_path(results)['folders_of_cases']

        def found(*names):
            folder = self.path('-'.join(names).replace('/', '-'))
            for name in names:
                os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
                with open(os.path.join(folder, name), 'w', encoding='utf-8'):
                    pass
            return {benchmark: os.path.relpath(at, folder) for benchmark, at in folders_of_cases(folder).items()}
        self.assertEqual(found('Case1.csv', 'poses.json'), {'tpcap': '.'})
        self.assertEqual(found('tpcap/Case1.csv', 'rear_in/1.json'), {'tpcap': 'tpcap', 'parkbench': 'rear_in'})
        self.assertEqual(found('parkbench/1.json'), {'parkbench': 'parkbench'})
        with self.assertRaisesRegex(Exception, 'no folder parkbench or rear_in'):
            found('poses.json')

    def test_each_scene_of_parkbench_is_planned_with_each_car(self):
        os.makedirs(self.path('scenes'))
        for name in ('1.json', '2.json', 'README.md'):
            with open(self.path('scenes/' + name), 'w', encoding='utf-8'):
                pass
        steps = {step.name: step for step in steps_of('raw', 'programs', QUICK, {'parkbench': self.path('scenes')})}
        self.assertFalse(any('tpcap' in name for name in steps))
        for car in PARKBENCH_CARS:
            written = [job.argv[2] for job in steps[f'parkbench-scenes-{car}'].jobs]
            self.assertEqual([os.path.basename(file) for file in written], ['1.yaml', '2.yaml'])
            self.assertEqual([job.argv[1] for job in steps[f'parkbench-{car}'].jobs], written)
            self.assertTrue(all(job.argv[-1] == car for job in steps[f'parkbench-scenes-{car}'].jobs))

    def step(self, *command, fine=(0,)):
        output = self.path('some/output')
        return Step('some', 'something', 'command', [Job(['/bin/sh', '-c', *command], output, True, fine)])

    def test_a_complete_step_is_not_repeated_unless_its_command_changes(self):
        step = self.step('echo once; echo x >>' + self.path('count'))
        self.assertTrue(run_step(self.folder, step, 'full'))
        self.assertFalse(run_step(self.folder, step, 'full'))
        self.assertTrue(run_step(self.folder, self.step('echo twice'), 'full'))
        with open(self.path('some/output'), encoding='utf-8') as output, open(self.path('count'), encoding='utf-8') as count:
            self.assertEqual((output.read(), count.read()), ('twice\n', 'x\n'))

    def test_a_failure_is_one_line_and_no_complete_step(self):
        with self.assertRaisesRegex(Failure, 'sh ended with status 3: why'):
            run_step(self.folder, self.step('echo why >&2; exit 3'), 'full')
        with open(self.path('some/step.json'), encoding='utf-8') as stream:
            self.assertFalse(json.load(stream)['complete'])
        self.assertTrue(run_step(self.folder, self.step('exit 3', fine=(3,)), 'full'))


if __name__ == '__main__':
    unittest.main()
