"""What is packed: the installed package, the sdist, and one version in all files.

pip installs the compiled core, and the C++ headers with the CMake package for other people's projects. The sdist holds
every file of the tree and the studio's page, and nothing that a build leaves; tools/release.sh builds a wheel from it.
CMakeLists.txt defines the version; files that cannot read it from there have the same one. tools/release.sh releases
only what is in a commit.
"""

import json
import re
import shutil
import subprocess
import sys
import tarfile
from importlib.metadata import entry_points, version
from pathlib import Path

import punctura
import pytest
from punctura import _core, paths
from punctura.paths import cmake_dir, include_dir

ROOT = Path(__file__).resolve().parents[2]


def headers(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*.hpp")}


def punctura_paths(*options: str) -> str:
    command = [sys.executable, "-m", "punctura", "paths", *options]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_the_package_holds_every_header_of_core_and_runtime() -> None:
    assert headers(include_dir()) == headers(ROOT / "core") | headers(ROOT / "runtime")


def test_the_verb_paths_prints_what_the_functions_return() -> None:
    assert punctura_paths("--include") == f"{include_dir()}\n"
    assert punctura_paths("--cmake") == f"{cmake_dir()}\n"
    lines = [line.split(maxsplit=1) for line in punctura_paths().splitlines()]
    assert lines == [["include", str(include_dir())], ["cmake", str(cmake_dir())]]


def test_cmake_finds_the_package_in_the_folder_and_in_the_prefix() -> None:
    assert (cmake_dir() / "punctura-config.cmake").is_file()
    (prefix,) = entry_points(group="cmake.prefix", name="punctura")  # scikit-build-core adds it to CMAKE_PREFIX_PATH
    assert cmake_dir() == Path(prefix.load().__file__).parent / "lib/cmake/punctura"


def test_a_copy_that_pip_did_not_install_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paths, "_PREFIX", tmp_path)
    for folder in (include_dir, cmake_dir):
        with pytest.raises(FileNotFoundError, match=r"Run `pip install \.` in its source folder"):
            folder()


@pytest.mark.skipif(sys.platform != "linux", reason="nm reads ELF files")
def test_the_compiled_core_exports_its_entry_point_only() -> None:
    listed = subprocess.run(["nm", "-D", "--defined-only", _core.__file__], capture_output=True, text=True, check=True)
    assert [line.split()[-1] for line in listed.stdout.splitlines()] == ["PyInit__core"]


BUILD = "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])"
PAGE = "python/punctura/studio/page/"  # git ignores it; ./test builds it before the tests
BUILT = ("build/", "out/", ".venv/", ".git/", "web/node_modules/")


def test_an_sdist_is_the_tree_with_the_page(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", BUILD, str(tmp_path)], cwd=ROOT, check=True, capture_output=True)
    (archive,) = tmp_path.glob("punctura-*.tar.gz")
    with tarfile.open(archive) as opened:
        packed = {name.partition("/")[2] for name in opened.getnames()}
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    tree = {file for file in listed.splitlines() if (ROOT / file).exists()}
    assert tree - packed == set()
    assert PAGE + "index.html" in packed
    assert [name for name in packed if name.startswith(BUILT) or "__pycache__" in name] == []


INTEGRATIONS = {  # each file and the line with the version
    "rust/Cargo.toml": r'\nversion = "(.*)"',
    "wasm/package.json": r'"version": "(.*)"',
}


def test_every_place_has_the_same_version():
    number = re.search(r"project\(punctura VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert punctura.__version__ == number
    assert version("punctura") == number
    assert json.loads((ROOT / "web" / "package.json").read_text())["version"] == number
    assert f"\nversion: {number}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"## {number}" in (ROOT / "CHANGELOG.md").read_text()
    for file, line in INTEGRATIONS.items():
        found = re.search(line, (ROOT / "integrations" / file).read_text())
        assert found and found[1] == number, file


def test_the_readmes_of_the_npm_package_and_the_c_library_name_only_what_their_reader_has():
    packed = json.loads((ROOT / "integrations/wasm/package.json").read_text())
    for file in ("integrations/wasm/README.md", "capi/README.md"):
        links = re.findall(r"\]\(([^)]+)\)", (ROOT / file).read_text())
        assert [link for link in links if not link.startswith("#")] == []
    text = (ROOT / "integrations/wasm/README.md").read_text()
    assert f"npm install ./punctura-npm-{packed['version']}.tgz" in text
    assert set(re.findall(r"node_modules/punctura/([\w.]+)", text)) <= set(packed["files"])


def test_a_release_refuses_a_file_that_is_in_no_commit(tmp_path: Path) -> None:
    for name in ("tools/release.sh", "tools/zig.sh", "integrations/tools.sh", "CMakeLists.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    subprocess.run(["git", "init", "--quiet"], cwd=tmp_path, check=True)
    ended = subprocess.run(["tools/release.sh", "notes"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ended.returncode == 1
    assert "Not in the commit" in ended.stderr and "CMakeLists.txt" in ended.stderr
    assert not (tmp_path / "build").exists()
