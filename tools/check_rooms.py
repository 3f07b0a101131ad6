"""An include or import may point to its own room or to one above it; docs/architecture.md draws the rooms."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from sources import CPP_SUFFIXES, Finding, report, sources

# From the top down. A folder of core, then what stands on core.
ROOMS = (
    "core/punctura/model",
    "core/punctura/state",
    "core/punctura/signal",
    "core/punctura/proxy",
    "core/punctura/insertion",
    "core/punctura/device",
    "core/punctura/safety",
    "core/punctura/servo",
    "core/punctura/scene",
    "core/punctura/plant",
    "core/punctura/punctura.hpp",  # all of them in one include
    "runtime/punctura_runtime",
    "python/bindings",
    "python/punctura",
)
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def room_of(path: str) -> str | None:
    return next((room for room in ROOMS if path == room or path.startswith(room + "/")), None)


def includes(text: str) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(text.splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1]


def target_of(include: str, path: str, tree: set[str]) -> str | None:
    """The file of this tree that an include names, or None for a foreign one."""
    beside = PurePosixPath(path).parent / include
    parts: list[str] = []
    for part in beside.parts:
        parts = parts[:-1] if part == ".." else [*parts, part]
    candidates = ["/".join(parts), f"core/{include}", f"runtime/{include}"]
    return next((candidate for candidate in candidates if candidate in tree), None)


def cpp_findings(root: Path) -> Iterator[Finding]:
    files = sources(root, CPP_SUFFIXES)
    tree = set(files)
    for path in files:
        room = room_of(path)
        if path.startswith(("core/", "runtime/")) and room is None:
            yield Finding(path, 1, "lies in no room that tools/check_rooms.py knows")
        if room is None:
            continue
        for line, include in includes((root / path).read_text(encoding="utf-8")):
            target = target_of(include, path, tree)
            if target is None:
                if include.startswith("punctura"):
                    yield Finding(path, line, f"includes {include}, which does not exist")
                continue
            there = room_of(target)
            if there is None or ROOMS.index(there) > ROOMS.index(room):
                yield Finding(path, line, f"{room} may not include {target}: it lies below")


def imported(text: str, path: str) -> Iterator[tuple[int, str]]:
    package = list(PurePosixPath(path).with_suffix("").parts)[:-1]
    for node in ast.walk(ast.parse(text, path)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield node.lineno, alias.name
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            yield node.lineno, ".".join([*base, *(node.module or "").split(".")]).strip(".")


def python_findings(root: Path) -> Iterator[Finding]:
    """The package imports nothing of tests, tools and the like; its command line and studio stand lowest."""
    outside = {"tests", "benchmarks", "tools", "examples", "oracles"}
    lowest = ("punctura.cli", "punctura.studio")
    for path in sources(root, (".py",)):
        if not path.startswith("python/punctura/"):
            continue
        inner = path.removeprefix("python/")
        for line, module in imported((root / path).read_text(encoding="utf-8"), inner):
            if module.split(".")[0] in outside:
                yield Finding(path, line, f"the package may not import {module}")
            elif module.startswith(lowest) and not inner.startswith(tuple(name.replace(".", "/") for name in lowest)):
                yield Finding(path, line, f"only the command line and the studio may import {module}")


def findings(root: Path) -> list[Finding]:
    return [*cpp_findings(root), *python_findings(root)]


if __name__ == "__main__":
    sys.exit(report("rooms", findings, sys.argv))
