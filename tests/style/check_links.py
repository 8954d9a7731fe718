#!/usr/bin/env python3
"""Do the links and pictures of the documentation that lead to files of the project lead to files that exist?

usage: check_links.py ROOT
"""
import os
import re
import sys

from project_files import project_files, report, text_of

LINK = re.compile(r'\]\(([^)\s]+)\)|\b(?:src|href)="([^"]+)"')
CODE_BLOCK = re.compile(r'^```.*?^```', re.MULTILINE | re.DOTALL)


def main(root):
    files = project_files(root)
    folders = {os.path.dirname(name) for name in files}
    findings = []
    for name in files:
        if not name.endswith('.md'):
            continue
        for link in LINK.finditer(CODE_BLOCK.sub('', text_of(root, name))):
            target = (link.group(1) or link.group(2)).split('#')[0]
            if not target or ':' in target or target.startswith('../../actions/'):  # pages of the host of the project
                continue
            path = os.path.normpath(os.path.join(os.path.dirname(name), target))
            if path not in files and not any(folder == path or folder.startswith(path + '/') for folder in folders):
                findings.append(f'{name}: there is no {target}')
    report(findings, 'Links are relative to the file that they are in; the target must be tracked by git.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
