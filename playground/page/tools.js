// Effects of fingers, mouse and keys on the scene.

const Tools = (() => {
  const canvas = document.getElementById('view'), pointers = new Map();
  let tool = 'select', selected = { kind: 'start' }, drag = null, outline = null, ghost = null, pinch = null, turned = 0, onChange = () => {}, onView = () => {}, hover = null;

  const size = () => [canvas.clientWidth, canvas.clientHeight];
  // In a comparison both halves show the same part of the world.
  let halves = 1;
  const pane = () => { const [w, h] = size(); return [w / halves, h]; };
  function position(event) {
    const box = canvas.getBoundingClientRect(), [w] = pane();
    let x = event.clientX - box.left;
    if (halves > 1) x %= w;
    return [x, event.clientY - box.top];
  }
  const world = at => View.toWorld(at, ...pane());

  function thingAt(point, reach) {
    const scene = Scene.current;
    const within = (pose, margin) => Scene.contains(Scene.footprint(scene.vehicle, pose, margin), point);
    if (within(scene.start, reach / 2)) return { kind: 'start' };
    if (scene.slot && Scene.contains(Scene.slotOutline(scene.slot), point)) return { kind: 'slot' };
    if (!scene.slot) for (let i = scene.goals.length - 1; i >= 0; --i) if (within(scene.goals[i], reach / 2)) return { kind: 'goal', index: i };
    for (let i = scene.polygons.length - 1; i >= 0; --i) if (Scene.contains(scene.polygons[i], point)) return { kind: 'polygon', index: i };
    return null;
  }

  function select(thing) { selected = thing; onView(); }
  // A car to be placed appears in the middle of the view and follows the pointer or the arrow keys.
  function use(name) {
    tool = name;
    outline = null;
    ghost = name === 'car' && Scene.current ? [View.view.x, View.view.y, Scene.current.start[2]] : null;
    if (ghost) canvas.focus({ preventScroll: true });
    for (const button of document.querySelectorAll('[data-tool]')) button.setAttribute('aria-pressed', String(button.dataset.tool === name));
    canvas.style.cursor = name === 'select' ? 'default' : 'crosshair';
    onView();
  }

  function parkedCar([x, y, yaw]) {
    const car = Scene.current.vehicle, back = car.rear_overhang, length = back + car.wheelbase + car.front_overhang, half = car.width / 2, r = 0.25;
    const c = Math.cos(yaw), s = Math.sin(yaw), a = length / 2;
    return [[-a, -half + r], [-a + r, -half], [a - r, -half], [a, -half + r], [a, half - r], [a - r, half], [-a + r, half], [-a, half - r]].map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
  }
  function placeCar() {
    const scene = Scene.current;
    if (mayAdd()) { Scene.remember(); scene.polygons.push(parkedCar(ghost)); selected = { kind: 'polygon', index: scene.polygons.length - 1 }; Scene.changed(); onChange('placed'); }
    use('select');
  }
  const mayAdd = () => { if (!Scene.current.map) return true; Panels.notice('Obstacles can be added to worlds of polygons, not to maps.'); return false; };

  function closeOutline() {
    const corners = outline && outline.corners;
    outline = null;
    if (corners && corners.length >= 3) {
      if (Scene.crosses(corners)) Panels.notice('An outline must not cross itself; draw it again.');
      else { Scene.remember(); Scene.current.polygons.push(corners); selected = { kind: 'polygon', index: Scene.current.polygons.length - 1 }; Scene.changed(); }
    }
    use('select');
  }

  function down(event) {
    canvas.focus({ preventScroll: true });
    const at = position(event), point = world(at), scene = Scene.current, reach = 14 / View.view.scale;
    if (!scene) return;
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at);
    if (pointers.size === 2) { const [a, b] = [...pointers.values()]; pinch = { distance: Math.hypot(a[0] - b[0], a[1] - b[1]) }; drag = null; return; }
    if (event.button === 1 || event.button === 2) { drag = { kind: 'pan', at }; canvas.style.cursor = 'grabbing'; return; }
    if (tool === 'car') { ghost = [...point, ghost ? ghost[2] : scene.start[2]]; placeCar(); return; }
    if (tool === 'polygon') {
      if (!mayAdd()) { use('select'); return; }
      outline = outline || { corners: [] };
      const first = outline.corners[0];
      if (first && outline.corners.length >= 3 && Math.hypot(first[0] - point[0], first[1] - point[1]) < reach) closeOutline();
      else outline.corners.push(point);
      onView();
      return;
    }
    if (tool === 'slot') { drag = { kind: 'slot', from: point, begin: at }; return; }
    drag = grip(point, event.pointerType) || { kind: 'pan' };
    drag.begin = drag.at = at;
    canvas.style.cursor = 'grabbing';
    if (drag.thing) { selected = drag.thing; onView(); }
  }

  // The drag that begins at a point, or null on the ground.
  function grip(point, pointer) {
    const scene = Scene.current, reach = 14 / View.view.scale, chosen = Tools.selected;
    if (chosen) {
      const handle = Draw.handleOf(scene, chosen);
      if (Math.hypot(handle[0] - point[0], handle[1] - point[1]) < 1.4 * reach) return { kind: 'turn' };
      if (chosen.kind === 'polygon') {
        const corner = scene.polygons[chosen.index].findIndex(([x, y]) => Math.hypot(x - point[0], y - point[1]) < reach);
        if (corner >= 0) return { kind: 'corner', corner };
      }
    }
    const thing = thingAt(point, pointer === 'touch' ? 0.6 : 0.2);
    return thing && { kind: 'move', thing, last: point };
  }

  function moved(event) {
    const at = position(event), point = world(at), scene = Scene.current;
    hover = point;
    if (!scene) return;
    if (pointers.has(event.pointerId)) pointers.set(event.pointerId, at);
    if (pinch && pointers.size === 2) {
      const [a, b] = [...pointers.values()], distance = Math.hypot(a[0] - b[0], a[1] - b[1]);
      View.zoom(distance / Math.max(1, pinch.distance), [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], ...pane());
      pinch.distance = distance;
      onView();
      return;
    }
    if (ghost) ghost = [...point, ghost[2]];
    if (outline || ghost) onView();
    if (!drag) {
      if (tool === 'select') canvas.style.cursor = grip(point, event.pointerType) ? 'grab' : 'default';
      return;
    }
    if (drag.kind === 'pan') { View.view.x -= (at[0] - drag.at[0]) / View.view.scale; View.view.y += (at[1] - drag.at[1]) / View.view.scale; drag.at = at; onView(); return; }
    // A click that trembles changes nothing.
    if (!drag.moved) {
      if (Math.hypot(at[0] - drag.begin[0], at[1] - drag.begin[1]) < 3) return;
      drag.moved = true;
      Scene.remember();
    }
    if (drag.kind === 'move') { Scene.move(selected, point[0] - drag.last[0], point[1] - drag.last[1]); drag.last = point; }
    else if (drag.kind === 'turn') {
      const pose = Scene.poseOf(selected), angle = Math.atan2(point[1] - pose[1], point[0] - pose[0]);
      const before = selected.kind === 'polygon' ? (drag.angle === undefined ? angle : drag.angle) : pose[2];
      Scene.turn(selected, Scene.wrap(angle - before));
      drag.angle = angle;
    } else if (drag.kind === 'corner') scene.polygons[selected.index][drag.corner] = point;
    else if (drag.kind === 'slot') {
      const [x, y] = drag.from, length = Math.max(0.5, Math.abs(point[1] - y)), width = Math.max(0.5, Math.abs(point[0] - x)), upright = length > width;
      // The car enters through its open side.
      const toCar = upright ? Math.sign(scene.start[1] - (y + point[1]) / 2) || 1 : 0;
      scene.slot = { kind: upright ? 'perpendicular' : 'parallel', pose: [(x + point[0]) / 2, (y + point[1]) / 2, upright ? toCar * Math.PI / 2 : 0], length: upright ? length : width, width: upright ? width : length, entry: 'reverse', angle: Math.PI / 4, side: 'either', depth: null, lateral_offset: 0 };
      scene.goals = [];
      selected = { kind: 'slot' };
      Panels.showSlot();
    }
    Scene.changed();
  }

  function up(event) {
    pointers.delete(event.pointerId);
    if (pointers.size < 2) pinch = null;
    const was = drag;
    drag = null;
    if (was && was.kind === 'slot') use('select');
    if (tool === 'select') canvas.style.cursor = Scene.current && grip(world(position(event)), event.pointerType) ? 'grab' : 'default';
    if (was && was.moved) onChange(was.kind === 'move' ? 'moved ' + selected.kind : was.kind);
  }

  function remove() {
    const scene = Scene.current;
    if (!selected || selected.kind !== 'polygon') { Panels.notice('Only obstacles can be deleted.'); return; }
    Scene.remember();
    const polygon = scene.polygons[selected.index];
    const corner = hover ? polygon.findIndex(([x, y]) => Math.hypot(x - hover[0], y - hover[1]) < 10 / View.view.scale) : -1;
    if (corner >= 0 && polygon.length > 3) polygon.splice(corner, 1);
    else { scene.polygons.splice(selected.index, 1); selected = { kind: 'start' }; }
    Scene.changed();
    onChange('settled');
  }

  canvas.addEventListener('pointerdown', down);
  canvas.addEventListener('pointermove', moved);
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('dblclick', event => {
    const scene = Scene.current, point = world(position(event));
    if (outline) { outline.corners.pop(); closeOutline(); return; }
    if (!selected || selected.kind !== 'polygon') return;
    // A new corner on the nearest side.
    const polygon = scene.polygons[selected.index];
    let best = -1, least = 12 / View.view.scale;
    polygon.forEach(([x, y], i) => {
      const [u, v] = polygon[(i + 1) % polygon.length], l = Math.hypot(u - x, v - y) || 1, share = Math.min(1, Math.max(0, ((point[0] - x) * (u - x) + (point[1] - y) * (v - y)) / (l * l)));
      const off = Math.hypot(x + share * (u - x) - point[0], y + share * (v - y) - point[1]);
      if (off < least) { least = off; best = i; }
    });
    if (best >= 0) { Scene.remember(); polygon.splice(best + 1, 0, point); Scene.changed(); onChange('settled'); }
  });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    if (event.shiftKey && selected) {
      // One step of undo for a turn of the wheel, however many notches it has.
      if (event.timeStamp - turned > 600) Scene.remember();
      turned = event.timeStamp;
      Scene.turn(selected, -Math.sign(event.deltaY || event.deltaX) * Math.PI / 60); Scene.changed(); onChange('turn'); return;
    }
    View.zoom(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0016)), position(event), ...pane());
    onView();
  }, { passive: false });
  canvas.addEventListener('keydown', event => {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !Scene.current) return;
    const fine = event.shiftKey, key = event.key.toLowerCase();
    if (event.key === 'Tab') {
      const all = Scene.things(), now = selected ? all.findIndex(each => each.kind === selected.kind && each.index === selected.index) : -1, next = now + (event.shiftKey ? -1 : 1);
      if (next < 0 || next >= all.length) return;  // out of the canvas, to the next element
      event.preventDefault();
      select(all[next]);
      Panels.report(`${Scene.nameOf(all[next])} is selected`);
    } else if (ghost && (steps || key === 'q' || key === 'e' || event.key === 'Enter')) {
      event.preventDefault();
      if (event.key === 'Enter') { placeCar(); return; }
      const metres = fine ? 0.05 : 0.5;
      ghost = steps ? [ghost[0] + metres * steps[0], ghost[1] + metres * steps[1], ghost[2]] : [ghost[0], ghost[1], Scene.wrap(ghost[2] + (key === 'q' ? 1 : -1) * Math.PI / 180 * (fine ? 1 : 5))];
      onView();
    } else if (steps && selected) { event.preventDefault(); Scene.remember(); Scene.move(selected, steps[0] * (fine ? 0.01 : 0.1), steps[1] * (fine ? 0.01 : 0.1)); Scene.changed(); onChange('moved ' + selected.kind); }
    else if ((key === 'q' || key === 'e') && selected) { Scene.remember(); Scene.turn(selected, (key === 'q' ? 1 : -1) * Math.PI / 180 * (fine ? 1 : 5)); Scene.changed(); onChange('turn'); }
    else if (event.key === 'Delete' || event.key === 'Backspace') { event.preventDefault(); remove(); }
    else if (event.key === 'Enter') closeOutline();
    else if (event.key === 'Escape') use('select');
  });
  for (const button of document.querySelectorAll('[data-tool]')) button.addEventListener('click', () => use(button.dataset.tool));

  canvas.addEventListener('pointerleave', () => { hover = null; onView(); });

  return {
    use, remove, select, closeOutline,
    get selected() { const scene = Scene.current; return selected && scene && (selected.kind !== 'polygon' || scene.polygons[selected.index]) && (selected.kind !== 'goal' || (!scene.slot && scene.goals[selected.index])) && (selected.kind !== 'slot' || scene.slot) ? selected : null; },
    get tool() { return tool; }, get ghost() { return ghost && parkedCar(ghost); },
    get outline() { return outline; }, get hover() { return hover; }, get dragging() { return drag !== null && drag.kind !== 'pan'; },
    set halves(count) { halves = count; },
    listen: (change, view) => { onChange = change; onView = view; }, reset: () => { selected = { kind: 'start' }; outline = ghost = drag = null; }
  };
})();
