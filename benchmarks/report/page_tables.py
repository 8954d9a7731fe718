"""Tables of the page: figures of planners on problems, as rows for the template."""
import dataclasses
import json
import math
import os

from formatting import percent, probability, shown, shown_in, shown_time
from planner_statistics import median, median_interval, quantile, share_interval
from standings import MEASURES, WITHIN

# Further columns, shown where the runs have such figures. The file is made from the table in
# benchmarks/store/RunColumns.cpp.
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'columns.json'), encoding='utf-8') as _columns:
    COLUMNS = json.load(_columns)


@dataclasses.dataclass
class Figure:
    """A cell of a table."""
    text: str
    sort: float = None  # sort key of its column
    tip: str = ''       # explanation when pointed at, tapped or focused
    kind: str = ''      # class in the style sheet
    note: str = ''      # smaller, beside the text
    share: float = None  # drawn as a bar or a colour
    interval: tuple = None  # interval of the share


@dataclasses.dataclass
class Row:
    """A line of a table: of a planner, or of a problem or class (index None)."""
    name: str
    figures: list
    index: int = None
    link: str = ''
    tip: str = ''
    marks: list = dataclasses.field(default_factory=list)  # (class, text, tip) beside the name


class Cell:
    """Results of one planner on one problem. A run without a valid exact solution counts as infinitely slow.

    Lengths are those of the solved runs, as in summary.csv. In comparisons across problems an unsolved run counts as
    infinitely long, too."""

    def __init__(self, runs):
        self.runs = runs
        self.count = len(runs)
        self.solved = sum(run.solved for run in runs)
        self.invalid = sum(run.invalid for run in runs)
        self.approximate = sum(run.approximate for run in runs)
        times, lengths = [run.time for run in runs], [run.length for run in runs if run.solved]
        self.time, self.time_interval = median(times), median_interval(times)
        self.quartiles = quantile(times, 0.25), quantile(times, 0.75)
        self.length, self.length_interval = median(lengths), median_interval(lengths)
        self.length_of_all = median([run.length for run in runs])
        self.shortest = min(lengths, default=math.inf)

    def values_of_solved(self, name):
        values = [run.figure(name) for run in self.runs if run.solved]
        return [value for value in values if not math.isnan(value)]

    def of_solved(self, name):
        """Median of a column over the solved runs; NaN without one."""
        return median(self.values_of_solved(name))


def _median_figure(value, interval, count, show, best):
    low, high, certainty = interval
    kind = ' '.join(word for word, holds in (('best', best), ('range', not certainty)) if holds)
    if not math.isfinite(low):
        return Figure(show(value), value, '', kind)
    tip = (f'{100 * certainty:.1f} % confidence interval of the median of {count} runs' if certainty
           else f'range of the {count} runs: too few for a 95 % confidence interval')
    return Figure(show(value), value, tip, kind, f'{show(low)} – {show(high)}')


def _share_figure(solved, count):
    low, high = share_interval(solved, count)
    return Figure(f'{solved}/{count}', solved / max(1, count), f'{solved} of {count} runs; 95 % confidence interval '
                  f'{100 * low:.0f} to {100 * high:.0f} %', 'share', '', solved / max(1, count), (low, high))


def shown_length(value):
    return shown_in(value, 'm', 4)


def _table(kind, headings, rows, sortable=True, foot=None):
    return {'kind': kind, 'headings': headings, 'rows': rows, 'sortable': sortable, 'foot': foot}


def overall_table(results, field, table):
    """The planners of a field over all its problems."""
    cells_of = {index: [(problem, table[problem][index]) for problem in field.problems] for index in field.planners}
    shortest = {problem: min(table[problem][index].shortest for index in field.planners) for problem in field.problems}
    times = {index: [run.time for _, cell in cells for run in cell.runs] for index, cells in cells_of.items()}
    best = min(map(median, times.values())) if len(field.planners) > 1 else math.inf
    rows = []
    for index, cells in cells_of.items():
        time, interval = median(times[index]), median_interval(times[index])
        always = sum(cell.solved == cell.count for _, cell in cells)
        invalid = sum(cell.invalid for _, cell in cells)
        ratios = [cell.length_of_all / shortest[problem] for problem, cell in cells if math.isfinite(shortest[problem])]
        ratio = median(ratios)
        rows.append(Row(results.planners[index], [
            _share_figure(sum(cell.solved for _, cell in cells), len(times[index])),
            Figure(f'{always}/{len(cells)}', always / max(1, len(cells)),
                   f'{always} of {len(cells)} problems solved in every run'),
            Figure(f'▲ {invalid}' if invalid else '0', invalid, '', 'invalid' if invalid else ''),
            _median_figure(time, interval, len(times[index]), shown_time, time == best < math.inf),
            Figure(shown(ratio), ratio, f'median over {len(ratios)} problems of its median length over all runs, divided by the '
                   'shortest solution of these planners; infinite where it solves fewer than half of its runs')], index))
    return _table('figures', ['planner', 'runs solved', 'always solved', 'invalid', 'first solution, median',
                              'length over best, all runs'], rows)


