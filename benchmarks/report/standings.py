"""Comparison of planners over all problems: profiles, penalised times, ranks and tests of pairs.

Definitions and their sources: docs/benchmark-reference.md."""
import bisect
import csv
import dataclasses
import math
import os
import re

import numpy
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from planner_statistics import (LEVEL, critical_difference, friedman, groups, holm, mean_ranks, median, sign_test, wilcoxon,
                                wilson)
from program import ReportError

MEASURES = {'time': 'time to the first solution', 'length': 'length of the path'}
WITHIN = {'time': (1.0, 2.0, 10.0), 'length': (1.0, 1.01, 1.1)}  # ratios to the virtual best in the tables
PENALTY = 10.0            # number of time limits for an unsolved run
MIN_SCORE = 1e-9          # seconds or metres; scores are compared by their ratios
MAX_POINTS = 150          # maximum points of a curve
CLASSES = 'classes.csv'   # name in the folder of the results
KINDS = ('parallel', 'perpendicular', 'angled')


def score(runs, measure):
    """Median over all runs, to six significant digits: a smaller difference is rounding, and a tie."""
    return float(f'{median([max(MIN_SCORE, getattr(run, measure)) for run in runs]):.6g}')


def penalised(runs, limit):
    """Mean time, in which each run without a valid exact solution counts as ten time limits (PAR-10)."""
    return sum(run.time if run.solved else PENALTY * limit for run in runs) / len(runs)


def share_solved(runs):
    return sum(run.solved for run in runs) / len(runs)


def share_within(values, ratio):
    """Share of all problems on which a planner is at most that many times worse than the virtual best."""
    return sum(value <= ratio * (1.0 + 1e-12) for value in values) / len(values)


def profile(values):
    """Points (ratio, share of all problems with at most this ratio), from ratio 1."""
    ordered = sorted(values)
    ratios = sorted({1.0, *(value for value in ordered if 1.0 < value < math.inf)})
    return [(ratio, bisect.bisect_right(ordered, ratio * (1.0 + 1e-12)) / len(ordered)) for ratio in ratios]


@dataclasses.dataclass
class Row:
    """Results of one planner on the problems of a field."""
    index: int
    runs: int
    solved: int
    expected: float  # expected number of problems solved with one attempt each
    par10: float     # seconds, mean over the problems with equal weights
    within: dict     # (measure, ratio) -> share of the problems
    rank: dict       # measure -> mean rank


@dataclasses.dataclass
class Ranking:
    """Mean ranks by one measure."""
    ranks: dict      # index -> mean rank
    friedman: object
    critical: float  # Nemenyi's critical difference
    groups: list     # lists of indices without a significant difference


