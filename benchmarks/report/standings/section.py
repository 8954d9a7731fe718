"""The part of the page that sets the planners against each other."""
import math

from charts import shown, shown_time, style_of, text
from standings.pictures import expected_chart, profile_chart, rank_chart
from standings.scores import LEVEL
from standings.standing import WITHIN

BEST = {'time': 'quickest planner on the problem', 'length': 'shortest path on the problem'}
WORDS = {'time': 'time to the first solution', 'length': 'length of the path'}


def _panel(title, picture, note='', wide=False):
    return (f'<figure class="panel{" wide" if wide else ""}"><figcaption>{title}</figcaption>{picture}'
            f'{f"<p class=note>{note}</p>" if note else ""}</figure>')


def _swatch(index):
    name, dash = style_of(index)
    return (f'<svg class="swatch" viewBox="0 0 24 10" aria-hidden="true"><path class="curve {name}"{dash} '
            'd="M1 5H23"/></svg>')


def probability(p):
    """p = 0.012, p < 0.0001."""
    return 'p < 0.0001' if p < 1e-4 else f'p = {p:.2g}'


def _percent(share):
    return f'{100 * share:.0f} %'


def _figures(results, standing):
    """The table of a field."""
    count = len(standing.field.problems)
    heads = ''.join(f'<th>{f"≤ {ratio:g} ×" if ratio > 1.0 else "best"}</th>' for ratio in WITHIN['time'])
    heads += '<th>rank,<br>length</th>' + ''.join(f'<th>{f"≤ {ratio:g} ×" if ratio > 1.0 else "shortest"}</th>'
                                                  for ratio in WITHIN['length'])
    out = ['<div class="scroll"><table class="figures sortable standings"><thead><tr><th class=name>planner</th>'
           f'<th>problems solved,<br>expected of {count}</th><th>PAR-10</th><th>rank,<br>time</th>{heads}</tr></thead>'
           '<tbody>']
    least = min(row.par10 for row in standing.rows)
    for row in standing.rows:
        name = results.planners[row.index]
        best = ' class="best"' if row.par10 == least and row.solved else ''
        cells = [f'<td data-sort="{row.expected:.6g}" data-tip="{row.solved} of {row.runs} runs">{row.expected:.2f}</td>',
                 f'<td{best} data-sort="{"inf" if math.isnan(row.par10) else f"{row.par10:.6g}"}"><b>'
                 f'{shown_time(row.par10)}</b></td>']
        for measure in WITHIN:
            cells.append(f'<td data-sort="{row.rank[measure]:.6g}">{row.rank[measure]:.2f}</td>')
            for ratio in WITHIN[measure]:
                share = row.within[measure, ratio]
                cells.append(f'<td data-sort="{share:.6g}" data-tip="{text(name)}: {round(share * count)} of {count} '
                             f'problems">{_percent(share)}</td>')
        out.append(f'<tr data-p="{row.index}"><th class="name">{_swatch(row.index)}{text(name)}</th>{"".join(cells)}</tr>')
    out.append(f'</tbody><tfoot><tr><th class="name">virtual best</th><td>{standing.best_solved}</td><td>'
               f'{shown_time(standing.best_par10)}</td><td colspan="{2 + sum(map(len, WITHIN.values()))}"></td></tr>'
               '</tfoot></table></div>')
    return ''.join(out)


def _ranking(results, standing, measure, identifier):
    """Picture of the ranks by a measure, and what is to be known of it."""
    ranking, count = standing.rankings[measure], len(standing.field.problems)
    names = {index: results.planners[index] for index in ranking.ranks}
    picture = rank_chart(identifier, f'mean ranks by {WORDS[measure]}', names, ranking.ranks, ranking.groups)
    said = (f'Friedman over {count} problems: χ² = {shown(ranking.friedman.chi_square)}, {probability(ranking.friedman.p)} '
            f'(by F of Iman and Davenport). Bars join neighbours that pairwise Wilcoxon tests with Holm\'s correction do not '
            f'tell apart at {100 * LEVEL:.0f} %. Nemenyi\'s critical difference, for comparison: '
            f'{shown(ranking.critical)} ranks.')
    return _panel(f'Mean rank by {WORDS[measure]}; left is better', picture, said, wide=True)


def _pair_matrix(results, pairs, measure):
    """Row against column: problems won and lost; coloured where the difference is significant."""
    found = {(pair.first, pair.second): pair for pair in pairs if pair.measure == measure}
    there = sorted({index for pair in found for index in pair})
    head = ''.join(f'<th data-p="{index}"><span>{text(results.planners[index])}</span></th>' for index in there)
    out = [f'<div class="scroll"><table class="matrix pairs"><thead><tr><th class="name">{WORDS[measure]}</th>{head}</tr>'
           '</thead><tbody>']
    for first in there:
        out.append(f'<tr data-p="{first}"><th class="name">{text(results.planners[first])}</th>')
        for second in there:
            pair = found.get((min(first, second), max(first, second)))
            if first == second or pair is None:
                out.append('<td class="absent"></td>')
                continue
            turned = first > second
            wins, losses = (pair.losses, pair.wins) if turned else (pair.wins, pair.losses)
            ratio = pair.ratio
            if turned:
                ratio = 1.0 / ratio if ratio > 0.0 else math.inf
            kind = '' if not pair.differ else ' better' if better(pair, turned) else ' worse'
            tip = (f'{results.planners[first]} against {results.planners[second]}: better on {wins}, alike on {pair.ties}, '
                   f'worse on {losses} of {pair.problems} problems; median ratio {shown(ratio)}; Wilcoxon '
                   f'{probability(pair.wilcoxon.p)}, Holm {probability(pair.wilcoxon_holm)}; sign test '
                   f'{probability(pair.sign)}, Holm {probability(pair.sign_holm)}')
            out.append(f'<td class="pair{kind}" data-p="{second}" data-tip="{text(tip)}">{wins}–{losses}</td>')
        out.append('</tr>')
    return ''.join(out) + '</tbody></table></div>'