def _refusal(results, cell):
    """(number of refused runs, median time; infinite if half of the runs are others)"""
    times = [run.figure('planning time') if results.is_refusal(run) else math.inf for run in cell.runs]
    return sum(map(math.isfinite, times)), median(times)


def refusal_table(results, table):
    """Problems without a solution: which planner refuses them, and when."""
    rows = []
    for problem in results.unsolvable:
        for index, cell in table[problem].items():
            refused, time = _refusal(results, cell)
            rows.append(Row(f'{problem}: {results.planners[index]}', [
                _share_figure(refused, cell.count), Figure(shown_time(time) if math.isfinite(time) else '–', time),
                Figure(str(cell.count - refused - cell.invalid), cell.count - refused - cell.invalid),
                Figure(f'▲ {cell.invalid}' if cell.invalid else '0', cell.invalid, '', 'invalid' if cell.invalid else '')],
                index))
    return _table('figures', ['planner', 'refused correctly', 'after, median', 'until the time limit, or failed',
                              'claimed a path'], rows) if rows else None


def matrix(results, table, count, linked):
    """The first problems against planners: share solved as colour, median time as text. linked: problems with a
    section."""
    rows = []
    for number, (problem, cells) in enumerate(list(table.items())[:count]):
        figures = []
        for index, planner in enumerate(results.planners):
            cell = cells.get(index)
            if cell is None:
                figures.append(Figure('', kind='absent'))
                continue
            tip = f'{planner} on {problem}: {cell.solved} of {cell.count} runs solved'
            tip += f', {cell.invalid} invalid' if cell.invalid else ''
            label = f'{cell.solved}/{cell.count}'
            if problem in results.unsolvable:
                refused, time = _refusal(results, cell)
                label = f'{refused}/{cell.count} refused' + ('' if math.isinf(time) else f', {shown_time(time)}')
                tip = f'{planner} on {problem}, which has no solution: {refused} of {cell.count} runs refused it correctly'
                figures.append(Figure(label + (' ▲' if cell.invalid else ''), None, tip, 'none'))
                continue
            if math.isfinite(cell.time):
                label = shown_time(cell.time)
                tip += f'; first solution after {label}, {shown_length(cell.length)} (medians)'
            figures.append(Figure(label + (' ▲' if cell.invalid else ''), None, tip, 'some' if cell.solved else 'none', '',
                                  cell.solved / cell.count))
        rows.append(Row(problem, figures, None, f'#problem-{number}' if number < linked else '',
                        marks=[('near', 'no solution', '')] if problem in results.unsolvable else []))
    return _table('matrix', ['problem', *results.planners], rows, sortable=False)


def further_columns(results, folded):
    """Columns with a value in any run. Loading the map matters beside a drive only: otherwise it is the same for
    all."""
    there = [column for column in COLUMNS if column['folded'] == folded
             and any(column['unit'] != 'MB' and not math.isnan(run.figure(column['name'])) or run.figure(column['name']) > 0.0
                     for run in results.runs[:2000])]  # memory that never grows was not measured
    driven = any(not math.isnan(run.figure('travel time')) for run in results.runs[:2000])
    return [column for column in there if driven or column['name'] != 'map loading time']


def _further_figures(cell, columns):
    for column in columns:
        values = cell.values_of_solved(column['name'])
        value = column['factor'] * (sum(values) / max(1, len(values)) if column['share'] and values else median(values))
        text = '< 0.1 MB' if column['unit'] == 'MB' and value < 0.05 else shown_in(value, column['unit'])
        yield Figure(text, value)


