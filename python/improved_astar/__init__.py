"""Plans the path of a car into a parking slot: Improved A* without OMPL.

    import improved_astar as ia

    scenario = ia.Scenario.read('narrow_parallel.yaml')
    result = ia.plan(scenario, time_limit=1.0)
    print(result.status, result.length, result.path.shape)
    result.plot('path.png')

Poses are (x, y, yaw) of the midpoint of the rear axle, in metres and radians counter-clockwise from +x.
"""
from ._core import (Drive, Error, ParkingPlan, ParkingPlanner, Result, Scenario, Slot, Vehicle, Verdict, __version__,
                    _parameter_table, check, plan, plan_batch, vehicles)
from .animation import Animation, animate
from .plotting import plot
from .results import read_runs

__all__ = ['Animation', 'Drive', 'Error', 'ParkingPlan', 'ParkingPlanner', 'Result', 'Scenario', 'Slot', 'Vehicle',
           'Verdict', 'animate', 'check', 'parameters', 'plan', 'plan_batch', 'plot', 'read_runs', 'vehicles']


def parameters():
    """Returns the parameters of the planner: {name: (default, allowed values, unit, meaning)}."""
    return {row[0]: tuple(row[1:]) for row in _parameter_table()}


Drive.plot = plot
Drive.animate = animate
