"""docs/results.md and what belongs to it, from the evidence: pure functions from raw output to text."""
import glob
import json
import math
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', 'report'))

from curves import step_curves  # noqa: E402
from evidence import OURS, SETS, Variant, delays  # noqa: E402
from formatting import shown, shown_in, shown_time  # noqa: E402
from planner_statistics import median, quantile  # noqa: E402

FIGURE = re.compile(r'(<!--figure ([\w.-]+)-->)(.*?)(<!--/figure-->)', re.DOTALL)
TABLE = re.compile(r'(<!-- results -->\n).*?(<!-- /results -->)', re.DOTALL)
IMPROVING = ('improved_astar_anytime', 'RRTstar', 'PRMstar', 'BITstar')
VARIANTS = {  # of the ablation
    'improved_astar': 'all abilities', 'from_the_start': 'one search, from the start',
    'from_the_goal': 'one search, from the goal', 'one_resolution': 'without finer levels',
    'no_obstacle_heuristic': 'without the route round obstacles',
    'no_detours': 'without detours', 'no_shortening': 'without improving the path',
    'no_clearance': 'without preferred clearance',
    'admissible_weights': 'both weights 1', 'five_steering_angles': 'five steering angles instead of three',
    'hybrid_astar': '`hybrid_astar`: all of these off'}
CHECKS = {'polygons/free': 'polygons, more than 1 m away', 'polygons/mixed': 'polygons, anywhere',
          'polygons/tight': 'polygons, within 0.5 m of contact', 'grid/free': 'map, more than 1 m away',
          'grid/mixed': 'map, anywhere', 'grid/tight': 'map, within 0.5 m of contact',
          'search/both_ends': 'a parking search from both ends', 'search/from_slot': 'a parking search out of the slot'}
SHOWN_CHECKS = ('polygons/mixed', 'polygons/tight', 'grid/mixed', 'search/both_ends')  # others are figures only
VALIDATORS = {'swept': '`SweptMotionValidator`', 'curve_once_2cm': '`ReedsSheppMotionValidator`, every 2 cm',
              'discrete_2cm': '`DiscreteMotionValidator`, every 2 cm',
              'discrete_2cm_plain_fcl': '`DiscreteMotionValidator`, every 2 cm, FCL alone'}
NANOSECONDS = {'ns': 1.0, 'us': 1e3, 'ms': 1e6, 's': 1e9}


def markdown(headings, rows):
    lines = [headings, ['---'] + ['--:'] * (len(headings) - 1), *rows]
    return '\n'.join('| ' + ' | '.join(cells) + ' |' for cells in lines)


def times(ratio):
    """A ratio, as it is read: 0.98, 1.40, 2.5, 25."""
    return f'{ratio:.2f}' if 0.1 <= ratio < 1.995 else shown(ratio, 2)


def centimetres(metres):
    return shown(100.0 * metres, 2)


def seconds_of(check):
    return check['cpu_time'] * NANOSECONDS[check['time_unit']] * 1e-9


def count(number, noun):
    return f'{number} {noun}' + ('' if number == 1 else 's')


class Figures:
    """What other pages quote: name -> value, text and command."""

    def __init__(self, evidence):
        self._steps = evidence.steps
        self.found = {}

    def add(self, name, value, text, step):
        if value is not None and not (isinstance(value, float) and not math.isfinite(value)):
            self.found[name] = {'value': value, 'text': text, 'command': self._steps[step]['command']}


# ---- sections of the page: each returns a list of paragraphs, and adds its figures -----------------------------------

def comparison_rows(comparison):
    for planner in sorted(comparison.planners, key=lambda name: (-len(comparison.solved(name)), comparison.time(name, 0.5))):
        runs, good, common = comparison.runs(planner), comparison.solved(planner), comparison.common(planner)
        yield [planner, f'{len(good)} of {len(runs)}', str(len(common)), times(comparison.ratio(planner, 'time')),
               times(comparison.ratio(planner, 'length')), shown(comparison.of_solved(planner, 'cusps'), 2),
               centimetres(comparison.of_solved(planner, 'least_clearance')), shown_time(comparison.time(planner, 0.5)),
               shown_time(comparison.time(planner, 0.99))]


