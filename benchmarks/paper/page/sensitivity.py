"""Do the verdicts hang on the disc's radius, the weight, or the cell?"""
import os

from formatting import shown
from design import ALGORITHMS, SAME_PATH, SENSITIVITY, folder_of, study_of
from paired import compare, correct, verdict, way_of
from ratios import MEASURE_NAMES, named
from study import TIMES, Study


def comparisons_of(rows, study):
    """Of the same ratios in another study, corrected as one family. Experiment 2 drives what Improved A* drives."""
    found = []
    for row in rows:
        firsts, seconds = (study.figures(row.measure, ALGORITHMS[name]) or
                           study.figures(row.measure, ALGORITHMS[SAME_PATH.get(name, name)])
                           for name in (row.first, row.second))
        found.append(compare(firsts, seconds))
    correct([each for each in found if each.ratios])
    return found


def table(results_folder, scenario, rows):
    """(table of the verdicts that change, how many there are, how many were looked at, values with runs that failed)."""
    own = [row for row in rows if row.scenario == scenario.name and row.measure not in TIMES]
    columns, unsolved = [], []
    for what, key, _, values in SENSITIVITY:
        for value in values:
            if not os.path.isdir(os.path.join(results_folder, folder_of(study_of(key, value), scenario.name))):
                continue
            study = Study(results_folder, study_of(key, value), scenario.name)
            columns.append((f'{what} {value:g}', comparisons_of(own, study)))
            if study.unsolved:
                unsolved.append(f'{what} {value:g}: {study.unsolved} of {len(study.results.runs)}')
    lines = [f'| ratio ({scenario.name}) | usual | ' + ' | '.join(name for name, _ in columns) + ' |',
             '| --- |' + ' --- |' * (len(columns) + 1)]
    changed = 0
    for index, row in enumerate(own):
        found = [row.ours] + [comparisons[index] for _, comparisons in columns]
        outcomes = [verdict(way_of(row.paper), ours.way()) for ours in found]
        if len(set(outcomes) - {'unclear'}) > 1:
            changed += 1
            lines.append(f'| {MEASURE_NAMES[row.measure]}: {named(row.first)} / {named(row.second)} (paper '
                         f'{shown(row.paper)}) | ' + ' | '.join(
                             f'{outcome} ({shown(ours.middle)})' if ours.ratios else '–'
                             for outcome, ours in zip(outcomes, found)) + ' |')
    return '\n'.join(lines) if changed else '', changed, len(own), unsolved
