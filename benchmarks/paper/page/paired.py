"""Comparing two algorithms on the same maps: ratios per map, their median, a sign test, and verdicts by one rule."""
import dataclasses
import math

from planner_statistics import holm, median, median_interval, sign_test

NEAR = 1.05   # ratios nearer to 1 than by this factor count as none
LEVEL = 0.05  # of what counts as certain


def chance_of_signs(values):
    """The sign test's probability for differences; those of 0 do not count."""
    return sign_test(sum(value > 0.0 for value in values), sum(value < 0.0 for value in values))


@dataclasses.dataclass
class Comparison:
    """Ratios over maps. The interval is that of the median, from order statistics; certain when it could be had."""
    ratios: list
    middle: float = math.nan
    low: float = math.nan
    high: float = math.nan
    certain: bool = False
    chance: float = 1.0  # of the sign test; corrected when it is one of many

    def way(self, corrected=True):
        """'more', 'less', 'same', or None when the data do not say."""
        if not self.certain:
            return None
        if 1.0 / NEAR <= self.low and self.high <= NEAR:
            return 'same'
        if (corrected and self.chance >= LEVEL) or self.low <= 1.0 <= self.high:
            return None
        return way_of(self.middle) if way_of(self.middle) != 'same' else None


def way_of(ratio):
    """The direction of a ratio that is taken at its word, as the paper's are."""
    return 'same' if abs(math.log(ratio)) <= math.log(NEAR) else 'more' if ratio > 1.0 else 'less'


def comparison_of(ratios):
    """Of one ratio per map, which is positive."""
    if not ratios:
        return Comparison([])
    low, high, certainty = median_interval(ratios)
    return Comparison(ratios, median(ratios), low, high, certainty > 0.0,
                      chance_of_signs([math.log(ratio) if abs(math.log(ratio)) > 1e-9 else 0.0 for ratio in ratios]))


def compare(firsts, seconds):
    """firsts, seconds: figures per map; maps on which one of the two is missing or not positive do not count."""
    return comparison_of([firsts[name] / seconds[name] for name in firsts
                          if name in seconds and firsts[name] > 0.0 and seconds[name] > 0.0])


def correct(comparisons):
    """Corrects the probabilities of comparisons that are looked at together."""
    for each, chance in zip(comparisons, holm([each.chance for each in comparisons])):
        each.chance = chance


def verdict(papers, ours):
    """papers, ours: ways. Both the same: agrees; more against less: opposite; one of them none: differs."""
    if ours is None:
        return 'unclear'
    if papers == ours:
        return 'agrees'
    return 'differs' if 'same' in (papers, ours) else 'opposite'
