#!/usr/bin/env python3
"""A planner for the plug-in of ExternalPlanner.cpp, as small as can be: from the start straight to the goal.

It reads a scenario from standard input and prints the poses of a path, "x y yaw" a line; the curves of the space join them.
Whether it is free, and worth anything, is for others to say."""
import re
import sys


def pose(text, key):
    return re.search(rf'^{key}: \[(.*)\]$', text, re.MULTILINE).group(1).replace(',', ' ')


SCENARIO = sys.stdin.read()
print(pose(SCENARIO, 'start'))
print(pose(SCENARIO, 'goal'))
