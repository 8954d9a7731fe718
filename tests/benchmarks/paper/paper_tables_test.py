"""The statistics and verdicts of docs/paper.md."""
import math
import os
import random
import re
import sys
import unittest

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', '..')
sys.path.insert(0, os.path.join(ROOT, 'benchmarks', 'paper'))

import paper_tables as paper  # noqa: E402


class PaperTablesTest(unittest.TestCase):
    def test_interval_holds_the_median_with_the_stated_error(self):
        self.assertIsNone(paper.median_interval([1.0] * 10))  # 2 / 2^10 is more than 0.1 %
        for count in (11, 17, 30):
            low, high = paper.median_interval(list(range(count)))
            self.assertEqual(low, count - 1 - high)
            miss = 2.0 * sum(math.comb(count, k) for k in range(low + 1)) / 2.0 ** count
            self.assertLessEqual(miss, paper.ERROR)
            self.assertGreater(miss + 2.0 * math.comb(count, low + 1) / 2.0 ** count, paper.ERROR)  # none is shorter
        rng = random.Random(1)
        missed = 0
        for _ in range(4000):
            low, high = paper.median_interval([rng.random() for _ in range(20)])
            missed += not low <= 0.5 <= high
        self.assertLess(missed, 20)

    def test_verdicts(self):
        around = {'less': [0.4 + 0.01 * k for k in range(20)], 'more': [2.0 + 0.1 * k for k in range(20)],
                  'same': [0.99 + 0.001 * k for k in range(20)], 'unclear': [0.2 + 0.2 * k for k in range(20)],
                  'slightly less': [0.96 + 0.001 * k for k in range(20)]}
        for measured, claimed, verdict in (
                ('less', 0.4, 'agrees'), ('less', 0.97, 'differs'), ('less', 3.0, 'opposite'), ('more', 1.2, 'agrees'),
                ('more', 0.5, 'opposite'), ('same', 1.04, 'agrees'), ('same', 2.0, 'differs'), ('unclear', 0.5, 'unclear'),
                ('slightly less', 0.9, 'differs')):
            self.assertEqual(paper.Ratio(around[measured]).verdict(claimed), verdict, (measured, claimed))
        self.assertEqual(paper.Ratio([]).verdict(0.5), 'unclear')
        self.assertEqual(paper.claim_verdict(paper.Ratio(around['less']), 0.05), 'agrees, but by less')
        self.assertEqual(paper.claim_verdict(paper.Ratio(around['less']), 0.9), 'agrees')

    def test_ratios_are_of_maps_that_both_solve(self):
        results = paper.Results('')
        results.runs['perpendicular', 'printed'] = {
            'basic_astar': {'a': {'status': 'exact', 'length_m': 3.0}, 'b': {'status': 'exact', 'length_m': 5.0}},
            'paper_improved_astar': {'a': {'status': 'exact', 'length_m': 2.0}, 'b': {'status': 'timeout'}}}
        self.assertEqual(results.ratio('length', 'basic_astar', 'paper_improved_astar').values, [1.5])

    def test_links_lead_to_files(self):
        for _, file, *_ in paper.CLAIMS:
            self.assertTrue(os.path.exists(os.path.join(ROOT, file)), file)

    def test_page_has_every_table(self):
        with open(os.path.join(ROOT, 'docs', 'paper.md'), encoding='utf-8') as stream:
            page = stream.read()
        for marker, rows in (('claims', 26), ('ratios', 11), ('drives', 26), ('choices', 4)):
            text = re.search(f'<!-- {marker}:begin -->\n(.*?)<!-- {marker}:end -->', page, re.DOTALL).group(1)
            found = [line for line in text.split('\n') if line.startswith('| ') and not line.startswith(('|  |', '| ---'))]
            headers = marker in ('claims', 'choices')
            self.assertEqual(len(found) - headers, rows, marker)


if __name__ == '__main__':
    unittest.main()
