"""The command line of parking_convert."""
import argparse
import math
import os
import re
import signal
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np

from improved_astar import Error, Vehicle
from improved_astar._core import _read_file as read_file, _unknown_name as unknown_name, _write_file as write_file

from . import bench_mr, commonparking, hope, matlab, omplapp, own, parkbench, results
from .scenarios import obstacle_polygons
from .text import counted, number, numbers, one_line, pose_of, quoted

DONE, FAULTY, BAD_INPUT = 0, 1, 2
LARGEST = 256 << 20  # maximum bytes of a file
SAME = 1e-6          # maximum difference in metres and radians between input and output
MEBIBYTE = 1 << 20


@dataclass(frozen=True)
class ProblemFormat:
    """A format of files with a parking problem."""
    name: str                            # one word, for --to
    extension: str                       # extension of written files
    text: str                            # one line for --help
    largest: int                         # maximum bytes of a file
    recognizes: Callable[[bytes], bool]  # (content): whether it has this format
    read: Callable[..., Any]             # (file, content, vehicle, start, goal): the Scenario
    write: Optional[Callable[..., Any]]  # (scenario, file): the content as text or bytes; None: is only read


@dataclass(frozen=True)
class ResultFormat:
    """A format of submitted results."""
    name: str                  # one word, for --to
    extension: str             # extension of written files
    text: str                  # one line for --help
    is_trajectory: bool        # whether it requires a trajectory
    write: Callable[..., Any]  # (result): the content of the file
    fault: Callable[..., Any]  # (result, file, content): the fault of a written file, or None


# The last format applies to files that none recognizes.
PROBLEM_FORMATS = [
    ProblemFormat('commonparking', '.mat', 'cases of CommonParking; the car steers up to 0.7 rad', matlab.LARGEST,
                  matlab.is_matlab, commonparking.read_case, commonparking.case_content),
    ProblemFormat('benchmr', '.svg', 'polygon scenes of Bench-MR; obstacles are convex', 16 * MEBIBYTE,
                  lambda content: content.removeprefix(b'\xef\xbb\xbf').lstrip().startswith(b'<'),
                  bench_mr.read, bench_mr.svg_text),
    ProblemFormat('parkbench', '.json', 'scenes of ParkBench, without a car; read only', 16 * MEBIBYTE,
                  parkbench.is_scene, parkbench.read, None),
    ProblemFormat('omplapp', '.cfg', 'planar problems of ompl_benchmark, with their meshes; read only',
                  MEBIBYTE, omplapp.recognizes, omplapp.read, None),
    ProblemFormat('tpcap', '.csv', 'cases of TPCAP, without a car; default: TPCAP\'s car',
                  16 * MEBIBYTE, lambda content: False, own.read, own.tpcap_text),
    ProblemFormat('yaml', '.yaml', 'scenarios of this project, with the maps and voxels they name', 16 * MEBIBYTE,
                  lambda content: True, own.read, own.yaml_text),
]
RESULT_FORMATS = [
    ResultFormat('commonparking-path', '.mat', 'path for CommonParking\'s EvaluateResult, with its exact arcs', False,
                 commonparking.path_content, commonparking.result_fault),
    ResultFormat('commonparking-trajectory', '.mat', 'trajectory for CommonParking\'s EvaluateResult', True,
                 commonparking.trajectory_content, commonparking.result_fault),
    ResultFormat('tpcap-trajectory', '.csv', 'trajectory as t, x, y, yaw, v, a, steering, steering_rate', True,
                 results.csv_text, results.csv_fault),
]
OPTIONS = (  # name, placeholder of its value (empty: none), help
    ('--to', 'FORMAT', 'format of OUTPUT (default: by its extension; yaml with --hope)'),
    ('--check', None, 'check INPUT, and OUTPUT after writing; status 1 when a check fails'),
    ('--vehicle', 'NAME|FILE', "the car (default: the file's, or the format's)"),
    ('--start', 'X,Y,YAW', "replace the file's, or add it if the format has none"),
    ('--goal', 'X,Y,YAW', "replace the file's goal, or add it if the format has none"),
    ('--hope', 'LEVEL', 'generate problems of this level of HOPE; OUTPUT is a folder'),
    ('--count', 'N', 'number of problems (default 10)'),
    ('--seed', 'N', 'seed of the first problem; each further one has the next number (default 1)'),
    ('--help', None, 'print this text'),
)
USAGE = '''parking_convert INPUT OUTPUT [options]
       parking_convert INPUT --check
       parking_convert --hope LEVEL OUTPUT [--count N] [--seed N] [--to FORMAT]'''
