"""What planners are compared by: a score for each problem, the less the better, and what follows from it."""
import dataclasses
import math

from order_statistics import median
from standings.paired_tests import holm, sign_test, wilcoxon

MEASURES = {'time': 'time to the first solution', 'length': 'length of the path'}
PENALTY = 10.0  # a run that is not solved counts as so many time limits
LEVEL = 0.05
LEAST = 1e-9    # seconds or metres; scores are compared by their ratios


def rounded(value):
    """Six significant digits: what differs by less is the noise of arithmetic, and a tie."""
    return float(f'{value:.6g}')


def score(runs, measure):
    """Median over all runs; infinite where half of them or more have no valid exact solution."""
    return rounded(median([max(LEAST, getattr(run, measure)) for run in runs]))


def penalised(runs, limit):
    """Mean time, in which each run without a valid exact solution counts as ten time limits (PAR-10)."""
    return sum(run.time if run.solved else PENALTY * limit for run in runs) / len(runs)


def wilson(share, trials, z=1.959963984540054):
    """95 % interval of a share (Wilson 1927)."""
    if trials <= 0:
        return 0.0, 1.0
    middle = share + z * z / (2.0 * trials)
    reach = z * math.sqrt(share * (1.0 - share) / trials + z * z / (4.0 * trials * trials))
    whole = 1.0 + z * z / trials
    return max(0.0, (middle - reach) / whole), min(1.0, (middle + reach) / whole)


@dataclasses.dataclass
class Field:
    """Planners that were run on the same problems, which can be compared on all of them."""
    problems: list
    planners: list  # indices
    runs: dict      # (problem, index) -> runs
    scores: dict    # measure -> {index: [score of each problem]}

    def virtual_best(self, measure):
        """For each problem the score of the planner that is best there; infinite where none solves it."""
        return [min(column) for column in zip(*(self.scores[measure][index] for index in self.planners))]

    def rows(self, measure):
        """For each problem the scores of all planners."""
        return [list(row) for row in zip(*(self.scores[measure][index] for index in self.planners))]


def score_table(results):
    """measure -> {(problem, index): score} for all that was run."""
    table = {measure: {} for measure in MEASURES}
    for index, planner in enumerate(results.planners):
        for problem in results.problems:
            runs = results.of(problem, planner)
            if runs:
                for measure in MEASURES:
                    table[measure][problem, index] = score(runs, measure)
    return table


def fields(results, scores):
    """The largest first. Every planner is in one."""
    found = {}
    for index, planner in enumerate(results.planners):
        problems = tuple(problem for problem in results.problems if results.of(problem, planner))
        if problems:
            found.setdefault(problems, []).append(index)
    made = []
    for problems, planners in sorted(found.items(), key=lambda item: -len(item[0]) * len(item[1])):
        runs = {(problem, index): results.of(problem, results.planners[index])
                for problem in problems for index in planners}
        made.append(Field(list(problems), planners, runs,
                          {measure: {index: [scores[measure][problem, index] for problem in problems]
                                     for index in planners} for measure in MEASURES}))
    return made


def ratios(field, measure):
    """index -> score over the virtual best's for each problem; infinite where the planner does not solve it."""
    best = field.virtual_best(measure)
    return {index: [own / least if math.isfinite(own) else math.inf
                    for own, least in zip(field.scores[measure][index], best)] for index in field.planners}


def share_within(values, ratio):
    """Share of all problems on which a planner is at most so many times worse than the virtual best."""
    return sum(value <= ratio * (1.0 + 1e-12) for value in values) / len(values)


def profile(values):
    """Points (ratio, share of all problems with at most this ratio), from ratio 1 (Dolan and More 2002)."""
    finite = sorted(value for value in values if math.isfinite(value))
    points = [(1.0, share_within(values, 1.0))]
    for count, value in enumerate(finite, 1):
        if value > points[-1][0] * (1.0 + 1e-12):
            points.append((value, count / len(values)))
        else:
            points[-1] = (points[-1][0], count / len(values))
    return points


