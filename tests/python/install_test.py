"""Installed, the package is found in its folder and plans; nothing else is needed there."""
import os
import shutil
import subprocess
import sys

PROGRAM = '''
import improved_astar as ia
wall = [[-0.5, -5], [0.5, -5], [0.5, 2], [-0.5, 2]]
result = ia.plan(ia.Scenario.from_polygons([wall], (-8, 0, 0), (8, 0, 0)))
assert result and ia.check(result.scenario, result), result
print(ia.__file__, ia.__version__, result)
'''


def main(cmake, build, prefix, folder):
    shutil.rmtree(prefix, ignore_errors=True)
    subprocess.run([cmake, '--install', build, '--prefix', prefix, '--component', 'python'], check=True,
                   stdout=subprocess.DEVNULL)
    place = os.path.join(prefix, folder)
    wanted = {'__init__.py', '__init__.pyi', '_core.pyi', 'animation.py', 'ompl.py', 'plotting.py', 'py.typed',
              'results.py'}
    found = set(os.listdir(os.path.join(place, 'improved_astar')))
    modules = {name for name in found if name.startswith('_core.') and name.endswith('.so')}
    if found != wanted | modules or len(modules) != 1:
        return f'the package holds {sorted(found)}'
    environment = dict(os.environ, PYTHONPATH=place)
    done = subprocess.run([sys.executable, '-B', '-c', PROGRAM], env=environment, cwd='/', text=True,
                          capture_output=True, check=False)
    print(done.stdout, done.stderr)
    return None if done.returncode == 0 and place in done.stdout else 'the installed package does not work'


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
