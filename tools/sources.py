"""Shared by the tree checks: the project's own files, and the form of a finding."""

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

CPP_SUFFIXES = (".hpp", ".cpp", ".h", ".c")
GENERATED = ("web/src/wire/tick_table.ts",)  # by tools/make_tick_table.py
SOURCE_SUFFIXES = (*CPP_SUFFIXES, ".py", ".pyi", ".ts", ".sh", ".cmake")


class Finding(NamedTuple):
    """One place that breaks a rule."""

    path: str
    line: int
    reason: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.reason}"


def sources(root: Path, suffixes: tuple[str, ...], generated: bool = False) -> list[str]:
    """Sorted paths, with forward slashes, that git tracks or would track; all files outside a git tree.

    generated: whether to include generated files.
    """
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listed = subprocess.run(command, capture_output=True, check=True, text=True).stdout.split("\0")
    except (OSError, subprocess.CalledProcessError):
        listed = [path.relative_to(root).as_posix() for path in root.rglob("*")]
    skipped = () if generated else GENERATED
    return sorted(
        {path for path in listed if path.endswith(suffixes) and path not in skipped and (root / path).is_file()}
    )


def report(name: str, findings: Callable[[Path], list[Finding]], argv: list[str]) -> int:
    """Prints all findings for the tree given on the command line, default this one. Returns 1 if there are any."""
    root = Path(argv[1]) if len(argv) > 1 else Path(__file__).resolve().parent.parent
    found = findings(root)
    for finding in found:
        print(finding)
    print(f"{name}: {len(found)} findings" if found else f"{name}: in order")
    return 1 if found else 0
