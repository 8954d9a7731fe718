"""The steps of scripts/results: what is run, with which program, and where its raw output goes.

A step is skipped where its output is complete and of the same program, command and inputs. One that was interrupted goes on."""
import datetime
import glob
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..'))
HERE = os.path.join(ROOT, 'benchmarks', 'results')
SCENARIOS = os.path.join(ROOT, 'benchmarks', 'scenarios')
PROGRAMS = 'build/release/benchmarks/'  # as a reader calls them
PLANNED = (0, 3, 4)  # statuses of parking_plan with a result, even without a path
PARKBENCH_CARS = ('toyota_yaris', 'vw_golf8', 'mercedes_s_w223')  # small, medium, large
PERCEIVED = ('parked_rows', 'streets', 'multi_storey', 'large_lot', 'angled_lot', 'careless_lot')  # kinds of worlds
DRIVEN = ('angled45', 'parallel', 'perpendicular', 'dead_end_aisle')  # with trouble


class Failure(Exception):
    """A step failed; the text is one line."""


@dataclass
class Job:
    """One command. Its output is the file that it writes itself, or that its standard output is written to."""
    argv: list
    output: str
    to_stdout: bool = False
    fine: tuple = (0,)


@dataclass
class Step:
    name: str
    title: str
    command: str  # as a reader runs it
    jobs: list
    resumes: bool = False  # the program itself continues where it was interrupted
    inputs: list = field(default_factory=list)  # files and folders


@dataclass
class Amount:
    """How much is measured."""
    time: float    # seconds of a run of a comparison
    runs: dict     # of each planner on a problem, by set
    queries: int   # in each world
    variants: int  # runs of each variant of the ablation
    repeats: int   # of a plan
    drives: int
    perceived: int  # drives by a sensor
    checks: list   # options of the micro-benchmarks


FULL = Amount(0.5, {'bundled': 2, 'random': 1, 'tpcap': 1}, 4, 2, 3, 140, 48, ['--benchmark_min_time=0.1'])
QUICK = Amount(0.2, {'bundled': 1, 'random': 1, 'tpcap': 1}, 1, 1, 3, 28, 6,
               ['--benchmark_min_time=0.02', '--benchmark_filter=^(stateCheck|motionCheck|sweptArc|distanceField|checkerOf)'])


def scenario_files(folder):
    return sorted(glob.glob(os.path.join(folder, '*.csv')) + [
        file for file in glob.glob(os.path.join(folder, '*.yaml'))
        if re.search(r'^start:', open(file, encoding='utf-8').read(), re.MULTILINE)])


