"""Loads databases of ompl_benchmark_statistics, such as those of parking_benchmark, into plain tables."""
import csv
import dataclasses
import functools
import json
import math
import os
import pathlib
import re
import sqlite3

import numpy

from formatting import own_name
from program import ReportError

FILE = 'benchmark.db'  # name in a folder of results
FULL = 0.99        # share of the time limit beyond which a run used it up
FIRST_FAILURE = 6  # outcomes from this one on are failures of the planner itself (benchmarks/planners/MeasuredPlanner.h)


@dataclasses.dataclass
class Run:
    """One run of a planner. Times in seconds, lengths in metres; infinite without a valid exact solution."""
    problem: str
    planner: str
    values: numpy.ndarray  # values of the columns of the table runs; NaN: none
    columns: dict          # name -> position in the values
    improvements: list     # (seconds, metres) of solutions, each shorter than the previous one

    number: int = 0
    seed: int = 0
    solved: bool = False       # exact, and valid in the second check
    invalid: bool = False      # exact by the planner's report only
    approximate: bool = False  # another path
    time: float = math.inf     # time of the first solution
    length: float = math.inf   # length of the last solution

    def figure(self, name):
        """The value of a column, also by its name with blanks; NaN without one."""
        place = self.columns.get(name.replace(' ', '_'))
        return math.nan if place is None else float(self.values[place])


@dataclasses.dataclass
class Results:
    """All runs, with their settings."""
    problems: list = dataclasses.field(default_factory=list)
    planners: list = dataclasses.field(default_factory=list)
    runs: list = dataclasses.field(default_factory=list)
    settings: dict = dataclasses.field(default_factory=dict)  # planner -> its parameters
    setups: dict = dataclasses.field(default_factory=dict)    # problem -> text
    facts: dict = dataclasses.field(default_factory=dict)     # column of the table experiments -> its distinct values
    time_limit: float = math.nan
    rechecked: bool = True  # whether every solution was checked again
    sources: list = dataclasses.field(default_factory=list)   # files
    labels: list = dataclasses.field(default_factory=list)    # distinguishing names of the sources
    origins: dict = dataclasses.field(default_factory=dict)   # planner -> (folder, its name there)

    def __post_init__(self):
        self._cells = None

    @functools.cached_property
    def _blocked(self):
        return {run.problem for run in self.runs if run.figure('solvable') == 0.0}

    @property
    def folder(self):
        """The value of the first source."""
        return os.path.dirname(os.path.abspath(self.sources[0]))

    @property
    def unsolvable(self):
        """Problems whose start, or every goal, is not free: no path exists, and a planner must not claim one."""
        return [problem for problem in self.problems if problem in self._blocked]

    @property
    def solvable(self):
        """All other problems."""
        return [problem for problem in self.problems if problem not in self._blocked]

    def is_refusal(self, run):
        """Whether a run ended by itself, before the time limit, without claiming a path."""
        return (not run.solved and not run.invalid and not run.figure('outcome') >= FIRST_FAILURE
                and run.figure('planning time') < FULL * self.time_limit)

    @property
    def versions(self):
        """The lines about this project's version and the machine, from the setups; empty for others' databases."""
        found = (re.search(r'^ompl_improved_astar .*\n.*$', setup, re.MULTILINE) for setup in self.setups.values())
        return next((match.group(0).split('\n') for match in found if match), [])

    def of(self, problem, planner):
        """The runs of a planner on a problem."""
        if self._cells is None:
            self._cells = {}
            for run in self.runs:
                self._cells.setdefault((run.problem, run.planner), []).append(run)
        return self._cells.get((problem, planner), [])


