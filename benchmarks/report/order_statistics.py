"""Statistics that assume nothing of a distribution but that its values are independent draws.

Infinite values are welcome everywhere: a run that timed out took longer than all that did not.
"""
import functools
import math


def quantile(values, share):
    """Linear between the two values next to it (Hyndman and Fan 1996, type 7); NaN without values."""
    ordered = sorted(values)
    if not ordered:
        return math.nan
    position = share * (len(ordered) - 1)
    index = int(position)
    fraction = position - index
    if fraction == 0.0 or ordered[index] == ordered[index + 1]:
        return ordered[index]
    return ordered[index] + fraction * (ordered[index + 1] - ordered[index])


def median(values):
    return quantile(values, 0.5)


@functools.lru_cache(maxsize=None)
def median_ranks(count, level=0.95):
    """Ranks (from 1) of the two order statistics that enclose the median with a certainty of at least level, and that
    certainty; None when there are too few values (below 6 for 95 %).

    The number of values below the median is binomially distributed with p = 1/2 (Conover 1999, section 3.2).
    """
    below = 0.0  # P(B <= rank - 2)
    best = None
    for rank in range(1, count // 2 + 1):
        k = rank - 1
        below += math.exp(math.lgamma(count + 1) - math.lgamma(k + 1) - math.lgamma(count - k + 1)
                          - count * math.log(2.0))
        certainty = 1.0 - 2.0 * below
        if certainty < level:
            break
        best = (rank, count + 1 - rank, certainty)
    return best


def median_interval(values, level=0.95):
    """(low, high, certainty); the range of all values and certainty 0 when there are too few."""
    ordered = sorted(values)
    if not ordered:
        return math.nan, math.nan, 0.0
    ranks = median_ranks(len(ordered), level)
    if ranks is None:
        return ordered[0], ordered[-1], 0.0
    return ordered[ranks[0] - 1], ordered[ranks[1] - 1], ranks[2]


def _beta_fraction(a, b, x):
    """Continued fraction of the incomplete beta function (Lentz's method; Press et al., "Numerical Recipes", 6.4)."""
    tiny = 1e-300
    c, d = 1.0, 1.0 - (a + b) * x / (a + 1.0)
    d = 1.0 / (d if abs(d) > tiny else tiny)
    result = d
    for m in range(1, 500):
        for numerator in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                          -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1.0 + numerator * d
            d = 1.0 / (d if abs(d) > tiny else tiny)
            c = 1.0 + numerator / c
            c = c if abs(c) > tiny else tiny
            result *= c * d
        if abs(c * d - 1.0) < 1e-14:
            break
    return result


def beta_distribution(x, a, b):
    """P(X <= x) of a beta distribution with parameters a, b > 0."""
    if x <= 0.0 or x >= 1.0:
        return 0.0 if x <= 0.0 else 1.0
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x))
    if x < (a + 1.0) / (a + b + 2.0):
        return front * _beta_fraction(a, b, x) / a
    return 1.0 - front * _beta_fraction(b, a, 1.0 - x) / b


def _beta_quantile(share, a, b):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if beta_distribution(middle, a, b) < share:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@functools.lru_cache(maxsize=None)
def share_interval(successes, trials, level=0.95):
    """Exact interval for a share (Clopper and Pearson 1934)."""
    if trials == 0:
        return 0.0, 1.0
    tail = 0.5 * (1.0 - level)
    low = 0.0 if successes == 0 else _beta_quantile(tail, successes, trials - successes + 1)
    high = 1.0 if successes == trials else _beta_quantile(1.0 - tail, successes + 1, trials - successes)
    return low, high