def ahead(comparison):
    """Where others are ahead of us, on more than one problem in ten."""
    said = []
    for planner in comparison.planners:
        if planner in (OURS, 'improved_astar_anytime') or not comparison.common(planner):
            continue
        earlier, shorter = comparison.earlier(planner), comparison.shorter(planner)
        parts = [f'earlier on {len(earlier)}'] if earlier else []
        if shorter:
            parts.append(f'shorter on {len(shorter)} (by {100.0 * shorter[0][0]:.0f} % on `{shorter[0][1]}`)')
        if 10 * max(len(earlier), len(shorter)) > len(comparison.common(planner)):
            said.append(f'{planner} {" and ".join(parts)} of {len(comparison.common(planner))}')
    unsolved = [problem for problem in comparison.problems if not math.isfinite(comparison.middle(problem, OURS, 'time'))]
    text = f'Ahead of `{OURS}` on a tenth of the problems in common or more: ' + ('; '.join(said) if said else 'none') + '.'
    return text + (' It leaves unsolved: ' + ', '.join(f'`{name}`' for name in unsolved) + '.' if unsolved else '')


def compared(evidence, figures):
    made = []
    for kind, comparison in evidence.comparisons.items():
        step = f'comparison-{kind}'
        headings = ['planner', 'solved', 'in common', 'time ratio', 'length ratio', 'changes of direction',
                    'clearance, cm', 'first path', '99 %']
        unsolved = comparison.unsolved
        about = f'{count(len(comparison.problems), "problem")}, {comparison.time_limit:g} s.'
        if comparison.unsolvable:
            about += f' Without a solution: {"; ".join(map(comparison.refusals, comparison.unsolvable))}.'
        if unsolved:
            them = 'it' if len(unsolved) == 1 else 'them'
            about += f' Left out, since no planner solves {them}: {", ".join(unsolved)}.'
        made += [f'### {SETS[kind]}', f'`{evidence.steps[step]["command"]}`', about,
                 markdown(headings, list(comparison_rows(comparison))), ahead(comparison),
                 f'![Runs solved over time](results/solved-{kind}.svg)']
        good, runs = len(comparison.solved(OURS)), len(comparison.runs(OURS))
        figures.add(f'{kind}.solved', good / runs, f'{good} of {runs}', step)
        figures.add(f'{kind}.problems', len(comparison.problems), str(len(comparison.problems)), step)
        for name, share in (('first_path', 0.5), ('first_path_99', 0.99)):
            value = comparison.time(OURS, share)
            figures.add(f'{kind}.{name}', value, shown_time(value), step)
        for planner in comparison.planners:
            own, all_own = len(comparison.solved(planner)), len(comparison.runs(planner))
            figures.add(f'{kind}.{planner}.solved', own / all_own, f'{own} of {all_own}', step)
            for measure in ('time', 'length'):
                value = comparison.ratio(planner, measure)
                figures.add(f'{kind}.{planner}.{measure}_ratio', value, times(value), step)
    return made


def repeated_calls(evidence, figures):
    rows = []
    for kind, plans in evidence.trajectories.items():
        first = [plan['planning_time_ms'][0] * 1e-3 for plan in plans.values()]
        later = [median(plan['planning_time_ms'][1:]) * 1e-3 for plan in plans.values() if len(plan['planning_time_ms']) > 1]
        rows.append([SETS[kind], str(len(first)), times(median([a / b for a, b in zip(first, later)])),
                     *(shown_time(median(values)) for values in (first, later))])
        figures.add(f'{kind}.first_call', median(first), shown_time(median(first)), f'trajectories-{kind}')
        figures.add(f'{kind}.repeated_call', median(later), shown_time(median(later)), f'trajectories-{kind}')
    if not rows:
        return []
    return ['## First calls',
            'The first call of a process is slower than those that follow. Times are by the clock on the wall, '
            'over the problems solved.', f'`{next(iter(step_commands(evidence, "trajectories")))}`',
            markdown(['problems', 'solved', 'first over later', 'first call', 'later calls'], rows)]


