"""The tables and the figure of docs/paper.md, from the runs of paper_run and parking_plan on the maps of make_maps."""
import dataclasses
import json
import math
import os
import re
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'scripts', 'lib'))

import picture_style as style  # noqa: E402

ALGORITHMS = ['basic_astar', *(f'experiment_{k}' for k in range(1, 7)), 'paper_improved_astar']
NAMES = {name: name.removeprefix('paper_').replace('_', ' ').capitalize().replace('astar', 'A\\*') for name in ALGORITHMS}
ERROR = 0.001  # error probability of an interval; 5 % for fifty intervals together
NEAR = 1.05    # ratios within this factor of 1 count as equal
PARKED_DISTANCE, PARKED_ANGLE = 0.25, 5.0  # maximum error of a parked car at rest in metres and degrees

# Runs of paper_run: their arguments. Those in DRIVEN are driven, those in SINGLE run Improved A* only.
VARIANTS = {
    'printed': [], 'ahead': ['--disc', 'ahead', '--per-stretch'], 'rear_axle': ['--disc', 'rear_axle'],
    'radius_1': ['--radius', '1'], 'radius_1.5': ['--radius', '1.5'], 'bezier': ['--spline', 'bezier'],
    'field': ['--lookup', 'field'], 'no_tie_break': ['--set', 'tie_break=0'], 'list': ['--set', 'open_list=linear'],
    'one_direction': ['--set', 'bidirectional=false', '--set', 'search_from=start'],
    'octile': ['--set', 'heuristic=octile'], 'manhattan': ['--set', 'heuristic=manhattan']}
DRIVEN = {'printed': 'as printed', 'ahead': 'disc ahead of the axle, a spline for each stretch',
          'rear_axle': 'disc round the rear axle', 'radius_1': 'disc of 1 m', 'radius_1.5': 'disc of 1.5 m',
          'bezier': 'Bezier curve'}
SINGLE = ('no_tie_break', 'list', 'one_direction', 'octile', 'manhattan')

MEASURES = {
    'loading': lambda run: run['map_loading_time_ms'],
    'planning': lambda run: run['planning_time_ms'],
    'total': lambda run: run['map_loading_time_ms'] + run['planning_time_ms'],
    'acceleration': lambda run: run['drive']['mean_abs_acceleration'],
    'steering': lambda run: run['drive']['mean_abs_steering_deg'],
    'length': lambda run: run['length_m'],
    'travel': lambda run: run['drive']['travel_time_s'],
    'turning': lambda run: run['turning_deg'],
    'expanded': lambda run: run['expanded'],
    'cells': lambda run: run['cells_looked_at'],
    'comparisons': lambda run: run['open_list_comparisons']}

# The paper's tables (arXiv 2406.15429): ms, ms, m/s^2, degrees; lengths in cells, travel times in seconds.
PUBLISHED = {'perpendicular': {name: dict(zip(('loading', 'planning', 'acceleration', 'steering'), values)) for name, values in {
    'basic_astar': (98255.68, 21.86, 1.812, 19.74), 'experiment_1': (1.78, 442.93, 0.306, 10.79),
    'experiment_2': (96384.52, 6.9, 0.3062, 10.79), 'experiment_3': (1.95, 609.01, 0.141, 12.89),
    'experiment_4': (1.85, 583.30, 0.631, 20.31), 'experiment_5': (1.82, 430.61, 1.662, 10.05),
    'experiment_6': (1.80, 621.65, 1.555, 9.20), 'paper_improved_astar': (1.81, 411.04, 0.306, 10.79)}.items()},
    'parallel': {'basic_astar': dict(loading=110479.79, planning=65.77, length=101.8261, travel=26.2, acceleration=1.485,
                                     steering=12.7033),
                 'paper_improved_astar': dict(loading=3.10, planning=1213.97, length=101.8145, travel=66.4, acceleration=0.30,
                                        steering=20.03)}}
PUBLISHED['perpendicular']['basic_astar'].update(length=78.14, travel=20.4)
PUBLISHED['perpendicular']['paper_improved_astar'].update(length=72.119, travel=49.6)
for _table in PUBLISHED.values():
    for _row in _table.values():
        _row['total'] = _row['loading'] + _row['planning']