def steps_of(raw, programs, amount, data):
    """All steps in their order; a generator, since the random queries must be drawn before they are listed.

    data: benchmark -> folder with the user's copy of its cases."""
    def program(name):
        return os.path.join(programs, name)

    def at(*names):
        return os.path.join(raw, *names)

    def benchmark(name, title, config, folder, shown, limit, runs):
        options = ['--time', f'{limit:g}', '--runs', str(runs)]
        file = os.path.join(HERE, config)
        command = f'{PROGRAMS}parking_benchmark benchmarks/results/{config} --scenarios {shown} {" ".join(options)}'
        return Step(name, title, command,
                    [Job([program('parking_benchmark'), file, '--scenarios', folder, *options, '--output', at(name),
                          '--no-report', '--quiet'], at(name, 'benchmark.db'))], True, [file, folder])

    queries = at('queries', 'set')
    count = ['--worlds', '1', '--queries', str(amount.queries)]
    yield Step('queries', 'random queries are drawn', ' '.join([f'{PROGRAMS}parking_queries --output queries', *count]),
               [Job([program('parking_queries'), '--output', queries, *count], os.path.join(queries, 'index.json'))])
    sets = {'bundled': (SCENARIOS, 'benchmarks/scenarios'), 'random': (queries, 'queries')}
    if 'tpcap' in data:
        sets['tpcap'] = (data['tpcap'], 'FOLDER')
    for kind, (folder, shown) in sets.items():
        yield benchmark(f'comparison-{kind}', f'planners compared, {kind}', 'comparison.cfg', folder, shown, amount.time,
                        amount.runs[kind])
    for kind, (folder, shown) in sets.items():
        yield benchmark(f'ablation-{kind}', f'ablation, {kind}', 'ablation.cfg', folder, shown, amount.time, amount.variants)
    for kind, (folder, shown) in sets.items():
        for name, title, options in (
                ('trajectories', 'trajectories and drives', ['--runs', str(amount.repeats), '--trajectory', '--track']),
                ('standstills', 'drives that stop to steer', ['--track'])):
            jobs = []
            for file in scenario_files(folder):
                output = at(f'{name}-{kind}', os.path.splitext(os.path.basename(file))[0] + '.json')
                jobs.append(Job([program('parking_plan'), file, *options, '--json', output], output, fine=PLANNED))
            command = f'{PROGRAMS}parking_plan {shown}/NAME {" ".join(options)} --json FILE'
            yield Step(f'{name}-{kind}', f'{title}, {kind}', command, jobs, inputs=[folder])
    if 'parkbench' in data:
        yield from parkbench_steps(program, at, amount, data['parkbench'])
    options = ['--drives', str(amount.drives)]
    named = 'benchmarks/scenarios/{' + ','.join(DRIVEN) + '}.yaml'
    driven = [os.path.join(SCENARIOS, f'{name}.yaml') for name in DRIVEN]
    yield Step('troubles', 'drives that meet trouble', f'{PROGRAMS}troubled_drives {named} {" ".join(options)}',
               [Job([program('troubled_drives'), *driven, *options], at('troubles', 'troubles.md'), True, (0, 1))],
               inputs=driven)
    # On a map of cells of 10 cm a goal must keep some distance.
    wide, options = at('perceived-queries', 'set'), ['--margin', '0.15', *count]
    yield Step('perceived-queries', 'queries of drives by a sensor', ' '.join([f'{PROGRAMS}parking_queries --output wide', *options]),
               [Job([program('parking_queries'), '--output', wide, *options], os.path.join(wide, 'index.json'))])
    driven = [file for file in scenario_files(wide) if os.path.basename(file).startswith(PERCEIVED)]
    options, named = ['--drives', str(amount.perceived)], 'wide/{' + ','.join(PERCEIVED) + '}*'
    yield Step('perceived', 'drives by a sensor', f'{PROGRAMS}perceived_drives {named} {" ".join(options)}',
               [Job([program('perceived_drives'), *driven, *options], at('perceived', 'perceived.md'), True, (0, 1))],
               inputs=driven)
    yield Step('checks', 'footprint checks', f'{PROGRAMS}validity_benchmark {shlex.join(amount.checks)}',
               [Job([program('validity_benchmark'), *amount.checks, '--benchmark_format=json'],
                    at('checks', 'checks.json'), True)])
    yield benchmark('termination', 'how promptly planners end', 'termination.cfg', SCENARIOS, 'benchmarks/scenarios', 0.1,
                    amount.runs['bundled'])
    table = at('slots', 'car-slot-table.md')
    yield Step('slots', 'cars in slots', f'{PROGRAMS}car_slot_table FILE', [Job([program('car_slot_table'), table], table)])


def parkbench_steps(program, at, amount, folder):
    """Each scene becomes a scenario for each car, since the car at its goal stands over obstacles."""
    options = ['--runs', str(amount.repeats), '--trajectory']
    for car in PARKBENCH_CARS:
        cases, converted, planned = at(f'parkbench-scenes-{car}', 'set'), [], []
        for file in sorted(glob.glob(os.path.join(folder, '*.json'))):
            name = os.path.splitext(os.path.basename(file))[0]
            case, output = os.path.join(cases, name + '.yaml'), at(f'parkbench-{car}', name + '.json')
            converted.append(Job([program('parking_convert'), file, case, '--vehicle', car], case))
            planned.append(Job([program('parking_plan'), case, *options, '--json', output], output, fine=PLANNED))
        yield Step(f'parkbench-scenes-{car}', f'scenes of ParkBench converted, {car}',
                   f'{PROGRAMS}parking_convert FOLDER/NAME.json NAME.yaml --vehicle CAR', converted,
                   inputs=[folder, os.path.join(ROOT, 'benchmarks', 'convert', 'parkbench.py')])
        yield Step(f'parkbench-{car}', f'scenes of ParkBench planned, {car}',
                   f'{PROGRAMS}parking_plan NAME.yaml {" ".join(options)} --json FILE', planned, inputs=[cases])


