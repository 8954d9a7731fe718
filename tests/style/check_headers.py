#!/usr/bin/env python3
"""Does every header of the libraries compile on its own?

usage: check_headers.py ROOT COMPILE_COMMANDS.json

A header that is the first include of a library's source has been compiled so when the project was built. Only the
others are compiled here, without making code, with the options of the source that is nearest to them.
"""
import json
import os
import re
import shlex
import subprocess
import sys

from check_dependencies import LIBRARIES
from project_files import project_files, report, text_of

FIRST_INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
WITH_VALUE = ('-o', '-c')


def first_include(text):
    """What a source includes first, or None."""
    found = FIRST_INCLUDE.search(text)
    return found.group(1) if found else None


def compiler_options(command):
    """A compile command without its source and what is made of it."""
    words = iter(shlex.split(command))
    return [word for word in words if not (word in WITH_VALUE and next(words))]


def main(root, compile_commands):
    with open(compile_commands, encoding='utf-8') as stream:
        entries = json.load(stream)
    folders = tuple(f'{library}/' for library in LIBRARIES)
    commands = {os.path.relpath(entry['file'], root): entry for entry in entries}
    commands = {name: entry for name, entry in commands.items() if name.startswith(folders)}
    compiled = {first_include(text_of(root, name)) for name in commands}
    findings = []
    for name in project_files(root):
        if not name.startswith(folders) or not name.endswith('.h') or name in compiled:
            continue
        folder = os.path.dirname(name)
        nearest = max(commands, key=lambda source: len(os.path.commonpath([folder, os.path.dirname(source)])))
        done = subprocess.run(compiler_options(commands[nearest]['command']) + ['-fsyntax-only', '-x', 'c++', '-'],
                              input=f'#include "{name}"\n', cwd=commands[nearest]['directory'],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            findings.append(f'{name}: does not compile on its own:\n{done.stderr}')
    report(findings, 'A header includes all that it uses.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]), sys.argv[2])
