#!/usr/bin/env python3
"""Is no file of code longer than 500 lines, but for those that long_files.txt excuses?

usage: check_length.py ROOT
"""
import os
import sys

from project_files import is_code, project_files, report, text_of

LIMIT = 500
EXCUSES = 'tests/style/long_files.txt'


def excuses(root):
    """path -> reason"""
    found = {}
    for line in (text_of(root, EXCUSES) or '').splitlines():
        if line.strip() and not line.startswith('#'):
            path, _, reason = line.partition(':')
            found[path.strip()] = reason.strip()
    return found


def main(root):
    excused = excuses(root)
    findings = [f'{EXCUSES}: {path} is listed without a reason' for path, reason in excused.items() if not reason]
    long_files = set()
    for name in project_files(root):
        if is_code(root, name):
            lines = len((text_of(root, name) or '').splitlines())
            if lines > LIMIT:
                long_files.add(name)
                if name not in excused:
                    findings.append(f'{name}: {lines} lines')
    findings += [f'{EXCUSES}: {path} is not longer than {LIMIT} lines' for path in excused if path not in long_files]
    report(findings, f'At most {LIMIT} lines; split the file by its jobs, or give the reason in {EXCUSES}.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
