"""The standings for programs: statistics.json has all, standings.csv and pairs.csv what tables hold."""
import csv
import io
import json
import math

from standings.scores import MEASURES
from standings.standing import WITHIN

FORMAT = 1  # of statistics.json
FILES = {'statistics.json': 'all figures of "Planners against each other"',
         'standings.csv': 'planners overall and by class of problem: PAR-10, ranks, shares',
         'pairs.csv': 'every pair of planners: wins, tests, corrected p values'}


def _number(value):
    """None for what is not finite: JSON has no infinity."""
    return value if math.isfinite(value) else None


def _csv(rows):
    stream = io.StringIO()
    csv.writer(stream, lineterminator='\n').writerows(rows)
    return stream.getvalue()


def _cell(value):
    return '' if not math.isfinite(value) else f'{value:.10g}'


def standings_csv(results, standing):
    """Planners of each field on all its problems, then each class; empty: no figure, or infinite."""
    shares = [(measure, ratio) for measure in MEASURES for ratio in WITHIN[measure]]
    rows = [['field', 'class', 'planner', 'problems', 'runs', 'solved', 'expected_solved', 'par10_s']
            + [f'rank_{measure}' for measure in MEASURES] + [f'{measure}_within_{ratio:g}' for measure, ratio in shares]]
    for number, each in enumerate(standing.fields):
        count = len(each.field.problems)
        for row in each.rows:
            rows.append([number, '', results.planners[row.index], count, row.runs, row.solved, _cell(row.expected),
                         _cell(row.par10)] + [_cell(row.rank[measure]) for measure in MEASURES]
                        + [_cell(row.within[share]) for share in shares])
        rows.append([number, '', 'virtual best', count, '', '', each.best_solved, _cell(each.best_par10)]
                    + [''] * (len(MEASURES) + len(shares)))
    for (name, index), (count, runs, solved, share, penalised) in standing.of_class.items():
        rows.append(['', name, results.planners[index], count, runs, solved, _cell(share * count), _cell(penalised)]
                    + [''] * (len(MEASURES) + len(shares)))
    return _csv(rows)


def pairs_csv(results, standing):
    rows = [['measure', 'first', 'second', 'problems', 'wins', 'ties', 'losses', 'median_ratio', 'rank_sum_worse',
             'rank_sum_better', 'wilcoxon_p', 'wilcoxon_exact', 'wilcoxon_p_holm', 'sign_p', 'sign_p_holm']]
    for pair in standing.pairs:
        test = pair.wilcoxon
        rows.append([pair.measure, results.planners[pair.first], results.planners[pair.second], pair.problems, pair.wins,
                     pair.ties, pair.losses, _cell(pair.ratio), _cell(test.plus), _cell(test.minus), _cell(test.p),
                     int(test.exact), _cell(pair.wilcoxon_holm), _cell(pair.sign), _cell(pair.sign_holm)])
    return _csv(rows)


def _ranking(results, ranking):
    return {'mean_ranks': {results.planners[index]: rank for index, rank in ranking.ranks.items()},
            'friedman': None if ranking.friedman is None else
            {name: _number(value) for name, value in ranking.friedman._asdict().items()},
            'nemenyi_critical_difference': _number(ranking.critical),
            'not_told_apart': [[results.planners[index] for index in group] for group in ranking.groups]}


def statistics_json(results, standing):
    """Everything; null stands for infinity, or for a figure that there is not."""
    names = results.planners
    found = {'format': FORMAT, 'time_limit': _number(standing.limit), 'measures': MEASURES, 'fields': [], 'pairs': [],
             'classes': standing.classes}
    for each in standing.fields:
        found['fields'].append({
            'problems': each.field.problems,
            'virtual_best': {'par10': _number(each.best_par10), 'solved': each.best_solved,
                             **{measure: [_number(value) for value in each.field.virtual_best(measure)]
                                for measure in MEASURES}},
            'planners': [{
                'planner': names[row.index], 'runs': row.runs, 'solved': row.solved, 'expected_solved': row.expected,
                'par10': _number(row.par10),
                **{measure: {'scores': [_number(value) for value in each.field.scores[measure][row.index]],
                             'mean_rank': row.rank[measure],
                             'profile': [list(point) for point in each.profiles[measure][row.index]]}
                   for measure in MEASURES},
                'expected_over_time': [list(point) for point in each.expected[row.index]]} for row in each.rows],
            **{f'ranking_{measure}': _ranking(results, ranking) for measure, ranking in each.rankings.items()}})
    for pair in standing.pairs:
        test = pair.wilcoxon
        found['pairs'].append({
            'measure': pair.measure, 'first': names[pair.first], 'second': names[pair.second], 'problems': pair.problems,
            'wins': pair.wins, 'ties': pair.ties, 'losses': pair.losses, 'median_ratio': _number(pair.ratio),
            'wilcoxon': dict(test._asdict(), p_holm=pair.wilcoxon_holm),
            'sign': {'p': pair.sign, 'p_holm': pair.sign_holm}})
    found['of_class'] = [
        {'class': name, 'planner': names[index], 'problems': count, 'runs': runs, 'solved': solved, 'expected_share': share,
         'par10': _number(penalised)}
        for (name, index), (count, runs, solved, share, penalised) in standing.of_class.items()]
    return json.dumps(found, separators=(',', ':'), ensure_ascii=False) + '\n'


def tables(results, standing):
    """name of the file -> its content"""
    return {'statistics.json': statistics_json(results, standing), 'standings.csv': standings_csv(results, standing),
            'pairs.csv': pairs_csv(results, standing)}
