"""What scripts/results has measured, read from the raw output of its steps, and the figures that follow from it."""
import glob
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', 'report'))

from database import read_results  # noqa: E402
from formatting import shown_time  # noqa: E402
from planner_statistics import median, quantile  # noqa: E402

OURS = 'improved_astar'
SETS = {'bundled': 'Bundled problems', 'random': 'Random queries', 'tpcap': 'TPCAP\'s cases'}
KEPT = 0.0995  # metres of clearance that count as the preferred 0.1


class Evidence:
    """The raw output of all steps. Members of a step that was not run are empty."""

    def __init__(self, raw):
        self.steps = {}
        for file in sorted(glob.glob(os.path.join(raw, '*', 'step.json'))):
            with open(file, encoding='utf-8') as stream:
                step = json.load(stream)
            if step['complete']:
                self.steps[step['name']] = step
        self._raw = raw
        self.comparisons = {kind: Comparison(results) for kind, results in self._databases('comparison')}
        self.ablations = dict(self._databases('ablation'))
        self.termination = read_results(os.path.join(raw, 'termination')) if 'termination' in self.steps else None
        self.trajectories, self.standstills = (
            {kind: self._plans(f'{name}-{kind}') for kind in SETS if f'{name}-{kind}' in self.steps}
            for name in ('trajectories', 'standstills'))
        # Car -> plans of all scenes.
        self.parkbench = {name.removeprefix('parkbench-'): self._plans(name, False)
                          for name in self.steps if name.startswith('parkbench-') and 'scenes' not in name}
        self.checks = {each['name']: each for each in self._json('checks', 'checks.json').get('benchmarks', [])}
        self.troubles = self._table('troubles', 'troubles.md')
        self.perceived = self._table('perceived', 'perceived.md')
        self.slots = self._text('slots', 'car-slot-table.md')

    def _databases(self, what):
        for kind in SETS:
            if f'{what}-{kind}' in self.steps:
                yield kind, read_results(os.path.join(self._raw, f'{what}-{kind}'))

    def _text(self, step, name):
        if step not in self.steps:
            return ''
        with open(os.path.join(self._raw, step, name), encoding='utf-8') as stream:
            return stream.read()

    def _json(self, step, name):
        return json.loads(self._text(step, name) or '{}')

    def _plans(self, step, only_solved=True):
        """problem -> what parking_plan wrote of it."""
        found = {}
        for file in sorted(glob.glob(os.path.join(self._raw, step, '*.json'))):
            with open(file, encoding='utf-8') as stream:
                plan = json.load(stream)
            if plan.get('status') == 'exact' or not only_solved and 'status' in plan:
                found[os.path.basename(file)[:-len('.json')]] = plan
        return found

    def _table(self, step, name):
        """Rows of a table in Markdown, as lists of cells; the first is that of the headings."""
        lines = self._text(step, name).splitlines()
        return [[cell.strip() for cell in line.strip('|').split('|')] for line in lines
                if line.startswith('|') and not line.startswith('|--')]