ABOUT = '''Converts parking problems between formats, and results of parking_plan --json into those of others.
The format of INPUT is detected by its content.'''
EXAMPLES = '''Examples, run at the root of the project:
  parking_convert benchmarks/scenarios/parallel.yaml parallel.svg
  parking_convert --hope complex hope --count 100 --seed 1

More examples:
  parking_convert Case7.csv Case7.yaml --check
  parking_convert parking1.svg parking1.yaml --start 3,-7.2,0 --goal 4.05,-2.6,1.5708 --check
  parking_plan case07.yaml --trajectory --json case07.json
  parking_convert case07.json Case07.mat --to commonparking-trajectory --check

Status: 0 done, 1 a check failed, 2 invalid input or usage'''


def parser():
    problems, handed_in = (''.join(f'\n  {each.name:<26}{each.extension:<6}{each.text}' for each in formats)
                           for formats in (PROBLEM_FORMATS, RESULT_FORMATS))
    made = argparse.ArgumentParser(
        usage=USAGE, description=ABOUT, allow_abbrev=False, add_help=False, exit_on_error=False,
        epilog=f'Formats of problems, read and written:{problems}\n\nFormats of results, written:{handed_in}\n\n'
        f'Levels of HOPE: {" ".join(hope.LEVELS)}\n\n{EXAMPLES}',
        formatter_class=lambda prog: argparse.RawDescriptionHelpFormatter(prog, width=80))
    made.add_argument('files', nargs='*', help=argparse.SUPPRESS)
    group = made.add_argument_group('Options')
    for name, value, text in OPTIONS:
        group.add_argument(name, help=text, **({'metavar': value} if value else {'action': 'store_true'}))
    return made


def parse(arguments):
    """The options of the command line. Raises Error with one line."""
    valued = [name for name, value, _ in OPTIONS if value]
    joined = []  # name and value: argparse would read -3,1,0 alone as an option
    for each in arguments:
        if joined and joined[-1] in valued:
            joined[-1] += '=' + each
        else:
            joined.append(each)
    given = [each.split('=')[0] for each in joined]
    try:
        options, unknown = parser().parse_known_intermixed_args(joined)
    except argparse.ArgumentError as error:
        raise Error(f'{error} (see --help)') from None
    if unknown:
        raise Error(unknown_name('option', unknown[0].split('=')[0], [name for name, *_ in OPTIONS]) + ' (see --help)')
    for name in valued:
        if given.count(name) > 1:
            raise Error(f'option {name} is given more than once (see --help)')
    return options


def convert(arguments):
    options = parse(arguments)
    if options.help:
        print(parser().format_help(), end='')
        return DONE
    files = options.files
    if not files:
        raise Error('--hope requires the name of a folder to write (see --help)' if options.hope is not None else
                    'no INPUT given (see --help)')
    if len(files) > (1 if options.hope is not None else 2):
        raise Error(f'{quoted(files[-1])} is one name too many (see --help)')
    if options.hope is not None:
        refuse(options, 'changes an input file, and --hope has none', 'start', 'goal', 'vehicle')
        return generate_hope(files[0], options)
    refuse(options, 'requires --hope', 'count', 'seed')
    source, output = files[0], files[1] if len(files) > 1 else None
    if output is None:
        if not options.check:
            raise Error('no OUTPUT and no --check given (see --help)')
        refuse(options, 'is the format of OUTPUT, which is missing', 'to')
    elif output == '-':
        raise Error("'-' is not standard output here; for a file of that name write './-'")
    content = read_file(source, LARGEST)  # once: a pipe cannot be read again
    if results.is_result(content) and not parkbench.is_scene(content):
        return convert_result(source, content, output, options)
    return convert_problem(source, content, output, options)


