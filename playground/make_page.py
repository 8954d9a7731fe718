"""Makes the playground's one file from its parts.

usage: make_page.py ROOT VERSION CORE.js JS-YAML.js PAGE.html
"""
import base64
import hashlib
import json
import os
import sys

SCRIPTS = ['formats.js', 'scene.js', 'memory.js', 'view.js', 'draw.js', 'charts.js', 'planner.js', 'tools.js', 'panels.js', 'guide.js', 'main.js']
SCENES = ['perpendicular', 'parallel', 'angled45', 'narrow_parallel', 'tight_parallel', 'narrow_perpendicular',
          'dead_end_aisle', 'multi_storey', 'underground_garage', 'perceived_street', 'unreachable']


# Sources of the page, apart from the compiler.
FOLDERS = ['automatic_parking', 'ompl_improved_astar', 'parking_geometry', 'path_tracking', 'state_validity', 'playground',
           os.path.join('benchmarks', 'scenarios')]
FILES = [os.path.join('benchmarks', 'planners', name) for name in ('TextbookSearch.cpp', 'TextbookSearch.h')]


def sources(root):
    """Tells pages apart that were made of other sources."""
    names = sorted([os.path.join(place, name) for folder in FOLDERS for place, _, files in os.walk(os.path.join(root, folder))
                    for name in files if name.endswith(('.h', '.cpp', '.js', '.css', '.html', '.py', '.yaml', '.pgm'))]
                   + [os.path.join(root, file) for file in FILES])
    whole = hashlib.sha256()
    for name in names:
        whole.update(os.path.relpath(name, root).encode() + b'\0')
        with open(name, 'rb') as stream:
            whole.update(hashlib.sha256(stream.read()).digest())
    return whole.hexdigest()[:16]


def text(*parts):
    with open(os.path.join(*parts), encoding='utf-8') as stream:
        return stream.read()


def scenes(root):
    folder = os.path.join(root, 'benchmarks', 'scenarios')
    files = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), 'rb') as stream:
            data = stream.read()
        if name.endswith('.yaml'):
            files[name] = data.decode('utf-8')
        elif name.endswith('.pgm'):
            files[name] = 'base64:' + base64.b64encode(data).decode('ascii')
    return {'order': SCENES, 'files': files}


def in_script(content):
    """Fit to stand in a script element: nothing in it may end that."""
    return content.replace('</script', '<\\/script').replace('<!--', '<\\!--')


def main(root, version, core, js_yaml, page):
    folder = os.path.join(root, 'playground', 'page')
    marks = {
        '/*@STYLE@*/': text(folder, 'style.css'),
        '/*@SCENES@*/': in_script(json.dumps(scenes(root))),
        '/*@WORKER@*/': in_script(text(core) + '\n' + text(folder, 'worker.js')),
        '/*@SCRIPT@*/': in_script('\n'.join([text(js_yaml)] + [text(folder, name) for name in SCRIPTS])),
        '@VERSION@': version,
        '@SOURCES@': sources(root),
    }
    content = text(folder, 'index.html')
    for mark, replacement in marks.items():
        if content.count(mark) < 1:
            sys.exit(f'index.html: has no {mark}')
        content = content.replace(mark, replacement)
    with open(page, 'w', encoding='utf-8') as stream:
        stream.write(content)
    print(f'{page}: {len(content.encode()) / 1024:.0f} kB')


if __name__ == '__main__':
    main(*sys.argv[1:])
