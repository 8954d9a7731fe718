#!/usr/bin/env python3
"""Parking from Python, step by step, with pictures.

usage: tutorial.py [FOLDER]    (for pictures and pages; default: tutorial)

Needs the package improved_astar and, for the pictures, matplotlib.
"""
import math
import os
import sys

import numpy

import improved_astar as ia

folder = sys.argv[1] if len(sys.argv) > 1 else 'tutorial'
os.makedirs(folder, exist_ok=True)


def file(name):
    return os.path.join(folder, name)


def picture(result, name):
    try:
        result.plot(file(name))
    except ImportError:
        print('  (no pictures: matplotlib is not installed)')


print('1. A slot between two cars')
# Poses are (x, y, yaw) of the middle of the rear axle; +x of this slot points out of it, to the aisle.
slot = ia.Slot('perpendicular', pose=(0, -2.5, math.pi / 2), length=5, width=2.5)
neighbours = [[[-3.4, -4.8], [-1.5, -4.8], [-1.5, -0.4], [-3.4, -0.4]],
              [[1.5, -4.8], [3.4, -4.8], [3.4, -0.4], [1.5, -0.4]]]
wall = [[-15, 6], [15, 6], [15, 7], [-15, 7]]
scenario = ia.Scenario.from_polygons(neighbours + [wall], start=(-8, 1.7, 0), slot=slot, vehicle='vw_golf8')
result = ia.plan(scenario)
print(f'  {result.status}: {result.length:.2f} m, {result.cusps} changes of direction, '
      f'{100 * result.clearance:.0f} cm of clearance, {1e3 * result.statistics["planning_time"]:.1f} ms')
picture(result, '1-slot.png')
assert result

print('2. An independent check')
verdict = ia.check(scenario, result.path)
print(f'  {verdict}: {verdict.states} poses, sharpest curve {1 / verdict.max_curvature:.2f} m')
straight = numpy.array([[x, 1.7, 0.0] for x in numpy.linspace(-8, 8, 100)])
print(f'  straight ahead: {ia.check(scenario, straight)}')
assert verdict

print('3. How quickly can it be driven?')
drive = result.trajectory
print(f'  {result.duration:.1f} s, at most {numpy.abs(drive[:, 4]).max():.2f} m/s and '
      f'{math.degrees(numpy.abs(drive[:, 6]).max()):.0f} degrees of steering')
result.animate('Parking a Golf').save(file('3-drive.html'))

print('4. The penalty of a change of direction')
narrow = ia.Slot('parallel', pose=(0, -1.2, 0), length=5.2, width=2.4)
cars = [[[-7, -2.1], [-2.7, -2.1], [-2.7, -0.3], [-7, -0.3]], [[2.7, -2.1], [7, -2.1], [7, -0.3], [2.7, -0.3]],
        [[-15, -3.4], [15, -3.4], [15, -2.4], [-15, -2.4]]]
street = ia.Scenario.from_polygons(cars, start=(-6, 1.5, 0), slot=narrow, vehicle='vw_golf8', name='street')
for penalty in (0.0, 0.5, 5.0):
    each = ia.plan(street, gear_change_penalty=penalty)
    print(f'  {penalty} m: {each.length:.2f} m, {each.cusps} changes of direction')
    assert each
picture(each, '4-street.png')

print('5. With clearance and continuous curvature')
comfortable = ia.ParkingPlanner().plan(scenario)
print(f'  {comfortable.message}; curvature without jumps: {comfortable.is_smooth}')
picture(comfortable, '5-smooth.png')
assert comfortable

print('6. A map as an array')
cells = numpy.zeros((100, 120), dtype=numpy.uint8)  # row 0 is the lowest
cells[:60, 50:54] = 1
cells[75:, 50:54] = 1
garage = ia.Scenario.from_grid(cells, start=(3, 4, 0), goal=(20, 5, -math.pi / 2), resolution=0.2, name='garage')
found = ia.plan(garage)
print(f'  {found.status}: {found.length:.2f} m after {found.statistics["expanded"]} expansions')
picture(found, '6-map.png')
assert found and ia.check(garage, found)

print('7. Comparison with the grid model of the paper')
paper = ia.plan(garage, parameter_set='paper_improved_astar')
print(f'  grid: {paper.length:.2f} m for a circle that turns on the spot; car: {found.length:.2f} m')

print('8. Many at once')
starts = [garage.replace(start=(3, y, 0)) for y in numpy.linspace(3, 15, 13)]
results = ia.plan_batch(starts)
print(f'  {sum(map(bool, results))} of {len(results)} solved, '
      f'{min(r.length for r in results):.1f} to {max(r.length for r in results):.1f} m')
assert all(results)
