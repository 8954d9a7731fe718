"""Which class a problem belongs to: as a file says, or by its name."""
import csv
import os
import re

from results import ReportError, require_file

FILE = 'classes.csv'  # in the folder of the results
KINDS = ('parallel', 'perpendicular', 'angled')


def class_by_name(problem):
    """The kind of slot that the name tells, or else the name without its number: Case17 and Case3 are both "Case". What
    other planners are given instead of the car (Case3_se2_circle) stays apart."""
    stem, setting = re.fullmatch(r'(.*?)(_(?:se2|dubins|reeds_shepp)(?:_\w+)?)?', problem, re.DOTALL).groups()
    told = [kind for kind in KINDS if kind in stem.lower()]
    return (told[0] if told else re.sub(r'^\d+[\W_]*|[\W_]*\d+$', '', stem) or stem) + (setting or '')


def read_classes(file):
    """problem -> class, from a CSV file with the columns problem and class. Raises ReportError."""
    require_file(file)
    try:
        with open(file, encoding='utf-8', newline='') as stream:
            rows = list(csv.DictReader(stream))
            names = set(rows[0]) if rows else set()
    except OSError as error:
        raise ReportError(f'{file}: cannot be read: {error.strerror}') from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise ReportError(f'{file}: is not a CSV file ({error})') from error
    if not {'problem', 'class'} <= names:
        raise ReportError(f'{file}: lacks a first line with the columns problem and class, or holds nothing else')
    found = {}
    for count, row in enumerate(rows, 2):
        problem, kind = ((row[name] or '').strip() for name in ('problem', 'class'))
        if not problem or not kind:
            raise ReportError(f'{file}:{count}: lacks a problem or its class')
        if found.setdefault(problem, kind) != kind:
            raise ReportError(f'{file}:{count}: {problem} is of class {found[problem]} already')
    return found


def problem_classes(results, file=None):
    """class -> its problems, in the order of the problems. Those that the file does not name go by their names."""
    beside = os.path.join(results.folder, FILE)
    told = read_classes(file or beside) if file or os.path.exists(beside) else {}
    unknown = [problem for problem in told if problem not in results.problems]
    if file and unknown:
        raise ReportError(f'{file}: {unknown[0]}: there is no such problem in the results')
    found = {}
    for problem in results.problems:
        found.setdefault(told.get(problem) or class_by_name(problem), []).append(problem)
    return found
