"""The database of a comparison in the real Planner Arena, in an environment of its own: every plot is made.

usage: planner_arena_test.py PARKING_BENCHMARK SCENARIOS FOLDER, which keeps the installation
"""
import json
import os
import subprocess
import sys
import tempfile

SKIPPED = 77
PACKAGE = 'plannerarena==1.0.1'
CONFIG = '''[problem]
scenario = {scenarios}/perpendicular.yaml
scenario = {scenarios}/angled45.yaml
[benchmark]
time_limit = 0.5
run_count = 3
simplify = yes
[planner]
improved_astar=
RRTConnect=
RRTstar=
BITstar=
'''


def installed(folder):
    """The interpreter of an environment with the package; None without one, unless it may and can be made."""
    python = os.path.join(folder, 'bin', 'python')
    if os.path.exists(python) and subprocess.run([python, '-c', 'import plannerarena'], check=False).returncode == 0:
        return python
    if os.environ.get('PARKING_PLANNER_ARENA') != '1':
        print(f'skipped: with PARKING_PLANNER_ARENA=1 it installs {PACKAGE}, which takes 1 GB')
        return None
    for command in ([sys.executable, '-m', 'venv', folder], [python, '-m', 'pip', 'install', '--quiet', PACKAGE]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f'skipped, {PACKAGE} cannot be installed: {(done.stdout + done.stderr).strip().splitlines()[-1:]}')
            return None
    return python


def main(program, scenarios, environment):
    python = installed(environment)
    if python is None:
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        config = os.path.join(folder, 'small.cfg')
        with open(config, 'w', encoding='utf-8') as stream:
            stream.write(CONFIG.format(scenarios=scenarios))
        subprocess.run([program, config, '--output', folder, '--quiet', '--no-report'], check=True, stdout=subprocess.DEVNULL)
        session = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'arena_session.py')
        done = subprocess.run([python, '-B', '-W', 'ignore', session, os.path.join(folder, 'benchmark.db')], check=False,
                              capture_output=True, text=True)
    if done.returncode != 0:
        print(f'the session ended with {done.returncode}:\n{done.stderr}')
        return 1
    shown = json.loads(done.stdout)
    faults, options = shown['faults'], shown['options']
    expected = {'performance-problem': ['perpendicular', 'angled45'], 'progress-attribute': ['best cost'],
                'performance-planners': {'improved_astar', 'RRTConnect', 'RRTstar', 'BITstar'}}
    for name, values in expected.items():
        if type(values)(options.get(name, [])) != values:
            faults.append(f'{name} offers {options.get(name)}, not {values}')
    faults += [f'{name} is offered as a parameter of the problem' for name in options if 'problem_param' in name]
    faults += [] if shown['made'] > 50 else [f'only {shown["made"]} pictures']
    print('\n'.join(faults) or f'{shown["made"]} pictures')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
