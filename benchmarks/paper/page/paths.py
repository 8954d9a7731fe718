"""The paths of the runs, which the journal of a comparison has beside its database."""
import json
import os

from database import ReportError, read_results


def read_results_with_paths(folder):
    """The results in a folder, whose runs have the member path. Raises ReportError."""
    results = read_results(folder)
    file = os.path.join(folder, 'runs.jsonl')
    try:
        with open(file, encoding='utf-8') as stream:
            records = [json.loads(line) for line in stream]
        paths = {(record['experiment'], record['planner'], record['figures']['run']): record['path']
                 for record in records if 'path' in record}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ReportError(f'{file}: is not a file of benchmark results ({error})') from error
    for run in results.runs:
        run.path = paths.get((run.problem, run.planner, run.number))
    return results
