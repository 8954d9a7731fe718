#!/usr/bin/env python3
"""Makes the site of scripts/docs: guides in the groups of navigation.json, and a reference of all public C++ names.

usage: make_site.py ROOT WORK SITE

Reads the XML that Doxygen left in WORK/xml, prepares the pages in WORK/pages, and lets Sphinx write SITE. Fails when a page
is in no group, when a link or a picture leads nowhere, or when Sphinx warns.
"""
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import urllib.parse
from pathlib import Path
from xml.etree import ElementTree

HERE = Path(__file__).resolve().parent
LINK = re.compile(r'(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^)\s]+)\)')
PICTURE = re.compile(r'<(?:img|source)[^>]*?\b(?:src|srcset)="([^"]+)"')
PICTURES = ('*.svg', '*.png', '*.gif')
LANGUAGES = {'.cpp': 'cpp', '.h': 'cpp', '.py': 'python', '.yml': 'yaml', '.cff': 'yaml', '.cmake': 'cmake'}


def page_name(path):
    """Where a guide is among the pages: as in the project, but the README is the first page."""
    return 'index.md' if path == 'README.md' else path


def grouped_pages(root):
    """{group: pages}, and what is wrong with that: pages that are not there or twice, and pages in no group."""
    groups = json.loads((root / 'docs' / 'site' / 'navigation.json').read_text(encoding='utf-8'))
    listed = [page for pages in groups.values() for page in pages]
    wrong = [f'{page} is not there' for page in listed if not (root / page).is_file()]
    wrong += [f'{page} is listed twice' for page in sorted(set(listed)) if listed.count(page) > 1]
    wrong += [f'docs/{file.name} is in no group' for file in sorted((root / 'docs').glob('*.md'))
              if f'docs/{file.name}' not in listed]
    return groups, [f'docs/site/navigation.json: {each}' for each in wrong]


