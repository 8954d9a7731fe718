"""Which files belong to the project; shared by the style checks."""
import os
import subprocess
import sys

CODE = ('.h', '.cpp', '.py', '.sh', '.cmake')
GENERATED = {'build', '.git', '__pycache__'}


def project_files(root):
    """Paths relative to root: what git tracks or would track; without git (a source archive) all that is not built."""
    git = ['git', '-c', f'safe.directory={root}', '-C', root]
    listed = subprocess.run(git + ['ls-files', '-z', '--cached', '--others', '--exclude-standard'],
                            capture_output=True, text=True, check=False)
    if listed.returncode == 0 and os.path.exists(os.path.join(root, '.git')):
        names = [name for name in listed.stdout.split('\0') if name]
    else:
        names = []
        for folder, subfolders, files in os.walk(root):
            subfolders[:] = [name for name in subfolders
                             if name not in GENERATED and not name.startswith('build-')
                             and not (folder == root and name == 'results')]
            names += [os.path.relpath(os.path.join(folder, name), root) for name in files]
    return sorted(name for name in set(names) if os.path.isfile(os.path.join(root, name)))


def text_of(root, name):
    """The text of a file, or None for one that is not text."""
    with open(os.path.join(root, name), 'rb') as file:
        data = file.read()
    if b'\0' in data:
        return None
    try:
        return data.decode('utf-8')
    except UnicodeDecodeError:
        return None


def interpreter(text):
    """What the first line of a script names: 'python3', 'bash', ...; None without one."""
    line = text.split('\n', 1)[0]
    return line.split()[-1].split('/')[-1] if line.startswith('#!') else None


def is_code(root, name):
    """Is it written by hand to be run or compiled: sources, build files, scripts?"""
    if name.endswith(CODE) or os.path.basename(name) == 'CMakeLists.txt':
        return True
    if '.' in os.path.basename(name):
        return False
    text = text_of(root, name)
    return text is not None and interpreter(text) is not None


def report(findings, verdict):
    """Prints the findings, one a line, and ends the program: 1 when there are any."""
    for finding in findings:
        print(finding)
    if findings:
        print(f'{len(findings)} found. {verdict}')
    sys.exit(1 if findings else 0)
