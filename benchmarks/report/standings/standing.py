"""All figures of the standings, computed once for the page and for the files beside it."""
import dataclasses
import math

from standings.classes import problem_classes
from standings.ranks import critical_difference, friedman, groups, mean_ranks
from standings.scores import (MEASURES, best_par10, expected_solved, fields, pairs, par10, penalised, profile, ratios,
                              score_table, share_within)

WITHIN = {'time': (1.0, 2.0, 10.0), 'length': (1.0, 1.01, 1.1)}  # ratios to the virtual best that the tables have


@dataclasses.dataclass
class Row:
    """One planner on some problems."""
    index: int
    runs: int
    solved: int
    expected: float  # number of problems solved when each is tried once
    par10: float     # s
    within: dict     # (measure, ratio) -> share of the problems
    rank: dict       # measure -> mean rank


@dataclasses.dataclass
class Ranking:
    """Mean ranks by one measure."""
    ranks: dict      # index -> mean rank
    friedman: object
    critical: float  # Nemenyi's difference
    groups: list     # of indices that no pair of is told apart


class FieldStanding:
    """How the planners of one field stand to each other on its problems."""

    def __init__(self, field, differ, limit):
        self.field = field
        self.ratios = {measure: ratios(field, measure) for measure in MEASURES}
        self.profiles = {measure: {index: profile(values) for index, values in self.ratios[measure].items()}
                         for measure in MEASURES}
        self.expected = {index: expected_solved(field, index) for index in field.planners}
        self.best_par10 = best_par10(field, limit)
        self.best_solved = sum(math.isfinite(value) for value in field.virtual_best('time'))
        self.rankings = {}
        for measure in MEASURES:
            rows = field.rows(measure)
            ranks = mean_ranks(rows)

            def different(a, b, measure=measure):
                return differ.get((measure, *sorted((field.planners[a], field.planners[b]))), False)
            several = len(ranks) > 1
            self.rankings[measure] = Ranking(
                dict(zip(field.planners, ranks)), friedman(rows) if several else None,
                critical_difference(len(ranks), len(rows)) if several else math.nan,
                [[field.planners[k] for k in group] for group in groups(ranks, different)])
        self.rows = [self._row(index, limit) for index in field.planners]

    def _row(self, index, limit):
        field = self.field
        cells = [field.runs[problem, index] for problem in field.problems]
        within = {(measure, ratio): share_within(self.ratios[measure][index], ratio)
                  for measure in MEASURES for ratio in WITHIN[measure]}
        return Row(index, sum(map(len, cells)), sum(run.solved for runs in cells for run in runs),
                   sum(sum(run.solved for run in runs) / len(runs) for runs in cells), par10(field, index, limit), within,
                   {measure: self.rankings[measure].ranks[index] for measure in MEASURES})


class Standing:
    """Everything; fields are sorted by size, pairs by measure."""

    def __init__(self, results, classes_file=None):
        scores = score_table(results)
        self.limit = results.time_limit
        self.pairs = pairs(results, scores)
        differ = {(pair.measure, pair.first, pair.second): pair.differ for pair in self.pairs}
        everyone = fields(results, scores)
        self.fields = [FieldStanding(field, differ, self.limit) for field in everyone]
        self.classes = problem_classes(results, classes_file)
        self.of_class = {}  # (class, index) -> (problems, runs, solved, expected share solved, PAR-10)
        for name, problems in self.classes.items():
            for index, planner in enumerate(results.planners):
                cells = [results.of(problem, planner) for problem in problems if results.of(problem, planner)]
                if cells:
                    self.of_class[name, index] = self._of_cells(cells)

    def _of_cells(self, cells):
        return (len(cells), sum(map(len, cells)), sum(run.solved for runs in cells for run in runs),
                sum(sum(run.solved for run in runs) / len(runs) for runs in cells) / len(cells),
                sum(penalised(runs, self.limit) for runs in cells) / len(cells))
