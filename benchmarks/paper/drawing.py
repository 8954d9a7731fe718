"""Draws maps of parking problems and writes them: cars, walls, grids, and what a lidar sees of them.

Parked cars have the sizes of real cars. Everything random comes from the generator that the caller seeds, so that the
same bytes are written everywhere. Lengths in metres, poses are of the middle of the rear axle, yaw in radians
counter-clockwise from +x.
"""
import math

# length, width, wheelbase; sources in parking_geometry/VehicleCatalogue.cpp, whose rule for overhangs is used here too.
CARS = {
    'vw_golf8': (4.284, 1.789, 2.636),
    'bmw_3_g20': (4.709, 1.827, 2.851),
    'tesla_model3': (4.694, 1.849, 2.875),
    'mercedes_s_w223': (5.179, 1.954, 3.106),
    'toyota_yaris': (4.105, 1.694, 2.57),
    'toyota_corolla': (4.495, 1.745, 2.64),
    'smart_fortwo': (2.695, 1.663, 1.873),
    'vw_vanagon': (4.569, 1.844, 2.4719),
}
COMMON_CARS = ['vw_golf8', 'bmw_3_g20', 'tesla_model3', 'toyota_yaris', 'toyota_corolla', 'vw_vanagon']
FRONT_SHARE = 0.48

# Outline of a car in parts of its length (forwards) and width (to the left): rounded at the bumpers.
CAR_SHAPE = [(0.5, -0.30), (0.5, 0.30), (0.475, 0.43), (0.42, 0.5), (-0.44, 0.5), (-0.485, 0.44), (-0.5, 0.34),
             (-0.5, -0.34), (-0.485, -0.44), (-0.44, -0.5), (0.42, -0.5), (0.475, -0.43)]

def place(pose, points):
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return [(pose[0] + c * x - s * y, pose[1] + s * x + c * y) for x, y in points]


class Obstacle:
    def __init__(self, points, what):
        self.points = [(round(x, 3) + 0.0, round(y, 3) + 0.0) for x, y in points]
        self.what = what


def car(name, x, y, yaw):
    """A parked car with the middle of its body at x, y."""
    length, width = CARS[name][:2]
    return Obstacle(place((x, y, yaw), [(a * length, b * width) for a, b in CAR_SHAPE]), name)


def box(x0, y0, x1, y1, what):
    return Obstacle([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], what)


def rear_axle(name, x, y, yaw):
    """Pose of the rear axle of a car whose body has its middle at x, y."""
    length, _, wheelbase = CARS[name]
    back = 0.5 * length - (1 - FRONT_SHARE) * (length - wheelbase)
    return (x - back * math.cos(yaw), y - back * math.sin(yaw), yaw)


def parked(rng, x, y, yaw, either_way=True, careful=1.0):
    """Some car, parked as people do: a little off the middle, a little askew, nose first or last."""
    name = COMMON_CARS[int(rng.random() * len(COMMON_CARS))]
    if either_way and rng.random() < 0.4:
        yaw += math.pi
    along, across, turn = (2 * rng.random() - 1 for _ in range(3))
    dx, dy = 0.12 * along * careful, 0.1 * across * careful
    return car(name, x + dx * math.cos(yaw) - dy * math.sin(yaw), y + dx * math.sin(yaw) + dy * math.cos(yaw),
               yaw + math.radians(1.5) * turn * careful)


def number(value, digits=4):
    text = f'{value:.{digits}f}'.rstrip('0').rstrip('.')
    return '0' if text == '-0' else text


def numbers(values):
    """A point or a pose, whose yaw is written finely: at the end of a car 1e-4 rad are half a millimetre."""
    return '[' + ', '.join(number(v, 9 if i == 2 else 4) for i, v in enumerate(values)) + ']'


def scenario_text(about, vehicle, start, map_file, goal=None, slot=None):
    lines = ['# ' + line for line in about.strip().split('\n')]
    lines += [f'vehicle: {vehicle}', f'start: {numbers(start)}']
    if goal:
        lines.append(f'goal: {numbers(goal)}')
    if slot:
        lines.append('slot:')
        lines += [f'  {key}: {numbers(value) if isinstance(value, tuple) else number(value) if isinstance(value, float) else value}'
                  for key, value in slot.items()]
    lines.append(f'map: {map_file}')
    return ('\n'.join(lines) + '\n').encode()


FREE, OCCUPIED, UNKNOWN = 254, 0, 205  # as map_saver writes them


class Grid:
    def __init__(self, width, height, resolution, fill):
        self.width, self.height, self.resolution = width, height, resolution
        self.rows = [bytearray([fill]) * width for _ in range(height)]

    def cells_of(self, points):
        """Cells that share some area with a convex polygon (separating axes)."""
        r = self.resolution
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        normals = []
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
            nx, ny = by - ay, ax - bx
            side = [nx * x + ny * y for x, y in points]
            normals.append((nx, ny, min(side), max(side), 0.5 * r * (abs(nx) + abs(ny))))
        for row in range(max(0, int(min(ys) / r) - 1), min(self.height, int(max(ys) / r) + 2)):
            for column in range(max(0, int(min(xs) / r) - 1), min(self.width, int(max(xs) / r) + 2)):
                x, y = (column + 0.5) * r, (row + 0.5) * r
                if x + 0.5 * r <= min(xs) + 1e-9 or x - 0.5 * r >= max(xs) - 1e-9:
                    continue
                if y + 0.5 * r <= min(ys) + 1e-9 or y - 0.5 * r >= max(ys) - 1e-9:
                    continue
                if all(nx * x + ny * y + e > low + 1e-9 and nx * x + ny * y - e < high - 1e-9
                       for nx, ny, low, high, e in normals):
                    yield column, row

    def draw(self, points, value):
        for column, row in self.cells_of(points):
            self.rows[row][column] = value

    def pgm(self):
        head = f'P5\n{self.width} {self.height}\n255\n'.encode()
        return head + b''.join(bytes(row) for row in reversed(self.rows))


def look_round(rng, seen, truth, solid, sensor, rays=3600, step=0.1):
    """Adds to a map what a lidar on a car's roof sees: along every ray the ground up to the first thing that stands on
    it, thinner with distance as its rings spread."""
    cell = seen.resolution
    for k in range(rays):
        dx, dy = math.cos(2 * math.pi * k / rays), math.sin(2 * math.pi * k / rays)
        for n in range(int(0.4 / step), int(48.0 / step)):
            distance = step * n
            column, row = int((sensor[0] + distance * dx) / cell), int((sensor[1] + distance * dy) / cell)
            if not (0 <= column < seen.width and 0 <= row < seen.height):
                break
            if solid.rows[row][column] == OCCUPIED:
                seen.rows[row][column] = OCCUPIED
                break
            if rng.random() < min(1.0, 0.5 / max(1.0, distance - 4.0)):
                seen.rows[row][column] = truth.rows[row][column]


def close_gaps(seen, passes=3):
    """Gaps between the lidar's rings are closed, as usual for such maps."""
    for _ in range(passes):
        before = [bytes(row) for row in seen.rows]
        for row in range(1, seen.height - 1):
            for column in range(1, seen.width - 1):
                if before[row][column] == UNKNOWN:
                    near = [before[row + i][column + j] for i in (-1, 0, 1) for j in (-1, 0, 1)]
                    if near.count(FREE) >= 5:
                        seen.rows[row][column] = FREE
