// The panel beside the scene: figures, car, slot, parameters, comparison and messages.

const Panels = (() => {
  const byId = id => document.getElementById(id);
  let table = [], vehicles = [], chosen = {}, onParameters = () => {}, hiding = 0;

  function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const key in attributes) if (key.startsWith('on')) made.addEventListener(key.slice(2), attributes[key]); else if (attributes[key] !== undefined) made.setAttribute(key, attributes[key]);
    made.append(...children);
    return made;
  }
  function notice(text) {
    byId('notice').textContent = text;
    byId('notice').hidden = !text;
    clearTimeout(hiding);
    hiding = setTimeout(() => { byId('notice').hidden = true; }, 6000);
  }
  function report(text) { byId('summary').textContent = text; }

  const OUTCOMES = ['Parked', 'Only near the goal', 'No path', 'Time limit', 'The start is blocked', 'The goal is blocked', 'Led out of contact'];
  // The planner beside ours, and whether a car can drive a path.
  const TEXTBOOK = 'textbook_hybrid_astar', LABELS = { paper_improved_astar: 'paper_improved_astar (the paper)', [TEXTBOOK]: "the textbook's Hybrid A*" };
  const DRIVABLE = ['yes', 'no, turns too tightly', 'no, hits an obstacle'];
  const canDrive = p => Number.isFinite(p[1]) ? DRIVABLE[p[16]] : '\u2013';
  const fixed = (value, digits, unit = '') => Number.isFinite(value) ? value.toFixed(digits) + unit : '\u2013';
  const clearance = metres => !Number.isFinite(metres) ? '\u2013' : metres < 0.1 ? fixed(1000 * metres, 0, ' mm') : fixed(metres, 2, ' m');
  // An unfinished plan under the short limit while dragging has no result yet.
  function verdict(plan, limit, whole) {
    const s = plan.summary, outcome = s[0], unready = !whole && outcome !== 0 && s[10] >= 900 * limit;
    byId('status').textContent = unready ? 'Looking' : OUTCOMES[outcome];
    byId('verdict').className = outcome === 0 ? '' : outcome === 1 || unready ? 'near' : 'wrong';
    report(unready ? 'for a path \u2026' : outcome === 0 ? `${fixed(s[1], 2)} m, ${s[2]} change${s[2] === 1 ? '' : 's'} of direction, clearance ${clearance(s[3])} \u00b7 ${fixed(s[10], 1)} ms` : outcome === 3 ? `no path within ${limit} s` : plan.message);
  }
  function wrong(message) {
    byId('status').textContent = 'Not a scene';
    byId('verdict').className = 'wrong';
    report(message);
    byId('figures').tBodies[0].replaceChildren();
  }
  function figures(plan, other, duration) {
    const rows = (p, seconds) => [['length', fixed(p[1], 2, ' m')], ['changes of direction', fixed(p[2], 0)], ['minimum clearance', clearance(p[3])], ['driven in', fixed(seconds, 1, ' s')], ['planned in', fixed(p[10], 1, ' ms')], ['expansions', fixed(p[6], 0)], ['motions attempted', fixed(p[7], 0)], ['poses checked', fixed(p[9], 0)], ['cost over lower bound', fixed(p[5], 2)], ['a car can drive it', canDrive(p)], ['turning radius', fixed(p[15], 2, ' m')]];
    const mine = rows(plan.summary, duration), theirs = other ? rows(other.summary, NaN) : null;
    const head = theirs ? [element('tr', {}, element('th', {}), element('th', {}, 'left'), element('th', {}, 'right')), element('tr', { class: 'words' }, element('td', {}, 'result'), ...[plan, other].map(each => element('td', {}, OUTCOMES[each.summary[0]])))] : [];
    byId('figures').tBodies[0].replaceChildren(...head, ...mine.map(([name, value], i) => element('tr', {}, element('td', {}, name), element('td', {}, value), ...(theirs ? [element('td', {}, theirs[i][1])] : []))));
  }

  const NAMES = { wheelbase: 'wheelbase, m', front_overhang: 'front overhang, m', rear_overhang: 'rear overhang, m', width: 'width, m', max_steering_angle: 'steering angle, rad', max_speed: 'speed, m/s', max_acceleration: 'acceleration, m/s\u00b2', max_steering_rate: 'steering rate, rad/s' };
  function field(name, value, step, set) {
    const input = element('input', { type: 'number', step, value: Math.round(value * 1e4) / 1e4, 'aria-label': name });
    input.addEventListener('change', () => { const number = input.valueAsNumber; if (Number.isFinite(number)) set(number); else notice(`${name} must be a number.`); });
    return element('label', { class: 'row' }, name, input);
  }
  function showVehicle() {
    const scene = Scene.current, select = byId('vehicle'), known = vehicles.find(each => each.name === scene.vehicle.name);
    select.replaceChildren(...vehicles.map(each => element('option', { value: each.name }, each.name.replace(/_/g, ' '))), ...(known ? [] : [element('option', { value: scene.vehicle.name }, scene.vehicle.name)]));
    select.value = scene.vehicle.name;
    const details = element('details', {}, element('summary', {}, 'Sizes and limits'));
    for (const key of Formats.VEHICLE_FIELDS) details.append(field(NAMES[key], scene.vehicle[key], 0.01, value => { Scene.remember(); scene.vehicle[key] = value; if (Formats.VEHICLE_FIELDS.indexOf(key) < 4) delete scene.vehicle.outline; scene.vehicle.name = 'custom'; Scene.changed(); showVehicle(); }));
    const open = byId('vehicle-fields').querySelector('details[open]') !== null;
    details.open = open;
    byId('vehicle-fields').replaceChildren(details);
  }
  function showSlot() {
    const scene = Scene.current, box = byId('slot-fields'), slot = scene.slot;
    const remove = element('button', { type: 'button', onclick: () => { Scene.remember(); scene.goals = [lastGoal()]; scene.slot = null; Tools.select({ kind: 'goal', index: 0 }); Scene.changed(); showSlot(); } }, 'A free goal instead');
    if (!slot) {
      box.replaceChildren(element('p', { class: 'dim' }, 'The goal is a pose. Draw a slot with the tool Slot, or '), element('button', { type: 'button', onclick: () => {
        Scene.remember();
        const [x, y, yaw] = scene.goals[0], car = scene.vehicle, middle = (car.wheelbase + car.front_overhang - car.rear_overhang) / 2;
        scene.slot = { kind: 'perpendicular', pose: [x + middle * Math.cos(yaw), y + middle * Math.sin(yaw), yaw], length: 5.2, width: 2.6, entry: 'reverse', angle: Math.PI / 4, side: 'either', depth: null, lateral_offset: 0 };
        scene.goals = [];
        Tools.select({ kind: 'slot' }); Scene.changed(); showSlot();
      } }, 'Add a slot round the goal'));
      return;
    }
    const choice = (name, values) => { const select = element('select', { 'aria-label': name }, ...values.map(each => element('option', {}, each))); select.value = slot[name]; select.addEventListener('change', () => { Scene.remember(); slot[name] = select.value; Scene.changed(); showSlot(); }); return element('label', { class: 'row' }, name, select); };
    const number = (name, key, step = 0.05) => field(name, slot[key], step, value => { Scene.remember(); slot[key] = value; Scene.changed(); });
    box.replaceChildren(choice('kind', Formats.KINDS), choice('entry', Formats.ENTRIES), number('length, m', 'length'), number('width, m', 'width'), ...(slot.kind === 'angled' ? [number('angle, rad', 'angle', 0.01)] : []), number('to the left, m', 'lateral_offset', 0.01), remove);
  }
  let goals = [];
  const lastGoal = () => goals.length ? Array.from(goals.slice(0, 3)) : [...Scene.current.slot.pose];

  const isDefault = row => chosen[row.name] === undefined || chosen[row.name] === String(row.value);
  function parameterRow(row) {
    const set = value => { if (String(value) === String(row.value)) delete chosen[row.name]; else chosen[row.name] = String(value); box.classList.toggle('changed', !isDefault(row)); onParameters(); };
    const now = chosen[row.name] === undefined ? row.value : chosen[row.name], box = element('div', { class: 'parameter' + (isDefault(row) ? '' : ' changed'), 'data-name': row.name });
    let control;
    if (row.type === 'flag') { control = element('input', { type: 'checkbox', 'aria-label': row.name }); control.checked = String(now) === 'true'; control.addEventListener('change', () => set(control.checked)); }
    else if (row.type === 'name') { control = element('select', { 'aria-label': row.name }, ...row.names.map(each => element('option', {}, each))); control.value = now; control.addEventListener('change', () => set(control.value)); }
    else {
      control = element('input', { type: 'number', 'aria-label': row.name, min: row.zero ? 0 : row.least, max: row.most, step: row.type === 'count' ? row.step : 'any', value: now });
      control.addEventListener('change', () => { const value = control.valueAsNumber; if (Number.isFinite(value) && ((value >= row.least && value <= row.most) || (row.zero && value === 0))) set(value); else { notice(`${row.name} must be between ${row.least} and ${row.most}${row.unit ? ' ' + row.unit : ''}.`); control.value = chosen[row.name] === undefined ? row.value : chosen[row.name]; } });
    }
    const meaning = element('p', {});
    row.meaning.split('`').forEach((part, i) => meaning.append(i % 2 ? element('code', {}, part) : part));
    const line = element('label', { class: 'row' }, element('code', {}, row.name + (row.unit ? `, ${row.unit}` : '')), control);
    box.append(line);
    // Short ranges also have a slider.
    if (row.type === 'number' && row.most <= 100 && row.most > row.least) {
      const slider = element('input', { type: 'range', min: row.zero ? 0 : row.least, max: Math.min(row.most, 10 * Math.max(1, row.value)), step: row.step || 'any', value: now, 'aria-label': row.name + ', slider' });
      slider.addEventListener('input', () => { control.value = slider.value; set(Number(slider.value)); });
      control.addEventListener('change', () => { slider.value = control.value; });
      box.append(element('div', { class: 'row' }, slider));
    }
    box.append(meaning);
    return box;
  }
  function showParameters() {
    byId('parameters').replaceChildren(...table.filter(row => row.name !== 'turning_radius').map(parameterRow));
    filter();
  }
  function filter() {
    const words = byId('filter').value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const box of byId('parameters').children) box.hidden = !words.every(word => box.textContent.toLowerCase().includes(word) || box.dataset.name.includes(word));
  }
  byId('filter').addEventListener('input', filter);
  byId('defaults').addEventListener('click', () => { chosen = {}; showParameters(); onParameters(); });

  // A name that may go on in the next line behind its underscores.
  const broken = name => name.split('_').flatMap((part, index) => index ? ['_', element('wbr'), part] : [part]);
  function ablation(rows) {
    const body = rows.map(([name, p]) => element('tr', {}, element('td', {}, ...broken(name)), element('td', {}, OUTCOMES[p[0]] === 'Parked' ? fixed(p[1], 2) : '\u2013'), element('td', {}, fixed(p[2], 0)), element('td', { class: p[16] ? 'bad' : '', title: canDrive(p) }, canDrive(p).slice(0, 3).replace(',', '')), element('td', {}, String(p[6])), element('td', {}, fixed(p[10], p[10] < 10 ? 1 : 0))));
    const wrong = rows.filter(([, p]) => Number.isFinite(p[1]) && p[16]).length;
    const note = `No car can drive ${wrong} of these ${rows.length} paths. The paper's sets plan on a grid for a disc that turns on the spot: their lengths and changes of direction compare with each other only.`;
    byId('table-wrap').replaceChildren(...(wrong ? [element('p', {}, note)] : []), element('table', {}, element('thead', {}, element('tr', {}, ...['set', 'm', 'cusps', 'drivable', 'nodes', 'ms'].map(each => element('th', {}, each)))), element('tbody', {}, ...body)));
  }

  function begin(about, changed) {
    table = about.parameters; vehicles = about.vehicles; onParameters = changed;
    const sets = table.find(row => row.name === 'parameter_set').names;
    byId('compare').append(...[TEXTBOOK, ...sets].map(each => element('option', { value: each }, LABELS[each] || each)));
    showParameters();
  }
  return { begin, notice, report, verdict, wrong, figures, showVehicle, showSlot, showParameters, ablation, byId, element,
    get parameters() { return chosen; }, set parameters(values) { chosen = values; showParameters(); }, get vehicles() { return vehicles; },
    get sets() { return table.find(row => row.name === 'parameter_set').names; }, set goals(numbers) { goals = numbers; }, knows: name => table.some(row => row.name === name),
    get compared() { return [TEXTBOOK, ...table.find(row => row.name === 'parameter_set').names]; }, labelOf: name => LABELS[name] || name,
    parametersOf: name => name === TEXTBOOK ? { planner: TEXTBOOK } : { parameter_set: name }, isTextbook: name => name === TEXTBOOK,
    valueOf: name => chosen[name] === undefined ? String(table.find(row => row.name === name).value) : chosen[name] };
})();
