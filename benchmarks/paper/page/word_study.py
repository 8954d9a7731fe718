"""What paper_run, parking_plan and the growing grounds have left, as figures per map."""
import json
import math
import os

from planner_statistics import median
from paired import LEVEL, Comparison, compare, comparison_of, correct
from database import ReportError, read_results
from word_design import ALGORITHMS, CLUTTER, GROWTH_FACTORS, GROWTH_KEYS, own_file, runs_file

FORMAT = 1
PARKED_DISTANCE, PARKED_ANGLE = 0.25, 5.0  # metres and degrees from the goal within which a car at rest counts as parked

# name: function of a run; None when the run has no such figure.
MEASURES = {
    'loading': lambda run: run['map_loading_time_ms'],
    'planning': lambda run: run['planning_time_ms'],
    'total': lambda run: run['map_loading_time_ms'] + run['planning_time_ms'],
    'length': lambda run: run.get('length_m'),
    'turning': lambda run: run.get('turning_deg'),
    'cells': lambda run: run['cells_looked_at'],
    'positions': lambda run: run['positions_checked'],
    'expanded': lambda run: run['expanded'],
    'comparisons': lambda run: run['open_list_comparisons'],
    'uncovered': lambda run: run.get('approach_colliding_share'),
    'travel': lambda run: run.get('drive', {}).get('travel_time_s'),
    'acceleration': lambda run: run.get('drive', {}).get('mean_abs_acceleration'),
    'steering': lambda run: run.get('drive', {}).get('mean_abs_steering_deg'),
    'touching': lambda run: run.get('drive', {}).get('colliding_share'),
    'position': lambda run: run.get('drive', {}).get('final_position_error_m'),
    'heading': lambda run: run.get('drive', {}).get('final_yaw_error_deg'),
}


def read_json(file):
    try:
        with open(file, encoding='utf-8') as stream:
            return json.load(stream)
    except (OSError, ValueError) as error:
        raise ReportError(f'{file}: cannot be read ({error})') from error


def read_runs(file):
    """The runs that paper_run has written."""
    found = read_json(file)
    if not isinstance(found, dict) or found.get('format') != FORMAT or not isinstance(found.get('runs'), list):
        raise ReportError(f'{file}: is not of format {FORMAT} of paper_run; make it anew')
    return found['runs']


def is_parked(run):
    drive = run.get('drive', {})
    return bool(drive) and drive['stands'] and drive['final_position_error_m'] <= PARKED_DISTANCE \
        and drive['final_yaw_error_deg'] <= PARKED_ANGLE


class WordRuns:
    """One variant in one scenario: figures(measure, algorithm) per map."""

    def __init__(self, folder, scenario, variant):
        self.runs = {}
        for run in read_runs(os.path.join(folder, runs_file(scenario, variant))):
            self.runs.setdefault(run['algorithm'], {})[run['scenario']] = run
        missing = [name for name, key in ALGORITHMS.items() if key not in self.runs]
        if missing:
            raise ReportError(f'{os.path.join(folder, runs_file(scenario, variant))}: has no runs of {", ".join(missing)}')
        self.maps = sorted(self.runs['improved_astar'])
        self.factorial = Unsmoothed(self)

    def of(self, algorithm):
        return self.runs[ALGORITHMS[algorithm]]

    def solved(self, algorithm):
        return {name: run for name, run in self.of(algorithm).items() if run['status'] == 'exact'}

    def figures(self, measure, algorithm):
        found = {name: MEASURES[measure](run) for name, run in self.solved(algorithm).items()}
        return {name: value for name, value in found.items() if value is not None}


class Unsmoothed:
    """The variants of the factorial that are among the eight algorithms: what ratios.beside_of asks for."""
    NAMES = {'none': 'Basic_A*', 'wlb': 'Experiment_5', 'wl': 'Experiment_6'}

    def __init__(self, runs):
        self.runs = runs

    def figures(self, measure, variant):
        return self.runs.figures(measure, self.NAMES[variant]) if variant in self.NAMES else {}


def own_runs(folder, scenario, count):
    """This project's pipeline on the same tasks, in the terms of paper_run."""
    runs = []
    for number in range(count):
        result = read_json(os.path.join(folder, own_file(scenario, number)))
        try:
            drive = result.get('tracking')
            runs.append({'status': result['status'], 'planning_time_ms': result['planning_time_ms'][0],
                         'map_loading_time_ms': result['map_loading_time_ms'], 'length_m': result['length_m']})
            if drive and drive.get('arrived', True):
                runs[-1]['drive'] = {
                    'stands': True, 'final_position_error_m': drive['final_position_error_m'],
                    'final_yaw_error_deg': math.degrees(drive['final_yaw_error_rad']),
                    'travel_time_s': drive['travel_time_s'], 'mean_abs_acceleration': drive['mean_abs_acceleration'],
                    'mean_abs_steering_deg': drive['mean_abs_steering_deg'], 'colliding_share': float(drive['collisions'] > 0)}
        except (KeyError, TypeError, IndexError) as error:
            raise ReportError(f'{own_file(scenario, number)}: holds no drive of parking_plan ({error})') from error
    return runs


