#!/usr/bin/env python3
"""Do the documents give programs and scripts only options that these have, and do their helps fit a terminal?

usage: check_options.py ROOT PROGRAMS
PROGRAMS is the folder with the built programs.
"""
import glob
import os
import re
import subprocess
import sys

# Some are built only where their libraries are installed, and some take the options of a framework.
PROGRAMS = ['parking_plan', 'parking_benchmark', 'parking_convert', 'parking_queries', 'paper_run', 'troubled_drives',
            'soak']
# Of other programs than these (cmake, pip, Slurm, ...) a document may say what it likes.
SCRIPTS = ['scripts/compare', 'scripts/docs', 'scripts/fuzz', 'scripts/package',
           'scripts/pictures', 'scripts/playground', 'scripts/reproduce-paper', 'scripts/results', 'scripts/soak', 'scripts/test',
           'scripts/tidy', 'scripts/try-in-bare-root',
           'benchmarks/report/make_report', 'benchmarks/results/make_results', 'benchmarks/paper/make_maps']
MAX_WIDTH = 100  # characters
OPTION = re.compile(r'(?<![\w-])--[a-z][a-z-]*')


def help_of(*command):
    return subprocess.run([*command, '--help'], capture_output=True, text=True, check=True, timeout=60).stdout


def commands(text):
    """Lines of a document, each with those that a backslash adds to it."""
    return re.sub(r'\\\n\s*', ' ', text).split('\n')


def strangers(documents, options):
    """Options that a document gives to a program which has none of that name."""
    # The longest names first: of scripts/soak what follows is not soak's.
    names = '|'.join(re.escape(name) for name in sorted(options, key=len, reverse=True))
    called = re.compile(rf'(?<![\w/.-])(?:[\w./-]*?/)??({names})(?![\w/.-])([^`#|;&)]*)')
    for name, text in documents.items():
        for line in commands(text):
            for call in called.finditer(line):
                for option in OPTION.findall(call.group(2)):
                    if option not in options[call.group(1)]:
                        yield f'{name}: {call.group(1)} has no option {option}'


def main(root, folder):
    helps = {name: help_of(os.path.join(folder, name)) for name in PROGRAMS}
    for name in SCRIPTS:
        command = [os.path.join(root, name)]
        with open(command[0], encoding='utf-8') as stream:
            helps[name] = help_of(*([sys.executable, '-B'] if 'python' in stream.readline() else []), *command)
    wide = [f'{name}: a line of --help has {len(line)} characters: {line.strip()}' for name, each in helps.items()
            for line in each.splitlines() if len(line) >= MAX_WIDTH]
    options = {name: set(OPTION.findall(each)) | {'--help'} for name, each in helps.items()}
    documents = {}
    for name in ['README.md', 'CONTRIBUTING.md', *glob.glob('docs/**/*.md', root_dir=root, recursive=True)]:
        with open(os.path.join(root, name), encoding='utf-8') as stream:
            documents[name] = stream.read()
    # A script is called by its name alone, too.
    options.update({os.path.basename(name): each for name, each in list(options.items())
                    if os.path.basename(name) not in options and not name.startswith('scripts/')})
    return '\n'.join([*strangers(documents, options), *wide]) or None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2]))
