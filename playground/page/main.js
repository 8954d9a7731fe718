// Connects the parts: plans after changes and draws the result.

(async () => {
  const { byId, notice } = Panels, canvas = byId('view');
  const show = { footprints: true, tree: false, heuristic: false, clearance: false, field: false, charts: true };
  let answer = null, compareWith = '', optimising = false, soon = false, mode = 'drive', playing = false, stamp = 0, time = null, drawn = false, planning = 0, shown = 0, settled = 0, quick = null;
  // An own scene is not as bundled; the intro is the drive that plays once; hovered: {kind: 'path' | 'drive', at} under the pointer on a chart.
  let isOwn = false, greeted = false, intro = false, hovered = null;

  const bundled = JSON.parse(byId('scenes').textContent);
  const fileOf = async name => {
    const content = bundled.files[name];
    if (content === undefined || !content.startsWith('base64:')) return content;
    return Uint8Array.from(atob(content.slice(7)), each => each.charCodeAt(0));
  };

  // Drawing, at most once per frame.
  function redraw() { if (!drawn) { drawn = true; requestAnimationFrame(() => { drawn = false; render(); }); } }

  const plan = () => answer && answer.plans && answer.plans[0];
  const drive = () => { const p = plan(); return p && p.trajectory && p.trajectory.length >= 16 ? p.trajectory : null; };
  const steps = p => Draw.rows(p.steps || new Float64Array(0), 4);
  const duration = () => { const d = drive(); return d ? d[d.length - 8] : 0; };

  function momentOf(points, t) {
    let low = 0, high = points.length / 8 - 1;
    while (high - low > 1) { const middle = (low + high) >> 1; if (points[8 * middle] <= t) low = middle; else high = middle; }
    const a = points.subarray(8 * low, 8 * low + 8), b = points.subarray(8 * high, 8 * high + 8), share = b[0] > a[0] ? Math.min(1, Math.max(0, (t - a[0]) / (b[0] - a[0]))) : 1, mix = i => a[i] + share * (b[i] - a[i]);
    return { pose: [mix(1), mix(2), a[3] + share * Scene.wrap(b[3] - a[3])], v: mix(4), a: a[5], steering: mix(6), index: low };
  }

  // The expansion of the search that is shown: its two neighbours in time, and the node that was expanded last.
  function shownStep(p) {
    const all = p && p.steps ? steps(p) : [];
    if (!all.length) return null;
    const at = mode === 'search' && time !== null ? Math.min(all.length - 1, Math.floor(time * all.length)) : all.length - 1, step = all[at], before = all[Math.max(0, at - 1)], ended = at >= all.length - 1;
    const side = step[2] > before[2] ? 'goal' : 'start', tree = side === 'goal' ? p.goalTree : p.startTree, last = (side === 'goal' ? step[2] : step[1]) - 1;
    const index = ended || step[1] + step[2] === before[1] + before[2] ? -1 : tree[9 * last + 3];
    return { count: step[0], all: all[all.length - 1][0], step, before, ended, side, tree, index, node: index < 0 ? null : tree.subarray(9 * index, 9 * index + 9) };
  }
  // The node of the shown trees under the pointer, or null.
  function nodeUnder(p, now) {
    if (!Tools.hover || !now) return null;
    let best = null, least = 10 / View.view.scale;
    for (const [side, tree, count] of [['start', p.startTree, now.step[1]], ['goal', p.goalTree, now.step[2]]])
      for (let i = 0; i < count; ++i) { const off = Math.hypot(tree[9 * i] - Tools.hover[0], tree[9 * i + 1] - Tools.hover[1]); if (off < least) { least = off; best = { side, tree, index: i, node: tree.subarray(9 * i, 9 * i + 9) }; } }
    return best;
  }
  // The state of a path after some metres.
  function stateAt(path, metres) {
    const states = Draw.rows(path, 7), next = states.findIndex(each => each[5] >= metres), b = states[next < 0 ? states.length - 1 : next], a = states[Math.max(0, next - 1)] || b, share = b[5] > a[5] ? (metres - a[5]) / (b[5] - a[5]) : 1;
    return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * Scene.wrap(b[2] - a[2])];
  }

  function pane(painter, scene, p, main) {
    Draw.metres(painter);
    const found = answer || {}, goals = found.goals && found.goals.length ? Draw.rows(found.goals, 3) : scene.goals, startHits = found.startIsFree === false;
    const goalHits = found.freeGoals !== undefined && found.freeGoals.length > 0 && !found.freeGoals.includes(true), bodies = [];
    const has = p && p.path && p.path.length, selected = main ? Tools.selected : null, used = has && p.summary ? p.summary[12] : 0;
    if (startHits) bodies.push(Scene.footprint(scene.vehicle, scene.start));
    if (goalHits) bodies.push(Scene.footprint(scene.vehicle, goals[used]));
    if (show.field && found.field) Draw.distances(painter, found.field);
    Draw.world(painter, scene, found.bounds, selected, bodies);
    if (p && p.steps && (show.tree || show.heuristic || mode === 'search')) {
      const now = shownStep(p), under = main && now && nodeUnder(p, now);
      if (now) {
        Draw.tree(painter, p.startTree, now.step[1], Draw.palette['tree-start'], { heuristic: show.heuristic, fresh: now.ended ? 0 : now.step[1] - now.before[1] });
        Draw.tree(painter, p.goalTree, now.step[2], Draw.palette['tree-goal'], { heuristic: show.heuristic, fresh: now.ended ? 0 : now.step[2] - now.before[2] });
        if (now.node) painter.disc([now.node[0], now.node[1]], 7, { stroke: Draw.palette.ink, width: 2.2 });
      }
      if (under) Draw.branch(painter, under.tree, under.index);
    }
    const hidden = mode === 'search' && time !== null && time < 1;
    const disc = p && p.summary && p.summary[13] ? p.summary[14] : 0;
    if (has && !hidden) {
      if (show.footprints) Draw.footprints(painter, scene.vehicle, p.path, disc);
      Draw.path(painter, p.path);
      if (show.clearance) Draw.clearance(painter, p.path);
    }
    const red = { edge: Draw.palette.bad, fill: Draw.palette['bad-fill'] };
    goals.forEach((goal, i) => Draw.car(painter, scene.vehicle, goal, { edge: Draw.palette.goal, fill: 'rgba(16, 185, 129, 0.16)', opacity: i === used ? 0.95 : 0.5, chosen: selected && ((selected.kind === 'goal' && selected.index === i) || selected.kind === 'slot'), ...(goalHits ? red : {}) }));
    const moving = main && mode === 'drive' && time !== null && drive();
    Draw.car(painter, scene.vehicle, scene.start, { opacity: moving ? 0.35 : 1, chosen: selected && selected.kind === 'start', ...(startHits ? red : {}) });
    if (moving) {
      const now = momentOf(drive(), time), track = Draw.rows(drive(), 8).slice(0, now.index + 1).map(each => [each[1], each[2]]);
      track.push([now.pose[0], now.pose[1]]);
      painter.shape(track, { stroke: Draw.palette.drive, width: 2.5 }, false);
      Draw.car(painter, scene.vehicle, now.pose, { steering: now.steering, brake: now.a * now.v < -0.02 || Math.abs(now.v) < 0.005, reverse: now.v < -0.005 });
    } else {
      const name = (at, word, hits, colour, above) => painter.text([at[0], at[1]], hits ? word + ' touches: move it' : word, { fill: hits ? Draw.palette.bad : colour, halo: Draw.palette.ground, dy: above * (0.5 * scene.vehicle.width * painter.view.scale + 11) });
      name(scene.start, 'Start', startHits, Draw.palette['car-edge'], -1);
      if (goals[used]) name(goals[used], 'Goal', goalHits, Draw.palette.goal, 1);
    }
    if (main && hovered && has) {
      const pose = hovered.kind === 'drive' && drive() ? momentOf(drive(), hovered.at).pose : stateAt(p.path, hovered.at);
      Draw.car(painter, scene.vehicle, pose, { edge: Draw.palette.drive });
    }
    if (main) {
      if (Tools.selected && !playing && !Tools.ghost) Draw.handles(painter, scene, Tools.selected);
      if (Tools.ghost) painter.shape(Tools.ghost, { fill: Draw.palette.obstacle, stroke: Draw.palette.accent, width: 2, dash: [5, 4], opacity: 0.65 });
      if (Tools.outline) {
        const corners = Tools.hover ? [...Tools.outline.corners, Tools.hover] : Tools.outline.corners;
        painter.shape(corners, { fill: Draw.palette.slot, stroke: Draw.palette.accent, width: 2, dash: [5, 4] });
        for (const corner of Tools.outline.corners) painter.disc(corner, 4.5, { fill: Draw.palette.ground, stroke: Draw.palette.accent, width: 2 });
      }
    }
  }

  function render() {
    const scene = Scene.current;
    if (!scene) return;
    const ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight, context = canvas.getContext('2d');
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) { canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio); }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = Draw.palette.ground;
    context.fillRect(0, 0, width, height);
    const halves = compareWith ? 2 : 1;
    Tools.halves = halves;
    byId('sides').hidden = halves < 2;
    for (let k = 0; k < halves; ++k) {
      context.save();
      context.translate(k * width / halves, 0);
      context.beginPath(); context.rect(0, 0, width / halves, height); context.clip();
      pane(new CanvasPainter(context, width / halves, height, View.view), scene, answer && answer.plans ? answer.plans[k] : null, k === 0);
      context.restore();
    }
    if (halves > 1) { context.fillStyle = Draw.palette.soft; context.fillRect(width / 2 - 1, 0, 2, height); }
    const p = plan(), charts = [byId('chart-1'), byId('chart-2')];
    if (show.charts && p && p.path && p.path.length) {
      if (chartKind() === 'drive') Charts.drive(...charts, drive(), scene.vehicle, hovered ? hovered.at : time);
      else Charts.path(...charts, p.path, scene.vehicle, hovered && hovered.at);
    } else if (show.charts && answer) for (const each of charts) Charts.empty(each, 'no path to show');
    if (mode === 'search') { const now = shownStep(p); Guide.why(now, now && nodeUnder(p, now), false); }
    Guide.hint();
    clock();
    byId('delete').disabled = !(Tools.selected && Tools.selected.kind === 'polygon');
    byId('undo').disabled = !Scene.canUndo();
    byId('redo').disabled = !Scene.canRedo();
  }

  const chartKind = () => mode === 'drive' && drive() && time !== null ? 'drive' : 'path';

  function clock() {
    const p = plan();
    let text = '\u2013', share = 0;
    if (mode === 'drive') { const all = duration(); if (all) { const t = time === null ? 0 : time; text = `${t.toFixed(1)} / ${all.toFixed(1)} s`; share = t / all; } }
    else if (p && p.steps) { const all = steps(p), t = time === null ? 1 : time, at = Math.min(all.length - 1, Math.floor(t * all.length)); text = all.length ? `${all[at][0]} of ${all[all.length - 1][0]} expanded` : text; share = t; }
    byId('clock').textContent = text;
    byId('time').value = 1000 * share;
    byId('play').innerHTML = playing ? '&#10074;&#10074; Pause' : '&#9654; Play';
  }

  // Planning. During a drag plans have a short limit; the full plan follows at its end.
  const QUICK = 0.1;  // seconds
  const limitOf = whole => Math.min(whole ? 30 : QUICK, Math.max(0.05, Number(byId('limit').value) || 1));
  function question(whole) {
    const scene = Scene.current, limit = limitOf(whole);
    const parameters = [{ ...Panels.parameters }];
    if (compareWith) parameters.push(Panels.parametersOf(compareWith));
    return { kind: 'plan', start: scene.start, field: show.field ? 320 : 0, numbers: Planner.numbersOf(scene), cells: scene.map ? scene.map.cells : null, parameters, seconds: limit, hasty: !whole, trace: show.tree || show.heuristic || mode === 'search' ? 20000 : 0, trajectory: whole ? 2 : 0 };
  }
  async function replan(whole) {
    const mine = ++planning, scene = Scene.current;
    document.body.dataset.busy = 'yes';
    if (whole) remember();
    const asked = performance.now(), found = await Planner.ask(question(whole));
    // Two workers: results older than the displayed one are dropped.
    if (!found || mine < shown || (whole && mine !== planning)) return;
    shown = mine;
    if (whole) delete document.body.dataset.busy; else quick = found;
    document.body.dataset.planned = String(performance.now() - asked);
    if (!found.ok) { answer = { message: found.message, goals: found.goals, bounds: found.bounds, plans: null }; Panels.wrong(found.message); redraw(); return; }
    // A computed drive stays until the path changes.
    answer = found;
    if (found.goals) Panels.goals = found.goals;
    Panels.verdict(found.plans[0], limitOf(whole), whole);
    Panels.figures(found.plans[0], found.plans[1], duration() || NaN);
    document.body.dataset.answers = String(Number(document.body.dataset.answers || 0) + 1);
    if (whole) document.body.dataset.whole = String(mine);
    if (whole) optimising = false;
    // The first drive plays once by itself, and then the scene is as it was.
    if (whole && !greeted) { greeted = true; if (drive() && mode === 'drive' && !matchMedia('(prefers-reduced-motion: reduce)').matches) { intro = true; actions.play(); } }
    if (soon && drive()) { soon = false; notice(''); actions.play(); }
    if (mode === 'drive' && time !== null && !playing) time = Math.min(time, duration());
    redraw();
  }
  function changed(what) {
    const scene = Scene.current;
    if (what !== 'changed') { Panels.showVehicle(); Panels.showSlot(); }
    if (what === 'opened') { Tools.reset(); fit(); } else if (!isOwn) own(`${byId('scene').selectedOptions[0].textContent}, edited`);
    time = null; playing = intro = false; soon = false; optimising = true; greeted = greeted || what !== 'opened'; hovered = null;
    replan(false);
    clearTimeout(settled);
    settled = setTimeout(() => replan(true), 160);
    if (scene.slot === null && !scene.goals.length) scene.goals = [[...scene.start]];
    redraw();
  }

  function fit() {
    const scene = Scene.current, box = [Infinity, Infinity, -Infinity, -Infinity];
    const include = ([x, y]) => { box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y); box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y); };
    for (const corner of Scene.footprint(scene.vehicle, scene.start, 1)) include(corner);
    for (const goal of scene.goals) for (const corner of Scene.footprint(scene.vehicle, goal, 1)) include(corner);
    if (scene.slot) Scene.slotOutline(scene.slot).forEach(include);
    // The surroundings of the problem, not the whole street.
    const near = [box[0] - 6, box[1] - 6, box[2] + 6, box[3] + 6];
    for (const [x, y] of scene.polygons.flat()) include([Math.min(near[2], Math.max(near[0], x)), Math.min(near[3], Math.max(near[1], y))]);
    if (scene.map) { const [x, y] = scene.map.origin, { columns, rows, resolution } = scene.map; for (const [u, v] of [[x, y], [x + columns * resolution, y + rows * resolution]]) include([Math.min(near[2] + 6, Math.max(near[0] - 6, u)), Math.min(near[3] + 6, Math.max(near[1] - 6, v))]); }
    Guide.hint();
    byId('sides').hidden = !compareWith;
    const covered = id => byId(id).offsetHeight + 16;
    View.fit(box, canvas.clientWidth / (compareWith ? 2 : 1), canvas.clientHeight, 24, covered('verdict'), covered('below'));
    redraw();
  }

  // The list names the bundled scene, or says what the scene is that differs from all of them.
  function own(name) { isOwn = true; byId('own').textContent = name; byId('scene').value = ''; }
  async function openBundled(name, undoable = false) {
    const scene = await Formats.readScenario(name + '.yaml', await fileOf(name + '.yaml'), Panels.vehicles, fileOf);
    if (undoable) Scene.remember();
    isOwn = false;
    byId('scene').value = name;
    Scene.replace(scene);
  }
  function openOwn(scene, name = scene.name) { own(name); Scene.replace(scene); }
  async function openFiles(files) {
    try {
      const scene = await Formats.open([...files], Panels.vehicles);
      Scene.remember();
      openOwn(scene);
    } catch (error) { notice(error.message); }
  }

  // The scene, the changed parameters and the comparison outlive a reload.
  function remember() {
    if (Scene.current) Memory.store(Scene.current, { bundled: isOwn ? undefined : byId('scene').value, name: byId('own').textContent, parameters: Panels.parameters, compare: compareWith });
  }
  function setUp(parameters, compare) {
    const former = name => name === 'improved_astar' ? 'paper_improved_astar' : name;
    if (parameters) Panels.parameters = Object.fromEntries(Object.entries(parameters).filter(([name]) => Panels.knows(name)).map(([name, value]) => [name, name === 'parameter_set' ? former(String(value)) : String(value)]));
    if (Panels.compared.includes(former(compare))) { compareWith = former(compare); byId('compare').value = compareWith; byId('other-name').textContent = Panels.labelOf(compareWith); }
  }
  // The scene before a reload of the page; false without one.
  async function openStored() {
    try {
      const found = Memory.recall();
      if (!found) return false;
      const scene = found.bundled ? null : await Formats.readScenario('stored.yaml', found.scenario, Panels.vehicles, async name => found.files.get(name));
      setUp(found.parameters, found.compare);
      if (scene) openOwn(scene, String(found.name)); else await openBundled(found.bundled);
      return true;
    } catch (error) {
      Memory.forget();
      notice('The scene before the reload is damaged; this is a bundled one.');
      return false;
    }
  }

  // Links: the scene, the changed parameters and the view; deflated if the browser supports it.
  const toBase64 = bytes => { let text = ''; for (const each of bytes) text += String.fromCharCode(each); return btoa(text).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, ''); };
  const fromBase64 = text => Uint8Array.from(atob(text.replace(/-/g, '+').replace(/_/g, '/')), each => each.charCodeAt(0));
  const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
  async function link() {
    const scene = Scene.current, shared = isOwn ? null : { bundled: byId('scene').value };
    if (scene.map && !shared) { notice('A map is too large for a link; save the scenario instead.'); return null; }
    const round = value => JSON.parse(JSON.stringify(value, (key, each) => typeof each === 'number' ? Math.round(each * 1e6) / 1e6 : each));
    const content = new TextEncoder().encode(JSON.stringify({ ...(shared || { scene: round({ ...scene, map: undefined }) }), parameters: Panels.parameters, compare: compareWith || undefined }));
    const deflated = typeof CompressionStream === 'undefined' ? null : await through(content, new CompressionStream('deflate-raw'));
    location.hash = deflated ? 'z' + toBase64(deflated) : 'j' + toBase64(content);
    return location.href;
  }
  async function openLink(hash) {
    const damaged = () => { throw new Error('it is damaged or cut short'); };
    const decoded = async () => {
      const bytes = fromBase64(hash.slice(1)), content = hash[0] === 'z' ? await through(bytes, new DecompressionStream('deflate-raw')) : bytes;
      return JSON.parse(new TextDecoder().decode(content));
    };
    const found = await decoded().catch(damaged);
    if (!found || typeof found !== 'object') damaged();
    setUp(found.parameters, found.compare);
    if (found.bundled && bundled.order.includes(found.bundled)) return openBundled(found.bundled);
    // Through the reader of files, which checks everything.
    const scene = found.scene;
    if (!scene || typeof scene !== 'object') throw new Error('it contains no scene');
    const written = () => Formats.toYaml({ name: String(scene.name || 'scene'), vehicle: scene.vehicle, start: scene.start, goals: scene.goals, slot: scene.slot, polygons: scene.polygons, map: null });
    let text = '';
    try { text = written(); } catch (error) { damaged(); }
    openOwn(await Formats.readScenario('link.yaml', text, Panels.vehicles, async () => undefined));
  }

  function save(name, content, type) {
    const address = URL.createObjectURL(new Blob([content], { type }));
    const anchor = Panels.element('a', { href: address, download: name });
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }
  function svg() {
    const painter = new SvgPainter(canvas.clientWidth, canvas.clientHeight, View.view);
    pane(painter, Scene.current, plan(), false);
    return painter.toString(Draw.palette.ground);
  }
  const fileName = () => Scene.current.name.replace(/[^\w.-]+/g, '_') || 'scene';
  const pathTable = () => Formats.table(['x', 'y', 'yaw', 'direction', 'curvature', 'driven', 'clearance'], Draw.rows(plan().path, 7).map(each => [...each]));

  const actions = {
    open: () => byId('files').click(), fit, undo: Scene.undo, redo: Scene.redo, delete: Tools.remove, help: () => byId('keys').showModal(),
    share: async () => { const address = await link(); if (!address) return; try { await navigator.clipboard.writeText(address); notice('The link to this scene is in the address and copied.'); } catch (error) { notice('The link to this scene is in the address.'); } },
    theme: () => { const dark = document.documentElement.classList.toggle('dark'); try { localStorage.setItem('theme', dark ? 'dark' : 'light'); } catch (error) { /* without storage the page forgets */ } Draw.refresh(); redraw(); },
    'save-yaml': () => { save(fileName() + '.yaml', Formats.toYaml(Scene.current), 'text/yaml'); if (Scene.current.map) for (const [name, content] of Formats.mapFiles(Scene.current.map)) save(name, content, 'application/octet-stream'); },
    'save-csv': () => { if (plan() && plan().path.length) save(fileName() + '_path.csv', pathTable(), 'text/csv'); else notice('There is no path to save.'); },
    'save-trajectory': () => { if (drive()) save(fileName() + '_trajectory.csv', Formats.table(['t', 'x', 'y', 'yaw', 'v', 'a', 'steering', 'steering_rate'], Draw.rows(drive(), 8).map(each => [...each])), 'text/csv'); else notice('There is no trajectory to save.'); },
    'save-svg': () => save(fileName() + '.svg', svg(), 'image/svg+xml'),
    print: () => window.print(),
    play: () => {
      if (playing) { playing = false; redraw(); return; }
      if (mode === 'drive' && !drive() && optimising) { soon = true; notice('The drive is being optimised.'); return; }
      if (mode === 'drive' && !drive()) { notice(plan() && plan().trajectoryMessage ? plan().trajectoryMessage : 'There is no path to drive.'); return; }
      if (mode === 'search' && !(plan() && plan().steps)) return;
      const end = mode === 'drive' ? duration() : 1;
      if (time === null || time >= end) time = 0;
      playing = true;
      stamp = performance.now();
      requestAnimationFrame(frame);
    },
    ablation: async () => {
      const rows = [];
      for (const name of ['default', ...Panels.compared.filter(each => each !== 'default')]) {
        const found = await Planner.ask({ ...question(false), seconds: limitOf(true), hasty: false, parameters: [Panels.parametersOf(name)], trace: 0 });
        if (found && found.ok) { rows.push([name, found.plans[0].summary]); Panels.ablation(rows); }
      }
      replan(true);
    }
  };
  for (const name in actions) byId(name).addEventListener('click', () => { actions[name](); const menu = byId(name).closest('details.menu'); if (menu) menu.open = false; });

  function frame(now) {
    if (!playing) return;
    const rate = Number(byId('rate').value), all = mode === 'drive' ? duration() : 1;
    // A search of any size plays in about six seconds.
    time += (now - stamp) / 1000 * rate * (mode === 'drive' ? 1 : 1 / 12);
    stamp = now;
    if (time >= all) { time = intro ? null : all; playing = intro = false; }
    render();
    if (playing) requestAnimationFrame(frame);
  }
  function setMode(name) {
    mode = name; playing = false; time = null;
    for (const each of ['drive', 'search']) byId('tab-' + each).setAttribute('aria-selected', String(each === name));
    byId('why').hidden = name !== 'search';
    document.body.classList.toggle('searching', name === 'search');
    hovered = null; intro = false;
    legend();
    if (name === 'search') Guide.happened('search');
    if (name === 'search' && !(plan() && plan().steps)) replan(true); else redraw();
  }
  byId('tab-drive').addEventListener('click', () => setMode('drive'));
  byId('tab-search').addEventListener('click', () => setMode('search'));
  byId('time').addEventListener('input', () => { playing = false; time = Number(byId('time').value) / 1000 * (mode === 'drive' ? duration() : 1); redraw(); });

  function legend() {
    const entries = [['forward', 'forwards'], ['reverse', 'reverse']];
    if (show.tree || show.heuristic || mode === 'search') entries.push(['tree-start', "the start's tree"], ['tree-goal', "the goal's tree"]);
    if (mode === 'drive') entries.push(['drive', 'driven']);
    const swatch = (background, name, width = 16) => Panels.element('li', {}, Panels.element('i', { style: `background:${background};width:${width}px` }), name);
    const shades = (from, to) => `linear-gradient(90deg, ${[0, 0.25, 0.5, 0.75, 1].map(share => `hsl(${from + share * (to - from)} 82% 48%)`).join(', ')})`;
    byId('legend').replaceChildren(...entries.map(([colour, name]) => swatch(`var(--${colour})`, name)),
      ...(show.heuristic ? [swatch(shades(200, 10), 'remaining cost by the heuristic: low to high', 40)] : []), ...(show.clearance ? [swatch(shades(0, 130), 'clearance: 0 to 0.8 m', 40)] : []), ...(show.field ? [swatch(shades(10, 210), `distance: 0 to ${Draw.MOST_DISTANCE} m`, 40)] : []));
  }
  for (const box of document.querySelectorAll('[data-show]')) box.addEventListener('change', () => {
    show[box.dataset.show] = box.checked;
    byId('charts').hidden = !show.charts;
    legend();
    if (((show.tree || show.heuristic) && !(plan() && plan().steps)) || (show.field && !(answer && answer.field))) replan(true); else redraw();
  });

  byId('compare').addEventListener('change', () => { compareWith = byId('compare').value; byId('other-name').textContent = Panels.labelOf(compareWith); fit(); replan(true); });
  byId('limit').addEventListener('change', () => replan(true));
  byId('vehicle').addEventListener('change', () => { Scene.remember(); const car = Panels.vehicles.find(each => each.name === byId('vehicle').value); if (car) Scene.current.vehicle = { ...car }; Scene.changed(); Panels.showVehicle(); });
  byId('scene').addEventListener('change', () => { if (byId('scene').value) openBundled(byId('scene').value, true).catch(error => notice(error.message)); });
  byId('files').addEventListener('change', () => { openFiles(byId('files').files); });
  addEventListener('dragover', event => { event.preventDefault(); document.body.classList.add('dropping'); });
  addEventListener('dragleave', event => { if (!event.relatedTarget) document.body.classList.remove('dropping'); });
  addEventListener('drop', event => { event.preventDefault(); document.body.classList.remove('dropping'); if (event.dataTransfer.files.length) openFiles(event.dataTransfer.files); });
  addEventListener('paste', event => { const text = event.clipboardData && event.clipboardData.getData('text'); if (text && !/^(INPUT|TEXTAREA)$/.test(event.target.tagName)) openFiles([new File([text], 'pasted')]); });
  for (const chart of [byId('chart-1'), byId('chart-2')]) {
    chart.addEventListener('pointermove', event => { const at = Charts.under(chart, event); hovered = at === null ? null : { kind: chartKind(), at }; redraw(); });
    chart.addEventListener('pointerleave', () => { hovered = null; redraw(); });
  }
  canvas.addEventListener('pointermove', () => { if (mode === 'search') redraw(); });
  addEventListener('pointerdown', event => { if (intro && !event.target.closest('#player')) { time = null; playing = false; redraw(); } intro = false; greeted = true; }, true);
  addEventListener('pagehide', remember);
  addEventListener('resize', redraw);
  addEventListener('hashchange', () => { if (/^#[zj]/.test(location.hash) && !document.body.dataset.ownLink) openLink(location.hash.slice(1)).catch(error => notice('The link cannot be read: ' + error.message)); });
  addEventListener('beforeprint', () => { document.body.dataset.dark = document.documentElement.classList.contains('dark') ? 'yes' : ''; document.documentElement.classList.remove('dark'); Draw.refresh(); render(); });
  addEventListener('afterprint', () => { if (document.body.dataset.dark) document.documentElement.classList.add('dark'); Draw.refresh(); redraw(); });
  addEventListener('keydown', event => {
    if (/^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) || byId('keys').open) return;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'z') { event.preventDefault(); if (event.shiftKey) Scene.redo(); else Scene.undo(); return; }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tool = { v: 'select', c: 'car', p: 'polygon', s: 'slot' }[event.key.toLowerCase()], box = { t: 'tree', h: 'heuristic', r: 'clearance', g: 'field' }[event.key.toLowerCase()], action = { f: 'fit', o: 'open', l: 'share', d: 'theme', '?': 'help' }[event.key.toLowerCase()];
    if (tool) Tools.use(tool);
    else if (box) { const input = document.querySelector(`[data-show="${box}"]`); input.checked = !input.checked; input.dispatchEvent(new Event('change')); }
    else if (action) actions[action]();
    else if (event.key === ' ' && !/^(BUTTON|SUMMARY)$/.test(event.target.tagName)) { event.preventDefault(); actions.play(); }
  });

  // Begin.
  let theme = null;
  try { theme = localStorage.getItem('theme'); } catch (error) { /* no storage: the system's theme */ }
  if (theme === 'dark' || (theme === null && matchMedia('(prefers-color-scheme: dark)').matches)) document.documentElement.classList.add('dark');
  Draw.refresh();
  legend();
  const about = await Planner.about;
  if (about.broken) { byId('status').textContent = 'This browser cannot run the planner'; Panels.report(about.broken); return; }
  Panels.begin(about, () => replan(true));
  byId('scene').append(Panels.element('option', { value: '', id: 'own', hidden: '' }, 'own scene'), ...bundled.order.map(name => Panels.element('option', { value: name }, name.replace(/_/g, ' '))));
  Scene.listen(changed);
  Tools.listen(what => { Guide.happened(what); clearTimeout(settled); replan(true); }, redraw);
  try {
    if (await openStored()) { /* reloaded */ } else if (/^#[zj]/.test(location.hash)) await openLink(location.hash.slice(1)); else await openBundled('perpendicular');
  } catch (error) { notice('The link cannot be read: ' + error.message); await openBundled('perpendicular'); }
  // For tests and inspection.
  window.playground = { Scene, View, Planner, Formats, Panels, Tools, Draw, svg, pathTable, link, get answer() { return answer; }, get quick() { return quick; }, show, setMode, openBundled, openFiles, openLink, get time() { return time; }, get hovered() { return hovered; }, get playing() { return playing; } };
})();