GROWTH_MEASURES = {'cpu': ('processor time', 'cpu time'), 'comparisons': ('comparisons in the open lists', 'open list comparisons'),
                   'expanded': ('nodes expanded', 'nodes expanded'), 'checked': ('cells and poses looked at', 'states checked')}


class Growth:
    """The growing grounds: effect(key, measure, size, clutter) over their maps."""

    def __init__(self, folder):
        self.folder = os.path.join(folder, 'growth')
        results = read_results(self.folder)
        self.runs = {}
        self.unsolved = 0
        for run in results.runs:
            size, clutter = (int(word) for word in run.problem.split('_')[1:3])
            if run.solved:
                self.runs.setdefault((size, clutter), {}).setdefault(run.problem, {})[run.planner] = run
            self.unsolved += not run.solved
        if not self.runs:
            raise ReportError(f'{self.folder}: has no runs on grounds of make_growth_maps')
        self.count = len(results.runs)
        self.sizes = sorted({size for size, _ in self.runs})
        self.clutter = [round(100 * each) for each in CLUTTER]

    def effects(self, key, measure):
        """{(size, clutter): Comparison} of the improvement, one family of tests. An effect on a map is the factor by which
        the improvement changes the figure, in the geometric mean over all combinations of the others."""
        found = {}
        for place, problems in sorted(self.runs.items()):
            values = []
            for variants in problems.values():
                logarithms = []
                for name, run in variants.items():
                    present = name.replace('none', '')
                    other = ''.join(each for each in GROWTH_KEYS if each in present and each != key) or 'none'
                    if key in present and other in variants:
                        pair = [each.figure(GROWTH_MEASURES[measure][1]) for each in (run, variants[other])]
                        if min(pair) > 0.0:
                            logarithms.append(math.log(pair[0] / pair[1]))
                if len(logarithms) == 2 ** (len(GROWTH_FACTORS) - 1):
                    values.append(math.exp(sum(logarithms) / len(logarithms)))
            # Grounds without boxes are all the same one: no spread, and nothing to be certain of.
            is_one = values and place[1] == 0
            found[place] = Comparison(values, median(values)) if is_one else comparison_of(values)
        correct(list(found.values()))
        return found


BEYOND_MEASURES = {'processor time': 'cpu time', 'poses looked at': 'states checked', 'nodes expanded': 'nodes expanded',
                   'length': 'path length'}


class Rectangle:
    """The paper's algorithms with the car's rectangle: what an improvement changes, map by map."""

    def __init__(self, folder):
        self.results = read_results(os.path.join(folder, 'rectangle'))
        self.unsolved = sum(not run.solved for run in self.results.runs)

    def figures(self, measure, planner):
        return {run.problem: run.figure(BEYOND_MEASURES[measure]) for run in self.results.runs
                if run.planner == planner and run.solved}

    def effects(self, without):
        """{measure: Comparison} of Improved A* with the algorithm that lacks one improvement. Not corrected."""
        return {measure: compare(self.figures(measure, 'Improved_A*'), self.figures(measure, without))
                for measure in BEYOND_MEASURES}


def planner_rows(folder, names):
    """Of other planners on the whole tasks: (name, tasks, solved, median of the first solution's time in ms, median of the
    length over the shortest known, median of cusps)."""
    results = read_results(os.path.join(folder, 'planners'))
    best = {}
    for run in results.runs:
        if run.solved:
            best[run.problem] = min(best.get(run.problem, math.inf), run.length)
    rows = []
    for name in names:
        runs = [run for run in results.runs if run.planner == name.replace(' ', '_')]
        if not runs:
            raise ReportError(f'{results.folder}: has no runs of {name}')
        solved = [run for run in runs if run.solved]
        rows.append((name, len(runs), len(solved), *([median([1e3 * run.time for run in solved]),
                                                      median([run.length / best[run.problem] for run in solved]),
                                                      median([run.figure('cusps') for run in solved])]
                                                     if solved else [math.nan] * 3)))
    return rows


def is_less(effect):
    """Does the improvement certainly lower the figure?"""
    return effect.certain and effect.chance < LEVEL and effect.high < 1.0


def pays_from(effects, sizes, clutter):
    """The least size from which on the improvement certainly lowers the figure at this clutter; None when there is none."""
    least = None
    for size in reversed(sizes):
        if not is_less(effects.get((size, clutter), Comparison([]))):
            break
        least = size
    return least
