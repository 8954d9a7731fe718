"""Pictures of how planners stand to each other, in the manner of charts.py."""
import math

from charts import (BOTTOM, LEFT, RIGHT, TOP, WIDTH, Axis, axes, band, frame, px, shown, step_path, style_of, text, tick_time,
                    time_range)

ACROSS, DOWN = 440.0, 300.0  # of a chart with two others beside it
FARTHEST = 1000.0  # ratio at which profiles end


def _curves(identifier, title, curves, x, y, kind, body, bands):
    """Step curves through points (value, height[, low, high]) of each planner. Returns the SVG and the data."""
    series, lines = [], []
    for index, points in curves.items():
        name, dash = style_of(index)
        if bands:
            body.append(band(index, points, x, y))
        lines.append(f'<path class="curve {name}" data-p="{index}"{dash} '
                     f'd="{step_path([point[:2] for point in points], x, y)}"/>')
        made = {'p': index, 't': [round(point[0], 7) for point in points], 'y': [round(point[1], 4) for point in points]}
        if bands:
            made.update(l=[round(point[2], 3) for point in points], h=[round(point[3], 3) for point in points])
        series.append(made)
    data = {'kind': kind, 'low': x.low, 'high': x.high, 'begin': x.begin, 'end': x.end, 'top': y.end, 'bottom': y.begin,
            'series': series}
    return frame(identifier, title, ''.join(body + lines), DOWN, ACROSS), data


def profile_chart(identifier, title, profiles, best):
    """Share of the problems on which each planner is at most so many times worse than the best one there."""
    last = max((points[-1][0] for points in profiles.values()), default=1.0)
    high = min(FARTHEST, max(1.1, 1.05 * last))
    x = Axis(1.0, high, LEFT, ACROSS - RIGHT, True)
    y = Axis(0.0, 1.0, DOWN - BOTTOM, TOP, False)
    body = [axes(x, y, f'ratio to the {best} (logarithmic)', 'problems', lambda v: f'{v:g}',
                 lambda v: f'{100 * v:.0f} %')]
    shortened = {index: [point for point in points if point[0] <= high] for index, points in profiles.items()}
    return _curves(identifier, title, shortened, x, y, 'profile', body, False)


def expected_chart(identifier, title, expected, count, limit):
    """Expected number of problems solved over time, with its interval as a band."""
    low, high = time_range([point[0] for points in expected.values() for point in points], limit)
    x = Axis(low, high, LEFT, ACROSS - RIGHT, True)
    y = Axis(0.0, float(count), DOWN - BOTTOM, TOP, False)
    body = [axes(x, y, 'time (logarithmic)', f'problems solved, of {count}', tick_time, lambda v: f'{v:g}')]
    curves = {index: points or [(low, 0.0, 0.0, 0.0)] for index, points in expected.items()}
    return _curves(identifier, title, curves, x, y, 'expected', body, True)


def rank_chart(identifier, title, names, ranks, groups):
    """Mean ranks on a line, best on the left; a bar joins those that the problems do not tell apart (Demsar 2006).

    names, ranks: index of a planner -> its name, its mean rank; groups: lists of indices."""
    order = sorted(ranks, key=lambda index: (ranks[index], index))
    count, half = len(order), (len(order) + 1) // 2
    width, margin, line, pitch, bar = 2.0 * WIDTH + 50.0, 250.0, 34.0, 21.0, 8.0
    first = line + 16.0 + bar * len(groups) + 14.0
    height = first + pitch * half
    x = Axis(1.0, float(count), margin, width - margin, False)
    body = [f'<path class="axis" d="M{px(x.begin)} {px(line)}H{px(x.end)}"/>']
    step = math.ceil(count / 20)
    for rank in range(1, count + 1, step):
        body.append(f'<path class="axis" d="M{px(x(rank))} {px(line)}v-6"/><text class="tick" x="{px(x(rank))}" '
                    f'y="{px(line - 11)}" text-anchor="middle">{rank}</text>')
    for place, index in enumerate(order):
        left = place < half
        at = first + pitch * (place if left else count - 1 - place)
        side, end = (margin - 24.0, 'end') if left else (width - margin + 24.0, 'start')
        away = -7.0 if left else 7.0
        colour, dash = style_of(index)
        label = names[index] if len(names[index]) <= 24 else names[index][:23] + '…'
        body.append(f'<g data-p="{index}" data-tip="{text(names[index])}: mean rank {shown(ranks[index])}">'
                    f'<path class="rank {colour}"{dash} d="M{px(x(ranks[index]))} {px(line)}V{px(at)}H{px(side)}"/>'
                    f'<circle class="dot {colour}" cx="{px(x(ranks[index]))}" cy="{px(line)}" r="4"/>'
                    f'<text class="name" x="{px(side + away)}" y="{px(at + 4)}" text-anchor="{end}">{text(label)} '
                    f'<tspan class="tick">{shown(ranks[index])}</tspan></text></g>')
    for row, group in enumerate(groups):
        at = line + 14.0 + bar * row
        begin, end = (min(ranks[index] for index in group), max(ranks[index] for index in group))
        tip = ', '.join(names[index] for index in group)
        body.append(f'<path class="alike" d="M{px(x(begin) - 5)} {px(at)}H{px(x(end) + 5)}" data-tip="not told apart: '
                    f'{text(tip)}"/>')
    return frame(identifier, title, ''.join(body), height, width)
