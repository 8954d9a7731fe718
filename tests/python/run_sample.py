"""Runs the Python programs of the README and the guides, those of each page in a folder of its own."""
import os
import re
import subprocess
import sys
import tempfile


def main(root):
    root = os.path.abspath(root)
    for name in ('README.md', os.path.join('docs', 'getting-started.md'), os.path.join('docs', 'python.md')):
        with open(os.path.join(root, name), encoding='utf-8') as stream:
            blocks = re.findall(r'^```python\n(.*?)^```', stream.read(), re.MULTILINE | re.DOTALL)
        if not blocks:
            return f'{name}: has no Python program'
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(os.path.join(root, 'benchmarks'), os.path.join(folder, 'benchmarks'))
            done = subprocess.run([sys.executable, '-B', '-c', '\n'.join(blocks)], cwd=folder, text=True,
                                  capture_output=True, check=False)
            print(done.stdout)
            if done.returncode != 0:
                if 'ModuleNotFoundError' in done.stderr:
                    print('SKIPPED:', done.stderr.splitlines()[-1])
                    sys.exit(77)
                return f'{name}: {done.stderr}'
    return None


if __name__ == '__main__':
    sys.exit(main(sys.argv[1]))
