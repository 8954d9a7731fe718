"""The report: one self-contained HTML page. report.html is its template."""
import base64
import functools
import gzip
import json
import math
import os

import jinja2
import plotly.offline

import charts
from formatting import percent, probability, shown, shown_time
from gallery import Gallery
from page_tables import (Cell, class_table, field_table, further_columns, further_table, matrix, overall_table, pair_matrix,
                         problem_table, refusal_table, shown_length)
from planner_statistics import LEVEL
from standings import MEASURES, share_solved
from tables import FILES

HERE = os.path.dirname(os.path.abspath(__file__))
# Beyond these limits, details are left out to keep a page below 10 MB.
MAX_DETAILED_RUNS = 20000  # runs of a comparison in which each dot names its run
MAX_SECTION_CELLS, MAX_MATRIX_CELLS = 1000, 5000  # planners times problems
MAX_GALLERIES, MAX_SETUPS = 25, 100  # problems
BEST = {'time': 'fastest planner on the problem', 'length': 'shortest path on the problem'}


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
    return {'title': field_title(field), 'table': field_table(results, field), 'panels': panels}


def field_title(field):
    count = len(field.problems)
    listed = ', '.join(field.problems[:6]) + (' …' if count > 6 else '')
    return f'{len(field.planners)} planner{"s"[:len(field.planners) != 1]} on {count} problem{"s"[:count != 1]}: {listed}'


def _overall_context(results, field, number, table, made):
    """The planners of a field on all its problems."""
    runs_of = {index: [run for problem in field.problems for run in table[problem][index].runs] for index in field.planners}
    chart = charts.success_chart(results.planners, runs_of, results.time_limit)
    return {'title': field_title(field), 'table': overall_table(results, field, table),
            'chart': made.add(f'success-all-{number}', 'Success over time', chart)}


def _standings_context(results, standings, made):
    compared = [field for field in standings.fields if len(field.planners) > 1] or standings.fields[:1]
    classes = standings.classes
    return {
        'fields': [_field_context(results, field, number, made) for number, field in enumerate(compared)],
        'unsolvable': len(results.unsolvable),
        'alone': [results.planners[index] for field in standings.fields if field not in compared
                  for index in field.planners],
        'pairs': [pair_matrix(results, standings, measure) for measure in BEST] if standings.pairs else [],
        'pair_problems': max((pair.problems for pair in standings.pairs), default=0),
        'classes': class_table(results, standings) if 1 < len(classes) < len(results.solvable) else None}


def _problem_context(results, number, problem, cells, columns, made):
    """gallery: None where it is left out."""
    gallery = Gallery(results, problem, cells) if number < MAX_GALLERIES else None
    context = {'number': number, 'name': problem, 'gist': _gist(results, problem, cells), 'gallery': gallery or None,
               'is_without_paths': gallery is None, 'table': None, 'further': None, 'panels': []}
    if problem in results.unsolvable:
        return context
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
    return {**context, 'table': problem_table(results, cells, columns[False]),
            'further': further_table(results, cells, columns[True]), 'panels': panels}


def _gist(results, problem, cells):
    """The results of a problem in one line."""
    if problem in results.unsolvable:
        refusing = sum(all(map(results.is_refusal, cell.runs)) for cell in cells.values())
        return f'no solution exists; refused in every run by {refusing} of {len(cells)} planners'
    text = f'{sum(cell.solved > 0 for cell in cells.values())} of {len(cells)} planners solve it'
    index = min(cells, key=lambda index: cells[index].time)
    if math.isfinite(cells[index].time):
        text += f'; fastest {results.planners[index]}, {shown_time(cells[index].time)}'
    index = min(cells, key=lambda index: cells[index].length_of_all)
    if math.isfinite(cells[index].length_of_all):
        text += f'; shortest {results.planners[index]}, {shown_length(cells[index].length_of_all)}'
    return text


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


def _tiles(results):
    """Figures at the top: (value, meaning)."""
    solvable = set(results.solvable)
    runs, unsolvable = [run for run in results.runs if run.problem in solvable], len(results.unsolvable)
    return [(len(results.problems), 'problems' + (f', {unsolvable} without a solution' if unsolvable else '')),
            (len(results.planners), 'planners'), (f'{len(results.runs):,}'.replace(',', ' '), 'runs'),
            (shown_time(results.time_limit), 'time limit'),
            (percent(share_solved(runs)) if runs else '–', 'of the runs' + (' with a solution' if unsolvable else '') + ' solved'),
            (sum(run.invalid for run in results.runs), 'invalid solutions')]


def _packed_plotly():
    """Plotly's script for a page without network, compressed: it has 8 MB in Debian."""
    return base64.b64encode(gzip.compress(plotly.offline.get_plotlyjs().encode(), compresslevel=6, mtime=0)).decode()


def report_page(results, standings):
    """The whole page as text."""
    table = {problem: {index: Cell(results.of(problem, planner)) for index, planner in enumerate(results.planners)
                       if results.of(problem, planner)} for problem in results.problems}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    made, problems, planners = Charts(), results.problems, results.planners
    environment.globals.update(inf=math.inf, colour_of=functools.partial(charts.colour_of, planners),
                               dash_of=functools.partial(charts.dash_of, planners))
    columns = {folded: further_columns(results, folded) for folded in (False, True)}
    sections = [_problem_context(results, number, problem, table[problem], columns, made)
                for number, problem in enumerate(problems[:MAX_SECTION_CELLS // len(planners)])]
    overall = [_overall_context(results, field, number, table, made) for number, field in enumerate(standings.fields)]
    galleries = [section for section in sections if section['gallery']]
    facts = _facts(results)
    return environment.get_template('report.html').render(
        title='Parking benchmark: ' + ', '.join(results.labels),
        subtitle=' · '.join(facts[what] for what in ('started', 'host', 'processor') if what in facts),
        tiles=_tiles(results),
        planners=list(enumerate(planners)), overall=overall, refusals=refusal_table(results, table), galleries=galleries,
        dark=next((section['gallery'].style for section in galleries), ''),
        matrix=matrix(results, table, MAX_MATRIX_CELLS // len(planners), len(sections)), problems=len(problems),
        standings=_standings_context(results, standings, made), sections=sections, rechecked=results.rechecked, facts=facts,
        sources=len(results.sources),
        settings=results.settings, links=_links(results),
        setups=[(problem, results.setups[problem].strip()) for problem in problems[:MAX_SETUPS]],
        charts=json.dumps(made, separators=(',', ':'), allow_nan=False).replace('<', '\\u003c'), plotly=_packed_plotly())
