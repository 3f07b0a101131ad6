"""Each member of the Python reference has words of its own, or is named in the words of its class."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path


class Entry:
    """A class, a function or a member, and the text below it that is not of a member."""

    def __init__(self, outer: Entry | None) -> None:
        self.outer, self.name, self.words, self.described = outer, "", "", False


class Reference(HTMLParser):
    """The entries of a page of autodoc."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.entries: list[Entry] = []
        self._open: list[Entry | None] = []  # a definition list each; None: one that is no entry
        self.feed(page)

    @property
    def _entry(self) -> Entry | None:
        return next((entry for entry in reversed(self._open) if entry), None)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        known, entry = dict(attributes), self._entry
        if tag == "dl":
            of_python = (known.get("class") or "").startswith("py ")
            self._open.append(Entry(entry) if of_python else None)
        elif tag == "dt" and entry and self._open[-1] is entry and not entry.name:
            entry.name = known.get("id") or ""
        elif tag == "dd" and entry and self._open[-1] is entry:
            entry.described = True

    def handle_endtag(self, tag: str) -> None:
        if tag == "dl" and self._open and (entry := self._open.pop()):
            self.entries.append(entry)

    def handle_data(self, data: str) -> None:
        if (entry := self._entry) and entry.described:
            entry.words += data


def findings(html: Path) -> Iterator[str]:
    """Members without words, of all pages of the reference."""
    for path in sorted(html.glob("reference/python/*.html")):
        for entry in Reference(path.read_text(encoding="utf-8")).entries:
            own = entry.name.rpartition(".")[2]
            of_class = entry.outer.words if entry.outer else ""
            if not entry.words.strip() and not re.search(rf"\b{re.escape(own)}\b", of_class):
                yield f"{path}: {entry.name} has no words: write a docstring, or a comment beside the field"
