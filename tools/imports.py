"""Finds the includes and imports of all files in the tree, and the file that each one refers to."""

import ast
import posixpath
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from sources import CPP_SUFFIXES, sources

PACKAGE = "python/punctura/"
PAGE = "web/src/"
_MADE = PAGE + "wire/messages.ts"  # by npm run types; git ignores it
_COMPILED = "punctura._core"
_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
# import "./a.ts"; import x from "./a.ts"; export { x } from "./a.ts"; import("./a.ts"); new URL("./a.ts", ...)
_PAGE_IMPORT = re.compile(r"""(?:\bfrom|\bimport|\bimport\s*\(|\bnew\s+URL\s*\()\s*["'](\.[^"']+)["']""")


class Import(NamedTuple):
    """One include or import. target: the file of this tree that it refers to; None if it is external."""

    path: str
    line: int
    name: str
    target: str | None


def cpp_imports(root: Path) -> Iterator[Import]:
    """All includes of C++ and C files."""
    files = sources(root, CPP_SUFFIXES)
    for path, text in _texts(root, files):
        for line, name in _matches(_INCLUDE, text):
            beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
            candidates = (beside, f"core/{name}", f"runtime/{name}", f"capi/include/{name}")
            yield Import(path, line, name, next((file for file in candidates if file in files), None))


def page_imports(root: Path) -> Iterator[Import]:
    """All imports in the page's files, including type and dynamic imports."""
    files = [path for path in sources(root, (".ts", ".json"), generated=True) if path.startswith(PAGE)]
    code = [path for path in files if path.endswith(".ts")]
    files.append(_MADE)
    for path, text in _texts(root, code):
        for line, name in _matches(_PAGE_IMPORT, text):
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
            yield Import(path, line, name, target if target in files else None)


def python_imports(root: Path) -> Iterator[Import]:
    """All imports in the package's files, including those in functions and under TYPE_CHECKING.

    A name that `punctura/__init__.py` re-exports counts as an import of its defining module.
    """
    texts = dict(_texts(root, [path for path in sources(root, (".py",)) if path.startswith(PACKAGE)]))
    modules = {_module(path): path for path in texts}
    facade = texts.get(f"{PACKAGE}__init__.py", "")
    exported = {name: module for module, name, _ in _imported(facade, "punctura", is_package=True) if name}
    for path, text in texts.items():
        for module, name, line in _imported(text, _module(path), is_package=path.endswith("__init__.py")):
            full = f"{module}.{name}" if name else module
            if full in modules or full == _COMPILED:
                module = full
            elif module == "punctura" and name in exported:
                module = exported[name]
            yield Import(path, line, full if full in modules else module, modules.get(module))


def _imported(text: str, module: str, is_package: bool) -> Iterator[tuple[str, str, int]]:
    """For each import: the module, the imported name (empty for the module itself), and the line."""
    package = module.split(".") if is_package else module.split(".")[:-1]
    for node in ast.walk(ast.parse(text, module)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name, "", node.lineno
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            source = ".".join([*base, *filter(None, [node.module])])
            for alias in node.names:
                yield source, alias.name, node.lineno


def circles(imports: Mapping[str, set[str]]) -> list[list[str]]:
    """Groups of files that import each other, each group sorted. Tarjan's algorithm."""
    found: list[list[str]] = []
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []

    def visit(file: str) -> None:
        index[file] = low[file] = len(index)
        stack.append(file)
        for target in sorted(imports.get(file, ())):
            if target not in index:
                visit(target)
                low[file] = min(low[file], low[target])
            elif target in stack:
                low[file] = min(low[file], index[target])
        if low[file] == index[file]:
            group = stack[stack.index(file) :]
            del stack[stack.index(file) :]
            if len(group) > 1 or file in imports.get(file, ()):
                found.append(sorted(group))

    for file in sorted(imports):
        if file not in index:
            visit(file)
    return found


def _module(path: str) -> str:
    return path.removeprefix("python/").removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def _texts(root: Path, files: list[str]) -> Iterator[tuple[str, str]]:
    for path in files:
        yield path, (root / path).read_text(encoding="utf-8")


def _matches(pattern: re.Pattern[str], text: str) -> Iterator[tuple[int, str]]:
    for match in pattern.finditer(text):
        yield text.count("\n", 0, match.start(1)) + 1, match[1]