def _judge(run, rechecked):
    """Sets the outcome of a run: an exact solution that fails the second check is a failure."""
    get = run.figure
    run.number, run.seed = (0 if math.isnan(get(name)) else int(get(name)) for name in ('run', 'seed'))
    if rechecked:
        run.solved = get('success') == 1.0
        exact = not math.isnan(get('first solution time'))
        run.invalid = exact and not run.solved
        run.approximate = not exact and not math.isnan(get('path length'))
    else:
        run.approximate = get('approximate solution') == 1.0
        run.invalid = get('solved') == 1.0 and get('correct solution') == 0.0 and not run.approximate
        run.solved = get('solved') == 1.0 and not run.approximate and not run.invalid
    if not run.solved:
        run.improvements = []
        return
    # The planner's own share of map loading has a separate column; curves exclude it like the tables.
    loading = get('time') - get('planning time')
    if loading > 0.0:
        run.improvements = [(max(0.0, time - loading), cost) for time, cost in run.improvements]
    lengths = [get('path length'), get('solution length'), *(cost for _, cost in run.improvements[-1:])]
    run.length = next((length for length in lengths if not math.isnan(length)), math.inf)
    times = [get('first solution time'), *(time for time, _ in run.improvements[:1]), get('time')]
    run.time = next((time for time in times if not math.isnan(time)), math.inf)
    run.improvements = run.improvements or [(run.time, run.length)]


def _improvements(connection):
    """id of a run -> its improvements; of databases of OMPL from samples of the best cost at many times."""
    if 'improvements' in (row[1] for row in connection.execute('PRAGMA table_info(details)')):
        return {run: [tuple(map(float, each)) for each in json.loads(text)]
                for run, text in connection.execute('SELECT runid, improvements FROM details')}
    found = {}
    if 'best_cost' in (row[1] for row in connection.execute('PRAGMA table_info(progress)')):
        for run, time, cost in connection.execute('SELECT runid, min(time), best_cost FROM progress WHERE best_cost '
                                                  'IS NOT NULL GROUP BY runid, best_cost ORDER BY runid, 2'):
            steps = found.setdefault(run, [])
            if math.isfinite(cost) and (not steps or cost < steps[-1][1]):
                steps.append((float(time), float(cost)))
    return found


def _planner_name(name):
    return re.sub(r'^(geometric|control)_', '', name)


def _check_values(file, names, table):
    for place, name in enumerate(names):
        if name in ('time', 'path_length') or name.endswith('_time'):
            bad = numpy.flatnonzero(table[:, place] < 0.0)
            if bad.size:
                raise ReportError(f'{file}: run {table[bad[0], 0]:.0f}: {name} is {table[bad[0], place]:g}; it must be '
                                  '0 or more')


def _read_runs(results, connection, file, rename):
    experiments = {row['id']: row for row in connection.execute('SELECT * FROM experiments ORDER BY id')}
    planners = {row['id']: row for row in connection.execute('SELECT * FROM plannerConfigs ORDER BY id')}
    columns = [row for row in connection.execute('PRAGMA table_info(runs)')
               if not re.search('CHAR|TEXT|BLOB', row['type'].upper()) and row['name'] != 'id']
    names = ['id'] + [column['name'] for column in columns]
    quoted = ', '.join('"' + name.replace('"', '""') + '"' for name in names)
    cursor = connection.execute(f'SELECT {quoted} FROM runs ORDER BY id')
    cursor.row_factory = None
    parts = []
    while rows := cursor.fetchmany(5000):
        parts.append(numpy.array(rows, dtype=float))
    table = numpy.concatenate(parts) if parts else numpy.empty((0, len(names)))
    _check_values(file, names, table)
    places = {name: place for place, name in enumerate(names)}
    rechecked = 'success' in places
    results.rechecked = results.rechecked and rechecked
    improvements = _improvements(connection)
    for values in table:
        problem = str(experiments[int(values[places['experimentid']])]['name'])
        name = _planner_name(str(planners[int(values[places['plannerid']])]['name']))
        planner = rename(name)
        results.origins[planner] = os.path.dirname(os.path.abspath(file)), name
        run = Run(problem, planner, values, places, improvements.get(int(values[0]), []))
        _judge(run, rechecked)
        if run.solved and not (math.isfinite(run.time) and math.isfinite(run.length)):
            raise ReportError(f'{file}: run {values[0]:.0f}: is solved and lacks the time or the length of its solution')
        results.runs.append(run)
    for row in planners.values():
        settings = dict(re.findall(r'^;?(\S+) = (.*)$', str(row['settings'] or ''), re.MULTILINE))
        results.settings.setdefault(rename(_planner_name(str(row['name']))), settings)
    for row in experiments.values():
        results.setups.setdefault(str(row['name']), str(row['setup'] or ''))
        for name in ('version', 'hostname', 'cpuinfo', 'date', 'seed', 'timelimit'):
            values = results.facts.setdefault(name, [])
            if row[name] is not None and str(row[name]) not in values:
                values.append(str(row[name]))
    known_problems, known_planners = {run.problem for run in results.runs}, {run.planner for run in results.runs}
    problems, configured = _configured_order(os.path.dirname(file))
    problems += (str(row['name']) for row in experiments.values())
    for names_of, wanted, known in ((results.problems, problems, known_problems),
                                    (results.planners, [*map(rename, configured), *results.settings], known_planners)):
        names_of += [name for name in dict.fromkeys(wanted) if name in known and name not in names_of]