class Field:
    """Planners with common problems, and their comparison on all of them."""

    def __init__(self, results, problems, planners, scores, differ):
        self.problems, self.planners = problems, planners  # names, indices
        self._cells = {index: [results.of(problem, results.planners[index]) for problem in problems]
                       for index in planners}
        self.scores = {measure: {index: [scores[measure][problem, index] for problem in problems] for index in planners}
                       for measure in MEASURES}
        self.virtual_best = {measure: [min(column) for column in zip(*self.scores[measure].values())]
                             for measure in MEASURES}
        self.ratios = {measure: {index: [own / best if math.isfinite(own) else math.inf
                                         for own, best in zip(self.scores[measure][index], self.virtual_best[measure])]
                                 for index in planners} for measure in MEASURES}
        self.profiles = {measure: {index: profile(values) for index, values in self.ratios[measure].items()}
                         for measure in MEASURES}
        self.expected = {index: self._expected_solved(index) for index in planners}
        penalties = {index: [penalised(runs, results.time_limit) for runs in self._cells[index]] for index in planners}
        self.best_par10 = sum(min(column) for column in zip(*penalties.values())) / len(problems)
        self.best_solved = sum(math.isfinite(value) for value in self.virtual_best['time'])
        self.rankings = {measure: self._ranking(measure, differ) for measure in MEASURES}
        self.rows = [self._row(index, sum(penalties[index]) / len(problems)) for index in planners]

    def _expected_solved(self, index):
        """Points (time, expected number of problems solved by then with one attempt each, low, high).

        The interval is Wilson's for as many trials as there are problems, since runs on one problem are not
        independent. It is never too narrow for problems of one distribution: the share of runs solved on a problem
        spreads at most as far as 0 or 1."""
        count = len(self.problems)
        gains = {}
        for runs in self._cells[index]:
            for run in runs:
                if run.solved:
                    gains[run.time] = gains.get(run.time, 0.0) + 1.0 / len(runs)
        total, points = 0.0, []
        for time in sorted(gains):
            total += gains[time]
            points.append((time, min(total, float(count))))
        if len(points) > MAX_POINTS:
            points = [points[round(k * (len(points) - 1) / (MAX_POINTS - 1))] for k in range(MAX_POINTS)]
        return [(time, solved, *(count * end for end in wilson(solved / count, count))) for time, solved in points]

    def _ranking(self, measure, differ):
        rows = list(zip(*self.scores[measure].values()))
        ranks = mean_ranks(rows)

        def different(a, b):
            return differ.get((measure, *sorted((self.planners[a], self.planners[b]))), False)
        several = len(ranks) > 1
        return Ranking(dict(zip(self.planners, ranks)), friedman(rows) if several else None,
                       critical_difference(len(ranks), len(rows)) if several else math.nan,
                       [[self.planners[k] for k in group] for group in groups(ranks, different)])

    def _row(self, index, par10):
        cells = self._cells[index]
        return Row(index, sum(map(len, cells)), sum(run.solved for runs in cells for run in runs),
                   sum(map(share_solved, cells)), par10,
                   {(measure, ratio): share_within(self.ratios[measure][index], ratio)
                    for measure in MEASURES for ratio in WITHIN[measure]},
                   {measure: self.rankings[measure].ranks[index] for measure in MEASURES})


@dataclasses.dataclass
class Pair:
    """Two planners on their common problems."""
    measure: str
    first: int
    second: int
    problems: int
    wins: int    # problems won by the first
    ties: int
    losses: int
    ratio: float  # median of first over second; both unsolved counts as 1
    wilcoxon: object
    sign: float
    wilcoxon_holm: float = 1.0
    sign_holm: float = 1.0

    @property
    def differ(self):
        return self.wilcoxon_holm <= LEVEL

    @property
    def first_is_better(self):
        """The planner with the better ranks in the test."""
        return self.wilcoxon.minus > self.wilcoxon.plus


def difference(first, second):
    """Logarithm of the ratio; 0 if both are unsolved."""
    if first == second:
        return 0.0
    if math.isinf(first) or math.isinf(second):
        return math.inf if math.isinf(first) else -math.inf
    return math.log(first / second)


