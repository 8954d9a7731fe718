"""The report in a real browser, headless Chromium: no errors, charts drawn, tables sorted, planners hidden, on a desk and a phone."""
import html
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
const note = (name, value) => document.body.setAttribute('data-seen-' + name, value);
const whenDrawn = async element => {
    element.scrollIntoView();
    while (!element.querySelector('.trace')) await new Promise(done => setTimeout(done, 50));
    return element;
};
(async () => {
    const curve = await whenDrawn(document.getElementById('success-0'));
    note('curves', curve.querySelectorAll('.scatterlayer .trace').length);
    const lengths = await whenDrawn(document.getElementById('length-0'));
    note('axis', lengths.querySelector('.ytitle').textContent);
    const dots = await whenDrawn(document.getElementById('strip-0'));
    note('dots', dots.querySelectorAll('.points path').length);
    const table = document.querySelector('#problem-0 table');
    const names = () => Array.from(table.tBodies[0].rows).map(row => row.cells[0].textContent.trim()).join(',');
    const heading = table.querySelectorAll('thead button')[2];
    heading.click();
    note('fastest', names());
    heading.click();
    note('slowest', names());
    note('order', heading.parentElement.getAttribute('aria-sort'));
    const tip = document.getElementById('tip');
    table.querySelector('td[data-tip]').focus();
    note('tip', tip.hidden ? 'nothing' : tip.textContent);
    document.querySelector('.chip[data-p="0"]').click();
    note('hidden', Array.from(document.querySelectorAll('main [data-p]')).every(each => each.hidden === (each.dataset.p === '0')));
    await new Promise(done => setTimeout(done, 200));
    note('left', curve.querySelectorAll('.scatterlayer .trace').length);
    note('wide', document.documentElement.scrollWidth > innerWidth);
    document.title = 'visited';
})();
</script></body>'''


def dump(file, *options):
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [BROWSER, '--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
             f'--user-data-dir={profile}', '--enable-logging=stderr', '--virtual-time-budget=20000',
             *options, '--dump-dom', 'file://' + file],
            capture_output=True, text=True, timeout=240, check=False)


class BrowserTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        records = [made_results.record('a', 'slow', k, 'solved', 0.5 + 0.01 * k, 10.0) for k in range(8)]
        records += [made_results.record('a', 'quick', k, 'solved', 0.002 + 0.001 * k, 30.0) for k in range(8)]
        records += [made_results.record('a', 'never', k, 'none') for k in range(8)]
        made_results.write(folder, records)
        subprocess.run([sys.executable, '-B', MAKE_REPORT, folder], check=True, capture_output=True)
        with open(os.path.join(folder, 'report.html'), encoding='utf-8') as stream:
            page = stream.read()
        self.visit = os.path.join(folder, 'visit.html')
        with open(self.visit, 'w', encoding='utf-8') as stream:
            stream.write(page.replace('</body>', VISIT))

    def test_a_visit(self):
        for size in ('1280,900', '420,800'):
            done = dump(self.visit, f'--window-size={size}')
            self.assertEqual([line for line in done.stderr.splitlines() if 'CONSOLE' in line], [])
            seen = {name: html.unescape(value) for name, value in re.findall('data-seen-([a-z]+)="([^"]*)"', done.stdout)}
            self.assertEqual(seen, {
                'curves': '3', 'axis': 'length, m', 'dots': '18', 'fastest': 'quick,slow,never', 'slowest': 'never,slow,quick',
                'order': 'descending', 'tip': '0 of 8 runs; 95 % confidence interval 0 to 37 %', 'hidden': 'true', 'left': '2',
                'wide': 'false'}, done.stderr[-2000:])


if __name__ == '__main__':
    if BROWSER is None:
        print('Skipped: Chromium is not installed (Debian package chromium)')
        sys.exit(SKIPPED)
    unittest.main()
