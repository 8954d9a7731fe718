"""All ratios of the paper beside ours, with verdicts and with what was measured beside them."""
import dataclasses

from formatting import shown
from design import ALGORITHMS
from paired import Comparison, compare, correct, verdict, way_of
from published import WHAT, ratio_rows

MEASURE_NAMES = {'loading': 'map loading', 'planning': 'planning', 'total': 'loading and planning',
                 'acceleration': 'mean acceleration', 'steering': 'mean steering', 'length': 'path length',
                 'travel': 'travel time'}
# What is looked at beside a ratio: quantities that the machine's load does not touch.
BESIDE = {'loading': ('cells',), 'planning': ('expanded',), 'total': ('cells', 'expanded'),
          'length': ('turning',), 'travel': ('turning', 'length'), 'acceleration': ('turning', 'travel'),
          'steering': ('turning',)}
BESIDE_NAMES = {'cells': 'cells and poses looked at', 'expanded': 'nodes expanded', 'turning': 'turning along the path',
                'length': 'path length', 'travel': 'travel time', 'unsmoothed': 'the same without smoothing in either'}
TIMES = ('planning', 'total')


@dataclasses.dataclass
class Row:
    scenario: str
    measure: str
    first: str
    second: str
    paper: float
    ours: Comparison
    verdict: str = ''
    beside: list = dataclasses.field(default_factory=list)  # (name, Comparison)


def unsmoothed(variant):
    return variant.replace('none', '').replace('s', '') or 'none'


def beside_of(scenario, measure, first, second):
    """Of two algorithms, what else differs between them."""
    found = [(name, compare(scenario.figures(name, first), scenario.figures(name, second)))
             for name in BESIDE.get(measure, ())]
    if measure in TIMES:
        plain = [unsmoothed(ALGORITHMS[name]) for name in (first, second)]
        if plain != [ALGORITHMS[first], ALGORITHMS[second]] and plain[0] != plain[1]:
            figures = [scenario.factorial.figures(measure, variant) for variant in plain]
            found.append(('unsmoothed', compare(*figures)))
    return found


def rows_of(scenarios):
    """scenarios: Scenario by name. The rows of one scenario are one family of tests."""
    rows = [Row(name, measure, first, second, paper,
                compare(scenarios[name].figures(measure, first), scenarios[name].figures(measure, second)))
            for name, measure, first, second, paper in ratio_rows()]
    for name in scenarios:
        correct([row.ours for row in rows if row.scenario == name])
    for row in rows:
        row.verdict = verdict(way_of(row.paper), row.ours.way())
        row.beside = beside_of(scenarios[row.scenario], row.measure, row.first, row.second)
    return rows


def sentence(row):
    """What goes with a ratio and what does not, from the figures alone; empty where neither is certain.

    A quantity goes with a ratio when both are certainly above, or both certainly below 1. It is no proof of a cause."""
    way = row.ours.way()
    if way not in ('more', 'less'):
        return ''
    parts = {'with': [], 'although': []}
    for name, comparison in row.beside:
        other = comparison.way(corrected=False)
        if other in ('more', 'less'):
            parts['with' if other == way else 'although'].append(f'{BESIDE_NAMES[name]} × {shown(comparison.middle)}')
        elif other == 'same' and name != 'unsmoothed':
            parts['although'].append(f'{BESIDE_NAMES[name]} the same')
    return '; '.join(f'{word} {", ".join(texts)}' for word, texts in parts.items() if texts)


def named(algorithm):
    return algorithm.replace('_', ' ').replace('*', '\\*')


def shown_interval(comparison, count=0):
    if not comparison.ratios:
        return '–'
    if not comparison.certain:
        return f'**{shown(comparison.middle)}**'
    few = f', {len(comparison.ratios)} maps' if len(comparison.ratios) < count else ''
    return f'**{shown(comparison.middle)}** ({shown(comparison.low)} to {shown(comparison.high)}{few})'


def shown_chance(chance):
    return '< 0.001' if chance < 0.001 else f'{chance:.3f}' if chance < 0.1 else f'{chance:.2f}'


def ratio_table(rows, count):
    lines = ['| ratio | paper | ours | p | | beside it |', '| --- | ---: | ---: | ---: | --- | --- |']
    for row in rows:
        lines.append(f'| {MEASURE_NAMES[row.measure]}: {named(row.first)} / {named(row.second)} | {shown(row.paper)} | '
                     f'{shown_interval(row.ours, count)} | {shown_chance(row.ours.chance)} | {row.verdict} | {sentence(row)} |')
    return '\n'.join(lines)


def counted(rows):
    counts = {name: sum(row.verdict == name for row in rows) for name in ('agrees', 'differs', 'opposite', 'unclear')}
    return ', '.join(f'{count} × {name}' for name, count in counts.items() if count)


def headline_answer(claim, reduced):
    """reduced: the Comparison of the improved figure with the other one. Whether there is less at all follows the rule of
    all verdicts, whether it is as much as claimed the interval."""
    if not reduced.certain:
        return 'no answer: too few maps'
    way = reduced.way()
    if way != 'less':
        return 'the other way round' if way == 'more' else 'not seen'
    if 1.0 - reduced.high >= claim:
        return 'holds'
    return 'less, but not by as much' if 1.0 - reduced.low < claim else 'less; whether by as much is open'


def headline_table(scenarios, headlines):
    """The claims are one family of tests."""
    lines = ['| claim | section | ours: median reduction | p | |', '| --- | --- | ---: | ---: | --- |']
    found = [compare(scenarios[scenario].figures(measure, first), scenarios[scenario].figures(measure, second))
             for _, _, scenario, measure, first, second, _ in headlines]
    correct(found)
    for (text, section, *_, claim), reduced in zip(headlines, found):
        def percent(ratio):
            return f'{100.0 * (1.0 - ratio):.1f} %'.replace('-', '−')
        ours = (f'**{percent(reduced.middle)}** ({percent(reduced.high)} to {percent(reduced.low)})' if reduced.certain
                else '–')
        lines.append(f'| {text} | {section} | {ours} | {shown_chance(reduced.chance)} | {headline_answer(claim, reduced)} |')
    return '\n'.join(lines)


def legend():
    return ', '.join(f'{named(name)}: {what}' for name, what in WHAT.items() if what)