def step_commands(evidence, name):
    return [step['command'] for key, step in evidence.steps.items() if key.startswith(name)]


def anytime(evidence, figures):
    made = []
    for planner in IMPROVING:
        if not any(planner in comparison.planners for comparison in evidence.comparisons.values()):
            continue
        row = [planner]
        for kind, comparison in evidence.comparisons.items():
            first, last = comparison.over_best(planner, True), comparison.over_best(planner, False)
            row += [shown(first), shown(last)]
            if planner == 'improved_astar_anytime' and comparison.solved(planner):
                figures.add(f'{kind}.anytime_gain', 1.0 - last / first, f'{100.0 * (1.0 - last / first):.1f} %',
                            f'comparison-{kind}')
        made.append(row)
    headings = ['planner', *(f'{kind}: {which}' for kind in evidence.comparisons for which in ('first', 'last'))]
    return ['## More time',
            'Length of the first and of the last path over the shortest that is known, medians over the solved '
            'runs. The curves count unsolved runs as infinitely long, and begin where half are solved.',
            *([markdown(headings, made)] if made else []), *(f'![Length over time, {SETS[kind]}](results/length-{kind}.svg)'
                                        for kind in evidence.comparisons)] if evidence.comparisons else []


def ablation(evidence, figures):
    if not evidence.ablations:
        return []
    rows, known = [], next(iter(evidence.ablations.values())).planners
    step = next(name for name in evidence.steps if name.startswith('ablation'))
    for name, text in VARIANTS.items():
        if name in known:
            each = Variant(evidence.ablations, name)
            rows.append([text, f'{each.solved} of {each.problems}', times(each.time_ratio), times(each.length_ratio),
                         f'{each.more_cusps:+.0f}', f'{each.kept} of {each.compared}', shown_time(each.slow)])
            figures.add(f'ablation.{name}.solved', each.solved, f'{each.solved} of {each.problems}', step)
            figures.add(f'ablation.{name}.time_ratio', each.time_ratio, times(each.time_ratio), step)
            figures.add(f'ablation.{name}.length_ratio', each.length_ratio, times(each.length_ratio), step)
    return ['## Ablation', 'Each ability is switched off alone, on all problems above. Ratios to all abilities are geometric '
            'means over the problems that both solve in every run. Cusps are the difference of the sums; 10 cm counts the '
            'paths that keep the preferred clearance.', f'`{evidence.steps[step]["command"]}`',
            markdown(['variant', 'solved', 'time ratio', 'length ratio', 'changes', '10 cm', '99 % of times'], rows)]


