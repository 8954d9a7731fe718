"""Reads what parking_benchmark leaves in a folder: runs*.jsonl, or else its database."""
import csv
import dataclasses
import glob
import json
import math
import os
import pathlib
import re
import sqlite3
import stat

from checks import BadValue, check_header, check_run, is_time

FORMAT = 2  # of the lines in runs.jsonl


class ReportError(Exception):
    """Bad input; its text is one line that names the file."""


@dataclasses.dataclass
class Run:
    """One run of a planner. Times in seconds, lengths in metres; infinite where there is no valid exact solution."""
    problem: str
    planner: str
    number: int
    seed: int
    figures: dict       # name of the column -> number
    improvements: list  # (seconds, metres) of solutions, each shorter than the one before
    path: dict = None   # as in the file of runs

    solved: bool = False        # exact, and valid when checked once more
    invalid: bool = False       # exact in the planner's view only
    approximate: bool = False
    time: float = math.inf      # of the first solution
    length: float = math.inf    # of the last one

    def figure(self, name):
        """A figure as a number; NaN when there is none."""
        return self.figures.get(name, math.nan)


@dataclasses.dataclass
class Results:
    """All runs, and what is known of how they came about."""
    folder: str
    problems: list = dataclasses.field(default_factory=list)
    planners: list = dataclasses.field(default_factory=list)
    runs: list = dataclasses.field(default_factory=list)
    settings: dict = dataclasses.field(default_factory=dict)  # planner -> its parameters
    setups: dict = dataclasses.field(default_factory=dict)    # problem -> text
    machine: str = ''
    cpu: str = ''
    host: str = ''
    config: str = ''
    seed: str = ''
    started: float = None  # seconds since 1970
    time_limit: float = math.nan
    rechecked: bool = True
    sources: list = dataclasses.field(default_factory=list)
    damage: list = dataclasses.field(default_factory=list)    # one line for each file with lines that are none

    def of(self, problem, planner):
        return self._index().get((problem, planner), [])

    def _index(self):
        if not hasattr(self, '_cells'):
            self._cells = {}
            for run in self.runs:
                self._cells.setdefault((run.problem, run.planner), []).append(run)
        return self._cells


def number(text):
    """A value as a float; NaN for what is none."""
    try:
        return float(text)
    except (TypeError, ValueError):
        return math.nan


def judge(run):
    """What counts: a solution that the planner calls exact and that is not valid when checked again is a failure."""
    get = run.figure
    if 'success' in run.figures:
        run.solved = get('success') == 1.0
        exact = not math.isnan(get('first solution time'))
        run.invalid = exact and not run.solved
        run.approximate = not exact and not math.isnan(get('path length'))
    else:  # somebody else's database: nothing was checked again
        run.approximate = get('approximate solution') == 1.0
        right = get('correct solution')
        run.invalid = get('solved') == 1.0 and right == 0.0 and not run.approximate
        run.solved = get('solved') == 1.0 and not run.approximate and not run.invalid
    if not run.solved:
        run.improvements = []
        return
    length = get('path length')
    run.length = length if not math.isnan(length) else get('solution length')
    first = get('first solution time')
    if math.isnan(first):
        first = run.improvements[0][0] if run.improvements else get('time')
    run.time = first
    # The planner's own share of loading a map has a column of its own; the curves leave it out like the tables do.
    loading = get('time') - get('planning time')
    loading = loading if loading > 0.0 else 0.0
    run.improvements = [(max(0.0, time - loading), cost) for time, cost in run.improvements]
    if math.isnan(run.length) and run.improvements:
        run.length = run.improvements[-1][1]
    if not run.improvements:
        run.improvements = [(run.time, run.length)]


def _list_names(results):
    """Names in the order of the configuration, which summary.csv has; planners take turns at random in the runs."""
    problems, planners = [], []
    try:
        with open(os.path.join(results.folder, 'summary.csv'), encoding='utf-8', newline='') as stream:
            for row in csv.DictReader(stream):
                problems.append(row.get('problem'))
                planners.append(row.get('planner'))
    except (OSError, UnicodeDecodeError, csv.Error):
        pass  # then by name
    by_name = sorted({run.planner for run in results.runs}, key=str.lower)
    for order, names, there in ((problems, results.problems, [run.problem for run in results.runs]),
                                (planners, results.planners, by_name)):
        known = set(there)
        names += [name for name in dict.fromkeys(order) if name in known]
        names += [name for name in dict.fromkeys(there) if name not in names]


