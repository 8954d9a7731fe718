#!/usr/bin/env python3
"""What scripts/test and scripts/compare do about packages and options, with dpkg, apt-get, sudo and id replaced."""
import os
import pty
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = ('test', 'compare')


class ScriptsTest(unittest.TestCase):
    """The replaced commands write what they are called with to `calls`; `missing` holds what dpkg does not have."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.project = os.path.join(self.folder, 'a project')
        shutil.copytree(os.path.join(ROOT, 'scripts'), os.path.join(self.project, 'scripts'))
        self.calls = os.path.join(self.folder, 'calls')
        self.missing = os.path.join(self.folder, 'missing')
        self.write(self.calls, '')
        self.write(self.missing, '')
        self.replace('dpkg-query', f'grep -qx -- "${{@: -1}}" "{self.missing}" || echo -n installed')
        self.replace('apt-get', f'echo "apt-get $*" >>"{self.calls}"; '
                                f'if [[ $* == *install* ]]; then : >"{self.missing}"; fi')
        self.replace('sudo', f'echo "sudo $*" >>"{self.calls}"; exit 1')
        self.replace('id', 'echo 0')
        self.replace('cmake', f'echo "cmake $*" >>"{self.calls}"; '
                              'if [[ $1 == --version ]]; then echo "cmake version 3.25.1"; else exit 1; fi')

    def write(self, path, text):
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)

    def replace(self, command, body):
        path = os.path.join(self.folder, 'bin', command)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        self.write(path, '#!/usr/bin/env bash\n' + body + '\n')
        os.chmod(path, 0o755)

    def run_script(self, script, *arguments, **environment):
        path = os.path.join(self.folder, 'bin') + ':' + os.environ['PATH']
        return subprocess.run([os.path.join(self.project, 'scripts', script), *arguments], cwd='/',
                              env={**os.environ, 'PATH': path, **environment}, capture_output=True, text=True,
                              check=False)

    def called(self, command):
        with open(self.calls, encoding='utf-8') as file:
            return [line.strip() for line in file if line.startswith(command)]

    def test_apt_is_not_touched_when_nothing_is_missing(self):
        for script in SCRIPTS:
            with self.subTest(script):
                done = self.run_script(script)
                self.assertIn('packages are installed', done.stdout)
                self.assertEqual(self.called('apt-get'), [])
                self.assertEqual(self.called('sudo'), [])
                self.assertTrue(self.called('cmake --preset release'), done.stderr)
                self.assertEqual(done.returncode, 1)  # of the replaced cmake

    def test_only_what_is_missing_is_installed(self):
        self.write(self.missing, 'libompl-dev\nlibgtest-dev\n')
        done = self.run_script('test')
        self.assertIn('libompl-dev', done.stdout)
        self.assertIn('GoogleTest', done.stdout)
        update, install = self.called('apt-get')
        self.assertTrue(update.endswith(' update'))
        self.assertTrue(install.endswith('--yes --no-install-recommends libompl-dev libgtest-dev'))

    def test_comparing_needs_no_packages_of_the_tests(self):
        self.write(self.missing, 'libgtest-dev\nshellcheck\n')
        self.run_script('compare')
        self.assertEqual(self.called('apt-get'), [])

    def test_without_root_the_command_is_printed(self):
        self.replace('id', 'echo 1000')
        self.write(self.missing, 'libompl-dev\n')
        for script in SCRIPTS:
            with self.subTest(script):
                done = self.run_script(script)
                self.assertEqual(done.returncode, 2)
                self.assertIn('sudo apt-get update && sudo apt-get install --yes --no-install-recommends libompl-dev\n',
                              done.stderr)
                self.assertEqual(self.called('apt-get'), [])

    def test_sudo_without_a_password_is_used(self):
        self.replace('id', 'echo 1000')
        self.replace('sudo', f'echo "sudo $*" >>"{self.calls}"; shift; "$@"')
        self.write(self.missing, 'libompl-dev\n')
        self.run_script('test')
        self.assertEqual(len(self.called('sudo --non-interactive env DEBIAN_FRONTEND=noninteractive apt-get')), 2)

    def test_failure_of_apt_ends_the_script(self):
        self.replace('apt-get', 'exit 100')
        self.write(self.missing, 'libompl-dev\n')
        done = self.run_script('test')
        self.assertEqual(done.returncode, 2)
        self.assertIn('could not install', done.stderr)
        self.assertEqual(self.called('cmake'), [])

    def test_old_cmake_is_named(self):
        self.replace('cmake', 'echo "cmake version 3.18.4"')
        done = self.run_script('test')
        self.assertEqual(done.returncode, 2)
        self.assertIn('cmake 3.18.4 is too old', done.stderr)

    def test_missing_compiler_is_named_with_its_package(self):
        for script in SCRIPTS:
            done = self.run_script(script, CXX='no-such-compiler')
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr, f"{script}: there is no C++ compiler no-such-compiler; Debian's package is g++\n")

    def test_full_disk_is_said_before_the_build(self):
        self.replace('df', 'printf "Avail\\n  310\\n"')
        for script in SCRIPTS:
            done = self.run_script(script)
            self.assertEqual(done.returncode, 2)
            self.assertIn('310 MB of disk are free', done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_bare_root_says_in_one_line_what_it_lacks(self):
        for what, arguments, said in (
                ('', ['trixie', 'bookworm'], 'more than one SUITE'), ('', [], 'no SUITE'), ('', ['--fast'], '--fast'),
                ('', ['a b'], "'a b'"), ('', ['trixie', '--root'], '--root needs a value'),
                ('id', ['trixie'], 'only be made by root'), ('apt-get', ['trixie'], 'names no mirror'),
                ('df', ['trixie'], '310 MB'), ('debootstrap', ['nowhere'], 'could not make nowhere: E: no such release')):
            self.replace('id', 'echo 0')
            self.replace('df', 'printf "Avail\\n  9310\\n"')
            self.replace('apt-get', 'echo "Debian|http://mirror.invalid"')
            self.replace('debootstrap', 'echo "E: no such release"; exit 1')
            self.replace('git', 'exit 1')
            self.replace('unshare', 'exit 1')
            if what in ('id', 'apt-get', 'df'):
                self.replace(what, {'id': 'echo 1000', 'apt-get': 'exit 1', 'df': 'printf "Avail\\n  310\\n"'}[what])
            with self.subTest(f'{what} {arguments}'):
                done = self.run_script('try-in-bare-root', *arguments, TMPDIR=self.folder)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(said, done.stderr)
                self.assertEqual([name for name in os.listdir(self.folder) if 'bare-root' in name], [])

    def test_wrong_options_end_with_status_2_and_one_line(self):
        for script, arguments in (('test', ['--release']), ('test', ['a', 'b']), ('compare', ['--fast']),
                                  ('compare', ['results']), ('results', ['--fast']), ('results', ['--data'])):
            with self.subTest(f'{script} {arguments}'):
                done = self.run_script(script, *arguments)
                self.assertEqual(done.returncode, 2)
                self.assertEqual(len(done.stderr.splitlines()), 1)
                self.assertEqual(self.called('cmake'), [])

    def test_what_the_comparison_ends_with_is_handed_on(self):
        self.replace('cmake', 'if [[ $1 == --version ]]; then echo "cmake version 3.25.1"; fi')
        program = os.path.join(self.project, 'build', 'release', 'benchmarks', 'parking_benchmark')
        os.makedirs(os.path.dirname(program))
        self.write(program, '#!/usr/bin/env bash\necho "$@"\nexit "$STATUS"\n')
        os.chmod(program, 0o755)
        for status, handed_on, said in (('0', 0, 'Compared in'), ('1', 1, 'FAILED: parking_benchmark ended with status 1'),
                                        ('2', 2, ''), ('130', 130, ''), ('134', 1, 'FAILED')):
            with self.subTest(status):
                done = self.run_script('compare', '--', '--time', 'nan', STATUS=status)
                self.assertEqual((done.returncode, done.stderr), (handed_on, ''))
                self.assertIn('bundled.cfg --output ' + os.path.join(self.project, 'results') + ' --time nan\n', done.stdout)
                self.assertIn(said, done.stdout)
                self.assertEqual('FAILED' in done.stdout, handed_on == 1)
        done = self.run_script('compare', '--', '--help', STATUS='0')
        self.assertEqual(done.returncode, 0)
        self.assertNotIn('Compared', done.stdout)

    def test_findings_of_clang_tidy_fail(self):
        self.replace('cmake', 'if [[ $1 == --version ]]; then echo "cmake version 3.25.1"; fi')
        self.replace('run-clang-tidy', 'echo "clang-tidy-14 -p=build a.cpp"; echo "$FOUND"; exit "$STATUS"')
        for folder in ('build/tidy', 'python'):
            os.makedirs(os.path.join(self.project, folder))
        for found, status, said in (('', 0, 'PASSED'), ('a.cpp:1:1: error: a bug', 1, 'FAILED')):
            done = self.run_script('tidy', 'python/', FOUND=found, STATUS=str(status))
            self.assertEqual((done.returncode, done.stderr), (status, ''))
            self.assertIn(said, done.stdout)
            self.assertIn(found, done.stdout)
            self.assertNotIn('a.cpp\n', done.stdout)
        done = self.run_script('tidy', 'nowhere')
        self.assertEqual((done.returncode, done.stderr), (2, f'tidy: no folder nowhere below {self.project}\n'))

    def test_headlines_are_bold_on_terminals_with_colours_only(self):
        command = ['bash', '-c', f'source {ROOT}/scripts/lib/common.sh; say done; say "FAILED: it"']
        for changes, wanted in (({}, '\033[1m==> done\033[0m\n\033[1;31m==> FAILED: it\033[0m\n'),
                                ({'NO_COLOR': '1'}, '==> done\n==> FAILED: it\n'), ({'TERM': 'dumb'}, '==> done\n==> FAILED: it\n')):
            ours, theirs = pty.openpty()
            subprocess.run(command, stdout=theirs, check=True, env={**os.environ, 'TERM': 'xterm', 'NO_COLOR': '', **changes})
            os.close(theirs)
            self.assertEqual(os.read(ours, 4096).decode().replace('\r', ''), wanted)
            os.close(ours)
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, '==> done\n==> FAILED: it\n')

    def test_wrong_number_of_jobs_is_named(self):
        self.replace('cmake', 'if [[ $1 == --version ]]; then echo "cmake version 3.25.1"; fi')
        done = self.run_script('test', PARKING_JOBS='none')
        self.assertEqual(done.returncode, 2)
        self.assertIn("PARKING_JOBS is 'none'", done.stderr)

    def test_called_through_a_symbolic_link(self):
        link = os.path.join(self.folder, 'run-tests')
        os.symlink(os.path.join(self.project, 'scripts', 'test'), link)
        done = subprocess.run([link, '--help'], cwd='/', capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0)
        self.assertIn('usage', done.stdout)

    def test_build_folder_of_another_place_is_configured_afresh(self):
        cache = os.path.join(self.project, 'build', 'release', 'CMakeCache.txt')
        os.makedirs(os.path.dirname(cache))
        self.write(cache, 'CMAKE_HOME_DIRECTORY:INTERNAL=/somewhere/else\n')
        self.run_script('test')
        self.assertIn('--fresh', self.called('cmake --preset')[-1])
        self.write(cache, f'CMAKE_HOME_DIRECTORY:INTERNAL={os.path.realpath(self.project)}\n')
        self.run_script('test')
        self.assertNotIn('--fresh', self.called('cmake --preset')[-1])


if __name__ == '__main__':
    unittest.main()
