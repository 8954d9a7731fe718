"""The report: one HTML page that needs nothing else."""
import datetime
import json
import math
import os

from charts import (cost_chart, shown, shown_time, strip_chart, style_of, success_chart, text)
from gallery import card, read_picture
from order_statistics import median, median_interval, quantile, share_interval
from standings.section import standings_html
from standings.tables import FILES

HERE = os.path.dirname(os.path.abspath(__file__))
DOTS = 20000  # runs up to which each has a dot of its own that can be pointed at


class Room:
    """So many bytes of the page for one of its parts: what comes when they are used up is left to the files beside it."""

    def __init__(self, size):
        self.left = size

    def take(self, content):
        """Is there room for this text? Then it is taken; and once something did not fit, nothing more does."""
        size = len(content.encode())
        self.left = self.left - size if size <= self.left else -1
        return self.left >= 0


SECTIONS, GALLERIES, MATRIX, SETUPS = 5_000_000, 2_000_000, 1_600_000, 400_000  # bytes, so that a page stays below 10 MB


class Cell:
    """How one planner did on one problem. Without a valid exact solution, a run's time and length are infinite."""

    def __init__(self, runs):
        self.runs = runs
        self.count = len(runs)
        self.solved = sum(run.solved for run in runs)
        self.invalid = sum(run.invalid for run in runs)
        self.approximate = sum(run.approximate for run in runs)
        self.share = share_interval(self.solved, self.count)
        times = [run.time for run in runs]
        self.time, self.time_interval = median(times), median_interval(times)
        self.quartiles = quantile(times, 0.25), quantile(times, 0.75)
        lengths = [run.length for run in runs]
        self.length, self.length_interval = median(lengths), median_interval(lengths)
        self.best = min(lengths)

    def of_solved(self, name):
        """Median of a property over the solved runs; NaN without one."""
        return median([run.figure(name) for run in self.runs if run.solved and not math.isnan(run.figure(name))])

    def share_of_solved(self, name):
        """Share of the solved runs for which a property is true; NaN without one that has it."""
        values = [run.figure(name) for run in self.runs if run.solved and not math.isnan(run.figure(name))]
        return sum(values) / len(values) if values else math.nan


def interval_html(interval, show, count):
    """[low, high], or the range of values when there are too few for an interval."""
    low, high, certainty = interval
    if math.isnan(low) or math.isinf(low):
        return ''
    tip = (f'{100 * certainty:.1f} % confidence interval of the median, from the ranks of {count} runs' if certainty
           else f'range of the {count} runs: too few for a 95 % confidence interval')
    return f' <span class="ci{"" if certainty else " range"}" data-tip="{tip}">{show(low)} – {show(high)}</span>'


def share_html(solved, count, interval):
    low, high = interval
    tip = f'{solved} of {count} runs; 95 % confidence interval {100 * low:.0f} to {100 * high:.0f} %'
    share = solved / count if count else 0.0
    return (f'<td class="share" data-sort="{share:.4f}" data-tip="{tip}"><span class="bar"><i style="width:'
            f'{100 * share:.1f}%"></i><u style="left:{100 * low:.1f}%;width:{100 * (high - low):.1f}%"></u></span>'
            f'<span class="of"><b>{solved}</b>/{count}</span></td>')


def swatch(index):
    name, dash = style_of(index)
    return (f'<svg class="swatch" viewBox="0 0 24 10" aria-hidden="true"><path class="curve {name}"{dash} '
            'd="M1 5H23"/></svg>')


def sortable(value):
    return f' data-sort="{value:.9g}"' if math.isfinite(value) else ' data-sort="inf"'


# Further columns, shown where the runs have such figures: column, heading, factor, unit. The file is made from the
# table in benchmarks/comparison/RunColumns.cpp.
with open(os.path.join(HERE, 'columns.json'), encoding='utf-8') as _columns:
    EXTRA = [(column['name'], column['heading'], column['factor'], column['unit'], column['share'], column['folded'])
             for column in json.load(_columns)]


def extra_columns(results, folded):
    """Loading the map matters beside the drive only: otherwise it is the same for all."""
    there = {name for name, *_ in EXTRA for run in results.runs[:2000] if not math.isnan(run.figure(name))}
    if 'travel time' not in there:
        there.discard('map loading time')
    return [column[:5] for column in EXTRA if column[0] in there and column[5] == folded]


