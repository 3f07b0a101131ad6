"""A part of Sphinx: the search shows its summaries also if the site is opened as a file, without a server.

It writes the texts of all pages into one script, which search.html alone loads, and only if it is a file.
"""

import json
from html import escape
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

VOID = {"area", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}
LEFT_OUT = {"script", "style"}


class Text(HTMLParser):
    """The text of a page's main part, with the elements that have an anchor. Sphinx's search reads it as the page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self._parts: list[str] = []
        self._open: list[tuple[str, str]] = []  # of the elements that are open: tag, and what closes it here
        self._inside = self._left_out = 0
        self.feed(page)
        self.text = "".join(self._parts)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag in VOID:
            return
        known = dict(attributes)
        begins, closes = known.get("role") == "main", ""
        self._left_out += self._left_out > 0 or tag in LEFT_OUT or "headerlink" in (known.get("class") or "").split()
        if (self._inside or begins) and not self._left_out and (begins or known.get("id")):
            anchor = f' id="{escape(known["id"] or "")}"' if known.get("id") else ""
            self._parts.append(f"<div{' role=main' if begins else ''}{anchor}>")
            closes = "</div>"
        self._inside += self._inside > 0 or begins
        self._open.append((tag, closes))

    def handle_endtag(self, tag: str) -> None:
        if tag in VOID or tag not in (name for name, _ in self._open):
            return
        while self._open:
            name, closes = self._open.pop()
            self._parts.append(closes)
            self._inside -= self._inside > 0
            self._left_out -= self._left_out > 0
            if name == tag:
                return

    def handle_data(self, data: str) -> None:
        if self._inside and not self._left_out:
            self._parts.append(escape(data, quote=False))


def write(html: Path) -> None:
    """Writes the texts of the site in this folder."""
    pages = {path.relative_to(html).as_posix(): path for path in sorted(html.rglob("*.html"))}
    texts = {name: Text(path.read_text(encoding="utf-8")).text for name, path in pages.items()}
    script = f"const PAGE_TEXTS = {json.dumps(texts, ensure_ascii=False)};\n"
    (html / "_static" / "page_texts.js").write_text(script, encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    def in_the_search(app: Any, name: str, template: str, context: Any, tree: Any) -> None:
        if name == "search":
            app.add_js_file("search_file.js")

    def finished(app: Any, error: Exception | None) -> None:
        if error is None:
            write(Path(app.outdir))

    app.config.html_static_path.append(str(Path(__file__).parent / "static"))
    app.connect("html-page-context", in_the_search)
    app.connect("build-finished", finished)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