class Site:
    def __init__(self, root, work):
        self.root, self.xml, self.pages = root, work / 'xml', work / 'pages'
        self.headers = self.read_headers()
        self.shown = {}         # files of the project that a guide links to: their pages
        self.pictures = set()   # those that guides show
        self.wrong = []

    def read_headers(self):
        """{header: its page}, of all headers in Doxygen's XML."""
        headers = {}
        for compound in ElementTree.parse(self.xml / 'index.xml').getroot().iterfind('compound[@kind="file"]'):
            location = ElementTree.parse(self.xml / f'{compound.get("refid")}.xml').find('compounddef/location')
            headers[location.get('file')] = f'reference/{location.get("file")}.md'
        return dict(sorted(headers.items()))

    def top_folders(self):
        return sorted({name.split('/')[0] for name in self.headers})

    def write(self, name, text):
        file = self.pages / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding='utf-8')

    def page_of(self, target):
        """The page that stands for a file or folder of the project; None for a folder without a page."""
        if target in self.headers:
            return self.headers[target]
        if (self.root / target).is_dir():
            top = target.split('/')[0]
            if all(os.path.dirname(name) != target for name in self.headers):
                return f'reference/{top}.md' if target in self.top_folders() else None
            return f'reference/{top}.md' + (f'#{re.sub("[^a-z0-9_-]", "", target.lower())}' if target != top else '')
        if target not in self.shown:
            self.shown[target] = f'files/{target}.md'
            text = (self.root / target).read_text(encoding='utf-8')
            language = LANGUAGES.get(Path(target).suffix, 'text')
            if text.startswith('#!'):
                language = 'python' if 'python' in text.partition('\n')[0] else 'bash'
            fence = '`' * 6
            self.write(self.shown[target], f'---\norphan: true\n---\n# {target}\n\n{fence}{language}\n{text}\n{fence}\n')
        return self.shown[target]

    def rewrite(self, page, listed):
        """The text of a guide with links that lead to pages of the site."""
        folder = os.path.dirname(page)
        here = os.path.dirname(page_name(page))

        def check_picture(target):
            place = os.path.normpath(os.path.join(folder, target))
            self.pictures.add(place)
            if not (self.root / place).is_file():
                self.wrong.append(f'{page}: no picture {target}')

        def replace(match):
            text, target = match.groups()
            if text.startswith('!'):
                check_picture(target)
                return match.group()
            if target.startswith(('#', 'http:', 'https:', 'mailto:')):
                return match.group()
            file, _, anchor = target.partition('#')
            place = os.path.normpath(os.path.join(folder, file))
            if place.endswith('.md') and place in listed:
                found = page_name(place)
            elif place.startswith('..') or not (self.root / place).exists():
                self.wrong.append(f'{page}: no file {target}')
                return match.group()
            else:
                found = self.page_of(place)
            if found is None:
                return text[1:-1]
            return f'{text}({os.path.relpath(found, here or ".")}{"#" + anchor if anchor else ""})'

        lines, fence = [], None
        for line in (self.root / page).read_text(encoding='utf-8').splitlines():
            # A badge is a state of GitHub's, not of the project.
            if line.startswith('[![') and '](../../actions/' in line:
                continue
            opened = re.match(r'\s*(```+|~~~+)', line)
            if opened and (fence is None or line.strip().startswith(fence)):
                fence = None if fence else opened.group(1)
            elif fence is None:
                for target in PICTURE.findall(line):
                    check_picture(target)
                line = LINK.sub(replace, line)
            lines.append(line)
        return '\n'.join(lines) + '\n'

    def write_guides(self, groups):
        listed = {page for pages in groups.values() for page in pages}
        trees = ''
        for group, pages in groups.items():
            names = ''.join('Overview <self>\n' if page == 'README.md' else f'{page[:-3]}\n' for page in pages)
            trees += f'\n```{{toctree}}\n:hidden:\n:caption: {group}\n\n{names}```\n'
        names = ''.join(f'reference/{folder}\n' for folder in self.top_folders())
        trees += f'\n```{{toctree}}\n:hidden:\n:caption: Reference\n\n{names}All names <genindex>\n```\n'
        for page in sorted(listed):
            self.write(page_name(page), self.rewrite(page, listed) + (trees if page == 'README.md' else ''))
        for pattern in PICTURES:
            for picture in (self.root / 'docs').rglob(pattern):
                name = picture.relative_to(self.root)
                if str(name) not in self.pictures:
                    self.wrong.append(f'{name}: no page shows this picture')
                copy = self.pages / name
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(picture, copy)

    def remove_private(self):
        """Doxygen writes private members into its XML, too."""
        for file in self.xml.glob('*.xml'):
            tree = ElementTree.parse(file)
            private = [(compound, part) for compound in tree.getroot() for part in compound
                       if part.tag == 'sectiondef' and part.get('kind').startswith('private')
                       or part.tag == 'innerclass' and part.get('prot') == 'private']
            for compound, part in private:
                compound.remove(part)
            if private:
                tree.write(file, encoding='utf-8', xml_declaration=True)

    def write_reference(self):
        self.remove_private()
        for header, page in self.headers.items():
            # Without a place in the navigation, where they would hide the guides: a page for each folder lists them.
            self.write(page, f'---\norphan: true\n---\n# {os.path.basename(header)}\n\n`#include "{header}"`\n\n'
                       f'```{{doxygenfile}} {header}\n```\n')
        for top in self.top_folders():
            text = f'# {top}\n'
            for folder in sorted({os.path.dirname(header) for header in self.headers if header.startswith(f'{top}/')}):
                names = [header for header in self.headers if os.path.dirname(header) == folder]
                text += f'\n## {folder}\n\n' if folder != top else '\n'
                text += ''.join(f'- [{os.path.basename(name)}]({name}.md)\n' for name in names)
            self.write(f'reference/{top}.md', text)