def _plain(name):
    """In databases '_' stands for blanks."""
    return name.replace('_', ' ')


def _take_header(results, file, record, fingerprints):
    if record['parking_benchmark'] != FORMAT:
        raise ReportError(f'{file}: was written by another version of parking_benchmark')
    check_header(record)
    started = float(record.get('started', 0.0))
    fingerprints[file] = str(record.get('fingerprint', ''))
    if results.started is None or started < results.started:
        results.started = started
    hosts = results.host.split('+') if results.host else []
    host = str(record.get('host', 'unknown'))
    results.host = '+'.join(hosts if host in hosts else hosts + [host])
    results.machine = str(record.get('machine', ''))
    results.cpu = str(record.get('cpu', ''))
    results.config = str(record.get('config', ''))
    results.seed = str(record.get('seed', ''))
    results.time_limit = number(record.get('time_limit'))
    results.setups.update(record.get('setups', {}))


def require_file(file):
    """Raises ReportError for a device: some never end. What is not there says so when it is opened, and a pipe does end."""
    try:
        mode = os.stat(file).st_mode
    except OSError:
        return
    if stat.S_ISDIR(mode) or not (stat.S_ISREG(mode) or stat.S_ISFIFO(mode)):
        raise ReportError(f'{file}: is a {"folder" if stat.S_ISDIR(mode) else "device"}; a file is needed')


def _run_of(record):
    figures = {name: number(value) for name, value in {**record['reported'], **record['figures']}.items()}
    check_run(record)
    run = Run(str(record['experiment']), str(record['planner']), int(figures['run']), int(figures['seed']), figures,
              [(float(time), float(cost)) for time, cost in record['progress']], record.get('path'))
    judge(run)
    return run, dict(record['parameters'])


def _read_runs_file(results, file, known, fingerprints):
    require_file(file)
    try:
        with open(file, encoding='utf-8', errors='replace', newline='\n') as stream:
            lines = stream.read().split('\n')
    except OSError as error:
        raise ReportError(f'{file}: cannot be read: {error.strerror}') from error
    lines.pop()  # empty, or cut short when the program was interrupted
    header, runs, damage = {}, [], []
    for count, line in enumerate(lines, 1):
        try:
            record = json.loads(line)
            if 'parking_benchmark' in record:
                _take_header(results, file, record, fingerprints)
                header = record
            else:
                runs.append((*_run_of(record), str(record.get('fingerprint', ''))))
        except BadValue as error:
            raise ReportError(f'{file}:{count}: {error}') from error
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError) as error:
            damage.append(f'{file}:{count}: is not a line of benchmark results ({_one_line(error)})')
    if not header and not runs:
        raise ReportError(damage[0] if damage else f'{file}: is not a file of benchmark results')
    if len(set(fingerprints.values())) > 1:
        raise ReportError(f'{" and ".join(fingerprints)}: hold the runs of different comparisons; name those that '
                          'belong together with --runs')
    if damage:
        more = f'it and {len(damage) - 1} more are' if len(damage) > 1 else 'it is'
        results.damage.append(f'{damage[0]}; {more} left out')
    # The last header says which runs are of use; those of planners that are gone or changed stay in the file.
    wanted = header.get('fingerprints')
    for run, parameters, fingerprint in runs:
        if wanted is not None and wanted.get(run.problem, {}).get(run.planner) != fingerprint:
            continue
        key = (run.problem, run.planner, run.number)
        if key not in known:
            known.add(key)
            results.settings.setdefault(run.planner, parameters)
            results.runs.append(run)
    results.sources.append(file)


def _one_line(error):
    text = f'no {error}' if isinstance(error, KeyError) else str(error)
    return ' '.join(text.split())


def _check_times(file, properties):
    """Of a row of runs, whoever wrote it."""
    for name, value in properties.items():
        if is_time(name) and not value >= 0.0:
            raise ReportError(f'{file}: run {properties.get("id", 0.0):.0f}: {name} is {value:g}; it must be a number of '
                              'seconds, 0 or more')