def better(pair, turned=False):
    """Does the first one (turned: the second) have the smaller scores by rank?"""
    return (pair.wilcoxon.minus > pair.wilcoxon.plus) != turned


def _class_table(results, standing):
    head = ''.join(f'<th data-p="{index}"><span>{text(name)}</span></th>' for index, name in enumerate(results.planners))
    out = [f'<div class="scroll"><table class="matrix"><thead><tr><th class="name">class</th><th>problems</th>{head}</tr>'
           '</thead><tbody>']
    for name, problems in standing.classes.items():
        listed = ', '.join(problems[:12]) + (' …' if len(problems) > 12 else '')
        out.append(f'<tr><th class="name" data-tip="{text(listed)}">{text(name)}</th><td class="absent">{len(problems)}</td>')
        for index, planner in enumerate(results.planners):
            figures = standing.of_class.get((name, index))
            if figures is None:
                out.append(f'<td class="absent" data-p="{index}"></td>')
                continue
            count, runs, solved, share, penalised = figures
            tip = (f'{planner}, {name}: {solved} of {runs} runs solved on {count} problems, {100 * share:.0f} % of a problem '
                   f'expected; PAR-10 {shown_time(penalised)}')
            out.append(f'<td data-p="{index}" class="{"some" if solved else "none"}" style="--share:{100 * share:.0f}" '
                       f'data-tip="{text(tip)}">{_percent(share)}<br><small>{shown_time(penalised)}</small></td>')
        out.append('</tr>')
    return ''.join(out) + '</tbody></table></div>'


def _field(results, standing, number, several, charts):
    field = standing.field
    count = len(field.problems)
    out = []
    if several:
        names = ', '.join(field.problems[:6]) + (' …' if count > 6 else '')
        out.append(f'<h3>{len(field.planners)} planners on {count} problem{"" if count == 1 else "s"}: {text(names)}</h3>')
    out.append(_figures(results, standing))
    out.append('<div class="charts">')
    made = expected_chart(f'expected-{number}', 'expected number of problems solved over time', standing.expected, count,
                          results.time_limit)
    charts[f'expected-{number}'] = made[1]
    out.append(_panel('Problems solved over time, expected for one try each; band: 95 %', made[0]))
    for measure in BEST:
        made = profile_chart(f'profile-{measure}-{number}', f'performance profile, {WORDS[measure]}',
                             standing.profiles[measure], BEST[measure])
        charts[f'profile-{measure}-{number}'] = made[1]
        out.append(_panel(f'Performance profile: {WORDS[measure]}, median of each problem', made[0]))
    if count > 1 and len(field.planners) > 1:
        out += [_ranking(results, standing, measure, f'ranks-{measure}-{number}') for measure in BEST]
    return ''.join(out) + '</div>'


def standings_html(results, standing, charts):
    """The section; the data of its curves is added to charts."""
    compared = [each for each in standing.fields if len(each.field.planners) > 1] or standing.fields[:1]
    alone = [results.planners[index] for each in standing.fields if each not in compared for index in each.field.planners]
    out = ['<section id="standings"><h2>Planners against each other</h2><p class="note">Each planner\'s score on a problem is '
           'the median over all of its runs there; a problem that it solves in half of them or fewer has the score ∞, the last '
           'rank, and is compared like all others. PAR-10 is the mean time in which a run without a solution counts as ten '
           'time limits.</p>']
    out += [_field(results, each, number, len(standing.fields) > 1, charts) for number, each in enumerate(compared)]
    if alone:
        out.append(f'<p class="note">Run on problems that no other planner was run on alike, and so not ranked: '
                   f'{text(", ".join(alone))}.</p>')
    if standing.pairs:
        most = max(pair.problems for pair in standing.pairs)
        few = ('' if most > 5 else f' With {most} problems no difference can be significant; it takes six without ties and '
               'without a correction.')
        out.append('<h3>Pairs</h3><p class="note">Problems on which the planner of the row is better, and worse, than that of '
                   f'the column; coloured where the signed-rank test with Holm\'s correction tells them apart.{few}</p>')
        out += [_pair_matrix(results, standing.pairs, measure) for measure in BEST]
    else:
        out.append('<p class="note">Tests of pairs and ranks need two problems that planners share.</p>')
    if 1 < len(standing.classes) and len(standing.classes) < len(results.problems):
        out.append('<h3>Classes of problems</h3><p class="note">Share of the problems that is expected to be solved in one try, '
                   'and PAR-10.</p>' + _class_table(results, standing))
    return ''.join(out) + '</section>'
