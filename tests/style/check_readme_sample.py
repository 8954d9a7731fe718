#!/usr/bin/env python3
"""Are the programs in the README and the guide those that are compiled: the marked lines of examples/readme_example.cpp?

usage: check_readme_sample.py ROOT [--update]    (--update writes the lines into the documents)
"""
import os
import re
import sys
import textwrap

from project_files import text_of

SOURCE = 'examples/readme_example.cpp'
# document -> the marks in the source, and in the document
PLACES = {'README.md': ('readme', 'sample'), 'docs/using.md': ('program', 'program')}
ANY_MARK = re.compile(r'^ *// \w+:(begin|end)\n', re.MULTILINE)


def marked_lines(source, mark):
    """The lines between the marks, without the indentation that they share; None where there are no marks."""
    found = re.search(rf'^ *// {mark}:begin\n(.*?)^ *// {mark}:end$', source, re.MULTILINE | re.DOTALL)
    return textwrap.dedent(ANY_MARK.sub('', found.group(1))) if found else None


def fault_of(root, document, update):
    """What is wrong with one document, or None."""
    source_mark, mark = PLACES[document]
    text = text_of(root, document)
    wanted = marked_lines(text_of(root, SOURCE), source_mark)
    block = re.search(rf'(<!-- {mark}:begin -->\n```cpp\n)(.*?)(```\n<!-- {mark}:end -->)', text, re.DOTALL)
    if wanted is None:
        return f'{SOURCE}: no lines between "// {source_mark}:begin" and "// {source_mark}:end"'
    if not block:
        return f'{document}: no code block between <!-- {mark}:begin --> and <!-- {mark}:end -->'
    if block.group(2) == wanted:
        return None
    if not update:
        return f'{document}: its program is not that of {SOURCE}; check_readme_sample.py ROOT --update copies it'
    with open(os.path.join(root, document), 'w', encoding='utf-8') as file:
        file.write(text[:block.start(2)] + wanted + text[block.end(2):])
    return None


def main(root, update):
    faults = [fault_of(root, document, update) for document in PLACES]
    return '\n'.join(fault for fault in faults if fault) or None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), '--update' in sys.argv[2:]))
