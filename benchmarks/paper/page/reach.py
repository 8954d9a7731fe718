"""How near to its goal a disc can come at all: every cell that it gets to, looked at one by one."""
import collections
import math

from figures import pose_in, read_pgm

CELL, FREE = 0.5, 254


def nearest_reachable(scenario_file, radius):
    """Metres between the goal and the nearest cell's middle that a disc gets to from the start over eight neighbours.

    The cells are those of the map, whose middle is at 0, 0; the start is in the middle of one."""
    start, goal = (pose_in(scenario_file, key) for key in ('start', 'goal'))
    width, height, rows = read_pgm(scenario_file.removesuffix('.yaml') + '.pgm')
    rows = rows[::-1]
    reach = math.ceil(radius / CELL)
    near = [(i, j) for i in range(-reach, reach + 1) for j in range(-reach, reach + 1)
            if math.hypot(max(0.0, abs(i) - 0.5), max(0.0, abs(j) - 0.5)) * CELL <= radius]

    def is_free(column, row):
        return all(0 <= column + i < width and 0 <= row + j < height and rows[row + j][column + i] == FREE for i, j in near)

    def away(column, row):
        return math.hypot((column + 0.5 - 0.5 * width) * CELL - goal[0], (row + 0.5 - 0.5 * height) * CELL - goal[1])
    first = int(start[0] / CELL + 0.5 * width), int(start[1] / CELL + 0.5 * height)
    waiting, known, best = collections.deque([first]), {first}, away(*first)
    while waiting:
        column, row = waiting.popleft()
        best = min(best, away(column, row))
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                other = column + i, row + j
                if other not in known:
                    known.add(other)
                    if is_free(*other):
                        waiting.append(other)
    return best