def checks(evidence, figures):
    found = evidence.checks
    if not found:
        return []
    rows = []
    for name, text in CHECKS.items():
        plain, tiers = found.get(f'stateCheck/{name}/plain_fcl'), found.get(f'stateCheck/{name}/two_tier')
        if plain and tiers:
            if name in SHOWN_CHECKS:
                rows.append([text, times(seconds_of(plain) / seconds_of(tiers)),
                             *(f'{shown(1e9 * seconds_of(each), 2)} ns' for each in (tiers, plain))])
            figures.add(f'checks.{name.replace("/", ".")}', 1e9 * seconds_of(tiers), f'{shown(1e9 * seconds_of(tiers), 2)} ns',
                        'checks')
            figures.add(f'checks.{name.replace("/", ".")}.ratio', seconds_of(plain) / seconds_of(tiers),
                        times(seconds_of(plain) / seconds_of(tiers)), 'checks')
    motions = []
    for name, text in VALIDATORS.items():
        pairs = [(found.get(f'motionCheck/{which}/{name}'), found.get(f'motionCheck/{which}/swept'))
                 for which in ('random', 'valid')]
        if all(all(pair) for pair in pairs):
            cells = [text]
            for (own, swept), which in zip(pairs, ('random', 'free')):
                cells += [times(seconds_of(own) / seconds_of(swept)), shown_time(seconds_of(own))]
                figures.add(f'checks.motion.{which}.{name}_ratio', seconds_of(own) / seconds_of(swept),
                            times(seconds_of(own) / seconds_of(swept)), 'checks')
            motions.append(cells)
    for size in (200, 500, 1000, 2000):
        for name, benchmark in (('field', 'distanceField'), ('map', 'checkerOfMap')):
            each = found.get(f'{benchmark}/{size}')
            if each:
                figures.add(f'checks.{name}.{size}', seconds_of(each), shown_time(seconds_of(each)), 'checks')
    text = []
    wrong = next((each for name, each in found.items() if name.startswith('wrongMotions')), None)
    if wrong:
        figures.add('checks.wrong.swept', wrong['swept accepts wrongly'], f'{wrong["swept accepts wrongly"]:.0f}', 'checks')
        figures.add('checks.wrong.discrete', wrong['discrete_2cm accepts wrongly'], 
                    f'{wrong["discrete_2cm accepts wrongly"]:.0f}', 'checks')
        text = [f'Of {wrong["motions"]:.0f} random Reeds-Shepp motions {wrong["free"]:.0f} are free. The swept check accepts '
                f'{wrong["swept accepts wrongly"]:.0f} of the others, a look every 2 cm '
                f'{wrong["discrete_2cm accepts wrongly"]:.0f}. The swept check refuses '
                f'{wrong["swept refuses for its tolerance"]:.0f} of the free ones, which pass within its tolerance.']
    return ['## Footprint checks', f'`{evidence.steps["checks"]["command"]}`', 'Mean processor time of a check of one pose:',
            markdown(['poses', 'faster than FCL alone', 'two tiers', 'FCL alone'], rows), 'Of one motion:',
            markdown(['checker', 'random: ratio', 'time', 'free: ratio', 'time'], motions), *text]


def quotients(optimised, standing):
    """Duration of the trajectory over that of the drive which stops to steer, of the problems that have both."""
    return [plan['trajectory_optimization']['duration_s'] / standing[name]['tracking']['travel_time_s']
            for name, plan in optimised.items() if 'trajectory_optimization' in plan
            and standing.get(name, {}).get('tracking', {}).get('arrived')]


