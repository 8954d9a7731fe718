#!/usr/bin/env python3
"""So many inputs that a fuzz target makes from those kept, the same every time: a test that fails did so before, too, unless
somebody broke something. `scripts/fuzz` looks for what nobody has seen yet.

usage: random_test.py CORPUS INPUTS [PROGRAM]
"""
import base64
import glob
import os
import subprocess
import sys
import tempfile

SEED = 20261122

# What comes with a sanitizer counts as memory, too.
MEGABYTES = 1000 if os.environ.get('PARKING_SANITIZER') else 500


def main(corpus, inputs, program):
    with tempfile.TemporaryDirectory() as folder:
        # New inputs go into the first folder. What is compared and how small an input could be differs from run to run.
        done = subprocess.run(
            [program, f'-seed={SEED}', f'-runs={inputs}', '-timeout=60', f'-rss_limit_mb={MEGABYTES}', '-max_len=4096',
             '-use_cmp=0', '-reduce_inputs=0', f'-artifact_prefix={folder}/', folder, corpus],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        print(done.stdout.decode(errors='replace')[-3000:])
        if done.returncode != 0:
            for file in glob.glob(folder + '/*-*'):
                with open(file, 'rb') as stream:
                    print('FOUND something; the input, in base64:', base64.b64encode(stream.read()).decode())
    return 1 if done.returncode != 0 else 0


if __name__ == '__main__':
    if len(sys.argv) < 4:
        print('SKIPPED: clang with libFuzzer is not installed (Debian: clang, libclang-rt-dev)')
        sys.exit(77)
    sys.exit(main(*sys.argv[1:4]))
