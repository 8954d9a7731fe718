#!/usr/bin/env python3
"""Does docs/options.md say what the programs say with --help, and do the documents name all options, and no others?

usage: check_options.py ROOT PROGRAMS [--update]
PROGRAMS is the folder with the built programs. --update writes the page anew.
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
           'scripts/pictures', 'scripts/playground', 'scripts/reproduce-paper', 'scripts/soak', 'scripts/test',
           'scripts/try-in-bare-root',
           'benchmarks/report/make_report', 'benchmarks/report/results_page', 'benchmarks/paper/make_maps']
OPTION = re.compile(r'(?<![\w-])--[a-z][a-z-]*')
PAGE = re.compile(r'(<!-- options:begin -->\n)(.*)(<!-- options:end -->)', re.DOTALL)


def help_of(*command):
    return subprocess.run([*command, '--help'], capture_output=True, text=True, check=True, timeout=60).stdout


def section(name, text):
    """The program's own words, up to the end of its options: what follows depends on what it was built with."""
    blocks = re.split(r'\n(?=\n)', text.rstrip('\n'))
    options = next(k for k, block in enumerate(blocks) if block.startswith('\nOptions:'))
    kept = '\n'.join(line.rstrip() for block in blocks[:options + 1] for line in block.split('\n'))
    return f'## {name}\n\n```text\n{kept}\n```\n\n'


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


def main(root, folder, update):
    helps = {name: help_of(os.path.join(folder, name)) for name in PROGRAMS}
    page = os.path.join(root, 'docs', 'options.md')
    with open(page, encoding='utf-8') as stream:
        text = stream.read()
    wanted = ''.join(section(name, each) for name, each in helps.items())
    found = PAGE.search(text)
    if not found:
        return 'docs/options.md: nothing between <!-- options:begin --> and <!-- options:end -->'
    if update:
        with open(page, 'w', encoding='utf-8') as stream:
            stream.write(text[:found.start(2)] + '\n' + wanted + text[found.end(2):])
        return None
    faults = []
    if found.group(2) != '\n' + wanted:
        faults.append('docs/options.md: is not what the programs say; check_options.py --update makes it')
    for name in SCRIPTS:
        command = [os.path.join(root, name)]
        with open(command[0], encoding='utf-8') as stream:
            helps[name] = help_of(*([sys.executable, '-B'] if 'python' in stream.readline() else []), *command)
    options = {name: set(OPTION.findall(each)) | {'--help'} for name, each in helps.items()}
    documents = {}
    for name in ['README.md', 'CONTRIBUTING.md', *glob.glob('docs/**/*.md', root_dir=root, recursive=True)]:
        with open(os.path.join(root, name), encoding='utf-8') as stream:
            documents[name] = stream.read()
    named = {option for each in documents.values() for option in OPTION.findall(each)}
    for name, each in options.items():
        faults += [f'no document names {option} of {name}' for option in sorted(each - named)]
    # A script is called by its name alone, too.
    options.update({os.path.basename(name): each for name, each in list(options.items())
                    if os.path.basename(name) not in options and not name.startswith('scripts/')})
    faults += strangers(documents, options)
    return '\n'.join(faults) or None


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], '--update' in sys.argv[3:]))
