"""Mean ranks of several planners over problems, and which of them the problems can tell apart."""
import collections
import functools
import math

from order_statistics import beta_distribution
from standings.paired_tests import middle_ranks

Friedman = collections.namedtuple('Friedman', 'chi_square f p')


def mean_ranks(rows):
    """rows: for each problem the scores of all planners, the least being the best. Returns a mean rank for each planner."""
    ranked = [middle_ranks(row) for row in rows]
    return [sum(column) / len(rows) for column in zip(*ranked)]


def friedman(rows):
    """Do all planners rank alike? Friedman's statistic, corrected for ties, and p by Iman and Davenport's F (1980)."""
    problems, planners = len(rows), len(rows[0])
    ranked = [middle_ranks(row) for row in rows]
    middle = 0.5 * (planners + 1)
    spread = sum((rank - middle) ** 2 for row in ranked for rank in row)
    if spread == 0.0 or problems < 2:
        return Friedman(0.0, 0.0, 1.0)
    between = sum((sum(column) - problems * middle) ** 2 for column in zip(*ranked))
    chi_square = (planners - 1) * between / spread
    rest = problems * (planners - 1) - chi_square
    if rest <= 1e-9 * chi_square:
        return Friedman(chi_square, math.inf, 0.0)  # the same order on every problem
    f = (problems - 1) * chi_square / rest
    first, second = planners - 1, (planners - 1) * (problems - 1)
    return Friedman(chi_square, f, beta_distribution(second / (second + first * f), 0.5 * second, 0.5 * first))


def _range_distribution(width, count):
    """P(greatest - least <= width) of count independent standard normal values (Simpson's rule)."""
    def normal(x):
        return 0.5 * math.erfc(-x / math.sqrt(2.0))
    steps, low, high = 400, -8.0, 8.0
    size = (high - low) / steps
    total = 0.0
    for k in range(steps + 1):
        x = low + k * size
        weight = 1 if k in (0, steps) else 4 if k % 2 else 2
        total += weight * math.exp(-0.5 * x * x) * (normal(x) - normal(x - width)) ** (count - 1)
    return count * total * size / 3.0 / math.sqrt(2.0 * math.pi)


@functools.lru_cache(maxsize=None)
def critical_difference(planners, problems, level=0.05):
    """Nemenyi's (Demsar 2006): mean ranks of two planners that differ by more differ significantly, all pairs considered."""
    low, high = 0.0, 20.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        if 1.0 - _range_distribution(middle, planners) > level:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high) / math.sqrt(2.0) * math.sqrt(planners * (planners + 1) / (6.0 * problems))


def groups(ranks, differ):
    """Largest runs of planners next to each other by mean rank of which no two differ: [[index, ...]], best first.

    differ(a, b): are these two told apart? Only groups of two and more."""
    order = sorted(range(len(ranks)), key=lambda k: ranks[k])
    found, reached = [], 0
    for begin in range(len(order)):
        end = begin
        while end + 1 < len(order) and not any(differ(order[k], order[end + 1]) for k in range(begin, end + 1)):
            end += 1
        if end > begin and end + 1 > reached:
            found.append(order[begin:end + 1])
            reached = end + 1
    return found
