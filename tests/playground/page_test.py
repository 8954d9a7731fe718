"""The playground in headless Chromium: what a visitor does, and what the page must show then.

usage: page_test.py ROOT PAGE [TEST...]

PARKING_PLAN in the environment is the program whose answers the page's must equal; without it the Python module is asked.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import browser

SKIPPED = 77
ROOT, PAGE = (sys.argv[1], sys.argv[2]) if len(sys.argv) > 2 else ('.', '')
SOLVABLE = ['perpendicular', 'parallel', 'angled45', 'narrow_parallel', 'tight_parallel', 'narrow_perpendicular',
            'dead_end_aisle', 'multi_storey', 'underground_garage', 'perceived_street']
STATUS = ['exact', 'approximate', 'infeasible', 'timeout', 'invalid_start', 'invalid_goal']
# How many pixels of the scene have nearly the colour that the page gives a name to.
COUNT = '''name => {
    const canvas = document.getElementById('view'), hex = playground.Draw.palette[name];
    const [r, g, b] = [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16));
    const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
        if (Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 24) ++count;
    return count;
}'''


def planned(file):
    """Status, length, cusps and expansions of the native core."""
    program = os.environ.get('PARKING_PLAN')
    if program and os.path.exists(program):
        done = subprocess.run([program, file, '--time-limit', '60', '--json', '-'], capture_output=True, text=True,
                              check=False, timeout=200)
        found = json.loads(done.stdout)
        return found['status'], found['length_m'], found['cusps'], found['search']['expanded']
    try:
        import improved_astar
    except ImportError as error:
        raise unittest.SkipTest('neither parking_plan nor the Python module is built') from error
    found = improved_astar.plan(improved_astar.Scenario.read(file), time_limit=60)
    return found.status, found.length, found.cusps, found.statistics['expanded']


def stale(page):
    """Was the page made of other sources than these?"""
    sys.path.insert(0, os.path.join(ROOT, 'playground'))
    import make_page
    with open(page, encoding='utf-8') as stream:
        found = re.search(r'<meta name="sources" content="([0-9a-f]*)">', stream.read())
    return not found or found.group(1) != make_page.sources(ROOT)


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.page.close()

    def setUp(self):
        self.page.console.clear()
        self.page.resize(1400, 900)
        self.page.open(PAGE, '?' + self.id())
        self.page.until('document.body.dataset.whole')
        self.page.value('document.getElementById("limit").value = 20')

    def tearDown(self):
        # Counting pixels makes the browser give this advice.
        self.assertEqual([each for each in self.page.console if 'willReadFrequently' not in each], [])

    def ask(self, expression):
        return self.page.value(expression)

    def settle(self, action):
        """Does something, and waits for the plan and the drive that follow from it."""
        if isinstance(action, str):
            self.ask(action)
        else:
            action()
        self.page.until('!document.body.dataset.busy')

    def summary(self):
        return self.ask('Array.from(playground.answer.plans[0].summary)')

    def count(self, colour):
        self.ask('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))')
        return self.ask(f'({COUNT})({json.dumps(colour)})')

    def at(self, x, y):
        """Where a point of the world is on the screen."""
        return self.ask(f'''(() => {{ const c = document.getElementById('view'), box = c.getBoundingClientRect(),
            at = playground.View.toScreen([{x}, {y}], c.clientWidth, c.clientHeight);
            return [box.left + at[0], box.top + at[1]]; }})()''')

    def test_it_is_one_file_and_fetches_nothing(self):
        with open(PAGE, encoding='utf-8') as stream:
            text = stream.read()
        for reference in ('src=', '@import', 'url(http', 'fetch("http'):
            self.assertNotIn(reference, text)
        self.assertEqual(self.ask('performance.getEntriesByType("resource").filter(e => !/^(blob|data):/.test(e.name)).length'), 0)

    def test_plans_as_the_native_core_does(self):
        self.assertEqual(self.ask('Array.from(document.getElementById("scene").options).map(each => each.value)'),
                         SOLVABLE + ['unreachable'])
        for name in SOLVABLE + ['unreachable']:
            with self.subTest(name):
                status, length, cusps, expanded = planned(os.path.join(ROOT, 'benchmarks', 'scenarios', name + '.yaml'))
                self.settle(f'playground.openBundled({json.dumps(name)})')
                summary = self.summary()
                self.assertEqual(STATUS[int(summary[0])], status)
                self.assertEqual(status, 'approximate' if name == 'unreachable' else 'exact')
                self.assertIn('Only near the goal' if name == 'unreachable' else 'Parked',
                              self.ask('document.getElementById("verdict").textContent'))
                self.assertAlmostEqual(summary[1], length, delta=1e-6)
                self.assertEqual(summary[2], cusps)
                self.assertEqual(summary[6], expanded)

    def quick(self, place):
        """Moves the pointer; milliseconds of processor time that the plan from where the car then is has taken."""
        begin = self.page.worker_time()
        before = self.ask('playground.quick ? playground.quick.question.id : 0')
        self.page.mouse('mouseMoved', *place)
        self.page.until(f'''playground.quick && playground.quick.question.id > {before} && (() => {{
            const start = playground.Scene.current.start, asked = playground.quick.question.numbers;
            const at = 9 + 2 * asked[8];  // behind the car and its outline
            return asked[at] === start[0] && asked[at + 1] === start[1]; }})()''', 20)
        end = self.page.worker_time()
        return self.ask('playground.quick.milliseconds') if begin is None or end is None else 1e3 * (end - begin)

    def test_plans_take_less_than_50_ms_while_dragging(self):
        slowest = (0.0, '')
        for name in SOLVABLE + ['unreachable']:
            with self.subTest(name):
                self.settle(f'playground.openBundled({json.dumps(name)})')
                x, y = self.ask('''(() => { const scene = playground.Scene.current, [x, y, yaw] = scene.start;
                    return [x + scene.vehicle.wheelbase / 2 * Math.cos(yaw), y + scene.vehicle.wheelbase / 2 * Math.sin(yaw)];
                    })()''')
                self.page.mouse('mousePressed', *self.at(x, y))
                for dx, dy in ((0.5, 0.2), (1.2, 0.4), (-0.8, -0.3), (-1.5, 0.3), (0.9, -0.4)):
                    place, least = self.at(x + dx, y + dy), 1e9
                    # The first plans in a page are slower, until the browser has compiled the core at its best. What
                    # has no solution is given up after 100 ms, until the pointer rests.
                    limit = 150.0 if name == 'unreachable' else 50.0
                    for _ in range(10):
                        least = min(least, self.quick(place))
                        if least < limit:
                            break
                    self.assertLess(least, limit)
                    if name != 'unreachable':
                        slowest = max(slowest, (least, name))
                    else:
                        self.assertIn(self.ask('document.getElementById("status").textContent'),
                                      ('Looking', 'Only near the goal'))
                self.page.mouse('mouseReleased', *place)
                self.page.until('!document.body.dataset.busy')
        print(f'slowest answer while dragging: {slowest[0]:.1f} ms ({slowest[1]})')

    def test_the_plan_follows_the_pointer(self):
        start = self.ask('playground.Scene.current.start')
        ahead = (start[0] + 1.0, start[1])
        for k in range(6):
            begin, end = self.at(ahead[0] + 0.3 * k, ahead[1]), self.at(ahead[0] + 0.3 * (k + 1), ahead[1])
            self.settle(lambda begin=begin, end=end: self.page.drag(begin, end))
            path = self.ask('Array.from(playground.answer.plans[0].path.slice(0, 2))')
            now = self.ask('playground.Scene.current.start')
            self.assertAlmostEqual(path[0], now[0], delta=1e-6)
        self.assertAlmostEqual(now[0], start[0] + 1.8, delta=0.05)
        # By its handle the car is turned; by keys it is moved; undone is undone.
        handle = self.ask('playground.Draw.handleOf(playground.Scene.current, playground.Tools.selected)')
        self.settle(lambda: self.page.drag(self.at(*handle), self.at(now[0] + 4, now[1] + 2)))
        turned = self.ask('playground.Scene.current.start[2]')
        self.assertGreater(turned, 0.2)
        self.settle(lambda: self.page.key('ArrowLeft'))
        self.assertAlmostEqual(self.ask('playground.Scene.current.start[0]'), now[0] - 0.1, delta=1e-6)
        self.settle('document.getElementById("undo").click()')
        self.assertAlmostEqual(self.ask('playground.Scene.current.start[0]'), now[0], delta=1e-6)

    def test_obstacles_and_slots_are_drawn(self):
        count = self.ask('playground.Scene.current.polygons.length')
        self.ask('document.querySelector("[data-tool=polygon]").click()')
        for corner in ((4, 2), (6, 2), (6, 3), (4, 3)):
            self.page.drag(self.at(*corner), self.at(*corner), 1)
        self.settle(lambda: self.page.key('Enter'))
        self.assertEqual(self.ask('playground.Scene.current.polygons.length'), count + 1)
        self.page.mouse('mouseMoved', *self.at(0, 8), buttons=0)  # away from its corners, which could be deleted, too
        self.settle(lambda: self.page.key('Delete'))
        self.assertEqual(self.ask('playground.Scene.current.polygons.length'), count)
        self.ask('document.querySelector("[data-tool=car]").click()')
        self.settle(lambda: self.page.drag(self.at(4, 3), self.at(4, 3), 1))
        self.assertEqual(self.ask('playground.Scene.current.polygons.length'), count + 1)
        self.ask('document.querySelector("[data-tool=slot]").click()')
        self.settle(lambda: self.page.drag(self.at(-3.5, 1.0), self.at(3.5, 4.0)))
        self.assertEqual(self.ask('playground.Scene.current.slot.kind'), 'parallel')

    def test_the_scene_shows_what_it_should(self):
        self.assertGreater(self.count('forward'), 150)
        self.assertGreater(self.count('reverse'), 150)
        self.assertGreater(self.count('obstacle'), 20000)
        self.assertEqual(self.count('tree-goal'), 0)
        self.settle('document.querySelector("[data-show=tree]").click()')
        grown = self.count('tree-goal')
        self.assertGreater(grown, 100)
        self.ask('playground.setMode("search")')
        begin = 'document.getElementById("time").value = 60; document.getElementById("time").dispatchEvent(new Event("input"))'
        self.ask(begin)
        self.assertLess(self.count('tree-goal'), grown)
        self.assertIn('expanded', self.ask('document.getElementById("clock").textContent'))
        self.assertLess(self.count('reverse'), 20, 'no path before it is found')

    def test_it_drives(self):
        self.assertEqual(self.count('drive'), 0)
        self.ask('document.getElementById("play").click()')
        self.page.until('playground.time > 5.0')
        self.assertGreater(self.count('drive'), 20)
        self.ask('document.getElementById("play").click()')
        now = self.ask('playground.time')
        self.assertAlmostEqual(self.ask('playground.time'), now, delta=1e-9)
        self.assertRegex(self.ask('document.getElementById("clock").textContent'), r'^\d+\.\d / 1\d\.\d s$')

    def test_parameters_and_comparison(self):
        names = self.ask('Array.from(document.querySelectorAll(".parameter")).map(each => each.dataset.name)')
        self.assertGreater(len(names), 25)
        self.settle('''(() => { const box = document.querySelector('[aria-label=shortening]'); box.click(); })()''')
        self.assertEqual(self.ask('playground.Panels.parameters'), {'shortening': 'false'})
        long = self.summary()[1]
        self.settle('document.getElementById("defaults").click()')
        self.assertLessEqual(self.summary()[1], long)
        self.assertEqual(self.ask('playground.Panels.parameters'), {})
        choose = '''(name => { const box = document.getElementById('compare'); box.value = name;
            box.dispatchEvent(new Event('change')); })'''
        self.settle(f'{choose}("paper_improved_astar")')
        self.assertEqual(self.ask('playground.answer.plans.length'), 2)
        self.assertEqual(self.ask('playground.answer.plans[1].summary[13]'), 1, 'the grid plans for a disc')
        self.assertFalse(self.ask('document.getElementById("sides").hidden'))
        self.settle(f'{choose}("")')
        self.ask('document.getElementById("ablation").click()')
        self.page.until('document.querySelectorAll("#table-wrap tbody tr").length === playground.Panels.sets.length')

    def test_files_and_links(self):
        yaml = self.ask('playground.Formats.toYaml(playground.Scene.current)')
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'saved.yaml')
            with open(file, 'w', encoding='utf-8') as stream:
                stream.write(yaml)
            wanted = planned(file)
        self.assertAlmostEqual(self.summary()[1], wanted[1], delta=1e-6)
        self.assertTrue(self.ask('playground.svg()').startswith('<svg xmlns='))
        table = self.ask('playground.pathTable()').splitlines()
        self.assertEqual(table[0], 'x,y,yaw,direction,curvature,driven,clearance')
        self.assertGreater(len(table), 100)
        case = '4000000000,4000000001,0.1,4000000012,4000000001,6.4,1,4,4000000005,4000000005,4000000006,4000000005,4000000006,4000000006,4000000005,4000000006'
        self.settle(f'playground.openFiles([new File([{json.dumps(case)}], "Case1.csv")])')
        self.assertEqual(self.ask('playground.Scene.current.name'), 'Case1')
        self.assertEqual(self.summary()[0], 0)
        self.settle('playground.openBundled("parallel")')
        self.settle(lambda: self.page.key('e') if self.ask('document.getElementById("view").focus()') is None else None)
        yaw, length = self.ask('playground.Scene.current.start[2]'), self.summary()[1]
        address = self.ask('playground.link()')
        self.page.open(PAGE, '?again' + address[address.index('#'):])
        self.page.until('document.body.dataset.whole')
        self.assertAlmostEqual(self.ask('playground.Scene.current.start[2]'), yaw, delta=1e-6)
        self.assertAlmostEqual(self.summary()[1], length, delta=0.02)

    def test_bad_input_is_said_in_plain_words(self):
        for name, content, words in (
                ('a.yaml', 'start: [0, 0]\ngoal: [1, 1, 0]\npolygons: []\n', 'start must be a list of 3 numbers'),
                ('a.yaml', 'start: [0, 0, 0]\npolygons: []\n', 'neither goal nor slot'),
                ('a.yaml', 'start: [0, 0, 0]\ngoal: [1, 1, 0]\npolygons:\n', 'polygons is nothing'),
                ('a.yaml', 'start: [0, 0, 0]\ngoal: [1, 1, 0]\npolygons: []\nunknown_is_occupied: true\n', 'only cells of a map'),
                ('a.yaml', 'start: [0, 0, 0]\nslot: {kind: parallel, pose: [1, 1, 0], length: 6, width: 2, angle: 1}\npolygons: []\n',
                 'only angled slots'),
                ('a.yaml', 'start: [0, 0, 0]\nstart: [0, 0, 0]\n', 'duplicated mapping key'),
                ('a.yaml', 'start: [0, 0, 0\n', 'within a flow collection'),
                ('a.yaml', 'start: [0, 0, 0]\ngoal: [1, 0, 0]\nmap: other.yaml\n', 'is missing'),
                ('a.csv', '1,2,3,4,5,6,1,4,0,0\n', 'the vertex counts require 8 coordinates'),
                ('a.csv', '1,2,x,4,5,6,0\n', "number 3 is 'x'"),
                ('a.bin', 'nothing of the kind', 'is not a scenario')):
            self.ask(f'playground.openFiles([new File([{json.dumps(content)}], {json.dumps(name)})])')
            said = self.ask('document.getElementById("notice").textContent')
            self.assertIn(words, said)
            self.assertNotIn('\n', said)
            self.assertNotIn(words, self.ask('document.getElementById("summary").textContent'), 'the plan is still there')
        for link, words in (('#zgarbage', 'damaged'), ('#j!', 'damaged'), ('#j' + 'e30', 'contains no scene'),
                            ('#jeyJzY2VuZSI6eyJzdGFydCI6WzFdfX0', 'damaged')):
            said = self.ask(f'playground.openLink({json.dumps(link[1:])}).then(() => "", error => error.message)')
            self.assertIn(words, said)
        # What only the core can tell, and the page goes on.
        crossed = 'start: [-8, 3, 0]\ngoal: [8, 3, 0]\npolygons:\n  - [[0, 0], [1, 1], [1, 0], [0, 1]]\n'
        self.ask(f'playground.openFiles([new File([{json.dumps(crossed)}], "b.yaml")])')
        self.page.until('document.getElementById("summary").textContent.includes("crosses itself")')
        self.settle('playground.openBundled("parallel")')
        self.assertEqual(self.summary()[0], 0)

    def test_nothing_overlaps_or_sticks_out(self):
        for width, height in ((1400, 900), (1100, 700), (820, 1180), (390, 844), (360, 640)):
            with self.subTest(f'{width} x {height}'):
                self.page.resize(width, height, mobile=width < 900)
                self.ask('dispatchEvent(new Event("resize"))')
                self.count('forward')  # two frames
                boxes = self.ask('''["header", "#stage", "#player", "#chart-1", "#chart-2", "#panel"].map(each => {
                    const box = document.querySelector(each).getBoundingClientRect();
                    return [each, box.left, box.top, box.right, box.bottom]; })''')
                for i, (one, *a) in enumerate(boxes):
                    for other, *b in boxes[:i]:
                        apart = a[0] >= b[2] - 0.5 or b[0] >= a[2] - 0.5 or a[1] >= b[3] - 0.5 or b[1] >= a[3] - 0.5
                        self.assertTrue(apart, f'{one} {a} lies over {other} {b}')
                out = self.ask('''Array.from(document.querySelectorAll("header nav > button, header select, header summary"))
                    .filter(each => { const box = each.getBoundingClientRect();
                        return box.width && (box.left < 0 || box.right > innerWidth || box.top < 0); })
                    .map(each => each.textContent)''')
                self.assertEqual(out, [], 'not to be reached without scrolling sideways')

    def test_both_planners_are_seen_side_by_side(self):
        self.settle('''(() => { const box = document.getElementById('compare'); box.value = 'paper_improved_astar';
            box.dispatchEvent(new Event('change')); })()''')
        self.count('forward')
        halves = self.ask('''(() => {
            const canvas = document.getElementById('view'), hex = playground.Draw.palette.forward;
            const [r, g, b] = [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16)), found = [0, 0];
            const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            for (let i = 0; i < data.length; i += 4)
                if (Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 24)
                    ++found[(i / 4) % canvas.width < canvas.width / 2 ? 0 : 1];
            return found; })()''')
        self.assertGreater(min(halves), 40)
        self.assertEqual(self.ask('document.querySelectorAll("#figures th").length'), 3)

    def test_it_fits_phones_darkness_and_paper(self):
        self.page.resize(390, 844, mobile=True)
        self.ask('dispatchEvent(new Event("resize")); document.getElementById("fit").click()')
        self.assertLessEqual(self.ask('document.documentElement.scrollWidth - innerWidth'), 0)
        self.assertGreater(self.count('forward'), 30)
        self.page.resize(1400, 900)
        light = self.ask('playground.Draw.palette.ground')
        self.ask('document.getElementById("theme").click()')
        self.assertNotEqual(self.ask('playground.Draw.palette.ground'), light)
        self.assertGreater(self.count('forward'), 100)
        self.ask('document.getElementById("theme").click()')
        self.page.call('Emulation.setEmulatedMedia', media='print')
        self.assertEqual(self.ask('getComputedStyle(document.getElementById("player")).display'), 'none')
        self.assertNotEqual(self.ask('getComputedStyle(document.getElementById("figures")).display'), 'none')
        self.page.call('Emulation.setEmulatedMedia', media='')


if __name__ == '__main__':
    if browser.PROGRAM is None:
        print('SKIPPED: Chromium is not installed (Debian package chromium)')
        sys.exit(SKIPPED)
    if not os.path.exists(PAGE):
        print(f'SKIPPED: {PAGE} is not built (scripts/playground builds it)')
        sys.exit(SKIPPED)
    if stale(PAGE):
        print(f'SKIPPED: {PAGE} was made of other sources than these (scripts/playground makes it anew)')
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
