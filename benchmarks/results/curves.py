"""Curves of the results as SVG pictures, in the style of all pictures of the documents."""
import math
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'scripts', 'lib'))

from picture_style import CURVES, INK, Axes, decade_ticks, line, picture, round_ticks, text  # noqa: E402

WIDTH, HEIGHT = 760, 320
LEFT, RIGHT, TOP, BOTTOM = 64, 230, 14, 46  # of the field; the legend is at its right
DASHES = ('', '7 4')


def time_label(seconds):
    """100 µs, 1 ms, 10 s."""
    for unit, factor in (('µs', 1e-6), ('ms', 1e-3), ('s', 1.0)):
        if seconds < 999.5 * factor:
            return f'{seconds / factor:g} {unit}'
    return f'{seconds:g} s'


def step_points(points, end):
    """A curve that keeps its height until the next point, up to the end."""
    made = []
    for x, y in points:
        if made:
            made.append((x, made[-1][1]))
        made.append((x, y))
    return made + [(end, made[-1][1])] if made else []


def step_curves(curves, times, heights, x_title, y_title, height_label):
    """A picture of step curves over a logarithmic axis of times.

    curves maps names to points (seconds, height); times and heights are the ranges of the axes. The place of a curve among
    all determines its colour, also if others lie outside of the field and are omitted."""
    low, high = times
    bottom, top = heights
    axes = Axes(LEFT, TOP, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM, (math.log10(low), math.log10(high)), heights)
    body = axes.frame(x_label=x_title, y_label=y_title,
                      x_ticks=[(math.log10(tick), time_label(tick)) for tick in decade_ticks(low, high)],
                      y_ticks=[(tick, height_label(tick)) for tick in round_ticks(bottom, top, 6)])
    body += (f'<clipPath id="field"><path d="M{LEFT} {TOP - 2}H{WIDTH - RIGHT}V{HEIGHT - BOTTOM + 2}H{LEFT}Z"/></clipPath>\n'
             '<g clip-path="url(#field)">\n')
    seen = [(index, name, points) for index, (name, points) in enumerate(curves.items())
            if any(bottom <= height <= top for _, height in points)]
    looks = [(CURVES[index % len(CURVES)], DASHES[index // len(CURVES) % len(DASHES)]) for index, _, _ in seen]
    for (_, _, points), (colour, dash) in zip(seen, looks):
        steps = step_points(points, high)
        body += axes.curve([math.log10(max(time, low)) for time, _ in steps], [height for _, height in steps], colour, dash)
    body += '</g>\n'
    for place, ((_, name, _), (colour, dash)) in enumerate(zip(seen, looks)):
        x, y = WIDTH - RIGHT + 12, TOP + 14 + 19 * place
        body += line([(x, y - 4), (x + 22, y - 4)], colour, dash=dash) + text(x + 28, y, name, INK)
    return picture(WIDTH, HEIGHT, body, f'{y_title}, {x_title}')
