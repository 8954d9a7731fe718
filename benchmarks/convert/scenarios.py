"""Common parts of the formats of problems: scenarios of polygons, and maps as polygons."""
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from improved_astar import Error, Scenario

WALL = 1.0  # metres


@contextmanager
def errors_name(file):
    """Adds the name of the source file to errors about a scenario."""
    try:
        yield
    except Error as error:
        raise Error(f'{file}: {str(error).removeprefix("scenario: ")}') from None


def scenario_of_polygons(file, polygons, start, goal, vehicle):
    with errors_name(file):
        return Scenario.from_polygons(polygons, start, goal, vehicle=vehicle, name=Path(file).stem)


def obstacle_polygons(scenario):
    """The obstacles as arrays of corners: cells of a map merged into rectangles, with a wall round it."""
    if scenario.grid is None:
        return scenario.polygons
    occupied = scenario.grid == 1
    if scenario.unknown_is_occupied:
        occupied |= scenario.grid == 2
    rows, columns = occupied.shape
    size = scenario.resolution
    boxes = [tuple(size * edge for edge in rectangle) for rectangle in merged_cells(occupied)]
    right, top = size * columns, size * rows
    boxes += [(-WALL, -WALL, right + WALL, 0.0), (-WALL, top, right + WALL, top + WALL),
              (-WALL, 0.0, 0.0, top), (right, 0.0, right + WALL, top)]
    x, y, yaw = scenario.origin
    cos, sin = np.cos(yaw), np.sin(yaw)
    polygons = []
    for low_x, low_y, high_x, high_y in boxes:
        corners = np.array([(low_x, low_y), (high_x, low_y), (high_x, high_y), (low_x, high_y)])
        polygons.append(corners @ [[cos, sin], [-sin, cos]] + [x, y])
    return polygons


def merged_cells(occupied):
    """Occupied cells as few rectangles: runs along each row, joined with the equal run of the row below.

    Each is (first column, first row, column after the last, row after the last)."""
    rectangles, open_runs = [], {}  # (first column, column after the last): first row
    for row, cells in enumerate(occupied):
        edges = np.flatnonzero(np.diff(cells, prepend=False, append=False)).reshape(-1, 2)
        runs = {tuple(map(int, run)): row for run in edges}
        for (begin, end), first in open_runs.items():
            if (begin, end) in runs:
                runs[begin, end] = first
            else:
                rectangles.append((begin, first, end, row))
        open_runs = runs
    return rectangles + [(begin, first, end, len(occupied)) for (begin, end), first in open_runs.items()]
