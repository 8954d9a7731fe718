"""Tests of benchmarks/report/planner_statistics.py: published values, laws, and what SciPy does not decide."""
import itertools
import math
import random
import sys
import unittest

from made_results import REPORT

sys.path.insert(0, REPORT)
from planner_statistics import (EXACT, critical_difference, friedman, groups, holm, mean_ranks, median, median_interval,  # noqa: E402
                                median_ranks, quantile, share_interval, sign_test, wilcoxon, wilson)

# Demsar, "Statistical Comparisons of Classifiers over Multiple Data Sets", 2006, table 6: four classifiers on 14 data sets,
# the more the better. Its ranks of the last but one row (4, 1, 2, 3) tell what its three decimals hide.
DEMSAR = [(0.763, 0.768, 0.771, 0.798), (0.599, 0.591, 0.590, 0.569), (0.954, 0.971, 0.968, 0.967),
          (0.628, 0.661, 0.654, 0.657), (0.882, 0.888, 0.886, 0.898), (0.936, 0.931, 0.916, 0.931),
          (0.661, 0.668, 0.609, 0.685), (0.583, 0.583, 0.563, 0.625), (0.775, 0.838, 0.866, 0.875),
          (1.000, 1.000, 1.000, 1.000), (0.940, 0.962, 0.965, 0.962), (0.619, 0.666, 0.614, 0.669),
          (0.972, 0.981, 0.975, 0.9749), (0.957, 0.978, 0.946, 0.970)]


class MedianTest(unittest.TestCase):
    def test_quantiles_lie_linearly_between_values(self):
        # R: quantile(c(1, 2, 4, 8, 16), 0.25) = 2, quantile(c(1, 2, 4, 8), 0.25) = 1.75
        self.assertEqual([quantile([16, 1, 8, 2, 4], 0.25), quantile([1, 2, 4, 8], 0.25)], [2, 1.75])
        self.assertEqual([median([3.0, 1.0, 2.0]), median([4.0, 1.0, 2.0, 3.0])], [2.0, 2.5])
        self.assertTrue(math.isnan(median([])))

    def test_time_outs_count_as_infinite(self):
        inf = math.inf
        self.assertEqual(median([1.0, 2.0, inf]), 2.0)
        for values in ([1.0, inf, inf], [1.0, 2.0, inf, inf], [inf, inf]):
            self.assertEqual(median(values), inf)
        self.assertEqual(quantile([1, 2, 4, inf], 0.75), inf)

    def test_published_ranks(self):
        # Conover 1999, table A3: n = 6: 1st and 6th; n = 10: 2nd and 9th; n = 20: 6th and 15th; below 6 none.
        self.assertIsNone(median_ranks(5))
        self.assertEqual([median_ranks(count)[:2] for count in (6, 10, 20)], [(1, 6), (2, 9), (6, 15)])
        self.assertEqual(median_interval([3.0, 1.0, math.inf]), (1.0, math.inf, 0.0))

    def test_ranks_are_the_narrowest_of_their_certainty(self):
        def certainty_of(count, rank):
            return 1.0 - 2.0 * (sum(math.comb(count, k) for k in range(rank)) / 2 ** count)
        for count in (6, 7, 30, 101, 1000):
            first, last, certainty = median_ranks(count)
            self.assertEqual(first + last, count + 1)
            self.assertAlmostEqual(certainty, certainty_of(count, first), 10)
            self.assertGreaterEqual(certainty, 0.95)
            self.assertLess(certainty_of(count, first + 1), 0.95)

    def test_covers_the_median_as_often_as_it_says(self):
        rng = random.Random(5)
        intervals = (median_interval([rng.expovariate(1.0) for _ in range(15)]) for _ in range(3000))
        inside = sum(low <= math.log(2.0) <= high for low, high, _ in intervals)
        certainty = median_ranks(15)[2]
        self.assertLess(abs(inside / 3000 - certainty), 4 * math.sqrt(certainty * (1 - certainty) / 3000))


class ShareTest(unittest.TestCase):
    def test_published_intervals(self):
        # Clopper and Pearson for 5 of 10: 0.1871 to 0.8129; for none of 10: 0 to 0.3085 (1 - 0.025^0.1).
        for found, wanted in zip(share_interval(5, 10) + share_interval(0, 10), (0.18709, 0.81291, 0.0, 1.0 - 0.025 ** 0.1)):
            self.assertAlmostEqual(found, wanted, 4)
        self.assertEqual(share_interval(0, 0), (0.0, 1.0))
        # Wilson for 5 of 10: 0.2366 to 0.7634; for none of 10: 0 to z^2 / (n + z^2).
        for found, wanted in zip(wilson(0.5, 10) + wilson(0.0, 10), (0.2366, 0.7634, 0.0, 3.8414588 / 13.8414588)):
            self.assertAlmostEqual(found, wanted, 4)


