#!/usr/bin/env python3
"""Does Doxygen read the docstrings without a warning, is every public name documented, and are the guides fit for the site:
is each in a group of docs/site/navigation.json, does every link and picture in them exist, is every picture shown?

Of enumerators and namespaces Doxygen does not warn by itself, and functions of a namespace without a docstring it
leaves out without a word: they are looked for in its XML.

usage: check_docs.py ROOT
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

from project_files import report

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'docs', 'site'))
import make_site  # noqa: E402


def is_documented(element):
    texts = (element.find(tag) for tag in ('briefdescription', 'detaileddescription'))
    return any(text is not None and ''.join(text.itertext()).strip() for text in texts)


def place_of(element):
    location = element.find('location')
    return f'{location.get("file")}:{location.get("line")}'


def undocumented(folder):
    """Namespaces that hold something and public enumerators without a docstring, in the XML that Doxygen wrote."""
    found = set()
    for file in glob.glob(os.path.join(folder, '*.xml')):
        for compound in ElementTree.parse(file).getroot().findall('compounddef'):
            if compound.get('prot') == 'private':
                continue
            holds = compound.find('innerclass') is not None or compound.find('.//memberdef') is not None
            if compound.get('kind') == 'namespace' and holds and not is_documented(compound):
                found.add(f'{place_of(compound)}: namespace {compound.findtext("compoundname")} is not documented')
            for enumeration in compound.iterfind('.//memberdef[@kind="enum"]'):
                if enumeration.get('prot') != 'private':
                    found.update(f'{place_of(enumeration)}: {enumeration.findtext("qualifiedname")}::'
                                 f'{value.findtext("name")} is not documented'
                                 for value in enumeration.findall('enumvalue') if not is_documented(value))
    return sorted(found)


def main(root):
    if not shutil.which('doxygen'):
        report(['doxygen is not installed'], 'Its Debian package is doxygen; scripts/test installs it.')
    with tempfile.TemporaryDirectory() as output:
        configuration = f'@INCLUDE = Doxyfile\nOUTPUT_DIRECTORY = "{output}"\n'
        built = subprocess.run(['doxygen', '-'], input=configuration, cwd=root, capture_output=True, text=True,
                               check=False)
        said = [line.replace(root + os.sep, '') for line in built.stderr.splitlines() if line.strip()]
        if not os.path.exists(os.path.join(output, 'xml', 'index.xml')):
            said.append(f'doxygen wrote no XML, status {built.returncode}')
        else:
            said += undocumented(os.path.join(output, 'xml')) + make_site.prepare(Path(root), Path(output))
    report(said, 'Doxyfile says what Doxygen reads, docs/site/navigation.json which guides the site has.')


if __name__ == '__main__':
    main(os.path.abspath(sys.argv[1]))