def extra_cells(cell, extra):
    values = [(factor * (cell.share_of_solved(name) if share else cell.of_solved(name)), unit)
              for name, _, factor, unit, share in extra]
    return ''.join(f'<td{sortable(value)}>{shown(value)}{f" {unit}" if value == value else ""}</td>'
                   for value, unit in values)


def more_table(results, cells, more):
    """Further figures of the paths and drives, folded up; empty where no planner has any."""
    rows = [(index, extra_cells(cell, more)) for index, cell in cells.items() if cell.solved]
    if not more or not rows:
        return ''
    return ('<details><summary>Further figures: medians over the solved runs, goals attained as a share of them</summary><div class="scroll"><table class="figures '
            'sortable"><thead><tr><th class=name>planner</th>' + ''.join(f'<th>{heading}</th>' for _, heading, *_ in more)
            + '</tr></thead><tbody>'
            + ''.join(f'<tr data-p="{index}"><th class="name">{swatch(index)}{text(results.planners[index])}</th>{row}</tr>'
                      for index, row in rows) + '</tbody></table></div></details>')


def problem_table(results, cells, extra):
    head = ['planner', 'solved', 'first solution, median', 'quartiles', 'length, median', 'cusps', 'clearance']
    rows = [f'<th{" class=name" if k == 0 else ""}>{name}</th>' for k, name in enumerate(head)]
    rows += [f'<th>{heading}</th>' for _, heading, *_ in extra]
    out = [f'<div class="scroll"><table class="figures sortable"><thead><tr>{"".join(rows)}</tr></thead><tbody>']
    best_time = min((cell.time for cell in cells.values()), default=math.inf)
    best_length = min((cell.length for cell in cells.values()), default=math.inf)
    for index, cell in cells.items():
        name = results.planners[index]
        marks = ''
        if cell.invalid:
            marks = (f' <span class="invalid" data-tip="{cell.invalid} of {cell.count} runs ended with a path that the '
                     f'planner calls a solution and that is not valid when checked again every 5 mm: failures">'
                     f'▲ {cell.invalid} invalid</span>')
        if cell.approximate:
            marks += (f' <span class="near" data-tip="{cell.approximate} of {cell.count} runs ended with a path that '
                      f'does not reach the goal">{cell.approximate} approximate</span>')
        low, high = cell.quartiles
        time_class = ' class="best"' if cell.time == best_time < math.inf else ''
        length_class = ' class="best"' if cell.length <= best_length * 1.001 and best_length < math.inf else ''
        cusps, clearance = cell.of_solved('cusps'), cell.of_solved('least clearance')
        out.append(
            f'<tr data-p="{index}"><th class="name">{swatch(index)}{text(name)}{marks}</th>'
            f'{share_html(cell.solved, cell.count, cell.share)}'
            f'<td{time_class}{sortable(cell.time)}><b>{shown_time(cell.time)}</b>'
            f'{interval_html(cell.time_interval, shown_time, cell.count)}</td>'
            f'<td class="soft"{sortable(low)}>'
            f'{f"{shown_time(low)} – {shown_time(high)}" if math.isfinite(low) else "–"}</td>'
            f'<td{length_class}{sortable(cell.length)}><b>{shown(cell.length, 4)}{" m" if math.isfinite(cell.length) else ""}</b>'
            f'{interval_html(cell.length_interval, lambda v: shown(v, 4), cell.count)}</td>'
            f'<td{sortable(cusps)}>{f"{cusps:g}" if cusps == cusps else "–"}</td>'
            f'<td{sortable(clearance)}>{f"{100 * clearance:.1f} cm" if clearance == clearance else "–"}</td>')
        out.append(extra_cells(cell, extra) + '</tr>')
    return ''.join(out) + '</tbody></table></div>'


def overall_rows(results, table):
    """(index, problems run on, problems solved in every run, runs solved, runs, share interval, invalid, median time,
    interval, median of its length over the best known) for each planner."""
    best_known = {problem: min((cell.best for cell in cells.values()), default=math.inf)
                  for problem, cells in table.items()}
    rows = []
    for index in range(len(results.planners)):
        cells = [(problem, table[problem][index]) for problem in results.problems if index in table[problem]]
        solved, count = sum(cell.solved for _, cell in cells), sum(cell.count for _, cell in cells)
        times = [run.time for _, cell in cells for run in cell.runs]
        ratios = [cell.length / best_known[problem] for problem, cell in cells if math.isfinite(best_known[problem])]
        rows.append((index, len(cells), sum(cell.solved == cell.count for _, cell in cells), solved, count,
                     share_interval(solved, count), sum(cell.invalid for _, cell in cells), median(times),
                     median_interval(times), median(ratios) if ratios else math.nan, len(ratios)))
    return rows