def _read_database(results, file):
    if os.path.exists(file) and not os.path.isfile(file):
        raise ReportError(f'{file}: is no file; a database is needed')
    try:
        connection = sqlite3.connect(pathlib.Path(file).absolute().as_uri() + '?mode=ro', uri=True)
        try:
            connection.row_factory = sqlite3.Row
            experiments = {row['id']: row for row in connection.execute('SELECT * FROM experiments')}
            planners = {row['id']: row for row in connection.execute('SELECT * FROM plannerConfigs')}
            progress = {}
            columns = [row[1] for row in connection.execute('PRAGMA table_info(progress)')]
            if 'best_cost' in columns:
                query = 'SELECT runid, time, best_cost FROM progress ORDER BY runid, time'
                for identifier, time, cost in connection.execute(query):
                    steps = progress.setdefault(identifier, [])
                    if cost is not None and (not steps or cost < steps[-1][1]):
                        steps.append((float(time), float(cost)))
            paths = {}
            if connection.execute("SELECT 1 FROM sqlite_master WHERE name = 'details'").fetchone():
                paths = {run: json.loads(path) for run, path in connection.execute('SELECT runid, path FROM details '
                                                                                   'WHERE path IS NOT NULL')}
            counts = {}
            for row in connection.execute('SELECT * FROM runs ORDER BY id'):
                problem = str(experiments[row['experimentid']]['name'])
                planner = re.sub(r'^(geometric|control)_', '', str(planners[row['plannerid']]['name']))
                properties = {_plain(name): number(row[name]) for name in row.keys() if row[name] is not None}
                _check_times(file, properties)
                cell = counts.setdefault((problem, planner), [0])
                index = int(properties.get('run', cell[0]))
                cell[0] += 1
                run = Run(problem, planner, index, int(properties.get('seed', 0)), properties,
                          progress.get(row['id'], []), paths.get(row['id']))
                results.rechecked = results.rechecked and 'success' in properties
                judge(run)
                results.runs.append(run)
            for row in planners.values():
                name = re.sub(r'^(geometric|control)_', '', str(row['name']))
                settings = dict(re.findall(r'^(\S+) = (.*)$', str(row['settings'] or ''), re.MULTILINE))
                results.settings.setdefault(name, settings)
            for row in experiments.values():
                results.setups[str(row['name'])] = str(row['setup'] or '')
                results.host, results.cpu = str(row['hostname'] or ''), str(row['cpuinfo'] or '')
                results.seed, results.time_limit = str(row['seed'] or ''), number(row['timelimit'])
                found = re.search(r'^ompl_improved_astar .*\n.*$', results.setups[str(row['name'])], re.MULTILINE)
                results.machine = found.group(0) if found else str(row['version'] or '')
        finally:
            connection.close()
    except (sqlite3.Error, KeyError, IndexError, ValueError, TypeError, OverflowError) as error:
        raise ReportError(f'{file}: is not a benchmark database of OMPL ({_one_line(error)})') from error
    results.sources.append(file)


def read_results(folder, files=None):
    """Reads the runs in a folder: those of runs.jsonl, or of all runs-*.jsonl, or of benchmark.db.

    files: read these instead. Raises ReportError.
    """
    if not os.path.isdir(folder):
        raise ReportError(f'{folder}: is no folder')
    results = Results(folder)
    if not files:
        whole = os.path.join(folder, 'runs.jsonl')
        files = [whole] if os.path.exists(whole) else sorted(glob.glob(os.path.join(glob.escape(folder),
                                                                                     'runs-*.jsonl')))
    database = os.path.join(folder, 'benchmark.db')
    if files:
        known, fingerprints = set(), {}
        for file in files:
            if file.endswith('.db'):
                _read_database(results, file)
            else:
                _read_runs_file(results, file, known, fingerprints)
    elif os.path.exists(database):
        _read_database(results, database)
    else:
        raise ReportError(f'{folder}: holds no results of parking_benchmark (runs*.jsonl or benchmark.db)')
    if not results.runs:
        raise ReportError(f'{results.sources[0]}: holds no runs')
    _list_names(results)
    return results
