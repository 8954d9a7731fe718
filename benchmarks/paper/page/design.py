"""Which variants of the paper's A* are run on the generated maps, and what their runs are called."""
import itertools

# The five improvements that the paper takes away one by one: key, name, settings without it, settings with it. All the
# rest is as in the parameter set improved_astar.
FACTORS = [
    ('w', 'weighted heuristic', {'heuristic_weight_far': 1, 'heuristic_weight_near': 1, 'near_goal_distance': 0,
                                 'tie_break': 0}, {}),
    ('l', 'dynamic loading', {'obstacle_loading': 'eager'}, {}),
    ('b', 'two directions and heap', {'bidirectional': 'false', 'search_from': 'start', 'open_list': 'linear'}, {}),
    ('n', '16 neighbours', {}, {'motion_model': 'grid16'}),
    ('s', 'smoothing', {'smoothing': 'none'}, {}),
]
SCENARIOS = ('perpendicular', 'parallel')
RUNS = 4                # of each variant on each map: the search does the same in each, the clock does not
KEYS = ''.join(factor[0] for factor in FACTORS)


def name_of(present):
    """The variant with these of the improvements: wlbs has all but n; none has none."""
    return ''.join(key for key in KEYS if key in present) or 'none'


VARIANTS = [name_of([key for key, there in zip(KEYS, chosen) if there])
            for chosen in itertools.product((False, True), repeat=len(KEYS))]

# The paper's algorithms among them. (Basic A* differs in giving up where there is no way, too; here there is one.)
ALGORITHMS = {'Basic_A*': 'none', 'Experiment_1': 'lbs', 'Experiment_2': 'wbs', 'Experiment_3': 'wls',
              'Experiment_4': 'wlbns', 'Experiment_5': 'wlb', 'Experiment_6': 'wl', 'Improved_A*': 'wlbs'}
# Loading changes when cells are looked at, not which way is found: experiment 2 drives what Improved A* drives.
SAME_PATH = {'Experiment_2': 'Improved_A*'}

# What a verdict must not hang on: name, key of [problem] or parameter, values beside the usual one.
RADIUS, WEIGHT, CELL = 1.25, 1.5, 0.5
DRIVEN_VALUES = {('circle_radius', 1.5), ('heuristic_weight_far', 2.0)}  # whose paths are driven, too: that takes long
SENSITIVITY = [('disc radius, m', 'circle_radius', RADIUS, (1.0, 1.5, 2.0)),
               ('weight far from the goal', 'heuristic_weight_far', WEIGHT, (1.2, 2.0, 3.0)),
               ('cell, m', 'xy_resolution', CELL, (0.25, 1.0))]


def settings_of(variant, changes):
    settings = {'parameter_set': 'improved_astar'}
    for key, _, without, with_it in FACTORS:
        if key == 'w' and key in variant.replace('none', ''):
            settings.update({name: value for name, value in changes.items() if name.startswith('heuristic_weight')})
        settings.update(with_it if key in variant.replace('none', '') else without)
    settings.update({name: value for name, value in changes.items() if not name.startswith('heuristic_weight')})
    return settings


def configuration(files, variants, runs, track=False, radius=RADIUS, changes=None):
    """The text of a .cfg."""
    lines = ['# Written by scripts/reproduce-paper.', '[problem]', *(f'scenario = {file}' for file in files), 'space = se2',
             'footprint = circle', f'circle_radius = {radius}', '', '[benchmark]', 'time_limit = 5.0',
             f'run_count = {runs}', 'seed = 1', f'track = {"true" if track else "false"}', '', '[planner]']
    for variant in variants:
        lines += ['improved_astar=', f'improved_astar.name={variant}']
        lines += [f'improved_astar.{key}={value}' for key, value in settings_of(variant, changes or {}).items()]
    return '\n'.join(lines) + '\n'


def folder_of(study, scenario):
    """Of the results, in the folder of all results."""
    return f'{study}_{scenario}'


def study_of(key, value):
    """Of a value in SENSITIVITY."""
    return f'{key}_{value}'


def studies(maps, count, quick=False):
    """(name of the folder, text of the .cfg) of all runs on generated maps, count of each scenario."""
    algorithms = list(dict.fromkeys(ALGORITHMS.values()))
    driven = [variant for name, variant in ALGORITHMS.items() if name not in SAME_PATH]
    made = []
    for scenario in SCENARIOS:
        every = [f'{maps}/{scenario}_{k:02}.yaml' for k in range(count)]
        made += [(folder_of('factorial', scenario), configuration(every, VARIANTS, 1 if quick else RUNS)),
                 (folder_of('drives', scenario), configuration(every, driven, 1, track=True))]
        for _, key, _, values in SENSITIVITY:
            for value in values:
                radius = value if key == 'circle_radius' else RADIUS
                changes = {} if key == 'circle_radius' else {key: value}
                made.append((folder_of(study_of(key, value), scenario),
                             configuration(every, algorithms, 1, not quick and (key, value) in DRIVEN_VALUES, radius,
                                           changes)))
    return made
