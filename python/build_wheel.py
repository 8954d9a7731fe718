"""Builds the package with scikit-build-core and makes wheels self-contained: they contain libyaml-cpp and libpng, and
their names state the supported systems."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

from scikit_build_core.build import *  # noqa: F401,F403: the hooks of a build backend
from scikit_build_core.build import build_wheel as _build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = _build_wheel(wheel_directory, config_settings, metadata_directory)
    try:
        import auditwheel  # noqa: F401
    except ImportError:
        return name  # a build for this system only
    if not sys.platform.startswith('linux'):
        return name
    made = pathlib.Path(wheel_directory, name)
    with tempfile.TemporaryDirectory() as folder:
        _audit('repair', '--wheel-dir', folder, made)
        repaired = next(pathlib.Path(folder).glob('*.whl'))
        _audit('show', repaired)
        made.unlink()
        shutil.move(repaired, pathlib.Path(wheel_directory, repaired.name))
    return repaired.name


def _audit(*arguments):
    subprocess.run([sys.executable, '-m', 'auditwheel', *map(str, arguments)], check=True)
