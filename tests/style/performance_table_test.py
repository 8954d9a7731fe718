#!/usr/bin/env python3
"""scripts/performance-table: are the tables in place, and does it write them whole or not at all?"""
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(ROOT, 'scripts', 'performance-table')
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader('performance_table', SCRIPT)
SPEC = importlib.util.spec_from_loader('performance_table', LOADER)
script = importlib.util.module_from_spec(SPEC)
LOADER.exec_module(script)


class EveryBenchmark(dict):
    """Results in which every benchmark took 1234 ns and every counter is 12."""

    def __contains__(self, name):
        return True

    def __getitem__(self, name):
        return 1234.0, EveryCounter()


class EveryCounter(dict):
    def __getitem__(self, name):
        return 12.0


def new_texts():
    results = script.Results()
    results.rows = EveryBenchmark()
    return script.texts(results, 'one core')


class PerformanceTableTest(unittest.TestCase):
    def test_tables_of_the_project_are_whole(self):
        for file in script.TABLES:
            self.assertEqual(script.faults(file, script.read(file)), [])

    def test_what_it_writes_is_a_whole_table(self):
        for file, text in new_texts().items():
            before = script.read(file)
            after = script.replaced(file, before, text)
            self.assertEqual(script.faults(file, after), [])
            # Nothing but the table changes, and writing it again changes nothing.
            self.assertEqual(script.block(file).sub('', after), script.block(file).sub('', before))
            self.assertEqual(script.replaced(file, after, text), after)

    def test_faults_are_found(self):
        for file, text in new_texts().items():
            marker, header, _ = script.TABLES[file]
            good = f'<!-- {marker}:begin -->\n{text}<!-- {marker}:end -->\n'
            self.assertEqual(script.faults(file, good), [])
            for bad in (good.replace(f'{marker}:begin', 'begin'), good.replace(f'{marker}:end', 'end'), good + good,
                        good.replace(header, '| a | b |'), good.replace('1.2 us |', '1.2 us', 1),
                        good.replace(script.COMMAND, 'hand'),
                        f'<!-- {marker}:begin -->\n<!-- {marker}:end -->\n'):
                self.assertNotEqual(script.faults(file, bad), [], bad)

    def test_a_missing_marker_or_benchmark_is_named(self):
        with self.assertRaisesRegex(script.Failure, 'docs/performance.md: 0 places between'):
            script.replaced('docs/performance.md', 'nothing here', 'text')
        with self.assertRaisesRegex(script.Failure, 'no benchmark stateCheck'):
            script.readme_table(script.Results())

    def test_medians_are_taken(self):
        results = script.Results()
        results.add({'benchmarks': [
            {'name': 'a', 'run_name': 'a', 'cpu_time': 7.0, 'time_unit': 'us'},
            {'name': 'a_mean', 'run_name': 'a', 'aggregate_name': 'mean', 'cpu_time': 9.0, 'time_unit': 'us'},
            {'name': 'a_median', 'run_name': 'a', 'aggregate_name': 'median', 'cpu_time': 2.0, 'time_unit': 'us'}]})
        self.assertEqual(results.time('a'), 2000.0)

    def test_files_are_written_whole_or_not_at_all(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'file.md')
            with open(path, 'w', encoding='utf-8') as file:
                file.write('before')
            os.chmod(path, 0o640)
            script.write(path, 'after')
            with open(path, encoding='utf-8') as file:
                self.assertEqual(file.read(), 'after')
            self.assertEqual(os.stat(path).st_mode & 0o777, 0o640)
            with self.assertRaises(TypeError):
                script.write(path, None)
            with open(path, encoding='utf-8') as file:
                self.assertEqual(file.read(), 'after')
            self.assertEqual(os.listdir(folder), ['file.md'])

    def test_numbers_as_text(self):
        for value, text in ((0.5, '0.5 ns'), (42.9, '43 ns'), (141.4, '141 ns'), (1362, '1.4 us'), (4.1e6, '4.1 ms'),
                            (278e6, '278 ms'), (5.2e10, '52 s')):
            self.assertEqual(script.duration(value), text)

    def test_wrong_options_end_with_status_2(self):
        for arguments in (['--fast'], ['--repetitions', '0'], ['--seconds', '-1']):
            done = subprocess.run([sys.executable, '-B', SCRIPT, *arguments], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 2, done.stderr)


if __name__ == '__main__':
    unittest.main()
