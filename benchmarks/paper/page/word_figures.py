"""The figures of the page of the paper at its word, as SVG files."""
import math
import os
import struct

from figures import COLOURS, drives_figure, label, svg
from database import ReportError
from word_design import SCENARIOS
from word_study import read_runs
from write_whole import write_whole

SHOWN = ('basic_astar', 'improved_astar')
CELL, HALF = 0.5, 50.0
GROUND = 4  # layer; what stands higher is an obstacle


def occupied_of(file):
    """(x, y) of the cells of a map of make_random_maps --voxels in which something stands."""
    try:
        with open(file, 'rb') as stream:
            content = stream.read()
    except OSError as error:
        raise ReportError(f'{file}: cannot be read: {error.strerror}') from error
    if content[:6] != b'\x93NUMPY' or len(content) < 10:
        raise ReportError(f'{file}: is no .npy')
    begin = 10 + struct.unpack('<H', content[8:10])[0]
    return {(column, row) for column, row, layer, _ in struct.iter_unpack('<4q', content[begin:]) if layer > GROUND}


def polyline(points, place, style):
    return '<polyline points="' + ' '.join('{:.1f},{:.1f}'.format(*place(*point)) for point in points) + f'" fill="none" {style}/>'


def start_of(file):
    with open(file, encoding='utf-8') as stream:
        line = next(line for line in stream if line.startswith('start:'))
    return [float(word) for word in line.split('[')[1].split(']')[0].split(',')]


def panel(run, cells, start, x0, y0, scale):
    """Points are relative to the scenario's start. Returns (body, width, height)."""
    ways = run['curve'] + [state[1:3] for state in run['drive']['states']]
    low = [min(point[k] for point in ways) - 4.0 for k in (0, 1)]
    high = [max(point[k] for point in ways) + 4.0 for k in (0, 1)]
    width, height = scale * (high[0] - low[0]), scale * (high[1] - low[1])

    def place(x, y):
        return x0 + scale * (x - low[0]), y0 + scale * (high[1] - y)
    body = []
    for column, row in sorted(cells):
        x, y = column * CELL - HALF - start[0], row * CELL - HALF - start[1]
        if low[0] <= x <= high[0] - CELL and low[1] <= y <= high[1] - CELL:
            px, py = place(x, y + CELL)
            body.append(f'M{px:.1f} {py:.1f}h{scale * CELL:.1f}v{scale * CELL:.1f}h{-scale * CELL:.1f}z')
    return ['<path fill="#c8c8c8" d="' + ''.join(body) + '"/>',
            polyline(run['corners'], place, 'stroke="#888"'),
            polyline(run['curve'][::2], place, f'stroke="{COLOURS[0]}" stroke-width="2"'),
            polyline([state[1:3] for state in run['drive']['states'][::2]], place,
                     f'stroke="{COLOURS[1]}" stroke-width="1.5" stroke-dasharray="2 2"'),
            f'<rect x="{x0:.1f}" y="{y0:.1f}" width="{width:.1f}" height="{height:.1f}" fill="none" stroke="#888"/>'], width, height


def ways_figure(runs, folder, scale=7.0):
    """runs: {scenario: {algorithm: run with its lines}}."""
    body, y0, widest = [], 22.0, 0.0
    for scenario, found in runs.items():
        x0, tallest = 10.0, 0.0
        file = os.path.join(folder, 'voxels', f'{scenario}_voxels_00')
        cells, start = occupied_of(file + '.npy'), start_of(file + '.yaml')
        for name in SHOWN:
            if name in found:
                drawn, width, height = panel(found[name], cells, start, x0, y0, scale)
                body += [label(x0, y0 - 6.0, f'{scenario}, {name}')] + drawn
                x0, tallest = x0 + width + 14.0, max(tallest, height)
        y0, widest = y0 + tallest + 28.0, max(widest, x0)
    return svg(widest + 10.0, y0, body)


def write_all(folder, images):
    runs = {}
    for scenario in SCENARIOS:
        file = os.path.join(folder, f'lines_{scenario}.json')
        runs[scenario] = {run['algorithm']: run for run in read_runs(file) if run['algorithm'] in SHOWN and 'drive' in run}
    try:
        os.makedirs(images, exist_ok=True)
    except OSError as error:
        raise ReportError(f'{images}: cannot be made: {error.strerror}') from error
    write_whole(os.path.join(images, 'paper-run.svg'), ways_figure(runs, folder))
    names = {'Basic_A*': 'basic_astar', 'Improved_A*': 'improved_astar'}
    drives = {name: [(state[0], state[5], math.degrees(state[6])) for state in runs['perpendicular'][key]['drive']['states']]
              for name, key in names.items() if key in runs['perpendicular']}
    if not drives:
        raise ReportError(f'{os.path.join(folder, "lines_perpendicular.json")}: holds no drive to be drawn')
    write_whole(os.path.join(images, 'paper-run-drives.svg'), drives_figure(drives))
