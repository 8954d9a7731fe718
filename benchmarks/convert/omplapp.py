"""Configurations of OMPL.app's ompl_benchmark for rigid bodies and cars in the plane (github.com/ompl/omplapp,
resources/2D), with the COLLADA meshes of `world` and `robot` beside them.

As in OMPL.app, the world is the projection of all triangles on the plane, and poses refer to the mean vertex of the robot.
The car is the rectangle round the robot with its rear axle at that point, round which OMPL.app's curves turn the robot."""
import configparser
import math
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from improved_astar import Error, Vehicle
from improved_astar._core import _read_file as read_file

from .scenarios import scenario_of_polygons
from .text import quoted

LARGEST = 64 << 20      # maximum bytes of a mesh
DIGITS = 6              # of metres; corners that agree so far are the same
TURNING_RADIUS = 1.0    # metres, of SE2Benchmark::configure()
KINEMATIC_CAR_RADIUS = 1.0 / math.tan(math.radians(30.0))  # KinematicCarPlanning: length 1, 30 degrees
WALL = 1.0              # metres
DEEPEST = 50            # nodes within each other; more are a cycle


def recognizes(content):
    return re.search(rb'^\s*\[problem\]', content, re.MULTILINE) is not None and \
        re.search(rb'^\s*world\s*=', content, re.MULTILINE) is not None


def read(file, content, vehicle, start, goal):
    problem = problem_of(file, content)
    triangles, _ = mesh_of(file, problem, 'world')
    car = vehicle or car_of(file, problem)
    polygons = projected(triangles) + frame_of(file, problem, math.hypot(car.length, car.width))
    return scenario_of_polygons(file, polygons, start or pose_of(file, problem, 'start'),
                                goal or pose_of(file, problem, 'goal'), car)


def problem_of(file, content):
    parser = configparser.ConfigParser(interpolation=None, strict=False, inline_comment_prefixes=('#',))
    try:
        parser.read_string(content.decode('utf-8', 'replace'))
        problem = parser['problem']
    except configparser.Error as error:
        raise Error(f'{file}: {error}') from None
    for key in problem:
        if key.endswith('.z') or '.axis.' in key:
            raise Error(f'{file}: {key} belongs to a problem in three dimensions; only those in the plane are supported')
    return problem


def number_of(file, problem, key):
    try:
        value = float(problem[key])
    except KeyError:
        raise Error(f'{file}: [problem] has no {key}') from None
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise Error(f'{file}: {key} must be a number, not {quoted(problem[key])}')
    return value


def pose_of(file, problem, name):
    return tuple(number_of(file, problem, f'{name}.{axis}') for axis in ('x', 'y', 'theta'))


def mesh_file(folder, name):
    """The mesh beside the file, or in the resources of OMPL.app, whose programs search both."""
    folders = [folder, folder / 'resources', folder.parent / 'resources']
    return next((each / name for each in folders if (each / name).exists()), folder / name)


def mesh_of(file, problem, key):
    """The triangles of a mesh as an array of n x 3 corners (x, y), and its mean vertex."""
    if key not in problem:
        raise Error(f'{file}: [problem] has no {key}')
    name = str(mesh_file(Path(file).parent, problem[key]))
    content = read_file(name, LARGEST)
    try:
        triangles, vertices = Mesh(ElementTree.fromstring(content)).projection()
    except (ElementTree.ParseError, ArithmeticError, AttributeError, LookupError, RuntimeError, TypeError, ValueError) as error:
        raise Error(f'{name}: is not a mesh of triangles in COLLADA: {error}') from None
    if not len(triangles):
        raise Error(f'{name}: contains no triangles')
    return triangles, vertices.mean(axis=0)


