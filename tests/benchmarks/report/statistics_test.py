"""Tests of benchmarks/report/order_statistics.py against slow exact arithmetic and published values."""
import itertools
import math
import random
import sys
import unittest
from fractions import Fraction

from made_results import REPORT

sys.path.insert(0, REPORT)
from order_statistics import median, median_interval, median_ranks, quantile, share_interval  # noqa: E402


class MedianTest(unittest.TestCase):
    def test_odd_and_even(self):
        self.assertEqual(median([3.0, 1.0, 2.0]), 2.0)
        self.assertEqual(median([4.0, 1.0, 2.0, 3.0]), 2.5)
        self.assertTrue(math.isnan(median([])))

    def test_time_outs_count_as_infinite(self):
        self.assertEqual(median([1.0, 2.0, math.inf]), 2.0)
        self.assertEqual(median([1.0, math.inf, math.inf]), math.inf)
        self.assertEqual(median([1.0, 2.0, math.inf, math.inf]), math.inf)
        self.assertEqual(median([math.inf, math.inf]), math.inf)

    def test_quartiles_as_of_type_7(self):
        # R: quantile(c(1, 2, 4, 8, 16), 0.25) = 2, quantile(c(1, 2, 4, 8), 0.25) = 1.75
        self.assertEqual(quantile([1, 2, 4, 8, 16], 0.25), 2)
        self.assertEqual(quantile([1, 2, 4, 8], 0.25), 1.75)
        self.assertEqual(quantile([1, 2, 4, math.inf], 0.75), math.inf)


class IntervalTest(unittest.TestCase):
    def test_ranks_against_exact_sums(self):
        for count in itertools.chain(range(1, 120), (500, 1001)):
            ranks = median_ranks(count)
            # The largest rank r with 1 - 2 P(B <= r - 1) >= 95 %, in exact arithmetic.
            best, below = None, Fraction(0)
            for rank in range(1, count // 2 + 1):
                below += Fraction(math.comb(count, rank - 1), 2 ** count)
                if 1 - 2 * below >= Fraction(95, 100):
                    best = (rank, count + 1 - rank, float(1 - 2 * below))
            self.assertEqual(ranks is None, best is None, count)
            if best:
                self.assertEqual(ranks[:2], best[:2], count)
                self.assertAlmostEqual(ranks[2], best[2], 10)

    def test_published_ranks(self):
        # Conover 1999, table A3, and any textbook: n = 6: 1st and 6th; n = 10: 2nd and 9th; n = 20: 6th and 15th.
        self.assertIsNone(median_ranks(5))
        self.assertEqual(median_ranks(6)[:2], (1, 6))
        self.assertEqual(median_ranks(10)[:2], (2, 9))
        self.assertEqual(median_ranks(20)[:2], (6, 15))

    def test_too_few_values_give_the_range(self):
        self.assertEqual(median_interval([3.0, 1.0, math.inf]), (1.0, math.inf, 0.0))

    def test_covers_the_median_as_often_as_it_says(self):
        rng = random.Random(5)
        inside, trials = 0, 3000
        for _ in range(trials):
            low, high, _ = median_interval([rng.expovariate(1.0) for _ in range(15)])
            inside += low <= math.log(2.0) <= high
        certainty = median_ranks(15)[2]
        self.assertLess(abs(inside / trials - certainty), 4 * math.sqrt(certainty * (1 - certainty) / trials))


class ShareTest(unittest.TestCase):
    def test_published_values(self):
        # Clopper and Pearson for 5 of 10: 0.1871 to 0.8129; for none of 10: 0 to 0.3085 (1 - 0.025^0.1).
        low, high = share_interval(5, 10)
        self.assertAlmostEqual(low, 0.18709, 4)
        self.assertAlmostEqual(high, 0.81291, 4)
        low, high = share_interval(0, 10)
        self.assertEqual(low, 0.0)
        self.assertAlmostEqual(high, 1.0 - 0.025 ** 0.1, 9)
        self.assertAlmostEqual(share_interval(10, 10)[0], 0.025 ** 0.1, 9)

    def test_ends_have_the_tails_they_should(self):
        for successes, trials in ((3, 11), (40, 44), (500, 1000)):
            low, high = share_interval(successes, trials)
            upper = sum(math.comb(trials, k) * Fraction(low) ** k * (1 - Fraction(low)) ** (trials - k)
                        for k in range(successes, trials + 1)) if trials < 100 else None
            lower = sum(math.comb(trials, k) * Fraction(high) ** k * (1 - Fraction(high)) ** (trials - k)
                        for k in range(successes + 1)) if trials < 100 else None
            if trials < 100:
                self.assertAlmostEqual(float(upper), 0.025, 8)
                self.assertAlmostEqual(float(lower), 0.025, 8)
            self.assertLess(low, successes / trials)
            self.assertGreater(high, successes / trials)


if __name__ == '__main__':
    unittest.main()
