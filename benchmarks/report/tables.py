"""The standings for programs: all in statistics.json, the tables in standings.csv and pairs.csv."""
import csv
import io
import json
import math

from standings import MEASURES, WITHIN

FORMAT = 1  # format of statistics.json
FILES = {'statistics.json': 'all figures of "Planners against each other"',
         'standings.csv': 'planners overall and by class of problem: PAR-10, ranks, shares',
         'pairs.csv': 'every pair of planners: wins, tests, corrected p values'}
SHARES = [(measure, ratio) for measure in MEASURES for ratio in WITHIN[measure]]


def _csv(heading, rows):
    """Numbers with ten digits; empty for missing or infinite ones."""
    stream = io.StringIO()
    writer = csv.DictWriter(stream, heading, restval='', lineterminator='\n')
    writer.writeheader()
    for row in rows:
        writer.writerow({name: value if not isinstance(value, float) else f'{value:.10g}' if math.isfinite(value) else ''
                         for name, value in row.items()})
    return stream.getvalue()


def _standings_csv(results, standings):
    """Planners of each field on all its problems, then each class."""
    heading = ['field', 'class', 'planner', 'problems', 'runs', 'solved', 'expected_solved', 'par10_s',
               *(f'rank_{measure}' for measure in MEASURES), *(f'{measure}_within_{ratio:g}' for measure, ratio in SHARES)]
    rows = []
    for number, field in enumerate(standings.fields):
        count = len(field.problems)
        for row in field.rows:
            rows.append({'field': number, 'planner': results.planners[row.index], 'problems': count, 'runs': row.runs,
                         'solved': row.solved, 'expected_solved': float(row.expected), 'par10_s': row.par10,
                         **{f'rank_{measure}': row.rank[measure] for measure in MEASURES},
                         **{f'{measure}_within_{ratio:g}': row.within[measure, ratio] for measure, ratio in SHARES}})
        rows.append({'field': number, 'planner': 'virtual best', 'problems': count, 'expected_solved': field.best_solved,
                     'par10_s': field.best_par10})
    for (name, index), (count, runs, solved, share, par10) in standings.of_class.items():
        rows.append({'class': name, 'planner': results.planners[index], 'problems': count, 'runs': runs, 'solved': solved,
                     'expected_solved': float(share * count), 'par10_s': par10})
    return _csv(heading, rows)


def _pairs_csv(results, standings):
    heading = ['measure', 'first', 'second', 'problems', 'wins', 'ties', 'losses', 'median_ratio', 'rank_sum_worse',
               'rank_sum_better', 'wilcoxon_p', 'wilcoxon_exact', 'wilcoxon_p_holm', 'sign_p', 'sign_p_holm']
    return _csv(heading, ({
        'measure': pair.measure, 'first': results.planners[pair.first], 'second': results.planners[pair.second],
        'problems': pair.problems, 'wins': pair.wins, 'ties': pair.ties, 'losses': pair.losses, 'median_ratio': pair.ratio,
        'rank_sum_worse': pair.wilcoxon.plus, 'rank_sum_better': pair.wilcoxon.minus, 'wilcoxon_p': pair.wilcoxon.p,
        'wilcoxon_exact': int(pair.wilcoxon.exact), 'wilcoxon_p_holm': pair.wilcoxon_holm, 'sign_p': pair.sign,
        'sign_p_holm': pair.sign_holm} for pair in standings.pairs))


def _finite(value):
    """The value with None for everything that is not finite: JSON has no infinity."""
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _field_json(results, field):
    names = results.planners
    return {
        'problems': field.problems,
        'virtual_best': {'par10': field.best_par10, 'solved': field.best_solved, **field.virtual_best},
        'planners': [{
            'planner': names[row.index], 'runs': row.runs, 'solved': row.solved, 'expected_solved': row.expected,
            'par10': row.par10,
            **{measure: {'scores': field.scores[measure][row.index], 'mean_rank': row.rank[measure],
                         'profile': field.profiles[measure][row.index]} for measure in MEASURES},
            'expected_over_time': field.expected[row.index]} for row in field.rows],
        **{f'ranking_{measure}': {
            'mean_ranks': {names[index]: rank for index, rank in ranking.ranks.items()},
            'friedman': ranking.friedman and ranking.friedman._asdict(),
            'nemenyi_critical_difference': ranking.critical,
            'not_told_apart': [[names[index] for index in group] for group in ranking.groups]}
           for measure, ranking in field.rankings.items()}}


def _statistics_json(results, standings):
    names = results.planners
    found = {
        'format': FORMAT, 'time_limit': results.time_limit, 'measures': MEASURES,
        'fields': [_field_json(results, field) for field in standings.fields],
        'pairs': [{'measure': pair.measure, 'first': names[pair.first], 'second': names[pair.second],
                   'problems': pair.problems, 'wins': pair.wins, 'ties': pair.ties, 'losses': pair.losses,
                   'median_ratio': pair.ratio, 'wilcoxon': dict(pair.wilcoxon._asdict(), p_holm=pair.wilcoxon_holm),
                   'sign': {'p': pair.sign, 'p_holm': pair.sign_holm}} for pair in standings.pairs],
        'classes': standings.classes,
        'of_class': [{'class': name, 'planner': names[index], 'problems': count, 'runs': runs, 'solved': solved,
                      'expected_share': share, 'par10': par10}
                     for (name, index), (count, runs, solved, share, par10) in standings.of_class.items()]}
    return json.dumps(_finite(found), separators=(',', ':'), ensure_ascii=False) + '\n'


def tables(results, standings):
    """name of the file -> its content"""
    return {'statistics.json': _statistics_json(results, standings), 'standings.csv': _standings_csv(results, standings),
            'pairs.csv': _pairs_csv(results, standings)}