def refuse(options, why, *names):
    """Raises Error for given options among these, which would have no effect."""
    for name in names:
        if getattr(options, name) is not None:
            raise Error(f'--{name} {why} (see --help)')


def refuse_input(output, inputs):
    for each in inputs:
        if os.path.isfile(output) and os.path.isfile(each) and os.path.samefile(output, each):
            other = '' if each == output else f' {quoted(each)}'
            raise Error(f'{quoted(output)} is the input{other}, which would be lost; choose another file to write')


def pose_option(options, name):
    text = getattr(options, name)
    pose = None if text is None else pose_of(text)
    if text is not None and pose is None:
        raise Error(f'--{name} must be X,Y,YAW in metres and radians, not {quoted(text)}')
    return pose


def whole_option(options, name, default, least, most):
    text = getattr(options, name)
    if text is None:
        return default
    if not re.fullmatch('[0-9]{1,12}', text) or not least <= int(text) <= most:
        raise Error(f'--{name} must be a whole number from {least} to {most}, not {quoted(text)}')
    return int(text)


def format_for(formats, what, name, output):
    """The format of this name, else the first one of the output's extension, of those that can be written."""
    formats = [each for each in formats if each.write]
    for each in formats:
        if each.name == name if name is not None else each.extension == Path(output).suffix:
            return each
    if name is not None:
        raise Error(unknown_name(what, name, [each.name for each in formats]))
    known = ', '.join(f'{each.name} ({each.extension})' for each in formats)
    raise Error(f'{quoted(output)}: the extension belongs to no {what}; select one with --to: {known}')


def convert_problem(source, content, output, options):
    if options.vehicle == '':
        raise Error('--vehicle has an empty name; without the option its default applies')
    vehicle = Vehicle(options.vehicle) if options.vehicle else None
    found = next(each for each in PROBLEM_FORMATS if each.recognizes(content))
    if len(content) > found.largest:
        raise Error(f'{source}: is larger than the limit of {found.largest >> 20} MiB')
    scenario = found.read(source, content, vehicle, pose_option(options, 'start'), pose_option(options, 'goal'))
    if output is not None:
        refuse_input(output, [source, *scenario.files] + ([options.vehicle] if options.vehicle else []))
    status = DONE
    if options.check:
        print(summary_of(scenario))
        status = report(source, faults_of(scenario))
    if output is None:
        return status
    format_to = format_for(PROBLEM_FORMATS, 'format', options.to, output)
    write(output, format_to.write(scenario, output))
    if not options.check:
        return DONE
    # The car is not in every format, so it is an argument.
    written = format_to.read(output, read_file(output, LARGEST), vehicle, None, None)
    return max(status, report(output, differences(written, scenario)))


def convert_result(source, content, output, options):
    refuse(options, f'changes a problem, and {quoted(source)} is a result', 'start', 'goal', 'vehicle')
    result = results.parse(source, content)
    if options.check:
        length = number(round(np.abs(result.path.lengths).sum(), 3))
        stretches = counted(len(result.path.runs()), 'stretch', 'stretches')
        print(f'{source}: {result.planner}, {result.status}, path of {length} m in {stretches}, trajectory of '
              f'{counted(len(result.trajectory), "sample")}')
    if output is None:
        return DONE
    refuse_input(output, [source])
    format_to = format_for(RESULT_FORMATS, 'format of results', options.to, output)
    if format_to.is_trajectory and not len(result.trajectory):
        raise Error(f'{source}: the result has no trajectory to write as {format_to.name}; plan with --trajectory or '
                    '--track')
    write(output, format_to.write(result))
    if not options.check:
        return DONE
    fault = format_to.fault(result, output, read_file(output, LARGEST))
    return report(output, [fault] if fault else [])