def trajectories(evidence, figures):
    rows, drives = [], []
    for kind, plans in evidence.trajectories.items():
        step = f'trajectories-{kind}'
        made = [plan['trajectory_optimization'] for plan in plans.values() if plan.get('trajectory_optimization')]
        if not made:
            continue
        ratio = median(quotients(plans, evidence.standstills.get(kind, {})))
        spent, total = [each['time_ms'] * 1e-3 for each in made], sum(each['duration_s'] for each in made)
        fallbacks = sum(each['fallback'] for each in made)
        rows.append([SETS[kind], str(len(made)), str(fallbacks), times(ratio), f'{shown(total, 4)} s',
                     shown_time(median(spent)), shown_time(quantile(spent, 0.99))])
        for name, value, text in (('total', total, f'{shown(total, 4)} s'), ('fallbacks', fallbacks, str(fallbacks)),
                                  ('ratio', ratio, times(ratio)), ('time', median(spent), shown_time(median(spent))),
                                  ('time_99', quantile(spent, 0.99), shown_time(quantile(spent, 0.99)))):
            figures.add(f'{kind}.trajectory.{name}', value, text, step)
        driven = [plan['tracking'] for plan in plans.values() if plan.get('tracking')]
        final, largest = (max(each[name] for each in driven) for name in ('final_position_error_m', 'max_position_error_m'))
        middle, late = (median([each['mpc_solve_ms'][name] for each in driven]) * 1e-3 for name in ('median', 'p99'))
        arrived, touched = sum(each['arrived'] for each in driven), sum(each['collisions'] > 0 for each in driven)
        drives.append([SETS[kind], f'{arrived} of {len(driven)}', str(touched), centimetres(final), centimetres(largest),
                       shown_time(middle), shown_time(late)])
        for name, value, text in (('arrived', arrived, f'{arrived} of {len(driven)}'), ('touching', touched, str(touched)),
                                  ('final_error', final, f'{centimetres(final)} cm'),
                                  ('largest_error', largest, f'{centimetres(largest)} cm'),
                                  ('step', middle, shown_time(middle)), ('step_99', late, shown_time(late))):
            figures.add(f'{kind}.drive.{name}', value, text, step)
    if not rows:
        return []
    return ['## Trajectories',
            f'`{step_commands(evidence, "trajectories")[0]}`', '*Ratio*: median of the duration over that of a '
            'drive along the planned path that stops to steer (`parking_plan NAME --track`). *Fallback*: the result is such a '
            'drive. Every problem is in [trajectories](results/trajectories.md).',
            markdown(['problems', 'solved', 'fallback', 'ratio', 'durations, sum', 'optimising', '99 %'], rows),
            '## Drives', 'The model predictive controller drives the trajectories above without disturbances. Errors are the '
            'largest of all drives; times of a step are medians over the drives.',
            markdown(['problems', 'arrived', 'touching', 'final error, cm', 'largest error, cm', 'step', '99 %'], drives)]


PARKBENCH = ['## ParkBench', """ParkBench is a set of recorded scenes in which a car reverses into its place
([scenes](https://github.com/dqm5rtfg9b-collab/Constrained_Parking_Scenarios); FOLDER is your own copy).

- *Published, not measured here*: a learned policy surpasses classical planners "by +96% in success rate and +52% in
  efficiency" (F. Tao and others, [arXiv 2601.22545](https://arxiv.org/abs/2601.22545), abstract).
- *Measured here*: `improved_astar` with three cars of the catalogue. The scenes have no car, so the two differ in the car.

Obstacles under the car at its goal, and outliers, are left out ([scenarios](scenarios.md#other-formats)). The tables show
median and largest value of the solved scenes. *Planning* of a scene is the median of its calls, by the clock on the wall."""]


def parkbench(evidence, figures):
    if not evidence.parkbench:
        return []

    def spread(values, show):
        return [show(quantile(values, share)) for share in (0.5, 1.0)]
    paths, motions = [], []
    for car, plans in sorted(evidence.parkbench.items()):
        good = [plan for plan in plans.values() if plan['status'] == 'exact']
        made = [plan['trajectory_optimization'] for plan in good if 'duration_s' in plan['trajectory_optimization']]
        planning = [median(plan['planning_time_ms']) * 1e-3 for plan in good]
        optimising, fallbacks = [each['time_ms'] * 1e-3 for each in made], sum(each['fallback'] for each in made)
        solved = f'{len(good)} of {len(plans)}'
        paths.append([car, solved, *spread(planning, shown_time),
                      *spread([plan['length_m'] for plan in good], lambda length: shown_in(length, 'm')),
                      *spread([plan['cusps'] for plan in good], lambda cusps: shown(cusps, 1))])
        motions.append([car, f'{len(made)} of {len(plans)}', str(fallbacks),
                        *spread([each['duration_s'] for each in made], lambda duration: shown_in(duration, 's')),
                        *spread(optimising, shown_time)])
        for name, value, text in (('solved', len(good) / len(plans), solved), ('fallbacks', fallbacks, str(fallbacks)),
                                  ('slowest', quantile(planning, 1.0), paths[-1][3]),
                                  ('slowest_trajectory', quantile(optimising, 1.0), motions[-1][-1])):
            figures.add(f'parkbench.{car}.{name}', value, text, f'parkbench-{car}')
    return [*PARKBENCH, *(f'`{command}`' for command in dict.fromkeys(step_commands(evidence, 'parkbench'))),
            markdown(['car', 'solved', 'planning', 'slowest', 'length', 'longest', 'cusps', 'most'], paths),
            'The trajectories along these paths:',
            markdown(['car', 'made', 'fallback', 'duration', 'longest', 'optimising', 'slowest'], motions)]


