"""What docs/general.md says round its figures."""


def cpu_name(text_of_cpu):
    """The model, from the output of lscpu."""
    fields = dict(line.split(':', 1) for line in text_of_cpu.splitlines() if ':' in line)
    return ' '.join(fields.get('Model name', 'processor not known').split())


PAGE = """# Queries that nothing was tuned on

The bundled problems are what the planner's constants were chosen on. What it is worth elsewhere shows on random queries:
worlds that a generator makes, and in each of them starts and goals that are free, every other goal pushed against an
obstacle. This page is written by `benchmarks/report/general_page` from such a comparison, failures first.

## What falls short

{failures}

## Distribution

{count} queries in {worlds} worlds (seed `{seed}`, {margin:g} m of room at start and goal), one run of each planner on each,
up to {limit:g} s of processor time. Times and lengths are of what a planner solved, which for some are the easy ones.

{table}

![Share of the queries that each planner has solved, over processor time](images/general_solved.svg)

![Share of the queries that each planner solves with a path of at most some length over the shortest that any of them
found](images/general_lengths.svg)

By kind of world, with the median time over all queries of that kind (∞: more than half of them unsolved):

{kinds}

`hybrid_astar` is this project's core with its own additions switched off. PRM works with two threads and pays for both.
`improved_astar` and `hybrid_astar` stop at their first solution; BIT\\* goes on to the end, and the length is that of its
last one.

## How to repeat it

```sh
parking_queries --output queries --seed {seed}{draw}
parking_benchmark benchmarks/general.cfg --scenarios queries --output results-general{run}
benchmarks/report/general_page results-general queries --output page/general.md
```

Without `--output` the last one writes this page and its pictures anew, docs/general.md.

Nobody has to believe in our worlds, or in this seed:

```sh
parking_queries --output mine --seed whatever --kind streets --kind clutter --worlds 5 --margin 0.1
parking_queries --output there --from FOLDER     # maps and scenarios of a folder
parking_plan mine/streets_3_2.yaml --svg path.svg
```

Equal seeds give equal files on every machine; a world does not depend on which others are drawn. `index.json` says what was
drawn. The kinds: `parked_rows` (aisles between rows of parked cars), `streets` (blocks of houses, cars along the kerbs, yards),
`multi_storey` (decks with a ring of lanes, and narrow ramps from each to the next), `clutter` (posts, boxes, debris), `shapes`
(large polygons of any form), `large_lot` (hundreds of cars on up to 250 m), `angled_lot` (slots askew to one-way aisles that
are too narrow to turn round in), `careless_lot` (cars across the lines, and some in the aisles), `maze` (lanes between walls,
with dead ends). Each world has one of the known cars, or the one of `--vehicle`.

Times are processor times (`clock = processor`), so that a machine that does other things as well does not count against the
planners. The machine was shared when this was measured.

{machine}
"""
