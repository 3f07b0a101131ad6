"""Sphinx's settings. Sphinx runs on the folder that build.py lays out, never on docs/ itself."""

import sys
from pathlib import Path
from typing import Any

import punctura

sys.path.insert(0, str(Path(__file__).parent))
from text import docstring_rst

project = "Punctura"
author = "the Punctura authors"
version = release = punctura.__version__
html_title = f"Punctura {release}"

extensions = ["myst_nb", "sphinx.ext.autodoc"]
root_doc = "index"
include_patterns = ["*.md", "docs/*.md", "docs/notebooks/*.md", "examples/README.md", "reference/**", "gallery/*"]
exclude_patterns = ["core/**", "runtime/**", "python/**"]
source_suffix = {".md": "myst-nb", ".rst": "restructuredtext"}

myst_enable_extensions = ["attrs_inline"]
myst_heading_anchors = 4  # so that page.md#a-heading works as it does on a code host
suppress_warnings = ["misc.highlighting_failure"]  # an output or a shortened listing need not be valid code
highlight_language = "text"
default_role = "code"  # `name` in a docstring

autodoc_docstring_signature = True  # the compiled functions carry their signatures in their docstrings
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "imported-members": True, "undoc-members": True, "show-inheritance": True}

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120

html_theme = "furo"
html_show_sphinx = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}


def setup(app: Any) -> None:
    def plain(app: Any, what: str, name: str, item: object, options: Any, lines: list[str]) -> None:
        lines[:] = docstring_rst(lines)

    app.connect("autodoc-process-docstring", plain)
