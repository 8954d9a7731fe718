"""What the page of the paper at its word says whatever the figures are. Nothing here explains a result."""
from word_design import PLANNING_TIME
from word_study import PARKED_ANGLE, PARKED_DISTANCE

INTRODUCTION = '''
# The paper at its word

<!-- Written by benchmarks/paper/page/word_page from the results of scripts/reproduce-paper; do not edit. -->

[The other page](paper-comparison.md) compares the paper's algorithms as this project runs them: with its distance field, its
checked spline and its controller. Here the paper does all of it, from perceived voxels to standstill in the slot: the disc
round the body's middle, every cell in it looked up, one spline through A\\*'s way and the manoeuvre, and the paper's own cost of
the controller along a way that nobody has reworked. To make it again: `scripts/reproduce-paper --part word`.
[The switches](paper-experiments.md), [the elements of the method](paper-elements.md),
[where the paper errs](paper-errata.md).
'''


def method(counts):
    tasks = ' and '.join(f'{count} {name} tasks' for name, count in counts.items())
    return f'''
{tasks} ([make_random_maps](../benchmarks/paper/make_random_maps) `--voxels`), all algorithms
on each. Each map is a file of voxels with labels in SurroundOcc's format, which becomes a grid of 200 x 200 cells of 0.5 m. Times are processor time, the least of
the runs; what else the machine does can make them longer, and touches nothing that is counted, nor ways and drives.
'''


RUN = f'''
*Manoeuvre*: tasks for which the paper's single sweep exists. *Way*: for which A\\* gets to where it begins. *Parked*: drives that
come to rest within {PARKED_DISTANCE:g} m and {PARKED_ANGLE:g}° of the goal. *Touch something*: drives on which the car's body, the rectangle, is in an
obstacle at some moment. The other figures are medians. As printed, the car's poses are of the body's middle and obey the
equations of the rear axle. The last row is this project's pipeline on the same tasks: `parking_plan --trajectory --track`.
'''

FIGURE = '''
The first map of each scenario. Thin: the corners of A\\*'s way and of the manoeuvre; thick: what is to be driven; dotted: what
the paper's controller drives. Below it acceleration and steering on the perpendicular one, in the manner of the paper's figures.
'''

RATIOS = '''
As printed, by the rule of [the other page](paper-comparison.md). The drives end in the slot or
wherever the controller gets to.
'''

SENSITIVITY = '''
The same ratios, but for the times, where the paper is taken another way. Listed are those with two different certain verdicts;
the median of ours is in brackets.
'''

DISC = '''
Ways of Improved A\\*. The share is that of the way to the manoeuvre on which the body, heading where the way goes, would stand in
an obstacle: what the disc does not cover.
'''

LOOKUP = '''
As printed every cell in the disc is looked at; beside it the same search with a distance field, which is made beforehand and
counts as loading. Medians of the maps.
'''

DISTANCES = '''
Diagonal and Manhattan distance instead of the Euclidean one: the ratio of the figures map by map, its median and the 95 %
interval of that, bold where it is certain (sign test, Holm over the table). A search from one side with both weights at 1, as
Basic A\\*'s, goes by its lower bound, which is the Euclidean distance whatever `heuristic` says.
'''


def growth(growing):
    return f'''
Square grounds ([make_growth_maps](../benchmarks/paper/make_growth_maps)) with boxes on a share of them (the clutter), from corner
to corner, for a disc of 0.6 m; heap and two directions apart, all 16 combinations, without smoothing. {growing.unsolved} of {growing.count} runs ended
without a way. An effect is the factor by which an improvement changes a figure, in the geometric mean over the combinations of
the others; the tables have its median over the grounds and the 95 % interval of that, bold where p < 0.05 (sign test, Holm over
the cells of one improvement in one table). *Lower from*: the least size from which on the figure is certainly lower with the
improvement. Without clutter all grounds of a size are the same one: there is a figure, and nothing to be certain of.
'''


def rectangle(study):
    return f'''
Which of the paper's improvements survive when the car's rectangle is checked instead of the disc? The same algorithms on
approaches to slots, the rectangle in the heading of each step. An effect is the ratio of Improved A\\* to the algorithm without
the improvement, map by map: its median and the 95 % interval of that, bold where p < 0.05 (sign test, Holm over the table). Above
1: more with the improvement. {study.unsolved} of {len(study.results.runs)} runs ended without a way.
'''


PLANNERS = f'''
Other planners on the whole tasks, from voxels into the slot: motions that the car can drive, its rectangle, {PLANNING_TIME:g} s of
processor time for each, one run. *Car* is this project's car model. Lengths are over the shortest one that any of them found.
'''
