"""Shared by the tools that generate files of the tree."""

import argparse
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def write(tool: str, doc: str | None, files: dict[str, str], argv: list[str] | None = None) -> int:
    """Writes the files, by their path in the tree. With --check: returns 1 if one is not current, and prints it."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="fail if the files are out of date")
    check, old = parser.parse_args(argv).check, []
    for name, text in files.items():
        path = ROOT / name
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            old.append(name)
    if old:
        print(f"{', '.join(old)} is out of date; run: python tools/{Path(tool).name}")
    return 1 if old else 0
