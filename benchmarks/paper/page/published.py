"""What the paper publishes (arXiv 2406.15429, sections "Results", "Ablation Experiments" and "Discussion"): nothing but its
figures. ms, ms, m/s^2, degrees; lengths and travel times in the paper's own units."""

ALGORITHMS = ['Basic_A*'] + [f'Experiment_{k}' for k in range(1, 7)] + ['Improved_A*']
WHAT = {'Basic_A*': 'no improvement', 'Experiment_1': 'without weighted heuristic',
        'Experiment_2': 'without dynamic loading', 'Experiment_3': 'without two directions and heap',
        'Experiment_4': 'with 16 neighbours', 'Experiment_5': 'without smoothing',
        'Experiment_6': 'without smoothing, two directions and heap', 'Improved_A*': ''}

# Table "Comparison of each algorithm in ablation experiment".
ABLATION = {name: dict(zip(('loading', 'planning', 'acceleration', 'steering'), values)) for name, values in {
    'Basic_A*': (98255.68, 21.86, 1.812, 19.74), 'Experiment_1': (1.78, 442.93, 0.306, 10.79),
    'Experiment_2': (96384.52, 6.9, 0.3062, 10.79), 'Experiment_3': (1.95, 609.01, 0.141, 12.89),
    'Experiment_4': (1.85, 583.30, 0.631, 20.31), 'Experiment_5': (1.82, 430.61, 1.662, 10.05),
    'Experiment_6': (1.80, 621.65, 1.555, 9.20), 'Improved_A*': (1.81, 411.04, 0.306, 10.79)}.items()}

# Table "Algorithm Performance Comparison in Vertical Parking Scenario". Its loading time of Improved A* is another than
# that of the ablation table (docs/paper-errata.md).
VERTICAL = {'Basic_A*': dict(loading=98255.68, planning=21.86, length=78.14, travel=20.4, acceleration=1.812,
                             steering=19.743),
            'Improved_A*': dict(loading=2.062, planning=411.04, length=72.119, travel=49.6, acceleration=0.306,
                                steering=10.791)}

# Table "Algorithm Performance Comparison in Parallel Parking Scenario".
PARALLEL = {'Basic_A*': dict(loading=110479.79, planning=65.77, length=101.8261, travel=26.2, acceleration=1.485,
                             steering=12.7033),
            'Improved_A*': dict(loading=3.10, planning=1213.97, length=101.8145, travel=66.4, acceleration=0.30,
                                steering=20.03)}

for _table in (ABLATION, VERTICAL, PARALLEL):
    for _row in _table.values():
        _row['total'] = _row['loading'] + _row['planning']

# (claim, section, scenario, measure, algorithm, compared with, by how much less)
HEADLINES = [
    ('loading and planning take over 95 % less time', 'Vertical Parking, Discussion', 'perpendicular', 'total',
     'Improved_A*', 'Basic_A*', 0.95),
    ('over 95 % less time', 'Parallel Parking', 'parallel', 'total', 'Improved_A*', 'Basic_A*', 0.95),
    ('acceleration 83.1 % less', 'Vertical Parking', 'perpendicular', 'acceleration', 'Improved_A*', 'Basic_A*', 0.831),
    ('steering angle 45.3 % less', 'Vertical Parking', 'perpendicular', 'steering', 'Improved_A*', 'Basic_A*', 0.453),
    ('acceleration 79.8 % less', 'Parallel Parking', 'parallel', 'acceleration', 'Improved_A*', 'Basic_A*', 0.798),
    ('shorter paths (7.7 %)', 'Vertical Parking', 'perpendicular', 'length', 'Improved_A*', 'Basic_A*',
     1.0 - 72.119 / 78.14),
    ('planning 68.4 % faster than Basic A\\* once loading is left out (experiment 2)', 'Discussion', 'perpendicular',
     'planning', 'Experiment_2', 'Basic_A*', 0.684),
    ('two directions and heap plan 32.5 % faster (against experiment 3)', 'Discussion', 'perpendicular', 'planning',
     'Improved_A*', 'Experiment_3', 0.325)]


def ratio_rows():
    """All ratios of the paper's tables: (scenario, measure, first, second, the paper's ratio)."""
    rows = []
    for measure in ('loading', 'planning', 'total', 'acceleration', 'steering'):
        pairs = [(name, 'Improved_A*') for name in ALGORITHMS[:-1]]
        if measure == 'planning':
            pairs.append(('Experiment_2', 'Basic_A*'))
        if measure != 'loading':
            pairs += [('Experiment_6', 'Experiment_5'), ('Experiment_6', 'Experiment_3')]
        rows += [('perpendicular', measure, first, second, ABLATION[first][measure] / ABLATION[second][measure])
                 for first, second in pairs]
    rows += [(scenario, measure, 'Basic_A*', 'Improved_A*', table['Basic_A*'][measure] / table['Improved_A*'][measure])
             for scenario, table, measures in (
                 ('perpendicular', VERTICAL, ('length', 'travel')),
                 ('parallel', PARALLEL, ('loading', 'planning', 'total', 'length', 'travel', 'acceleration', 'steering')))
             for measure in measures]
    return rows
