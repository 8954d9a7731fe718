"""`pip install .` into a virtual environment, without a network, where scikit-build-core is installed.

usage: pip_test.py ROOT FOLDER
"""
import os
import shutil
import subprocess
import sys
import venv

from install_test import PROGRAM

SKIPPED = 77


def main(root, folder):
    try:
        import scikit_build_core  # pylint: disable=unused-import,import-outside-toplevel
        import pip  # pylint: disable=unused-import,import-outside-toplevel
    except ImportError as error:
        print(f'SKIPPED: {error} (Debian packages python3-scikit-build-core, from Debian 13 on, and python3-pip)')
        return SKIPPED
    shutil.rmtree(folder, ignore_errors=True)
    venv.create(folder, system_site_packages=True, with_pip=False)
    python = os.path.join(folder, 'bin', 'python')
    done = subprocess.run([python, '-m', 'pip', 'install', '--no-build-isolation', '--no-deps', '--no-index',
                           '--config-settings=build-dir=' + os.path.join(folder, 'build'), root], check=False)
    if done.returncode != 0:
        return 'pip could not install the package'
    done = subprocess.run([python, '-B', '-c', PROGRAM], cwd='/', text=True, capture_output=True, check=False)
    print(done.stdout, done.stderr)
    return None if done.returncode == 0 and folder in done.stdout else 'the installed package does not work'


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