class Mesh:
    """A document in COLLADA 1.4, as far as OMPL.app's meshes use it."""

    def __init__(self, root):
        self.space = root.tag[:root.tag.index('}') + 1]  # of all names
        self.by_id = {element.get('id'): element for element in root.iter() if element.get('id')}
        self.root = root

    def projection(self):
        """Triangles and vertices in the plane."""
        parts = [part for scene in self.root.iter(self.space + 'visual_scene') for part in self.of_node(scene, np.eye(4), 0)]
        # Assimp turns z up into y up, and OMPL.app then drops z.
        up = self.root.findtext(f'{self.space}asset/{self.space}up_axis', 'Y_UP').strip()
        axes = [0, 2] if up == 'Z_UP' else [0, 1]
        return (np.concatenate([np.empty((0, 3, 3)), *(corners for corners, _ in parts)])[:, :, axes],
                np.concatenate([np.empty((0, 3)), *(vertices for _, vertices in parts)])[:, axes])

    def of_node(self, node, transform, depth):
        if depth > DEEPEST:
            raise ValueError('its nodes contain themselves')
        for matrix in node.findall(self.space + 'matrix'):
            transform = transform @ np.array(matrix.text.split(), float).reshape(4, 4)
        if any(node.find(self.space + each) is not None for each in ('translate', 'rotate', 'scale')):
            raise ValueError('only transformations by a matrix are supported')
        found = []
        for each in node.findall(self.space + 'instance_geometry'):
            for part in self.of_geometry(self.by_id[each.get('url')[1:]]):
                found.append([points @ transform[:3, :3].T + transform[:3, 3] for points in part])
        inner = node.findall(self.space + 'node')
        inner += [self.by_id[each.get('url')[1:]] for each in node.findall(self.space + 'instance_node')]
        for each in inner:
            found += self.of_node(each, transform, depth + 1)
        return found

    def of_geometry(self, geometry):
        for triangles in geometry.iter(self.space + 'triangles'):
            inputs = triangles.findall(self.space + 'input')
            stride = 1 + max(int(each.get('offset')) for each in inputs)
            vertex = next(each for each in inputs if each.get('semantic') == 'VERTEX')
            source = next(each for each in self.by_id[vertex.get('source')[1:]] if each.get('semantic') == 'POSITION')
            array = self.by_id[source.get('source')[1:]].find(self.space + 'float_array')
            points = np.array(array.text.split(), float).reshape(-1, 3)
            indices = np.array(triangles.findtext(self.space + 'p').split(), int)
            corners = indices.reshape(-1, stride)[:, int(vertex.get('offset'))]
            yield points[corners].reshape(-1, 3, 3), points[np.unique(corners)]


def projected(triangles):
    """Distinct triangles, and the segments that upright triangles become unless they are an edge of another one."""
    rounded = np.round(triangles, DIGITS) + 0.0
    solid, edges, segments = {}, set(), set()
    for corners in rounded.tolist():
        a, b, c = sorted(map(tuple, corners))
        if abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) > 10.0 ** -DIGITS:
            solid[a, b, c] = None
            edges |= {(a, b), (b, c), (a, c)}
        elif a != c:
            segments.add((a, c))
    return [np.array(corners) for corners in [*solid, *sorted(segments - edges)]]


def car_of(file, problem):
    triangles, middle = mesh_of(file, problem, 'robot')
    low, high = triangles.min(axis=(0, 1)) - middle, triangles.max(axis=(0, 1)) - middle
    wheelbase = 0.5 * high[0]
    radius = KINEMATIC_CAR_RADIUS if 'control' in problem else TURNING_RADIUS
    if 'turningradius' in problem:
        radius = number_of(file, problem, 'turningradius')
        if radius <= 0.0:
            raise Error(f'{file}: turningradius must be positive')
    return Vehicle('tpcap', name=Path(problem['robot']).stem, wheelbase=wheelbase, rear_overhang=-low[0],
                   front_overhang=high[0] - wheelbase, width=2.0 * max(high[1], -low[1]),
                   max_steering_angle=math.atan(wheelbase / radius))


def frame_of(file, problem, distance):
    """Walls at a distance round the volume of the reference point; none without a volume."""
    if 'volume.min.x' not in problem:
        return []
    low_x, low_y, high_x, high_y = (number_of(file, problem, f'volume.{end}.{axis}') + sign * distance
                                    for end, sign in (('min', -1.0), ('max', 1.0)) for axis in ('x', 'y'))
    boxes = [(low_x - WALL, low_y, low_x, high_y), (high_x, low_y, high_x + WALL, high_y),
             (low_x, low_y - WALL, high_x, low_y), (low_x, high_y, high_x, high_y + WALL)]
    return [np.array([(left, bottom), (right, bottom), (right, top), (left, top)]) for left, bottom, right, top in boxes]