class PairTest(unittest.TestCase):
    def test_signed_ranks_as_published(self):
        # Tables of critical values: n = 10, 5 % two-sided: 8 (p = 0.0488) is significant; n = 6: only 0; n = 5: nothing.
        negative = {10: (1, 7), 6: (), 5: ()}
        for count, wanted in ((10, 0.048828125), (6, 0.03125), (5, 0.0625)):
            values = [float(-k if k in negative[count] else k) for k in range(1, count + 1)]
            self.assertAlmostEqual(wilcoxon(values).p, wanted, 12)
        # Demsar, table 2: R+ = 93 and R- = 12 where the ranks of the two zeros (1.5 each) are split between both.
        found = wilcoxon([round(second - first, 3) for first, second, *_ in DEMSAR])
        self.assertEqual((found.zeros, found.count, found.plus + 1.5, found.minus + 1.5), (2, 12, 93.0, 12.0))

    def test_signed_ranks_with_ties_zeros_and_infinities(self):
        # By hand: ranks 1 (zero), 2.5, 2.5, 4; of 8 choices of signs the sum of positive ones is at most 2.5 in 3.
        self.assertAlmostEqual(wilcoxon([0.0, 1.0, -1.0, math.inf]).p, 2 * 3 / 8, 12)
        self.assertEqual([wilcoxon([0.0] * 7).p, wilcoxon([1.0]).p], [1.0, 1.0])

    def test_sides_are_alike_and_magnitude_does_not_matter(self):
        rng = random.Random(2)
        for count in (3, EXACT, EXACT + 4, 120):
            values = [rng.choice((0.0, rng.gauss(0.2, 1.0))) for _ in range(count)]
            found, turned = wilcoxon(values), wilcoxon([-value for value in values])
            self.assertEqual((found.plus, found.minus), (turned.minus, turned.plus))
            self.assertAlmostEqual(found.p, turned.p, 12)
            self.assertAlmostEqual(found.p, wilcoxon([math.copysign(abs(value) ** 3, value) for value in values]).p, 12)

    def test_level_is_kept_whether_exact_or_not(self):
        rng = random.Random(6)
        for count in (EXACT, 15):
            rejected = sum(wilcoxon([rng.gauss(0.0, 1.0) for _ in range(count)]).p <= 0.05 for _ in range(1000))
            self.assertLess(rejected / 1000, 0.05 + 4 * math.sqrt(0.05 * 0.95 / 1000))
            self.assertGreater(rejected / 1000, 0.02)

    def test_sign_test(self):
        self.assertAlmostEqual(sign_test(9, 1), 0.021484375, 12)  # 2 (1 + 10) / 2^10
        self.assertEqual([sign_test(0, 0), sign_test(3, 3), sign_test(4, 3)], [1.0, 1.0, 1.0])

    def test_holm(self):
        # By hand: sorted 0.005, 0.01, 0.03, 0.04 times 4, 3, 2, 1 are 0.02, 0.03, 0.06, 0.04, and none below the previous.
        for found, wanted in zip(holm([0.01, 0.04, 0.03, 0.005]), (0.03, 0.06, 0.06, 0.02)):
            self.assertAlmostEqual(found, wanted, 12)
        rng = random.Random(8)
        for _ in range(100):
            values = [rng.choice((rng.random(), rng.random() ** 6, 0.02)) for _ in range(rng.randrange(0, 30))]
            found = holm(values)
            self.assertEqual([found[k] for k in sorted(range(len(values)), key=lambda k: values[k])], sorted(found))
            self.assertTrue(all(own <= adjusted <= min(1.0, len(values) * own + 1e-15)
                                for own, adjusted in zip(values, found)))


class RanksTest(unittest.TestCase):
    def test_published_example(self):
        rows = [[-value for value in row] for row in DEMSAR]
        ranks = mean_ranks(rows)
        for found, wanted in zip(ranks, (3.143, 2.000, 2.893, 1.964)):
            self.assertAlmostEqual(found, wanted, 3)
        # Demsar does not correct for ties: 9.28. The correction divides by 1 - sum(t^3 - t) / (N k (k^2 - 1)).
        ties = sum(row.count(value) ** 2 - 1 for row in rows for value in row)
        self.assertAlmostEqual(friedman(rows).chi_square * (1 - ties / (14 * 4 * 15)), 9.28, 2)
        self.assertAlmostEqual(critical_difference(4, 14), 1.25, 2)

    def test_probability_of_friedman(self):
        rng = random.Random(3)
        for _ in range(20):  # of three the F distribution has a closed form: (1 + 2 F / n)^(-n / 2)
            found = friedman([[rng.random() + 0.2 * k for k in range(3)] for _ in range(9)])
            self.assertAlmostEqual(found.p, (1.0 + 2.0 * found.f / 16.0) ** -8.0, 9)
        self.assertEqual([friedman([row] * 5).p for row in ([1.0, 2.0, 3.0], [1.0, 1.0, 1.0])], [0.0, 1.0])
        self.assertIsNone(friedman([[1.0, 2.0]] * 5))

    def test_ranks_of_all_sum_up(self):
        rng = random.Random(5)
        rows = [[rng.choice((1.0, 2.0, math.inf)) for _ in range(7)] for _ in range(20)]
        self.assertAlmostEqual(sum(mean_ranks(rows)), 28.0)

    def test_groups(self):
        def apart(*several):
            return lambda a, b: (min(a, b), max(a, b)) in several
        ranks = [1.0, 2.0, 3.0, 4.0]
        self.assertEqual(groups(ranks, apart()), [[0, 1, 2, 3]])
        self.assertEqual(groups(ranks, apart((0, 3))), [[0, 1, 2], [1, 2, 3]])
        self.assertEqual(groups(ranks, apart(*itertools.combinations(range(4), 2))), [])
        self.assertEqual(groups([4.0, 1.0, 2.0, 3.0], apart((0, 1))), [[1, 2, 3], [2, 3, 0]])
        # Neither end differs from the other, but two within do: no bar over both of these.
        self.assertEqual(groups(ranks, apart((1, 2))), [[0, 1], [2, 3]])


if __name__ == '__main__':
    unittest.main()
