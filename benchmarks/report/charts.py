"""Charts as inline SVG; what report.js shows beside the pointer comes along as plain data."""
import html
import math

from order_statistics import median_ranks

WIDTH, HEIGHT = 600.0, 300.0
LEFT, RIGHT, TOP, BOTTOM = 58.0, 14.0, 14.0, 44.0
COLOURS = 8      # that the style sheet has; further planners repeat them with other dashes
DASHES = ('', '7 4', '2 3.5')
STEPS = 140      # places at which medians over time are looked at


def text(value):
    """For attributes and elements."""
    return html.escape(str(value), quote=True)


def shown(value, digits=3):
    """A figure with as many digits as say something; no exponent where none is needed."""
    if value is None or math.isnan(value):
        return '–'
    if math.isinf(value):
        return '∞'
    if value == 0.0:
        return '0'
    places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    rounded = f'{value:.{min(places, 6)}f}'
    return rounded


def shown_time(seconds):
    """4.81 ms, 1.20 s, ∞."""
    if math.isnan(seconds) or math.isinf(seconds):
        return shown(seconds)
    if seconds < 1e-3:
        return shown(1e6 * seconds) + ' µs'
    return shown(1e3 * seconds) + ' ms' if seconds < 1.0 else shown(seconds) + ' s'


def style_of(index):
    """Class and dash of the planner with this index."""
    dash = DASHES[index // COLOURS % len(DASHES)]
    return f'c{index % COLOURS}', f' stroke-dasharray="{dash}"' if dash else ''


def px(value):
    return f'{value:.1f}'.removesuffix('.0')


class Axis:
    """From values to pixels, linear or logarithmic."""

    def __init__(self, low, high, begin, end, logarithmic):
        self.low, self.high, self.begin, self.end, self.logarithmic = low, high, begin, end, logarithmic

    def __call__(self, value):
        value = min(max(value, self.low), self.high)
        if self.logarithmic:
            share = math.log(value / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)

    def ticks(self):
        if self.logarithmic and self.high > 1.5 * self.low:
            decades = math.log10(self.high / self.low)
            factors = (1,) if decades > 2.5 else (1, 2, 5) if decades > 0.7 else (1, 1.5, 2, 3, 4, 5, 6, 8)
            found = [factor * 10.0 ** exponent for exponent in range(math.floor(math.log10(self.low)),
                                                                     math.floor(math.log10(self.high)) + 1)
                     for factor in factors]
        else:
            step = 10.0 ** math.floor(math.log10(self.high - self.low))
            step = next(step * f for f in (0.2, 0.25, 0.5, 1.0, 2.0) if (self.high - self.low) / (step * f) <= 5.5)
            found = [step * k for k in range(math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9) + 1)]
        return [value for value in found if self.low * (1 - 1e-9) <= value <= self.high * (1 + 1e-9)]


def time_range(times, limit):
    """A range for an axis of times that holds all finite ones and the time limit."""
    finite = [time for time in times if math.isfinite(time) and time > 0.0]
    high = max(finite + ([limit] if math.isfinite(limit) and limit > 0.0 else []), default=1.0)
    low = min(finite, default=high / 100.0)
    low = 10.0 ** math.floor(math.log10(low) + 1e-9)
    return max(low, 1e-6), max(high, 10.0 * max(low, 1e-6))


def axes(x, y, x_label, y_label, x_text, y_text, grid_y=True):
    parts = []
    for value in x.ticks():
        at = px(x(value))
        parts.append(f'<path class="grid" d="M{at} {px(y.end)}V{px(y.begin)}"/>'
                     f'<text class="tick" x="{at}" y="{px(y.begin + 16)}" text-anchor="middle">{x_text(value)}</text>')
    for value in y.ticks() if grid_y else ():
        at = px(y(value))
        parts.append(f'<path class="grid" d="M{px(x.begin)} {at}H{px(x.end)}"/>'
                     f'<text class="tick" x="{px(x.begin - 7)}" y="{px(y(value) + 3.7)}" text-anchor="end">'
                     f'{y_text(value)}</text>')
    parts.append(f'<path class="axis" d="M{px(x.begin)} {px(y.end)}V{px(y.begin)}H{px(x.end)}"/>')
    parts.append(f'<text class="label" x="{px(0.5 * (x.begin + x.end))}" y="{px(y.begin + 35)}" '
                 f'text-anchor="middle">{text(x_label)}</text>')
    if y_label:
        middle = 0.5 * (y.begin + y.end)
        parts.append(f'<text class="label" transform="translate(14 {px(middle)}) rotate(-90)" '
                     f'text-anchor="middle">{text(y_label)}</text>')
    return ''.join(parts)


