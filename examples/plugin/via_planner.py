"""Through one random pose, in Python.

    parking_plan SCENARIO --plugin examples/plugin/via_planner.py --planner via_python

It samples poses near a goal until one connects start and goal by two free motions, as ViaPlanner.cpp does."""
import math
import random

NAME = 'via_python'
PARAMETERS = {'radius': 15.0, 'batch': 50}


def plan(problem):
    """Returns the poses of a path, which the space's curves join, or None. A generator may yield ever shorter paths."""
    start, radius = problem.start, problem.parameters['radius']
    for _ in range(1000):
        goal = random.choice(problem.goals)
        poses = [(goal[0] + random.uniform(-radius, radius), goal[1] + random.uniform(-radius, radius),
                  random.uniform(-math.pi, math.pi)) for _ in range(problem.parameters['batch'])]
        # One question about many poses takes less time than many questions.
        into_goal = problem.is_motion_free([(pose, goal) for pose in poses])
        poses = [pose for pose, is_free in zip(poses, into_goal) if is_free]
        for pose, is_free in zip(poses, problem.is_motion_free([(start, pose) for pose in poses])):
            if is_free:
                return [start, pose, goal]
    return None
