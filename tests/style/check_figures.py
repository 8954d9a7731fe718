#!/usr/bin/env python3
"""Does every figure that a page quotes stand in docs/results/figures.json, and with the text that the page shows?

usage: check_figures.py ROOT
"""
import json
import os
import re
import sys

from project_files import project_files, report, text_of

MARKER = re.compile(r'<!--figure ([\w.*+-]+)-->(.*?)<!--/figure-->', re.DOTALL)
BEGIN, END = re.compile(r'<!--\s*figure\b'), re.compile(r'<!--\s*/figure\b')
FIGURES = 'docs/results/figures.json'
CODE = re.compile(r'```.*?```|`[^`\n]*`', re.DOTALL)  # shows how a marker is written


def findings_in(name, text, figures):
    text = CODE.sub('', text)
    markers = MARKER.findall(text)
    if not len(BEGIN.findall(text)) == len(END.findall(text)) == len(markers):
        yield f'{name}: a figure is written <!--figure NAME-->text<!--/figure-->'
    for figure, shown in markers:
        if figure not in figures:
            yield f'{name}: {FIGURES} has no {figure}'
        elif figures[figure]['text'] != shown:
            yield f'{name}: {figure} is {figures[figure]["text"]}, not {shown}'


def main(root):
    figures = {}
    if os.path.exists(os.path.join(root, FIGURES)):
        with open(os.path.join(root, FIGURES), encoding='utf-8') as stream:
            figures = json.load(stream)
    findings = [f'{FIGURES}: {name}: lacks {member}' for name, figure in figures.items()
                for member in ('value', 'text', 'command') if member not in figure]
    for name in project_files(root):
        if name.endswith('.md'):
            findings += findings_in(name, text_of(root, name), figures)
    report(findings, 'scripts/results writes the figures; scripts/results --pages-only does so from what it has measured.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
