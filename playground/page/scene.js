// The edited scene: car, goal or slot, obstacles. With undo.

const Scene = (() => {
  let scene = null, past = [], future = [], mapCount = 0;
  const listeners = [];
  const copy = each => ({ ...JSON.parse(JSON.stringify({ ...each, map: null })), map: each.map });
  const wrap = angle => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

  function tell(what) { for (const listener of listeners) listener(what); }

  function replace(next, what = 'opened') {
    if (next.map && !next.map.id) next.map.id = ++mapCount;
    scene = next;
    tell(what);
  }

  // Records the scene before a change, for undo: as it is, or an earlier copy of it.
  function remember(before = scene) {
    if (!before) return;
    past.push(copy(before));
    if (past.length > 100) past.shift();
    future = [];
  }
  function undo() { if (past.length) { future.push(copy(scene)); replace(past.pop(), 'undone'); } }
  function redo() { if (future.length) { past.push(copy(scene)); replace(future.pop(), 'undone'); } }
  const changed = () => tell('changed');

  // The body of the car, corners counter-clockwise: its outline or a rectangle. With a margin the bounding rectangle.
  function footprint(car, [x, y, yaw], margin = 0) {
    const c = Math.cos(yaw), s = Math.sin(yaw), back = -car.rear_overhang - margin, front = car.wheelbase + car.front_overhang + margin, half = car.width / 2 + margin;
    return (car.outline && margin === 0 ? car.outline : [[back, -half], [front, -half], [front, half], [back, half]]).map(([a, b]) => [x + c * a - s * b, y + s * a + c * b]);
  }

  // Pose of a car in a slot, like the first entry of the planner: only for placing dragged objects.
  function slotOutline(slot) {
    const [x, y, yaw] = slot.pose, c = Math.cos(yaw), s = Math.sin(yaw), a = slot.length / 2, b = slot.width / 2;
    return [[-a, -b], [a, -b], [a, b], [-a, b]].map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
  }

  const area = polygon => polygon.reduce((sum, [x, y], i) => { const [u, v] = polygon[(i + 1) % polygon.length]; return sum + x * v - u * y; }, 0) / 2;
  const middle = polygon => polygon.reduce(([x, y], [u, v]) => [x + u / polygon.length, y + v / polygon.length], [0, 0]);
  function contains(polygon, [x, y]) {
    let inside = false;
    for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
      const [ax, ay] = polygon[i], [bx, by] = polygon[j];
      if ((ay > y) !== (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
    }
    return inside;
  }
  function crosses(polygon) {
    const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), n = polygon.length;
    for (let i = 0; i < n; ++i)
      for (let j = i + 2; j < n; ++j) {
        if (i === 0 && j === n - 1) continue;
        const a = polygon[i], b = polygon[(i + 1) % n], c = polygon[j], d = polygon[(j + 1) % n];
        if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
      }
    return false;
  }

  // Whether the areas of two polygons overlap.
  function overlaps(one, other) {
    const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const sidesCross = one.some((a, i) => other.some((c, j) => {
      const b = one[(i + 1) % one.length], d = other[(j + 1) % other.length];
      return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
    }));
    return sidesCross || contains(one, other[0]) || contains(other, one[0]);
  }

  // Objects that can be selected: {kind: 'start' | 'goal' | 'slot' | 'polygon', index}.
  function poseOf(thing) {
    if (thing.kind === 'start') return scene.start;
    if (thing.kind === 'goal') return scene.goals[thing.index];
    if (thing.kind === 'slot') return scene.slot.pose;
    return [...middle(scene.polygons[thing.index]), 0];
  }
  function move(thing, dx, dy) {
    if (thing.kind === 'polygon') for (const corner of scene.polygons[thing.index]) { corner[0] += dx; corner[1] += dy; }
    else { const pose = poseOf(thing); pose[0] += dx; pose[1] += dy; }
  }
  function turn(thing, angle) {
    if (thing.kind !== 'polygon') { const pose = poseOf(thing); pose[2] = wrap(pose[2] + angle); return; }
    const polygon = scene.polygons[thing.index], [x, y] = middle(polygon), c = Math.cos(angle), s = Math.sin(angle);
    for (const corner of polygon) { const u = corner[0] - x, v = corner[1] - y; corner[0] = x + c * u - s * v; corner[1] = y + s * u + c * v; }
  }
  function things() {
    const found = [{ kind: 'start' }];
    if (scene.slot) found.push({ kind: 'slot' });
    else scene.goals.forEach((_, index) => found.push({ kind: 'goal', index }));
    scene.polygons.forEach((_, index) => found.push({ kind: 'polygon', index }));
    return found;
  }
  function nameOf(thing) {
    return { start: 'the car', goal: 'the goal', slot: 'the slot', polygon: `obstacle ${thing.index + 1}` }[thing.kind];
  }

  return {
    get current() { return scene; },
    replace, remember, undo, redo, changed, copy, footprint, slotOutline, area, middle, contains, crosses, overlaps, poseOf, move, turn, things, nameOf, wrap,
    canUndo: () => past.length > 0, canRedo: () => future.length > 0,
    listen: listener => listeners.push(listener)
  };
})();
