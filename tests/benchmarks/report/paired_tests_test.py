"""Tests of benchmarks/report/standings: ranks and paired tests against published figures and brute force."""
import itertools
import math
import random
import sys
import unittest
from fractions import Fraction

from made_results import REPORT

sys.path.insert(0, REPORT)
from standings.paired_tests import holm, middle_ranks, sign_test, wilcoxon  # noqa: E402
from standings.ranks import critical_difference, friedman, groups, mean_ranks  # noqa: E402
from standings.scores import wilson  # noqa: E402

# Demsar, "Statistical Comparisons of Classifiers over Multiple Data Sets", 2006, table 6: four classifiers on 14 data sets,
# the more the better. Its ranks of the last but one row (4, 1, 2, 3) tell what its three decimals hide.
DEMSAR = [(0.763, 0.768, 0.771, 0.798), (0.599, 0.591, 0.590, 0.569), (0.954, 0.971, 0.968, 0.967),
          (0.628, 0.661, 0.654, 0.657), (0.882, 0.888, 0.886, 0.898), (0.936, 0.931, 0.916, 0.931),
          (0.661, 0.668, 0.609, 0.685), (0.583, 0.583, 0.563, 0.625), (0.775, 0.838, 0.866, 0.875),
          (1.000, 1.000, 1.000, 1.000), (0.940, 0.962, 0.965, 0.962), (0.619, 0.666, 0.614, 0.669),
          (0.972, 0.981, 0.975, 0.9749), (0.957, 0.978, 0.946, 0.970)]


def p_by_enumeration(differences):
    """Two-sided p of the signed-rank test: all choices of signs, counted one by one. Zeros are ranked and have no sign."""
    magnitudes = [abs(value) for value in differences]
    ranks = [Fraction(sum(other < own for other in magnitudes)) + Fraction(magnitudes.count(own) + 1, 2)
             for own in magnitudes]
    signed = [rank for rank, value in zip(ranks, differences) if value != 0]
    seen = min(sum(rank for rank, value in zip(ranks, differences) if value > 0),
               sum(rank for rank, value in zip(ranks, differences) if value < 0))
    extreme = sum(sum(itertools.compress(signed, signs)) <= seen
                  for signs in itertools.product((0, 1), repeat=len(signed)))
    return min(1.0, float(Fraction(2 * extreme, 2 ** len(signed))))


class WilcoxonTest(unittest.TestCase):
    def test_against_enumeration_with_ties_zeros_and_infinities(self):
        rng = random.Random(11)
        for _ in range(150):
            count = rng.randrange(1, 11)
            differences = [rng.choice((-math.inf, math.inf, 0.0, 0.5, -0.5, 1.0, -1.0, rng.gauss(0.3, 1.0)))
                           for _ in range(count)]
            self.assertAlmostEqual(wilcoxon(differences).p, p_by_enumeration(differences), 12, differences)

    def test_published(self):
        # Tables of critical values: n = 10, 5 % two-sided: 8 (p = 0.0488) is significant, 9 is not; n = 6: only 0.
        def of_rank_sum(count, least):
            values = [float(k) for k in range(1, count + 1)]
            for chosen in itertools.product((0, 1), repeat=count):
                if sum(itertools.compress(values, chosen)) == least:
                    return wilcoxon([-value if negative else value for value, negative in zip(values, chosen)])
            return None
        self.assertAlmostEqual(of_rank_sum(10, 8).p, 0.048828125, 12)
        self.assertGreater(of_rank_sum(10, 9).p, 0.05)
        self.assertAlmostEqual(of_rank_sum(6, 0).p, 0.03125, 12)
        self.assertGreater(of_rank_sum(6, 1).p, 0.05)
        self.assertAlmostEqual(of_rank_sum(5, 0).p, 0.0625, 12)

    def test_ranks_of_the_published_example(self):
        # Demsar, table 2: R+ = 93 and R- = 12 where the ranks of the two zeros (1.5 each) are split between both.
        found = wilcoxon([round(second - first, 3) for first, second, *_ in DEMSAR])
        self.assertEqual((found.zeros, found.count), (2, 12))
        self.assertEqual((found.plus + 1.5, found.minus + 1.5), (93.0, 12.0))

    def test_sides_are_alike_and_magnitude_does_not_matter(self):
        rng = random.Random(2)
        for count in (3, 20, 49, 50, 51, 120):
            differences = [rng.choice((0.0, rng.gauss(0.2, 1.0))) for _ in range(count)]
            found, turned = wilcoxon(differences), wilcoxon([-value for value in differences])
            self.assertEqual((found.plus, found.minus, found.p), (turned.minus, turned.plus, turned.p))
            stretched = wilcoxon([math.copysign(abs(value) ** 3 if abs(value) < 2 else math.inf, value)
                                  for value in differences if abs(value) < 2])
            self.assertEqual(stretched.p, wilcoxon([value for value in differences if abs(value) < 2]).p)

    def test_normal_where_counting_would_take_long(self):
        rng = random.Random(4)
        for _ in range(40):
            differences = [rng.choice((0.0, 1.0, -1.0, rng.gauss(0.2, 1.0))) for _ in range(50)]
            exact, normal = wilcoxon(differences), wilcoxon(differences, exact_up_to=0)
            self.assertTrue(exact.exact and not normal.exact)
            self.assertLess(abs(exact.p - normal.p), 0.02)
        self.assertFalse(wilcoxon([rng.gauss(0.0, 1.0) for _ in range(51)]).exact)
        self.assertTrue(wilcoxon([rng.gauss(0.0, 1.0) for _ in range(50)]).exact)

    def test_nothing_differs(self):
        self.assertEqual(wilcoxon([0.0] * 7).p, 1.0)

    def test_level_is_kept(self):
        rng = random.Random(6)
        rejected = sum(wilcoxon([rng.gauss(0.0, 1.0) for _ in range(15)]).p <= 0.05 for _ in range(2000))
        self.assertLess(rejected / 2000, 0.05 + 4 * math.sqrt(0.05 * 0.95 / 2000))
        self.assertGreater(rejected / 2000, 0.03)


