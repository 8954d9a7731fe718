"""What is run of the paper at its word: paper_run's variants, and how the improvements' effects grow with the map."""
import itertools

from design import ALGORITHMS as KEYS_OF, settings_of

SCENARIOS = ('perpendicular', 'parallel')
ALGORITHMS = {'Basic_A*': 'basic_astar', **{f'Experiment_{k}': f'experiment_{k}' for k in range(1, 7)},
              'Improved_A*': 'improved_astar'}
REPEATS = 5                   # times of these variants are the least of so many
TIMED = ('printed', 'field')  # others run once: what they are for is counted, or driven

# name: (what it is, arguments of paper_run, are the ways driven?)
VARIANTS = {
    'printed': ('as printed', [], True),
    'corrected': ('disc ahead of the axle, a spline for each stretch', ['--disc', 'ahead', '--per-stretch'], True),
    'rear_axle': ('disc round the rear axle', ['--disc', 'rear_axle'], True),
    'radius_1': ('disc of 1 m', ['--radius', '1'], True),
    'radius_1.5': ('disc of 1.5 m', ['--radius', '1.5'], True),
    'bezier': ('Bezier curve', ['--spline', 'bezier'], True),
    'field': ('distance field instead of the scan', ['--lookup', 'field'], False),
    'octile': ('diagonal distance', ['--set', 'heuristic=octile'], False),
    'manhattan': ('Manhattan distance', ['--set', 'heuristic=manhattan'], False),
}
# Beside the first one; verdicts are compared between these.
SENSITIVE = ('printed', 'corrected', 'rear_axle', 'radius_1', 'radius_1.5', 'bezier')
FRAME_VARIANTS = ('printed', 'corrected')  # of real frames, where they are given


def runs_file(scenario, variant):
    return f'word_{scenario}_{variant}.json'


def own_file(scenario, number):
    """Of this project's pipeline on the same task."""
    return f'own_{scenario}_{number:02}.json'


# Growth: maps of so many cells along each side, with so large a share of the ground under boxes.
SIZES, QUICK_SIZES = (50, 100, 200, 400), (50, 100)
CLUTTER = (0.0, 0.1, 0.2)
GROWTH_MAPS, QUICK_GROWTH_MAPS = 10, 2  # of each size and clutter
# Heap and two directions apart, unlike in the paper.
GROWTH_FACTORS = [
    ('w', 'weighted heuristic', {'heuristic_weight_far': 1, 'heuristic_weight_near': 1, 'near_goal_distance': 0,
                                 'tie_break': 0}),
    ('l', 'dynamic loading', {'obstacle_loading': 'eager'}),
    ('b', 'two directions', {'bidirectional': 'false', 'search_from': 'start'}),
    ('h', 'heap', {'open_list': 'linear'}),
]
GROWTH_KEYS = ''.join(key for key, *_ in GROWTH_FACTORS)


def growth_variants():
    """{name: settings} of all combinations, without smoothing."""
    found = {}
    for chosen in itertools.product((False, True), repeat=len(GROWTH_FACTORS)):
        settings = {'parameter_set': 'improved_astar', 'smoothing': 'none'}
        for (_, _, without), there in zip(GROWTH_FACTORS, chosen):
            settings.update({} if there else without)
        found[''.join(key for key, there in zip(GROWTH_KEYS, chosen) if there) or 'none'] = settings
    return found


def growth_name(size, clutter, number):
    return f'growth_{size:03}_{round(100 * clutter):02}_{number:02}'


def growth_configuration(files):
    lines = ['# Written by scripts/reproduce-paper.', '[problem]', *(f'scenario = {file}' for file in files), 'space = se2',
             'footprint = circle', 'circle_radius = 0.6', '', '[benchmark]', 'time_limit = 10.0', 'run_count = 1', 'seed = 1', '',
             '[planner]']
    for name, settings in growth_variants().items():
        lines += ['improved_astar=', f'improved_astar.name={name}']
        lines += [f'improved_astar.{key}={value}' for key, value in settings.items()]
    return '\n'.join(lines) + '\n'


# Beyond the paper: its improvements with the car's rectangle instead of the disc, and other planners on the same tasks.
BEYOND_MAPS = 12  # of each scenario
LEFT_OUT = {'weighted heuristic': 'Experiment_1', 'dynamic loading': 'Experiment_2', 'two directions and heap': 'Experiment_3',
            '8 neighbours instead of 16': 'Experiment_4', 'smoothing': 'Experiment_5'}
PLANNERS = {'Car': 'improved_astar', 'Hybrid A*': 'textbook_hybrid_astar', 'RRT*': 'RRTstar', 'PRM': 'PRM',
            'RRTConnect': 'RRTConnect'}
PLANNING_TIME = 1.0  # seconds of processor time


def rectangle_configuration(files):
    lines = ['# Written by scripts/reproduce-paper.', '[problem]', *(f'scenario = {file}' for file in files), 'space = se2',
             'footprint = rectangle', '', '[benchmark]', 'time_limit = 10.0', 'run_count = 1', 'seed = 1', 'clock = processor', '',
             '[planner]']
    for name in ('Improved_A*', *LEFT_OUT.values()):
        lines += ['improved_astar=', f'improved_astar.name={name}']
        lines += [f'improved_astar.{key}={value}' for key, value in settings_of(KEYS_OF[name], {}).items()]
    return '\n'.join(lines) + '\n'


def planners_configuration(files):
    lines = ['# Written by scripts/reproduce-paper.', '[problem]', *(f'scenario = {file}' for file in files),
             'space = reeds_shepp', 'footprint = rectangle', '', '[benchmark]', f'time_limit = {PLANNING_TIME}', 'run_count = 1',
             'seed = 1', 'clock = processor', '', '[planner]']
    for name, planner in PLANNERS.items():
        lines += [f'{planner}=', f'{planner}.name={name.replace(" ", "_")}']
    return '\n'.join(lines) + '\n'
