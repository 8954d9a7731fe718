"""The formats of the whole project: YAML scenarios and TPCAP cases. The library reads both."""
import numpy
from improved_astar import Scenario

from .scenarios import errors_name, obstacle_polygons
from .text import number, numbers, one_line

VEHICLE_FIELDS = ('wheelbase', 'front_overhang', 'rear_overhang', 'width', 'max_steering_angle', 'max_speed',
                  'max_acceleration', 'max_steering_rate')


def read(file, content, vehicle, start, goal):
    scenario = Scenario.read(file, vehicle, text=content)
    if start is None and goal is None:
        return scenario
    with errors_name(file):
        return scenario.replace(start=start, goal=goal)


def yaml_text(scenario, _file):
    vehicle = scenario.vehicle
    fields = [f"name: '{one_line(vehicle.name)}'"]
    fields += [f'{name}: {number(getattr(vehicle, name))}' for name in VEHICLE_FIELDS]
    if len(vehicle.outline) > 0:
        fields.append('outline: [' + ', '.join(f'[{numbers(corner)}]' for corner in vehicle.outline) + ']')
    lines = [f'vehicle: {{{", ".join(fields)}}}', f'start: [{numbers(scenario.start)}]',
             f'goal: [{numbers(scenario.goals[0])}]']
    polygons = obstacle_polygons(scenario)
    lines.append('polygons:' if polygons else 'polygons: []')
    for polygon in polygons:
        lines.append('  - [' + ', '.join(f'[{numbers(corner)}]' for corner in polygon) + ']')
    return '\n'.join(lines) + '\n'


def tpcap_text(scenario, _file):
    # A case has no points and segments: their last corner is written again.
    polygons = [numpy.vstack([polygon, *[polygon[-1:]] * (3 - len(polygon))]) for polygon in obstacle_polygons(scenario)]
    values = [*scenario.start, *scenario.goals[0], len(polygons), *map(len, polygons)]
    for polygon in polygons:
        values += polygon.ravel().tolist()
    return numbers(values, ',') + '\n'
