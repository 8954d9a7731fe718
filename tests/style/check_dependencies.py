#!/usr/bin/env python3
"""Do the folders include each other in one direction only?

usage: check_dependencies.py ROOT
"""
import os
import re
import sys

from project_files import project_files, report, text_of

GEOMETRY, VALIDITY, PLANNER = 'parking_geometry', 'state_validity', 'ompl_improved_astar'
TRACKING, PIPELINE = 'path_tracking', 'automatic_parking'
LIBRARIES = [GEOMETRY, VALIDITY, PLANNER, TRACKING, PIPELINE]

# folder -> the other folders of the project that it may include. The longest prefix of a file's path counts.
MAY_INCLUDE = {
    GEOMETRY: [],
    VALIDITY: [GEOMETRY],
    f'{VALIDITY}/fcl': [VALIDITY, GEOMETRY],
    f'{VALIDITY}/ompl': [VALIDITY, GEOMETRY],
    PLANNER: [VALIDITY, GEOMETRY],
    f'{PLANNER}/search': [VALIDITY, GEOMETRY],
    TRACKING: [GEOMETRY],
    f'{TRACKING}/trajectory': [VALIDITY, GEOMETRY],
    PIPELINE: LIBRARIES,
    f'{PIPELINE}/scenario': LIBRARIES,
    f'{PIPELINE}/perception': [VALIDITY, GEOMETRY],
    'python': LIBRARIES,
    'playground': LIBRARIES + ['benchmarks/planners'],  # the textbook's search, which is free of OMPL
    'benchmarks': LIBRARIES,  # the random worlds that the tests use too are in benchmarks/worlds
    'examples': LIBRARIES,
    'integrations': [PLANNER, VALIDITY, GEOMETRY],  # of the core, see NEVER
    'tests': LIBRARIES + ['benchmarks', 'examples', 'playground', 'integrations'],
}
# The rooms of the comparison, each of which may use those before it. The studies beside them use what they like.
ROOMS = [f'benchmarks/{room}' for room in ('worlds', 'system', 'planners', 'metrics', 'plan', 'config', 'queries', 'store',
                                           'summary', 'compare')]
MAY_INCLUDE.update({room: LIBRARIES + ROOMS[:k] for k, room in enumerate(ROOMS)})

# What the core does without: other libraries than Eigen, and the folders that are there to know them.
READERS = [f'{GEOMETRY}/io/', f'{GEOMETRY}/drawing/']
ADAPTERS = READERS + [f'{VALIDITY}/fcl/', f'{VALIDITY}/ompl/']
OUTSIDE = ['ompl/', 'fcl/', 'ceres/', 'yaml-cpp/', 'png.h', 'boost/', 'nlohmann/', 'sqlite3.h']

# folder -> what it must not include although it may include what is round it.
NEVER = {
    GEOMETRY: OUTSIDE + ADAPTERS,
    f'{GEOMETRY}/io': ['ompl/', 'fcl/', 'ceres/', f'{GEOMETRY}/drawing/'],
    f'{GEOMETRY}/drawing': OUTSIDE + [f'{GEOMETRY}/io/'],
    VALIDITY: OUTSIDE + ADAPTERS,
    f'{VALIDITY}/fcl': [other for other in OUTSIDE + ADAPTERS if other not in ('fcl/', f'{VALIDITY}/fcl/')],
    f'{VALIDITY}/ompl': ['ompl/geometric/', 'ompl/control/', 'ompl/tools/', 'fcl/', 'ceres/'] + READERS,
    PLANNER: ['fcl/', 'ceres/', 'ompl/tools/'] + READERS,
    f'{PLANNER}/search': OUTSIDE + ADAPTERS,
    TRACKING: ['ompl/', 'fcl/'] + READERS,
    f'{TRACKING}/trajectory': OUTSIDE + ADAPTERS,
    f'{PIPELINE}/scenario': OUTSIDE + ADAPTERS,
    f'{PIPELINE}/perception': OUTSIDE + ADAPTERS,
    'playground': OUTSIDE + ADAPTERS,
    'python': ['ompl/', 'fcl/', 'ceres/', f'{VALIDITY}/fcl/', f'{VALIDITY}/ompl/'],
    'integrations': OUTSIDE + ADAPTERS,
}

INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)


def rule_for(name, rules):
    """The entry for the longest folder that the file lies in, or None."""
    fitting = [folder for folder in rules if name.startswith(folder + '/')]
    return max(fitting, key=len) if fitting else None


def is_within(included, folders):
    return any(included.startswith(folder + '/') for folder in folders)


def main(root):
    findings = []
    for name in project_files(root):
        own = rule_for(name, MAY_INCLUDE)
        if own is None or not name.endswith(('.h', '.cpp')):
            continue
        never = NEVER.get(rule_for(name, NEVER), [])
        text = text_of(root, name)
        for match in INCLUDE.finditer(text):
            included = match.group(1)
            place = f'{name}:{text.count(chr(10), 0, match.start(1)) + 1}'
            # A file includes its own folder, and that is all that lies within a folder with rules of its own.
            allowed = is_within(included, [own] + MAY_INCLUDE[own])
            if is_within(included, MAY_INCLUDE) and not allowed:
                findings.append(f'{place}: {own} must not include {included}')
            elif any(included.startswith(prefix) for prefix in never):
                findings.append(f'{place}: {own} must not include {included}')
            elif included.startswith('.'):
                findings.append(f'{place}: {included}: includes are written from the root of the project')
    report(findings, 'The arrows between the folders: MAY_INCLUDE and NEVER in tests/style/check_dependencies.py.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
