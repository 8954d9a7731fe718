// Draws the scene: world, cars, search trees, paths.

const Draw = (() => {
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  let palette = {};
  function refresh() {
    for (const name of ['ground', 'grid', 'obstacle', 'obstacle-edge', 'unknown', 'forward', 'reverse', 'goal', 'slot', 'car', 'car-edge', 'glass', 'ink', 'soft', 'tree-start', 'tree-goal', 'drive', 'accent', 'bad', 'bad-fill']) palette[name] = colour(name);
    mapPictures.clear();
  }
  const mapPictures = new Map();
  const rows = (numbers, width) => { const found = []; for (let i = 0; i + width <= numbers.length; i += width) found.push(numbers.subarray(i, i + width)); return found; };

  function mapPicture(map) {
    if (!mapPictures.has(map.id)) {
      const canvas = document.createElement('canvas'), rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16));
      canvas.width = map.columns; canvas.height = map.rows;
      const context = canvas.getContext('2d'), image = context.createImageData(map.columns, map.rows);
      const shades = [[0, 0, 0, 0], [...rgb(palette['obstacle-edge']), 255], [...rgb(palette.unknown), 255]];
      for (let row = 0; row < map.rows; ++row)
        for (let column = 0; column < map.columns; ++column)
          image.data.set(shades[map.cells[row * map.columns + column]], 4 * ((map.rows - 1 - row) * map.columns + column));
      context.putImageData(image, 0, 0);
      mapPictures.set(map.id, canvas);
    }
    return mapPictures.get(map.id);
  }

  function metres(painter) {
    const { view, width, height } = painter, step = [0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500].find(each => each * view.scale > 44) || 1000;
    const w = width / 2 / view.scale, h = height / 2 / view.scale, lines = [];
    for (let x = Math.ceil((view.x - w) / step) * step; x <= view.x + w; x += step) lines.push([[x, view.y - h], [x, view.y + h]]);
    for (let y = Math.ceil((view.y - h) / step) * step; y <= view.y + h; y += step) lines.push([[view.x - w, y], [view.x + w, y]]);
    painter.segments(lines, { stroke: palette.grid, width: 1 });
    return step;
  }

  // The distance to the nearest obstacle as a picture of one point per pixel. field: columns, rows, spacing, x, y, metres row by row.
  const MOST_DISTANCE = 4;  // metres; farther points look alike
  const fieldPictures = new WeakMap();
  function fieldPicture(field) {
    if (!fieldPictures.has(field)) {
      const [columns, rows] = field, canvas = document.createElement('canvas');
      canvas.width = columns; canvas.height = rows;
      const context = canvas.getContext('2d'), image = context.createImageData(columns, rows);
      // The colours of hsl(hue 82% 48%), as in the legend.
      const tone = (k, hue) => { const n = (k + hue / 30) % 12; return Math.round(255 * (0.48 - 0.3936 * Math.max(-1, Math.min(n - 3, 9 - n, 1)))); };
      for (let row = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
          const hue = 10 + 200 * Math.min(1, field[5 + row * columns + column] / MOST_DISTANCE);
          image.data.set([tone(0, hue), tone(8, hue), tone(4, hue), 100], 4 * ((rows - 1 - row) * columns + column));
        }
      context.putImageData(image, 0, 0);
      fieldPictures.set(field, canvas);
    }
    return fieldPictures.get(field);
  }
  function distances(painter, field) {
    const [, rows, spacing, x, y] = field;
    painter.image(fieldPicture(field), [x - spacing / 2, y - spacing / 2, 0], spacing, rows, true);
  }

  // Bodies: outlines of poses that must not touch an obstacle but do.
  function world(painter, scene, bounds, selected, bodies = []) {
    if (scene.map) painter.image(mapPicture(scene.map), scene.map.origin, scene.map.resolution, scene.map.rows);
    scene.polygons.forEach((polygon, index) => {
      const wrong = polygon.length > 2 && Scene.crosses(polygon), chosen = selected && selected.kind === 'polygon' && selected.index === index;
      const hit = bodies.some(body => Scene.overlaps(body, polygon));
      painter.shape(polygon, { fill: wrong ? palette.bad : hit ? palette['bad-fill'] : palette.obstacle, stroke: chosen ? palette.accent : hit ? palette.bad : palette['obstacle-edge'], width: chosen ? 2.5 : hit ? 2 : 1.2 });
    });
    if (bounds && bounds.length === 4 && !scene.map) {
      const [a, b, c, d] = bounds;
      painter.shape([[a, b], [c, b], [c, d], [a, d]], { stroke: palette.soft, width: 1, dash: [6, 6], opacity: 0.6 });
    }
    if (scene.slot) painter.shape(Scene.slotOutline(scene.slot), { fill: palette.slot, stroke: palette.goal, width: 2, dash: [8, 5] });
  }

  const local = ([x, y, yaw], points) => { const c = Math.cos(yaw), s = Math.sin(yaw); return points.map(([a, b]) => [x + c * a - s * b, y + s * a + c * b]); };
  function rounded(back, front, half, radius) {
    const points = [];
    for (const [cx, cy, from] of [[front - radius, half - radius, 0], [back + radius, half - radius, 1], [back + radius, -half + radius, 2], [front - radius, -half + radius, 3]])
      for (let k = 0; k <= 5; ++k) { const angle = (from + k / 5) * Math.PI / 2; points.push([cx + radius * Math.cos(angle), cy + radius * Math.sin(angle)]); }
    return points;
  }

  // A car seen from above. Style: {steering, edge, fill, opacity, brake, reverse}.
  function car(painter, vehicle, pose, looks = {}) {
    const L = vehicle.wheelbase, R = vehicle.rear_overhang, F = vehicle.front_overhang, W = vehicle.width, length = R + L + F, opacity = looks.opacity === undefined ? 1 : looks.opacity;
    const edge = looks.edge || palette['car-edge'], outline = vehicle.outline, out = outline ? 0.35 * W : W / 2 - 0.15, fit = (u, v) => [-R + u * length, v * W / 2], t = Math.tan(looks.steering || 0), half = out * t / L;
    painter.shape(local(pose, outline || rounded(-R, L + F, W / 2, Math.min(0.34, 0.2 * W))), { fill: looks.fill || palette.car, stroke: edge, width: looks.chosen ? 3 : 1.6, opacity });
    const wheel = (x, y, angle) => painter.shape(local(local(pose, [[x, y]]).map(([u, v]) => [u, v, pose[2] + angle])[0], [[-0.32, -0.11], [0.32, -0.11], [0.32, 0.11], [-0.32, 0.11]]), { fill: palette.ink, opacity });
    for (const side of [-1, 1]) { wheel(0, side * out, 0); wheel(L, side * out, Math.atan2(t, 1 - side * half)); }
    const glass = { fill: palette.glass, opacity: 0.85 * opacity };
    if (outline) {  // an arrow from the fixed to the steered axle instead of windows and lamps, which need not fit
      painter.shape(local(pose, [[0.5 * L, -0.15 * W], [0.8 * L, 0], [0.5 * L, 0.15 * W]]), glass);
      painter.disc([pose[0], pose[1]], 2.5, { fill: edge, opacity });
      return;
    }
    painter.shape(local(pose, [fit(0.66, -0.78), fit(0.66, 0.78), fit(0.56, 0.62), fit(0.56, -0.62)]), glass);
    painter.shape(local(pose, [fit(0.14, -0.7), fit(0.14, 0.7), fit(0.22, 0.6), fit(0.22, -0.6)]), glass);
    for (const side of [-1, 1]) {
      painter.shape(local(pose, [[L + F - 0.2, side * 0.36 * W - 0.15], [L + F - 0.06, side * 0.36 * W - 0.15], [L + F - 0.06, side * 0.36 * W + 0.15], [L + F - 0.2, side * 0.36 * W + 0.15]]), { fill: '#fde68a', opacity });
      painter.shape(local(pose, [[-R + 0.04, side * 0.38 * W - 0.16], [-R + 0.17, side * 0.38 * W - 0.16], [-R + 0.17, side * 0.38 * W + 0.16], [-R + 0.04, side * 0.38 * W + 0.16]]), { fill: looks.brake ? '#ef4444' : '#7f1d1d', opacity });
      if (looks.reverse) painter.shape(local(pose, [[-R + 0.04, side * 0.2 * W - 0.1], [-R + 0.16, side * 0.2 * W - 0.1], [-R + 0.16, side * 0.2 * W + 0.1], [-R + 0.04, side * 0.2 * W + 0.1]]), { fill: '#ffffff', opacity });
    }
    painter.disc([pose[0], pose[1]], 2.5, { fill: edge, opacity });
  }

  // The handle for turning, ahead of the object.
  function handleOf(scene, thing) {
    if (thing.kind === 'polygon') { const m = Scene.middle(scene.polygons[thing.index]); return [m[0], m[1] + Math.max(...scene.polygons[thing.index].map(([x, y]) => Math.hypot(x - m[0], y - m[1]))) + 0.9]; }
    const [x, y, yaw] = Scene.poseOf(thing), reach = thing.kind === 'slot' ? scene.slot.length / 2 + 1 : scene.vehicle.wheelbase + scene.vehicle.front_overhang + 1;
    return [x + reach * Math.cos(yaw), y + reach * Math.sin(yaw)];
  }

  function handles(painter, scene, thing) {
    if (!thing) return;
    const at = handleOf(scene, thing), pose = Scene.poseOf(thing);
    painter.segments([[[pose[0], pose[1]], at]], { stroke: palette.accent, width: 1.5, dash: [3, 4] });
    painter.disc(at, 8, { fill: palette.ground, stroke: palette.accent, width: 2.5 });
    painter.text(at, '\u21bb', { fill: palette.accent, font: '700 11px system-ui, sans-serif' });
    if (thing.kind === 'polygon') for (const corner of scene.polygons[thing.index]) painter.disc(corner, 5, { fill: palette.ground, stroke: palette.accent, width: 2 });
  }

  // One of the two trees at a time of the search; the nodes' remaining costs as shades, open nodes as dots.
  function tree(painter, numbers, count, stroke, options) {
    const nodes = rows(numbers, 9).slice(0, count), faint = [], last = [];
    let most = 1e-9;
    for (const node of nodes) if (Number.isFinite(node[7])) most = Math.max(most, node[7]);
    nodes.forEach((node, index) => {
      const parent = nodes[node[3]];
      if (!parent || node[3] === index) return;
      const steps = Math.max(1, Math.ceil(Math.abs(node[5] * node[4]) / 0.35)), line = [[parent[0], parent[1]]];
      if (node[4] !== 0 && steps > 0) for (let k = 1; k < steps; ++k) {
        const d = node[5] * k / steps, h = 0.5 * node[4] * d, chord = Math.abs(h) < 1e-6 ? d : d * Math.sin(h) / h;
        line.push([parent[0] + chord * Math.cos(parent[2] + h), parent[1] + chord * Math.sin(parent[2] + h)]);
      }
      line.push([node[0], node[1]]);
      const into = index > nodes.length - 1 - options.fresh ? last : faint;
      for (let k = 1; k < line.length; ++k) into.push([line[k - 1], line[k]]);
    });
    painter.segments(faint, { stroke, width: 1, opacity: 0.5 });
    painter.segments(last, { stroke, width: 2.2, opacity: 1 });
    if (options.heuristic)
      for (const node of nodes) { const share = Number.isFinite(node[7]) ? node[7] / most : 1; painter.disc([node[0], node[1]], 2.6, { fill: `hsl(${Math.round(200 - 190 * share)} 85% 52%)`, opacity: 0.9 }); }
    else for (const node of nodes) if (!node[8]) painter.disc([node[0], node[1]], 1.7, { fill: stroke, opacity: 0.9 });
  }

  // The way from a tree's root to one of its nodes.
  function branch(painter, numbers, index) {
    const nodes = rows(numbers, 9), line = [];
    for (let at = index; nodes[at]; at = nodes[at][3]) {
      line.push([nodes[at][0], nodes[at][1]]);
      if (nodes[at][3] === at) break;
    }
    painter.shape(line, { stroke: palette.ink, width: 2, opacity: 0.8 }, false);
    painter.disc(line[0], 6, { stroke: palette.ink, width: 2.2 });
  }

  function path(painter, numbers, options = {}) {
    const states = rows(numbers, 7);
    let begin = 0;
    for (let k = 1; k <= states.length; ++k)
      if (k === states.length || states[k][3] !== states[begin + 1][3]) {
        painter.shape(states.slice(begin, k).map(each => [each[0], each[1]]), { stroke: palette.ground, width: 6, opacity: 0.8 }, false);
        painter.shape(states.slice(begin, k).map(each => [each[0], each[1]]), { stroke: states[begin + 1 < states.length ? begin + 1 : begin][3] > 0 ? palette.forward : palette.reverse, width: 3, opacity: options.opacity }, false);
        begin = k - 1;
      }
    for (let k = 1; k + 1 < states.length; ++k) if (states[k][3] !== states[k + 1][3]) painter.disc([states[k][0], states[k][1]], 3.5, { fill: palette.ground, stroke: palette.ink, width: 1.5 });
  }

  function footprints(painter, vehicle, numbers, disc) {
    const states = rows(numbers, 7);
    let last = -1e9;
    states.forEach((state, k) => {
      const cusp = k > 0 && k + 1 < states.length && state[3] !== states[k + 1][3];
      if (state[5] - last < 0.8 && !cusp) return;
      last = state[5];
      if (disc) painter.disc([state[0], state[1]], disc, { stroke: palette['car-edge'], width: 1, opacity: 0.3 }, true);
      else painter.shape(Scene.footprint(vehicle, [state[0], state[1], state[2]]), { stroke: palette['car-edge'], width: 1, opacity: cusp ? 0.55 : 0.28 });
    });
  }

  // Clearance along the path: the smaller, the redder.
  function clearance(painter, numbers) {
    for (const state of rows(numbers, 7)) {
      const share = Math.min(1, Math.max(0, state[6] / 0.8));
      painter.disc([state[0], state[1]], 4.2, { fill: `hsl(${Math.round(130 * share)} 80% 45%)`, opacity: 0.75 });
    }
  }

  return { refresh, palette, rows, metres, world, car, handles, handleOf, tree, branch, path, footprints, clearance, distances, MOST_DISTANCE };
})();
