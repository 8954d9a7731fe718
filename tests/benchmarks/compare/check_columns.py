#!/usr/bin/env python3
"""Are the table in docs/benchmark-reference.md and the report's columns those of benchmarks/store/RunColumns.cpp?

usage: check_columns.py ROOT LIST_COLUMNS [--update]
LIST_COLUMNS is the program built from list_columns.cpp. --update writes table and columns anew.
"""
import json
import os
import re
import subprocess
import sys

TABLE = re.compile(r'(<!-- columns:begin -->\n)(.*?)(<!-- columns:end -->)', re.DOTALL)
HEADER = '| column | type | unit | meaning |\n| --- | --- | --- | --- |\n'


def row(column):
    name = column['name'].replace(' ', '_')
    return f'| `{name}` | {column["type"]} | {column["unit"]} | {column["text"]} |\n'


def main(root, program, update):
    document, report = os.path.join(root, 'docs', 'benchmark-reference.md'), os.path.join(root, 'benchmarks', 'report',
                                                                                 'columns.json')
    columns = json.loads(subprocess.run([program], capture_output=True, text=True, check=True).stdout)
    with open(document, encoding='utf-8') as stream:
        text = stream.read()
    table = TABLE.search(text)
    if not table:
        return 'docs/benchmark-reference.md: no table between <!-- columns:begin --> and <!-- columns:end -->'
    wanted = HEADER + ''.join(row(column) for column in columns)
    shown = [column['report'] for column in columns if 'report' in column]
    if update:
        with open(document, 'w', encoding='utf-8') as stream:
            stream.write(text[:table.start(2)] + wanted + text[table.end(2):])
        with open(report, 'w', encoding='utf-8') as stream:
            stream.write('[' + ',\n '.join(json.dumps(column, ensure_ascii=False) for column in shown) + ']\n')
        return None
    how = f'is not that of the columns; {os.path.basename(__file__)} --update makes it'
    if table.group(2) != wanted:
        return f'docs/benchmark-reference.md: the table {how}'
    with open(report, encoding='utf-8') as stream:
        if json.load(stream) != shown:
            return f'benchmarks/report/columns.json: {how}'
    return None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], '--update' in sys.argv[3:]))