def overall_table(results, table):
    out = ['<div class="scroll"><table class="figures sortable"><thead><tr><th class=name>planner</th><th>runs solved'
           '</th><th>always<br>solved</th><th>invalid</th><th>first solution,<br>median</th>'
           '<th>length<br>over best</th></tr></thead><tbody>']
    rows = overall_rows(results, table)
    # Who was run on fewer problems than others is not to be compared with them.
    most = max(row[1] for row in rows)
    best_time = min(row[7] for row in rows if row[1] == most)
    for index, problems, always, solved, count, interval, invalid, time, time_interval, ratio, compared in rows:
        share = share_html(solved, count, interval)
        tip = (f'median over {compared} problems of its median length, divided by the shortest solution that any planner '
               'found; infinite where it solves fewer than half of its runs')
        out.append(f'<tr data-p="{index}"><th class="name">{swatch(index)}{text(results.planners[index])}</th>{share}'
                   f'<td data-sort="{always / max(1, problems):.4f}" data-tip="{always} of {problems} problems solved in '
                   f'every run">{always}/{problems}</td>'
                   f'<td data-sort="{invalid}">{f"<span class=invalid>▲ {invalid}</span>" if invalid else "0"}</td>'
                   f'<td{" class=best" if problems == most and time == best_time < math.inf else ""}'
                   f'{sortable(time)}><b>{shown_time(time)}</b>'
                   f'{interval_html(time_interval, shown_time, count)}</td>'
                   f'<td{sortable(ratio)} data-tip="{tip}">{shown(ratio)}</td></tr>')
    note = ''
    if any(row[1] < most for row in rows):
        note = ('<p class="note">Each planner on the problems that it was run on: compare only those that share them.</p>')
    return ''.join(out) + '</tbody></table></div>' + note


def matrix(results, table, sections):
    """Problems against planners: share solved as colour, median time as text. sections: problems that have one."""
    room = Room(MATRIX)
    head = ''.join(f'<th data-p="{index}"><span>{text(name)}</span></th>'
                   for index, name in enumerate(results.planners))
    out = [f'<div class="scroll"><table class="matrix"><thead><tr><th class="name">problem</th>{head}</tr></thead><tbody>']
    for number, problem in enumerate(results.problems):
        link = f'<a href="#problem-{number}">{text(problem)}</a>' if number < sections else text(problem)
        row = [f'<tr><th class="name">{link}</th>']
        for index, name in enumerate(results.planners):
            cell = table[problem].get(index)
            if cell is None:
                row.append(f'<td class="absent" data-p="{index}"></td>')
                continue
            share = cell.solved / cell.count
            tip = f'{name} on {problem}: {cell.solved} of {cell.count} runs solved'
            if cell.invalid:
                tip += f', {cell.invalid} invalid'
            if math.isfinite(cell.time):
                tip += f'; first solution after {shown_time(cell.time)}, {shown(cell.length, 4)} m (medians)'
            label = shown_time(cell.time) if math.isfinite(cell.time) else f'{cell.solved}/{cell.count}'
            mark = '<em>▲</em>' if cell.invalid else ''
            row.append(f'<td data-p="{index}" class="{"none" if share == 0 else "some"}" style="--share:'
                       f'{100 * share:.0f}" data-tip="{text(tip)}">{label}{mark}</td>')
        row = ''.join(row) + '</tr>'
        if not room.take(row):
            return ''.join(out) + '</tbody></table></div>' + left_out('rows', number, len(results.problems))
        out.append(row)
    return ''.join(out) + '</tbody></table></div>'


def left_out(what, count, all_of_them):
    """What is said where the page would become too long."""
    return (f'<p class="note">To keep this page short, {what} of {all_of_them - count} of the {all_of_them} problems are left '
            'out here. They count in all figures about several problems; summary.csv has their own.</p>')


def settings_html(results):
    out = []
    for index, name in enumerate(results.planners):
        settings = results.settings.get(name, {})
        entries = ''.join(f'<dt>{text(key)}</dt><dd>{text(value)}</dd>' for key, value in sorted(settings.items()))
        out.append(f'<details><summary>{swatch(index)}{text(name)}</summary><dl class="settings">'
                   f'{entries or "<dt>no parameters</dt><dd></dd>"}</dl></details>')
    return ''.join(out)


