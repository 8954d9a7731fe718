"""Does package.xml name the project, its version and what packages.sh lists for its build?

usage: check_ros_package.py ROOT VERSION
"""
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

# rosdep's keys (github.com/ros/rosdistro, rosdep/*.yaml) of Debian packages; ompl is a package of ROS itself.
KEYS = {
    'cmake': 'cmake',
    'libbenchmark-dev': 'benchmark',
    'libboost-dev': 'libboost-dev',
    'libboost-filesystem-dev': 'libboost-filesystem-dev',
    'libboost-program-options-dev': 'libboost-program-options-dev',
    'libccd-dev': 'libccd-dev',
    'libceres-dev': 'libceres-dev',
    'libeigen3-dev': 'eigen',
    'libfcl-dev': 'libfcl-dev',
    'libompl-dev': 'ompl',
    'libpng-dev': 'libpng-dev',
    'libsqlite3-dev': 'libsqlite3-dev',
    'libyaml-cpp-dev': 'yaml-cpp',
    'nlohmann-json3-dev': 'nlohmann-json-dev',
    'pybind11-dev': 'pybind11-dev',
    'python3-dev': 'python3-dev',
    'python3-numpy': 'python3-numpy',
    'python3-scipy': 'python3-scipy',
}
WITH_EVERY_ROS = {'g++', 'make', 'python3'}


def main(root, version):
    package = xml.parse(os.path.join(root, 'package.xml')).getroot()
    faults = []
    for tag, expected in (('name', 'ompl_improved_astar'), ('version', version)):
        if package.find(tag).text != expected:
            faults.append(f'package.xml: {tag} is {package.find(tag).text}, the project has {expected}')
    if package.get('format') != '3' or package.find('export/build_type').text != 'cmake':
        faults.append('package.xml: must have format 3 and the build type cmake')
    # ROS's tools ignore a file whose address has no domain.
    if not re.fullmatch(r'[\w%+.-]+@[\w-]+(\.[\w-]+)*\.[a-zA-Z]{2,}', package.find('maintainer').get('email')):
        faults.append('package.xml: the maintainer has no valid e-mail address')
    listed = subprocess.run(['bash', '-c', 'source "$1"; packages_for build', '-', os.path.join(root, 'scripts/lib/packages.sh')],
                            check=True, capture_output=True, text=True).stdout
    needed = {line.split('\t')[0] for line in listed.splitlines()} - WITH_EVERY_ROS
    faults += [f'{name}: packages.sh lists it for the build; add its key of rosdep here and to package.xml'
               for name in sorted(needed - set(KEYS))]
    expected = {KEYS[name] for name in needed & set(KEYS)}
    found = [each.text for each in package if each.tag.endswith('depend')]
    faults += [f'package.xml: {key} is missing' for key in sorted(expected - set(found))]
    faults += [f'package.xml: packages.sh does not list {key} for the build' for key in sorted(set(found) - expected)]
    faults += [f'package.xml: {key} is named twice' for key in sorted({key for key in found if found.count(key) > 1})]
    return '\n'.join(faults) or None


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
