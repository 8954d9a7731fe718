"""What the paper publishes (arXiv 2406.15429, sections "Results" and "Ablation Experiments"), and what is to be said
beside our figures."""

ALGORITHMS = ['Basic_A*'] + [f'Experiment_{k}' for k in range(1, 7)] + ['Improved_A*']

# ms, ms, m/s^2, degrees
ABLATION = {name: dict(zip(('loading', 'planning', 'acceleration', 'steering'), values)) for name, values in {
    'Basic_A*': (98255.68, 21.86, 1.812, 19.74), 'Experiment_1': (1.78, 442.93, 0.306, 10.79),
    'Experiment_2': (96384.52, 6.9, 0.3062, 10.79), 'Experiment_3': (1.95, 609.01, 0.141, 12.89),
    'Experiment_4': (1.85, 583.30, 0.631, 20.31), 'Experiment_5': (1.82, 430.61, 1.662, 10.05),
    'Experiment_6': (1.80, 621.65, 1.555, 9.20), 'Improved_A*': (1.81, 411.04, 0.306, 10.79)}.items()}

PERPENDICULAR = {name: dict(values) for name, values in ABLATION.items()}
PERPENDICULAR['Basic_A*'].update(length=78.14, travel=20.4)
PERPENDICULAR['Improved_A*'].update(length=72.119, travel=49.6)

PARALLEL = {'Basic_A*': dict(loading=110479.79, planning=65.77, length=101.8261, travel=26.2, acceleration=1.485,
                             steering=12.7033),
            'Improved_A*': dict(loading=3.10, planning=1213.97, length=101.8145, travel=66.4, acceleration=0.30,
                                steering=20.03)}

UNREACHABLE = {'Basic_A*': 'no path', 'Improved_A*': 'a path as near as possible'}

# What, column, numerator, denominator, {verdict: why}.
EFFECTS = [
    ('map loading, Basic A\\* / Improved A\\*', 'loading', 'Basic_A*', 'Improved_A*',
     {'agrees': 'Without lazy loading every cell is checked before the search. The paper does that by looking at all '
                'cells within a circle, in Python; here a cell is one look into a distance field, which is built for all '
                'and counts as loading: so the ratio is smaller.'}),
    ('planning, Basic A\\* / Improved A\\*', 'planning', 'Basic_A*', 'Improved_A*',
     {'agrees': 'Lazy loading moves the checks of cells from loading into planning, and smoothing comes on top.',
      'opposite': 'The checks that lazy loading moves into planning are cheap here.'}),
    ('loading and planning, Basic A\\* / Improved A\\*', 'total', 'Basic_A*', 'Improved_A*',
     {'agrees': 'Most cells are never asked for: what is not checked costs nothing.',
      'differs': 'What lazy loading saves, smoothing costs.', 'opposite': 'What lazy loading saves, smoothing costs.'}),
    ('planning without weighting (1) / Improved A\\*', 'planning', 'Experiment_1', 'Improved_A*',
     {'agrees': 'Weights lead straight to the goal; the rest is smoothing.',
      'differs': 'The weights spare nodes (column "expanded"), but smoothing takes most of the time.',
      'opposite': 'The weights spare nodes (column "expanded"), but the path to which they lead has more corners, and '
                  'smoothing, which takes most of the time, then takes longer.'}),
    ('planning with eager loading (2) / Improved A\\*', 'planning', 'Experiment_2', 'Improved_A*',
     {'agrees': 'The checks are done before, the path is the same.',
      'differs': 'The path is the same, and the checks that are done before hardly cost anything here.',
      'opposite': 'The path is the same, and the checks that are done before hardly cost anything here: this is noise.'}),
    ('loading and planning, eager (2) / Improved A\\*', 'total', 'Experiment_2', 'Improved_A*',
     {'agrees': 'Every cell is checked though few are needed.'}),
    ('planning, one direction and linear list (3) / Improved A\\*', 'planning', 'Experiment_3', 'Improved_A*',
     {'agrees': 'More nodes, and a list that is searched from end to end.',
      'differs': 'More nodes are expanded, but a few hundred in a linear list cost little in C++.',
      'opposite': 'More nodes are expanded, but a few hundred in a linear list cost little in C++, and the path of a '
                  'single search has fewer corners to smooth.'}),
    ('mean acceleration, 16 neighbours (4) / Improved A\\*', 'acceleration', 'Experiment_4', 'Improved_A*',
     {'agrees': 'Long steps meet badly in the middle, as the paper says.'}),
    ('mean steering, 16 neighbours (4) / Improved A\\*', 'steering', 'Experiment_4', 'Improved_A*',
     {'opposite': 'The longer moves turn by smaller angles, which the car can follow.',
      'agrees': 'Long steps meet badly in the middle, as the paper says.'}),
    ('planning without smoothing (5) / Improved A\\*', 'planning', 'Experiment_5', 'Improved_A*',
     {'opposite': 'Our smoothing checks every span of the curve against the map and takes more time than the search.',
      'differs': 'Our smoothing checks every span of the curve against the map and takes more time than the search.'}),
    ('mean acceleration without smoothing (5) / Improved A\\*', 'acceleration', 'Experiment_5', 'Improved_A*',
     {'opposite': 'The controller stops at sharp corners and turns there slowly; it does not jerk.',
      'differs': 'The controller stops at sharp corners and turns there slowly; it does not jerk. And much of the curve '
                 'had to keep the corners (see below).'}),
    ('mean steering without smoothing (5) / Improved A\\*', 'steering', 'Experiment_5', 'Improved_A*',
     {'differs': 'A small effect in the paper; here the curve had to keep most corners.',
      'opposite': 'A small effect in the paper, too.', 'agrees': 'A small effect.'}),
    ('mean acceleration, Basic A\\* / Improved A\\*', 'acceleration', 'Basic_A*', 'Improved_A*',
     {'differs': 'See below.', 'opposite': 'See below.',
      'agrees': 'Corners make the controller brake; ours keeps to the car\'s limits all the same.'}),
    ('mean steering, Basic A\\* / Improved A\\*', 'steering', 'Basic_A*', 'Improved_A*',
     {'opposite': 'See below: weights and bidirectional search leave more corners than plain A\\*, and smoothing may not cut '
                  'them.', 'differs': 'See below.'}),
]

