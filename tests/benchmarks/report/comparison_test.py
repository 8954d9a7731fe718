"""The report of a real, small comparison: its table has what parking_benchmark's summary.csv has, and its pictures.

usage: comparison_test.py PARKING_BENCHMARK SCENARIOS
"""
import csv
import os
import re
import subprocess
import sys
import tempfile

from made_results import MAKE_REPORT

from gallery import read_picture  # noqa: E402
from page import Cell  # noqa: E402
from database import read_results  # noqa: E402

CONFIG = '''[problem]
scenario = {scenarios}/perpendicular.yaml
[benchmark]
time_limit = 0.3
run_count = 6
[planner]
improved_astar=
RRTConnect=
reeds_shepp=
'''


def close(value, text):
    return value == float('inf') if text == '' else abs(value - float(text)) <= 1e-9 * max(1.0, abs(value))


def main(program, scenarios):
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        config = os.path.join(folder, 'small.cfg')
        with open(config, 'w', encoding='utf-8') as stream:
            stream.write(CONFIG.format(scenarios=scenarios))
        output = os.path.join(folder, 'results')
        subprocess.run([program, config, '--output', output, '--quiet'], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([sys.executable, '-B', MAKE_REPORT, output], check=True, stdout=subprocess.DEVNULL)
        results = read_results(output)
        with open(os.path.join(output, 'summary.csv'), encoding='utf-8', newline='') as stream:
            rows = list(csv.DictReader(stream))
        if len(rows) != 3 or results.planners != [row['planner'] for row in rows]:
            faults.append(f'rows {rows}, planners {results.planners}')
        for row in rows:
            cell = Cell(results.of(row['problem'], row['planner']))
            if (str(cell.solved), str(cell.count), str(cell.invalid)) != (row['solved'], row['runs'], row['invalid']):
                faults.append(f'{row["planner"]}: {cell.solved}/{cell.count}, {cell.invalid} invalid, not {row}')
            for value, name in ((cell.time, 'median'), (cell.quartiles[0], 'q1'), (cell.quartiles[1], 'q3'),
                                (cell.time_interval[0], 'ci_low'), (cell.time_interval[1], 'ci_high')):
                if not close(value, row[f'first_solution_{name}_s']):
                    faults.append(f'{row["planner"]}: {name} {value}, not {row[f"first_solution_{name}_s"]}')
        picture = read_picture(output, 'perpendicular')
        if picture is None or 'data-planner' in picture.ground or 'data-planner' not in picture.best.content:
            faults.append('the picture of the problem has no map without paths')
        elif {row['planner'] for row in rows if row['solved'] != '0'} != set(picture.paths):
            faults.append(f'there are paths of {list(picture.paths)} in the picture')
        else:
            path = picture.paths['improved_astar']
            best = next(run for run in results.of('perpendicular', 'improved_astar') if run.number == path.run)
            if path.content.count('<circle') != best.figure('cusps'):
                faults.append(f'{path.content.count("<circle")} changes of direction are drawn, {best.figure("cusps")} are in the database')
        # Parts of a comparison that are put together elsewhere have a report with all runs and their paths.
        parts = []
        for part in ('1/2', '2/2'):
            parts += ['--from', os.path.join(folder, part[0])]
            subprocess.run([program, config, '--output', parts[-1], '--shard', part, '--runs', '2', '--quiet'], check=True,
                           stdout=subprocess.DEVNULL)
        whole = os.path.join(folder, 'whole')
        subprocess.run([program, config, '--output', whole, '--merge', *parts, '--runs', '2', '--quiet'], check=True,
                       stdout=subprocess.DEVNULL)
        with open(os.path.join(whole, 'report.html'), encoding='utf-8') as stream:
            report = stream.read()
        if not re.search('data-planner="improved_astar".*?<polyline', report, re.DOTALL) or '<b>6</b><span>runs</span>' not in report:
            faults.append('the report of merged parts lacks runs or paths')
        # Where Python lacks the packages of the report, one line says so, and all else is there.
        os.mkdir(os.path.join(folder, 'bin'))
        with open(os.path.join(folder, 'bin', 'python3'), 'w', encoding='utf-8') as stream:
            stream.write('#!/bin/sh\necho "make_report: Python packages are missing" >&2\nexit 3\n')
        os.chmod(stream.name, 0o755)
        poor = os.path.join(folder, 'poor')
        done = subprocess.run([program, config, '--output', poor, '--runs', '1', '--quiet'], capture_output=True, text=True,
                              env={**os.environ, 'PATH': os.path.dirname(stream.name) + ':' + os.environ['PATH']}, check=False)
        if (done.returncode, done.stderr) != (0, f'parking_benchmark: {poor}/report.html: is not written: make_report: '
                                              'Python packages are missing\n'):
            faults.append(f'without the packages: status {done.returncode}, {done.stderr}')
        if 'report.html' in os.listdir(poor) or not {'benchmark.db', 'summary.csv', 'pictures'} <= set(os.listdir(poor)):
            faults.append(f'without the packages there are {os.listdir(poor)}')
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