def troubles(evidence, figures):
    if len(evidence.troubles) < 2:
        return []
    headings, *rows = evidence.troubles
    wanted = [headings.index(name) for name in ('trouble', 'drives', 'parked', 'stopped, touching nothing', 'could be avoided')]
    hit, other = headings.index('and was hit'), headings.index('anything else was hit')
    for name, place in (('drives', wanted[1]), ('parked', wanted[2]), ('avoidable', wanted[4]), ('hit', hit), ('other', other)):
        value = sum(int(row[place]) for row in rows)
        figures.add(f'troubles.{name}', value, str(value), 'troubles')
    return ['Disturbed drives, in which an obstacle may appear:', f'`{evidence.steps["troubles"]["command"]}`',
            markdown(['trouble', 'drives', 'parked', 'stopped free', 'avoidable obstacles', 'of these hit', 'else hit'],
                     [[row[place] for place in (*wanted, hit, other)] for row in rows])]


def perceived(evidence, figures):
    if len(evidence.perceived) < 2:
        return []
    headings, *rows = evidence.perceived
    for name in ('drives', 'parked', 'avoidable hits', 'stops'):
        value = int(rows[0][headings.index(name)])
        figures.add(f'perceived.{name.split()[0]}', value, str(value), 'perceived')
    return ['## Drives by a sensor',
            'The car knows what a sensor of 20 m has seen. In most drives a box appears in front of it.',
            *(f'`{evidence.steps[step]["command"]}`' for step in ('perceived-queries', 'perceived')),
            markdown(headings, rows),
            '*Avoidable*: by a full brake, known for the first car only. *Time*: relative to a drive that knows the world. *Changes of '
            'mind*: plans that leave the one before by more than 0.5 m. Times of computing: median / 99 % / largest.']


def termination(evidence, figures):
    if evidence.termination is None:
        return []
    rows = []
    for planner, late in delays(evidence.termination).items():
        if late:
            rows.append([planner, str(len(late)), shown_time(max(0.0, median(late))), shown_time(max(0.0, max(late)))])
            figures.add(f'termination.{planner}', max(late), shown_time(max(0.0, max(late))), 'termination')
    return ['## Ending in time', f'`{evidence.steps["termination"]["command"]}`',
            f'Delay between the end of {1e3 * evidence.termination.time_limit:g} ms and the return of `solve()`, by the clock '
            'on the wall, of the runs that used up their time:',
            markdown(['planner', 'runs', 'delay, median', 'largest'], rows)]


# ---- the page, its attachments and curves ----------------------------------------------------------------------------

def provenance(evidence):
    """Version, commit, processor and date of all steps; several where they differ."""
    def all_of(name):
        return ', '.join(dict.fromkeys(str(step[name]) for step in evidence.steps.values() if step[name]))
    libraries = next((comparison.results.versions[0] for comparison in evidence.comparisons.values()
                      if comparison.results.versions), '')
    text = f'Version {all_of("version")}, commit {all_of("commit") or "unknown"}; {all_of("processor")}, '
    text += f'{all_of("cores")} cores; {all_of("date")}.'
    return text + (f' Built with {libraries.split(", ", 1)[1]}.' if ', ' in libraries else '')


