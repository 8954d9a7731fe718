"""Scenes of ParkBench (github.com/dqm5rtfg9b-collab/Constrained_Parking_Scenarios; F. Tao and others, arXiv 2601.22545).

As in its reader (utils.py), the poses of the planning request move from its origin to that of the obstacles, and each
obstacle is a polyline. Its segments become obstacles without width. Poses are of the rear axle's middle; the scenes have
no car.

The slots contain wheel stops, over which the parked car stands. ParkBench samples the obstacles every 0.1 m and leaves
out the points under the car at its goal. Here a segment under the car ends 0.1 m away from it. Obstacles far away are
outliers of the recording, by ParkBench's README; they would make the world up to 17 km wide."""
import math

from improved_astar import Vehicle

from .results import json_field
from .scenarios import errors_name, scenario_of_polygons

SPACING = 0.1  # metres
FAR = 100.0    # metres from the start, along x or y


def is_scene(content):
    return content.lstrip().startswith(b'{') and b'"NfmAggregatedPolygonObjects"' in content


def read(file, content, vehicle, start, goal):
    car = vehicle or Vehicle('tpcap')
    with errors_name(file):
        frame = json_field(content, 'a scene of ParkBench').member('Frames').member('0')
        request = frame.member('PlanningRequest')
        shift = [a - b for a, b in zip(origin_of(request, 'm_origin'), origin_of(frame, 'm_nfmOrigin'))]
        start = start or pose_of(request.member('m_startPosture'), shift)
        goal = goal or pose_of(target_of(request), shift)
        segments = []
        for each in frame.member('NfmAggregatedPolygonObjects').entries():
            nodes = each.member('nfmPolygonObjectNodes')
            corners = [node.numbers('m_x', 'm_y') for node in nodes.entries()]
            if len(corners) < 2:
                nodes.fail('a list of two or more nodes')
            for pair in zip(corners, corners[1:]):
                segments += [] if is_far(pair, start) else parts_beside(pair, goal, car)
    return scenario_of_polygons(file, segments, start, goal, car)


def origin_of(field, name):
    return values_of(field.member(name), 2) if field.has(name) else (0.0, 0.0)


def target_of(request):
    if not request.has('m_targetAreas'):
        return request.member('m_targetArea').member('m_targetPosture')
    targets = request.member('m_targetAreas').member('m_targetPosture')
    if not targets.entries():
        targets.fail('a list of targets')
    return targets.entries()[0]


def pose_of(posture, shift):
    x, y, yaw = values_of(posture.member('m_pose'), 3)
    return x + shift[0], y + shift[1], yaw


def values_of(field, count):
    values = tuple(each.number() for each in field.entries())
    if len(values) != count:
        field.fail(f'a list of {count} numbers')
    return values


def is_far(segment, start):
    return any(max(ends) < middle - FAR or min(ends) > middle + FAR for middle, *ends in zip(start, *segment))


def parts_beside(segment, goal, car):
    """The segment, or its parts beside the car if it runs under the car at its goal."""
    cos, sin = math.cos(goal[2]), math.sin(goal[2])
    local = [(cos * (x - goal[0]) + sin * (y - goal[1]), cos * (y - goal[1]) - sin * (x - goal[0])) for x, y in segment]
    if not share_under(local, car, 0.0):
        return [segment]
    enter, leave = share_under(local, car, SPACING)
    (x0, y0), (x1, y1) = segment
    shares = [(0.0, enter)] * (enter > 0.0) + [(leave, 1.0)] * (leave < 1.0)
    return [[(x0 + share * (x1 - x0), y0 + share * (y1 - y0)) for share in pair] for pair in shares]


def share_under(segment, car, margin):
    """The shares of the segment's length at which it enters and leaves the body at (0, 0, 0); None if it stays beside."""
    half = 0.5 * car.width + margin
    limits = (-car.rear_overhang - margin, car.wheelbase + car.front_overhang + margin), (-half, half)
    enter, leave = 0.0, 1.0
    for begin, end, (low, high) in zip(*segment, limits):
        if begin == end:
            if not low <= begin <= high:
                return None
            continue
        first, last = sorted((limit - begin) / (end - begin) for limit in (low, high))
        enter, leave = max(enter, first), min(leave, last)
    return (enter, leave) if enter <= leave else None
