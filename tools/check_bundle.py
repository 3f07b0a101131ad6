"""Checks the gzipped size of the studio's page: of all its files, and of those that it needs for its first picture."""

import gzip
import re
import sys
from pathlib import Path

MOST = 400_000  # bytes
MOST_AT_FIRST = 200_000
_NAMED = re.compile(r"\./(assets/[^\"]+)\"")  # in index.html
_IMPORTED = re.compile(r"(?:from|import)[\"'`]\./([^\"'`]+)[\"'`]")  # at once; import(...) comes later


def weight(page: Path) -> dict[str, int]:
    """Gzipped size of each file of the page, bytes."""
    return {
        file.relative_to(page).as_posix(): len(gzip.compress(file.read_bytes(), 9))
        for file in sorted(page.rglob("*"))
        if file.is_file() and file.suffix != ".map"
    }


def at_first(page: Path) -> set[str]:
    """The files that the page needs before its first picture: those that index.html names, and what they import."""
    found = {"index.html"}
    left = _NAMED.findall((page / "index.html").read_text(encoding="utf-8"))
    while left:
        name = left.pop()
        if name not in found:
            found.add(name)
            text = (page / name).read_text(encoding="utf-8") if name.endswith(".js") else ""
            left += [f"assets/{each}" for each in _IMPORTED.findall(text)]
    return found


if __name__ == "__main__":
    page = Path(__file__).resolve().parents[1] / "python" / "punctura" / "studio" / "page"
    files = weight(page)
    if "index.html" not in files:
        sys.exit("bundle: there is no page; build it with: python tools/build_backend/studio_page.py")
    total = sum(files.values())
    first = sum(files[name] for name in at_first(page))
    words = f"bundle: {total / 1000:.0f} kB gzipped, {first / 1000:.0f} kB of it before the first picture"
    if total > MOST or first > MOST_AT_FIRST:
        print("\n".join(f"{size:>9} {name}" for name, size in files.items()))
        sys.exit(f"{words}; at most {MOST / 1000:.0f} and {MOST_AT_FIRST / 1000:.0f} kB")
    print(words)
