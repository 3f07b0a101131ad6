"""Prepares the folder that Sphinx reads: links to the tree, and the generated files.

The pages stand where they stand in the tree, so that a link which works on a code host works in the site, too.
"""

import re
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SITE = Path(__file__).resolve().parent
LINKED = (
    "docs/images",
    "examples/cpp",
    "examples/python",
    "capi/include",
    "core",
    "runtime",
    "python/punctura",
)
PAGES = (
    *("*.md", "docs/*.md", "docs/decisions/*.md", "docs/notebooks/*.md", "examples/*"),
    *("integrations/*.md", "integrations/*/README.md"),
)  # conf.py reads it, too
CONTENTS = "\n```{toctree}\n:hidden:\n:glob:\n\n*/README\n```\n"
LINK = re.compile(r"\]\(([^)#:\s]+)")
HEADER = re.compile(r"\]\((?:\.\./)*((?:core|runtime)/[\w/]+\.hpp)\)")
FOLDER = re.compile(r"\]\(((?:\.\./)*)core/punctura/(?:lab/)?(\w+)/?\)")


def page(text: str) -> str:
    """Changes the links to headers, so that they lead to the C++ reference."""
    return FOLDER.sub(r"](\1reference/cpp/\2.rst)", HEADER.sub(r"](#\1)", text))


def linked_files(page: Path) -> list[Path]:
    """The files that a page links to and that are no pages. Sphinx offers them for download."""
    found = [(page.parent / link).resolve() for link in LINK.findall(page.read_text(encoding="utf-8"))]
    return [path for path in found if path.is_file() and path.suffix != ".md"]


def lay_out(folder: Path) -> None:
    """Creates the folder again. Pages are copied; other files are links."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in LINKED:
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(ROOT / name)
    pages = [path for pattern in PAGES for path in ROOT.glob(pattern) if path.is_file()]
    linked = {path for page in pages if page.suffix == ".md" for path in linked_files(page)}
    for path in [*pages, *sorted(linked.difference(pages))]:
        place = folder / path.relative_to(ROOT)
        if place.exists():
            continue
        place.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".md":
            place.write_text(page(path.read_text(encoding="utf-8")), encoding="utf-8")
        else:
            place.symlink_to(path)
    with (folder / "integrations" / "README.md").open("a", encoding="utf-8") as overview:
        overview.write(CONTENTS)
    shutil.copy(SITE / "index.md", folder / "index.md")
