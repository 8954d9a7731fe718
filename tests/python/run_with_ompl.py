"""Runs pytest in a virtual environment with OMPL's own Python package, which it creates on first use.

usage: run_with_ompl.py FOLDER TEST...
"""
import os
import subprocess
import sys
import venv

SKIPPED = 77
OMPL = 'ompl>=2.0.1'


def main(folder, *tests):
    python = os.path.join(folder, 'bin', 'python')
    if not os.path.exists(python):
        venv.create(folder, system_site_packages=True, with_pip=False)
    has_ompl = [python, '-B', '-c', 'from ompl import base; base.SE2StateType']
    if subprocess.run(has_ompl, capture_output=True, check=False).returncode != 0:
        subprocess.run([python, '-m', 'pip', 'install', '--quiet', '--timeout', '20', '--retries', '1', OMPL], check=False)
    if subprocess.run(has_ompl, capture_output=True, check=False).returncode != 0:
        print(f"SKIPPED: OMPL's Python package is not available here (pip install '{OMPL}')")
        return SKIPPED
    run_pytest = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'run_pytest')
    return subprocess.run([python, '-B', run_pytest, *tests], check=False).returncode


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
