"""Results of parking_benchmark as pandas data frames; pandas is imported when the first is read."""
import glob
import json
import os
import pathlib
import re
import sqlite3

from ._core import Error

FORMAT = 2  # of the lines in runs.jsonl


def _one_line(error):
    return ' '.join(str(error).split())


def _runs_of_file(file):
    """The runs in one journal: those that its last header wants, each once."""
    try:
        with open(file, encoding='utf-8', errors='replace', newline='\n') as stream:
            lines = stream.read().split('\n')
    except OSError as error:
        raise Error(f'{file}: cannot be read: {error.strerror}') from error
    header, rows = None, []
    for count, line in enumerate(lines[:-1], 1):  # behind the last line end: nothing, or a line cut short
        try:
            record = json.loads(line)
            if 'parking_benchmark' in record:
                if record['parking_benchmark'] != FORMAT:
                    raise Error(f'{file}: was written by another version of parking_benchmark')
                header = record
            else:
                row = {'problem': record['experiment'], 'planner': record['planner'], **record['reported'],
                       **record['figures']}
                row['parameters'] = dict(record['parameters'])
                row['progress'] = [tuple(step) for step in record['progress']]
                rows.append((record.get('fingerprint', ''), row))
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            if isinstance(error, Error):
                raise
            raise Error(f'{file}:{count}: is not a line of benchmark results ({_one_line(error)})') from error
    if header is None and not rows:
        raise Error(f'{file}: is not a file of benchmark results')
    wanted = (header or {}).get('fingerprints')
    return [row for fingerprint, row in rows
            if wanted is None or wanted.get(row['problem'], {}).get(row['planner']) == fingerprint]


def _runs_of_database(file):
    try:
        connection = sqlite3.connect(pathlib.Path(file).absolute().as_uri() + '?mode=ro', uri=True)
        try:
            connection.row_factory = sqlite3.Row
            experiments = {row['id']: str(row['name']) for row in connection.execute('SELECT * FROM experiments')}
            planners = {row['id']: str(row['name']) for row in connection.execute('SELECT * FROM plannerConfigs')}
            progress = {}
            if 'best_cost' in [row[1] for row in connection.execute('PRAGMA table_info(progress)')]:
                for run, time, cost in connection.execute('SELECT runid, time, best_cost FROM progress '
                                                          'WHERE best_cost IS NOT NULL ORDER BY runid, time'):
                    progress.setdefault(run, []).append((time, cost))
            rows = []
            for run in connection.execute('SELECT * FROM runs ORDER BY id'):
                row = {'problem': experiments[run['experimentid']],
                       'planner': re.sub(r'^(geometric|control)_', '', planners[run['plannerid']])}
                row.update({name.replace('_', ' '): run[name] for name in run.keys()
                            if name not in ('id', 'experimentid', 'plannerid')})
                row['progress'] = progress.get(run['id'], [])
                rows.append(row)
            return rows
        finally:
            connection.close()
    except (sqlite3.Error, KeyError, IndexError) as error:
        raise Error(f'{file}: is not a benchmark database ({_one_line(error)})') from error


def read_runs(path):
    """The runs of a comparison, one row each, as a pandas DataFrame.

    path: a file of runs (.jsonl), a database (.db), or the folder that parking_benchmark wrote: then its runs*.jsonl, or
    else its benchmark.db. Columns: problem, planner, those of docs/comparison.md, and progress: a list of
    (seconds, cost).
    """
    import pandas
    try:
        path = os.fsdecode(path)
    except TypeError:
        raise Error(f'path must be the path of a file or folder, not {path!r}') from None
    if os.path.isdir(path):
        whole = os.path.join(path, 'runs.jsonl')
        files = [whole] if os.path.exists(whole) else sorted(glob.glob(os.path.join(glob.escape(path), 'runs-*.jsonl')))
        database = os.path.join(path, 'benchmark.db')
        if not files and os.path.exists(database):
            files = [database]
        if not files:
            raise Error(f'{path}: holds no results of parking_benchmark (runs*.jsonl or benchmark.db)')
    elif os.path.exists(path):
        files = [path]
    else:
        raise Error(f'{path}: there is no such file or folder')
    rows, known = [], set()
    for file in files:
        database = file.endswith('.db')
        for row in _runs_of_database(file) if database else _runs_of_file(file):
            key = (row['problem'], row['planner'], row.get('run'))
            if database or key not in known:
                known.add(key)
                rows.append(row)
    frame = pandas.DataFrame(rows)
    return frame.sort_values(['problem', 'planner', 'run'], ignore_index=True) if 'run' in frame else frame
