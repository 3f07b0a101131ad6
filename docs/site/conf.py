"""Sphinx's settings. Sphinx runs on the folder that build.py prepares, never on docs/ itself."""

import re
import sys
from pathlib import Path
from typing import Any

import punctura

sys.path.insert(0, str(Path(__file__).parent))
from field_words import give_words, members
from layout import PAGES
from text import docstring_rst

project = "Punctura"
author = "the Punctura contributors"
version = release = punctura.__version__
html_title = f"Punctura {release}"

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_copybutton", "sphinx_design", "search_texts"]
root_doc = "index"
include_patterns = [*PAGES, "reference/**", "gallery/*"]
exclude_patterns = ["capi/**", "core/**", "runtime/**", "python/**"]
source_suffix = {".md": "myst-nb", ".rst": "restructuredtext"}

myst_enable_extensions = ["attrs_inline", "colon_fence"]
myst_heading_anchors = 4  # so that page.md#a-heading works as it does on a code host
suppress_warnings = ["misc.highlighting_failure"]  # an output or a shortened listing need not be valid code
highlight_language = "text"
default_role = "code"  # `name` in a docstring

autoclass_content = "both"  # the docstring of the class, and of its constructor
autodoc_docstring_signature = True  # the compiled functions carry their signatures in their docstrings
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "imported-members": True, "undoc-members": True}

nb_execution_mode = "force"
nb_execution_show_tb = True
nb_execution_timeout = 120

copybutton_selector = "div:not(.highlight-text, .output) > div.highlight > pre"  # what a program prints is not copied

html_theme = "furo"
html_show_sphinx = html_show_copyright = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}


def short(signature: str) -> str:
    """Removes the module's name from a compiled function's signature, and shows a default object as `...`."""
    plain = re.sub(r"^\(self(, )?", "(", signature)
    plain = re.sub(r"punctura\._core\.|collections\.abc\.|numpy\.typing\.", "", plain)
    return re.sub(r"= \w+\((?:[^()]|\([^()]*\))*\)", "= ...", plain)


def setup(app: Any) -> None:
    def docstring(app: Any, what: str, name: str, item: object, options: Any, lines: list[str]) -> None:
        if what == "property" and lines and (kind := re.fullmatch(r"\(self\) -> (.+)", lines[0])):
            lines[:] = [f"`{short(kind[1])}`", *lines[1:]]  # a compiled property without words of its own
        lines += members(item) if what == "class" else []
        base = ", ".join(f"`{kind.__name__}`" for kind in item.__bases__) if isinstance(item, type) else ""
        lines[:] = docstring_rst([*lines, *([f"Derives from {base}."] if what == "exception" else [])])

    def signature(
        app: Any, what: str, name: str, item: object, options: Any, arguments: str | None, result: str | None
    ) -> tuple[str, str | None] | None:
        return (short(arguments), result and short(result)) if arguments else None

    trees: dict[str, str] = {}

    def sidebar(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
        make, folder = context.get("toctree"), page.rpartition("/")[0]
        context["toctree"] = lambda **how: trees.get(folder) or trees.setdefault(folder, make(**how) if make else "")

    if "quick" in app.tags:  # the tree takes a third of the time, and differs in its marks alone between two pages
        app.connect("html-page-context", sidebar, priority=400)  # before the theme reads it
    app.connect("builder-inited", lambda app: give_words())
    app.connect("autodoc-process-docstring", docstring)
    app.connect("autodoc-process-signature", signature)
