"""A built page must work without a network, and every link inside the site must have its target."""

import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes that make a browser fetch something without a click.
FETCHED = {
    "script": ("src",), "link": ("href",), "img": ("src", "srcset"), "iframe": ("src",), "source": ("src", "srcset"),
    "video": ("src",), "object": ("data",),
}  # fmt: skip
IN_STYLE = re.compile(r"@import\s+[\"']([^\"']+)|url\(\s*[\"']?([^\"')]+)")


class Page(HTMLParser):
    """The files that a page fetches, its links and its anchors."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.fetched: list[str] = []
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if not value:
                continue
            if name == "id":
                self.anchors.add(value)
            elif tag == "a" and name == "href":
                self.links.append(value)
            elif name in FETCHED.get(tag, ()):
                self.fetched.append(value)
            elif name == "style":
                self.fetched += urls(value)


def urls(style: str) -> list[str]:
    return [first or second for first, second in IN_STYLE.findall(style)]


def foreign(url: str) -> bool:
    return bool(urlsplit(url).netloc)


def findings(html: Path) -> list[str]:
    """All problems of the site in this folder."""
    built = {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in sorted(html.rglob("*.html"))}
    return [*over_the_network(html, built), *dead_links(built)]


def over_the_network(html: Path, built: dict[Path, Page]) -> Iterator[str]:
    for path, page in built.items():
        yield from (f"{path}: fetches {url} from another host" for url in page.fetched if foreign(url))
    for path in sorted(html.rglob("*.css")):
        found = urls(path.read_text(encoding="utf-8"))
        yield from (f"{path}: fetches {url} from another host" for url in found if foreign(url))


def dead_links(built: dict[Path, Page]) -> Iterator[str]:
    for path, page in built.items():
        for url in page.links:
            parts = urlsplit(url)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                yield f"{path}: links to {url}, which is not there"
            elif target in built and parts.fragment and unquote(parts.fragment) not in built[target].anchors:
                yield f"{path}: links to {url}, a page without that anchor"
