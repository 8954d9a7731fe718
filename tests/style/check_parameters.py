#!/usr/bin/env python3
"""Is the table of docs/parameters.md of parameters what the planner has?

usage: check_parameters.py ROOT LIST_PARAMETERS [--update]
LIST_PARAMETERS is the program built from list_parameters.cpp, which prints the table. --update puts it there.
"""
import os
import re
import subprocess
import sys

from project_files import text_of

DOCUMENT = 'docs/parameters.md'
TABLE = re.compile(r'(?<=<!-- parameters:begin -->\n).*?(?=<!-- parameters:end -->)', re.DOTALL)


def main(root, program, update):
    text = text_of(root, DOCUMENT)
    table = TABLE.search(text)
    if not table:
        return f'{DOCUMENT}: no table between <!-- parameters:begin --> and <!-- parameters:end -->'
    wanted = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    if update:
        with open(os.path.join(root, DOCUMENT), 'w', encoding='utf-8') as file:
            file.write(text[:table.start()] + wanted + text[table.end():])
        return None
    present = table.group().splitlines()
    for row in wanted.splitlines():
        if row not in present:
            return f'{DOCUMENT}: the table of parameters lacks this row (--update rewrites it): {row}'
    extra = [row for row in present if row not in wanted.splitlines()]
    return f'{DOCUMENT}: the planner has no such parameter: {extra[0]}' if extra else None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], '--update' in sys.argv[3:]))