def names_of_steps(data):
    return [step.name for step in steps_of('', '', QUICK, data)]


def _hash_of(paths):
    found = hashlib.sha256()
    for path in paths:
        files = [os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names]
        for file in sorted(files) if os.path.isdir(path) else [path]:
            found.update(os.path.relpath(file, path).encode())
            with open(file, 'rb') as stream:
                found.update(stream.read())
    return found.hexdigest()


def processor():
    with open('/proc/cpuinfo', encoding='utf-8') as stream:
        found = re.search(r'^model name\s*: (.*)', stream.read(), re.MULTILINE)
    return found.group(1) if found else 'unknown processor'


def project_version():
    with open(os.path.join(ROOT, 'CMakeLists.txt'), encoding='utf-8') as stream:
        return re.search(r'project\(.*?VERSION ([\d.]+)', stream.read(), re.DOTALL).group(1)


def commit():
    """Of the sources; empty outside of git."""
    said = subprocess.run(['git', '-C', ROOT, 'describe', '--always', '--dirty', '--exclude', '*'],
                          capture_output=True, text=True, check=False)
    return said.stdout.strip().replace('-dirty', ' with changes') if said.returncode == 0 else ''


def _write(file, content):
    with open(file + '.tmp', 'w', encoding='utf-8') as stream:
        stream.write(content)
    os.replace(file + '.tmp', file)


def _run_job(job, log):
    os.makedirs(os.path.dirname(job.output), exist_ok=True)
    with open(log, 'a', encoding='utf-8') as errors:
        done = subprocess.run(job.argv, stdout=subprocess.PIPE if job.to_stdout else errors, stderr=errors, check=False)
    if done.returncode not in job.fine:
        with open(log, encoding='utf-8') as stream:
            last = (stream.read().strip().splitlines() or ['without a word'])[-1]
        raise Failure(f'{os.path.basename(job.argv[0])} ended with status {done.returncode}: {last}')
    if job.to_stdout:
        _write(job.output, done.stdout.decode())


def run_step(raw, step, amount_name):
    """Returns whether anything had to be run."""
    folder = os.path.join(raw, step.name)
    mark, log = os.path.join(folder, 'step.json'), os.path.join(folder, 'log')
    # The position of the raw output is no part of the key, so that the folder may be moved.
    argv = [[os.path.relpath(word, raw) if os.path.isabs(word) else word for word in job.argv] for job in step.jobs]
    key = _hash_of([step.jobs[0].argv[0], *step.inputs]) + hashlib.sha256(json.dumps(argv).encode()).hexdigest()
    known = {}
    if os.path.exists(mark):
        with open(mark, encoding='utf-8') as stream:
            known = json.load(stream)
    if known.get('key') == key and known['complete']:
        return False
    if known.get('key') != key:
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
    facts = {'name': step.name, 'key': key, 'command': step.command, 'amount': amount_name, 'version': project_version(),
             'commit': commit(), 'processor': processor(), 'cores': os.cpu_count(), 'date': f'{datetime.date.today()}',
             'complete': False}
    _write(mark, json.dumps(facts, indent=1))
    started = time.monotonic()
    for job in step.jobs:
        if step.resumes or not os.path.exists(job.output):
            _run_job(job, log)
    _write(mark, json.dumps({**facts, 'complete': True, 'seconds': round(time.monotonic() - started)}, indent=1))
    return True


def measure(raw, programs, quick, data, only=()):
    """Runs the steps, all of them or those whose name contains one of the words."""
    started = time.monotonic()
    for number, step in enumerate(steps_of(raw, programs, QUICK if quick else FULL, data), 1):
        if only and step.name != 'queries' and not any(word in step.name for word in only):
            continue
        print(f'results: {number:2} {step.title} ... ', end='', flush=True)
        begun = time.monotonic()
        if run_step(raw, step, 'quick' if quick else 'full'):
            print(f'{time.monotonic() - begun:.0f} s, {time.monotonic() - started:.0f} s in total', flush=True)
        else:
            print('complete', flush=True)
    sys.stdout.flush()
