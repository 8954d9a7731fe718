#!/usr/bin/env python3
"""Does Doxygen build the documentation without a warning: does what docstrings and documents name exist, and is every class
documented? Members whose names say it all may go without.

usage: check_docs.py ROOT
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

from project_files import report

MEMBER = re.compile(r': warning: Member .* is not documented\.$')


def main(root):
    if not shutil.which('doxygen'):
        report(['doxygen is not installed'], 'Its Debian package is doxygen; scripts/test installs it.')
    with tempfile.TemporaryDirectory() as output:
        configuration = f'@INCLUDE = Doxyfile\nOUTPUT_DIRECTORY = "{output}"\nWARN_IF_UNDOCUMENTED = YES\n'
        built = subprocess.run(['doxygen', '-'], input=configuration, cwd=root, capture_output=True, text=True,
                               check=False)
        said = [line.replace(root + os.sep, '') for line in built.stderr.splitlines()
                if line.strip() and not MEMBER.search(line)]
        if not said and not os.path.exists(os.path.join(output, 'docs', 'index.html')):
            said = [f'doxygen wrote no pages, status {built.returncode}']
    report(said, 'Doxyfile says what Doxygen reads, and what it warns of.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
