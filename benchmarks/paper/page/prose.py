"""What the page says whatever the figures are: how it was done, and what the rules are. Nothing here explains a result."""
INTRODUCTION = '''
# The paper's experiments, repeated

<!-- Written by benchmarks/paper/page/paper_page from the results of scripts/reproduce-paper; do not edit. -->

The paper ([arXiv 2406.15429](https://arxiv.org/abs/2406.15429)) compares a basic A\\* with an improved one, and takes the
improvements away one by one. This page sets our figures beside its own. To make it again: `scripts/reproduce-paper`.
[How the experiments are set up](paper-experiments.md); [where the paper errs](paper-errata.md).
'''


def method(counts, unsolved, machine):
    maps = ' and '.join(f'{count} generated {name} maps' for name, count in counts.items())
    return f'''
The paper's program is written in Python, its maps are not published, and each of its figures comes from one map. Ours is
C++. So absolute figures are not comparable; what can be compared are ratios between two algorithms. Ours are taken on
{maps} ([make_random_maps](../benchmarks/paper/make_random_maps)), both
algorithms on each map; {unsolved} runs there ended without a path.

Map loading holds what is done once per map (obstacles and distance field) and, with eager loading, the check of every
cell. Loading and planning together are processor time. The two apart are wall times, the least of the runs that did not have
to wait for the processor. Cells and poses looked at are counted over loading and planning. The plan ends where the
reverse-parking manoeuvre begins. Averages of the drive are over time, with absolute values, standstills included; the paper
leaves them undefined.

{machine}.
'''


CLAIMS = '''
Whether there is less at all is judged by the rule below, with the claims as one table; whether it is as much as claimed by
the 95 % interval of the median, in brackets. Negative: more.
'''

RULE = '''
One rule gives every verdict. The paper's ratio is "more" above 1.05, "less" below 1 / 1.05, else "the same". Ours is the
median of the ratios on the maps, with its 95 % interval (order statistics). It is "the same" when the interval lies
within those bounds; it is "more" or "less" when the median lies beyond them, the interval does not hold 1 and the sign test
over the maps, corrected for all ratios of the table (Holm), gives p < 0.05; otherwise the verdict is *unclear*. *Agrees*:
both say the same. *Opposite*: one says more, the other less. *Differs*: one of them says the same, the other does not.

The last column is no explanation; it says what else was measured on the same maps: "with" quantities whose ratio
certainly goes the same way (interval beyond 1, median by more than 5 %), "although" those that certainly do not. × is the
median of that quantity's ratio.
'''

FACTORIAL = '''
All 32 combinations of the five improvements on each map. A main effect is the factor by which an improvement changes a
figure, in the geometric mean over the 16 combinations of the others; the table has its median over the maps and the 95 %
interval of that, bold where p < 0.05 (sign test, Holm over all effects on that figure). An interaction is the factor by which
one improvement changes the effect of another; those that are certain and above 5 % are listed.
'''

SENSITIVITY = '''
The same verdicts by the same rule with another radius of the disc, another weight, and other cells, on the same maps
(usual: disc 1.25 m, weight 1.5, cell 0.5 m). Listed are the ratios with two different certain verdicts; the median of ours
is in brackets. The wall times of loading and planning apart are left out here. – was not measured: of these variants only the
paths with disc 1.5 m and with weight 2 were driven.
'''


def fixed(runs):
    return f'''
One map each, [drawn](../benchmarks/paper/make_maps) with the size, start and slot that the paper gives. Of {runs} runs,
ours in bold, the paper's in brackets. The search is deterministic: other runs only time it again, and one map says
nothing of others. Lengths: the paper counts cells. The rows "Car" are this project's car model.
'''


UNREACHABLE = {'unreachable': 'A car stands at the destination (the paper\'s case)',
               'walled_in': 'The destination is free, but walls stand all round it',
               'too_tight': 'The destination is free, but every way there is narrower than the disc'}
UNREACHABLE_PAPER = {'Basic_A*': 'no path', 'Improved_A*': 'a path as near as possible'}
UNREACHABLE_TEXT = '''
A planner that refuses a destination within an obstacle looks at no more than the ends; the other two cases have to be
searched.
'''

SHORTCOMINGS = '''
## What this page does not show

The disc stands round the rear axle here. The spline is checked against the map and keeps to the car's turning radius, which
the paper's does not, and the drive is that of the approach, with this project's controller. [Another page](paper-run.md) takes
the paper at its word, to standstill in the slot. The paper's maps, from SurroundOcc, are not public; ours are drawn.
'''
