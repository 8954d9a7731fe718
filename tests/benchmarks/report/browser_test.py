"""The report in a real browser, headless Chromium: no errors, charts drawn, tables sorted, planners hidden, on a desk and a phone."""
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import made_results
from made_results import MAKE_REPORT

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'playground'))

from browser import PROGRAM, Browser  # noqa: E402

SKIPPED = 77

# What a visitor does; what is seen then goes into attributes of the page.
VISIT = r'''<script>
const note = (name, value) => document.body.setAttribute('data-seen-' + name, value);
const whenDrawn = async element => {
    element.scrollIntoView();
    while (!element.querySelector('.trace')) await new Promise(done => setTimeout(done, 50));
    return element;
};
const settle = () => new Promise(done => setTimeout(done, 200));
// Contrast of a text with the first opaque ground below it (WCAG 2).
const channels = colour => colour.match(/[\d.]+/g).slice(0, 3).map(Number);
const luminance = colour => colour.map(each => each / 255).map(each => each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4)
    .reduce((sum, each, k) => sum + each * [0.2126, 0.7152, 0.0722][k], 0);
const contrast = element => {
    let below = element;
    while (/rgba\(.*, 0\)|transparent/.test(getComputedStyle(below).backgroundColor)) below = below.parentElement;
    let shown = 1;
    for (let each = element; each; each = each.parentElement) shown *= getComputedStyle(each).opacity;
    const ground = channels(getComputedStyle(below).backgroundColor);
    const ink = channels(getComputedStyle(element).color).map((each, k) => shown * each + (1 - shown) * ground[k]);
    const [light, dark] = [ink, ground].map(luminance).sort((a, b) => b - a);
    return (light + 0.05) / (dark + 0.05);
};
const weakest = () => Math.min(...Array.from(document.querySelectorAll('button, summary, a')).filter(each => each.textContent.trim()).map(contrast));
(async () => {
    note('dark', matchMedia('(prefers-color-scheme: dark)').matches);
    note('early', typeof Plotly);  // charts are loaded when they are near
    // A link to a folded problem unfolds it, and its heading is not below the planners.
    note('folded', !document.getElementById('problem-0').open);
    location.hash = '#problem-0';
    await settle();
    const chips = document.querySelector('.chips').getBoundingClientRect(), top = document.getElementById('problem-0').getBoundingClientRect();
    note('unfolded', document.getElementById('problem-0').open && (top.left >= chips.right || top.top >= chips.bottom - 1));
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
    const areas = Array.from(document.querySelectorAll('#problem-0 .scroll, #matrix .scroll'));
    note('scrolls', areas.every(each => each.classList.contains('scrolls') === (each.scrollWidth > each.clientWidth + 1)));
    note('contrast', weakest() >= 4.5);
    const chip = document.querySelector('.chip[data-p="0"]');
    for (const kind of ['pointerover', 'mouseover', 'pointerdown', 'pointerup']) chip.dispatchEvent(new PointerEvent(kind, {bubbles: true}));
    chip.click();
    note('hidden', Array.from(document.querySelectorAll('main [data-p]')).every(each => each.hidden === (each.dataset.p === '0')));
    await settle();
    const left = Array.from(curve.querySelectorAll('.scatterlayer .trace'));
    note('left', left.length);
    note('faded', left.some(each => Number(getComputedStyle(each).opacity) * getComputedStyle(each.querySelector('.js-line')).opacity < 1));
    note('pale', weakest() < 4.5);
    // A chart is saved as SVG.
    let saved;
    HTMLAnchorElement.prototype.click = function () { saved = this; };
    document.querySelector('.export[data-chart="success-0"]').click();
    while (!saved) await settle();
    const text = decodeURIComponent(saved.href);
    note('saved', [saved.download, text.startsWith('data:image/svg+xml,<svg'), (text.match(/class="trace scatter/g) || []).length].join());
    // A picture is enlarged, and the body moves along its path.
    document.querySelector('.gallery .drawing').click();
    const large = document.getElementById('large');
    note('large', large.open && large.querySelector('svg').getBoundingClientRect().width > 300);
    large.querySelector('.move').click();
    const places = new Set(), body = large.querySelector('.body');
    for (let k = 0; k < 50 && places.size < 3; ++k) {
        await settle();
        if (/^translate.*rotate/.test(body.getAttribute('transform'))) places.add(body.getAttribute('transform'));
    }
    note('moves', places.size);
    large.close();
    note('wide', document.documentElement.scrollWidth > innerWidth);
    document.title = 'visited';
})();
</script></body>'''


def value(browser, expression):
    return browser.call('Runtime.evaluate', expression=expression, returnByValue=True)['result'].get('value')


class BrowserTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        records = [made_results.record('a', 'slow', k, 'solved', 0.5 + 0.01 * k, 10.0) for k in range(8)]
        records += [made_results.record('a', 'quick', k, 'solved', 0.002 + 0.001 * k, 30.0) for k in range(8)]
        records += [made_results.record('a', 'never', k, 'none') for k in range(8)]
        made_results.write(folder, records)
        made_results.write_picture(folder, 'a', {'quick': 0, 'slow': 0})
        subprocess.run([sys.executable, '-B', MAKE_REPORT, folder], check=True, capture_output=True)
        with open(os.path.join(folder, 'report.html'), encoding='utf-8') as stream:
            page = stream.read()
        self.visit = os.path.join(folder, 'visit.html')
        with open(self.visit, 'w', encoding='utf-8') as stream:
            stream.write(page.replace('</body>', VISIT))

    def test_a_visit(self):
        for width, dark in ((1440, False), (1024, True), (420, False), (390, True)):
            with self.subTest(width=width, dark=dark):
                browser = Browser(width, 800, dark)
                self.addCleanup(browser.close)
                browser.call('Emulation.setFocusEmulationEnabled', enabled=True)
                browser.call('Page.navigate', url='file://' + self.visit)
                end = time.monotonic() + 120
                while value(browser, 'document.title') != 'visited' and time.monotonic() < end:
                    time.sleep(0.1)
                self.assertEqual(browser.console, [])
                seen = value(browser, 'Object.fromEntries(Array.from(document.body.attributes, each => [each.name.slice(10), each.value]))')
                self.assertEqual(seen, {
                    'dark': str(dark).lower(), 'early': 'undefined', 'folded': 'true', 'unfolded': 'true', 'curves': '3', 'axis': 'length, m', 'dots': '18',
                    'fastest': 'quick,slow,never', 'slowest': 'never,slow,quick', 'order': 'descending',
                    'tip': '0 of 8 runs; 95 % confidence interval 0 to 37 %', 'scrolls': 'true', 'contrast': 'true', 'hidden': 'true',
                    'left': '2', 'faded': 'false', 'pale': 'false', 'saved': 'success-0.svg,true,2', 'large': 'true',
                    'moves': '3', 'wide': 'false'})


if __name__ == '__main__':
    if PROGRAM is None:
        print('Skipped: Chromium is not installed (Debian package chromium)')
        sys.exit(SKIPPED)
    unittest.main()
