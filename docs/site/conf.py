"""Configuration of Sphinx for the pages that make_site.py prepares."""
import logging
import os
from xml.etree import ElementTree

from docutils import nodes
from sphinx import addnodes
from sphinx.domains.cpp import CPPDomain
from sphinx.transforms import SphinxTransform

project = 'Improved A* for automatic parking'
html_title = project
extensions = ['myst_parser', 'breathe']
myst_heading_anchors = 4
myst_enable_extensions = ['html_image']
breathe_projects = {'project': os.environ['REFERENCE_XML']}
breathe_default_project = 'project'
breathe_show_include = False
primary_domain = 'cpp'
highlight_language = 'text'

html_theme = 'furo'
html_static_path = ['static']
html_css_files = ['site.css']
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_permalinks_icon = '#'
html_use_index = True


class OpenNamespaces(logging.Filter):
    """Every header opens the same namespaces again, which Sphinx takes for a second declaration."""

    def filter(self, record):
        text = record.getMessage()
        return not ('Duplicate C++ declaration' in text and '.. cpp:type:: ' in text)


class UnwrapNamespaces(SphinxTransform):
    """Shows what a header declares without a frame for each namespace round it, which the index would list, too."""
    default_priority = 500

    def apply(self):
        while True:
            frame = next((frame for frame in self.document.findall(addnodes.desc)
                          if frame[0].astext().startswith('namespace ')), None)
            if frame is None:
                return
            siblings = frame.parent
            place = siblings.index(frame)
            if place > 0 and isinstance(siblings[place - 1], addnodes.index):
                siblings.remove(siblings[place - 1])
            kept = [child for child in frame[-1].children
                    if isinstance(child, (addnodes.desc, nodes.container, nodes.rubric, addnodes.index))]
            siblings.replace(frame, kept)


namespace_places = set()


def find_namespaces(_app, env):
    index = ElementTree.parse(os.path.join(breathe_projects['project'], 'index.xml'))
    names = {each.text for each in index.iterfind('compound[@kind="namespace"]/name')}
    namespace_places.update(symbol.declaration.get_newest_id()
                            for symbol in env.domaindata['cpp']['root_symbol'].get_all_symbols()
                            if symbol.declaration and str(symbol.get_full_nested_name()) in names)


class SearchableCpp(CPPDomain):
    """Search and index find what can be named: neither namespaces nor the parameters of functions."""

    def get_objects(self):
        return (each for each in super().get_objects()
                if not each[2].endswith('Param') and each[4] not in namespace_places)


def unlink_namespaces(_app, doctree, _page):
    """A namespace has no place to lead to: it is in every header."""
    for link in list(doctree.findall(nodes.reference)):
        if (link.get('refid') or link.get('refuri', '').partition('#')[2]) in namespace_places:
            link.parent.replace(link, link.children)


def setup(app):
    logging.getLogger('sphinx.sphinx.domains.cpp').addFilter(OpenNamespaces())
    app.add_domain(SearchableCpp, override=True)
    app.add_transform(UnwrapNamespaces)
    app.connect('env-updated', find_namespaces)
    app.connect('doctree-resolved', unlink_namespaces)
