"""What pip installs: the compiled core, and the C++ headers with the CMake package for other people's projects."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

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
