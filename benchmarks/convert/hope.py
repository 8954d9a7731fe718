"""Random parking problems like those of HOPE (M. Jiang and others, arXiv 2405.20579); equal seeds give equal problems.

The code is the project's own and uses the numbers that HOPE publishes (src/configs.py of github.com/jiamiya/HOPE). They
are the clearance round the car in its slot, the width of the aisle, the number of obstacles beyond it, and the start
poses. normal and complex have bays and parallel slots, extreme only parallel slots. HOPE's fourth level uses recordings
of the Dragon Lake lot, which this project may not distribute. dlp is a lot of that size (140 m by 80 m, about 400
bays), filled at random. The start is in an aisle up to 30 m away."""
import math
from dataclasses import dataclass

import numpy as np

from improved_astar import Error, Scenario, Vehicle

from .mersenne import Random
from .scenarios import scenario_of_polygons

LEAST_GAP = 0.1                                # metres: MIN_DIST_TO_OBST
TILT, MOST_TILT = math.pi / 36, math.pi / 12   # radians: standard deviation and maximum of the headings of parked cars
CAR_CHANCE = 0.7                               # probability of a car at each further place beside the slot
WALL_CHANCE = 0.2                              # probability that only a wall bounds the aisle
SPREAD = 0.5                                   # metres by which corners of loose obstacles are moved
TRIALS = 100000
CAR = Vehicle('tpcap', name='hope', rear_overhang=0.93, width=1.94)
CENTRE = 0.5 * CAR.length - CAR.rear_overhang  # metres from the rear axle forwards to the middle of the body


@dataclass(frozen=True)
class Level:
    """Sizes of a level in metres."""
    room: tuple       # along a parallel slot, beyond the car's length, minimum and maximum
    side: tuple       # across a bay, beyond its width; None: no bays
    aisles: tuple     # beside parallel slots, and bays
    obstacles: int


LEVELS = {
    'normal': Level((0.25 * CAR.length, 0.25 * CAR.length + 0.5), (0.85, 1.2), (4.5, 7.0), 3),
    'complex': Level((0.9, 0.25 * CAR.length), (0.4, 0.85), (4.0, 6.0), 5),
    'extreme': Level((0.6, 0.9), None, (3.5, None), 8),
    'dlp': None,
}


def scene(level, seed):
    """The scenario of this seed; level is one of LEVELS."""
    random = Random(seed)
    if level == 'dlp':
        polygons, start, goal = parking_lot(random)
    else:
        is_bay = LEVELS[level].side is not None and random.chance(0.5)
        slot = SlotScene(LEVELS[level], is_bay, random)
        drawn = (slot.draw() for _ in range(TRIALS))
        polygons, start, goal = next(each for each in drawn if each)
    return scenario_of_polygons(f'hope_{level}_{seed}', polygons, start, goal, CAR)


