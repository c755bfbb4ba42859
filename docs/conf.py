"""Sphinx configuration. Everything that the pages quote from the program is produced while they are built."""

import importlib.util
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

import make_pages  # noqa: E402 - beside this file
from sphinx.util import inspect  # noqa: E402

from rodwell import __version__  # noqa: E402

project = "rodwell"
author = "The rodwell developers"
copyright = author
version = release = __version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx.ext.viewcode",
]
nb_execution_mode = "force"  # the tutorial is executed while the pages are built; what fails in it fails them
nb_execution_raise_on_error = True
nb_execution_timeout = 300
shutil.copy(HERE.parent / "examples" / "tutorial.ipynb", HERE)
exclude_patterns = ["_build", "_generated", "jupyter_execute", "Thumbs.db", ".DS_Store"]
highlight_language = "none"
smartquotes_action = "D"  # dashes only: primes are derivatives

# Mathematics without a network: one file of the bundled MathJax, which draws with outlines and loads no fonts.
_bundle = importlib.util.find_spec("sphinx-mathjax-offline")
if _bundle is None or not _bundle.submodule_search_locations:
    raise RuntimeError("sphinx-mathjax-offline is missing: pip install '.[docs]'")
mathjax_path = "tex-svg.js"
mathjax3_config = {"svg": {"scale": 0.92}}
html_static_path = ["_static", str(Path(_bundle.submodule_search_locations[0], "static", "mathjax", mathjax_path))]

html_theme = "furo"
html_title = f"rodwell {version}"
html_css_files = ["rodwell.css"]
html_copy_source = html_show_sourcelink = False

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath", "substitution"]
myst_heading_anchors = 3
myst_substitutions = make_pages.build()

# The view to turn and zoom, in the pages as it is in a report.
_live = HERE / "_generated" / "live"
_live.mkdir(exist_ok=True)
shutil.copy(make_pages.RESULTS / "rod-3d.html", _live / "drill-string-3d.html")
shutil.copy(make_pages.RESULTS.parent / "path" / "load-path-3d.html", _live / "load-path-3d.html")
html_static_path.append(str(_live))

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_type_aliases = {"FloatArray": "FloatArray"}
inspect.TypeAliasForwardRef.__repr__ = lambda self: self.name  # inside tuples and unions too
napoleon_google_docstring = False
napoleon_attr_annotations = False


def _colons(app, what, name, obj, options, lines):
    """Before napoleon: what stands before a colon in the first line of a property is not its type."""
    if what in ("attribute", "property") and lines:
        lines[0] = lines[0].replace(": ", " – ")


def _absolute_values(app, what, name, obj, options, lines):
    """Bars around a symbol are absolute values in docstrings, not substitutions."""
    lines[:] = [re.sub(r"\|(\w[^|\s]*)\|", r"\\|\1\\|", line) for line in lines]


_beside = {}


def _navigation_once(app, pagename, templatename, context, doctree):
    """Pages of source code stand in no table of contents: those of one folder have the same one beside them.

    The theme asks for it on every page, and most of the pages are of source code: a third of the time of a build.
    """
    if doctree is None and pagename.startswith("_modules/"):
        made, folder = context["toctree"], pagename.rpartition("/")[0]

        def navigation(**options):
            key = folder, *sorted(options.items())
            if key not in _beside:
                _beside[key] = made(**options)
            return _beside[key]

        context["toctree"] = navigation


def setup(app):
    app.connect("html-page-context", _navigation_once, priority=400)  # before the theme's own
    app.connect("autodoc-process-docstring", _colons, priority=400)
    app.connect("autodoc-process-docstring", _absolute_values, priority=600)