INTRODUCTION = '''
# The paper's experiments, repeated

<!-- Written by benchmarks/report/paper_page from the results of benchmarks/paper/*.cfg; do not edit. -->

The paper ([arXiv 2406.15429](https://arxiv.org/abs/2406.15429)) compares a basic A\\* with an improved one, and takes the
improvements away one by one. This page sets our figures beside its own. To make it again:

```sh
for name in perpendicular parallel unreachable; do
    parking_benchmark benchmarks/paper/$name.cfg --output results/paper/$name
done
benchmarks/report/paper_page results/paper
```

[How the experiments are set up](paper-experiments.md).
'''

METHOD = '''
## What can be compared

The paper's program is written in Python and its maps are not published. Ours is C++, on
[maps of our own](../benchmarks/paper/make_maps) with the same size, start and slot; a cell is 0.5 m. So absolute figures
are not comparable, and what matters is the direction of an effect. As in the paper, the plan ends where the reverse-parking
manoeuvre begins. The car model is ours: its rows beside the others show what the same task costs when paths are drivable.

Map loading holds what is done once per map (obstacles and distance field) and, with eager loading, the check of every
cell. Averages of the drive are over time, with absolute values, standstills included; the paper leaves them undefined.
'''

READING = '''
## Where it does not agree, and why

**Smoothing.** The paper puts a B-spline through the grid path and drives it. A spline cuts corners, and a shortest grid path
hugs the inner corner of every bend: the spline then leads the car into the obstacle. Ours is checked span by span, and
follows the grid path wherever the curve would collide. In narrow aisles that is most of the corners, so that smoothing
saves little steering and costs more time than the search itself.

**Corners.** A heuristic weight above 1 and two searches that meet somewhere find a path sooner, but not a straighter one:
where the two meet, and where the weights change, it zigzags. Basic A\\*, whose path is a shortest one, has fewer corners.
A car cannot turn on the spot: at a corner that it cannot cut within a metre our controller stops and shunts, which is
what the travel times show. The paper's controller follows its corners with acceleration peaks instead.

**Collisions in the drive.** The disc stands for a car that is four metres long: where the grid path turns sharply, the
car's corners leave the disc. The rows with collisions are paths that the disc can take and the car cannot. The car
model's paths, planned for the body, have none, are driven in the shortest time, and need no more planning time.

**Lazy loading** is the effect that carries the paper, and it is there: the cells are checked when the search gets to
them, and loading becomes nearly free. How much that is worth depends on how dear a check is. With a distance field it is
dear no longer.
'''
