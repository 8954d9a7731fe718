#!/usr/bin/env python3
"""Do all shell scripts pass shellcheck?

usage: check_shell.py ROOT
"""
import os
import shutil
import subprocess
import sys

from project_files import interpreter, project_files, report, text_of


def main(root):
    if not shutil.which('shellcheck'):
        report(['shellcheck is not installed'], 'scripts/test installs it.')
    scripts = [name for name in project_files(root)
               if name.endswith('.sh') or interpreter(text_of(root, name) or '') in ('sh', 'bash', 'dash')]
    if not scripts:
        report(['no shell scripts'], 'Is this the root of the project?')
    checked = subprocess.run(['shellcheck'] + scripts, cwd=root, capture_output=True, text=True, check=False)
    report([checked.stdout + checked.stderr] if checked.returncode != 0 else [], 'shellcheck objects.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
