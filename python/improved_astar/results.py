"""Results of parking_benchmark as pandas data frames; pandas is imported on first use."""
import os
import pathlib
import re
import sqlite3

from ._core import Error


def _progress(connection):
    """Returns a dict from the id of a run to its improving solutions: (seconds, cost)."""
    found = {}
    if 'best_cost' in [row[1] for row in connection.execute('PRAGMA table_info(progress)')]:
        for run, time, cost in connection.execute('SELECT runid, time, best_cost FROM progress '
                                                  'WHERE best_cost IS NOT NULL ORDER BY runid, time'):
            steps = found.setdefault(run, [])
            if not steps or cost < steps[-1][1]:
                steps.append((time, cost))
    return found


def _runs_of(file):
    try:
        connection = sqlite3.connect(pathlib.Path(file).absolute().as_uri() + '?mode=ro', uri=True)
        try:
            connection.row_factory = sqlite3.Row
            experiments = {row['id']: str(row['name']) for row in connection.execute('SELECT * FROM experiments')}
            planners = {row['id']: row for row in connection.execute('SELECT * FROM plannerConfigs')}
            types = {row['name']: row['type'] for row in connection.execute('PRAGMA table_info(runs)')}
            progress = _progress(connection)
            rows = []
            for run in connection.execute('SELECT * FROM runs ORDER BY id'):
                planner = planners[run['plannerid']]
                row = {'problem': experiments[run['experimentid']],
                       'planner': re.sub(r'^(geometric|control)_', '', str(planner['name'])),
                       'parameters': dict(re.findall(r'^;?(\S+) = (.*)$', planner['settings'] or '', re.MULTILINE)),
                       'progress': progress.get(run['id'], [])}
                for name in run.keys():
                    if name not in ('id', 'experimentid', 'plannerid'):
                        is_flag = types[name] == 'BOOLEAN' and run[name] is not None
                        row[name.replace('_', ' ')] = bool(run[name]) if is_flag else run[name]
                rows.append(row)
            return rows
        finally:
            connection.close()
    except (sqlite3.Error, KeyError, IndexError) as error:
        raise Error(f'{file}: is not a benchmark database ({" ".join(str(error).split())})') from error


def read_runs(path):
    """Returns the runs of a comparison as a pandas DataFrame with one row per run.

    path : a database, or the output folder of parking_benchmark with its benchmark.db

    The columns are problem, planner, those of docs/benchmark-reference.md, parameters, and progress: a list of
    (seconds, cost).
    """
    import pandas
    try:
        path = os.fsdecode(path)
    except TypeError:
        raise Error(f'path must be the path of a file or folder, not {path!r}') from None
    if not os.path.exists(path):
        raise Error(f'{path}: there is no such file or folder')
    file = os.path.join(path, 'benchmark.db') if os.path.isdir(path) else path
    if not os.path.exists(file):
        raise Error(f'{path}: holds no results of parking_benchmark (benchmark.db)')
    frame = pandas.DataFrame(_runs_of(file))
    return frame.sort_values(['problem', 'planner', 'run'], ignore_index=True) if 'run' in frame else frame