def middle_difference(differences):
    """Median with infinite values: of two in the middle an infinite one counts, and two opposite ones give 0."""
    ordered = sorted(differences)
    low, high = ordered[(len(ordered) - 1) // 2], ordered[len(ordered) // 2]
    if math.isinf(low) and math.isinf(high) and low != high:
        return 0.0
    return low if low == high or math.isinf(low) else 0.5 * (low + high)


def _pairs(results, scores):
    """All pairs of planners with two common problems or more.

    Holm's correction covers all pairs of a measure between planners that such pairs connect: other problems are other
    experiments."""
    made = []
    for measure in MEASURES:
        own, table = [], scores[measure]
        for first in range(len(results.planners)):
            for second in range(first + 1, len(results.planners)):
                found = [difference(table[problem, first], table[problem, second]) for problem in results.solvable
                         if (problem, first) in table and (problem, second) in table]
                if len(found) > 1:
                    wins, losses = sum(value < 0.0 for value in found), sum(value > 0.0 for value in found)
                    own.append(Pair(measure, first, second, len(found), wins, len(found) - wins - losses, losses,
                                    math.exp(middle_difference(found)), wilcoxon(found), sign_test(wins, losses)))
        for family in _families(own):
            for pair, p, sign in zip(family, holm([pair.wilcoxon.p for pair in family]),
                                     holm([pair.sign for pair in family])):
                pair.wilcoxon_holm, pair.sign_holm = p, sign
        made += own
    return made


def _families(pairs):
    """Groups of pairs whose planners are connected by pairs."""
    count = 1 + max((pair.second for pair in pairs), default=0)
    links = coo_matrix((numpy.ones(len(pairs)), ([pair.first for pair in pairs], [pair.second for pair in pairs])), (count, count))
    _, family_of = connected_components(links, directed=False)
    found = {}
    for pair in pairs:
        found.setdefault(family_of[pair.first], []).append(pair)
    return found.values()


def class_by_name(problem):
    """The kind of slot in the name, or else the name without its numbers: Case17 and Case3 are both "Case".

    Problems solved for a disc instead of the car (Case3_se2_circle) stay separate."""
    stem, setting = re.fullmatch(r'(.*?)(_(?:se2|dubins|reeds_shepp)(?:_\w+)?)?', problem, re.DOTALL).groups()
    kinds = [kind for kind in KINDS if kind in stem.lower()]
    return (kinds[0] if kinds else re.sub(r'^\d+[\W_]*|[\W_\d]*\d$', '', stem) or stem) + (setting or '')


def read_classes(file):
    """problem -> class, from a CSV file with the columns problem and class. Raises ReportError."""
    if os.path.exists(file) and not os.path.isfile(file):
        raise ReportError(f'{file}: is not a file; a CSV file is required')
    try:
        with open(file, encoding='utf-8', newline='') as stream:
            rows = list(csv.DictReader(stream))
    except OSError as error:
        raise ReportError(f'{file}: cannot be read: {error.strerror}') from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise ReportError(f'{file}: is not a CSV file ({error})') from error
    if not rows or not {'problem', 'class'} <= set(rows[0]):
        raise ReportError(f'{file}: lacks a first line with the columns problem and class, or contains no other line')
    found = {}
    for count, row in enumerate(rows, 2):
        problem, kind = ((row[name] or '').strip() for name in ('problem', 'class'))
        if not problem or not kind:
            raise ReportError(f'{file}:{count}: lacks a problem or its class')
        if found.setdefault(problem, kind) != kind:
            raise ReportError(f'{file}:{count}: {problem} already belongs to class {found[problem]}')
    return found


def problem_classes(results, file=None):
    """class -> its problems, in the order of the problems. Problems that the file does not contain are classified by
    name."""
    beside = os.path.join(results.folder, CLASSES)
    told = read_classes(file or beside) if file or os.path.exists(beside) else {}
    unknown = [problem for problem in told if problem not in results.problems]
    if file and unknown:
        raise ReportError(f'{file}: {unknown[0]}: there is no such problem in the results')
    found = {}
    for problem in results.solvable:
        found.setdefault(told.get(problem) or class_by_name(problem), []).append(problem)
    return found


class Standings:
    """All figures, computed once for the page and its files. Fields are sorted by size, pairs by measure."""

    def __init__(self, results, classes_file=None):
        # Problems without a solution are no part of any comparison: all that is right there is to refuse them.
        cells = {(problem, index): results.of(problem, planner) for index, planner in enumerate(results.planners)
                 for problem in results.solvable if results.of(problem, planner)}
        scores = {measure: {cell: score(runs, measure) for cell, runs in cells.items()} for measure in MEASURES}
        self.pairs = _pairs(results, scores)
        differ = {(pair.measure, pair.first, pair.second): pair.differ for pair in self.pairs}
        together = {}
        for index in range(len(results.planners)):
            if problems := tuple(problem for problem in results.solvable if (problem, index) in cells):
                together.setdefault(problems, []).append(index)
        self.fields = [Field(results, list(problems), planners, scores, differ) for problems, planners
                       in sorted(together.items(), key=lambda item: -len(item[0]) * len(item[1]))]
        self.classes = problem_classes(results, classes_file)
        self.of_class = {}  # (class, index) -> (problems, runs, solved, expected share solved, PAR-10)
        for name, problems in self.classes.items():
            for index in range(len(results.planners)):
                own = [cells[problem, index] for problem in problems if (problem, index) in cells]
                if own:
                    self.of_class[name, index] = (
                        len(own), sum(map(len, own)), sum(run.solved for runs in own for run in runs),
                        sum(map(share_solved, own)) / len(own),
                        sum(penalised(runs, results.time_limit) for runs in own) / len(own))