def problem_table(results, cells, columns):
    best_time = min((cell.time for cell in cells.values()), default=math.inf)
    best_length = min((cell.length_of_all for cell in cells.values()), default=math.inf)
    rows = []
    for index, cell in cells.items():
        marks = []
        if cell.invalid:
            marks.append(('invalid', f'▲ {cell.invalid} invalid', f'{cell.invalid} of {cell.count} runs ended with a path '
                          'that the planner reports as a solution and that fails the second check'))
        if cell.approximate:
            marks.append(('near', f'{cell.approximate} approximate', f'{cell.approximate} of {cell.count} runs ended with '
                          'a path that does not reach the goal'))
        low, high = cell.quartiles
        cusps, clearance = cell.of_solved('cusps'), cell.of_solved('least clearance')
        rows.append(Row(results.planners[index], [
            _share_figure(cell.solved, cell.count),
            _median_figure(cell.time, cell.time_interval, cell.count, shown_time, cell.time == best_time < math.inf),
            Figure(f'{shown_time(low)} – {shown_time(high)}' if math.isfinite(low) else '–', low, '', 'soft'),
            _median_figure(cell.length, cell.length_interval, cell.solved, shown_length,
                           cell.length_of_all <= 1.001 * best_length and best_length < math.inf),
            Figure('–' if math.isnan(cusps) else f'{cusps:g}', cusps),
            Figure(shown_in(100.0 * clearance, 'cm'), clearance), *_further_figures(cell, columns)], index, marks=marks))
    return _table('figures', ['planner', 'solved', 'first solution, median', 'quartiles', 'length of solved, median',
                              'changes of direction', 'clearance', *(column['heading'] for column in columns)], rows)


def further_table(results, cells, columns):
    """Further figures of paths and drives; None without values."""
    rows = [Row(results.planners[index], list(_further_figures(cell, columns)), index)
            for index, cell in cells.items() if cell.solved]
    return _table('figures', ['planner', *(column['heading'] for column in columns)], rows) if columns and rows else None


def field_table(results, field):
    count = len(field.problems)
    least = min(row.par10 for row in field.rows)
    rows = []
    for row in field.rows:
        figures = [Figure(f'{row.expected:.2f}', row.expected, f'{row.solved} of {row.runs} runs'),
                   Figure(shown_time(row.par10), row.par10, '', 'best' if row.par10 == least and row.solved else '')]
        for measure in WITHIN:
            figures.append(Figure(f'{row.rank[measure]:.2f}', row.rank[measure]))
            shares = (row.within[measure, ratio] for ratio in WITHIN[measure])
            figures += [Figure(percent(share), share, f'{round(share * count)} of {count} problems') for share in shares]
        rows.append(Row(results.planners[row.index], figures, row.index))
    headings = ['planner', f'problems solved, expected of {count}', 'PAR-10']
    for measure, first in (('time', 'best'), ('length', 'shortest')):
        headings += [f'rank, {measure}', *(f'≤ {ratio:g} ×' if ratio > 1.0 else first for ratio in WITHIN[measure])]
    foot = Row('virtual best', [Figure(str(field.best_solved)), Figure(shown_time(field.best_par10))]
               + [Figure('')] * (len(headings) - 3))
    return _table('figures', headings, rows, foot=foot)


def _pair_tip(results, pair):
    first, second = results.planners[pair.first], results.planners[pair.second]
    return (f'{first} against {second}: better on {pair.wins}, equal on {pair.ties}, worse on {pair.losses} of '
            f'{pair.problems} problems; median ratio {shown(pair.ratio)}; Wilcoxon {probability(pair.wilcoxon.p)}, Holm '
            f'{probability(pair.wilcoxon_holm)}; sign test {probability(pair.sign)}, Holm {probability(pair.sign_holm)}')


def pair_matrix(results, standings, measure):
    """Row against column: problems won and lost; coloured if the difference is significant."""
    found = {(pair.first, pair.second): pair for pair in standings.pairs if pair.measure == measure}
    there = sorted({index for pair in found for index in pair})
    rows = []
    for first in there:
        figures = []
        for second in there:
            pair = found.get((min(first, second), max(first, second)))
            if pair is None or first == second:
                figures.append(Figure('', kind='absent'))
                continue
            own, other = (pair.wins, pair.losses) if first < second else (pair.losses, pair.wins)
            ahead = pair.first_is_better == (first < second)
            figures.append(Figure(f'{own}–{other}', None, _pair_tip(results, pair),
                                  'pair' + ('' if not pair.differ else ' better' if ahead else ' worse')))
        rows.append(Row(results.planners[first], figures, first))
    return _table('matrix', [MEASURES[measure], *(results.planners[index] for index in there)], rows, sortable=False)


def class_table(results, standings):
    rows = []
    for name, problems in standings.classes.items():
        figures = [Figure(str(len(problems)), kind='absent')]
        for index, planner in enumerate(results.planners):
            if (name, index) not in standings.of_class:
                figures.append(Figure('', kind='absent'))
                continue
            count, runs, solved, share, par10 = standings.of_class[name, index]
            figures.append(Figure(percent(share), None, f'{planner}, {name}: {solved} of {runs} runs solved on {count} '
                                  f'problems, {percent(share)} of a problem expected; PAR-10 {shown_time(par10)}',
                                  'some' if solved else 'none', shown_time(par10), share))
        rows.append(Row(name, figures, tip=', '.join(problems[:12]) + (' …' if len(problems) > 12 else '')))
    return _table('matrix', ['class', 'problems', *results.planners], rows, sortable=False)
