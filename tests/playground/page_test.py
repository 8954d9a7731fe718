"""The playground in headless Chromium: what a visitor does, and what the page must show then.

usage: page_test.py ROOT PAGE [TEST...]

PARKING_PLAN in the environment is the program whose answers the page's must equal; without it the Python module is asked.
"""
import json
import os
import re
import statistics
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
        cls.page = browser.Browser(still=True)

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
        self.assertEqual(self.ask('Array.from(document.getElementById("scene").options).map(each => each.value).filter(Boolean)'),
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
        slowest, all_times = (0.0, ''), []
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
                        if name != 'multi_storey':
                            all_times.append(least)
                    else:
                        self.assertIn(self.ask('document.getElementById("status").textContent'),
                                      ('Looking', 'Only near the goal'))
                self.page.mouse('mouseReleased', *place)
                self.page.until('!document.body.dataset.busy')
        print(f'answers while dragging: median {statistics.median(all_times):.1f} ms without multi_storey, '
              f'slowest {slowest[0]:.1f} ms ({slowest[1]})')

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
        self.page.until('document.querySelectorAll("#table-wrap tbody tr").length === playground.Panels.compared.length')
        rows = {row[0]: row[1:] for row in self.ask("""Array.from(document.querySelectorAll("#table-wrap tbody tr"),
            row => Array.from(row.cells, cell => cell.textContent))""")}
        for name in ('default', 'hybrid_astar', 'textbook_hybrid_astar'):
            self.assertEqual(rows[name][2], 'yes', name)
        for name in ('basic_astar', 'paper_improved_astar'):
            self.assertEqual(rows[name][2], 'no', 'a car does not turn on the spot')
            self.assertLess(float(rows[name][0]), float(rows['default'][0]), 'shorter than any car can drive')
        self.assertRegex(self.ask('document.querySelector("#table-wrap p").textContent'), r'^No car can drive \d of these')
        self.assertNotIn('improved_astar', rows)

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
        # What was changed since outlives a reload, but not another visit by the link.
        self.settle(lambda: (self.ask('document.getElementById("view").focus()'), self.page.key('e')))
        changed = self.ask('playground.Scene.current.start[2]')
        self.assertNotAlmostEqual(changed, yaw, delta=0.05)
        self.reload()
        self.assertAlmostEqual(self.ask('playground.Scene.current.start[2]'), changed, delta=1e-6)
        self.page.call('Page.navigate', url='about:blank')
        self.page.open(PAGE, '?again' + address[address.index('#'):])
        self.page.until('window.playground && document.body.dataset.whole')
        self.assertAlmostEqual(self.ask('playground.Scene.current.start[2]'), yaw, delta=1e-6)

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
        for width, height in ((1400, 900), (1200, 800), (1100, 700), (1024, 768), (960, 700), (820, 1180), (844, 390), (390, 844), (360, 640)):
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
                self.ask('playground.Panels.notice("A notice of some length, to see that it hides nothing else.")')
                texts = self.ask('''["#verdict", "#hint", "#legend", "#notice"].map(each => {
                    const box = document.querySelector(each).getBoundingClientRect();
                    return [each, box.left, box.top, box.right, box.bottom]; }).filter(each => each[3] > each[1])''')
                self.assertEqual(len(texts), 4)
                for i, (one, *a) in enumerate(texts):
                    for other, *b in texts[:i]:
                        apart = a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3]
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

    def test_every_button_can_be_read_in_every_state(self):
        contrasts = """() => {
            const light = text => { const [r, g, b] = text.match(/[\\d.]+/g).map(Number).map(each => each / 255)
                .map(each => each <= 0.03928 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4);
                return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
            const ground = element => { for (let at = element; at; at = at.parentElement) {
                const colour = getComputedStyle(at).backgroundColor;
                if (!/^rgba\\(.*, 0\\)$|transparent/.test(colour)) return colour; } };
            return Array.from(document.querySelectorAll('button, summary'), each => {
                const [a, b] = [light(getComputedStyle(each).color), light(ground(each))].sort((x, y) => y - x);
                return [each.id || each.textContent, (a + 0.05) / (b + 0.05), Number(getComputedStyle(each).opacity)]; });
        }"""
        for theme in ('light', 'dark'):
            for states in ([], ['hover'], ['hover', 'active'], ['focus', 'focus-visible'], ['hover', 'focus', 'active', 'focus-visible']):
                for change in ('each => {}', 'each => each.hasAttribute("aria-pressed") && each.setAttribute("aria-pressed", "true")',
                               'each => each.hasAttribute("aria-selected") && each.setAttribute("aria-selected", "true")',
                               'each => { each.disabled = false; }', 'each => { each.disabled = true; }'):
                    self.ask(f'Array.from(document.querySelectorAll("button")).forEach({change})')
                    self.page.force('button, summary', states)
                    for name, contrast, opacity in self.ask(f'({contrasts})()'):
                        self.assertGreaterEqual(contrast, 4.5, f'{name} {theme} {states} {change}')
                        self.assertEqual(opacity, 1, name)
            self.page.force('button, summary', [])
            self.ask('Array.from(document.querySelectorAll("button")).forEach(each => { each.disabled = false; })')
            self.ask('document.getElementById("theme").click()')

    def test_a_finger_moves_an_obstacle_by_as_much(self):
        place = """(() => { const box = document.getElementById('view').getBoundingClientRect(); return [box.x, box.y, box.width, box.height]; })()"""
        for size in ((390, 844), (360, 640), (844, 390), (900, 1200), (1024, 768), (1190, 800)):
            with self.subTest(size):
                self.page.resize(*size, mobile=True)
                self.page.open(PAGE, f'?{self.id()}{size}')
                self.page.until('document.body.dataset.whole')
                index = 9
                x, y = self.ask(f'playground.Scene.middle(playground.Scene.current.polygons[{index}])')
                begin, before, scale = self.at(x, y), self.ask(place), self.ask('playground.View.view.scale')
                self.page.touch('touchStart', begin)
                self.count('forward')
                self.assertEqual(self.ask(place), before, 'nothing moves when the obstacle is grabbed')
                self.assertFalse(self.ask('document.getElementById("delete").disabled'), 'it is selected')
                for k in range(1, 9):
                    self.page.touch('touchMove', (begin[0] + 5 * k, begin[1] - 4 * k))
                    self.assertEqual(self.ask(place), before)
                self.page.touch('touchEnd')
                u, v = self.ask(f'playground.Scene.middle(playground.Scene.current.polygons[{index}])')
                self.assertAlmostEqual((u - x) * scale, 40, delta=1.0)
                self.assertAlmostEqual((v - y) * scale, 32, delta=1.0)

    def test_a_click_without_movement_changes_nothing(self):
        car = self.ask('playground.Scene.current.start')
        number = self.ask('document.body.dataset.answers')
        for at in ((car[0] + 1.0, car[1]), self.ask('playground.Scene.middle(playground.Scene.current.polygons[2])')):
            self.page.drag(self.at(*at), self.at(*at), 2)
        self.page.drag(self.at(0, 0), [each + 1.0 for each in self.at(0, 0)], 1)
        self.ask('document.querySelector("[data-tool=slot]").click()')
        self.page.drag(self.at(-3, 1), self.at(-3, 1), 1)
        self.assertFalse(self.ask('playground.Scene.canUndo()'))
        self.assertTrue(self.ask('document.getElementById("undo").disabled'))
        self.assertEqual(self.ask('playground.Scene.current.start'), car)
        self.assertEqual(self.ask('document.body.dataset.answers'), number, 'and is not planned for')
        self.ask('playground.openFiles([new File(["nothing of the kind"], "a.bin")])')
        self.assertFalse(self.ask('playground.Scene.canUndo()'), 'nor does a broken file')
        self.settle(lambda: self.page.drag(self.at(car[0] + 1, car[1]), self.at(car[0] + 2, car[1])))
        self.assertTrue(self.ask('playground.Scene.canUndo()'))

    def test_a_drawn_slot_is_in_the_panel(self):
        self.ask('playground.Scene.current.slot && document.querySelector("[data-tool=slot]").click()')
        self.page.mouse('mousePressed', *self.at(-3.5, 1.0))
        for x, y in ((0.0, 2.0), (3.5, 4.0)):
            self.page.mouse('mouseMoved', *self.at(x, y))
        shown = 'Array.from(document.querySelectorAll("#slot-fields select, #slot-fields input"), each => each.value)'
        wanted = 'playground.Scene.current.slot'
        for _ in range(2):  # while it is drawn, and then
            kind, _, length, width, _ = self.ask(shown)
            self.assertEqual(kind, 'parallel')
            self.assertAlmostEqual(float(length), self.ask(wanted + '.length'), delta=1e-3)
            self.assertAlmostEqual(float(width), self.ask(wanted + '.width'), delta=1e-3)
            self.settle(lambda: self.page.mouse('mouseReleased', *self.at(3.5, 4.0)))
        self.assertAlmostEqual(float(length), 7.0, delta=0.1)

    def test_what_touches_is_red_and_the_charts_are_empty(self):
        inked = """id => { const canvas = document.getElementById(id), data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            const [r, g, b] = [1, 3, 5].map(i => parseInt(playground.Draw.palette.accent.slice(i, i + 2), 16)); let count = 0;
            for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200 && Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 24) ++count;
            return count; }"""
        self.assertLess(self.count('bad-fill'), 100)
        self.assertGreater(self.ask(f'({inked})("chart-1")'), 100)
        self.settle("""(() => { const scene = playground.Scene.current, [x, y] = playground.Scene.middle(scene.polygons[9]);
            playground.Scene.remember(); scene.start = [x, y, scene.start[2]]; playground.Scene.changed(); })()""")
        self.page.until('document.getElementById("status").textContent === "The start is blocked"')
        self.assertGreater(self.count('bad-fill'), 2000)
        self.assertEqual(self.ask("playground.svg().split(`fill=\"${playground.Draw.palette['bad-fill']}\"`).length - 1"), 2, 'the car and what it touches')
        self.assertGreater(self.count('bad'), 100)
        self.assertEqual(self.ask(f'({inked})("chart-1")'), 0, 'no path, no curve')
        self.assertIn('Start touches: move it', self.ask('playground.svg()'))
        self.settle('document.getElementById("undo").click()')
        self.assertLess(self.count('bad-fill'), 100)
        self.assertGreater(self.ask(f'({inked})("chart-1")'), 100)
        # A goal in an obstacle, too.
        self.settle("""(() => { const scene = playground.Scene.current, [x, y] = playground.Scene.middle(scene.polygons[9]);
            playground.Scene.remember(); scene.slot = null; scene.goals = [[x, y, 0]]; playground.Scene.changed(); })()""")
        self.assertGreater(self.count('bad-fill'), 2000)
        self.assertIn('Goal touches: move it', self.ask('playground.svg()'))

    def test_a_map_alone_has_a_free_start_and_goal(self):
        # A corridor round a block, cells of 0.2 m, with a small yard apart.
        self.settle("""(() => { const columns = 150, rows = 120, cells = new Uint8Array(columns * rows).fill(1);
            const open = (a, b, c, d) => { for (let r = b; r < d; ++r) for (let q = a; q < c; ++q) cells[r * columns + q] = 0; };
            open(5, 5, 100, 30); open(5, 5, 30, 115); open(5, 90, 100, 115); open(112, 96, 148, 118);
            const pixels = new Uint8Array(columns * rows);
            for (let r = 0; r < rows; ++r) for (let q = 0; q < columns; ++q) pixels[(rows - 1 - r) * columns + q] = cells[r * columns + q] ? 0 : 254;
            return playground.openFiles([new File(['image: m.pgm\\nresolution: 0.2\\norigin: [3, 4, 0.3]\\nnegate: 0\\noccupied_thresh: 0.65\\nfree_thresh: 0.196\\n'], 'm.yaml'),
                new File([`P5\\n${columns} ${rows}\\n255\\n`, pixels], 'm.pgm')]); })()""")
        self.assertEqual(self.ask('document.getElementById("notice").hidden'), True, self.ask('document.getElementById("notice").textContent'))
        self.assertEqual(self.ask('playground.Scene.current.name'), 'm')
        self.assertTrue(self.ask('playground.answer.startIsFree'))
        self.assertEqual(self.ask('playground.answer.freeGoals'), [True])
        self.assertEqual(self.summary()[0], 0, 'and the car gets there')
        a, b = self.ask('playground.Scene.current.start'), self.ask('playground.Scene.current.goals[0]')
        self.assertGreater(abs(a[0] - b[0]) + abs(a[1] - b[1]), 10.0)
        # It outlives a reload.
        self.reload()
        for have, want in zip(self.ask('playground.Scene.current.start'), a):
            self.assertAlmostEqual(have, want, delta=1e-6)
        self.assertEqual(self.summary()[0], 0)
        self.assertEqual(self.ask('playground.Scene.current.map.name'), 'm')

    def reload(self):
        self.ask('void (window.left = true)')
        self.page.call('Page.reload')
        self.page.until('!window.left && window.playground && document.body.dataset.whole && !document.body.dataset.busy')

    def test_the_scene_outlives_a_reload(self):
        car = self.ask('playground.Scene.current.start')
        self.settle(lambda: self.page.drag(self.at(car[0] + 1, car[1]), self.at(car[0] + 2, car[1] + 0.5)))
        self.settle("""(() => { const box = document.querySelector('[aria-label=shortening]'); box.click(); })()""")
        moved, summary = self.ask('playground.Scene.current.start'), self.summary()
        self.reload()
        for have, want in zip(self.ask('playground.Scene.current.start'), moved):
            self.assertAlmostEqual(have, want, delta=1e-6)
        self.assertEqual(self.ask('playground.Panels.parameters'), {'shortening': 'false'})
        self.assertAlmostEqual(self.summary()[1], summary[1], delta=1e-3)
        self.assertIn('edited', self.ask('document.getElementById("scene").selectedOptions[0].textContent'))
        # A bundled scene stays one, and a broken one is replaced.
        self.settle('playground.openBundled("parallel")')
        self.reload()
        self.assertEqual(self.ask('document.getElementById("scene").value'), 'parallel')
        for broken in ('{', '{}', 'null', '{"hash":"","scenario":"start: [1]","files":[]}', '{"hash":"","bundled":"none"}'):
            # Stored when the page is left, after it has stored its own.
            self.ask(f"addEventListener('pagehide', () => sessionStorage.setItem(Object.keys(sessionStorage).find(each => each.includes({json.dumps(self.id())})), {json.dumps(broken)}))")
            self.reload()
            self.assertEqual(self.ask('document.getElementById("scene").value'), 'perpendicular', broken)
            self.assertIn('damaged', self.ask('document.getElementById("notice").textContent'), broken)

    def test_the_first_drive_plays_once(self):
        self.ask('new Promise(done => setTimeout(done, 300))')
        self.assertIsNone(self.ask('playground.time'), 'not for those who prefer less motion')
        self.assertFalse(self.ask('playground.playing'))
        lively = browser.Browser()
        try:
            lively.open(PAGE, '?lively')
            lively.until('document.body.dataset.whole')
            lively.until('playground.time > 0.5')
            lively.until('playground.time === null && !playground.playing', 30)
            lively.value('new Promise(done => setTimeout(done, 700))')
            self.assertIsNone(lively.value('playground.time'), 'once')
            lively.open(PAGE, '?lively again')
            lively.until('window.playground && playground.time > 0.2')
            x, y = lively.value("""(() => { const box = document.getElementById('view').getBoundingClientRect(); return [box.left + 5, box.bottom - 60]; })()""")
            lively.drag((x, y), (x, y), 1)
            self.assertIsNone(lively.value('playground.time'), 'a click ends it')
            self.assertEqual([each for each in lively.console if 'willReadFrequently' not in each], [])
        finally:
            lively.close()

    def test_it_says_what_it_is_and_what_to_do(self):
        about = self.ask('document.getElementById("about").textContent')
        self.assertIn('planner', about)
        self.assertEqual(about.count('.'), 2)
        self.assertEqual(self.ask('document.querySelector("#about a").href'), 'https://arxiv.org/abs/2406.15429')
        hint = 'document.getElementById("hint").hidden ? "" : document.getElementById("hint").textContent'
        self.assertIn('Drag the car', self.ask(hint))
        car = self.ask('playground.Scene.current.start')
        cursor = 'document.getElementById("view").style.cursor'
        self.page.mouse('mouseMoved', *self.at(car[0] + 1, car[1]), buttons=0)
        self.assertEqual(self.ask(cursor), 'grab')
        self.page.mouse('mousePressed', *self.at(car[0] + 1, car[1]))
        self.assertEqual(self.ask(cursor), 'grabbing')
        self.page.mouse('mouseMoved', *self.at(car[0] + 1.5, car[1]))
        self.settle(lambda: self.page.mouse('mouseReleased', *self.at(car[0] + 1.5, car[1])))
        self.page.mouse('mouseMoved', *self.at(car[0], car[1] + 4.0), buttons=0)
        self.assertEqual(self.ask(cursor), 'default', 'nothing to grab there')
        self.count('forward')
        self.assertIn('round handle', self.ask(hint))
        self.settle(lambda: (self.ask('document.getElementById("view").focus()'), self.page.key('e')))
        self.count('forward')
        self.assertIn('obstacle', self.ask(hint))
        x, y = self.ask('playground.Scene.middle(playground.Scene.current.polygons[2])')
        self.settle(lambda: self.page.drag(self.at(x, y), self.at(x + 0.5, y)))
        self.count('forward')
        self.assertIn('Search', self.ask(hint))
        self.settle('document.getElementById("tab-search").click()')
        self.count('forward')
        self.assertEqual(self.ask(hint), '', 'all is done')
        self.ask('document.querySelector("[data-tool=polygon]").click()')
        self.count('forward')
        self.assertIn('corner by corner', self.ask(hint))

    def test_why_the_trees_grow(self):
        self.assertTrue(self.ask('document.getElementById("why").hidden'))
        self.settle('document.getElementById("tab-search").click()')
        self.assertFalse(self.ask('document.getElementById("why").hidden'))
        self.ask('document.getElementById("time").value = 300; document.getElementById("time").dispatchEvent(new Event("input"))')
        self.count('forward')
        text = self.ask('document.getElementById("why-step").textContent')
        self.assertRegex(text, r"Expansion \d+ of \d+: the (start|goal)'s tree grows at the ringed pose, \d+\.\d m so far \+ 2\.5 × \d+\.\d m to go")
        self.assertIn('Point at a dot', text)
        goal = self.ask('Array.from(playground.answer.plans[0].goalTree.slice(0, 2))')
        self.page.mouse('mouseMoved', *self.at(*goal), buttons=0)
        self.count('forward')
        self.assertIn("Under the pointer, in the goal's tree: 0.0 m so far", self.ask('document.getElementById("why-step").textContent'))

    def test_keys_place_a_car(self):
        count = self.ask('playground.Scene.current.polygons.length')
        self.page.key('c')
        middle = 'playground.Scene.middle(playground.Tools.ghost)'
        x, y = self.ask(middle)
        self.assertAlmostEqual(x, self.ask('playground.View.view.x'), delta=0.01)
        ghosts = self.count('obstacle')
        for _ in range(3):
            self.page.key('ArrowUp')
        self.page.key('ArrowLeft')
        corner = self.ask('playground.Tools.ghost[0]')
        for _ in range(4):
            self.page.key('q')
        u, v = self.ask(middle)
        self.assertAlmostEqual(u, x - 0.5, delta=1e-9)
        self.assertAlmostEqual(v, y + 1.5, delta=1e-9)
        self.assertNotEqual(self.ask('playground.Tools.ghost[0]'), corner, 'it is turned')
        self.assertEqual(self.ask('playground.Scene.current.polygons.length'), count, 'still a ghost')
        self.assertLess(ghosts, 1e6)
        placed = self.ask('playground.Tools.ghost')
        self.settle(lambda: self.page.key('Enter'))
        self.assertEqual(self.ask(f'playground.Scene.current.polygons[{count}]'), placed)
        self.assertIsNone(self.ask('playground.Tools.ghost'))
        self.page.key('c')
        self.page.key('Escape')
        self.assertIsNone(self.ask('playground.Tools.ghost'))
        self.assertEqual(self.ask('playground.Scene.current.polygons.length'), count + 1)
        # By pointer the ghost is where it will be.
        self.page.key('c')
        self.page.mouse('mouseMoved', *self.at(2.0, 3.0), buttons=0)
        u, v = self.ask(middle)
        self.assertAlmostEqual(u, 2.0, delta=0.05)
        self.assertAlmostEqual(v, 3.0, delta=0.05)

    def test_the_textbook_plans_beside_ours(self):
        self.settle("""(() => { const box = document.getElementById('compare'); box.value = 'textbook_hybrid_astar';
            box.dispatchEvent(new Event('change')); })()""")
        first, second = (self.ask(f'Array.from(playground.answer.plans[{k}].summary)') for k in (0, 1))
        self.assertEqual((first[0], second[0]), (0, 0))
        self.assertEqual(second[13], 0, 'for the car, not for a disc')
        self.assertEqual(second[16], 0, 'a car can drive it')
        self.assertGreater(second[6], first[6], 'it expands more')
        self.assertIn('textbook', self.ask('document.getElementById("other-name").textContent'))
        self.settle('document.querySelector("[data-show=tree]").click()')
        self.assertGreater(self.ask('playground.answer.plans[1].startTree.length'), 9 * second[6] / 2)
        self.assertEqual(self.ask('playground.answer.plans[1].goalTree.length'), 0)
        self.settle(lambda: (self.ask('document.getElementById("view").focus()'), self.page.key('ArrowRight')))
        self.assertEqual(self.ask('playground.answer.plans.length'), 2)

    def test_the_distance_field_is_a_layer(self):
        distance = """(x, y) => { const f = playground.answer.field, c = Math.round((x - f[3]) / f[2]), r = Math.round((y - f[4]) / f[2]); return f[5 + r * f[0] + c]; }"""
        ground = self.count('ground')
        self.settle(lambda: self.page.key('g'))
        self.assertLess(self.count('ground'), 0.2 * ground)
        self.assertIn('distance', self.ask('document.getElementById("legend").textContent'))
        x, y = self.ask('playground.Scene.middle(playground.Scene.current.polygons[9])')
        self.assertEqual(self.ask(f'({distance})({x}, {y})'), 0)
        before = self.ask(f'({distance})({x}, {y + 4})')
        self.settle(f"""(() => {{ playground.Scene.move({{ kind: 'polygon', index: 9 }}, 0, 4); playground.Scene.changed(); }})()""")
        self.assertLess(self.ask(f'({distance})({x}, {y + 4})'), before, 'it follows the obstacles')
        self.settle(lambda: self.page.key('g'))
        self.assertGreater(self.count('ground'), 0.8 * ground)

    def test_the_car_stands_where_the_pointer_is_on_a_chart(self):
        box = """(id => { const box = document.getElementById(id).getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })"""
        self.assertEqual(self.count('drive'), 0)
        for chart in ('chart-1', 'chart-2'):
            left, top, width, height = self.ask(f'{box}("{chart}")')
            self.page.mouse('mouseMoved', left + width / 2, top + height / 2, buttons=0)
            self.assertGreater(self.count('drive'), 20, chart)
            self.assertEqual(self.ask('playground.hovered.kind'), 'path')
            self.assertAlmostEqual(self.ask('playground.hovered.at'), (width / 2 - 46) / (width - 56) * self.summary()[1], delta=0.1)
            self.page.mouse('mouseMoved', left + width / 2, top - 200, buttons=0)
            self.assertEqual(self.count('drive'), 0, 'and goes with it')
        self.ask('document.getElementById("time").value = 500; document.getElementById("time").dispatchEvent(new Event("input"))')
        self.count('forward')
        self.page.mouse('mouseMoved', left + width / 2, top + height / 2, buttons=0)
        self.count('forward')
        self.assertEqual(self.ask('playground.hovered.kind'), 'drive')

    def test_a_phone_on_its_side_shows_the_scene(self):
        self.page.resize(844, 390, mobile=True)
        self.ask('dispatchEvent(new Event("resize")); document.getElementById("fit").click()')
        self.assertGreater(self.count('forward'), 30)
        left, top, right, bottom = self.ask("""(() => { const box = document.getElementById('stage').getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom]; })()""")
        self.assertGreater((right - left) * (bottom - top), 0.4 * 844 * 390)
        self.assertLessEqual(bottom, 390)
        self.assertLessEqual(self.ask('document.getElementById("player").getBoundingClientRect().bottom'), 390)
        self.assertGreater(self.ask('document.getElementById("time").getBoundingClientRect().width'), 40)
        self.assertLessEqual(self.ask('document.documentElement.scrollWidth - innerWidth'), 0)

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
        self.page.medium('print')
        self.assertEqual(self.ask('getComputedStyle(document.getElementById("player")).display'), 'none')
        self.assertNotEqual(self.ask('getComputedStyle(document.getElementById("figures")).display'), 'none')
        self.page.medium('')


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
