"""Checks that files include or import only files of their own and of higher rooms (docs/architecture.md)."""

import sys
from collections.abc import Iterator
from pathlib import Path

from imports import PACKAGE, PAGE, Import, circles, cpp_imports, page_imports, python_imports
from sources import CPP_SUFFIXES, Finding, report, sources

# From top to bottom: core, the code on top of core, the Python package, the page.
ROOMS = (
    "core/punctura/model",
    "core/punctura/state",
    "core/punctura/signal",
    "core/punctura/proxy",
    "core/punctura/syringe",
    "core/punctura/insertion",
    "core/punctura/device",
    "core/punctura/safety",
    "core/punctura/servo",
    "core/punctura/scene",
    "core/punctura/rivals",
    "core/punctura/lab/events",  # no tick of a device needs the rooms of lab
    "core/punctura/lab/trace",
    "core/punctura/lab/plant",
    "core/punctura/punctura.hpp",  # includes most of core
    "runtime/punctura_runtime",
    "capi",
    "python/bindings",
    "python/punctura/restore.py",
    "python/punctura/results.py",
    "python/punctura/progress.py",
    "python/punctura/errors.py",
    "python/punctura/call_errors.py",
    "python/punctura/extras.py",
    "python/punctura/one_thread.py",
    "python/punctura/paths.py",
    "python/punctura/syringe.py",
    "python/punctura/files",
    "python/punctura/ticks",
    "python/punctura/scene",
    "python/punctura/simulation",
    "python/punctura/batches",
    "python/punctura/__init__.py",
    "python/punctura/defects.py",
    "python/punctura/process",
    "python/punctura/device_words.py",
    "python/punctura/fmu",
    "python/punctura/mujoco",
    "python/punctura/gym",
    "python/punctura/poses.py",
    "python/punctura/record",
    "python/punctura/events",
    "python/punctura/trace",
    "python/punctura/identify",
    "python/punctura/live",
    "python/punctura/exercise",
    "python/punctura/reproduce",
    "python/punctura/rivals",
    "python/punctura/compare",
    "python/punctura/study",
    "python/punctura/ready_protocols",
    "python/punctura/perception",
    "python/punctura/studio/wire",
    "python/punctura/studio",
    "python/punctura/cli",
    "python/punctura/__main__.py",
    "web/src/format.ts",
    "web/src/frames.ts",
    "web/src/wire",
    "web/src/engine",
    "web/src/state",
    "web/src/panel.ts",
    "web/src/hand",
    "web/src/pop",
    "web/src/plots/kit",
    "web/src/plots",
    "web/src/tissue",
    "web/src/scene",
    "web/src/slice",
    "web/src/controls",
    "web/src/stage",
    "web/src/bench.ts",
    "web/src/layout.ts",
    "web/src/main.ts",
    "web/src/static.ts",
)
WITH_ROOMS = ("core/", "runtime/", "capi/", PACKAGE, PAGE)  # every source file in these folders belongs to a room
OUTSIDE = {"tests", "benchmarks", "tools", "examples", "oracles"}  # the package must not import these


def room_of(path: str) -> str | None:
    """The room of a file: the longest match, because `studio/wire` is a separate room inside `studio`."""
    return max((room for room in ROOMS if path == room or path.startswith(room + "/")), key=len, default=None)


def unknown_rooms(root: Path) -> Iterator[Finding]:
    for path in sources(root, (*CPP_SUFFIXES, ".py", ".ts"), generated=True):
        if path.startswith(WITH_ROOMS) and room_of(path) is None:
            yield Finding(path, 1, "is in no room that tools/check_rooms.py knows")


def order_findings(imports: list[Import]) -> Iterator[Finding]:
    for path, line, name, target in imports:
        room = room_of(path)
        if room is None:
            continue
        verb = "include" if path.endswith(CPP_SUFFIXES) else "import"
        if target is None:
            missing = name.startswith("punctura" if verb == "include" else ".") and not name.endswith(".css")
            if missing:
                yield Finding(path, line, f"{verb}s {name}, which does not exist")
            elif path.startswith(PACKAGE) and name.split(".")[0] in OUTSIDE:
                yield Finding(path, line, f"the package may not import {name}")
            continue
        there = room_of(target)
        if there is None or ROOMS.index(there) > ROOMS.index(room):
            yield Finding(path, line, f"{room} may not {verb} {target}, which is in a lower room")


def circle_findings(imports: list[Import]) -> Iterator[Finding]:
    """Import circles. Leaves out a package's __init__.py: it imports its modules, and they may import its siblings."""
    targets: dict[str, set[str]] = {}
    for found in imports:
        if found.target is not None and not found.path.endswith("/__init__.py"):
            targets.setdefault(found.path, set()).add(found.target)
    for group in circles(targets):
        line = next(found.line for found in imports if found.path == group[0] and found.target in group)
        yield Finding(group[0], line, f"import circle: {', '.join(group)}")


def findings(root: Path) -> list[Finding]:
    found = list(unknown_rooms(root))
    for imports in (list(cpp_imports(root)), list(python_imports(root)), list(page_imports(root))):
        found += [*order_findings(imports), *circle_findings(imports)]
    return found


if __name__ == "__main__":
    sys.exit(report("rooms", findings, sys.argv))
