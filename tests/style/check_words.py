#!/usr/bin/env python3
"""Does each page exist, and has it no more words than it may have (pages.py)?

usage: check_words.py ROOT
"""
import os
import re
import sys

from pages import BUDGETS
from project_files import project_files, report, text_of

ALLOWED = 1.1  # times the budget
ATTACHMENT = re.compile(r'<!-- (\w+):begin -->.*?<!-- \1:end -->', re.DOTALL)
COMMENT = re.compile(r'<!--.*?-->', re.DOTALL)


def words_of(text):
    """How many words there are, in tables and code blocks, too; what is only punctuation is no word."""
    kept = COMMENT.sub('', ATTACHMENT.sub('', text))
    return sum(1 for word in kept.split() if re.search(r'\w', word))


def main(root):
    files = project_files(root)
    findings = []
    for page, budget in BUDGETS.items():
        if page not in files:
            findings.append(f'{page}: is missing')
            continue
        words = words_of(text_of(root, page))
        if words > ALLOWED * budget:
            findings.append(f'{page}: {words} words, its budget is {budget}')
    report(findings, 'The budgets are in pages.py.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
