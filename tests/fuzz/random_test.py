#!/usr/bin/env python3
"""All fuzz targets by turns for a minute in all, from the inputs kept; `scripts/fuzz` does more.

usage: random_test.py CORPUS SECONDS PROGRAM...
"""
import base64
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

# What comes with a sanitizer counts as memory, too.
MEGABYTES = 1000 if os.environ.get('PARKING_SANITIZER') else 500


def main(corpus, seconds, programs):
    failed = []
    each = max(1, int(seconds) // len(programs))
    for program in programs:
        name = os.path.basename(program)[len('fuzz_'):]
        folder = tempfile.mkdtemp()
        done = subprocess.run(
            [program, f'-max_total_time={each}', '-timeout=120', f'-rss_limit_mb={MEGABYTES}', '-max_len=4096',
             '-print_final_stats=1', f'-artifact_prefix={folder}/', os.path.join(folder), os.path.join(corpus, name)],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        text = done.stdout.decode(errors='replace')
        tried = re.search(r'number_of_executed_units: *(\d+)', text)
        print(f'{name}: {tried.group(1) if tried else "?"} inputs', flush=True)
        if done.returncode != 0:
            failed.append(name)
            print(text[-3000:])
            for file in glob.glob(folder + '/*-*'):
                with open(file, 'rb') as stream:
                    print('the input, in base64:', base64.b64encode(stream.read()).decode())
        shutil.rmtree(folder)
    if failed:
        print('FOUND something:', ' '.join(failed))
    sys.exit(1 if failed else 0)


if __name__ == '__main__':
    if len(sys.argv) < 4:
        print('SKIPPED: clang with libFuzzer is not installed (Debian: clang, libclang-rt-dev)')
        sys.exit(77)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