def shown(value):
    """Three digits, and all of those before the point."""
    return f'{value:.0f}' if abs(value) >= 100 else f'{value:.3g}'


def median_interval(values):
    """Interval of the population's median, by order statistics; None with too few values for the error probability."""
    ordered, count, below = sorted(values), len(values), 0
    best = None
    for k in range(count // 2):
        below += math.comb(count, k)
        if 2.0 * below / 2.0 ** count <= ERROR:
            best = ordered[k], ordered[count - 1 - k]
    return best


@dataclasses.dataclass
class Ratio:
    """Ratios of two figures, map by map."""
    values: list[float]

    @property
    def middle(self):
        return statistics.median(self.values) if self.values else math.nan

    def way(self):
        """more, less or same if that is significant, else empty."""
        interval = median_interval(self.values)
        if not interval:
            return ''
        low, high = interval
        if 1.0 / NEAR <= low and high <= NEAR:
            return 'same'
        if low > 1.0 and self.middle > NEAR:
            return 'more'
        return 'less' if high < 1.0 and self.middle < 1.0 / NEAR else ''

    def verdict(self, claimed):
        own, claim = self.way(), 'more' if claimed > NEAR else 'less' if claimed < 1.0 / NEAR else 'same'
        if not own:
            return 'unclear'
        return 'agrees' if own == claim else 'differs' if 'same' in (own, claim) else 'opposite'

    def __str__(self):
        if not self.values:
            return '–'
        interval = median_interval(self.values)
        return f'**{shown(self.middle)}**' + (f' ({shown(interval[0])} to {shown(interval[1])})' if interval else '')


def runs_file(folder, scenario, variant):
    return os.path.join(folder, f'{scenario}_{variant}.json')


class Results:
    """The runs in a folder: {algorithm: {map: run}} of each scenario and variant."""

    def __init__(self, folder):
        self.folder = folder
        self.runs = {}

    def of(self, scenario, algorithm, variant='printed'):
        key = scenario, variant
        if key not in self.runs:
            with open(runs_file(self.folder, *key), encoding='utf-8') as stream:
                found = self.runs[key] = {}
                for run in json.load(stream)['runs']:
                    found.setdefault(run['algorithm'], {})[run['scenario']] = run
        return self.runs[key][algorithm]

    def ratio(self, measure, first, second, scenario='perpendicular'):
        """first, second: an algorithm, or a pair of algorithm and variant."""
        one, other = (self.of(scenario, *((each,) if isinstance(each, str) else each)) for each in (first, second))
        values = []
        for name, run in one.items():
            if run['status'] == other[name]['status'] == 'exact':
                pair = [MEASURES[measure](each) for each in (run, other[name])]
                if min(pair) > 0.0:
                    values.append(pair[0] / pair[1])
        return Ratio(values)

    def pipeline(self, scenario, name):
        """This project's pipeline on a map, in the format of paper_run."""
        with open(os.path.join(self.folder, 'pipeline', name.replace('.yaml', '.json')), encoding='utf-8') as stream:
            plan = json.load(stream)
        run = {'status': plan['status'], 'length_m': plan['length_m'], 'map_loading_time_ms': plan['map_loading_time_ms'],
               'planning_time_ms': plan['planning_time_ms'][0]}
        if (drive := plan.get('tracking')) and drive['arrived']:
            run['drive'] = {'stands': True, 'final_yaw_error_deg': math.degrees(drive['final_yaw_error_rad']),
                            'colliding_share': float(drive['collisions'] > 0), **drive}
        return run


def table(header, rows):
    return '\n'.join(f'| {" | ".join(cells)} |' for cells in [header, ['---'] * len(header), *rows])


def ratio_table(results):
    """All ratios of the paper's tables, with those of these runs."""
    measures = {'loading': 'map loading', 'planning': 'planning', 'total': 'loading and planning',
                'acceleration': 'mean acceleration', 'steering': 'mean steering', 'length': 'length', 'travel': 'travel time'}
    pairs = [('perpendicular', name, 'paper_improved_astar') for name in ALGORITHMS[:-1]]
    pairs += [('perpendicular', 'experiment_2', 'basic_astar'), ('perpendicular', 'experiment_6', 'experiment_5'),
              ('perpendicular', 'experiment_6', 'experiment_3'), ('parallel', 'basic_astar', 'paper_improved_astar')]
    rows, counts = [], {}
    for scenario, first, second in pairs:
        cells = [f'{scenario}: {NAMES[first]} / {NAMES[second]}']
        for measure in measures:
            published = [PUBLISHED[scenario][name].get(measure) for name in (first, second)]
            if None in published:
                cells.append('')
                continue
            ratio, claimed = results.ratio(measure, first, second, scenario), published[0] / published[1]
            verdict = ratio.verdict(claimed)
            counts[verdict] = counts.get(verdict, 0) + 1
            cells.append(f'{ratio}; paper {shown(claimed)}: {verdict}')
        rows.append(cells)
    text = ', '.join(f'{counts.get(each, 0)} × {each}' for each in ('agrees', 'differs', 'opposite', 'unclear'))
    return f'{sum(counts.values())} ratios: {text}.\n\n' + table(['', *measures.values()], rows)


# element, file, claim, and its check: (ratio, first, second, scenario, the paper's ratio or bound).
SEARCH, GRID = 'ompl_improved_astar/search/', 'ompl_improved_astar/search/models/GridModel.h'
I, B = 'paper_improved_astar', 'basic_astar'
CLAIMS = [
    ('whole planner, perpendicular', 'benchmarks/paper/PaperTask.h', 'loading and planning take over 95 % less time',
     ('total', I, B, 'perpendicular', 0.05)),
    ('whole planner, parallel', 'benchmarks/paper/PaperTask.h', 'over 95 % less time', ('total', I, B, 'parallel', 0.05)),
    ('whole planner, perpendicular', 'benchmarks/paper/PaperTask.h', 'path 7.7 % shorter',
     ('length', I, B, 'perpendicular', 72.119 / 78.14)),
    ('drive, perpendicular', 'benchmarks/paper/PaperDrive.h', 'acceleration 83.1 % less',
     ('acceleration', I, B, 'perpendicular', 0.169)),
    ('drive, perpendicular', 'benchmarks/paper/PaperDrive.h', 'steering angle 45.3 % less',
     ('steering', I, B, 'perpendicular', 0.547)),
    ('drive, parallel', 'benchmarks/paper/PaperDrive.h', 'acceleration 79.8 % less', ('acceleration', I, B, 'parallel', 0.202)),
    ('weighted heuristic', SEARCH + 'HeuristicWeights.h', 'raises efficiency (7 % less loading and planning)',
     ('total', I, 'experiment_1', 'perpendicular', 412.85 / 444.71)),
    ('tie break p', SEARCH + 'HeuristicWeights.h', 'fewer nodes', ('expanded', I, (I, 'no_tie_break'), 'perpendicular', 0.5)),
    ('dynamic loading', GRID, 'fewer cells are looked at', ('cells', I, 'experiment_2', 'perpendicular', 0.5)),
    ('dynamic loading', GRID, 'loading and planning 99.6 % faster', ('total', I, 'experiment_2', 'perpendicular', 0.00428)),
    ('all but dynamic loading', SEARCH + 'Search.h', 'planning alone 68.4 % faster than Basic A\\*',
     ('planning', 'experiment_2', B, 'perpendicular', 0.316)),
    ('two directions and heap', SEARCH + 'Search.h', 'planning 32.5 % faster',
     ('planning', I, 'experiment_3', 'perpendicular', 0.675)),
    ('heap alone', SEARCH + 'OpenList.cpp', 'fewer comparisons, O(log n)',
     ('comparisons', I, (I, 'list'), 'perpendicular', 0.5)),
    ('heap alone', SEARCH + 'OpenList.cpp', 'planning faster', ('planning', I, (I, 'list'), 'perpendicular', 0.5)),
    ('two directions alone', SEARCH + 'Search.h', 'fewer nodes', ('expanded', I, (I, 'one_direction'), 'perpendicular', 0.5)),
    ('16 neighbours', SEARCH + 'models/MotionModels.cpp', 'less turning', ('turning', 'experiment_4', I, 'perpendicular', 0.5)),
    ('16 neighbours', SEARCH + 'models/MotionModels.cpp', 'planning takes longer (42 %)',
     ('planning', 'experiment_4', I, 'perpendicular', 1.42)),
    ('B-spline', 'benchmarks/paper/JointSpline.h', 'smoother: less turning', ('turning', I, 'experiment_5', 'perpendicular', 0.5)),
    ('B-spline', 'benchmarks/paper/JointSpline.h', 'acceleration 82 % less',
     ('acceleration', I, 'experiment_5', 'perpendicular', 0.184)),
    ('B-spline', 'benchmarks/paper/JointSpline.h', 'hardly costs planning time', ('planning', I, 'experiment_5', 'perpendicular', 1.0)),
]
WORDS = {'total': 'loading and planning', 'expanded': 'nodes', 'cells': 'cells'}


def claim_verdict(ratio, bound):
    verdict, interval = ratio.verdict(bound), median_interval(ratio.values)
    # Claims without a figure have the bound 0.5.
    if verdict == 'agrees' and bound not in (0.5, 1.0):
        if bound < 1.0 and interval[0] > bound or bound > 1.0 and interval[1] < bound:
            return 'agrees, but by less'
    return verdict


def counted_claims(results, scenarios):
    """Claims checked map by map: element, file, claim, measured, verdict."""
    def row(element, file, claim, good, count, more=''):
        return [element, file, claim, f'in {good} of {count} maps{more}', 'always' if good == count else 'not always' if good else 'never']
    found, driven, covered, arrivals = [], [], [], []
    for scenario in scenarios:
        runs = list(results.of(scenario, I).values())
        found += [run['status'] != 'no_manoeuvre' for run in runs]
        solved = [run for run in runs if run['status'] == 'exact']
        driven += [is_parked(run) and run['drive']['colliding_share'] == 0.0 for run in solved]
        covered += [run['approach_colliding_share'] == 0.0 for run in solved]
        arrivals += [run['arrival_turn_deg'] for run in solved]
    near = {name: run for name, run in results.of('unreachable', I).items()}
    nearest = sum('approach_m' in run and abs(run['approach_error_m'] - stated_distance(results.folder, name)) < 0.01
                  for name, run in near.items())
    none = sum('approach_m' not in run for run in results.of('unreachable', B).values())
    task = 'benchmarks/paper/PaperTask.h'
    return [
        row('manoeuvre: arcs and lines out of the slot', 'parking_geometry/manoeuvres/ReverseParking.h',
            'a collision-free path into the slot', sum(found), len(found)),
        row('disc for the car', 'benchmarks/paper/DiscWorld.h', 'sufficient: the body is free along A\\*\'s path', sum(covered),
            len(covered)),
        row('end of A\\* is a position', task, 'the manoeuvre joins', sum(turn < 30.0 for turn in arrivals), len(arrivals),
            f' the heading is less than 30° off; median {shown(statistics.median(arrivals))}°' if arrivals else ''),
        row('controller along one spline', 'benchmarks/paper/PaperDrive.h', 'the car parks without touching', sum(driven),
            len(driven)),
        row('unreachable slot, Improved A\\*', SEARCH + 'Search.h', 'a path as near to the slot as possible', nearest, len(near)),
        row('unreachable slot, Basic A\\*', SEARCH + 'Search.h', 'no path', none, len(near))]


def stated_distance(folder, name):
    with open(os.path.join(folder, 'maps', name), encoding='utf-8') as stream:
        return float(re.search(r'gets to ([\d.]+) m', stream.read()).group(1))


def claim_table(results):
    rows = []
    for element, file, claim, (measure, first, second, scenario, bound) in CLAIMS:
        ratio = results.ratio(measure, first, second, scenario)
        rows.append([element, file, claim, f'{WORDS.get(measure, measure)} × {ratio}', claim_verdict(ratio, bound)])
    rows += counted_claims(results, ('perpendicular', 'parallel'))
    for row in rows:
        row[1] = f'[{os.path.basename(row[1])}](../{row[1]})'
    return table(['element', 'in the code', 'claim', 'measured', 'verdict'], rows)


def is_parked(run):
    drive = run.get('drive')
    return bool(drive) and drive['stands'] and drive['final_position_error_m'] <= PARKED_DISTANCE \
        and drive['final_yaw_error_deg'] <= PARKED_ANGLE


def drive_row(name, runs):
    solved = [run for run in runs if run['status'] == 'exact']
    driven = [run for run in solved if 'drive' in run]

    def middle(function, of):
        return shown(statistics.median(function(run) for run in of)) if of else '–'
    return [name, f'{len(solved)} of {len(runs)}', str(sum(map(is_parked, driven))),
            str(sum(run['drive']['colliding_share'] > 0.0 for run in driven)),
            middle(lambda run: 100.0 * run['drive']['final_position_error_m'], driven), middle(MEASURES['travel'], driven),
            middle(MEASURES['acceleration'], driven), middle(MEASURES['steering'], driven), middle(MEASURES['length'], solved),
            middle(MEASURES['total'], solved)]


def drive_table(results):
    header = ['', 'path', 'parked', 'touch something', 'from the goal, cm', 'travel, s', 'acceleration, m/s²', 'steering, °',
              'length, m', 'loading and planning, ms']
    parts = []
    for scenario in ('perpendicular', 'parallel'):
        rows = [drive_row(f'{NAMES[name]}, {words}', list(results.of(scenario, name, variant).values()))
                for variant, words in DRIVEN.items() for name in (B, I)]
        rows.append(drive_row('this project\'s pipeline', [results.pipeline(scenario, name) for name in results.of(scenario, I)]))
        parts.append(f'**{scenario.capitalize()} parking**\n\n' + table(header, rows))
    return '\n\n'.join(parts)


def choice_table(results):
    """Nodes and cells for alternatives of the paper, medians over the perpendicular maps."""
    rows = []
    for name, words in (('printed', 'Euclidean distance, every cell looked at'), ('octile', 'diagonal distance'),
                        ('manhattan', 'Manhattan distance'), ('field', 'distance field')):
        solved = [run for run in results.of('perpendicular', I, name).values() if run['status'] == 'exact']
        rows.append([words, *(shown(statistics.median(MEASURES[each](run) for run in solved)) if solved else '–'
                              for each in ('expanded', 'length', 'loading', 'planning', 'cells'))])
    return table(['Improved A\\* with', 'nodes', 'length, m', 'loading, ms', 'planning, ms', 'cells'], rows)


def tables(folder):
    """{marker of docs/paper.md: text}."""
    results = Results(folder)
    return {'claims': claim_table(results), 'ratios': ratio_table(results), 'drives': drive_table(results),
            'choices': choice_table(results)}


def figure(runs):
    """An SVG of runs with their lines, all at one scale in metres: corners of the path, the path, the drive."""
    lines = [('path of A* and manoeuvre', style.FAINT, '2 4'), ('path to be driven', style.FORWARD, ''),
             ('drive', style.DRIVEN, '6 4')]
    places = [[run['corners'], run['curve'][::3], [state[1:3] for state in run['drive']['states']][::2]] for run in runs]
    ranges = []
    for each in places:
        points = [point for track in each for point in track]
        ranges.append([(math.floor(min(values)) - 1.0, math.ceil(max(values)) + 1.0) for values in zip(*points)])
    (width, gap), top, left = (960, 62), 76, 62.0
    scale = (width - 24 - len(runs) * gap) / sum(x1 - x0 for (x0, x1), _ in ranges)
    height = scale * max(y1 - y0 for _, (y0, y1) in ranges)
    body = style.legend(left, 24, lines)
    for run, tracks, (x, y) in zip(runs, places, ranges):
        y = (y[0], y[0] + height / scale)
        axes = style.Axes(left, top, scale * (x[1] - x[0]), height, x, y)
        name = f'{run["scenario"].split("_")[0]}, {run["algorithm"].removeprefix("paper_").split("_")[0]}'
        body += axes.frame(name, 'x (m)', 'y (m)' if left == 62.0 else '', style.round_ticks(*x, 5), style.round_ticks(*y, 10))
        for track, (_, colour, dash) in zip(tracks, lines):
            body += axes.curve(*zip(*track), colour, dash)
        left += axes.width + gap
    return style.picture(width, top + height + 52, body, 'Paths and drives of the basic and the improved algorithm')