def _configured_order(folder):
    """Problems and planners in the order of the configuration, from summary.csv: a database may have that of the first
    runs, which is random."""
    try:
        with open(os.path.join(folder, 'summary.csv'), encoding='utf-8', newline='') as stream:
            rows = list(csv.DictReader(stream))
    except (OSError, UnicodeDecodeError, csv.Error):
        return [], []
    return [row.get('problem') for row in rows], [row.get('planner') for row in rows]


def _connect(file):
    if not os.path.isfile(file):
        raise ReportError(f'{file}: is not a file; a database is required')
    connection = sqlite3.connect(pathlib.Path(file).absolute().as_uri() + '?mode=ro', uri=True)
    connection.row_factory = sqlite3.Row
    return connection


def _database_of(source):
    if not os.path.isdir(source):
        return source
    file = os.path.join(source, FILE)
    if not os.path.exists(file):
        raise ReportError(f'{source}: contains no results of parking_benchmark ({FILE})')
    return file


def _planners_in(file):
    connection = _connect(file)
    try:
        return {_planner_name(str(name)) for name, in connection.execute('SELECT name FROM plannerConfigs')}
    finally:
        connection.close()


def _label(source):
    """Names that distinguish the planners of a source from those of others."""
    name = os.path.basename(os.path.abspath(source))
    return os.path.basename(os.path.dirname(os.path.abspath(source))) if name == FILE else os.path.splitext(name)[0]


def _labels(sources):
    labels = [_label(source) for source in sources]
    return [label if labels.count(label) == 1 else source for label, source in zip(labels, sources)]


def read_results(*sources):
    """Reads databases, or those in folders. A planner in several of them becomes one for each: "RRT (old)".

    Raises ReportError."""
    results = Results()
    files = [_database_of(source) for source in sources]
    for number, (file, label) in enumerate(zip(files, _labels(sources))):
        try:
            others = set().union(*(_planners_in(other) for k, other in enumerate(files) if k != number))
            connection = _connect(file)
            try:
                _read_runs(results, connection, file,
                           lambda name, label=label, others=others: f'{name} ({label})' if name in others else name)
            finally:
                connection.close()
        except (sqlite3.Error, KeyError, IndexError, ValueError, TypeError, OverflowError) as error:
            text = f'no {error}' if isinstance(error, KeyError) else ' '.join(str(error).split())
            raise ReportError(f'{file}: is not a benchmark database of OMPL ({text})') from error
        results.sources.append(file)
        results.labels.append(label)
    if not results.runs:
        raise ReportError(f'{results.sources[0]}: contains no runs')
    if len(sources) > 1:  # instances of one planner are adjacent
        names = list(map(own_name, results.planners))
        results.planners.sort(key=lambda planner: names.index(own_name(planner)))
    limits = {float(value) for value in results.facts.get('timelimit', [])}
    results.time_limit = max(limits) if limits else math.nan
    return results
