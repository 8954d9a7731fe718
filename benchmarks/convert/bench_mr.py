"""Scenes of Bench-MR (github.com/robot-motion/bench-mr, bin/polygon_mazes): SVG of Inkscape, one user unit per metre.

As in Bench-MR's reader, the translation of the last group applies, y points up, and an obstacle is the convex hull of
its corners. Its poses refer to the middle of the body, round which the car turns: a car with its rear axle there. Start
and goal are not in the scenes: they are options, or the project's own attributes data-start and data-goal."""
import math
import re
from xml.etree import ElementTree

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from improved_astar import Error, Vehicle

from .scenarios import obstacle_polygons, scenario_of_polygons
from .text import NUMBER, numbers, pose_of, quoted

BODY_LENGTH, BODY_WIDTH = 4.253328, 2.433862  # metres, of bin/polygon_mazes/car.svg
WHEELBASE, TURNING_RADIUS = 2.0, 4.0          # metres; the radius is that of experiments/parking.cpp
TOKEN = re.compile(rf'[\s,]*({NUMBER.pattern}|[A-Za-z]|\S.*)', re.DOTALL)


def bench_mr_car():
    return Vehicle('tpcap', name='bench_mr', wheelbase=WHEELBASE, rear_overhang=0.5 * BODY_LENGTH,
                   front_overhang=0.5 * BODY_LENGTH - WHEELBASE, width=BODY_WIDTH,
                   max_steering_angle=math.atan(WHEELBASE / TURNING_RADIUS))


def read(file, content, vehicle, start, goal):
    try:
        root = ElementTree.fromstring(content)
    except ElementTree.ParseError as error:
        raise Error(f'{file}: is not a complete SVG: {error}') from None
    shift, polygons = np.zeros(2), []
    try:
        for element in root.iter():
            if 'transform' in element.attrib:
                shift = translation(element.get('transform'))
            if 'd' in element.attrib:
                corners = (corners_of(element.get('d')) + shift) * [1.0, -1.0]
                polygons.append(convex_hull(corners, f'obstacle {len(polygons) + 1}'))
        start = start or attribute_pose(root, 'data-start')
        goal = goal or attribute_pose(root, 'data-goal')
    except Error as error:
        raise Error(f'{file}: {error}') from None
    if not polygons:
        raise Error(f'{file}: contains no path and thus no obstacle')
    if not start or not goal:
        missing = 'no goal' if start else 'no start' if goal else 'neither start nor goal'
        options = ' and '.join(f'--{name} X,Y,YAW' for name, pose in (('start', start), ('goal', goal)) if not pose)
        raise Error(f'{file}: a scene of Bench-MR has {missing}; give {options} '
                    f'(of the middle of the {"rear axle" if vehicle else "body"})')
    return scenario_of_polygons(file, polygons, start, goal, vehicle or bench_mr_car())


def translation(text):
    found = re.match(rf'translate\(\s*({NUMBER.pattern})[\s,]+({NUMBER.pattern})\s*\)', text)
    if not found:
        raise Error(f'{quoted(text)} is not understood; groups are translated only')
    return np.array([float(each) for each in found.groups()])


def attribute_pose(element, attribute):
    """The pose in an attribute; None without the attribute."""
    text = element.get(attribute)
    pose = None if text is None else pose_of(text)
    if text is not None and pose is None:
        raise Error(f'{attribute} must be x, y and yaw, not {quoted(text)}')
    return pose


def corners_of(text):
    """The corners of a path of straight lines, from the commands of its attribute d."""
    tokens = [token.group(1) for token in TOKEN.finditer(text)]
    corners, at, command, place = [], np.zeros(2), None, 0

    def take_number():
        nonlocal place
        place += 1
        if place > len(tokens) or not NUMBER.fullmatch(tokens[place - 1]):
            raise Error(f'no number at {quoted("".join(tokens[place - 1:place]), 20)} in a path')
        return float(tokens[place - 1])

    while place < len(tokens):
        if tokens[place].isalpha() and len(tokens[place]) == 1:
            command = tokens[place]
            place += 1
        elif command in (None, 'z', 'Z'):
            raise Error(f'a path begins with {quoted(tokens[place], 20)}; it must begin with m or M')
        if command in ('z', 'Z'):
            continue
        if command not in tuple('mMlLhHvV'):
            raise Error(f'the command {quoted(command)} of a path is not understood; '
                        'obstacles are made of straight lines (m l h v z)')
        for axis in {'h': [0], 'v': [1]}.get(command.lower(), [0, 1]):
            at[axis] = take_number() + (at[axis] if command.islower() else 0.0)
        corners.append(at.copy())
        command = {'m': 'l', 'M': 'L'}.get(command, command)  # further pairs after a move are lines
    return np.array(corners).reshape(-1, 2)


def convex_hull(corners, what):
    """Counter-clockwise, from the corner farthest to the left."""
    try:
        hull = corners[ConvexHull(corners).vertices]
    except (QhullError, ValueError):
        raise Error(f'{what} has no area') from None
    return np.roll(hull, -np.lexsort((hull[:, 1], hull[:, 0]))[0], axis=0)


def svg_text(scenario, _file):
    """One attribute per line, as Bench-MR's reader requires."""
    polygons = obstacle_polygons(scenario)
    low = high = np.zeros(2)
    if polygons:
        corners = np.vstack(polygons)
        low, high = corners.min(axis=0), corners.max(axis=0)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<svg xmlns="http://www.w3.org/2000/svg"',
             f'   viewBox="{numbers((low[0], -high[1], *(high - low)), " ")}"',
             f'   data-start="{numbers(scenario.start, " ")}"', f'   data-goal="{numbers(scenario.goals[0], " ")}">',
             '  <g', '     transform="translate(0,0)">']
    for polygon in polygons:
        corners = ' L '.join(numbers(corner, ',') for corner in polygon * [1.0, -1.0])
        lines += ['    <path', f'       d="M {corners} z"', '       style="fill:#c7c7c7" />']
    return '\n'.join(lines + ['  </g>', '</svg>']) + '\n'
