"""Charts as Plotly's figures: {'data': traces, 'layout': ...}.

The member meta of a trace is the index of its planner, which the page uses to show and hide it. The page adds the
colours of text and grid, which follow the browser's theme."""
import functools
import math

import numpy

from formatting import own_name, shown, shown_time
from planner_statistics import median, median_ranks

# For light and dark pages; further planners repeat them with other dashes.
COLOURS = ('#3d85c6', '#e07b39', '#1f9e89', '#d1559b', '#9270d6', '#9b9b20', '#8b8b8b', '#d64545', '#2fb4d8', '#5fa33a',
           '#9c6b43', '#c79a00')
DASHES = ('solid', 'dash', 'dot')
MAX_POINTS = 300       # maximum points of a curve: the resolution of a screen
STEPS = 80             # number of times at which medians over time are computed
FARTHEST_RATIO = 1000.0  # largest ratio of performance profiles


@functools.lru_cache(maxsize=None)
def _looks(names):
    """(colour, dash) of each planner. Results of one planner in several databases share the colour."""
    shared, looks = list(dict.fromkeys(map(own_name, names))), []
    for index, name in enumerate(names):
        place = shared.index(own_name(name))
        instance = sum(own_name(other) == own_name(name) for other in names[:index])
        looks.append((COLOURS[place % len(COLOURS)], DASHES[(place // len(COLOURS) + instance) % len(DASHES)]))
    return looks


def colour_of(names, index):
    return _looks(tuple(names))[index][0]


def dash_of(names, index):
    return _looks(tuple(names))[index][1]


def _digits(values, digits=4):
    """A number in the precision of a chart."""
    return [float(f'{value:.{digits}g}') for value in values]


def _figure(traces, x, y, height=300, **layout):
    return {'data': traces, 'layout': {
        'height': height, 'margin': {'l': 52, 'r': 12, 't': 8, 'b': 42}, 'showlegend': False, 'hovermode': 'closest',
        'dragmode': False, 'xaxis': {'zeroline': False, 'fixedrange': True, **x},
        'yaxis': {'zeroline': False, 'fixedrange': True, **y}, **layout}}


def _title(text):
    return {'text': text, 'standoff': 6}


def _time_axis(low, high, text='time (logarithmic)'):
    return {'type': 'log', 'range': [math.log10(low), math.log10(high)], 'title': _title(text), 'dtick': 1,
            'exponentformat': 'SI', 'minexponent': 0, 'ticksuffix': 's'}


def _curve(names, index, x, y, hover, **more):
    """A step curve; it keeps a value until the next point."""
    return {'type': 'scatter', 'mode': 'lines', 'meta': index, 'name': names[index], 'x': _digits(x), 'y': _digits(y),
            'line': {'shape': 'hv', 'width': 2, 'color': colour_of(names, index), 'dash': dash_of(names, index)},
            'hovertemplate': '%{fullData.name}: ' + hover + '<extra></extra>', **more}


def _band(names, index, x, low, high, hover):
    """The area between two step curves, as two traces."""
    red, green, blue = (int(colour_of(names, index)[k:k + 2], 16) for k in (1, 3, 5))
    area = {'fill': 'tonexty', 'fillcolor': f'rgba({red},{green},{blue},0.13)'}
    traces = [_curve(names, index, x, low, 'interval from ' + hover), _curve(names, index, x, high, 'interval to ' + hover, **area)]
    for trace in traces:
        trace['line']['width'] = 0
    return traces


def time_range(times, limit):
    """A range that contains all finite times and the time limit."""
    finite = [time for time in times if 0.0 < time < math.inf]
    high = max([*finite, limit] if limit > 0.0 else finite, default=1.0)
    low = max(10.0 ** math.floor(math.log10(min(finite, default=high / 100.0)) + 1e-9), 1e-6)
    return low, max(high, 10.0 * low)


def success_points(runs):
    """(time, share of the runs solved by then) at each time at which a run is solved. Unsolved runs count."""
    times = sorted(run.time for run in runs if math.isfinite(run.time))
    points = {time: (k + 1) / len(runs) for k, time in enumerate(times)}
    return list(points.items())


def success_chart(names, runs_of, limit):
    """Share of the runs solved, over time. names: of all planners; runs_of: index -> runs."""
    points_of = {index: success_points(runs) for index, runs in runs_of.items()}
    low, high = time_range([time for points in points_of.values() for time, _ in points], limit)
    traces = []
    for index, points in points_of.items():
        points = points[::len(points) // MAX_POINTS + 1] + points[-1:]
        x, y = zip((low, 0.0), *points, (high, points[-1][1] if points else 0.0))
        traces.append(_curve(names, index, x, y, '%{y:.0%} by %{x:.3s}s'))
    return _figure(traces, _time_axis(low, high), {'title': _title('runs solved'), 'tickformat': '.0%',
                                                   'range': [-0.02, 1.02]})


def best_length_at(runs, times):
    """Best length of each run (rows) by some times (columns); infinite without a solution by then."""
    table = numpy.full((len(runs), len(times)), math.inf)
    for row, run in zip(table, runs):
        if run.improvements:
            when, lengths = zip(*run.improvements)
            row[:] = numpy.append(math.inf, lengths)[numpy.searchsorted(when, times, side='right')]
    return table


def median_curve(runs, low, high):
    """(time, median, low, high) of the best length over time where the median is finite, at each change.

    Runs without a solution by then count as infinitely long. The interval is that of the median, or the range with too
    few runs."""
    times = numpy.geomspace(low, high, STEPS + 1)
    lengths = numpy.sort(best_length_at(runs, times), axis=0)
    first, last, _ = median_ranks(len(runs)) or (1, len(runs), 0.0)
    points = []
    for time, column in zip(times, lengths.T):
        point = median(column), column[first - 1], column[last - 1]
        if math.isfinite(point[0]) and (not points or points[-1][1:] != point):
            points.append((float(time), *point))
    return points


def length_chart(names, runs_of, limit):
    """Median best length over time, with the interval of the median; None when no planner solves half of its runs."""
    low, high = time_range([time for runs in runs_of.values() for run in runs for time, _ in run.improvements], limit)
    curves = {index: median_curve(runs, low, high) for index, runs in runs_of.items()}
    traces, middles = [], []
    for index, points in curves.items():
        if points:
            points.append((high, *points[-1][1:]))
            x, middle, *_ = zip(*points)
            middles += middle
            known = [point for point in points if math.isfinite(point[3])]
            hover = '%{y:.2f} m by %{x:.3s}s'
            if known:
                traces += _band(names, index, *zip(*((x, begin, end) for x, _, begin, end in known)), hover)
            traces.append(_curve(names, index, x, middle, hover))
    if not traces:
        return None
    wide = max(middles) > 4.0 * min(middles)
    return _figure(traces, _time_axis(low, high), {'title': _title('length, m'), **({'type': 'log'} if wide else {})})


def _names_axis(names):
    """Planners from top to bottom, long names cut."""
    return {'tickvals': list(range(len(names))), 'range': [len(names) - 0.5, -0.5], 'showgrid': False,
            'ticktext': [name if len(name) <= 22 else name[:21] + '…' for name in names], 'automargin': True}


def strip_chart(names, rows, limit, detailed):
    """Every run's first solution on an axis of time: dots per planner, with the median and its interval.

    rows: (index, runs, median, (low, high, certainty)); detailed: whether each dot names its run."""
    low, high = time_range([run.time for _, runs, *_ in rows for run in runs], limit)
    traces, missing = [], []
    for line, (index, runs, middle, interval) in enumerate(rows):
        solved = [(k, run) for k, run in enumerate(runs) if math.isfinite(run.time)]
        labels = {'text': [f'{shown_time(run.time)}, {shown(run.length, 4)} m, run {run.number}, seed {run.seed}'
                           for _, run in solved], 'hovertemplate': '%{fullData.name}: %{text}<extra></extra>'}
        traces.append({'type': 'scatter', 'mode': 'markers', 'meta': index, 'name': names[index],
                       'x': _digits(run.time for _, run in solved),
                       'y': _digits(line + 0.07 * (k * 5 % 7 - 3) for k, _ in solved),  # spread vertically
                       'marker': {'size': 5, 'opacity': 0.6, 'color': colour_of(names, index)},
                       **(labels if detailed else {'hoverinfo': 'name'})})
        if math.isfinite(middle):
            end = min(interval[1], high)
            traces.append({'type': 'scatter', 'mode': 'lines', 'meta': index, 'x': _digits([interval[0], end]),
                           'y': [line, line], 'line': {'width': 9, 'color': colour_of(names, index)}, 'opacity': 0.3,
                           'hoverinfo': 'skip'})
            traces.append({'type': 'scatter', 'mode': 'markers', 'meta': index, 'name': names[index],
                           'x': _digits([middle]), 'y': [line],
                           'marker': {'symbol': 'line-ns-open', 'size': 18, 'line': {'width': 3}, 'color': colour_of(names, index)},
                           'hovertemplate': f'%{{fullData.name}}: median {shown_time(middle)}<extra></extra>'})
        unsolved = len(runs) - len(solved)
        if unsolved:
            missing.append({'xref': 'paper', 'x': 1.0, 'xanchor': 'left', 'y': line, 'showarrow': False,
                            'text': f'∞ × {unsolved}'})
    figure = _figure(traces, _time_axis(low, high, 'time to the first solution (logarithmic)'),
                     _names_axis([names[index] for index, *_ in rows]), 70 + 26 * len(rows), annotations=missing)
    figure['layout']['margin']['r'] = 60
    return figure


def profile_chart(names, profiles, best):
    """Share of the problems on which each planner is at most that many times worse than the best one there."""
    high = min(FARTHEST_RATIO, max(1.1, 1.05 * max(points[-1][0] for points in profiles.values())))
    traces = []
    for index, points in profiles.items():
        within = [point for point in points if point[0] <= high]
        x, y = zip(*within, (high, within[-1][1]))
        traces.append(_curve(names, index, x, y, '%{y:.0%} within %{x:.3g} times the best'))
    return _figure(traces, {'type': 'log', 'range': [0.0, math.log10(high)],
                            'title': _title(f'ratio to the {best}')},
                   {'title': _title('problems'), 'tickformat': '.0%', 'range': [-0.02, 1.02]})


def expected_chart(names, expected, count, limit):
    """Expected number of problems solved over time, with its interval."""
    low, high = time_range([point[0] for points in expected.values() for point in points], limit)
    bands, curves = [], []
    for index, points in expected.items():
        points = [(low, 0.0, 0.0, 0.0), *points]
        x, y, begin, end = zip(*points, (high, *points[-1][1:]))
        hover = '%{y:.1f} problems by %{x:.3s}s'
        bands += _band(names, index, x, begin, end, hover)
        curves.append(_curve(names, index, x, y, hover))
    return _figure(bands + curves, _time_axis(low, high),
                   {'title': _title(f'problems solved, of {count}'), 'range': [-0.02 * count, 1.02 * count]})


def rank_chart(names, ranks, groups):
    """Mean ranks, the best on top; bars join planners without a significant difference.

    ranks: index -> mean rank; groups: lists of indices adjacent by rank."""
    order = sorted(ranks, key=lambda index: (ranks[index], index))
    traces = [{'type': 'scatter', 'mode': 'markers', 'meta': index, 'name': names[index], 'x': _digits([ranks[index]]),
               'y': [line], 'marker': {'size': 11, 'color': colour_of(names, index)},
               'hovertemplate': '%{fullData.name}: mean rank %{x:.2f}<extra></extra>'} for line, index in enumerate(order)]
    for place, group in enumerate(groups):
        lines = [order.index(index) for index in group]
        label = 'no significant difference: ' + ', '.join(names[index] for index in group)
        x = len(order) + 0.3 + 0.25 * place
        traces.append({'type': 'scatter', 'mode': 'lines', 'name': label, 'x': [x, x],
                       'y': [min(lines) - 0.2, max(lines) + 0.2], 'line': {'width': 5, 'color': '#888888'},
                       'hovertemplate': '%{fullData.name}<extra></extra>'})
    high = len(order) + 0.3 + 0.25 * max(1, len(groups))
    return _figure(traces, {'range': [0.8, high], 'title': _title('mean rank'), 'dtick': max(1, math.ceil(len(order) / 12))},
                   _names_axis([names[index] for index in order]), 70 + 26 * len(order))
