"""Paths on the pictures that parking_benchmark draws of its problems."""
import math
import os
import re

from charts import px, shown, text

FAINT_RUNS = 30  # paths of other runs drawn behind the best one
CLOTHOID_STEP = 0.2  # metres of the arcs that a clothoid is drawn with
MOST_ARCS = 10000    # that a piece is drawn with, however long somebody's planner made it

_MAP = re.compile(r'<svg x="[^"]*" y="[^"]*" width="([\d.]+)" height="([\d.]+)"[^>]* data-left="([^"]+)" '
                  r'data-top="([^"]+)" data-scale="([^"]+)">\n(.*?)</svg>', re.DOTALL)
_PATHS = re.compile(r'<polyline [^>]*stroke-opacity="0\.9"[^>]*/>\n?')


class Picture:
    """The map of a problem: its drawing without paths, and where its pixels lie."""

    def __init__(self, width, height, left, top, scale, content):
        self.width, self.height, self.left, self.top, self.scale = width, height, left, top, scale
        self.content = content


def read_picture(folder, problem):
    """The picture of a problem, or None when there is none that can be drawn on."""
    try:
        with open(os.path.join(folder, 'pictures', problem + '.svg'), encoding='utf-8') as stream:
            found = _MAP.search(stream.read())
    except (OSError, UnicodeDecodeError):
        return None
    if found is None or '<script' in found.group(6):
        return None
    width, height, left, top, scale = (float(found.group(k)) for k in range(1, 6))
    return Picture(width, height, left, top, scale, _PATHS.sub('', found.group(6)))


def _pieces(path):
    """(direction, begin, end, curvature, turn) of a stored path's pieces, none turning by more than a quarter.

    Of the arrays that are pieces, [turn] turns on the spot, [curvature, length] is an arc and [curvature, length,
    sharpness] a clothoid, which is drawn as short arcs."""
    x, y, yaw = path['start']
    for piece in path['pieces']:
        if len(piece) == 1:
            yaw += piece[0]
            continue
        curvature, length, sharpness = (*piece, 0.0)[:3]
        steepest = max(abs(curvature), abs(curvature + sharpness * abs(length)))
        arcs = max(abs(length) / CLOTHOID_STEP if sharpness else 0.0, steepest * abs(length) / (0.5 * math.pi))
        count = max(1, math.ceil(min(arcs, MOST_ARCS)))
        step = length / count
        for k in range(count):
            bend = curvature + sharpness * abs(step) * (k + 0.5)
            angle = bend * step
            chord = step if abs(angle) < 1e-9 else 2.0 * math.sin(0.5 * angle) / bend
            nx, ny = x + chord * math.cos(yaw + 0.5 * angle), y + chord * math.sin(yaw + 0.5 * angle)
            yield (1 if step >= 0.0 else -1), (x, y), (nx, ny), bend, angle
            x, y, yaw = nx, ny, yaw + angle


def path_lines(path, picture):
    """The path as SVG: [(direction, d)] of its pieces between changes of direction, and the places of the changes."""
    lines, cusps = [], []
    last = None
    for direction, begin, end, curvature, turn in _pieces(path):
        (x0, y0), (x1, y1) = (((x - picture.left) * picture.scale, (picture.top - y) * picture.scale)
                              for x, y in (begin, end))
        if direction != last:
            if last is not None:
                cusps.append((x0, y0))
            lines.append((direction, [f'M{px(x0)} {px(y0)}']))
            last = direction
        if abs(turn) < 1e-6:
            lines[-1][1].append(f'L{px(x1)} {px(y1)}')
        else:
            radius = picture.scale / abs(curvature)
            lines[-1][1].append(f'A{px(radius)} {px(radius)} 0 0 {0 if turn > 0.0 else 1} {px(x1)} {px(y1)}')
    return [(direction, ''.join(parts)) for direction, parts in lines], cusps


def best_run(runs):
    """The shortest of the best kind: valid, else exact, else approximate; None without any path."""
    def rank(run):
        return (not run.solved, not run.invalid, run.figure('path length'))
    return min((run for run in runs if run.path), key=rank, default=None)


def card(problem, symbol, picture, index, planner, runs, link):
    """One planner's paths on one problem, with a caption."""
    best = best_run(runs)
    solved = sum(run.solved for run in runs)
    parts = [f'<figure class="card" data-p="{index}"><svg viewBox="0 0 {px(picture.width)} {px(picture.height)}" '
             f'role="img" aria-label="{text(planner)} on {text(problem)}"><use href="#{symbol}"/>']
    others = [run for run in runs if run.solved and run.path and run is not best][:FAINT_RUNS]
    faint = ''.join(d for run in others for _, d in path_lines(run.path, picture)[0])
    if faint:
        parts.append(f'<path class="faint" d="{faint}"/>')
    if best is not None:
        lines, cusps = path_lines(best.path, picture)
        kind = '' if best.solved else ' bad' if best.invalid else ' near'
        for direction, d in lines:
            parts.append(f'<path class="{"forward" if direction > 0 else "reverse"}{kind}" d="{d}"/>')
        for x, y in cusps if best.solved else ():
            parts.append(f'<circle class="cusp" cx="{px(x)}" cy="{px(y)}" r="5"/>')
    parts.append('</svg><figcaption>')
    name = f'<a href="{text(link)}">{text(planner)}</a>' if link else text(planner)
    parts.append(f'<b>{name}</b> ')
    if best is None:
        parts.append('<span class="none">no path</span>')
    else:
        changes = best.figure('cusps')
        what = f'{shown(best.figure("path length"), 4)} m'
        if best.solved:
            what += f', {changes:.0f} change{"" if changes == 1 else "s"} of direction' if changes == changes else ''
            clearance = best.figure('least clearance')
            what += f', clearance {100 * clearance:.1f} cm' if clearance == clearance else ''
        else:
            what = ('invalid: collides when checked again' if best.invalid
                    else f'approximate, ends {shown(best.figure("distance to goal"))} m from the goal')
        parts.append(f'<span>{what}</span>')
    parts.append(f'<span class="count">{solved}/{len(runs)}</span></figcaption></figure>')
    return ''.join(parts)
