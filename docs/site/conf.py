"""Sphinx's settings for the site. docs/site/build.py makes the folder of pages that they are about, and passes what
differs from build to build by the environment."""
import os

from docutils import nodes
from docutils.utils.math import latex2mathml
from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

project = "Ortung"
author = "the Ortung developers"
copyright = author  # noqa: A001  (Sphinx calls it so)
version = release = os.environ["ORTUNG_SITE_VERSION"]
html_title = f"Ortung {version}"
html_last_updated_fmt = None  # the same pages for the same sources

extensions = ["myst_parser", "breathe", "sphinx_copybutton"]
root_doc = "docs/index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = []

myst_enable_extensions = ["dollarmath", "attrs_image"]
myst_heading_anchors = 4
myst_url_schemes = ("http", "https", "mailto")

# Blocks that only our tests know the language of (tests/docs/blocks.py).
for language in ("session", "replies", "recording"):
    lexers[language] = TextLexer()

html_theme = "furo"
html_static_path = [os.environ["ORTUNG_SITE_STATIC"]]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_search_summary = False  # each is fetched, which browsers refuse to pages that are files
html_math_renderer = "mathml"
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = False

nitpicky = True
nitpick_ignore_regex = [
    # The C++ domain looks up each word of a signature: those of the standard library and of Eigen, and what is not public.
    (r"cpp:.*", r".*"),
    # Types of numpy and of typing in the stubs.
    (r"py:.*", r"(np|npt|os|pathlib|typing)\..*|[A-Z]\w*|_\w+|bool|float|int|str|bytes"),
]

if "ORTUNG_SITE_DOXYGEN" in os.environ:
    breathe_projects = {"ortung": os.environ["ORTUNG_SITE_DOXYGEN"]}
    breathe_default_project = "ortung"
    breathe_default_members = ("members",)
    breathe_show_include = False


def visit_math(self, node):
    """Formulas as MathML, which browsers draw themselves: nothing has to be fetched."""
    self.body.append(latex2mathml.tex2mathml(node.astext(), inline=True))
    raise nodes.SkipNode


def visit_math_block(self, node):
    self.body.append('<div class="formula">' + latex2mathml.tex2mathml(node.astext(), inline=False) + "</div>")
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math_block, None))
