"""One command repeats the paper's experiments: its quick form leaves a page, and goes on where it was.

usage: reproduce_paper_test.py PARKING_BENCHMARK REPRODUCE_PAPER
"""
import os
import subprocess
import sys
import tempfile


def main(program, script):
    with tempfile.TemporaryDirectory() as folder:
        frames = os.path.join(folder, 'frames')
        subprocess.run([sys.executable, '-B', os.path.join(os.path.dirname(script), '..', 'benchmarks', 'paper', 'make_random_maps'),
                        '--voxels', '--count', '1', '--output', frames], check=True, capture_output=True)
        command = [sys.executable, '-B', script, '--quick', '--program', program, '--results', folder, '--frames', frames]
        for attempt in ('first', 'second'):
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                print(f'{attempt} run: status {done.returncode}: {done.stdout[-500:]} {done.stderr[-500:]}')
                return 1
            with open(os.path.join(folder, 'paper-comparison.md'), encoding='utf-8') as stream:
                page = stream.read()
            for part in ('## The headline claims', 'main effects', 'on 3 generated', '6.25 m'):
                if part not in page and part.replace('on 3', '3') not in page:
                    print(f'{attempt} run: the page lacks "{part}"')
                    return 1
            with open(os.path.join(folder, 'paper-run.md'), encoding='utf-8') as stream:
                page = stream.read()
            for part in ('3 perpendicular tasks and 3 parallel tasks', 'this project\'s pipeline', '100 x 100',
                         '### Perceived frames (2 tasks)'):
                if part not in page:
                    print(f'{attempt} run: paper-run.md lacks "{part}"')
                    return 1
            files = [os.path.join(folder, name, 'benchmark.db') for name in ('factorial_parallel', 'growth')]
            size = [os.path.getsize(file) for file in files]
            size.append(os.path.getmtime(os.path.join(folder, 'word_parallel_printed.json')))
            if attempt == 'first':
                before = size
            elif size != before:
                print('the second run measured again what was there')
                return 1
        bad = subprocess.run([*command, '--frames', '/nowhere'], capture_output=True, text=True, check=False)
        if bad.returncode != 2 or 'holds no scenarios' not in bad.stderr:
            print(f'without frames: status {bad.returncode}: {bad.stderr}')
            return 1
        bad = subprocess.run([sys.executable, '-B', script, '--program', '/nowhere/parking_benchmark'], capture_output=True,
                             text=True, check=False)
        if bad.returncode != 2 or 'is no program' not in bad.stderr:
            print(f'without a program: status {bad.returncode}: {bad.stderr}')
            return 1
    return 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
