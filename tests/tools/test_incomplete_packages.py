"""A package that an interrupted installation left incomplete is installed again: its record is removed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

TOOL = Path(__file__).resolve().parents[2] / "tools/incomplete_packages.py"
RECORD = (
    "kind/__init__.py,sha256=x,9\nkind-1.dist-info/METADATA,,\nkind-1.dist-info/RECORD,,\nkind/__pycache__/a.pyc,,\n"
)


def install(folder: Path) -> Path:
    files = {
        "kind/__init__.py": "whole = 1",
        "kind-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: kind\nVersion: 1\n",
        "kind-1.dist-info/RECORD": RECORD,
        "kind-1.dist-info/INSTALLER": "uv",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    return folder / "kind-1.dist-info"


def remove_incomplete(folder: Path) -> str:
    return subprocess.run([sys.executable, TOOL, folder], capture_output=True, text=True, check=True).stdout


def test_the_record_of_a_complete_package_stays(tmp_path):
    record = install(tmp_path)
    assert remove_incomplete(tmp_path) == ""
    assert record.is_dir()


@pytest.mark.parametrize(
    "lost", ["kind/__init__.py", "kind-1.dist-info/METADATA", "kind-1.dist-info/RECORD", "kind-1.dist-info/INSTALLER"]
)
def test_the_record_of_a_package_without_a_file_is_removed(tmp_path, lost):
    record = install(tmp_path)
    (tmp_path / lost).unlink()
    assert remove_incomplete(tmp_path) == "kind-1.dist-info is incomplete and will be installed again.\n"
    assert not record.exists()


def test_the_record_of_a_package_with_half_a_file_is_removed(tmp_path):
    record = install(tmp_path)
    (tmp_path / "kind/__init__.py").write_text("who")
    remove_incomplete(tmp_path)
    assert not record.exists()


def test_a_record_that_ends_in_the_middle_of_a_line_is_removed(tmp_path):
    record = install(tmp_path)
    (record / "RECORD").write_text(RECORD + "kind/other.py,sha2")
    remove_incomplete(tmp_path)
    assert not record.exists()