def cpu_model(text_of_cpu):
    fields = dict(line.split(':', 1) for line in text_of_cpu.splitlines() if ':' in line)
    return ' '.join(fields.get('Model name', '').split())


def links(results):
    """Files beside the report, as (name, what it is)."""
    kinds = [('benchmark.db', 'all runs, in the schema of OMPL; Planner Arena opens it'),
             ('summary.csv', 'medians and intervals'), ('summary.md', 'the table of the terminal')]
    found = [(name, what) for name, what in kinds if os.path.isfile(os.path.join(results.folder, name))]
    for name in sorted(os.listdir(results.folder)):
        if name.startswith('runs') and name.endswith('.jsonl'):
            found.append((name, 'every run with its path, a line of JSON each'))
    for problem in results.problems:
        for name, what in ((problem + '.log', f'log of OMPL, {problem}'),
                           (f'pictures/{problem}.svg', f'best path of each planner, {problem}')):
            if os.path.isfile(os.path.join(results.folder, name)):
                found.append((name, what))
    return found


def path_links(results):
    """(problem, planner, run) -> file of states."""
    try:
        names = set(os.listdir(os.path.join(results.folder, 'paths')))
    except OSError:
        return {}
    found = {}
    for run in results.runs:
        name = f'{run.problem}-{run.planner}-{run.number}.csv'
        if name in names:
            found[run.problem, run.planner] = 'paths/' + name
    return found


def tile(value, what, tip=''):
    return f'<div class="tile"{f" data-tip={chr(34)}{text(tip)}{chr(34)}" if tip else ""}><b>{value}</b><span>{what}</span></div>'


def problem_section(results, number, problem, cells, extra, more, charts):
    """Tables and charts of a problem; the section is left open."""
    runs_of = {index: cell.runs for index, cell in cells.items()}
    out = [f'<section class="problem" id="problem-{number}"><h2>{text(problem)}</h2>']
    out += [problem_table(results, cells, extra), more_table(results, cells, more)]
    out.append('<div class="charts">')
    made = [(f'success-{number}', 'Success over time', success_chart(f'success-{number}', f'success over time, {problem}',
                                                                   runs_of, results.time_limit)),
            (f'cost-{number}', 'Length over time, median', cost_chart(f'cost-{number}', f'length over time, {problem}',
                                                                    runs_of, results.time_limit))]
    for identifier, title, chart in made:
        if chart is None:
            out.append(f'<figure class="panel"><figcaption>{title}</figcaption><p class="empty">No planner solves half of '
                       'its runs: the median is infinite throughout.</p></figure>')
            continue
        charts[identifier] = chart[1]
        out.append(f'<figure class="panel"><figcaption>{title}</figcaption>{chart[0]}</figure>')
    rows = [(index, results.planners[index], cell.runs, cell.time, cell.time_interval) for index, cell in cells.items()
            if cell.solved]
    if rows:
        out.append('<figure class="panel wide"><figcaption>First solution of every run; bar: median with its 95 % '
                   f'interval</figcaption>{strip_chart(f"strip-{number}", problem, rows, results.time_limit, len(results.runs) <= DOTS)}'
                   '</figure>')
    out.append('</div>')
    return ''.join(out)


def gallery(results, number, problem, cells, files):
    """Paths of all planners on a problem; empty without a picture to draw them on."""
    picture = read_picture(results.folder, problem)
    out = []
    if picture is not None:
        out.append(f'<h3>Paths</h3><svg class="symbols" aria-hidden="true"><symbol id="map-{number}" viewBox="0 0 '
                   f'{picture.width:g} {picture.height:g}">{picture.content}</symbol></svg><p class="key"><span class="forward">forwards</span>, '
                   '<span class="reverse">in reverse</span>; ○ change of direction; thin: solutions of the other runs. '
                   'The number is that of solved runs.</p><div class="gallery">')
        for index, cell in cells.items():
            name = results.planners[index]
            out.append(card(problem, f'map-{number}', picture, index, name, cell.runs, files.get((problem, name))))
        out.append('</div>')
    return ''.join(out)


def problem_sections(results, table, charts):
    """The sections, and how many there are: as many as the page has room for. The data of curves is added to charts."""
    extra, more, files = extra_columns(results, False), extra_columns(results, True), path_links(results)
    room, room_for_paths, out = Room(SECTIONS), Room(GALLERIES), []
    for number, problem in enumerate(results.problems):
        own = {}
        section = problem_section(results, number, problem, table[problem], extra, more, own)
        if not room.take(section + json.dumps(own)):
            return ''.join(out) + left_out('sections', number, len(results.problems)), number
        charts.update(own)
        paths = gallery(results, number, problem, table[problem], files) if room_for_paths.left >= 0 else ''
        out += [section, paths if room_for_paths.take(paths) else '<p class="note">To keep this page short, the paths are left '
                'out here; the folder pictures has the best of each planner.</p>', '</section>']
    return ''.join(out), len(results.problems)


