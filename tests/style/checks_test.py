#!/usr/bin/env python3
"""Each style check is run on a small project without a fault, then with one fault at a time: it must find them all."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from pages import BUDGETS

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
GOOD_SOURCE = '#pragma once\n\n#include "parking_geometry/Pose.h"\n'
PROGRAM = '#include <cstdio>\n\nint main()\n{\n    std::puts("a");\n    std::puts("b");\n}\n'
EXAMPLE = '// Writes.\n\n' + PROGRAM
README = f'# A project\n\n```cpp\n{PROGRAM}```\n'
GUIDE = '# A guide\n\n```cpp\nstd::puts("a");\nstd::puts("b");\n```\n'


class ChecksTest(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.root)
        shutil.copy(os.path.join(ROOT, '.clang-format'), self.root)
        self.write('parking_geometry/Pose.h', '#pragma once\n')
        self.write('state_validity/Checker.h', GOOD_SOURCE)
        self.write('state_validity/fcl/World.cpp', '#include <fcl/fcl.h>\n#include "state_validity/Checker.h"\n')
        self.write('state_validity/ompl/Validator.cpp',
                   '#include <ompl/base/State.h>\n#include "state_validity/fcl/World.h"\n')
        self.write('ompl_improved_astar/search/Search.h', GOOD_SOURCE)
        self.write('examples/readme_example.cpp', EXAMPLE)
        self.write('README.md', README)
        self.write('docs/using-the-planner.md', GUIDE)
        self.write('scripts/run', '#!/usr/bin/env bash\necho "$1"\n')

    def write(self, name, text):
        path = os.path.join(self.root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)

    def run_check(self, check, *arguments):
        return subprocess.run([sys.executable, '-B', os.path.join(HERE, f'check_{check}.py'), self.root, *arguments],
                              capture_output=True, text=True, check=False)

    def expect_found(self, check, name, *arguments):
        done = self.run_check(check, *arguments)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(name, done.stdout + done.stderr)

    def test_project_without_faults_passes_all(self):
        for check in ('format', 'dependencies', 'shell', 'paths', 'samples', 'links', 'glossary'):
            with self.subTest(check):
                done = self.run_check(check)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_figures_that_are_not_those_of_the_results(self):
        self.write('docs/results/figures.json', json.dumps({'a.b': {'value': 1.4, 'text': '1.4 ms', 'command': 'run'}}))
        self.write('docs/page.md', 'Takes <!--figure a.b-->1.4 ms<!--/figure-->; `<!--figure NAME-->text` is how.\n')
        self.assertEqual(self.run_check('figures').returncode, 0)
        for text in ('<!--figure a.b-->1.5 ms<!--/figure-->', '<!--figure a.c-->1.4 ms<!--/figure-->', '<!--figure a.b-->1.4 ms',
                     '<!-- figure a.b -->1.4 ms<!-- /figure -->'):
            with self.subTest(text):
                self.write('docs/page.md', text)
                self.expect_found('figures', 'docs/page.md')
        self.write('docs/page.md', '')
        self.write('docs/results/figures.json', json.dumps({'a.b': {'value': 1.4, 'text': '1.4 ms'}}))
        self.expect_found('figures', 'a.b: lacks command')

    def test_unformatted_source(self):
        self.write('state_validity/Checker.cpp', 'int  f( ) { return 1 ; }\n')
        self.expect_found('format', 'state_validity/Checker.cpp')

    def test_includes_against_the_arrows(self):
        for name, included in (
                ('parking_geometry/Bad.h', '"state_validity/Checker.h"'),
                ('parking_geometry/Bad.cpp', '<ompl/base/State.h>'),
                ('state_validity/Bad.h', '"ompl_improved_astar/ImprovedAStar.h"'),
                ('state_validity/Bad.cpp', '"tests/Oracle.h"'),
                ('parking_geometry/Bad.cpp', '"parking_geometry/io/ScenarioReader.h"'),
                ('parking_geometry/curves/Bad.cpp', '"parking_geometry/drawing/Svg.h"'),
                ('parking_geometry/text/Bad.cpp', '<yaml-cpp/yaml.h>'),
                ('parking_geometry/io/Bad.cpp', '"parking_geometry/drawing/Svg.h"'),
                ('parking_geometry/drawing/Bad.cpp', '"parking_geometry/io/ScenarioReader.h"'),
                ('parking_geometry/drawing/Bad.cpp', '<png.h>'),
                ('state_validity/Bad.cpp', '<ompl/base/State.h>'),
                ('state_validity/Bad.cpp', '<fcl/fcl.h>'),
                ('state_validity/Bad.h', '"state_validity/fcl/FclContactTest.h"'),
                ('state_validity/Bad.h', '"state_validity/ompl/FclFootprintChecker.h"'),
                ('state_validity/fcl/Bad.cpp', '<ompl/base/State.h>'),
                ('state_validity/fcl/Bad.cpp', '"state_validity/ompl/FclFootprintChecker.h"'),
                ('state_validity/ompl/Bad.cpp', '<fcl/fcl.h>'),
                ('state_validity/ompl/Bad.cpp', '<ompl/geometric/PathGeometric.h>'),
                ('state_validity/ompl/Bad.cpp', '"parking_geometry/io/ScenarioReader.h"'),
                ('ompl_improved_astar/Bad.cpp', '<fcl/fcl.h>'),
                ('ompl_improved_astar/Bad.cpp', '"parking_geometry/drawing/Svg.h"'),
                ('path_tracking/Bad.cpp', '"state_validity/Checker.h"'),
                ('path_tracking/Bad.cpp', '<ompl/base/State.h>'),
                ('path_tracking/Bad.cpp', '"parking_geometry/io/ScenarioReader.h"'),
                ('ompl_improved_astar/Bad.cpp', '"path_tracking/control/Mpc.h"'),
                ('ompl_improved_astar/search/Bad.h', '"state_validity/ompl/Checker.h"'),
                ('ompl_improved_astar/search/Bad.h', '"state_validity/fcl/FclContactTest.h"'),
                ('ompl_improved_astar/search/Bad.h', '<ceres/ceres.h>'),
                ('ompl_improved_astar/search/Bad.h', '"parking_geometry/io/ScenarioReader.h"'),
                ('ompl_improved_astar/search/Bad.h', '"ompl_improved_astar/ImprovedAStar.h"'),
                ('ompl_improved_astar/search/Bad.h', '<ompl/base/Planner.h>'),
                ('ompl_improved_astar/search/Bad.h', '<fcl/fcl.h>'),
                ('automatic_parking/Bad.cpp', '"benchmarks/Table.h"'),
                ('benchmarks/config/Bad.cpp', '"benchmarks/compare/Options.h"'),
                ('benchmarks/planners/Bad.cpp', '"benchmarks/plan/Problem.h"'),
                ('benchmarks/studies/Bad.cpp', '"tests/RandomWorlds.h"'),
                ('benchmarks/Bad.cpp', '"../state_validity/Checker.h"')):
            with self.subTest(f'{name} includes {included}'):
                self.write(name, f'#pragma once\n#include {included}\n')
                self.expect_found('dependencies', f'{name}:2')
                os.remove(os.path.join(self.root, name))

    def test_header_that_lacks_an_include(self):
        source = os.path.join(self.root, 'parking_geometry', 'Pose.cpp')
        commands = os.path.join(self.root, 'compile_commands.json')
        self.write('compile_commands.json', json.dumps([
            {'directory': self.root, 'file': source, 'command': f'c++ -I{self.root} -std=c++17 -o Pose.o -c {source}'}]))
        self.write('parking_geometry/Pose.cpp', '#include "parking_geometry/Pose.h"\n')
        self.assertEqual(self.run_check('headers', commands).returncode, 0)
        self.write('parking_geometry/Path.h', '#pragma once\nstd::vector<int> lengths();\n')
        self.expect_found('headers', 'parking_geometry/Path.h', commands)
        # A source that includes it first is compiled by the build, which then says what is wrong.
        self.write('parking_geometry/Pose.cpp', '#include "parking_geometry/Path.h"\n')
        self.assertEqual(self.run_check('headers', commands).returncode, 0)

    def test_shell_script_with_unquoted_variable(self):
        self.write('scripts/run', '#!/usr/bin/env bash\nrm $1\n')
        self.expect_found('shell', 'SC2086')

    def test_machine_path(self):
        self.write('README.md', 'See /' + 'home/somebody/project.\n')
        self.expect_found('paths', 'README.md:1')

    def test_sample_that_differs(self):
        for page, text, other in (('README.md', README, README.replace('main()', 'main(int, char **)')),
                                  ('README.md', README, README.replace('#include <cstdio>\n\n', '')),
                                  ('docs/using-the-planner.md', GUIDE, GUIDE.replace('"b"', '"c"')),
                                  ('docs/using-the-planner.md', GUIDE, GUIDE.replace('std::puts("b")', '    f("b")'))):
            self.write(page, other)
            self.expect_found('samples', page)
            self.write(page, text)
            self.assertEqual(self.run_check('samples').returncode, 0)

    def test_pages_that_are_missing_or_too_long(self):
        for page, budget in BUDGETS.items():
            self.write(page, 'word | ' * budget + '<!-- x:begin -->' + ' more' * budget + '<!-- x:end -->')
        done = self.run_check('words')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.write('docs/limits.md', 'word ' * 551)
        self.expect_found('words', 'docs/limits.md: 551 words')
        os.remove(os.path.join(self.root, 'docs/limits.md'))
        self.expect_found('words', 'docs/limits.md: is missing')

    def test_words_that_are_no_terms(self):
        self.write('docs/limits.md', '# Limits\n\nA path is asked\nfor.\n')
        self.expect_found('glossary', 'docs/limits.md:3: "asked for"; rather: requested')
        self.write('docs/limits.md', '# Limits\n\nA task, so manyfold.\n\n```text\nanew\n```\n')
        done = self.run_check('glossary')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.write('parking_geometry/Pose.h', '#pragma once\nint anew;\n/** \\brief Plans anew. */\nvoid plan();\n')
        self.write('state_validity/Bad.cpp', 'int anew;  // anew\nconst char *text = "plans by turns";\n')
        for place, found in (('headers', 'parking_geometry/Pose.h:3: "anew"'),
                             ('messages', 'state_validity/Bad.cpp:2: "by turns"')):
            done = self.run_check('glossary', place)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stdout.count('rather'), 1, done.stdout)
            self.assertIn(found, done.stdout)

    def test_versions_that_differ(self):
        changes = '# Changelog\n\nNewest first.\n\n## 0.3.0 (unreleased)\n\nAll new.\n\n## 0.2.0\n'
        self.write('CMakeLists.txt', 'cmake_minimum_required(VERSION 3.25)\nproject(some_project\n  VERSION 0.3.0\n)\n')
        self.write('CHANGELOG.md', changes)
        for folder in ('', 'integrations/nav2/'):
            self.write(f'{folder}package.xml', '<?xml version="1.0"?>\n<version>0.3.0</version>\n')
        self.write('CITATION.cff', 'cff-version: 1.2.0\nversion: "0.3.0"\n')
        self.write('pyproject.toml', 'cmake.version = ">=3.25"\ndynamic = ["version"]\ninput = "CMakeLists.txt"\n')
        self.write('scripts/package', 'libompl-improved-astar$soversion\n')
        done = self.run_check('version')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for name, text in (('CHANGELOG.md', changes.replace('## 0.3.0', '## 0.4.0')), ('CHANGELOG.md', '# Changelog\n'),
                           ('package.xml', '<version>0.2.0</version>\n'),
                           ('integrations/nav2/package.xml', '<version>0.2.0</version>\n'),
                           ('CITATION.cff', 'cff-version: 1.2.0\nversion: "0.2.0"\n'),
                           ('CITATION.cff', 'cff-version: 1.2.0\ntitle: some\n'),
                           ('pyproject.toml', 'dynamic = ["version"]\ninput = "CMakeLists.txt"\nversion = "0.2.0"\n'),
                           ('pyproject.toml', 'dynamic = ["version"]\n'),
                           ('scripts/package', 'libompl-improved-astar0.2\n')):
            with self.subTest(f'{name}: {text}'):
                with open(os.path.join(self.root, name), encoding='utf-8') as file:
                    before = file.read()
                self.write(name, text)
                self.expect_found('version', name)
                self.write(name, before)
        self.write('CMakeLists.txt', 'project(some_project)\n')
        self.expect_found('version', 'CMakeLists.txt')

    def make_documented(self):
        if not shutil.which('doxygen'):
            self.skipTest('doxygen is not installed')
        shutil.copy(os.path.join(ROOT, 'Doxyfile'), self.root)
        for name in ('docs/images/map.svg', 'docs/images/examples/park.svg', 'path_tracking/Drive.h',
                     'automatic_parking/Park.h', 'benchmarks/Run.h', 'integrations/nav2/Plugin.h'):
            self.write(name, '')
        self.write('docs/planner.md', '# Planner\n\n![a map](images/map.svg)\n')
        self.write('README.md', '[planner](docs/planner.md), [drive](path_tracking/Drive.h), [tracking](path_tracking)\n\n'
                   '<img src="docs/images/examples/park.svg">\n\n```md\n[no link](anywhere.md)\n```\n')
        self.write_navigation(Start=['README.md', 'docs/planner.md'], Use=['docs/using-the-planner.md'])

    def write_navigation(self, **groups):
        self.write('docs/site/navigation.json', json.dumps(groups))

    def test_guides_that_the_site_cannot_show(self):
        self.make_documented()
        for page, text, fault in (
                ('docs/planner.md', '![a map](images/map.svg) ![gone](images/gone.svg)', 'no picture images/gone.svg'),
                ('docs/planner.md', '![a map](images/map.svg) <img src="images/gone.svg">', 'no picture images/gone.svg'),
                ('docs/planner.md', '![a map](images/map.svg) [gone](gone.md)', 'no file gone.md'),
                ('docs/planner.md', 'no picture', 'docs/images/map.svg: no page shows this picture'),
                ('docs/extra.md', 'more', 'docs/extra.md is in no group')):
            with self.subTest(fault):
                self.write(page, text)
                self.expect_found('docs', fault)
                self.write('docs/planner.md', '![a map](images/map.svg)')
        os.remove(os.path.join(self.root, 'docs/extra.md'))
        self.write_navigation(Start=['README.md', 'docs/planner.md'], Use=['docs/using-the-planner.md', 'docs/gone.md', 'README.md'])
        self.expect_found('docs', 'docs/gone.md is not there')
        self.expect_found('docs', 'README.md is listed twice')

    def test_docstring_about_a_parameter_that_is_not_there(self):
        self.make_documented()
        done = self.run_check('docs')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.write('path_tracking/Drive.h', '/** \\brief A drive. */\nclass Drive\n{\npublic:\n'
                   '    /** \\param gone metres */\n    Drive(double length);\n};\n')
        self.expect_found('docs', 'path_tracking/Drive.h')

    def test_public_name_without_a_docstring(self):
        self.make_documented()
        self.write('path_tracking/Drive.h', '/** \\file */\nclass Drive\n{\npublic:\n    void go();\n};\n')
        self.expect_found('docs', 'Drive is not documented')
        self.write('path_tracking/Drive.h', '/** \\brief A drive. */\nclass Drive\n{\npublic:\n'
                   '    void go();\n};\n')
        self.expect_found('docs', 'go() (function) of class Drive is not documented')
        everything = ('/** \\brief Parts. */\nnamespace parts\n{\n/** \\brief Which way. */\nenum class Way\n{\n'
                      'Ahead,  ///< forwards\nBack  ///< in reverse\n};\n/** \\brief Drives on. */\nvoid drive();\n'
                      '/** \\brief A drive. */\nclass Drive\n{\nprivate:\nenum class State\n{\nOn\n};\n'
                      'State state_;\n};\n}\n')
        self.write('path_tracking/Drive.h', everything)
        done = self.run_check('docs')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.write('path_tracking/Drive.h', everything.replace('/** \\brief Parts. */', ''))
        self.expect_found('docs', 'namespace parts is')
        for docstring in ('/** \\brief Which way. */', '///< in reverse', '/** \\brief Drives on. */'):
            everything = everything.replace(docstring, '')
        self.write('path_tracking/Drive.h', everything)
        done = self.run_check('docs')
        for name in ('Way (enumeration)', 'Way::Back', 'drive()'):
            self.assertIn(name, done.stdout)

    def test_files_ignored_by_git_do_not_count(self):
        if not shutil.which('git'):
            self.skipTest('git is not installed')
        subprocess.run(['git', 'init', '--quiet', self.root], check=True)
        self.write('.gitignore', '/build/\n')
        bad = '#include <ompl/base/Planner.h>\n'
        self.write('build/parking_geometry/Bad.h', bad)
        self.assertEqual(self.run_check('dependencies').returncode, 0)
        self.write('parking_geometry/Bad.h', bad)
        self.expect_found('dependencies', 'parking_geometry/Bad.h')


if __name__ == '__main__':
    unittest.main()
