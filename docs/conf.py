"""How Sphinx makes the documentation site. Runs in build/site/source, where tools/site/build.py has gathered the pages."""

import re
from pathlib import Path

from docutils import nodes
from sphinx.pycode import ModuleAnalyzer
from sphinx.util.docutils import SphinxDirective

import brushfire

project = "Brushfire"
author = "the Brushfire authors"
copyright = "the Brushfire authors, MIT licence"
version = release = brushfire.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_static", "files", "extra"]
highlight_language = "text"
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
# Blocks are executed, not only lexed (tools/site/blocks.py); attributes of one name in two classes are no error.
suppress_warnings = ["misc.highlighting_failure", "ref.python"]

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings say which shapes, and signatures stay readable
autodoc_preserve_defaults = True
add_module_names = False
maximum_signature_line_length = 90

html_theme = "furo"
html_title = "Brushfire"
html_static_path = ["_static"]
html_favicon = "_static/icon.svg"
html_extra_path = ["extra"]  # the viewer
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#a33b0b", "color-brand-content": "#a33b0b"},
    "dark_css_variables": {"color-brand-primary": "#ff9d5c", "color-brand-content": "#ff9d5c"},
}

linkcheck_timeout = 20  # ./run docs links


class Drawing(SphinxDirective):
    """An SVG of figures/, inlined: it takes the colours of the page's theme. The content is its caption."""

    required_arguments = 1
    has_content = True

    def run(self):
        file = Path(self.env.srcdir) / "figures" / f"{self.arguments[0]}.svg"
        self.env.note_dependency(str(file))
        figure = nodes.figure(
            "", nodes.raw("", re.sub(r"<\?xml.*?\?>", "", file.read_text()), format="html"), classes=["drawing"]
        )
        if self.content:
            caption = self.parse_content_to_nodes()[0]
            figure += nodes.caption("", "", *caption.children)
        return [figure]


class Viewer(SphinxDirective):
    """The live viewer of web/, where it was built (./run web); a picture otherwise."""

    def run(self):
        if (Path(self.env.srcdir) / "extra/viewer/index.html").exists():
            frame = '<iframe class="viewer" src="viewer/index.html" title="Live viewer: click on the mesh" loading="lazy"></iframe>'
            link = '<p class="below">Click anywhere: distances from there, computed in your browser. <a href="viewer/index.html">Whole page</a></p>'
            return [nodes.raw("", frame + link, format="html")]
        return [nodes.image(uri="images/bunny.png", alt="Exact distances on a scan, isolines, two shortest paths")]


def without_overloads(analyze):
    """The implementation's signature says what all overloads say; listed, they would bury it."""

    def analyzed(self):
        analyze(self)
        self.overloads = {}

    return analyzed


ModuleAnalyzer.analyze = without_overloads(ModuleAnalyzer.analyze)


# `:param a, b: ...` says the same of several. Sphinx would take all but the last for a type, so an invisible
# separator stands in place of the commas until it has looked.
def join_names(app, domain, objtype, content):
    for name in content.findall(nodes.field_name):
        name[:] = [nodes.Text(name.astext().replace(", ", "\u2063"))]


def part_names(app, doctree):
    for text in [text for text in doctree.findall(nodes.Text) if "\u2063" in text]:
        text.parent.replace(text, nodes.Text(text.replace("\u2063", ", ")))


def hide_private(app, what, name, object, options, signature, returns):
    return signature and re.sub(r", _\w+(=\w+)?", "", signature), returns


def setup(app):
    app.connect("autodoc-process-signature", hide_private)
    app.connect("object-description-transform", join_names)
    app.connect("doctree-read", part_names)
    app.add_directive("drawing", Drawing)
    app.add_directive("viewer", Viewer)