def frame(identifier, title, body, height=HEIGHT, width=WIDTH):
    return (f'<svg class="chart" id="{identifier}" viewBox="0 0 {px(width)} {px(height)}" role="img" '
            f'aria-label="{text(title)}">{body}</svg>')


def step_path(points, x, y):
    """A step curve through (value, height) points; it keeps a height until the next one, and to the end."""
    parts = []
    for value, height in points:
        at, level = px(x(value)), px(y(height))
        parts.append(f'M{at} {level}' if not parts else f'H{at}V{level}')
    return ''.join(parts) + f'H{px(x.end)}'


def tick_time(value):
    """A tick: 10 ms."""
    for unit, size in (('s', 1.0), ('ms', 1e-3), ('µs', 1e-6)):
        if value >= 0.999 * size:
            return f'{value / size:g}'[:5] + ' ' + unit
    return f'{value:g} s'


def success_curves(runs_of, limit):
    """Points (time, share of runs solved by then) for each planner: {index: points}. Runs that are not solved count."""
    curves = {}
    for index, runs in runs_of.items():
        times = sorted(run.time for run in runs)
        points = [(time, (k + 1) / len(times)) for k, time in enumerate(times) if math.isfinite(time)]
        # Of several at once, the last; and no more points than a screen has.
        points = [point for k, point in enumerate(points) if k + 1 == len(points) or points[k + 1][0] > point[0]]
        if len(points) > 300:
            points = points[::len(points) // 300 + 1] + points[-1:]
        curves[index] = points
    return curves


def success_chart(identifier, title, runs_of, limit):
    """Share of the runs solved, over time. Returns the SVG and the data for report.js."""
    curves = success_curves(runs_of, limit)
    low, high = time_range([time for points in curves.values() for time, _ in points], limit)
    x = Axis(low, high, LEFT, WIDTH - RIGHT, True)
    y = Axis(0.0, 1.0, HEIGHT - BOTTOM, TOP, False)
    body = [axes(x, y, 'time (logarithmic)', 'runs solved', tick_time, lambda v: f'{100 * v:.0f} %')]
    series = []
    for index, points in curves.items():
        name, dash = style_of(index)
        whole = [(low, 0.0)] + points
        body.append(f'<path class="curve {name}" data-p="{index}"{dash} d="{step_path(whole, x, y)}"/>')
        series.append({'p': index, 't': [round(v, 7) for v, _ in whole], 'y': [round(v, 4) for _, v in whole]})
    data = {'kind': 'success', 'low': low, 'high': high, 'begin': x.begin, 'end': x.end, 'top': y.end,
            'bottom': y.begin, 'series': series}
    return frame(identifier, title, ''.join(body)), data


def cost_at(runs, time):
    """Best length of each run by some time; infinite for those that have none."""
    costs = []
    for run in runs:
        cost = math.inf
        for when, value in run.improvements:
            if when > time:
                break
            cost = value
        costs.append(cost)
    return costs


def median_curve(runs, low, high):
    """(time, median, low, high) of the best length over time, where the median is finite. Runs without a solution by
    then count as infinitely long; the interval is the 95 % one of the median, or the range below 6 runs."""
    ranks = median_ranks(len(runs))
    points = []
    for step in range(STEPS + 1):
        time = low * (high / low) ** (step / STEPS)
        costs = sorted(cost_at(runs, time))
        middle = len(costs) // 2
        value = costs[middle] if len(costs) % 2 else 0.5 * (costs[middle - 1] + costs[middle])
        if math.isinf(value):
            continue
        first, last = (costs[ranks[0] - 1], costs[ranks[1] - 1]) if ranks else (costs[0], costs[-1])
        if not points or points[-1][1:] != (value, first, last):
            points.append((time, value, first, last))
    return points


def band(index, points, x, y):
    """The interval over time, from where its upper end is finite."""
    if not points:
        return ''
    upper = step_path([(p[0], p[3]) for p in points], x, y)
    lower = [f'V{px(y(points[-1][2]))}']
    for k in range(len(points) - 1, 0, -1):
        lower.append(f'H{px(x(points[k][0]))}V{px(y(points[k - 1][2]))}')
    lower.append(f'H{px(x(points[0][0]))}Z')
    return f'<path class="band {style_of(index)[0]}" data-p="{index}" d="{upper}{"".join(lower)}"/>'


def cost_chart(identifier, title, runs_of, limit):
    """Median best length over time, with the interval of the median as a band. Returns the SVG and the data; None
    when no planner solves half of its runs."""
    low, high = time_range([when for runs in runs_of.values() for run in runs for when, _ in run.improvements], limit)
    curves = {index: median_curve(runs, low, high) for index, runs in runs_of.items()}
    finite = [value for points in curves.values() for _, value, *_ in points]
    if not finite:
        return None
    bottom, top = min(p[2] for points in curves.values() for p in points), max(finite)
    margin = 0.06 * max(top - bottom, 0.02 * top)
    logarithmic = top > 4.0 * bottom
    x = Axis(low, high, LEFT, WIDTH - RIGHT, True)
    y = Axis(bottom / 1.05 if logarithmic else max(0.0, bottom - margin), top * 1.1 if logarithmic else top + margin,
             HEIGHT - BOTTOM, TOP, logarithmic)
    body = [axes(x, y, 'time (logarithmic)', 'length, m' + (' (logarithmic)' if logarithmic else ''), tick_time,
                  lambda v: f'{v:g}')]
    series, lines = [], []
    for index, points in curves.items():
        if not points:
            continue
        name, dash = style_of(index)
        body.append(band(index, [p for p in points if math.isfinite(p[3])], x, y))
        lines.append(f'<path class="curve {name}" data-p="{index}"{dash} '
                     f'd="{step_path([p[:2] for p in points], x, y)}"/>')
        series.append({'p': index, 't': [round(p[0], 7) for p in points], 'y': [round(p[1], 3) for p in points],
                       'l': [round(p[2], 3) for p in points],
                       'h': [round(p[3], 3) if math.isfinite(p[3]) else None for p in points]})
    data = {'kind': 'cost', 'low': low, 'high': high, 'begin': x.begin, 'end': x.end, 'top': y.end,
            'bottom': y.begin, 'series': series}
    return frame(identifier, title, ''.join(body + lines)), data


def _offset(k):
    """Dots that are near each other in time do not lie in one line."""
    return (k * 5 % 7 - 3) * 1.7


def _dots(runs, x, at, colour):
    """All dots of a planner as one path, no two of them at the same place."""
    places = dict.fromkeys(f'{x(run.time):.0f} {at + _offset(k):.0f}' for k, run in enumerate(runs)
                           if math.isfinite(run.time))
    return f'<path class="dots {colour}" d="{"".join(f"M{place}h0" for place in places)}"/>' if places else ''


def strip_chart(identifier, title, rows, limit, each=True):
    """Every run's first solution on an axis of time, a line of dots for each planner, with the median and its interval.

    rows: (index, name, runs, median, (low, high, certainty)) of each planner; each: dots can be pointed at one by one, or
    all of a planner are one thing, which takes a tenth of the bytes."""
    pitch, names, missing, width = 24.0, 170.0, 70.0, 2.0 * WIDTH + 50.0
    height = TOP + pitch * len(rows) + BOTTOM
    low, high = time_range([run.time for row in rows for run in row[2]], limit)
    x = Axis(low, high, names, width - missing, True)
    y = Axis(0.0, 1.0, height - BOTTOM, TOP, False)
    body = [axes(x, y, 'time to the first solution (logarithmic)', '', tick_time, str, grid_y=False)]
    for line, (index, name, runs, middle, interval) in enumerate(rows):
        colour, _ = style_of(index)
        at = TOP + pitch * (line + 0.5)
        label = name if len(name) <= 22 else name[:21] + '…'
        parts = [f'<g data-p="{index}"><text class="name" x="{px(names - 10)}" y="{px(at + 4)}" text-anchor="end">'
                 f'{text(label)}</text>']
        if math.isfinite(interval[0]) and math.isfinite(middle):
            end = x(interval[1])
            parts.append(f'<path class="interval {colour}" d="M{px(x(interval[0]))} {px(at)}H{px(end)}"/>')
        if not each:
            parts.append(_dots(runs, x, at, colour))
        for k, run in enumerate(runs if each else ()):
            if not math.isfinite(run.time):
                continue
            offset = _offset(k)
            tip = f'{name}: {shown_time(run.time)}, {shown(run.length, 4)} m · run {run.number}, seed {run.seed}'
            parts.append(f'<circle class="dot {colour}" cx="{px(x(run.time))}" cy="{px(at + offset)}" r="2.6" '
                         f'data-tip="{text(tip)}"/>')
        if math.isfinite(middle):
            parts.append(f'<path class="median {colour}" d="M{px(x(middle))} {px(at - 9)}v18" '
                         f'data-tip="{text(name)}: median {shown_time(middle)}"/>')
        left = sum(not math.isfinite(run.time) for run in runs)
        if left:
            parts.append(f'<text class="missing" x="{px(width - missing + 12)}" y="{px(at + 4)}" data-tip="{text(name)}: '
                         f'{left} of {len(runs)} runs without a valid solution">∞ × {left}</text>')
        body.append(''.join(parts) + '</g>')
    return frame(identifier, title, ''.join(body), height, width)


# Of pictures that stand alone: the colours of report.css in the light.
STYLE = ('svg{font-family:sans-serif;background:#fff}.tick,.label,.name{font-size:11.5px;fill:#555}.grid{stroke:#e6e6e6;fill:none}'
         '.axis{stroke:#aaa;stroke-width:1.2;fill:none}.curve{fill:none;stroke-width:2.1;stroke-linejoin:round}'
         '.c0{stroke:#0077bb}.c1{stroke:#ee7733}.c2{stroke:#009988}.c3{stroke:#cc3377}.c4{stroke:#7a4fb5}.c5{stroke:#8a8a00}'
         '.c6{stroke:#33a5d8}.c7{stroke:#7d7d7d}')


def _standing_alone(title, names, body):
    """A picture with a style and a legend of its own. names: index -> planner."""
    side = 130.0
    legend = []
    for line, (index, name) in enumerate(names.items()):
        colour, dash = style_of(index)
        at = TOP + 14.0 + 20.0 * line
        legend.append(f'<path class="curve {colour}"{dash} d="M{px(WIDTH + 4)} {px(at)}h22"/>'
                      f'<text class="name" x="{px(WIDTH + 32)}" y="{px(at + 4)}">{text(name)}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{px(WIDTH + side)}" height="{px(HEIGHT)}" '
            f'viewBox="0 0 {px(WIDTH + side)} {px(HEIGHT)}" role="img" aria-label="{text(title)}"><style>{STYLE}</style>'
            f'<rect width="100%" height="100%" fill="#fff"/>{body}{"".join(legend)}</svg>\n')


def success_picture(title, names, runs_of, limit):
    """success_chart() as a file of its own."""
    chart, _ = success_chart('chart', title, runs_of, limit)
    return _standing_alone(title, names, chart[chart.index('>') + 1:chart.rindex('</svg>')])


def distribution_picture(title, names, values_of, most, label):
    """Share of the values that are at most so large, from 1 to most. values_of: index -> values, infinite ones too."""
    x = Axis(1.0, most, LEFT, WIDTH - RIGHT, False)
    y = Axis(0.0, 1.0, HEIGHT - BOTTOM, TOP, False)
    body = [axes(x, y, label, 'queries', lambda v: f'{v:g}', lambda v: f'{100 * v:.0f} %')]
    for index, values in values_of.items():
        colour, dash = style_of(index)
        ordered = sorted(values)
        points = [(1.0, 0.0)] + [(value, (k + 1) / len(ordered)) for k, value in enumerate(ordered) if value <= most]
        body.append(f'<path class="curve {colour}"{dash} d="{step_path(points, x, y)}"/>')
    return _standing_alone(title, names, ''.join(body))
