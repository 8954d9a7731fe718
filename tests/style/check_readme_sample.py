#!/usr/bin/env python3
"""Is the program in the README the one that is compiled: the marked lines of examples/readme_example.cpp?

usage: check_readme_sample.py ROOT [--update]    (--update writes the lines into the README)
"""
import os
import re
import sys

from project_files import text_of

SOURCE = 'examples/readme_example.cpp'
MARKED = re.compile(r'^ *// readme:begin\n(.*?)^ *// readme:end$', re.MULTILINE | re.DOTALL)
BLOCK = re.compile(r'(<!-- sample:begin -->\n```cpp\n)(.*?)(```\n<!-- sample:end -->)', re.DOTALL)


def main(root, update):
    readme = text_of(root, 'README.md')
    marked, block = MARKED.search(text_of(root, SOURCE)), BLOCK.search(readme)
    if not marked:
        return f'{SOURCE}: no lines between "// readme:begin" and "// readme:end"'
    if not block:
        return 'README.md: no code block between <!-- sample:begin --> and <!-- sample:end -->'
    if block.group(2) == marked.group(1):
        return None
    if not update:
        return f'README.md: its program is not that of {SOURCE}; check_readme_sample.py ROOT --update copies it'
    with open(os.path.join(root, 'README.md'), 'w', encoding='utf-8') as file:
        file.write(readme[:block.start(2)] + marked.group(1) + readme[block.end(2):])
    return None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), '--update' in sys.argv[2:]))
