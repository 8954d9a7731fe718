"""Configuration of Sphinx for the pages that make_site.py prepares."""
import logging
import os

from docutils import nodes
from sphinx import addnodes

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


def unwrap_namespaces(_app, doctree):
    """Shows what a header declares without a frame for each namespace round it."""
    while True:
        frames = [frame for frame in doctree.findall(addnodes.desc) if frame[0].astext().startswith('namespace ')]
        if not frames:
            return
        for frame in frames:
            if frame.parent is None:
                continue
            kept = [child for child in frame[-1].children
                    if isinstance(child, (addnodes.desc, nodes.container, nodes.rubric, addnodes.index))]
            frame.parent.replace(frame, kept)


def setup(app):
    logging.getLogger('sphinx.sphinx.domains.cpp').addFilter(OpenNamespaces())
    app.connect('doctree-read', unwrap_namespaces)
