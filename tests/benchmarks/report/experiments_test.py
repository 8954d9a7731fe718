"""The paper's experiments run, and what they measure is in the database.

usage: experiments_test.py PARKING_BENCHMARK FOLDER_OF_CONFIGURATIONS
"""
import os
import sqlite3
import subprocess
import sys
import tempfile

# What the paper's tables hold.
COLUMNS = ['map_loading_time', 'planning_time', 'path_length', 'travel_time', 'mean_acceleration', 'mean_steering_angle']


def main(program, configurations):
    faults = []
    for name in ('perpendicular', 'parallel', 'unreachable'):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([program, os.path.join(configurations, name + '.cfg'), '--output', folder, '--quiet',
                                   '--runs', '1', '--planner', 'Basic_A*', '--planner', 'Improved_A*', '--planner', 'Car'],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0:
                faults.append(f'{name}: status {done.returncode}: {done.stderr}')
                continue
            connection = sqlite3.connect(os.path.join(folder, 'benchmark.db'))
            rows = connection.execute(
                f'SELECT experiments.name, plannerConfigs.name, success, {", ".join(COLUMNS)} FROM runs JOIN plannerConfigs '
                'ON plannerConfigs.id = runs.plannerid JOIN experiments ON experiments.id = runs.experimentid').fetchall()
            connection.close()
            for experiment, planner, success, *figures in rows:
                # Through the gap of too_tight the car gets, the disc does not.
                solvable = name != 'unreachable' or ('Car' in planner and experiment.startswith('too_tight'))
                if bool(success) != solvable:
                    faults.append(f'{name}, {planner}: success {success}')
                if (solvable or 'Basic' not in planner) and not all(figure and figure > 0.0 for figure in figures):
                    faults.append(f'{name}, {planner}: {dict(zip(COLUMNS, figures))}')
            if len(rows) != (4 if name != 'unreachable' else 9):
                faults.append(f'{name}: {len(rows)} runs')
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
