#!/usr/bin/env python3
"""Are there words that a reader of the field stumbles over, where this project has a term?

usage: check_glossary.py ROOT [PLACE...]
PLACE: pages, headers (comments of headers), messages (texts in sources: --help, errors). Default: those that
are free of these words already.
"""
import os
import re
import sys

from pages import BUDGETS
from project_files import project_files, report, text_of

INSTEAD = {
    r'dear(?:er|est|ly)?': 'costly, higher cost',
    r'anew': 'again, restarts',
    r'by turns': 'alternately',
    r'nobody|somebody': 'name the actor',
    r'asked for': 'requested, required',
    r'promise[sd]?': 'lower bound, expected, guaranteed',
    r'patience': 'stall limit, time limit',
    r'nonsense': 'invalid result',
    r'to be had': 'available',
    r'comes? near': 'approaches',
    r'so many': 'that many, the number of',
    r'wherever|whatever': 'if, any',
    r'mended': 'fixed',
    r'afterthought': 'post-search',
    r'foretold': 'predicted',
    r'fresh quer(?:y|ies)': 'held-out query',
    r'in the median': 'median',
    r'quick machine': 'name the CPU',
    r'(?:is|are) told of': 'receives',
    r'in touch with': 'adjacent to, touching',
}
# A line break may stand where a phrase has a space.
WORDS = re.compile(r'\b(?:' + '|'.join(f'({word})' for word in INSTEAD).replace(' ', r'\s+') + r')\b', re.IGNORECASE)
ENFORCED = ('pages',)

CODE_BLOCK = re.compile(r'^```.*?^```', re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*', re.DOTALL)
TEXT = re.compile(r'"(?:[^"\\\n]|\\.)*"')
LIBRARIES = ('parking_geometry/', 'state_validity/', 'ompl_improved_astar/', 'path_tracking/', 'automatic_parking/')


def pages(name):
    return name in BUDGETS


def headers(name):
    return name.startswith((*LIBRARIES, 'benchmarks/', 'integrations/', 'playground/')) and name.endswith('.h')


def messages(name):
    return name.startswith((*LIBRARIES, 'benchmarks/')) and name.endswith('.cpp') or name.startswith('scripts/')


def parts_of(place, name, text):
    """Pairs of a place in the text and what is written there for people to read."""
    if place == 'pages':
        yield 0, CODE_BLOCK.sub(lambda block: '\n' * block.group().count('\n'), text)
    elif place == 'messages' and name.startswith('scripts/'):
        yield 0, text
    else:
        for part in (COMMENT if place == 'headers' else TEXT).finditer(text):
            yield part.start(), part.group()


def findings_in(place, name, text):
    for start, part in parts_of(place, name, text):
        for found in WORDS.finditer(part):
            line = text.count('\n', 0, start) + part.count('\n', 0, found.start()) + 1
            instead = list(INSTEAD.values())[found.lastindex - 1]
            yield f'{name}:{line}: "{" ".join(found.group().split())}"; rather: {instead}'


def main(root, places):
    findings = []
    for place in places:
        belongs = {'pages': pages, 'headers': headers, 'messages': messages}[place]
        for name in project_files(root):
            text = text_of(root, name) if belongs(name) else None
            findings += findings_in(place, name, text) if text else []
    report(findings, 'One term for one thing, and that of the field.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]), sys.argv[2:] or ENFORCED)