def setups_html(results, table):
    room, out = Room(SETUPS), []
    for name, setup in results.setups.items():
        if name in table:
            fold = f'<details><summary>{text(name)}</summary><pre>{text(setup.strip())}</pre></details>'
            if not room.take(fold):
                return ''.join(out) + left_out('setups', len(out), len(table))
            out.append(fold)
    return ''.join(out)


def report_page(results, standing):
    """The whole page as text; standing: the planners against each other."""
    table = {problem: {index: Cell(results.of(problem, planner)) for index, planner in enumerate(results.planners)
                       if results.of(problem, planner)} for problem in results.problems}
    charts = {}
    everything = {index: [run for cells in table.values() if index in cells for run in cells[index].runs]
                  for index in range(len(results.planners))}
    overall, charts['success-all'] = success_chart('success-all', 'success over time, all problems', everything,
                                                   results.time_limit)
    sections, shown_sections = problem_sections(results, table, charts)
    standings = standings_html(results, standing, charts)
    when = ''
    if results.started:
        when = datetime.datetime.fromtimestamp(results.started, datetime.timezone.utc).strftime('%Y-%m-%d %H:%M UTC')
    invalid = sum(run.invalid for run in results.runs)
    facts = [('started', when), ('configuration', results.config), ('host', results.host),
             ('processor', cpu_model(results.cpu)), ('versions', results.machine.split('\n')[0]),
             ('system', results.machine.split('\n')[1] if '\n' in results.machine else ''), ('seed', results.seed),
             ('time limit', shown_time(results.time_limit) + ' per run'),
             ('runs from', ', '.join(os.path.basename(name) for name in results.sources))]
    values = {
        'TITLE': text('Parking benchmark' + (f': {os.path.basename(results.config)}' if results.config else '')),
        'SUBTITLE': text(' · '.join(part for part in (when, results.host, cpu_model(results.cpu)) if part)),
        'TILES': tile(len(results.problems), 'problems') + tile(len(results.planners), 'planners')
                 + tile(f'{len(results.runs):,}'.replace(',', ' '), 'runs')
                 + tile(shown_time(results.time_limit), 'time limit')
                 + tile(f'{sum(run.solved for run in results.runs) / len(results.runs):.0%}'.replace('%', ' %'),
                        'of all runs solved')
                 + tile(invalid, 'invalid solutions', 'exact in the planner\'s view, but not valid when checked again'),
        'CHIPS': ''.join(f'<button type="button" class="chip" data-p="{index}" aria-pressed="true">{swatch(index)}'
                         f'{text(name)}</button>' for index, name in enumerate(results.planners)),
        'OVERALL': overall_table(results, table),
        'OVERALL_CHART': overall,
        'MATRIX': matrix(results, table, shown_sections),
        'STANDINGS': standings,
        'SECTIONS': sections,
        'RECHECK': ('Every solution is checked again, at poses at most 5 mm apart and by code of its own; one that is '
                    'not valid counts as a failure.' if results.rechecked else
                    'These results come from a database without second checks: solutions are taken at their '
                    'planners\' word.'),
        'FACTS': ''.join(f'<dt>{text(key)}</dt><dd>{text(value)}</dd>' for key, value in facts if value),
        'SETTINGS': settings_html(results),
        'SETUPS': setups_html(results, table),
        'FILES': ''.join(f'<li><a href="{text(name)}">{text(name)}</a> {text(what)}</li>'
                         for name, what in [*FILES.items(), *links(results)]),
        'DATA': json.dumps({'planners': results.planners, 'charts': charts},
                           separators=(',', ':')).replace('<', '\\u003c'),
    }
    with open(os.path.join(HERE, 'report.html'), encoding='utf-8') as stream:
        page = stream.read()
    for name in ('css', 'js'):
        with open(os.path.join(HERE, 'report.' + name), encoding='utf-8') as stream:
            page = page.replace(f'/*REPORT.{name.upper()}*/', stream.read())
    parts = page.split('%%')
    for k in range(1, len(parts), 2):
        parts[k] = values[parts[k]]
    return ''.join(parts)
