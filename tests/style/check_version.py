#!/usr/bin/env python3
"""Does everything that names the version name the one in CMakeLists.txt?

usage: check_version.py ROOT
"""
import os
import re
import sys

from project_files import report, text_of

# file -> what it says of the version: the expression finds it, and there must be as many as the second number.
NAMED = {
    'CHANGELOG.md': (r'\A(?:(?!^## ).)*^## (\S+)', 1),  # the first heading
    'package.xml': (r'<version>(.*?)</version>', 1),
    'integrations/nav2/package.xml': (r'<version>(.*?)</version>', 1),
    'CITATION.cff': (r'^version: *["\']?([^"\'\s]+)', 1),
    'pyproject.toml': (r'^version *= *["\']([^"\']+)', 0),
}
# These take it from there.
FOLLOW = {
    'pyproject.toml': (r'^dynamic = \["version"\]$', r'^input = "CMakeLists\.txt"$'),
    'scripts/package': (r'libompl-improved-astar\$soversion',),
}


def main(root):
    def text(name):
        return text_of(root, name) if os.path.isfile(os.path.join(root, name)) else ''
    found = re.findall(r'^project\(\w+\s+VERSION ([0-9.]+)$', text('CMakeLists.txt'), re.MULTILINE)
    if len(found) != 1:
        report(['CMakeLists.txt: project() says no version'], '')
    findings = []
    for name, (expression, least) in NAMED.items():
        said = re.findall(expression, text(name), re.MULTILINE | re.DOTALL)
        if len(said) < least:
            findings.append(f'{name}: names no version')
        findings += [f'{name}: names version {each}, CMakeLists.txt {found[0]}' for each in said if each != found[0]]
    for name, expressions in FOLLOW.items():
        findings += [f'{name}: does not take the version from CMakeLists.txt ({expression})' for expression in expressions
                     if not re.search(expression, text(name), re.MULTILINE)]
    report(findings, 'The version is that of project() in CMakeLists.txt.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
