#!/usr/bin/env python3
"""Does the README's table list the planner's parameters, with their defaults?

usage: check_readme_parameters.py ROOT LIST_PARAMETERS [--update]
LIST_PARAMETERS is the program built from list_parameters.cpp. --update rewrites the table; the meanings, which only the
table has, are kept, and those of new parameters are left for you to write.
"""
import os
import re
import subprocess
import sys

from project_files import text_of

TABLE = re.compile(r'(<!-- parameters:begin -->\n)(.*?)(<!-- parameters:end -->)', re.DOTALL)
HEADER = '| parameter | default | values | meaning |\n| --- | --- | --- | --- |\n'


def values(suggestion):
    """OMPL's range suggestion in words: '0.:.1:10.' -> '0 to 10', '0,1' -> 'true, false'."""
    if suggestion == '0,1':
        return '`true`, `false`'
    if re.fullmatch(r'[\d.]+:[\d.]+:[\d.]+', suggestion):
        low, _, high = suggestion.split(':')
        return f'{float(low):g} to {float(high):g}'
    return ', '.join(f'`{value}`' for value in suggestion.split(','))


def default(value, suggestion):
    if suggestion == '0,1':
        return '`true`' if value in ('1', 'true') else '`false`'
    try:
        return f'{float(value):g}'
    except ValueError:
        return f'`{value}`'


def row(name, value, suggestion, meaning):
    return f'| `{name}` | {default(value, suggestion)} | {values(suggestion)} | {meaning} |\n'


def main(root, program, update):
    readme = text_of(root, 'README.md')
    table = TABLE.search(readme)
    if not table:
        return 'README.md: no table between <!-- parameters:begin --> and <!-- parameters:end -->'
    meanings = dict(re.findall(r'^\| `(\w+)` \|.*\| ([^|]*) \|$', table.group(2), re.MULTILINE))
    listed = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
    parameters = [line.split('\t') for line in listed]
    if update:
        rows = [row(name, value, suggestion, meanings.get(name, '')) for name, value, suggestion in parameters]
        with open(os.path.join(root, 'README.md'), 'w', encoding='utf-8') as file:
            file.write(readme[:table.start(2)] + HEADER + ''.join(rows) + readme[table.end(2):])
        return None
    for name, value, suggestion in parameters:
        if not meanings.get(name, '').strip():
            return f'README.md: the table does not say what {name} means'
        if row(name, value, suggestion, meanings[name]) not in table.group(2):
            return f'README.md: the row of {name} is not "{row(name, value, suggestion, "...").strip()}"'
    unknown = sorted(set(meanings) - {parameter[0] for parameter in parameters})
    return f'README.md: the planner has no parameter {unknown[0]}' if unknown else None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], '--update' in sys.argv[3:]))
