"""The Python packages that reports need, found where Debian installs them."""
import importlib.util
import os
import sys

PACKAGES = {'numpy': 'python3-numpy', 'scipy': 'python3-scipy', 'jinja2': 'python3-jinja2', 'plotly': 'python3-plotly'}
SYSTEM_PYTHON = '/usr/bin/python3'
MISSING = 3  # exit status


def require_packages(program):
    """Ends the program with one line when a package is missing.

    Another python3 may be first in PATH and lack what Debian's has: then Debian's runs the program instead."""
    missing = [package for module, package in PACKAGES.items() if importlib.util.find_spec(module) is None]
    if not missing:
        return
    if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
        sys.stdout.flush()
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.orig_argv[1:]])
    print(f'{program}: Python packages are missing; sudo apt-get install {" ".join(missing)} installs them',
          file=sys.stderr)
    sys.exit(MISSING)
