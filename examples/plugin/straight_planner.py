#!/usr/bin/env python3
"""A minimal planner for the plug-in of ExternalPlanner.cpp: directly from the start to the goal.

It reads a scenario from standard input and prints the poses of a path, one "x y yaw" per line. The curves of the space join
them. It does not check collisions."""
import re
import sys


def pose(text, key):
    return re.search(rf'^{key}: \[(.*)\]$', text, re.MULTILINE).group(1).replace(',', ' ')


SCENARIO = sys.stdin.read()
print(pose(SCENARIO, 'start'))
print(pose(SCENARIO, 'goal'))
