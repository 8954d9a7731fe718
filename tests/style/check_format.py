#!/usr/bin/env python3
"""Are all C++ sources formatted as .clang-format says?

usage: check_format.py ROOT

The sources are as clang-format 14 writes them. Later versions break lines in and before lambdas elsewhere, and align the
comment after a brace differently; where such a version is installed, differences of these kinds are counted and said, and
all others are faults.
"""
import difflib
import os
import re
import shutil
import subprocess
import sys

from project_files import project_files, report, text_of

VERSION = 14
LAMBDA = re.compile(r'\[[^\[\]]*\]\s*(\(|\{)')
REACH = 8  # lines before a difference in which its statement began
FOLLOWS_BRACE = re.compile(r'^\s*\}\s+// namespace')


def clang_format():
    """Program and version; the project's version where there are several."""
    for name in (f'clang-format-{VERSION}', 'clang-format'):
        if shutil.which(name):
            said = subprocess.run([name, '--version'], capture_output=True, text=True, check=True).stdout
            found = re.search(r'version (\d+)', said)
            if found:
                return name, int(found.group(1))
    print('clang-format is not installed: its Debian package is clang-format; scripts/test installs it')
    sys.exit(1)


def without_blanks(lines):
    return ''.join(''.join(lines).split())


def is_known_difference(before, old, new):
    """Do versions differ in such a place? Only in blanks, and only at lambdas, comments after braces, and products."""
    if without_blanks(old) != without_blanks(new):
        return False
    if all(FOLLOWS_BRACE.match(line) for line in old):
        return True
    if len(old) == len(new) == 1 and re.sub(r' ?\* ?', '*', old[0]) == re.sub(r' ?\* ?', '*', new[0]):
        return True  # a product in a template argument, which 14 takes for a pointer
    return LAMBDA.search(''.join(before + old)) is not None


def faults_of(program, root, name):
    """Lines of a file that another version writes otherwise for no known reason, and the number of known ones."""
    old = text_of(root, name).splitlines(keepends=True)
    done = subprocess.run([program, '--style=file', name], cwd=root, capture_output=True, text=True, check=True)
    new = done.stdout.splitlines(keepends=True)
    faults, known = [], 0
    for kind, begin, end, new_begin, new_end in difflib.SequenceMatcher(None, old, new, False).get_opcodes():
        if kind == 'equal':
            continue
        if is_known_difference(old[max(0, begin - REACH):begin], old[begin:end], new[new_begin:new_end]):
            known += 1
        else:
            faults.append(f'{name}:{begin + 1}')
    return faults, known


def main(root):
    program, version = clang_format()
    sources = [name for name in project_files(root) if name.endswith(('.h', '.cpp'))]
    if not sources:
        report(['no C++ sources'], 'Is this the root of the project?')
    checked = subprocess.run([program, '--dry-run', '-Werror', '--style=file'] + sources, cwd=root,
                             capture_output=True, text=True, check=False)
    unformatted = sorted(set(re.findall(r'^(\S+?):\d+:\d+: (?:error|warning)', checked.stderr, re.MULTILINE)))
    if checked.returncode != 0 and not unformatted:
        report([checked.stderr.strip()], 'clang-format failed.')
    if version != VERSION:
        judged = [faults_of(program, root, name) for name in unformatted]
        unformatted = [fault for faults, _ in judged for fault in faults]
        print(f'clang-format {version}, not {VERSION}: {sum(known for _, known in judged)} places of the kinds in which '
              'the versions differ are not judged')
    report(unformatted, f'Not formatted; clang-format-{VERSION} -i FILE... fixes it.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
