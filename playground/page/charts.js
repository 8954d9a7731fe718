// Small charts below the scene: curvature and clearance along the path, speed and steering along the drive.

const Charts = (() => {
  const axes = new Map();  // of the canvases: [first, last, pixels before, pixels after]

  // What lies under the pointer on a chart's axis: metres of the path or seconds of the drive; null beside it.
  function under(canvas, event) {
    const axis = axes.get(canvas), box = canvas.getBoundingClientRect();
    if (!axis) return null;
    const [first, last, before, after] = axis;
    return first + (last - first) * Math.min(1, Math.max(0, (event.clientX - box.left - before) / (box.width - before - after)));
  }

  // Without a path a chart is empty.
  function empty(canvas, words) {
    const box = canvas.getBoundingClientRect(), ratio = devicePixelRatio || 1;
    axes.delete(canvas);
    canvas.width = Math.round(box.width * ratio); canvas.height = Math.round(box.height * ratio);
    const c = canvas.getContext('2d');
    c.scale(ratio, ratio);
    c.font = '12px system-ui, sans-serif'; c.fillStyle = Draw.palette.soft; c.textAlign = 'center';
    c.fillText(words, box.width / 2, box.height / 2);
  }

  function chart(canvas, title, unit, xs, ys, options = {}) {
    const box = canvas.getBoundingClientRect(), ratio = devicePixelRatio || 1, width = box.width, height = box.height, p = Draw.palette;
    if (!width || !height) return;
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
    const c = canvas.getContext('2d');
    c.scale(ratio, ratio);
    c.clearRect(0, 0, width, height);
    const l = 46, r = 10, t = 22, b = 18, x0 = xs[0] || 0, x1 = xs[xs.length - 1] || 1;
    const low = options.low === undefined ? Math.min(0, ...ys) : options.low, high = options.high === undefined ? Math.max(1e-9, ...ys) : options.high;
    axes.set(canvas, [x0, x1, l, r]);
    const at = x => l + (width - l - r) * (x - x0) / (x1 - x0 || 1), up = y => t + (height - t - b) * (1 - (Math.min(high, Math.max(low, y)) - low) / (high - low || 1));
    c.font = '600 12px system-ui, sans-serif'; c.fillStyle = p.ink; c.textAlign = 'left'; c.fillText(`${title}, ${unit}`, 10, 14);
    c.font = '11px system-ui, sans-serif'; c.fillStyle = p.soft;
    for (const value of options.ticks || [low, high]) {
      c.strokeStyle = p.grid; c.beginPath(); c.moveTo(l, up(value)); c.lineTo(width - r, up(value)); c.stroke();
      c.textAlign = 'right'; c.fillText(String(Math.round(value * 100) / 100), l - 5, up(value) + 4);
    }
    for (const value of options.limits || []) { c.strokeStyle = p.bad; c.setLineDash([5, 4]); c.beginPath(); c.moveTo(l, up(value)); c.lineTo(width - r, up(value)); c.stroke(); c.setLineDash([]); }
    c.textAlign = 'center';
    const step = [0.5, 1, 2, 5, 10, 20, 50, 100].find(each => (x1 - x0) / each <= width / 60) || 200;
    for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) c.fillText(`${x}${options.x || ' m'}`, Math.min(width - 16, at(x)), height - 5);
    if (options.reverse) {
      c.fillStyle = p.reverse; c.globalAlpha = 0.1;
      for (let i = 1, from = -1; i <= xs.length; ++i) {
        if (i < xs.length && options.reverse[i]) { if (from < 0) from = i - 1; continue; }
        if (from >= 0) c.fillRect(at(xs[from]), t, at(xs[i - 1]) - at(xs[from]), height - t - b);
        from = -1;
      }
      c.globalAlpha = 1;
    }
    c.strokeStyle = options.stroke || p.accent; c.lineWidth = 1.8; c.lineJoin = 'round'; c.beginPath();
    xs.forEach((x, i) => { if (i && !options.steps) c.lineTo(at(x), up(ys[i])); else if (i) { c.lineTo(at(xs[i - 1]), up(ys[i])); c.lineTo(at(x), up(ys[i])); } else c.moveTo(at(x), up(ys[i])); });
    c.stroke();
    if (typeof options.cursor === 'number') { c.strokeStyle = p.drive; c.lineWidth = 2; c.beginPath(); c.moveTo(at(options.cursor), t); c.lineTo(at(options.cursor), height - b); c.stroke(); }
  }

  function path(first, second, numbers, vehicle, cursor) {
    const states = Draw.rows(numbers, 7), s = states.map(each => each[5]), most = Math.tan(vehicle.max_steering_angle) / vehicle.wheelbase, reverse = states.map(each => each[3] < 0);
    chart(first, 'Curvature', '1/m', s, states.map(each => each[4]), { low: -1.2 * most, high: 1.2 * most, limits: [-most, most], ticks: [-most, 0, most], reverse, steps: true, cursor });
    chart(second, 'Clearance to the nearest obstacle', 'm', s, states.map(each => each[6]), { low: 0, high: 1, ticks: [0, 0.5, 1], reverse, stroke: Draw.palette.goal, cursor });
  }
  function drive(first, second, numbers, vehicle, time) {
    const points = Draw.rows(numbers, 8), t = points.map(each => each[0]), reverse = points.map(each => each[4] < -1e-3), degrees = 180 / Math.PI, lock = vehicle.max_steering_angle * degrees;
    chart(first, 'Speed', 'm/s', t, points.map(each => each[4]), { low: -1.15 * vehicle.max_speed, high: 1.15 * vehicle.max_speed, limits: [-vehicle.max_speed, vehicle.max_speed], ticks: [-vehicle.max_speed, 0, vehicle.max_speed], reverse, cursor: time, x: ' s', stroke: Draw.palette.drive });
    chart(second, 'Steering', 'degrees', t, points.map(each => each[6] * degrees), { low: -1.15 * lock, high: 1.15 * lock, limits: [-lock, lock], ticks: [-lock, 0, lock], reverse, cursor: time, x: ' s', stroke: Draw.palette.accent });
  }
  return { path, drive, empty, under };
})();
