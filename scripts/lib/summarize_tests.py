#!/usr/bin/env python3
"""Prints a summary of a CTest run: counts, failed tests, skipped tests with their reasons, the slowest tests.

usage: summarize_tests.py test-results.xml    (written by ctest --output-junit)
"""
import collections
import re
import sys
import xml.etree.ElementTree

SLOWEST = 5


def skip_reason(case):
    """Reason of a skipped test: GoogleTest prints it after 'file:line: Skipped', scripts after 'SKIPPED:'."""
    output = case.findtext('system-out') or ''
    found = re.search(r'(?:\d+: Skipped\n|SKIPPED: *)([^\n]+)', output)
    return found.group(1).strip() if found else 'no reason given'


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        cases = list(xml.etree.ElementTree.parse(sys.argv[1]).getroot().iter('testcase'))
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        print(f'No summary: {error}', file=sys.stderr)
        return 1

    failed = [case.get('name') for case in cases if case.get('status') == 'fail']
    skipped = collections.defaultdict(list)
    for case in cases:
        if case.find('skipped') is not None:
            skipped[skip_reason(case)].append(case.get('name'))
    number_skipped = sum(map(len, skipped.values()))
    print(f'{len(cases)} tests: {len(cases) - len(failed) - number_skipped} passed, {len(failed)} failed, '
          f'{number_skipped} skipped')
    for reason, names in sorted(skipped.items()):
        others = f' and {len(names) - 1} more' if len(names) > 1 else ''
        print(f'  skipped: {names[0]}{others}: {reason}')
    for name in failed:
        print(f'  FAILED: {name}')
    slowest = sorted(cases, key=lambda case: -float(case.get('time', 0)))[:SLOWEST]
    print('Slowest: ' + ', '.join(f'{case.get("name")} {float(case.get("time", 0)):.1f} s' for case in slowest))
    return 0


if __name__ == '__main__':
    sys.exit(main())
