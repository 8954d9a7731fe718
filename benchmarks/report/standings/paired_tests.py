"""Tests of paired scores: is one planner better than another on problems like these?

A difference is one number for each problem; it may be infinite (one solved it, the other did not) or zero (a tie).
"""
import collections
import functools
import math

EXACT = 50  # differences up to which the distribution of ranks is counted out

Wilcoxon = collections.namedtuple('Wilcoxon', 'plus minus count zeros p exact')


def middle_ranks(values):
    """Ranks from 1; equal values share the mean of theirs."""
    order = sorted(range(len(values)), key=lambda k: values[k])
    ranks, begin = [0.0] * len(values), 0
    while begin < len(order):
        end = begin
        while end + 1 < len(order) and values[order[end + 1]] == values[order[begin]]:
            end += 1
        for k in range(begin, end + 1):
            ranks[order[k]] = 0.5 * (begin + end) + 1.0
        begin = end + 1
    return ranks


@functools.lru_cache(maxsize=256)
def _counts_of_sums(doubled):
    """How many choices of signs give each sum of positive ranks (all doubled, so that they are whole).

    The product of (1 + x^r) over the ranks, its coefficients packed into one long integer."""
    width = (len(doubled) // 8 + 1) * 8
    packed = 1
    for rank in doubled:
        packed += packed << (rank * width)
    size = width // 8
    content = packed.to_bytes((sum(doubled) + 1) * size, 'little')
    return [int.from_bytes(content[k:k + size], 'little') for k in range(0, len(content), size)]


def wilcoxon(differences, exact_up_to=EXACT):
    """Signed-rank test, two-sided (Wilcoxon 1945). Zeros take part in the ranking and lose their ranks afterwards
    (Pratt 1959); equal ones share the mean of their ranks. The distribution is that of these very ranks: counted out for
    up to exact_up_to differences, else normal with their variance and a continuity correction of a half."""
    ranks = middle_ranks([round(abs(value), 12) for value in differences])
    plus = sum(rank for rank, value in zip(ranks, differences) if value > 0.0)
    minus = sum(rank for rank, value in zip(ranks, differences) if value < 0.0)
    own = [rank for rank, value in zip(ranks, differences) if value != 0.0]
    zeros = len(differences) - len(own)
    exact = len(own) <= exact_up_to
    if not own:
        return Wilcoxon(0.0, 0.0, 0, zeros, 1.0, True)
    if exact:
        counts = _counts_of_sums(tuple(sorted(round(2.0 * rank) for rank in own)))
        tail = sum(counts[:round(2.0 * min(plus, minus)) + 1])
        p = 2 * tail / 2 ** len(own)
    else:
        deviation = math.sqrt(sum(rank * rank for rank in own) / 4.0)
        distance = max(0.0, abs(plus - minus) / 2.0 - 0.5)
        p = math.erfc(distance / deviation / math.sqrt(2.0))
    return Wilcoxon(plus, minus, len(own), zeros, min(1.0, p), exact)


def sign_test(wins, losses):
    """Two-sided, exact (binomial with 1/2); ties say nothing for either side and are not among the trials."""
    trials = wins + losses
    return min(1.0, 2 * sum(math.comb(trials, k) for k in range(min(wins, losses) + 1)) / 2 ** trials)


def holm(values):
    """p values adjusted for being several (Holm 1979), in the order given: significant are those at most the level."""
    adjusted, greatest = [0.0] * len(values), 0.0
    for place, k in enumerate(sorted(range(len(values)), key=lambda k: values[k])):
        greatest = max(greatest, min(1.0, (len(values) - place) * values[k]))
        adjusted[k] = greatest
    return adjusted