def complete_theme(static):
    """Debian 12 leaves the parts of Furo apart that other releases put together: a script that imports another, which browsers
    refuse for files, a style sheet at an address of Debian's web servers, and the dark colours of readers who chose none."""
    script, style = static / 'scripts' / 'furo.js', static / 'styles' / 'furo.css'
    text = script.read_text(encoding='utf-8')
    script.write_text(re.sub(r'^import \w+ from "\./(.*?)";', lambda found: (script.parent / found[1]).read_text(encoding='utf-8'),
                             text, flags=re.MULTILINE), encoding='utf-8')
    text = style.read_text(encoding='utf-8')
    text = re.sub(r'@import url\(/javascript/(.*?)\);',
                  lambda found: Path('/usr/share/javascript', found[1]).read_text(encoding='utf-8'), text)
    if 'prefers-color-scheme' not in text:
        dark = re.search(r'body\[data-theme="?dark"?\]\s*(\{[^}]*--color-[^}]*\})', text)[1]
        text += f'\n@media (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark} }}\n'
    style.write_text(text, encoding='utf-8')


class Page(html.parser.HTMLParser):
    """What a page of the site refers to, and the places in it that can be referred to."""

    def __init__(self, file):
        super().__init__()
        self.references, self.loaded, self.places = [], [], set()
        self.feed(file.read_text(encoding='utf-8'))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.places.update(filter(None, (values.get('id'), values.get('name') if tag == 'a' else None)))
        loads = tag in ('img', 'script', 'source', 'iframe') or tag == 'link' and values.get('rel') == 'stylesheet'
        for key in ('src', 'href'):
            if values.get(key):
                (self.loaded if loads else self.references).append(values[key])


def broken(site):
    """References of a site's pages that lead nowhere, and what a page would load from a network."""
    for file in sorted(site.rglob('*.css')):
        for target in re.findall(r'url\(["\']?([^)"\']+)', file.read_text(encoding='utf-8')):
            if not target.startswith(('data:', '#')) and not (file.parent / target.partition('?')[0].partition('#')[0]).is_file():
                yield f'{file.relative_to(site)}: {target} is not there'
    pages = {file: Page(file) for file in sorted(site.rglob('*.html'))}
    for file, page in pages.items():
        for target in page.loaded + page.references:
            parts = urllib.parse.urlsplit(target)
            if parts.scheme or parts.netloc:
                if target in page.loaded and parts.scheme != 'data':
                    yield f'{file.relative_to(site)}: loads {target} from a network'
                continue
            place = Path(os.path.normpath(file.parent / urllib.parse.unquote(parts.path))) if parts.path else file
            if not place.is_file():
                yield f'{file.relative_to(site)}: {target} is not there'
            elif parts.fragment and place in pages and urllib.parse.unquote(parts.fragment) not in pages[place].places:
                yield f'{file.relative_to(site)}: {target}: no such heading'


def prepare(root, work):
    """Writes the pages for Sphinx; returns what is wrong with the guides: their groups, links and pictures."""
    groups, wrong = grouped_pages(root)
    if wrong:
        return wrong
    site = Site(root, work)
    shutil.rmtree(site.pages, ignore_errors=True)
    site.write_guides(groups)
    site.write_reference()
    return site.wrong


def main(root, work, output):
    wrong = prepare(root, work)
    if wrong:
        sys.exit('\n'.join(wrong))
    command = ['sphinx-build', '-q', '-W', '--keep-going', '-j', 'auto', '-c', HERE, '-d', work / 'doctrees', work / 'pages', output]
    if subprocess.run(command, check=False, env={**os.environ, 'REFERENCE_XML': str(work / 'xml')}).returncode:
        sys.exit('Sphinx warned of what is above')
    complete_theme(output / '_static')
    wrong = list(broken(output))
    if wrong:
        sys.exit('\n'.join(wrong))


if __name__ == '__main__':
    main(*(Path(argument).resolve() for argument in sys.argv[1:]))
