#!/usr/bin/env python3
"""Are all C++ sources formatted as .clang-format says?

usage: check_format.py ROOT    (with clang-format 14: other versions break some lines elsewhere)
"""
import re
import shutil
import subprocess
import sys

from project_files import SKIPPED, project_files, report

VERSION = 14


def clang_format():
    for name in (f'clang-format-{VERSION}', 'clang-format'):
        if shutil.which(name):
            said = subprocess.run([name, '--version'], capture_output=True, text=True, check=True).stdout
            found = re.search(r'version (\d+)', said)
            if found and int(found.group(1)) == VERSION:
                return name
            print(f'SKIPPED: {name} is version {found.group(1) if found else said.strip()}, not {VERSION}')
            sys.exit(SKIPPED)
    print('clang-format is not installed; scripts/test installs it')
    sys.exit(1)


def main(root):
    program = clang_format()
    sources = [name for name in project_files(root) if name.endswith(('.h', '.cpp'))]
    if not sources:
        report(['no C++ sources'], 'Is this the root of the project?')
    checked = subprocess.run([program, '--dry-run', '-Werror', '--style=file'] + sources, cwd=root,
                             capture_output=True, text=True, check=False)
    unformatted = sorted(set(re.findall(r'^(\S+?):\d+:\d+: (?:error|warning)', checked.stderr, re.MULTILINE)))
    if checked.returncode != 0 and not unformatted:
        report([checked.stderr.strip()], 'clang-format failed.')
    report(unformatted, f'Not formatted; {program} -i FILE... mends it.')


if __name__ == '__main__':
    main(sys.argv[1])