def introduction(evidence):
    quick = any(step['amount'] == 'quick' for step in evidence.steps.values())
    command = 'scripts/results' + (' --quick' if quick else '') + (' --data FOLDER' if 'tpcap' in evidence.comparisons or evidence.parkbench else '')
    text = ['# Results',
            f'How well do planner, footprint checks, trajectories and drives perform? `{command}` measures and writes '
            'this page, its [attachments](results) and all figures that other pages quote.', provenance(evidence)]
    if quick:
        text.append('**This is a quick run: few runs, short limits. It shows that the command works and proves nothing.**')
    text += [f'The random queries: `{evidence.steps["queries"]["command"]}`.' if 'queries' in evidence.steps else '']
    if 'tpcap' in evidence.comparisons:
        text.append('TPCAP\'s cases are not part of this project: FOLDER is your own copy.')
    return [each for each in text if each]


COMPARED = ['## Planners compared', f"""All planners use the same space, footprint checks and recheck of every path.
`hybrid_astar` is the core of `{OURS}`, from the start and without its improvements; `textbook_hybrid_astar` shares
only the checks. Times and limits are processor time.

- *Solved*: runs with a valid path to the goal, of all runs.
- *In common*: problems that the planner and `{OURS}` both solve in more than half of their runs. *Ratios* are medians
  over these of the planner's median over ours, for the time to the first path and for the length of the last.
- *Cusps* (changes of direction) and least *clearance*: medians over the solved runs.
- *First path* and *99 %*: quantiles of the time to the first path over all runs; an unsolved run takes ∞."""]


def problems_page(evidence):
    made = ['# Every problem of the comparison',
            'Which problem costs each planner how much? Medians over the runs on a problem: time to '
            f'the first path, and length of the last over the shortest that is known. Made by `scripts/results`; see '
            '[results](../results.md).', provenance(evidence)]
    for kind, comparison in evidence.comparisons.items():
        rows = []
        for problem in comparison.problems:
            cells = [(comparison.middle(problem, planner, 'time'), comparison.middle(problem, planner, 'length'))
                     for planner in comparison.planners]
            best = comparison.best[problem]
            rows.append([problem, *(f'{shown_time(time)}, {shown(length / best)}' if math.isfinite(time) else '–'
                                    for time, length in cells)])
        made += [f'## {SETS[kind]}', f'`{evidence.steps[f"comparison-{kind}"]["command"]}`',
                 markdown(['problem', *comparison.planners], rows)]
    return '\n\n'.join(made) + '\n'


def trajectories_page(evidence):
    made = ['# Every trajectory',
            'How long does the optimised trajectory of each problem take? Beside it the drive that stops to '
            'steer, the cost J of TPCAP, the time of optimising, and how the controller drives it. Made by `scripts/results`; '
            'see [results](../results.md).', provenance(evidence)]
    for kind, plans in evidence.trajectories.items():
        rows = []
        for name, plan in plans.items():
            found, drive = plan.get('trajectory_optimization') or {}, plan.get('tracking') or {}
            standing = evidence.standstills.get(kind, {}).get(name, {}).get('tracking') or {}
            if found:
                rows.append([name, str(plan['cusps']), shown(found['duration_s']),
                             shown(standing.get('travel_time_s', math.nan)), 'yes' if found['fallback'] else 'no',
                             shown(found['tpcap_cost']['J'], 4),
                             shown_time(found['time_ms'] * 1e-3), shown(drive.get('travel_time_s', math.nan)),
                             centimetres(drive.get('max_position_error_m', math.nan)),
                             centimetres(drive.get('min_clearance_m', math.nan)), str(drive.get('collisions', '–'))])
        made += [f'## {SETS[kind]}', f'`{evidence.steps[f"trajectories-{kind}"]["command"]}`', markdown(
            ['problem', 'changes of direction', 'optimised, s', 'stopping to steer, s', 'fallback', 'J', 'optimising', 'driven, s',
             'largest error, cm', 'clearance, cm', 'collisions'], rows)]
    return '\n\n'.join(made) + '\n'


