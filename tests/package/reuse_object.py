#!/usr/bin/env python3
"""A compiler launcher that compiles nothing twice: where another build of this project has compiled the same file with
the same options, its object is copied.

usage: reuse_object.py COMPILE_COMMANDS.json COMMAND...

Only an object that is newer than all that it was made of is taken; otherwise the command is run.
"""
import filecmp
import json
import os
import shlex
import shutil
import sys

WITH_VALUE = ('-o', '-c', '-MT', '-MF')


def parsed(command):
    """What a command compiles with, without the names of what it writes; and those, by option."""
    options, values = [], {}
    words = iter(command)
    for word in words:
        if word in WITH_VALUE:
            values[word] = next(words, '')
        elif word != '-MD' and not (word.startswith('-D') and word.endswith('_EXPORTS')):  # a macro that no source uses
            options.append(word)
    return options, values


def is_same_source(one, other):
    """Is it the same file, or are they copies of one that CMake has made for two builds?"""
    if one == other:
        return True
    return os.path.basename(one) == os.path.basename(other) and os.path.exists(one) and filecmp.cmp(one, other)


def made_of(made, folder):
    """The files that an object's depfile names, after its target. ccache may have written them relative to the folder."""
    with open(made + '.d', encoding='utf-8') as stream:
        names = shlex.split(stream.read().replace('\\\n', ' ').partition(':')[2])
    return [os.path.normpath(os.path.join(folder, name)) for name in names]


def reuse(compile_commands, command):
    """Copies the object that this command would make; False when there is none that is fit."""
    options, wanted = parsed(command)
    if not {'-o', '-c', '-MF'} <= wanted.keys():
        return False
    with open(compile_commands, encoding='utf-8') as stream:
        entries = json.load(stream)
    for entry in entries:
        if not is_same_source(entry['file'], wanted['-c']):
            continue
        others, found = parsed(shlex.split(entry['command']))
        if others != options[-len(others):]:  # before them another launcher may be named
            continue
        made = os.path.join(entry['directory'], found['-o'])
        try:
            files = made_of(made, entry['directory'])
            if max(map(os.path.getmtime, files)) >= os.path.getmtime(made):
                continue
            shutil.copyfile(made, wanted['-o'])
        except (OSError, ValueError):
            continue
        with open(wanted['-MF'], 'w', encoding='utf-8') as stream:
            names = ' '.join(name.replace(' ', '\\ ') for name in files)
            stream.write(f'{wanted.get("-MT", wanted["-o"])}: {names}\n')
        return True
    return False


if __name__ == '__main__':
    if not reuse(sys.argv[1], sys.argv[2:]):
        os.execvp(sys.argv[2], sys.argv[2:])
