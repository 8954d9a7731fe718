#!/usr/bin/env python3
"""What configuring by hand says on a machine that lacks something: one line that names the package or the disk.

usage: configure_test.py CMAKE CXX
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CMAKE = 'cmake'
CXX = 'c++'


class ConfigureTest(unittest.TestCase):
    """Each test configures the project in a folder of its own, and reads the first error."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.builds = 0

    def first_error(self, *arguments, **environment):
        """The text of the first error, its lines joined."""
        environment = {'PATH': os.environ['PATH'], 'LC_ALL': 'C', 'CXX': CXX, **environment}
        self.builds += 1
        done = subprocess.run([CMAKE, '-S', ROOT, '-B', os.path.join(self.folder, f'build{self.builds}'), *arguments],
                              capture_output=True, text=True, check=False, env=environment)
        self.assertNotEqual(done.returncode, 0)
        found = re.search(r'CMake Error at [^\n]*:\n\n?((?:  [^\n]*\n)+)', done.stderr)
        self.assertTrue(found, done.stderr)
        return ' '.join(found.group(1).split())

    def test_missing_libraries_are_named_with_their_packages(self):
        for library, said in (('Eigen3', 'Eigen3 3.3 or later was not found: install libeigen3-dev'),
                              ('ompl', 'ompl was not found: install libompl-dev'),
                              ('PNG', 'PNG was not found: install libpng-dev'),
                              ('nlohmann_json', 'nlohmann_json 3.2 or later was not found: install nlohmann-json3-dev'),
                              ('GTest', 'GTest was not found: install libgtest-dev'),
                              ('Python3', 'Python3 was not found: install python3')):
            with self.subTest(library):
                self.assertEqual(self.first_error(f'-DCMAKE_DISABLE_FIND_PACKAGE_{library}=ON'), said)

    def config(self, name, version):
        """A library that is there, in a version of our choice."""
        folder = os.path.join(self.folder, name)
        os.makedirs(folder)
        for file, text in ((f'{name}Config.cmake', ''),
                           (f'{name}ConfigVersion.cmake',
                            f'set(PACKAGE_VERSION {version})\n'
                            'if(NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)\n'
                            '  set(PACKAGE_VERSION_COMPATIBLE TRUE)\nendif()\n')):
            with open(os.path.join(folder, file), 'w', encoding='utf-8') as out:
                out.write(text)
        return f'-D{name}_DIR={folder}'

    def test_versions_that_are_too_old_are_named(self):
        self.assertEqual(self.first_error(self.config('ompl', '1.4.2')),
                         'OMPL 1.5 or later is needed, 1.4.2 was found: install a newer libompl-dev')

    def test_missing_compiler_is_named_with_its_package(self):
        programs = os.path.join(self.folder, 'bin')
        os.makedirs(programs)
        self.assertEqual(self.first_error('-DCMAKE_FIND_ROOT_PATH=' + self.folder, '-DCMAKE_SYSTEM_PROGRAM_PATH=',
                                          '-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF', PATH=programs, CXX=''),
                         'there is no C++ compiler: install g++')

    def test_full_disk_is_said_before_anything_is_built(self):
        programs = os.path.join(self.folder, 'bin')
        os.makedirs(programs)
        with open(os.path.join(programs, 'df'), 'w', encoding='utf-8') as out:
            out.write('#!/bin/sh\nprintf "Filesystem 1024-blocks Used Available Capacity Mounted on\\n"\n'
                      'printf "/dev/disk 900000 880000 20480 98%% /\\n"\n')
        os.chmod(out.name, 0o755)
        self.assertRegex(self.first_error(PATH=programs + ':' + os.environ['PATH']),
                         '/build1: 20 MB of disk are free, a build takes up to 1000 MB$')


if __name__ == '__main__':
    CMAKE, CXX = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1])
