#!/usr/bin/env python3
"""Does no file name a folder of the machine that it was written on?

usage: check_paths.py ROOT
"""
import os
import re
import sys

from project_files import project_files, report, text_of

# Absolute paths that exist on somebody's machine only. In documentation, a home is spelled ~.
MACHINE_PATH = re.compile(r'(?<![\w.$}~/-])/(?:home|Users|root|work|workspace|workspaces|mnt|media)/[\w.-]+')


def main(root):
    findings = []
    for name in project_files(root):
        text = text_of(root, name)
        for number, line in enumerate((text or '').splitlines(), 1):
            for match in MACHINE_PATH.finditer(line):
                findings.append(f'{name}:{number}: {match.group(0)}')
    report(findings, 'Paths are relative to the project, or come from the user.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