def generate_hope(folder, options):
    count = whole_option(options, 'count', 10, 1, 1000000)
    seed = whole_option(options, 'seed', 1, 0, 1000000000)
    if options.hope not in hope.LEVELS:
        raise Error(unknown_name('level of HOPE', options.hope, list(hope.LEVELS)))
    format_to = format_for(PROBLEM_FORMATS, 'format', options.to or 'yaml', folder)
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise Error(f'{quoted(folder)}: cannot be created: {error.strerror}') from None
    status = DONE
    for each in range(seed, seed + count):
        scenario = hope.scene(options.hope, each)
        file = os.path.join(folder, scenario.name + format_to.extension)
        write(file, format_to.write(scenario, file))
        if options.check:
            written = format_to.read(file, read_file(file, LARGEST), None, None, None)
            status = max(status, report(file, faults_of(written)))
    print(f'{counted(count, "problem")}: {folder}')
    return status


def write(file, content):
    write_file(file, content.encode() if isinstance(content, str) else content)


def summary_of(scenario):
    obstacles = counted(len(scenario.polygons), 'obstacle')
    if scenario.grid is not None:
        rows, columns = scenario.grid.shape
        obstacles = f'a map of {columns} x {rows} cells'
    return (f'{scenario.name}: car {scenario.vehicle.name}, start {numbers(scenario.start, ",")}, '
            f'goal {numbers(scenario.goals[0], ",")}, {obstacles}')


def report(file, faults):
    for fault in faults:
        print(f'{file}: {fault}')
    return FAULTY if faults else DONE


def faults_of(scenario):
    """The fault of a problem that all readers accept; None without one."""
    is_free = scenario.is_free([scenario.start, *scenario.goals])
    return ([] if is_free[0] else ['the start is in collision']) + \
        ([] if is_free[1:].any() else ['the goal is in collision'])


def differences(written, wanted):
    """The difference between written file and input; None without one."""
    tolerance = max(SAME, 1e-14 * (1.0 + abs(wanted.start[0]) + abs(wanted.start[1])))

    def same(a, b):
        turned = abs((a[2] - b[2] + math.pi) % math.tau - math.pi)
        return math.hypot(a[0] - b[0], a[1] - b[1]) <= tolerance and turned <= tolerance

    faults = []
    if not same(written.start, wanted.start):
        faults.append('the start differs from the input')
    if not same(written.goals[0], wanted.goals[0]):
        faults.append('the goal differs from the input')
    ours, theirs = obstacle_polygons(written), obstacle_polygons(wanted)
    if len(ours) != len(theirs):
        return faults + [f'{counted(len(ours), "obstacle")} instead of {len(theirs)}']
    for k, (polygon, other) in enumerate(zip(ours, theirs), 1):
        away = np.hypot(*np.moveaxis(other[:, None] - polygon, 2, 0)).min(axis=1)
        if away.max() > tolerance:
            faults.append(f'obstacle {k} has lost a corner; the format may support convex obstacles only')
    return faults


def run(arguments):
    """Converts, and returns the exit status of the program. Errors become one line on standard error."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        status = convert(arguments)
        sys.stdout.flush()
        return status
    except Error as error:
        reason = str(error)
    except OSError as error:  # the library, which raises Error, reads and writes all files
        reason = f'standard output cannot be written: {error.strerror}'
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python would write again at its end
    print(f'parking_convert: {one_line(reason)}', file=sys.stderr)
    return BAD_INPUT
