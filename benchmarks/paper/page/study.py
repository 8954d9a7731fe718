"""The figures of the runs, per map and algorithm."""
import math
import os

from design import ALGORITHMS, SAME_PATH, folder_of
from database import ReportError
from paths import read_results_with_paths
from planner_statistics import median

MINIMUM_TURN = 0.01  # radians; less is no corner
WAITING, SMALL = 1.1, 5e-5  # a run that took longer than so much of its processor time, and seconds, had to wait

# name: (heading, property of the run or function of the run, factor)
MEASURES = {
    'loading': ('map loading, ms', 'map loading time', 1e3),
    'planning': ('planning, ms', 'planning time', 1e3),
    'total': ('loading and planning, ms', 'cpu time', 1e3),
    'length': ('length, m', 'path length', 1.0),
    'travel': ('travel time, s', 'travel time', 1.0),
    'acceleration': ('mean acceleration, m/s²', 'mean acceleration', 1.0),
    'steering': ('mean steering, °', 'mean steering angle', 1.0),
    'cells': ('cells and poses looked at', 'states checked', 1.0),
    'expanded': ('nodes expanded', 'nodes expanded', 1.0),
    'collisions': ('collisions in the drive', 'collisions while driving', 1.0),
    'turning': ('turning along the path, °', None, 1.0),
    'corners': ('corners', None, 1.0),
}
TIMES = ('loading', 'planning')
DRIVEN = ('travel', 'acceleration', 'steering', 'collisions')


def shape_of(run):
    """(degrees that the path turns in all, its corners); NaN without a path."""
    pieces = (run.path or {}).get('pieces')
    if not pieces:
        return math.nan, math.nan
    turning, corners = 0.0, 0
    for piece in pieces:
        if len(piece) == 1:
            turning += abs(piece[0])
            corners += abs(piece[0]) > MINIMUM_TURN
        else:
            turning += abs(piece[0] * piece[1])
    return math.degrees(turning), corners


def value_of(run, measure):
    if measure in ('turning', 'corners'):
        return float(shape_of(run)[measure == 'corners'])
    _, prop, factor = MEASURES[measure]
    return factor * run.figure(prop)


def was_undisturbed(run):
    """Did the run have the processor to itself? What it was made to wait is no time of the planner."""
    return not run.figure('time') > WAITING * run.figure('cpu time') + SMALL


def middle(runs, measure):
    """The median over the runs that have one, of times the least of undisturbed runs; NaN when none has.

    The search does the same in every run. What differs is what else the machine does, and that only adds."""
    if measure in TIMES:
        runs = [run for run in runs if was_undisturbed(run)]
    values = [value for value in (value_of(run, measure) for run in runs) if not math.isnan(value)]
    return (min(values) if measure in TIMES else median(values)) if values else math.nan


class Study:
    """One folder of results on generated maps: figures[measure][variant][map]."""

    def __init__(self, results_folder, study, scenario):
        self.folder = os.path.join(results_folder, folder_of(study, scenario))
        results = read_results_with_paths(self.folder)
        self.results = results
        self.maps = [name for name in results.problems if name.startswith(scenario)]
        self.unsolved = sum(not run.solved for run in results.runs)
        self._figures = {}

    def figures(self, measure, variant):
        """Per map; of runs that were solved only."""
        key = measure, variant
        if key not in self._figures:
            of = {}
            for name in self.maps:
                value = middle([run for run in self.results.of(name, variant) if run.solved], measure)
                if not math.isnan(value):
                    of[name] = value
            if measure == 'total':
                of = {name: value + self._world_loading(name) for name, value in of.items()}
            self._figures[key] = of
        return self._figures[key]

    def _world_loading(self, name):
        """Obstacles and distance field, ms: the least of all runs, which is one that loads cells as it needs them.
        The processor time of a run holds all the rest."""
        return min(value_of(run, 'loading') for run in self.results.runs if run.problem == name)


class Scenario:
    """What is known of a scenario on generated maps: times and counts of the factorial, figures of the drives."""

    def __init__(self, results_folder, scenario):
        self.name = scenario
        self.factorial = Study(results_folder, 'factorial', scenario)
        self.drives = Study(results_folder, 'drives', scenario)
        if not self.factorial.maps:
            raise ReportError(f'{self.factorial.folder}: has no runs on maps of the scenario {scenario}')

    def figures(self, measure, algorithm):
        if measure in DRIVEN:
            return self.drives.figures(measure, ALGORITHMS[SAME_PATH.get(algorithm, algorithm)])
        return self.factorial.figures(measure, ALGORITHMS[algorithm])
