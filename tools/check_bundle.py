"""Checks that the studio's page is at most 400 kB gzipped: a browser loads all of it for the first paint."""

from __future__ import annotations

import gzip
import sys
from pathlib import Path

MOST = 400_000  # bytes


def weight(page: Path) -> dict[str, int]:
    """Gzipped size of each file of the page, bytes."""
    return {
        file.relative_to(page).as_posix(): len(gzip.compress(file.read_bytes(), 9))
        for file in sorted(page.rglob("*"))
        if file.is_file() and file.suffix != ".map"
    }


if __name__ == "__main__":
    files = weight(Path(__file__).resolve().parents[1] / "python" / "punctura" / "studio" / "page")
    if "index.html" not in files:
        sys.exit("bundle: there is no page; build it with: python tools/build_backend/studio_page.py")
    total = sum(files.values())
    if total > MOST:
        print("\n".join(f"{size:>9} {name}" for name, size in files.items()))
        sys.exit(f"bundle: {total / 1000:.0f} kB gzipped, over {MOST / 1000:.0f} kB")
    print(f"bundle: {total / 1000:.0f} kB gzipped")
