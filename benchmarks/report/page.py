"""The report: one self-contained HTML page. report.html is its template."""
import base64
import dataclasses
import gzip
import json
import math
import os

import jinja2
import plotly.offline

import charts
from formatting import percent, probability, shown, shown_in, shown_time
from gallery import read_picture
from planner_statistics import LEVEL, median, median_interval, quantile, share_interval
from standings import MEASURES, WITHIN, share_solved
from tables import FILES

HERE = os.path.dirname(os.path.abspath(__file__))
# Beyond these limits, details are left out to keep a page below 10 MB.
MAX_DETAILED_RUNS = 20000  # runs of a comparison in which each dot names its run
MAX_SECTION_CELLS, MAX_MATRIX_CELLS = 1000, 5000  # planners times problems
MAX_GALLERIES, MAX_SETUPS = 25, 100  # problems
BEST = {'time': 'fastest planner on the problem', 'length': 'shortest path on the problem'}

# Further columns, shown where the runs have such figures. The file is made from the table in
# benchmarks/store/RunColumns.cpp.
with open(os.path.join(HERE, 'columns.json'), encoding='utf-8') as _columns:
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


def _shown_length(value):
    return shown_in(value, 'm', 4)


def _table(kind, headings, rows, sortable=True, foot=None):
    return {'kind': kind, 'headings': headings, 'rows': rows, 'sortable': sortable, 'foot': foot}


def overall_table(results, table):
    """All planners over all their problems."""
    shortest = {problem: min((cell.shortest for cell in cells.values()), default=math.inf)
                for problem, cells in table.items()}
    cells_of = {index: [(problem, cells[index]) for problem, cells in table.items() if index in cells]
                for index in range(len(results.planners))}
    # Planners that ran on fewer problems than others are not comparable with them.
    most = max(map(len, cells_of.values()))
    times = {index: [run.time for _, cell in cells for run in cell.runs] for index, cells in cells_of.items()}
    best = min(median(times[index]) for index, cells in cells_of.items() if len(cells) == most)
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
            _median_figure(time, interval, len(times[index]), shown_time, len(cells) == most and time == best < math.inf),
            Figure(shown(ratio), ratio, f'median over {len(ratios)} problems of its median length, divided by the shortest '
                   'solution that any planner found; infinite where it solves fewer than half of its runs')], index))
    uneven = any(len(cells) < most for cells in cells_of.values())
    return _table('figures', ['planner', 'runs solved', 'always solved', 'invalid', 'first solution, median',
                              'length over best'], rows), uneven


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
            if math.isfinite(cell.time):
                label = shown_time(cell.time)
                tip += f'; first solution after {label}, {_shown_length(cell.length)} (medians)'
            figures.append(Figure(label + (' ▲' if cell.invalid else ''), None, tip, 'some' if cell.solved else 'none', '',
                                  cell.solved / cell.count))
        rows.append(Row(problem, figures, None, f'#problem-{number}' if number < linked else ''))
    return _table('matrix', ['problem', *results.planners], rows, sortable=False)


def _further_columns(results, folded):
    """Columns with a value in any run. Loading the map matters beside a drive only: otherwise it is the same for
    all."""
    there = [column for column in COLUMNS if column['folded'] == folded
             and any(not math.isnan(run.figure(column['name'])) for run in results.runs[:2000])]
    driven = any(not math.isnan(run.figure('travel time')) for run in results.runs[:2000])
    return [column for column in there if driven or column['name'] != 'map loading time']


def _further_figures(cell, columns):
    for column in columns:
        values = cell.values_of_solved(column['name'])
        value = column['factor'] * (sum(values) / max(1, len(values)) if column['share'] and values else median(values))
        yield Figure(shown_in(value, column['unit']), value)


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
            _median_figure(cell.length, cell.length_interval, cell.solved, _shown_length,
                           cell.length_of_all <= 1.001 * best_length and best_length < math.inf),
            Figure('–' if math.isnan(cusps) else f'{cusps:g}', cusps),
            Figure(shown_in(100.0 * clearance, 'cm'), clearance), *_further_figures(cell, columns)], index, marks=marks))
    return _table('figures', ['planner', 'solved', 'first solution, median', 'quartiles', 'length of solved, median', 'cusps',
                              'clearance', *(column['heading'] for column in columns)], rows)


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


