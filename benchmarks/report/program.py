"""Common parts of the report's programs: required packages, one-line errors, files that are complete or absent."""
import argparse
import importlib.util
import os
import sys
import tempfile

PACKAGES = {'numpy': 'python3-numpy', 'scipy': 'python3-scipy', 'jinja2': 'python3-jinja2', 'plotly': 'python3-plotly'}
SYSTEM_PYTHON = '/usr/bin/python3'
MISSING = 3  # exit status


def require_packages(program):
    """Ends the program with one line when a package is missing.

    The first python3 in PATH may lack Debian's packages: then Debian's python3 runs the program instead."""
    missing = [package for module, package in PACKAGES.items() if importlib.util.find_spec(module) is None]
    if not missing:
        return
    if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
        sys.stdout.flush()
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.orig_argv[1:]])
    print(f'{program}: Python packages are missing; sudo apt-get install {" ".join(missing)} installs them',
          file=sys.stderr)
    sys.exit(MISSING)


class ReportError(Exception):
    """Invalid input; its text is one line that names the file."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise ReportError(f'{message} (see --help)')


def run(program, main):
    """Runs main with the program's arguments. Returns the exit status: 2, and one line on standard error, for
    errors."""
    try:
        main(sys.argv[1:])
    except ReportError as error:
        print(f'{program}: ' + ' '.join(str(error).split()), file=sys.stderr)
        return 2
    except OSError as error:
        print(f'{program}: {error.filename or "standard output"}: {error.strerror}', file=sys.stderr)
        return 2
    return 0


def require_no_input(outputs, inputs):
    """Raises ReportError when one of the outputs is one of the inputs, which would be lost."""
    for output in outputs:
        for file in inputs:
            if os.path.exists(output) and os.path.exists(file) and os.path.samefile(output, file):
                raise ReportError(f'{output}: is the input {file}, which would be lost; choose another file to write')


def require_writable(file):
    """Raises ReportError unless a file of this name can be written, existing or not."""
    if not file:
        raise ReportError('the name of the file to write is empty')
    if os.path.exists(file) and not os.path.isfile(file):
        kind = 'a folder' if os.path.isdir(file) else 'a pipe or a device, which a file would replace'
        raise ReportError(f'{file}: cannot be written: is {kind}')
    folder = os.path.dirname(os.path.abspath(file))
    if not os.path.isdir(folder):
        raise ReportError(f'{file}: cannot be written: there is no folder {folder}')
    try:
        # Permissions are not sufficient: root may write everywhere, but not in /proc.
        with tempfile.NamedTemporaryFile(dir=folder, prefix='.report-'):
            pass
    except OSError as error:
        raise ReportError(f'{file}: cannot be written: {error.strerror}') from error


def write_whole(file, content):
    """Writes a file completely or not at all. Raises ReportError when it cannot be written; an existing file then
    stays."""
    require_writable(file)
    temporary = None
    try:
        with tempfile.NamedTemporaryFile('w', encoding='utf-8', dir=os.path.dirname(os.path.abspath(file)),
                                         prefix='.report-', delete=False) as stream:
            temporary = stream.name
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, file)
    except OSError as error:
        if temporary is not None and os.path.exists(temporary):
            os.remove(temporary)
        raise ReportError(f'{file}: cannot be written: {error.strerror}') from error