class SlotScene:
    """A slot on y = 0 and its neighbours, before its size is known."""

    def __init__(self, level, is_bay, random):
        self.level, self.is_bay, self.random = level, is_bay, random
        self.size = CAR.width if is_bay else CAR.length
        self.half = 15.0 if is_bay else 18.0
        self.least, self.most = level.side if is_bay else level.room
        self.goal = None

    def draw(self):
        """Obstacles, start and goal of one trial; None if HOPE would draw again."""
        self.goal = self.standing(0.0)
        left, right = self.fill(-1.0), self.fill(1.0)
        gaps = [surroundings(side[:1])(self.goal) for side in (left, right)]
        if min(gaps) < LEAST_GAP or not self.least <= sum(gaps) <= self.most:
            return None
        obstacles = [block(-self.half, -1.0, self.half, 0.0), *left, *right]
        edge = max(0.0, *(obstacle[:, 1].max() for obstacle in obstacles)) + LEAST_GAP
        aisle = self.level.aisles[self.is_bay]
        obstacles += self.far_side(edge + aisle)
        if surroundings(obstacles)(self.goal) <= 0.0:
            return None
        start = self.start_in(obstacles, edge, aisle)
        # Parallel: the car need not turn round.
        turned = not self.is_bay and math.cos(start[2]) < 0.0
        return obstacles, start, turned_round(self.goal) if turned else self.goal

    def standing(self, x):
        """A parked car round x, its end or side 0.1 to 0.9 m from the kerb."""
        yaw = (0.5 * math.pi if self.is_bay else 0.0) + self.random.normal(0.0, TILT, -MOST_TILT, MOST_TILT)
        low = min(0.0, CAR.footprint((x, 0.0, yaw))[:, 1].min())
        return x, self.random.normal(0.5, 0.2, LEAST_GAP, 0.9) - low, yaw

    def fill(self, side):
        """The neighbours on one side: a row of cars, or a block."""
        random = self.random
        nearest = random.between(0.2 * self.least, 0.8 * self.most)
        if random.chance(0.5):
            body = CAR.footprint(self.goal)
            end = max(0.0, (side * body[:, 0]).max())
            depth = body[:, 1].max() + random.between(-0.3, 0.3)
            # Its front leans by up to 15 degrees to either side.
            lean = math.tan(random.normal(0.0, TILT, -MOST_TILT, MOST_TILT)) * depth
            x0, x1 = side * (end + nearest), side * (end + nearest + abs(lean))
            low, high = (x0, x1) if lean > 0.0 else (x1, x0)
            return [np.array([(low, 0.0), (high, depth), (side * self.half, depth), (side * self.half, 0.0)])]
        x = side * (self.size + nearest)
        cars = [CAR.footprint(self.standing(x))]
        for _ in range(3 if self.is_bay else 2):
            x += side * (self.size + LEAST_GAP + random.between(0.2 * self.least, 0.8 * self.most))
            if random.chance(CAR_CHANCE):
                cars.append(CAR.footprint(self.standing(x)))
        return cars

    def far_side(self, y):
        """The objects across the aisle, at its end: a wall, or loose obstacles."""
        random = self.random
        if random.chance(WALL_CHANCE):
            return [block(-self.half, y + LEAST_GAP, self.half, y + LEAST_GAP + 0.1)]
        obstacles = []
        for _ in range(self.level.obstacles):
            loose = CAR.footprint((random.between(2.0 - self.half, self.half - 2.0), random.between(y + 2.0, y + 6.0),
                                   random.between(-math.pi, math.pi))).copy()
            for corner in loose:
                corner += [random.between(0.0, SPREAD) for _ in corner][::-1]
            if y < loose[:, 1].min() and loose[:, 1].max() < y + 8.0:
                obstacles.append(loose)
        return obstacles

    def start_in(self, obstacles, edge, aisle):
        random = self.random
        gap = surroundings([*obstacles, CAR.footprint(self.goal)])
        for _ in range(TRIALS):
            pose = (random.between(-0.5 * self.half, 0.5 * self.half), random.between(edge + 1.0, edge + aisle - 1.0),
                    random.normal(0.0, math.pi / 6, -0.5 * math.pi, 0.5 * math.pi) +
                    (math.pi if random.chance(0.5) else 0.0))
            if gap(pose) > 0.0:
                return pose
        raise Error('HOPE: no free start was found')


def parking_lot(random):
    """Four double rows of fifty bays per side, between aisles of 7 m: obstacles, start, goal."""
    width, depth, aisle, bays, rows = 2.8, 6.5, 7.0, 50, 8

    def standing(row, bay):
        up = -1.0 if row % 2 == 0 else 1.0  # to its aisle
        middle = aisle + row // 2 * (2.0 * depth + aisle) + (0.5 if row % 2 == 0 else 1.5) * depth
        yaw = up * 0.5 * math.pi + random.normal(0.0, 0.02, -0.06, 0.06)
        x = (bay + 0.5) * width + random.normal(0.0, 0.08, -0.2, 0.2)
        return x - CENTRE * math.cos(yaw), middle - CENTRE * math.sin(yaw), yaw

    place = random.below(rows), random.below(bays)
    parked = standing(*place)
    goal = parked if random.chance(0.5) else turned_round(parked)
    obstacles = []
    for row in range(rows):
        for bay in range(bays):
            if (row, bay) != place and random.chance(CAR_CHANCE):
                obstacles.append(CAR.footprint(standing(row, bay)))
    height = 4.0 * (2.0 * depth + aisle) + aisle
    obstacles += [block(-1.0, -1.0, bays * width + 1.0, 0.0), block(-1.0, height, bays * width + 1.0, height + 1.0)]
    gap = surroundings(obstacles, -40.0, bays * width + 40.0)
    for _ in range(TRIALS):
        up = random.below(5) * (2.0 * depth + aisle)
        start = (parked[0] + random.between(-30.0, 30.0), up + random.between(2.0, aisle - 2.0),
                 random.normal(0.0, 0.1, -0.3, 0.3) + (math.pi if random.chance(0.5) else 0.0))
        if abs(start[1] - parked[1]) <= 30.0 and gap(start) > 0.3:
            return obstacles, start, goal
    raise Error('HOPE: no free start was found')


def block(min_x, min_y, max_x, max_y):
    return np.array([(min_x, min_y), (max_x, min_y), (max_x, max_y), (min_x, max_y)])


def turned_round(pose):
    """The pose of the car in the opposite direction on the same ground."""
    x, y, yaw = pose
    return x + 2.0 * CENTRE * math.cos(yaw), y + 2.0 * CENTRE * math.sin(yaw), yaw + math.pi


def surroundings(obstacles, left=-20.0, right=20.0):
    """The function that returns the distance in metres between the car at a pose and these obstacles; 0 in contact.

    Poses are between left and right."""
    world = Scenario.from_polygons(obstacles, (left, 0.0, 0.0), (right, 0.0, 0.0), vehicle=CAR)
    return lambda pose: world.clearance_at([pose])[0]