class Charts(dict):
    """The figures of the page by name; the page draws each when it becomes visible."""

    def add(self, name, title, figure, note='', wide=False):
        """The template's data of a figure, or of its absence (None)."""
        if figure is not None:
            self[name] = figure
        return {'name': name, 'title': title, 'note': note, 'wide': wide, 'height': figure and figure['layout']['height']}


def _field_context(results, field, number, made):
    """A field of the standings: its table and charts."""
    names, count = results.planners, len(field.problems)
    panels = [made.add(f'expected-{number}', 'Expected problems solved over time, one attempt each; band: 95 %',
                       charts.expected_chart(names, field.expected, count, results.time_limit))]
    for measure, best in BEST.items():
        panels.append(made.add(f'profile-{measure}-{number}', f'Performance profile: {MEASURES[measure]}, median of '
                               'each problem', charts.profile_chart(names, field.profiles[measure], best)))
    if count > 1 and len(field.planners) > 1:
        for measure, ranking in field.rankings.items():
            test = ranking.friedman
            note = ('' if test is None else f'Friedman over {count} problems: χ² = {shown(test.chi_square)}, '
                    f'{probability(test.p)} (by F of Iman and Davenport). ')
            note += (f"Bars join adjacent planners without a significant difference in pairwise Wilcoxon tests with Holm's "
                     f"correction at {100 * LEVEL:.0f} %. Nemenyi's critical difference, for comparison: {shown(ranking.critical)} ranks.")
            panels.append(made.add(f'ranks-{measure}-{number}', f'Mean rank by {MEASURES[measure]}',
                                   charts.rank_chart(names, ranking.ranks, ranking.groups), note))
    listed = ', '.join(field.problems[:6]) + (' …' if count > 6 else '')
    return {'title': f'{len(field.planners)} planner{"s"[:len(field.planners) > 1]} on {count} '
                     f'problem{"s"[:count > 1]}: {listed}', 'table': field_table(results, field), 'panels': panels}


def _standings_context(results, standings, made):
    compared = [field for field in standings.fields if len(field.planners) > 1] or standings.fields[:1]
    classes = standings.classes
    return {
        'fields': [_field_context(results, field, number, made) for number, field in enumerate(compared)],
        'several': len(standings.fields) > 1,
        'alone': [results.planners[index] for field in standings.fields if field not in compared
                  for index in field.planners],
        'pairs': [pair_matrix(results, standings, measure) for measure in BEST] if standings.pairs else [],
        'pair_problems': max((pair.problems for pair in standings.pairs), default=0),
        'classes': class_table(results, standings) if 1 < len(classes) < len(results.problems) else None}


def _card(results, index, cell, path, link):
    """The text below a planner's path."""
    best = next((run for run in cell.runs if path and run.number == path.run), None)
    card = {'index': index, 'name': results.planners[index], 'link': link, 'path': path if best else None, 'kind': '',
            'count': f'{cell.solved}/{cell.count}', 'text': 'no path'}
    if best and best.solved:
        changes, clearance = best.figure('cusps'), best.figure('least clearance')
        card['text'] = (_shown_length(best.length)
                        + ('' if math.isnan(changes) else f', {changes:.0f} change{"s"[:changes != 1]} of direction')
                        + ('' if math.isnan(clearance) else f', clearance {100 * clearance:.1f} cm'))
    elif best and best.invalid:
        card.update(kind='bad', text='invalid: fails the second check')
    elif best:
        card.update(kind='approximate', text=f'approximate, ends {shown(best.figure("distance to goal"))} m from the goal')
    return card


def _gallery(results, problem, cells):
    """Paths of all planners on a problem; None without a picture to draw them on."""
    picture = read_picture(results.folder, problem)
    names = results.planners
    if picture is None or any(cell.solved and names[index] not in picture.paths for index, cell in cells.items()):
        return None  # or the picture of other results
    cards = []
    for index, cell in cells.items():
        path = picture.paths.get(names[index])
        file = f'paths/{problem}-{names[index]}-{path.run}.csv' if path else ''
        cards.append(_card(results, index, cell, path, file if os.path.isfile(os.path.join(results.folder, file)) else ''))
    return {'picture': picture, 'cards': cards}


