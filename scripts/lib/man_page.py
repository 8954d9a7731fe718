#!/usr/bin/env python3
"""Writes the manual page of a program from what it says with --help.

usage: man_page.py PROGRAM VERSION FILE
"""
import os
import re
import subprocess
import sys

SUMMARIES = {'parking_plan': 'plan how a car parks', 'parking_benchmark': 'compare planners on parking problems'}
OPTION = re.compile(r'^  (-\S+(?: [A-Z|.\-/a-z0-9=]+)?)(?:  +(.*))?$')


def escaped(text):
    """Text that troff takes as it is."""
    text = text.replace('\\', '\\e').replace('-', '\\-')
    return '\\&' + text if text.startswith(('.', "'")) else text


def paragraphs(lines):
    """Blocks of lines between blank ones."""
    block = []
    for line in [*lines, '']:
        if line.strip():
            block.append(line)
        elif block:
            yield block
            block = []


def option_lines(block):
    """The options of a help text as tagged paragraphs; a line that names no option goes on with the one before."""
    for line in block:
        found = OPTION.match(line)
        if found:
            yield '.TP'
            yield f'.B {escaped(found.group(1))}'
            yield from [escaped(found.group(2))] if found.group(2) else []
        else:
            yield escaped(line.strip())


def list_lines(block):
    """A list of names with meanings as tagged paragraphs."""
    for line in block:
        name, _, meaning = line.strip().partition(' ')
        yield from ('.TP', f'.B {escaped(name)}', escaped(meaning.strip()))


def page(program, version, text):
    """The manual page. Throws ValueError when the help text is not of the kind that this understands."""
    blocks = list(paragraphs(text.splitlines()))
    if not blocks or not blocks[0][0].startswith(f'usage: {program} '):
        raise ValueError(f'{program} --help does not begin with "usage: {program}"')
    synopsis = blocks[0][0][len(f'usage: {program} '):]
    result = [f'.TH {program.upper()} 1 "" "{program} {version}" "User Commands"', '.SH NAME',
              f'{escaped(program)} \\- {SUMMARIES[program]}', '.SH SYNOPSIS', f'.B {escaped(program)}', escaped(synopsis),
              '.SH DESCRIPTION']
    for block in blocks[1:]:
        title, _, rest = block[0].partition(':')
        if re.fullmatch('[A-Z][a-z]+', title) and len(block) > 1 and not rest:
            result.append(f'.SH {title.upper()}')
            result += option_lines(block[1:]) if title == 'Options' else list_lines(block[1:])
        elif re.fullmatch('[A-Z][a-z]+', title) and rest:
            heading = 'EXIT STATUS' if title == 'Status' else title.upper()
            result += [f'.SH {heading}', *(escaped(line.strip()) for line in [rest, *block[1:]])]
        else:
            result += ['.PP', *(escaped(line.strip()) for line in block)]
    if not any(line == '.SH OPTIONS' for line in result):
        raise ValueError(f'{program} --help lists no options')
    return '\n'.join(result) + '\n'


def main(program, version, file):
    name = os.path.basename(program)
    text = subprocess.run([program, '--help'], check=True, capture_output=True, text=True).stdout
    with open(file, 'w', encoding='utf-8') as stream:
        stream.write(page(name, version, text))


if __name__ == '__main__':
    main(*sys.argv[1:])
