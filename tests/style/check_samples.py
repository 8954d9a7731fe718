#!/usr/bin/env python3
"""Are the C++ blocks of the README and the guides lines of programs that the tests compile and run?

The README has a whole program, all of its source but the comment at the top. Blocks of the guides are runs of lines.

usage: check_samples.py ROOT
"""
import os
import re
import sys
import textwrap

from project_files import project_files, report, text_of

WHOLE = ('README.md', 'examples/readme_example.cpp')
GUIDES = ('docs/getting-started.md', 'docs/using-the-planner.md')
COMPILED = ('examples/', 'tests/package/core_consumer/')
BLOCK = re.compile(r'^```cpp\n(.*?)^```$', re.MULTILINE | re.DOTALL)


def is_run_of(lines, source):
    """Are the lines in the source, one after another, but for the same indentation of all?"""
    return any(textwrap.dedent('\n'.join(source[at:at + len(lines)])).split('\n') == lines
               for at in range(len(source) - len(lines) + 1) if source[at].strip() == lines[0].strip())


def main(root):
    files = project_files(root)
    page, program = WHOLE
    source = text_of(root, program)
    findings = []
    if BLOCK.findall(text_of(root, page)) != [source[source.index('#include'):]]:
        findings.append(f'{page}: its program is not that of {program}')
    sources = [text_of(root, name).split('\n') for name in files
               if name.startswith(COMPILED) and name.endswith(('.cpp', '.h'))]
    for page in (name for name in GUIDES if name in files):
        for block in BLOCK.findall(text_of(root, page)):
            lines = block.rstrip('\n').split('\n')
            if not any(is_run_of(lines, source) for source in sources):
                findings.append(f'{page}: no compiled program has the lines from "{lines[0].strip()}" on')
    report(findings, f'Copy the lines from a program in {" or ".join(COMPILED)}.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