class Comparison:
    """Runs of many planners. Its problems are the solvable ones: those that any of the planners solves in any run."""

    def __init__(self, results):
        self.results = results
        self.planners = results.planners
        self.time_limit = results.time_limit
        self.problems = [problem for problem in results.problems
                         if any(run.solved for run in results.runs if run.problem == problem)]
        self.unsolvable = results.unsolvable
        self.unsolved = [problem for problem in results.solvable if problem not in self.problems]
        self.best = {problem: min(run.length for run in results.runs if run.problem == problem) for problem in self.problems}

    def refusals(self, problem):
        """How many planners refuse a problem without a solution in every run, and after which median times."""
        refusing = {}
        for planner in self.planners:
            runs = self.results.of(problem, planner)
            if runs and all(map(self.results.is_refusal, runs)):
                refusing[planner] = median([run.figure('planning time') for run in runs])
        span = ' to '.join(dict.fromkeys(shown_time(pick(refusing.values())) for pick in (min, max) if refusing))
        return f'{problem}, refused in every run by {len(refusing)} planner{"s" if len(refusing) != 1 else ""}{span and " after " + span}'

    def runs(self, planner):
        return [run for problem in self.problems for run in self.results.of(problem, planner)]

    def solved(self, planner):
        return [run for run in self.runs(planner) if run.solved]

    def middle(self, problem, planner, measure):
        """Median over the runs, a run without a path being infinite; measure: time or length."""
        return median([getattr(run, measure) for run in self.results.of(problem, planner)] or [math.inf])

    def common(self, planner, other=OURS):
        """The problems that both solve in more than half of their runs."""
        return [problem for problem in self.problems if math.isfinite(self.middle(problem, planner, 'time'))
                and math.isfinite(self.middle(problem, other, 'time'))]

    def ratio(self, planner, measure, other=OURS):
        """Median over the common problems of the planner's median over the other's."""
        return median([self.middle(problem, planner, measure) / self.middle(problem, other, measure)
                       for problem in self.common(planner, other)])

    def time(self, planner, share):
        """Quantile of the time to the first path, over all runs."""
        return quantile([run.time for run in self.runs(planner)], share)

    def of_solved(self, planner, column):
        """Median over the solved runs."""
        return median([run.figure(column) for run in self.solved(planner)])

    def over_best(self, planner, first):
        """Median over the solved runs of the first or the last path's length over the shortest that is known."""
        return median([(run.improvements[0][1] if first else run.length) / self.best[run.problem]
                       for run in self.solved(planner)])

    def share_over_time(self, planner):
        """Points (seconds, share of the runs solved by then)."""
        runs = self.runs(planner)
        times = sorted(run.time for run in runs if run.solved)
        return [(time, (k + 1) / len(runs)) for k, time in enumerate(times)]

    def length_over_time(self, planner, steps=120, start=1e-4):
        """Points (seconds, median over all runs of the length by then over the shortest that is known)."""
        runs, points = self.runs(planner), []
        for k in range(steps + 1):
            time = start * (self.time_limit / start) ** (k / steps)
            ratio = median([min((length for moment, length in run.improvements if moment <= time), default=math.inf)
                            / self.best[run.problem] for run in runs])
            if math.isfinite(ratio) and (not points or ratio != points[-1][1]):
                points.append((time, ratio))
        return points

    def shorter(self, planner):
        """(share, problem) where its median path is shorter than ours, the largest share first."""
        gains = ((1.0 - self.middle(problem, planner, 'length') / self.middle(problem, OURS, 'length'), problem)
                 for problem in self.common(planner))
        return sorted((gain for gain in gains if gain[0] > 0.005), reverse=True)

    def earlier(self, planner):
        """The problems on which its first path comes sooner than ours."""
        return [problem for problem in self.common(planner)
                if self.middle(problem, planner, 'time') < self.middle(problem, OURS, 'time')]


def together(results, planner):
    """(set, problem) -> the runs of a planner, of several comparisons."""
    return {(kind, problem): each.of(problem, planner) for kind, each in results.items() for problem in each.problems}


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values)) if values else math.nan


class Variant:
    """One variant of our planner beside the usual one, on the problems of all sets. Values are medians over the runs."""

    def __init__(self, results, name):
        own, usual = together(results, name), together(results, OURS)
        both = [key for key in own if own[key] and all(run.solved for run in own[key] + usual[key])]

        def middle(runs, of):
            return median([of(run) for run in runs])
        # Of the problems that any variant solves.
        planners = next(iter(results.values())).planners
        solvable = {key for planner in planners for key, runs in together(results, planner).items()
                    if any(run.solved for run in runs)}
        self.problems = len(solvable)
        self.solved = sum(any(run.solved for run in own[key]) for key in solvable)
        self.compared = len(both)
        times = [middle(own[key], lambda run: run.time) for key in both]
        ratios = [time / middle(usual[key], lambda run: run.time) for time, key in zip(times, both)]
        self.time_ratio = geometric_mean(ratios)
        self.slow = quantile(times, 0.99)
        self.length_ratio = geometric_mean([
            middle(own[key], lambda run: run.length) / middle(usual[key], lambda run: run.length) for key in both])
        self.cusps = sum(middle(own[key], lambda run: run.figure('cusps')) for key in both)
        self.more_cusps = self.cusps - sum(middle(usual[key], lambda run: run.figure('cusps')) for key in both)
        self.kept = sum(middle(own[key], lambda run: run.figure('least_clearance')) >= KEPT for key in both)


def delays(results):
    """planner -> seconds by which its runs that used up their time ended after it."""
    limit = results.time_limit
    return {planner: [run.figure('time') - limit for run in results.runs
                      if run.planner == planner and run.figure('time') >= 0.999 * limit] for planner in results.planners}
