"""Statistics of runs and problems without assumptions about distributions, computed by SciPy.

Values may be infinite: a run that timed out took longer than all that did not. Definitions and sources:
docs/benchmark-reference.md."""
import collections
import functools
import math

import numpy
from scipy import stats

LEVEL = 0.05  # significance level; intervals have the rest
EXACT = 10    # largest number of differences for the exact Wilcoxon test

Wilcoxon = collections.namedtuple('Wilcoxon', 'plus minus count zeros p exact')
Friedman = collections.namedtuple('Friedman', 'chi_square f p')


def quantile(values, share):
    """Quantile, linear between the two adjacent values (type 7 of Hyndman and Fan); NaN without values.

    NumPy interpolates from infinity to infinity, which gives NaN."""
    ordered = sorted(values)
    if not ordered:
        return math.nan
    position = share * (len(ordered) - 1)
    low, high = ordered[math.floor(position)], ordered[math.ceil(position)]
    return low if low == high else low + (position - math.floor(position)) * (high - low)


def median(values):
    return quantile(values, 0.5)


@functools.lru_cache(maxsize=None)
def median_ranks(count):
    """Ranks (from 1) of the order statistics that enclose the median with at least 95 %, and the certainty; None for
    too few values.

    The number of values below the median is binomially distributed."""
    rank = int(stats.binom.ppf(0.5 * LEVEL, count, 0.5))
    if rank < 1:
        return None
    return rank, count + 1 - rank, float(1.0 - 2.0 * stats.binom.cdf(rank - 1, count, 0.5))


def median_interval(values):
    """(low, high, certainty) of the median; the range of all values and certainty 0 with too few values."""
    ordered = sorted(values)
    if not ordered:
        return math.nan, math.nan, 0.0
    ranks = median_ranks(len(ordered))
    if ranks is None:
        return ordered[0], ordered[-1], 0.0
    return ordered[ranks[0] - 1], ordered[ranks[1] - 1], ranks[2]


@functools.lru_cache(maxsize=None)
def share_interval(successes, trials):
    """Exact 95 % interval of a share (Clopper and Pearson)."""
    if trials == 0:
        return 0.0, 1.0
    return tuple(stats.binomtest(successes, trials).proportion_ci(1.0 - LEVEL, method='exact'))


def wilson(share, trials):
    """95 % interval of a share with a fractional count (Wilson); SciPy's accepts whole numbers only."""
    z = stats.norm.ppf(1.0 - 0.5 * LEVEL)
    middle = share + z * z / (2.0 * trials)
    reach = z * math.sqrt(share * (1.0 - share) / trials + z * z / (4.0 * trials * trials))
    whole = 1.0 + z * z / trials
    return max(0.0, (middle - reach) / whole), min(1.0, (middle + reach) / whole)


def wilcoxon(differences):
    """Two-sided signed-rank test with Pratt's treatment of zeros; plus and minus are the sums of ranks of either sign.

    Exact for up to EXACT differences, with any zeros and ties: all choices of signs are counted. Beyond, by the normal
    approximation, corrected for ties and continuity."""
    values = numpy.round(numpy.asarray(differences, dtype=float), 12)
    signed = numpy.sign(values) * stats.rankdata(numpy.abs(values))  # gives the same test as the values, and is finite
    own = signed[signed != 0.0]
    if own.size < 2:
        p = 1.0
    elif own.size <= EXACT:
        p = stats.permutation_test((own,), lambda ranks, axis: ranks.sum(axis=axis), permutation_type='samples',
                                   vectorized=True, n_resamples=math.inf).pvalue
    else:
        p = stats.wilcoxon(signed, zero_method='pratt', correction=True, method='approx').pvalue
    return Wilcoxon(float(own[own > 0.0].sum()), float(abs(own[own < 0.0]).sum()), own.size, len(values) - own.size, float(p),
                    own.size <= EXACT)


def sign_test(wins, losses):
    """Two-sided exact sign test; ties are not trials."""
    return float(stats.binomtest(wins, wins + losses).pvalue) if wins + losses else 1.0


def holm(values):
    """p values with Holm's correction for multiple tests, in the order given."""
    adjusted, greatest = [0.0] * len(values), 0.0
    for place, k in enumerate(sorted(range(len(values)), key=lambda k: values[k])):
        greatest = max(greatest, min(1.0, (len(values) - place) * values[k]))
        adjusted[k] = greatest
    return adjusted


def mean_ranks(rows):
    """Mean rank of each planner. rows: for each problem the scores of all planners, lower is better."""
    return [float(rank) for rank in stats.rankdata(rows, axis=1).mean(axis=0)]


def friedman(rows):
    """Friedman's test whether all planners rank equally: its statistic, and p by the F distribution of Iman and
    Davenport.

    None for fewer than three planners, for which the tests of pairs suffice."""
    problems, planners = len(rows), len(rows[0])
    if planners < 3:
        return None
    if problems < 2 or all(len(set(row)) == 1 for row in rows):
        return Friedman(0.0, 0.0, 1.0)
    chi_square = float(stats.friedmanchisquare(*zip(*rows)).statistic)
    rest = problems * (planners - 1) - chi_square
    if rest <= 1e-9 * chi_square:
        return Friedman(chi_square, math.inf, 0.0)  # the same order on every problem
    f = (problems - 1) * chi_square / rest
    return Friedman(chi_square, f, float(stats.f.sf(f, planners - 1, (planners - 1) * (problems - 1))))


@functools.lru_cache(maxsize=None)
def critical_difference(planners, problems):
    """Nemenyi's critical difference: a larger difference of two mean ranks is significant, for all pairs at once."""
    width = stats.studentized_range.ppf(1.0 - LEVEL, planners, math.inf)
    return float(width / math.sqrt(2.0) * math.sqrt(planners * (planners + 1) / (6.0 * problems)))


def groups(ranks, differ):
    """Largest groups of planners adjacent by mean rank without a different pair: [[index, ...]], best first.

    differ(a, b): whether two planners differ. Only groups of two and more."""
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
