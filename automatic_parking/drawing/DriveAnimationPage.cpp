#include "automatic_parking/drawing/DriveAnimationPage.h"

namespace parking
{
    const char *const DRIVE_ANIMATION_PAGE = R"PAGE(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>@TITLE@</title>
<style>
  :root { font-family: system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; color: #0f172a; }
  body { margin: 0; background: #eef2f6; }
  main { max-width: 976px; margin: 0 auto; padding: 18px 16px 32px; }
  h1 { font-size: 20px; margin: 0 0 2px; }
  p { margin: 0 0 12px; color: #475569; font-size: 14px; }
  .panel { background: #fff; border: 1px solid #cbd5e1; border-radius: 8px; overflow: hidden; }
  #scene { display: block; width: 100%; height: auto; }
  .controls { display: flex; flex-wrap: wrap; gap: 10px 14px; align-items: center; padding: 10px 12px; font-size: 14px; }
  .controls input[type=range] { flex: 1 1 240px; accent-color: #2563eb; min-width: 0; }
  button, select { font: inherit; padding: 5px 12px; border: 1px solid #94a3b8; border-radius: 6px; background: #f8fafc; }
  button { min-width: 84px; font-weight: 600; cursor: pointer; }
  button:hover { background: #e2e8f0; }
  output { font-variant-numeric: tabular-nums; min-width: 108px; text-align: right; }
  .readings { display: flex; flex-wrap: wrap; gap: 4px 22px; padding: 0 12px 10px; font-size: 14px; color: #334155; }
  .readings b { font-variant-numeric: tabular-nums; font-weight: 600; display: inline-block; min-width: 66px; }
  ul { display: flex; flex-wrap: wrap; gap: 4px 18px; list-style: none; margin: 10px 2px 14px; padding: 0;
       font-size: 13px; color: #334155; }
  li { display: flex; align-items: center; gap: 6px; }
  .plots { display: grid; gap: 10px; }
  .plots svg { display: block; width: 100%; height: auto; cursor: crosshair; }
  .plots text { font-size: 12px; fill: #475569; }
  .plots text.title { font-size: 13px; font-weight: 600; fill: #0f172a; }
</style>
</head>
<body>
<main>
<h1>@TITLE@</h1>
<p>@SUBTITLE@</p>
<div class="panel">
<svg id="scene" viewBox="@VIEW@" role="img" aria-label="The car on the map">
@MAP@
<g transform="@METRES@">
  <path id="track" fill="none" stroke="@DRIVEN@" stroke-width="0.07" stroke-linejoin="round" stroke-linecap="round"/>
  <g id="car"></g>
</g>
</svg>
<div class="controls">
  <button id="play" type="button" aria-label="Play or pause">Play</button>
  <input id="slider" type="range" min="0" max="1000" value="0" step="any" aria-label="Time">
  <output id="clock">0.0 s</output>
  <label>Speed <select id="rate"><option value="0.5">0.5x</option><option value="1">1x</option>
    <option value="2" selected>2x</option><option value="4">4x</option><option value="8">8x</option></select></label>
  <label><input id="follow" type="checkbox"> follow the car</label>
</div>
<div class="readings">
  <span>speed <b id="speed"></b></span><span>acceleration <b id="acceleration"></b></span>
  <span>steering <b id="angle"></b></span><span id="doing"></span>
</div>
</div>
<ul>
@LEGEND@</ul>
<div class="plots" id="plots"></div>
</main>
<script id="data" type="application/json">
@DATA@
</script>
<script>
'use strict';
const drive = JSON.parse(document.getElementById('data').textContent);
const count = drive.t.length, begin = drive.t[0], end = drive.t[count - 1];
const SVG = 'http://www.w3.org/2000/svg';
const byId = id => document.getElementById(id);

function add(parent, name, attributes, text) {
  const element = document.createElementNS(SVG, name);
  for (const key in attributes) element.setAttribute(key, attributes[key]);
  if (text !== undefined) element.textContent = text;
  parent.appendChild(element);
  return element;
}

// The direction of travel at each point; while the car stands, that of the motion to come.
const direction = new Array(count).fill(1);
for (let i = count - 1, last = 1; i >= 0; --i) {
  if (Math.abs(drive.v[i]) > 0.005) last = drive.v[i] < 0 ? -1 : 1;
  direction[i] = last;
}

// The car, in metres, x ahead of the rear axle.
const car = byId('car');
const L = drive.wheelbase, W = drive.width, R = drive.rearOverhang, F = drive.frontOverhang, length = R + L + F;
const wheel = { long: 0.64, wide: 0.22, out: 0.5 * W - 0.15 };
function wheelAt(x, y) {
  const group = add(car, 'g', { transform: `translate(${x} ${y})` });
  const turning = add(group, 'g', {});
  add(turning, 'rect', { x: -wheel.long / 2, y: -wheel.wide / 2, width: wheel.long, height: wheel.wide, rx: 0.06,
                         fill: '#0f172a' });
  return turning;
}
add(car, 'rect', { x: -R, y: -W / 2, width: length, height: W, rx: 0.34, fill: '#dbe7fb', stroke: '#1e3a8a',
                   'stroke-width': 0.06, 'fill-opacity': 0.93 });
wheelAt(0, wheel.out);
wheelAt(0, -wheel.out);
const left = wheelAt(L, wheel.out), right = wheelAt(L, -wheel.out);
const glass = { fill: '#93b4ea', 'fill-opacity': 0.85, stroke: '#1e3a8a', 'stroke-width': 0.03 };
const fit = (x, y) => `${(-R + x * length).toFixed(3)},${(y * W / 2).toFixed(3)}`;
add(car, 'polygon', Object.assign({ points: [fit(0.66, -0.78), fit(0.66, 0.78), fit(0.56, 0.62), fit(0.56, -0.62)].join(' ') }, glass));
add(car, 'polygon', Object.assign({ points: [fit(0.14, -0.7), fit(0.14, 0.7), fit(0.22, 0.6), fit(0.22, -0.6)].join(' ') }, glass));
add(car, 'rect', { x: -R + 0.22 * length, y: -0.31 * W, width: 0.34 * length, height: 0.62 * W, rx: 0.1, fill: '#c3d6f7',
                   stroke: '#1e3a8a', 'stroke-width': 0.03 });
const lamps = { brake: [], reverse: [] };
for (const side of [-1, 1]) {
  add(car, 'rect', { x: L + F - 0.2, y: side * 0.36 * W - 0.17, width: 0.14, height: 0.34, rx: 0.05, fill: '#fde68a' });
  lamps.brake.push(add(car, 'rect', { x: -R + 0.04, y: side * 0.38 * W - 0.16, width: 0.13, height: 0.32, rx: 0.04 }));
  lamps.reverse.push(add(car, 'rect', { x: -R + 0.04, y: side * 0.22 * W - 0.1, width: 0.13, height: 0.2, rx: 0.04 }));
}

function indexAt(time) {
  let low = 0, high = count - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (drive.t[middle] <= time) low = middle; else high = middle;
  }
  return low;
}
const mix = (values, i, share) => values[i] + share * (values[i + 1] - values[i]);
function mixAngle(values, i, share) {
  let turn = values[i + 1] - values[i];
  turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
  return values[i] + share * turn;
}
const degrees = angle => angle * 180 / Math.PI;

// The points of the track, ready to be joined up to any moment.
const points = drive.x.map((x, i) => x.toFixed(3) + ' ' + drive.y[i].toFixed(3));
const scene = byId('scene'), whole = scene.getAttribute('viewBox').split(' ').map(Number);
const metres = car.parentNode.transform.baseVal.consolidate().matrix;

let time = begin, playing = false, stamp = null;

function show() {
  const i = indexAt(time), span = drive.t[i + 1] - drive.t[i];
  const share = span > 0 ? Math.min(1, (time - drive.t[i]) / span) : 1;
  const x = mix(drive.x, i, share), y = mix(drive.y, i, share), yaw = mixAngle(drive.yaw, i, share);
  const v = mix(drive.v, i, share), a = drive.a[i], steering = mix(drive.steering, i, share);
  car.setAttribute('transform', `translate(${x} ${y}) rotate(${degrees(yaw)})`);
  // Both wheels point round the same centre.
  const t = Math.tan(steering), half = wheel.out * t / L;
  left.setAttribute('transform', `rotate(${degrees(Math.atan2(t, 1 - half))})`);
  right.setAttribute('transform', `rotate(${degrees(Math.atan2(t, 1 + half))})`);
  byId('track').setAttribute('d', 'M' + points.slice(0, i + 1).join('L') + `L${x.toFixed(3)} ${y.toFixed(3)}`);
  const standing = Math.abs(v) < 0.005, ahead = direction[standing ? Math.min(i + 1, count - 1) : i];
  const over = time >= end, braking = standing || a * v < -0.02;
  for (const lamp of lamps.brake) lamp.setAttribute('fill', braking ? '#ef4444' : '#7f1d1d');
  for (const lamp of lamps.reverse) lamp.setAttribute('fill', ahead < 0 && !over ? '#ffffff' : '#94a3b8');
  byId('clock').textContent = time.toFixed(1) + ' / ' + end.toFixed(1) + ' s';
  byId('slider').value = 1000 * (time - begin) / (end - begin || 1);
  byId('speed').textContent = v.toFixed(2) + ' m/s';
  byId('acceleration').textContent = (standing ? 0 : a).toFixed(2) + ' m/s\u00b2';
  byId('angle').textContent = degrees(steering).toFixed(1) + '\u00b0';
  byId('doing').textContent = over ? 'stands' : standing ? 'stands, turns its wheels' : ahead < 0 ? 'in reverse' : 'forwards';
  for (const plot of plots) plot.cursor.setAttribute('transform', `translate(${plot.at(time)} 0)`);
  if (byId('follow').checked) {
    const wide = Math.min(whole[2], 22 * drive.scale), high = wide * whole[3] / whole[2];
    const px = metres.a * x + metres.e, py = metres.d * y + metres.f;
    const within = (middle, size, k) => Math.min(whole[k] + whole[k + 2] - size, Math.max(whole[k], middle - size / 2));
    scene.setAttribute('viewBox', `${within(px, wide, 0)} ${within(py, high, 1)} ${wide} ${high}`);
  } else scene.setAttribute('viewBox', whole.join(' '));
}

// Speed, acceleration and steering over time.
function makePlot(title, unit, values, planned, limit, steps) {
  const width = 944, height = 150, l = 52, r = 14, top = 26, bottom = 24, room = 1.15 * limit;
  const panel = document.createElement('div');
  panel.className = 'panel';
  byId('plots').appendChild(panel);
  const svg = document.createElementNS(SVG, 'svg');
  svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
  panel.appendChild(svg);
  const at = time => l + (width - l - r) * (time - begin) / (end - begin || 1);
  const up = value => top + (height - top - bottom) * (0.5 - 0.5 * value / room);
  add(svg, 'text', { x: 12, y: 17, class: 'title' }, title + ', ' + unit);
  for (let i = 0, from = -1; i <= count; ++i) {
    const reverse = i < count && drive.v[i] < -0.001;
    if (reverse && from < 0) from = i;
    if (!reverse && from >= 0) {
      const to = Math.min(i, count - 1);
      add(svg, 'rect', { x: at(drive.t[from]), y: top, width: at(drive.t[to]) - at(drive.t[from]),
                         height: height - top - bottom, fill: '@REVERSE@', 'fill-opacity': 0.09 });
      from = -1;
    }
  }
  for (const value of steps) {
    add(svg, 'path', { d: `M${l} ${up(value)}H${width - r}`, stroke: value ? '#e2e8f0' : '#94a3b8' });
    add(svg, 'text', { x: l - 6, y: up(value) + 4, 'text-anchor': 'end' }, value);
  }
  for (const value of [-limit, limit])
    add(svg, 'path', { d: `M${l} ${up(value)}H${width - r}`, stroke: '#64748b', 'stroke-dasharray': '6 4' });
  const step = [1, 2, 5, 10, 20, 50, 100, 200].find(each => (end - begin) / each <= 12) || 500;
  for (let tick = Math.ceil(begin / step) * step; tick <= end; tick += step)
    add(svg, 'text', { x: at(tick), y: height - 8, 'text-anchor': 'middle' }, tick + ' s');
  add(svg, 'path', { d: 'M' + values.map((value, i) => at(drive.t[i]).toFixed(1) + ' ' + up(value).toFixed(1)).join('L'),
                     fill: 'none', stroke: '@DRIVEN@', 'stroke-width': 1.6, 'stroke-linejoin': 'round' });
  const asked = planned.map((value, i) => at(Math.min(end, drive.plannedT[i])).toFixed(1) + ' ' + up(value).toFixed(1));
  if (asked.length)
    add(svg, 'path', { d: 'M' + asked.join('L'), fill: 'none', stroke: '#0f172a', 'stroke-width': 1,
                       'stroke-dasharray': '5 3' });
  const cursor = add(svg, 'path', { d: `M0 ${top}V${height - bottom}`, stroke: '@FORWARD@', 'stroke-width': 1.5 });
  const seek = event => {
    if (event.buttons !== 1) return;
    const box = svg.getBoundingClientRect();
    const share = ((event.clientX - box.left) / box.width * width - l) / (width - l - r);
    go(begin + Math.min(1, Math.max(0, share)) * (end - begin));
  };
  svg.addEventListener('pointerdown', seek);
  svg.addEventListener('pointermove', seek);
  return { cursor, at };
}
const plots = [
  makePlot('Speed', 'm/s', drive.v, drive.plannedV, drive.maxSpeed,
           [-2, -1, 0, 1, 2].filter(v => Math.abs(v) <= drive.maxSpeed)),
  makePlot('Acceleration', 'm/s\u00b2', drive.a, drive.plannedA, drive.maxAcceleration,
           [-1, -0.5, 0, 0.5, 1].filter(v => Math.abs(v) <= drive.maxAcceleration)),
  makePlot('Steering angle', 'degrees', drive.steering.map(degrees), drive.plannedSteering.map(degrees),
           degrees(drive.maxSteering), [-40, -20, 0, 20, 40].filter(v => Math.abs(v) <= degrees(drive.maxSteering)))];

function go(to) {
  time = Math.min(end, Math.max(begin, to));
  show();
}
function play(on) {
  if (on && time >= end) time = begin;
  playing = on;
  stamp = null;
  byId('play').textContent = on ? 'Pause' : time >= end ? 'Replay' : 'Play';
  if (on) requestAnimationFrame(frame);
}
function frame(now) {
  if (!playing) return;
  if (stamp !== null) go(time + Math.min(0.25, (now - stamp) / 1000) * Number(byId('rate').value));
  stamp = now;
  if (time >= end) play(false); else requestAnimationFrame(frame);
}
byId('play').addEventListener('click', () => play(!playing));
byId('slider').addEventListener('input', event => { play(false); go(begin + event.target.value / 1000 * (end - begin)); play(false); });
byId('follow').addEventListener('change', show);
document.addEventListener('keydown', event => {
  if (event.target.tagName === 'SELECT' || event.target.type === 'range') return;
  if (event.key === ' ' && event.target.tagName !== 'BUTTON' && event.target.type !== 'checkbox') play(!playing);
  else if (event.key === 'ArrowRight') go(time + 0.5);
  else if (event.key === 'ArrowLeft') go(time - 0.5);
  else return;
  if (event.target.tagName !== 'BUTTON') event.preventDefault();
});
// A moment may be asked for in the address: page.html#t=12.5
const asked = /^#t=([0-9.]+)$/.exec(location.hash);
go(asked ? Number(asked[1]) : begin);
</script>
</body>
</html>
)PAGE";
}  // namespace parking