def expected_solved(field, index, most=150):
    """Points (time, expected number of problems solved by then when each is tried once, low, high).

    The interval is Wilson's for as many trials as there are problems: runs on one problem are not independent. It never
    promises too much for problems drawn alike, since the share of runs solved on a problem spreads at most as far as
    solved or not."""
    count = len(field.problems)
    gains = sorted((run.time, 1.0 / len(field.runs[problem, index])) for problem in field.problems
                   for run in field.runs[problem, index] if run.solved)
    total, points = 0.0, []
    for time, gain in gains:
        total += gain
        if points and points[-1][0] == time:
            points.pop()
        points.append((time, min(total, float(count))))
    if len(points) > most:
        kept = [round(k * (len(points) - 1) / (most - 1)) for k in range(most)]
        points = [points[k] for k in kept]
    made = []
    for time, solved in points:
        low, high = wilson(solved / count, count)
        made.append((time, solved, low * count, high * count))
    return made


def par10(field, index, limit):
    """Mean over the problems, each of the same weight."""
    return sum(penalised(field.runs[problem, index], limit) for problem in field.problems) / len(field.problems)


def best_par10(field, limit):
    """That of somebody who knows for each problem which planner to take."""
    return sum(min(penalised(field.runs[problem, index], limit) for index in field.planners)
               for problem in field.problems) / len(field.problems)


@dataclasses.dataclass
class Pair:
    """Two planners on the problems that both were run on."""
    measure: str
    first: int
    second: int
    problems: int
    wins: int    # of the first
    ties: int
    losses: int
    ratio: float  # median of first over second; neither solved counts as 1
    wilcoxon: object = None
    sign: float = 1.0
    wilcoxon_holm: float = 1.0
    sign_holm: float = 1.0

    @property
    def differ(self):
        return self.wilcoxon_holm <= LEVEL


def difference(first, second):
    """Logarithm of the ratio; 0 when neither solved it."""
    if first == second:
        return 0.0
    if math.isinf(first) or math.isinf(second):
        return math.inf if math.isinf(first) else -math.inf
    return math.log(first / second)


def middle_difference(differences):
    """Median; of two in the middle an infinite one counts, and two opposite ones say that neither is ahead."""
    ordered = sorted(differences)
    low, high = ordered[(len(ordered) - 1) // 2], ordered[len(ordered) // 2]
    if math.isinf(low) and math.isinf(high) and low != high:
        return 0.0
    return low if low == high or math.isinf(low) else 0.5 * (low + high)


def pairs(results, scores):
    """All pairs of planners that share two problems or more. Holm's correction is for all pairs of a measure between
    planners that such pairs connect: those on problems of their own are other experiments."""
    made = []
    for measure in MEASURES:
        own = []
        table = scores[measure]
        for first in range(len(results.planners)):
            for second in range(first + 1, len(results.planners)):
                found = [difference(table[problem, first], table[problem, second]) for problem in results.problems
                         if (problem, first) in table and (problem, second) in table]
                if len(found) < 2:
                    continue
                wins, losses = sum(value < 0.0 for value in found), sum(value > 0.0 for value in found)
                own.append(Pair(measure, first, second, len(found), wins, len(found) - wins - losses, losses,
                                math.exp(middle_difference(found)), wilcoxon(found), sign_test(wins, losses)))
        for family in families(own):
            for pair, adjusted in zip(family, holm([pair.wilcoxon.p for pair in family])):
                pair.wilcoxon_holm = adjusted
            for pair, adjusted in zip(family, holm([pair.sign for pair in family])):
                pair.sign_holm = adjusted
        made += own
    return made


def families(made):
    """Pairs whose planners are connected by pairs, together."""
    home = {}
    for pair in made:
        first, second = home.setdefault(pair.first, {pair.first}), home.setdefault(pair.second, {pair.second})
        if first is not second:
            first |= second
            home.update(dict.fromkeys(second, first))
    found = {}
    for pair in made:
        found.setdefault(id(home[pair.first]), []).append(pair)
    return list(found.values())
