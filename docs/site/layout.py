"""Prepares the folder that Sphinx reads: links to the tree, and the generated files.

The pages stand where they stand in the tree, so that a link which works on a code host works in the site, too.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SITE = Path(__file__).resolve().parent
# Files that a page links to. Sphinx offers a linked file for download if it is not a page.
LINKED = (
    "CITATION.cff",
    "LICENSE",
    "docs/images",
    "examples/cpp",
    "examples/python",
    "capi/include",
    "core",
    "runtime",
    "python/punctura",
)
PAGES = ("*.md", "docs/*.md", "docs/decisions/*.md", "docs/notebooks/*.md", "examples/*")  # conf.py reads it, too
HEADER = re.compile(r"\]\((?:\.\./)*((?:core|runtime)/[\w/]+\.hpp)\)")
FOLDER = re.compile(r"\]\(((?:\.\./)*)core/punctura/(?:lab/)?(\w+)/?\)")


def page(text: str) -> str:
    """Changes the links to headers, so that they lead to the C++ reference."""
    return FOLDER.sub(r"](\1reference/cpp/\2.rst)", HEADER.sub(r"](#\1)", text))


def lay_out(folder: Path) -> None:
    """Creates the folder again. Pages are copied; other files are links."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in LINKED:
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(ROOT / name)
    for path in [p for pattern in PAGES for p in ROOT.glob(pattern) if p.is_file()]:
        place = folder / path.relative_to(ROOT)
        place.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".md":
            place.write_text(page(path.read_text(encoding="utf-8")), encoding="utf-8")
        else:
            place.symlink_to(path)
    shutil.copy(SITE / "index.md", folder / "index.md")
