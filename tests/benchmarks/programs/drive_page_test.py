"""The page of a drive (parking_plan --html) in headless Chromium: it plays once, follows the car, and has two themes."""
import os
import sys
import time
import unittest

from programs import SOURCE, ProgramTest, bundled, main

sys.path.insert(0, os.path.join(SOURCE, 'tests', 'playground'))

from browser import PROGRAM, Browser  # noqa: E402

STATE = """(() => {
    const style = element => getComputedStyle(element), [x, y, width, height] = scene.getAttribute('viewBox').split(' ').map(Number);
    return {button: byId("play").textContent, clock: parseFloat(clock.textContent), metres: width / metres.a,
        page: style(document.body).backgroundColor, map: style(document.querySelector('#scene svg rect')).fill,
        ink: style(byId('play')).color, ground: style(byId('play')).backgroundColor, wide: document.documentElement.scrollWidth > innerWidth};
})()"""


class DrivePageTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.plan(bundled('parallel'), '--trajectory', '--track', '--html', 'drive.html')

    def visit(self, dark=False, still=False, width=1000):
        browser = Browser(width, 800, dark)
        self.addCleanup(browser.close)
        browser.call('Emulation.setEmulatedMedia', features=[
            {'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'},
            {'name': 'prefers-reduced-motion', 'value': 'reduce' if still else 'no-preference'}])
        browser.call('Page.navigate', url='file://' + os.path.join(self.folder, 'drive.html'))
        self.until(browser, 'typeof go === "function" && document.readyState === "complete"')
        return browser

    def value(self, browser, expression):
        return browser.call('Runtime.evaluate', expression=expression, returnByValue=True)['result'].get('value')

    def until(self, browser, condition):
        for _ in range(200):
            if self.value(browser, condition):
                return
            time.sleep(0.05)
        self.fail(condition)

    def test_it_plays_once(self):
        browser = self.visit()
        self.assertEqual(self.value(browser, STATE)['button'], 'Pause')
        self.until(browser, 'parseFloat(clock.textContent) > 0')
        self.value(browser, 'go(end - 0.1)')
        self.until(browser, 'byId("play").textContent === "Replay"')
        self.assertEqual(browser.console, [])

    def test_it_waits_for_who_prefers_reduced_motion(self):
        browser = self.visit(still=True)
        time.sleep(0.3)
        state = self.value(browser, STATE)
        self.assertEqual((state['button'], state['clock']), ('Play', 0.0))

    def test_the_followed_car_has_a_window_in_small_scenes(self):
        browser = self.visit(still=True)
        whole = self.value(browser, STATE)['metres']
        self.assertLess(whole, 40.0)
        self.value(browser, 'follow.click()')
        shown = self.value(browser, STATE)['metres']
        self.assertLess(shown, 0.8 * whole)
        self.assertGreaterEqual(shown, 7.999)

    def test_it_shows_what_is_seen_and_planned_on_the_way(self):
        self.plan(bundled('parallel'), '--track', '--perceive', '6', '--html', 'drive.html')
        browser = self.visit(still=True)
        self.until(browser, 'image.getAttribute("href").startsWith("data:image/png")')
        unseen = 'cells.reduce((sum, cell) => sum + (cell === 2), 0)'
        first = self.value(browser, unseen)
        plan = self.value(browser, "byId('plan').getAttribute('d')")
        self.assertTrue(plan.startswith('M'), plan)
        self.value(browser, 'go(end)')
        last = self.value(browser, unseen)
        self.assertLess(last, first)
        self.value(browser, 'go(begin)')
        self.assertEqual(self.value(browser, unseen), first)
        self.assertEqual(self.value(browser, "byId('plan').getAttribute('d')"), plan)
        self.assertEqual(browser.console, [])

    def test_it_has_a_dark_theme(self):
        colours = [self.value(self.visit(dark, still=True, width=390), STATE) for dark in (False, True)]
        for name in ('page', 'map', 'ink', 'ground'):
            self.assertNotEqual(colours[0][name], colours[1][name], name)
        self.assertEqual([each['wide'] for each in colours], [False, False])


if __name__ == '__main__':
    if PROGRAM is None:
        print('Skipped: Chromium is not installed (Debian package chromium)')
        sys.exit(77)
    main()