def readme_table(evidence):
    """The table of the README: of the bundled problems and the random queries."""
    kinds = [kind for kind in ('bundled', 'random') if kind in evidence.comparisons]
    planners = evidence.comparisons[kinds[0]].planners if kinds else []
    rows = []
    for planner in sorted(planners, key=lambda name: -sum(len(evidence.comparisons[kind].solved(name)) for kind in kinds)):
        row = [planner]
        for kind in kinds:
            each = evidence.comparisons[kind]
            row += [f'{len(each.solved(planner))} of {len(each.runs(planner))}', times(each.ratio(planner, 'time')),
                    times(each.ratio(planner, 'length'))]
        rows.append(row)
    headings = ['planner', *(f'{SETS[kind].split()[0].lower()}: {what}' for kind in kinds
                             for what in ('solved', 'time ratio', 'length ratio'))]
    return f'{markdown(headings, rows)}\n\n{provenance(evidence)}\n'


def curves(evidence):
    made = {}
    for kind, comparison in evidence.comparisons.items():
        solved = {f'{planner} {100.0 * len(comparison.solved(planner)) / len(comparison.runs(planner)):.0f} %':
                  [(1e-4, 0.0), *comparison.share_over_time(planner)] for planner in comparison.planners}
        made[f'docs/results/solved-{kind}.svg'] = step_curves(
            solved, (1e-4, comparison.time_limit), (0.0, 1.0), 'time to the first path', 'runs solved',
            lambda share: f'{100.0 * share:.0f} %')
        lengths = {planner: comparison.length_over_time(planner) for planner in comparison.planners}
        made[f'docs/results/length-{kind}.svg'] = step_curves(
            lengths, (1e-4, comparison.time_limit), (1.0, 2.0),
            'time', 'length over the shortest', lambda ratio: f'{ratio:.1f}')
    return made


def pages_of(evidence):
    """(name of a file of the project -> its text, figures, table of the README)."""
    figures = Figures(evidence)
    page = introduction(evidence)
    parts = compared(evidence, figures)
    page += (COMPARED + parts + ['Each problem is in [problems](results/problems.md).']) if parts else []
    for section in (repeated_calls, anytime, ablation, checks, trajectories, troubles, perceived, parkbench, termination):
        page += section(evidence, figures)
    if evidence.slots:
        page.append('Which car parks in which slot, in how many stretches: [cars in slots](results/car-slot-table.md).')
    made = {'docs/results.md': '\n\n'.join(page) + '\n',
            'docs/results/problems.md': problems_page(evidence), 'docs/results/trajectories.md': trajectories_page(evidence),
            'docs/results/figures.json': json.dumps(figures.found, indent=1, ensure_ascii=False, sort_keys=True) + '\n',
            **curves(evidence)}
    if evidence.slots:
        made['docs/results/car-slot-table.md'] = evidence.slots
    return made, figures.found, readme_table(evidence)


# ---- figures in other pages --------------------------------------------------------------------------------------------

def documents_with_figures(root):
    """name -> text of the pages that may quote figures."""
    names = ['README.md', *(os.path.relpath(file, root) for file in sorted(glob.glob(os.path.join(root, 'docs', '*.md'))))]
    found = {}
    for name in names:
        if name != 'docs/results.md':
            with open(os.path.join(root, name), encoding='utf-8') as stream:
                found[name] = stream.read()
    return found


def fill_documents(documents, figures, table):
    """The documents that change. A marker without a figure keeps its text, and is a fault for tests/style/check_figures.py."""
    changed = {}
    for name, text in documents.items():
        filled = FIGURE.sub(lambda found: found.group(1) + figures.get(found.group(2), {'text': found.group(3)})['text']
                            + found.group(4), text)
        filled = TABLE.sub(lambda found: found.group(1) + table + found.group(2), filled)
        if filled != text:
            changed[name] = filled
    return changed

