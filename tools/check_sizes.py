"""Checks source files: none over 350 lines, at most one in four over 200, no line over 120 columns.

A line with a web address may be longer, and generated files are not checked.
"""

import sys
from pathlib import Path

from sources import SOURCE_SUFFIXES, Finding, report, sources

LONGEST = 350
USUAL = 200
MOST_OVER_USUAL = 0.25
WIDEST = 120


def findings(root: Path) -> list[Finding]:
    files = sources(root, SOURCE_SUFFIXES)
    lines = {path: (root / path).read_text(encoding="utf-8").splitlines() for path in files}
    lengths = {path: len(text) for path, text in lines.items()}
    found = [Finding(path, n, f"{n} lines; the limit is {LONGEST}") for path, n in lengths.items() if n > LONGEST]
    over = sorted((path for path, n in lengths.items() if n > USUAL), key=lambda path: -lengths[path])
    if len(over) > MOST_OVER_USUAL * len(lengths):
        reason = f"one of {len(over)} files over {USUAL} lines; the limit is a quarter of {len(lengths)}"
        found.append(Finding(over[0], lengths[over[0]], reason))
    for path, text in lines.items():
        for number, line in enumerate(text, 1):
            if len(line) > WIDEST and "://" not in line:
                found.append(Finding(path, number, f"{len(line)} columns; the limit is {WIDEST}"))
    return found


if __name__ == "__main__":
    sys.exit(report("sizes", findings, sys.argv))