def _problem_context(results, number, problem, cells, columns, made):
    names = results.planners
    runs_of = {index: cell.runs for index, cell in cells.items()}
    panels = [made.add(f'success-{number}', 'Success over time', charts.success_chart(names, runs_of, results.time_limit)),
              made.add(f'length-{number}', 'Length over time, median',
                       charts.length_chart(names, runs_of, results.time_limit))]
    rows = [(index, cell.runs, cell.time, cell.time_interval) for index, cell in cells.items() if cell.solved]
    if rows:
        detailed = len(results.runs) <= MAX_DETAILED_RUNS
        panels.append(made.add(f'strip-{number}', 'First solution of every run; bar: median with its 95 % interval',
                               charts.strip_chart(names, rows, results.time_limit, detailed), wide=True))
    return {'number': number, 'name': problem, 'table': problem_table(results, cells, columns[False]),
            'further': further_table(results, cells, columns[True]), 'panels': panels,
            'gallery': _gallery(results, problem, cells) if number < MAX_GALLERIES else None,
            'is_without_paths': number >= MAX_GALLERIES}


def _links(results):
    """Files beside the report, as (name, content)."""
    files = [('benchmark.db', 'all runs, in the schema of OMPL; Planner Arena opens it'),
             ('summary.csv', 'medians and intervals'), ('summary.md', 'the table of the terminal')]
    for problem in results.problems:
        files += [(problem + '.log', f'log of OMPL, {problem}'),
                  (f'pictures/{problem}.svg', f'best path of each planner, {problem}')]
    return [*FILES.items(), *((name, what) for name, what in files if os.path.isfile(os.path.join(results.folder, name)))]


def _facts(results):
    """Conditions of the measurement: (name, value)."""
    facts = results.facts
    models = [line.split(':', 1)[1] for text in facts.get('cpuinfo', []) for line in text.splitlines()
              if line.startswith('Model name') and ':' in line]
    listed = {'started': facts.get('date', [])[:1], 'host': facts.get('hostname', []),
              'processor': list(dict.fromkeys(' '.join(model.split()) for model in models)),
              'versions': results.versions[:1] or facts.get('version', []), 'system': results.versions[1:2],
              'seed': facts.get('seed', []), 'time limit': [shown_time(results.time_limit) + ' per run'],
              'runs from': results.sources}
    return {what: ', '.join(values) for what, values in listed.items() if values}


def _packed_plotly():
    """Plotly's script for a page without network, compressed: it has 8 MB in Debian."""
    return base64.b64encode(gzip.compress(plotly.offline.get_plotlyjs().encode(), compresslevel=6, mtime=0)).decode()


def report_page(results, standings):
    """The whole page as text."""
    table = {problem: {index: Cell(results.of(problem, planner)) for index, planner in enumerate(results.planners)
                       if results.of(problem, planner)} for problem in results.problems}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.globals.update(inf=math.inf, colour_of=charts.colour_of, dash_of=charts.dash_of)
    made, problems, planners = Charts(), results.problems, results.planners
    everything = {index: [run for run in results.runs if run.planner == planner] for index, planner in enumerate(planners)}
    success = made.add('success-all', 'Success over time, all problems',
                       charts.success_chart(planners, everything, results.time_limit))
    columns = {folded: _further_columns(results, folded) for folded in (False, True)}
    sections = [_problem_context(results, number, problem, table[problem], columns, made)
                for number, problem in enumerate(problems[:MAX_SECTION_CELLS // len(planners)])]
    overall, uneven = overall_table(results, table)
    facts = _facts(results)
    return environment.get_template('report.html').render(
        title='Parking benchmark: ' + ', '.join(results.labels),
        subtitle=' · '.join(facts[what] for what in ('started', 'host', 'processor') if what in facts),
        tiles=[(len(problems), 'problems'), (len(planners), 'planners'), (f'{len(results.runs):,}'.replace(',', ' '), 'runs'),
               (shown_time(results.time_limit), 'time limit'), (percent(share_solved(results.runs)), 'of all runs solved'),
               (sum(run.invalid for run in results.runs), 'invalid solutions')],
        planners=list(enumerate(planners)), overall=overall, uneven=uneven, success=success,
        matrix=matrix(results, table, MAX_MATRIX_CELLS // len(planners), len(sections)), problems=len(problems),
        standings=_standings_context(results, standings, made), sections=sections, rechecked=results.rechecked, facts=facts,
        settings=results.settings, links=_links(results),
        setups=[(problem, results.setups[problem].strip()) for problem in problems[:MAX_SETUPS]],
        charts=json.dumps(made, separators=(',', ':'), allow_nan=False).replace('<', '\\u003c'), plotly=_packed_plotly())
