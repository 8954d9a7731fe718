"""Planners from a library: the example is built outside the tree, against the installed package, and used by both
programs; libraries that are none, or do not fit, are refused."""

import os
import shutil
import subprocess
import tempfile
import unittest

from programs import SOURCE, ProgramTest, bundled, main

EXAMPLE = os.path.join(SOURCE, 'examples', 'plugin')
CONFIG = '''[problem]
scenario = %s
[benchmark]
time_limit = 20
run_count = 2
[planner]
via=
via=
via.name=via_near
via.radius=12
''' % bundled('perpendicular')


def run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=600, check=False)
    if done.returncode != 0:
        raise RuntimeError(' '.join(str(part) for part in command) + '\n' + done.stdout)


class Plugin(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.mkdtemp(prefix='parking_plugin_')
        cls.addClassCleanup(shutil.rmtree, cls.work, ignore_errors=True)
        cls.prefix = os.path.join(cls.work, 'prefix')
        # Only headers and libraries are of use here; programs need not be built.
        run(os.environ['CMAKE'], '--install', os.environ['PARKING_BUILD_DIR'], '--prefix', cls.prefix)
        shutil.copytree(EXAMPLE, os.path.join(cls.work, 'source'))
        cls.library = cls.build('plugin')

    @classmethod
    def build(cls, name, *options):
        folder = os.path.join(cls.work, name)
        run(os.environ['CMAKE'], '-S', os.path.join(cls.work, 'source'), '-B', folder,
            '-DCMAKE_PREFIX_PATH=' + cls.prefix, '-DCMAKE_CXX_COMPILER=' + os.environ['CXX'], *options)
        run(os.environ['CMAKE'], '--build', folder)
        return os.path.join(folder, 'libvia_planner.so')

    def compile(self, name, text):
        """A library of some lines that need no headers."""
        source = self.write(name + '.cpp', text)
        library = self.path(name + '.so')
        run(os.environ['CXX'], '-shared', '-fPIC', '-o', library, source)
        return library

    def test_parking_plan(self):
        result = self.planned(bundled('perpendicular'), '--plugin', self.library, '--planner', 'via', '--set',
                              'radius=12', '--time-limit', 60)
        self.assertEqual((result['status'], result['planner']), ('exact', 'via'))
        self.assertEqual(result['parameters'], {'radius': 12})
        self.assertTrue(result['recheck']['valid'])
        self.assertIn('through one random pose', self.plan('--help', '--plugin', self.library).stdout)
        self.refused_plan(bundled('perpendicular'), '--planner', 'via', parts=["unknown planner 'via'"])

    def test_parking_benchmark(self):
        self.write('set.cfg', CONFIG)
        self.refused_benchmark('set.cfg', '--output', 'out', parts=['set.cfg:7:', "unknown planner 'via'"])
        done = self.benchmark('set.cfg', '--output', 'out', '--quiet', '--plugin', self.library)
        self.assertRegex(done.stdout, r'via +2/2')
        self.assertRegex(done.stdout, r'via_near +2/2')
        self.write('set.cfg', CONFIG + 'via.raduis=6\n')
        self.refused_benchmark('set.cfg', '--output', 'out', '--plugin', self.library,
                               parts=["did you mean 'radius'"])

    def test_time_limit_holds_for_plugins(self):
        result = self.planned(bundled('tight_parallel'), '--plugin', self.library, '--planner', 'via', '--time-limit',
                              0.3, status=4)
        self.assertEqual(result['status'], 'timeout')
        self.assertLess(result['planning_time_ms'][0], 5000.0)

    def test_another_version_of_ompl(self):
        shadow = os.path.join(self.work, 'shadow', 'ompl')
        os.makedirs(shadow)
        with open(os.path.join(shadow, 'config.h'), 'w') as stream:
            stream.write('#include_next <ompl/config.h>\n#undef OMPL_VERSION_VALUE\n#define OMPL_VERSION_VALUE 9008007\n')
        library = self.build('other', '-DCMAKE_CXX_FLAGS=-I' + os.path.dirname(shadow))
        self.refused_plan(bundled('perpendicular'), '--plugin', library, parts=['libvia_planner.so', 'OMPL 9.8.7'])

    def test_libraries_that_are_no_plugins(self):
        self.write('text.so', 'not a library')
        for library, part in (('missing.so', 'no such file'), ('text.so', 'cannot be loaded'),
                              (self.compile('bare', 'int x;'), 'parking_planner_plugin'),
                              (self.compile('lacking', 'void f(); void *x = (void *)f;'), 'undefined symbol'),
                              (self.compile('old', 'extern "C" { struct { int a, b; void *c; } parking_planner_plugin = '
                                            '{0, 0, 0}; }'), 'version 0')):
            with self.subTest(library):
                self.write('set.cfg', CONFIG)
                self.refused_benchmark('set.cfg', '--plugin', library, '--output', 'out',
                                       parts=[os.path.basename(library), part])
                self.refused_plan(bundled('angled45'), '--plugin', library, parts=[os.path.basename(library), part])

    def test_the_same_planner_twice(self):
        self.refused_plan(bundled('angled45'), '--plugin', self.library, '--plugin', self.library,
                          parts=['libvia_planner.so', 'already'])


if __name__ == '__main__':
    main()
