"""The page's figures, as SVG files."""
import json
import math
import os
import re
from html import escape as text

from design import KEYS
from factorial import NAMES
from published import ALGORITHMS
from database import ReportError
from study import MEASURES
from write_whole import write_whole

COLOURS = ('#0072b2', '#d55e00', '#009e73', '#cc79a7', '#56b4e9', '#e69f00')
DRIVES = {'Basic_A*': 'drive_basic_astar.json', 'Improved_A*': 'drive_improved_astar.json'}
STEP = 0.1  # metres between the points of a drawn path


def svg(width, height, body):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" '
            f'height="{height:.0f}" font-family="sans-serif" font-size="12">\n'
            f'<rect width="100%" height="100%" fill="white"/>\n' + '\n'.join(body) + '\n</svg>\n')


def label(x, y, words, anchor='start', more=''):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{text(words)}</text>'


def effects_figure(effects, measures=('total', 'cells', 'expanded', 'length', 'turning')):
    """Main effects with their intervals on a logarithmic axis; one panel for each figure."""
    names = list(effects)
    panel, left, row = 300.0, 175.0, 17.0
    height = 40.0 + row * len(KEYS) * len(names)
    body = []
    for index, measure in enumerate(measures):
        x0 = left + (panel + 20.0) * (index % 2)
        y0 = 30.0 + (height + 30.0) * (index // 2)
        shown = [effects[name][measure][(key,)] for key in KEYS for name in names]
        widest = max([1.2] + [max(each.high, 1.0 / each.low) for each in shown if each.certain and each.low > 0.0])
        scale = 0.5 * panel / math.log(widest * 1.1)

        def place(value, x0=x0, scale=scale):
            return x0 + 0.5 * panel + scale * math.log(value)
        bottom = y0 + row * len(KEYS) * len(names) + 6.0
        body.append(label(x0 + 0.5 * panel, y0 - 10.0, MEASURES[measure][0].split(',')[0], 'middle', ' font-weight="bold"'))
        body.append(f'<path d="M{place(1.0):.1f} {y0 - 4:.1f}V{bottom:.1f}" stroke="#888"/>')
        for tick in (0.01, 0.1, 0.5, 0.8, 0.9, 1.0, 1.1, 1.25, 2.0, 10.0, 100.0):
            if x0 <= place(tick) <= x0 + panel and (abs(place(tick) - place(1.0)) > 24.0 or tick == 1.0):
                body.append(f'<path d="M{place(tick):.1f} {bottom - 4:.1f}v4" stroke="#888"/>')
                body.append(label(place(tick), bottom + 11.0, f'{tick:g}', 'middle', ' font-size="10"'))
        for k, key in enumerate(KEYS):
            for n, name in enumerate(names):
                y = y0 + row * (k * len(names) + n) + 8.0
                effect = effects[name][measure][(key,)]
                if n == 0 and index % 2 == 0:
                    body.append(label(left - 8.0, y + 4.0 + 0.5 * row * (len(names) - 1), NAMES[key], 'end'))
                if not effect.ratios:
                    continue
                if effect.certain:
                    body.append(f'<path d="M{place(effect.low):.1f} {y:.1f}H{place(effect.high):.1f}" '
                                f'stroke="{COLOURS[n]}" stroke-width="2"/>')
                body.append(f'<circle cx="{place(effect.middle):.1f}" cy="{y:.1f}" r="3.5" fill="{COLOURS[n]}"/>')
    bottom = 30.0 + (height + 30.0) * math.ceil(len(measures) / 2)
    for n, name in enumerate(names):
        body.append(f'<circle cx="{left + 150.0 * n + 5.0:.1f}" cy="{bottom - 12.0:.1f}" r="3.5" fill="{COLOURS[n]}"/>')
        body.append(label(left + 150.0 * n + 14.0, bottom - 8.0, name))
    return svg(left + 2.0 * panel + 40.0, bottom, body)


def points_of(path):
    """Points along a path as runs.jsonl keeps it."""
    x, y, yaw = path['start']
    points = [(x, y)]
    for piece in path['pieces']:
        if len(piece) == 1:
            yaw += piece[0]
            continue
        steps = max(1, int(abs(piece[1]) / STEP))
        step = piece[1] / steps
        for k in range(steps):
            curvature = piece[0] + (piece[2] * (k + 0.5) * step if len(piece) == 3 else 0.0)
            middle = yaw + 0.5 * curvature * step
            x, y, yaw = x + step * math.cos(middle), y + step * math.sin(middle), yaw + curvature * step
            points.append((x, y))
    return points


def read_pgm(file):
    """(width, height, rows from the top) of a map as make_maps writes it."""
    try:
        with open(file, 'rb') as stream:
            kind, size, most, pixels = stream.read().split(b'\n', 3)
        width, height = (int(word) for word in size.split())
        if kind != b'P5' or most != b'255' or len(pixels) != width * height:
            raise ValueError
    except (OSError, ValueError) as error:
        raise ReportError(f'{file}: is no map as make_maps writes it') from error
    return width, height, [pixels[width * k:width * (k + 1)] for k in range(height)]


def pose_in(file, key):
    """A pose of a scenario file, as [x, y, yaw]."""
    try:
        with open(file, encoding='utf-8') as stream:
            found = re.search(rf'^{key}: \[([^\]]*)\]', stream.read(), re.MULTILINE)
    except OSError as error:
        raise ReportError(f'{file}: cannot be read: {error.strerror}') from error
    if not found:
        raise ReportError(f'{file}: has no {key}')
    return [float(word) for word in found.group(1).split(',')]


def map_body(rows, cell, bounds, scale):
    """What is not free as grey rectangles, in pixels; bounds: x0, y0, x1, y1 in metres about the map's middle."""
    half = 0.5 * cell * len(rows)
    body = []
    for k, row in enumerate(rows):
        y = half - (k + 1) * cell
        if not bounds[1] <= y < bounds[3]:
            continue
        begin = None
        first, last = (int((bounds[i] + half) / cell) for i in (0, 2))
        for column in range(first, last + 1):
            blocked = column < last and row[column] != 254
            if blocked and begin is None:
                begin = column
            elif not blocked and begin is not None:
                body.append(f'M{scale * (begin - first) * cell:.1f} {scale * (bounds[3] - y - cell):.1f}'
                            f'h{scale * (column - begin) * cell:.1f}v{scale * cell:.1f}'
                            f'h{-scale * (column - begin) * cell:.1f}z')
                begin = None
    return '<path fill="#c8c8c8" d="' + ''.join(body) + '"/>'


def paths_figure(results, map_file, start, cell=0.5, scale=7.0, problem='perpendicular_approach'):
    """The paths of all eight algorithms on one map, a panel each. They are kept in coordinates of their own; start is
    where they begin on the map."""
    rows = read_pgm(map_file)[2]
    drawn = {}
    for name in ALGORITHMS:
        path = next((run.path for run in results.of(problem, name) if run.path and run.path.get('pieces')), None)
        if path:
            drawn[name] = [(x - path['start'][0] + start[0], y - path['start'][1] + start[1]) for x, y in points_of(path)]
    if not drawn:
        raise ReportError(f'{results.folder}: holds no paths')
    every = [point for points in drawn.values() for point in points]
    bounds = [math.floor(min(p[0] for p in every)) - 4.0, math.floor(min(p[1] for p in every)) - 3.0,
              math.ceil(max(p[0] for p in every)) + 4.0, math.ceil(max(p[1] for p in every)) + 7.0]
    width, height = scale * (bounds[2] - bounds[0]), scale * (bounds[3] - bounds[1])
    ground = map_body(rows, cell, bounds, scale)
    body = [f'<defs><g id="map">{ground}</g></defs>']
    for index, name in enumerate(ALGORITHMS):
        x0, y0 = 10.0 + (width + 12.0) * (index % 4), 22.0 + (height + 30.0) * (index // 4)
        body.append(label(x0, y0 - 6.0, name.replace('_', ' ')))
        body.append(f'<g transform="translate({x0:.1f} {y0:.1f})"><use href="#map"/>')
        if name in drawn:
            line = ' '.join(f'{scale * (x - bounds[0]):.1f},{scale * (bounds[3] - y):.1f}' for x, y in drawn[name][::2])
            body.append(f'<polyline points="{line}" fill="none" stroke="{COLOURS[0]}" stroke-width="2"/>')
        body.append(f'<rect width="{width:.1f}" height="{height:.1f}" fill="none" stroke="#888"/></g>')
    return svg(20.0 + 4.0 * (width + 12.0), 30.0 + 2.0 * (height + 30.0), body)


def read_drive(file):
    """[(t, acceleration, steering in degrees)] of what parking_plan --track has written."""
    try:
        with open(file, encoding='utf-8') as stream:
            drive = [(state['t'], state['acceleration'], math.degrees(state['steering']))
                     for state in json.load(stream)['trajectory']]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ReportError(f'{file}: holds no drive of parking_plan ({error})') from error
    if not drive:
        raise ReportError(f'{file}: holds no drive of parking_plan')
    return drive


def drives_figure(drives, width=700.0, height=170.0):
    """Acceleration and steering over time. drives: {algorithm: read_drive()}."""
    left, longest = 60.0, max(drive[-1][0] for drive in drives.values())
    body = []
    for index, (heading, most) in enumerate((('acceleration, m/s²', 2.0), ('steering, °', 40.0))):
        top = 20.0 + (height + 50.0) * index
        body.append(f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>')
        body.append(label(left, top - 6.0, heading))
        for k in (-1.0, -0.5, 0.0, 0.5, 1.0):
            body.append(label(left - 5.0, top + 0.5 * height * (1.0 - k) + 4.0, f'{k * most:g}', 'end'))
        body.append(f'<path d="M{left} {top + 0.5 * height}h{width}" stroke="#ccc"/>')
        for k in range(6):
            body.append(label(left + width * k / 5, top + height + 14.0, f'{longest * k / 5:.0f} s', 'middle'))
        for colour, drive in zip(COLOURS, drives.values()):
            # The greatest and the least of each pixel are drawn: no peak is lost.
            columns = {}
            for state in drive:
                columns.setdefault(int(width * state[0] / longest), []).append(max(-most, min(most, state[1 + index])))
            points = ' '.join(f'{left + x:.0f},{top + 0.5 * height * (1.0 - value / most):.1f}'
                              for x, values in sorted(columns.items()) for value in dict.fromkeys((min(values), max(values))))
            body.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.2"/>')
    bottom = 20.0 + 2.0 * (height + 50.0)
    for n, name in enumerate(drives):
        body.append(f'<path d="M{left + 150 * n} {bottom - 14}h18" stroke="{COLOURS[n]}" stroke-width="2"/>')
        body.append(label(left + 150.0 * n + 24.0, bottom - 10.0, name.replace('_', ' ')))
    return svg(left + width + 20.0, bottom, body)


def write_all(folder, images, fixed, effects):
    """Writes the figures into the folder images."""
    drives = {name: read_drive(os.path.join(folder, file)) for name, file in DRIVES.items()}
    try:
        os.makedirs(images, exist_ok=True)
    except OSError as error:
        raise ReportError(f'{images}: cannot be made: {error.strerror}') from error
    here = os.path.dirname(os.path.abspath(__file__))
    write_whole(os.path.join(images, 'paper-effects.svg'), effects_figure(effects))
    maps = os.path.join(here, '..', 'maps')
    write_whole(os.path.join(images, 'paper-paths.svg'),
                paths_figure(fixed['perpendicular'], os.path.join(maps, 'perpendicular.pgm'),
                             pose_in(os.path.join(maps, 'perpendicular_approach.yaml'), 'start')))
    write_whole(os.path.join(images, 'paper-drives.svg'), drives_figure(drives))
