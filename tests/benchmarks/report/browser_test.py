"""The report in a real browser, headless Chromium: no errors, tables there, hovering and clicking work."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import made_results
from made_results import MAKE_REPORT

SKIPPED = 77
BROWSER = next((found for found in map(shutil.which, ('chromium', 'chromium-browser', 'google-chrome')) if found), None)

# What a visitor does; what is seen then goes into attributes of the page, which --dump-dom prints.
VISIT = '''<script>
addEventListener('load', () => {
    const note = (name, value) => document.body.setAttribute('data-seen-' + name, value);
    const tip = document.getElementById('tip');
    const at = (element, x, y) => {
        const box = element.getBoundingClientRect();
        return {clientX: box.left + x * box.width, clientY: box.top + y * box.height, bubbles: true};
    };
    const chart = document.getElementById('success-0');
    chart.dispatchEvent(new MouseEvent('mousemove', at(chart, 0.97, 0.5)));
    note('curve', tip.hidden ? 'nothing' : tip.textContent);
    chart.dispatchEvent(new MouseEvent('mouseleave', {}));
    note('left', tip.hidden);
    const lengths = document.getElementById('cost-0');
    lengths.dispatchEvent(new MouseEvent('mousemove', at(lengths, 0.97, 0.5)));
    note('length', tip.textContent);
    lengths.dispatchEvent(new MouseEvent('mouseleave', {}));
    const profile = document.getElementById('profile-time-0');
    profile.dispatchEvent(new MouseEvent('mousemove', at(profile, 0.97, 0.5)));
    note('profile', tip.textContent);
    profile.dispatchEvent(new MouseEvent('mouseleave', {}));
    const dot = document.querySelector('#strip-0 circle.dot');
    dot.dispatchEvent(new MouseEvent('mouseover', at(dot, 0.5, 0.5)));
    note('dot', tip.hidden ? 'nothing' : tip.textContent);
    dot.dispatchEvent(new MouseEvent('mouseout', at(dot, 0.5, 0.5)));
    const table = document.querySelector('#problem-0 table.sortable');
    const names = () => Array.from(table.tBodies[0].rows).map(row => row.cells[0].textContent).join(',');
    table.tHead.rows[0].cells[2].click();
    note('fastest', names());
    table.tHead.rows[0].cells[2].click();
    note('slowest', names());
    document.querySelector('.chip[data-p="0"]').click();
    note('hidden', document.querySelectorAll('.off[data-p="0"]').length > 5 && !document.querySelector('.off[data-p="1"]'));
    note('wide', document.documentElement.scrollWidth - innerWidth);
});
</script></body>'''


def dump(file, *options):
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [BROWSER, '--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
             f'--user-data-dir={profile}', '--enable-logging=stderr', '--virtual-time-budget=5000',
             '--window-size=1280,900', *options, '--dump-dom', 'file://' + file],
            capture_output=True, text=True, timeout=120, check=False)


class BrowserTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        records = [made_results.record('a', 'slow', k, 'solved', 0.5 + 0.01 * k, 10.0) for k in range(8)]
        records += [made_results.record('a', 'quick', k, 'solved', 0.002 + 0.001 * k, 30.0) for k in range(8)]
        records += [made_results.record('a', 'never', k, 'none') for k in range(8)]
        made_results.write(folder, records)
        with open(os.path.join(folder, 'summary.csv'), 'w', encoding='utf-8') as stream:
            stream.write('problem,planner\na,slow\na,quick\na,never\n')
        subprocess.run([sys.executable, '-B', MAKE_REPORT, folder], check=True, capture_output=True)
        with open(os.path.join(folder, 'report.html'), encoding='utf-8') as stream:
            page = stream.read()
        visit = os.path.join(folder, 'visit.html')
        with open(visit, 'w', encoding='utf-8') as stream:
            stream.write(page.replace('</body>', VISIT))
        self.done = dump(visit)

    def seen(self, name):
        found = re.search(f'data-seen-{name}="([^"]*)"', self.done.stdout)
        self.assertIsNotNone(found, f'{name}: {self.done.stderr[-2000:]}')
        return found.group(1)

    def test_a_visit(self):
        errors = [line for line in self.done.stderr.splitlines() if 'CONSOLE' in line]
        self.assertEqual(errors, [])
        self.assertGreaterEqual(self.done.stdout.count('<table'), 3)
        curve = self.seen('curve')
        self.assertRegex(curve, r'^by [\d.]+ s')
        self.assertIn('slow100 %', curve)
        self.assertIn('quick100 %', curve)
        self.assertIn('never0 %', curve)
        self.assertEqual(self.seen('left'), 'true')
        self.assertRegex(self.seen('length'), r'slow10\.00 m10\.00 – 10\.00quick30\.00 m30\.00 – 30\.00never∞|'
                                              r'slow10\.00 m10\.00 – 10\.00quick30\.00 m30\.00 – 30\.00')
        self.assertRegex(self.seen('profile'), r'^at most [\d.]+ times the best(slow100 %|quick100 %|never0 %){3}$')
        self.assertRegex(self.seen('dot'), r'^slow: 5\d\d ms, 10\.00 m · run \d, seed 100\d$')
        self.assertEqual(self.seen('fastest'), 'quick,slow,never')
        self.assertEqual(self.seen('slowest'), 'never,slow,quick')
        self.assertEqual(self.seen('hidden'), 'true')
        self.assertLessEqual(int(self.seen('wide')), 0)


if __name__ == '__main__':
    if BROWSER is None:
        print('Skipped: Chromium is not installed (Debian package chromium)')
        sys.exit(SKIPPED)
    unittest.main()