class SignAndHolmTest(unittest.TestCase):
    def test_sign_test(self):
        self.assertEqual(sign_test(9, 1), 0.021484375)  # 2 (1 + 10) / 2^10
        self.assertEqual(sign_test(1, 9), 0.021484375)
        self.assertEqual(sign_test(6, 0), 0.03125)
        self.assertEqual([sign_test(0, 0), sign_test(3, 3), sign_test(4, 3)], [1.0, 1.0, 1.0])

    def test_holm_as_published(self):
        # By hand: sorted 0.005, 0.01, 0.03, 0.04 times 4, 3, 2, 1 are 0.02, 0.03, 0.06, 0.04, and none below the one before.
        for found, wanted in zip(holm([0.01, 0.04, 0.03, 0.005]), (0.03, 0.06, 0.06, 0.02)):
            self.assertAlmostEqual(found, wanted, 12)
        self.assertEqual(holm([]), [])
        self.assertEqual(holm([0.4, 0.9]), [0.8, 0.9])

    def test_holm_keeps_the_order_and_lies_between_none_and_bonferroni(self):
        rng = random.Random(8)
        for _ in range(300):
            values = [rng.choice((rng.random(), rng.random() ** 6, 0.02)) for _ in range(rng.randrange(1, 30))]
            found = holm(values)
            order = sorted(range(len(values)), key=lambda k: values[k])
            self.assertEqual([found[k] for k in order], sorted(found))
            for own, adjusted in zip(values, found):
                self.assertLessEqual(own, adjusted)
                self.assertLessEqual(adjusted, min(1.0, len(values) * own) + 1e-15)


class RanksTest(unittest.TestCase):
    def test_ties_share_the_mean_rank(self):
        self.assertEqual(middle_ranks([3.0, 1.0, math.inf, 1.0, math.inf]), [3.0, 1.5, 4.5, 1.5, 4.5])

    def test_published_example(self):
        rows = [[-value for value in row] for row in DEMSAR]
        ranks = mean_ranks(rows)
        for found, wanted in zip(ranks, (3.143, 2.000, 2.893, 1.964)):
            self.assertAlmostEqual(found, wanted, 3)
        # Demsar does not correct for ties: 9.28. The correction divides by 1 - sum(t^3 - t) / (N k (k^2 - 1)).
        plain = 12 * 14 / 20 * (sum(rank * rank for rank in ranks) - 4 * 25 / 4)
        self.assertAlmostEqual(plain, 9.28, 2)
        ties = sum(row.count(value) ** 2 - 1 for row in rows for value in row)
        self.assertAlmostEqual(friedman(rows).chi_square, plain / (1 - ties / (14 * 4 * 15)), 10)
        self.assertAlmostEqual(critical_difference(4, 14), 1.25, 2)

    def test_published_critical_values(self):
        # Demsar, table 5: q at 5 %.
        for planners, value in ((2, 1.960), (3, 2.343), (4, 2.569), (5, 2.728), (10, 3.164)):
            self.assertAlmostEqual(critical_difference(planners, 10) / math.sqrt(planners * (planners + 1) / 60.0), value,
                                   delta=0.0011)

    def test_probability_of_friedman(self):
        rng = random.Random(3)
        for _ in range(50):  # of three the F distribution has a closed form: (1 + 2 F / n)^(-n / 2)
            rows = [[rng.random() + 0.2 * k for k in range(3)] for _ in range(9)]
            found = friedman(rows)
            self.assertAlmostEqual(found.p, (1.0 + 2.0 * found.f / 16.0) ** -8.0, 9)
        self.assertEqual(friedman([[1.0, 2.0, 3.0]] * 5).p, 0.0)
        self.assertEqual(friedman([[1.0, 1.0, 1.0]] * 5).p, 1.0)

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
        self.assertEqual(groups(ranks, apart((0, 1), (0, 2), (0, 3))), [[1, 2, 3]])
        self.assertEqual(groups(ranks, apart(*itertools.combinations(range(4), 2))), [])
        self.assertEqual(groups([4.0, 1.0, 2.0, 3.0], apart((0, 1))), [[1, 2, 3], [2, 3, 0]])
        # Neither end differs from the other, but two within do: no bar over both of these.
        self.assertEqual(groups(ranks, apart((1, 2))), [[0, 1], [2, 3]])


class WilsonTest(unittest.TestCase):
    def test_published(self):
        # 5 of 10: 0.2366 to 0.7634; 0 of 10: 0 to 0.2775 (z^2 / (n + z^2)).
        low, high = wilson(0.5, 10)
        self.assertAlmostEqual(low, 0.2366, 4)
        self.assertAlmostEqual(high, 0.7634, 4)
        low, high = wilson(0.0, 10)
        self.assertEqual(low, 0.0)
        self.assertAlmostEqual(high, 3.841458820694124 / 13.841458820694124, 12)
        self.assertEqual(wilson(0.3, 0), (0.0, 1.0))

    def test_ends_solve_the_equation(self):
        for share, trials in ((0.1, 7), (0.7, 40), (0.99, 1000)):
            for end in wilson(share, trials):
                self.assertAlmostEqual(abs(share - end) / math.sqrt(end * (1 - end) / trials), 1.959963984540054, 9)


if __name__ == '__main__':
    unittest.main()
